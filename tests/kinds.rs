//! Kinds of descriptions and requests: each with sentences of its own.

use spatial_fetch::grounding::{Grounder, Method};
use spatial_fetch::language::chunk_text;
use spatial_fetch::record::Grounding;

fn ground(text: &str) -> Grounding {
    let (tokens, chunks) = chunk_text(text);
    Grounder::new(Method::Composed, false).ground(text, &tokens, &chunks)
}

/// Object, room, last target, pairs, destination, what is ruled out, the number of further errands: in one line.
fn told(text: &str) -> String {
    line(&ground(text))
}

fn line(meaning: &Grounding) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(meaning.object.iter().map(|object| object.name.clone()));
    parts.extend(meaning.also.iter().map(|object| format!("+{}", object.name)));
    if let Some(room) = &meaning.room {
        parts.extend(room.name.iter().map(|name| format!("in:{name}")));
        parts.extend(room.side.iter().map(|side| format!("side:{}", side.name())));
    }
    let mut targets = meaning.nodes.iter().filter_map(|node| node.target.as_ref());
    parts.extend(targets.next_back().map(|target| format!("on:{target}")));
    let pairs = meaning.nodes.iter().flat_map(|node| &node.pairs);
    let pairs = pairs.map(|pair| format!("{}/{}", pair.reference, pair.direction.name()));
    parts.extend(pairs.filter(|pair| pair != "move/front"));
    if let Some(goal) = &meaning.destination {
        let all = [("to", &goal.recipient), ("to-room", &goal.room), ("to-place", &goal.target)];
        parts.extend(all.into_iter().filter_map(|(name, said)| Some(format!("{name}:{}", said.as_ref()?))));
    }
    parts.extend(meaning.not.iter().map(|not| format!("not:{}", not.name)));
    parts.extend(meaning.then.iter().map(|next| format!("then({})", line(next))));
    parts.join(" ")
}

fn all(cases: &[(&str, &str)]) {
    let wrong: Vec<String> = cases
        .iter()
        .filter(|(text, wanted)| told(text) != *wanted)
        .map(|(text, wanted)| format!("{text}\n  wanted {wanted}\n  got    {}", told(text)))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_ruled_out_is_never_acted_on() {
    all(&[
        ("the kettle isn't in the office", "kettle not:office"),
        ("bring me a drink that is not a juice", "drink to:speaker not:juice"),
        ("find the hammer but don't go into the garage", "hammer not:garage"),
        ("find the hammer, but please do not look in the attic", "hammer not:attic"),
        ("get me a magazine, no newspaper", "magazine to:speaker not:newspaper"),
        ("fetch the sponge from the sink, not the brush", "sponge on:sink not:brush"),
        ("stay out of the nursery and find the drum", "drum not:nursery"),
    ]);
}

#[test]
fn a_thing_goes_from_its_source_to_its_destination() {
    all(&[
        ("get the kettle from the stove and set it on the sideboard", "kettle on:stove to-place:sideboard"),
        ("take the towel from the bathroom to the laundry room", "towel in:bathroom to-room:laundry_room"),
        ("carry the vase to the credenza", "vase to-place:credenza"),
        ("bring me the stapler from the filing cabinet", "stapler on:filing_cabinet to:speaker"),
        (
            "find the ladle in the kitchen and give it to Priya in the garage",
            "ladle in:kitchen to:priya to-room:garage",
        ),
        ("put the spoon in the mug", "spoon to-place:mug"),
        ("put the lantern to the left of the bench", "lantern bench/left"),
    ]);
}

#[test]
fn several_things_and_several_errands() {
    all(&[
        ("bring me the fork and the ladle", "fork +ladle to:speaker"),
        (
            "find the drill in the garage, then find the kettle in the kitchen",
            "drill in:garage then(kettle in:kitchen)",
        ),
        ("put the milk in the fridge and the hammer in the garage", "milk to-place:fridge then(hammer to-room:garage)"),
        ("go to the sideboard and the piano", "on:sideboard then(on:piano)"),
    ]);
}

#[test]
fn the_thing_asked_for_is_the_subject_or_what_the_verb_takes() {
    all(&[
        ("my wallet is in the briefcase on the bench", "wallet on:bench briefcase/side"),
        ("find the key in the box", "keys box/side"),
        ("the rack has a lantern to the left of it", "on:rack lantern/right"),
        ("a box of matches is on the mantel", "match_box on:mantel"),
    ]);
}

#[test]
fn lists_after_a_relation_give_a_pair_each() {
    all(&[
        ("on a bench near a vase, a globe and a piano", "on:bench vase/side globe/side piano/side"),
        ("the pen is on the desk beside the globe and vase", "pen on:desk globe/side vase/side"),
    ]);
}

#[test]
fn rooms_before_furniture_and_rooms_entered_last() {
    all(&[
        ("the comb is on the bedroom dresser", "comb in:bedroom on:dresser"),
        ("leave the kitchen and go into the den", "in:den"),
        ("the broom is in the hallway", "broom in:hallway"),
        ("go down the hallway to the study", "in:study"),
    ]);
}

#[test]
fn numbers_and_typography_are_read_as_meant() {
    all(&[
        ("the ‘cup’ is on the coffee-table--behind the couch", "cup on:coffee_table couch/back"),
        ("the cup is in the living\u{2011}room", "cup in:living_room"),
        ("the mgu is on teh tabel", "mug on:table"),
    ]);
    let turn = ground("enter the room on the left and turn forty five degrees to the right");
    let amount = turn.nodes[0].pairs[0].amount.clone();
    assert_eq!(amount, Some(spatial_fetch::record::Amount::Degrees(45.0)));
    let walk = ground("enter the room on the left and walk forward 1.5 meters");
    assert_eq!(walk.nodes[0].pairs[0].amount, Some(spatial_fetch::record::Amount::Meters(1.5)));
}

#[test]
fn words_of_english_are_left_alone_and_repairs_are_told() {
    assert_eq!(told("the cup is in the closed box"), "cup box/side");
    assert_eq!(told("give me the peanuts from the sofa"), "peanuts on:couch to:speaker");
    let meaning = ground("the walet is on the table in the bedroom");
    assert!(meaning.warnings.iter().any(|warning| warning.contains("\"walet\"")), "{:?}", meaning.warnings);
}

#[test]
fn losing_a_word_never_makes_a_reading_surer() {
    let whole = ground("the kettle is on the stove in the kitchen");
    for text in
        ["the kettle is on the stove flarg in the kitchen", "the kettle is on the flarg stove gnup in the kitchen"]
    {
        assert!(ground(text).score < whole.score, "{text}");
    }
}

#[test]
fn what_is_carried_is_the_object_and_what_stands_holds_it() {
    all(&[
        ("the ladder is in the shed behind the mower", "ladder in:shed mower/back"),
        ("find the dumbbell under the weight bench", "dumbbell bench/under"),
        ("the scale is on the shelf in the left room", "scale side:left on:shelf"),
        ("the earrings are on the secretary desk in the bedroom", "earrings in:bedroom on:secretary_desk"),
        ("the hat is on the coat tree by the door", "hat on:coat_tree door/side"),
        ("the quilt is on the cot", "quilt on:cot"),
        ("my eye drops are on the washstand", "eye_drops on:washstand"),
        ("relocate the terrarium from the desk to the bathroom", "terrarium on:desk to-room:bathroom"),
    ]);
}
