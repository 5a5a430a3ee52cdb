use proptest::prelude::*;

use super::*;
use crate::language::{Class, Lexicon};

fn class(noun: &str) -> Option<NounClass> {
    Vocabulary::embedded().class_of(noun)
}

#[test]
fn the_shipped_tables_are_whole_sorted_and_of_known_classes() {
    let vocabulary = Vocabulary::embedded();
    let nouns: Vec<&str> = vocabulary.nouns.lines().filter_map(|line| line.split('\t').next()).collect();
    let english: Vec<&str> = vocabulary.english.lines().collect();
    assert!(nouns.len() > 10_000 && english.len() > 70_000, "{} and {}", nouns.len(), english.len());
    assert!(nouns.is_sorted_by(|a, b| a < b) && english.is_sorted_by(|a, b| a < b));
    for noun in nouns {
        assert!(vocabulary.noun(noun).is_some(), "`{noun}` has a class");
        assert!(noun.split('_').all(|word| vocabulary.is_english(word)), "`{noun}` is English");
    }
}

#[test]
fn nouns_of_a_home_have_the_class_of_what_people_mean_in_it() {
    let of = [
        ("table", NounClass::TableLike),
        ("escritoire", NounClass::TableLike),
        ("throne", NounClass::Seat),
        ("chesterfield", NounClass::Couch),
        ("bassinet", NounClass::Bed),
        ("tallboy", NounClass::Storage),
        ("penlight", NounClass::Lamp),
        ("icebox", NounClass::Appliance),
        ("washstand", NounClass::Furniture),
        ("hearthrug", NounClass::Structure),
        ("scullery", NounClass::Room),
        ("carafe", NounClass::Container),
        ("skillet", NounClass::Utensil),
        ("peanut", NounClass::Food),
        ("cappuccino", NounClass::Drink),
        ("pitchfork", NounClass::Tool),
        ("poncho", NounClass::Garment),
        ("kaleidoscope", NounClass::Toy),
        ("camcorder", NounClass::Electronics),
        ("atlas", NounClass::Stationery),
        ("painkiller", NounClass::Medicine),
        ("daffodil", NounClass::Plant),
        ("puppy", NounClass::Animal),
        ("grandmother", NounClass::Person),
        ("elbow", NounClass::BodyPart),
        ("tambourine", NounClass::Artifact),
    ];
    for (noun, expected) in of {
        assert_eq!(class(noun), Some(expected), "{noun}");
    }
}

#[test]
fn what_the_grammar_reads_otherwise_is_no_thing() {
    for word in ["right", "left", "back", "front", "look", "will", "can", "turn", "sour", "means", "equipment", "go"] {
        assert_eq!(class(word), None, "{word}");
    }
}

#[test]
fn plurals_are_what_their_singulars_are_and_glasses_are_worn() {
    let singular = |noun| Vocabulary::embedded().noun(noun).map(|noun| noun.singular);
    let plurals = ["knives", "boxes", "loaves", "berries", "cookies", "potatoes", "mice", "teeth", "policemen", "axes"];
    let singulars = ["knife", "box", "loaf", "berry", "cookie", "potato", "mouse", "tooth", "policeman", "axe"];
    assert_eq!(plurals.map(singular), singulars.map(Some));
    assert_eq!((class("glasses"), class("glass")), (Some(NounClass::Garment), Some(NounClass::Container)));
    assert_eq!(["bus", "gas", "s", "es", "ves"].map(singular), [None; 5]);
}

#[test]
fn a_compound_is_what_its_head_is() {
    assert_eq!(class("Coffee Mugs"), Some(NounClass::Container));
    assert_eq!(class("chipped_soup_bowl"), Some(NounClass::Container));
    assert_eq!(class("bottle_of_peanuts"), Some(NounClass::Container));
    assert_eq!(["_", "xyzzy_plugh", "table_", "of", "_of_"].map(class), [None; 5]);
}

#[test]
fn inflected_american_and_british_words_are_english_and_slips_are_not() {
    let english = |word: &&str| Vocabulary::embedded().is_english(word);
    let words = ["closed", "washed", "heated", "longer", "colour", "color", "grey", "gray", "Larder", "bookends"];
    assert_eq!(words.iter().filter(|word| !english(word)).count(), 0);
    assert_eq!(["mgu", "tabel", "bedrom", "teh", "", "\n", "a\nb"].iter().filter(|word| english(word)).count(), 0);
}

#[test]
fn a_table_that_was_changed_opens_no_vocabulary() {
    let nouns = include_str!("../../../corpus/vocabulary/nouns.tsv");
    let changed: &'static str = Box::leak(nouns.replacen("\tanimal\n", "\tperson\n", 1).into_boxed_str());
    let english = include_str!("../../../corpus/vocabulary/english.txt");
    let error = Vocabulary::open(changed, english).expect_err("another checksum");
    assert!(error.to_string().contains("table of nouns is damaged"), "{error}");
    let short = &english[..english.len() - 1];
    assert!(Vocabulary::open(nouns, short).expect_err("cut off").to_string().contains("table of english is damaged"));
}

#[test]
fn furniture_and_rooms_of_the_lexicon_that_the_vocabulary_knows_are_seldom_something_else() {
    let nouns = Lexicon::embedded().nouns().iter();
    let both: Vec<(Class, Class)> = nouns
        .filter(|noun| noun.class != Class::Object && noun.class != Class::Part)
        .filter_map(|noun| Some((noun.class, Vocabulary::embedded().noun(&noun.name)?.class.class()?)))
        .collect();
    let alike = both.iter().filter(|(written, inferred)| written == inferred).count();
    assert!(alike * 10 >= both.len() * 7, "{alike} of {}", both.len());
}

proptest! {
    #[test]
    fn any_text_gets_an_answer(text in "\\PC*|[a-z_ \\n\\t]{0,20}|(_of_|_|ves|men|s){0,6}") {
        let vocabulary = Vocabulary::embedded();
        let known = vocabulary.noun(&text).is_some();
        prop_assert!(!known || vocabulary.class_of(&text).is_some() || text.contains("of"));
        vocabulary.is_english(&text);
        Lexicon::embedded().mended(&text);
        Lexicon::embedded().inferred(&text);
    }

    #[test]
    fn a_word_of_english_is_never_mended(at in 0_usize..76_000) {
        let word = Vocabulary::embedded().english.lines().nth(at).unwrap_or_default();
        prop_assert_eq!(Lexicon::embedded().mended(word), None);
    }
}
