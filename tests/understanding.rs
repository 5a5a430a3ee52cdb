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
    all.map(|pair| (pair.reference.to_string(), pair.direction.name())).collect()
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
fn a_sentence_like_the_papers_figure_2_has_one_node_with_two_pairs() {
    let text = "my cellphone lies in the living room on your right, on the table to the right side in back of the sofa";
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
fn the_one_by_a_landmark_can_be_ruled_out_too() {
    let meaning = ground("the keys are in the room on the left on the dresser by the window not the one by the door");
    assert_eq!(pairs(&meaning), [pair("window", "side")]);
    assert!(meaning.warnings.iter().any(|warning| warning.contains("negation")), "{:?}", meaning.warnings);
}

#[test]
fn furniture_that_stands_on_furniture_is_what_is_asked_for() {
    let meaning = ground("the lamp is in the kitchen on the counter by the sink");
    assert_eq!((object(&meaning), target(&meaning)), (Some("lamp"), Some("counter")));
    let meaning = ground("the dresser is next to the bed in the room on the left and the scarf is on the dresser");
    assert_eq!((object(&meaning), target(&meaning)), (Some("scarf"), Some("dresser")));
}

#[test]
fn a_place_that_brings_in_furniture_is_no_move() {
    let meaning = ground("take a right into the room and to your left is a shelf and the jar is on the shelf");
    assert_eq!((target(&meaning), pairs(&meaning)), (Some("shelf"), vec![pair("robot", "left")]));
}

#[test]
fn a_turn_whose_verb_is_not_said_again_is_a_turn() {
    let meaning = ground("hang a right then a left and the broom is on the rack");
    assert_eq!((side(&meaning), pairs(&meaning)), (Some(Direction::Right), vec![pair("move", "left")]));
}

#[test]
fn a_landmark_at_the_door_is_kept_when_the_room_is_said_last() {
    let meaning = ground("the ring is on the small shelf near the door in the room to the right");
    assert_eq!((side(&meaning), pairs(&meaning)), (Some(Direction::Right), vec![pair("door", "side")]));
}

#[test]
fn a_thing_without_a_name_is_no_object() {
    assert_eq!(object(&ground("the squishy thing is under the sofa in the room on the left")), None);
}

#[test]
fn there_and_it_mean_the_furniture_said_before() {
    for text in [
        "turn left and there is a desk and the keys are there",
        "turn left and find the desk the keys are on it",
        "turn left and you will see a desk and the keys are on that desk",
    ] {
        let meaning = ground(text);
        assert_eq!((object(&meaning), target(&meaning)), (Some("keys"), Some("desk")), "{text}");
        assert_eq!(meaning.nodes.len(), 1, "{text}");
    }
}

#[test]
fn behind_it_is_behind_the_furniture_named_last() {
    let meaning = ground("turn right and you will see a couch and behind it there is a desk the keys are there");
    assert_eq!((target(&meaning), object(&meaning)), (Some("desk"), Some("keys")));
    assert_eq!(pairs(&meaning), [pair("couch", "back")]);
}

#[test]
fn a_side_alone_corrects_a_turn() {
    assert_eq!(side(&ground("go ahead take a right no no left into the room")), Some(Direction::Left));
}

#[test]
fn a_left_hand_room_is_the_room_on_the_left() {
    assert_eq!(side(&ground("the scarf is on the bench in the left hand room")), Some(Direction::Left));
}

#[test]
fn other_readings_differ_from_the_best_and_from_one_another() {
    let meaning = ground("the mug is on the table behind the couch");
    let mut all = vec![(meaning.room.clone(), meaning.object.clone(), meaning.nodes.clone())];
    all.extend(meaning.readings.iter().map(|r| (r.room.clone(), r.object.clone(), r.nodes.clone())));
    assert!(all.len() > 1 && meaning.readings.iter().all(|reading| reading.score <= meaning.score));
    for (i, reading) in all.iter().enumerate() {
        assert!(!all[..i].contains(reading), "{reading:?} stands twice");
    }
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
