//! What descriptions mean, end to end in the library.

use spatial_fetch::grounding::{Grounder, Method, answer};
use spatial_fetch::language::{Lexicon, chunk_text};
use spatial_fetch::record::{Direction, Grounding};

fn ground(text: &str) -> Grounding {
    let (tokens, chunks) = chunk_text(text);
    Grounder::new(Method::Composed, false).ground(text, &tokens, &chunks)
}

fn pairs(grounding: &Grounding) -> Vec<(String, &'static str)> {
    let all = grounding.nodes.iter().flat_map(|node| &node.pairs);
    all.map(|pair| (pair.reference.clone(), pair.direction.name())).collect()
}

fn pair(reference: &str, direction: &'static str) -> (String, &'static str) {
    (reference.to_string(), direction)
}

fn target(grounding: &Grounding) -> Option<&str> {
    grounding.nodes.iter().rev().find_map(|node| node.target.as_deref())
}

fn side(grounding: &Grounding) -> Option<Direction> {
    grounding.room.as_ref().and_then(|room| room.side)
}

fn object(grounding: &Grounding) -> Option<&str> {
    grounding.object.as_ref().map(|object| object.name.as_str())
}

#[test]
fn the_papers_figure_2_has_one_node_with_two_pairs() {
    let text = "the cellphone is in the living room on the right on the table to the right side behind the couch";
    let meaning = ground(text);
    assert_eq!(meaning.nodes.len(), 1);
    assert_eq!(pairs(&meaning), [pair("robot", "right"), pair("couch", "back")]);
    assert_eq!((object(&meaning), target(&meaning)), (Some("cellphone"), Some("table")));
    assert_eq!(meaning.room.as_ref().and_then(|room| room.name.as_deref()), Some("living_room"));
    assert_eq!(side(&meaning), Some(Direction::Right));
}

#[test]
fn the_first_side_picks_the_room_and_the_next_is_inside_it() {
    let meaning = ground("um roll forward and take a left and then take a right and the remote is on the dresser");
    assert_eq!(side(&meaning), Some(Direction::Left));
    assert_eq!(pairs(&meaning), [pair("move", "right")]);
}

#[test]
fn a_correction_replaces_what_it_corrects() {
    let meaning = ground("turn left oh sorry turn right into the den and the scarf is on the bench");
    assert_eq!(side(&meaning), Some(Direction::Right));
    assert!(meaning.warnings.iter().any(|warning| warning.contains("taken back")), "{:?}", meaning.warnings);
}

#[test]
fn a_turn_after_a_room_named_outright_is_inside_it() {
    let meaning = ground("go into the kitchen and make a sharp left");
    assert_eq!((side(&meaning), pairs(&meaning)), (None, vec![pair("move", "left")]));
}

#[test]
fn what_is_ruled_out_is_not_the_target() {
    let meaning = ground("the mug is in the room on the left not on the shelf on the counter");
    assert_eq!(target(&meaning), Some("counter"));
    assert!(!meaning.warnings.is_empty());
}

#[test]
fn other_things_on_the_same_support_are_landmarks() {
    let meaning =
        ground("in the room on the left there is a desk that has a globe on it and the wallet is on that desk");
    assert_eq!((object(&meaning), target(&meaning)), (Some("wallet"), Some("desk")));
    assert_eq!(pairs(&meaning), [pair("globe", "side")]);
}

#[test]
fn requests_are_understood() {
    let meaning = ground("can you bring me the book on the nightstand next to the bed please");
    assert_eq!((object(&meaning), target(&meaning)), (Some("book"), Some("nightstand")));
    assert_eq!(pairs(&meaning), [pair("bed", "side")]);
    let meaning = ground("I left my keys in the kitchen, I think near the sink");
    assert_eq!((object(&meaning), pairs(&meaning)), (Some("keys"), vec![pair("sink", "side")]));
}

#[test]
fn unknown_objects_are_named_with_less_confidence() {
    let known = ground("the mug is on the table in the room on the left");
    let unknown = ground("the frobnicator is on the table in the room on the left");
    assert_eq!(object(&unknown), Some("frobnicator"));
    assert!(unknown.score < known.score);
}

#[test]
fn a_misspelt_noun_is_understood() {
    assert_eq!(object(&ground("the walet is on the table")), Some("wallet"));
}

#[test]
fn without_a_room_one_question_is_asked_and_the_answer_settles_it() {
    let mut meaning = ground("the mug is on the table behind the couch");
    assert!(meaning.question.as_ref().is_some_and(|question| question.contains("room")), "{:?}", meaning.question);
    assert!(answer(&mut meaning, "the left one", Lexicon::embedded()));
    assert_eq!((side(&meaning), meaning.question), (Some(Direction::Left), None));
}

#[test]
fn an_answer_that_says_nothing_changes_nothing() {
    let mut meaning = ground("the mug is on the table behind the couch");
    let before = meaning.clone();
    assert!(!answer(&mut meaning, "hm", Lexicon::embedded()));
    assert_eq!(meaning, before);
}

#[test]
fn a_desk_said_again_by_its_head_noun_is_no_second_target() {
    let meaning = ground("in the room on the right go to the computer desk and the keys are on that desk");
    assert_eq!(meaning.nodes.iter().filter(|node| node.target.is_some()).count(), 1);
    assert_eq!(target(&meaning), Some("computer_desk"));
}

#[test]
fn words_that_changed_nothing_are_listed() {
    let meaning = ground("the mug is on the table in the room on the left by jove my zeppelin hovers");
    assert!(meaning.unused.iter().any(|span| span.text == "zeppelin"), "{:?}", meaning.unused);
}

#[test]
fn a_text_that_says_nothing_is_a_problem_not_an_error() {
    for text in ["", "🤖", "guten Tag"] {
        assert!(!ground(text).problems.is_empty(), "{text:?}");
    }
}
