//! What the chunker promises for any text.

use proptest::prelude::*;
use spatial_fetch::language::chunk_text;
use spatial_fetch::language::tokens::tokenize;
use spatial_fetch::record::{Chunk, Tag};

/// Text as people say it, with nonsense mixed in.
fn speech() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        8 => prop::sample::select(vec![
            "go", "turn", "left", "right", "the", "table", "couch", "room", "on", "in", "behind", "of", "and", "then",
            "mug", "is", "there", "you", "will", "find", "until", "wall", "sorry", "um", "not", "its", "'s", "door",
            "with", "far", "end", "halfway", "bedroom", "to", "your", "side", "look", "down", "a", "between", "two",
        ])
        .prop_map(str::to_string),
        1 => "\\PC{1,6}",
    ];
    prop::collection::vec(word, 0..40).prop_map(|words| words.join(" "))
}

fn check_level(text: &str, chunks: &[Chunk], start: usize, end: usize) {
    let mut from = start;
    for chunk in chunks {
        assert!(from <= chunk.start && chunk.start < chunk.end && chunk.end <= end, "{chunk:?} in {text:?}");
        assert!(text.is_char_boundary(chunk.start) && text.is_char_boundary(chunk.end));
        check_level(text, &chunk.chunks, chunk.start, chunk.end);
        from = chunk.end;
    }
}

proptest! {
    #[test]
    fn chunks_nest_stand_in_order_and_do_not_overlap(text in speech()) {
        let (_, chunks) = chunk_text(&text);
        check_level(&text, &chunks, 0, text.len());
    }

    #[test]
    fn tokens_are_the_text_without_its_spaces(text in "\\PC{0,80}") {
        let joined: String = tokenize(&text).iter().map(|word| word.text).collect();
        let bare: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        prop_assert_eq!(joined, bare);
    }

    #[test]
    fn every_token_is_the_slice_it_points_at(text in speech()) {
        let (tokens, _) = chunk_text(&text);
        prop_assert!(tokens.iter().all(|token| text[token.start..token.end] == token.text && !token.pos.is_empty()));
    }

    #[test]
    fn the_same_text_gives_the_same_tree(text in speech()) {
        prop_assert_eq!(chunk_text(&text), chunk_text(&text));
    }
}

fn tags(text: &str) -> Vec<Tag> {
    fn walk(chunks: &[Chunk], tags: &mut Vec<Tag>) {
        for chunk in chunks {
            tags.push(chunk.tag);
            walk(&chunk.chunks, tags);
        }
    }
    let mut all = Vec::new();
    walk(&chunk_text(text).1, &mut all);
    all
}

#[test]
fn a_sentence_of_where_is_one_clause_about_the_object() {
    let text = "the cellphone is in the living room on the right on the table to the right side behind the couch";
    assert_eq!(tags(text), [Tag::Obtp, Tag::Ormtp, Tag::Ormrp, Tag::Furtp, Tag::Irmrp, Tag::Furrp]);
}

#[test]
fn a_sentence_of_how_is_a_room_steps_and_the_object() {
    let text = "drive straight and hang a left, walk halfway in, then turn right and you'll see the mug";
    assert_eq!(tags(text), [Tag::Ormtp, Tag::Ormrp, Tag::Irmrp, Tag::Irmrp, Tag::Obtp]);
}

#[test]
fn a_correction_stays_in_the_tree() {
    assert!(tags("turn left no sorry turn right and it is on the desk").contains(&Tag::Conf));
}

#[test]
fn capitals_and_punctuation_change_nothing() {
    let said = tags("go to the kitchen and find the mug on the counter");
    assert_eq!(tags("Go to the Kitchen, and find the mug on the counter!"), said);
}

#[test]
fn texts_without_a_description_have_no_chunks() {
    for text in ["", "   ", "🤖🤖", "bonjour tout le monde", "?!"] {
        assert!(chunk_text(text).1.is_empty(), "{text:?}");
    }
}

#[test]
fn a_hundred_thousand_words_are_read_like_ten() {
    for phrase in ["the ", "turn left sorry ", "go forward and to the right and then ", "behind the couch "] {
        let text = phrase.repeat(100_000 / phrase.split_whitespace().count());
        let (tokens, chunks) = chunk_text(&text);
        assert!(tokens.len() > 99_000);
        check_level(&text, &chunks, 0, text.len());
    }
}
