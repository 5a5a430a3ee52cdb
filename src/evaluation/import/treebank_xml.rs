//! Treebank XML: items `S` or `Note`, each with one tree.

use quick_xml::Reader;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::Event;

use super::super::treebank::{TokenEntry, tag_of};
use super::bracketed::TreeBuilder;
use crate::limits::TREE_DEPTH;

/// The item that is being read.
struct Item {
    tree: TreeBuilder,
    /// Names of the elements open in it.
    elements: Vec<String>,
    /// Text since the last element began or ended.
    text: String,
    line: usize,
}

/// The trees of all items, in order. Errors name the line.
pub(super) fn read(xml: &str) -> Result<Vec<TokenEntry>, String> {
    let mut reader = Reader::from_str(xml);
    let mut item: Option<Item> = None;
    let mut entries = Vec::new();
    let (mut line, mut counted) = (1, 0);
    loop {
        let at = (reader.buffer_position() as usize).clamp(counted, xml.len());
        line += xml.as_bytes()[counted..at].iter().filter(|byte| **byte == b'\n').count();
        counted = at;
        let wrong = |message: String| format!("line {line}: {message}");
        match reader.read_event().map_err(|error| wrong(format!("not well-formed XML ({error})")))? {
            Event::Start(start) => match &mut item {
                Some(item) => item.open(start.name().as_ref()).map_err(wrong)?,
                None if is_item(start.name().as_ref()) => item = Some(Item::new(line)),
                None => {}
            },
            Event::Text(text) => {
                if let Some(item) = &mut item {
                    item.text.push_str(&text);
                }
            }
            // "it&apos;s": the five of XML; others stand for nothing here.
            Event::GeneralRef(entity) => {
                if let Some(item) = &mut item {
                    item.text.push_str(resolve_predefined_entity(&entity).unwrap_or(" "));
                }
            }
            Event::End(_) => {
                let open = item.as_mut().map(Item::close).transpose().map_err(wrong)?;
                if let Some(item) = item.take_if(|_| open == Some(false)) {
                    let from = item.line;
                    let entry = item.tree.finish().map_err(|message| format!("item from line {from}: {message}"))?;
                    entries.extend((!entry.tokens.is_empty()).then_some(entry));
                }
            }
            Event::Eof if item.is_some() => return Err(wrong("the file ends within an item".to_string())),
            Event::Eof => return Ok(entries),
            _ => {}
        }
    }
}

fn is_item(name: &str) -> bool {
    matches!(name, "S" | "Note")
}

impl Item {
    fn new(line: usize) -> Self {
        Self { tree: TreeBuilder::default(), elements: Vec::new(), text: String::new(), line }
    }

    fn open(&mut self, name: &str) -> Result<(), String> {
        self.take_text()?;
        TREE_DEPTH.check(self.elements.len() + 1)?;
        if tag_of(name).is_some() {
            self.tree.open(name)?;
        }
        self.elements.push(name.to_string());
        Ok(())
    }

    /// Puts the text so far into the tree.
    fn take_text(&mut self) -> Result<(), String> {
        let text = std::mem::take(&mut self.text);
        match self.elements.last().filter(|name| tag_of(name).is_none()) {
            // An element that is no chunk is a word with its part of speech.
            Some(pos) => text.split_whitespace().for_each(|word| self.tree.word(word, Some(pos))),
            None => self.tree.text(&text)?,
        }
        Ok(())
    }

    /// Closes the innermost element; false when it is the item itself that closes.
    fn close(&mut self) -> Result<bool, String> {
        self.take_text()?;
        let Some(name) = self.elements.pop() else { return Ok(false) };
        if tag_of(&name).is_some() {
            self.tree.close();
        }
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bracketed_items_and_nested_elements_give_the_same_tree() {
        let bracketed = "<T>\n<S>(S (OBTP my/PRP$ mug/NN is/VBZ (FURTP on/ON it/PRP)))</S></T>";
        let nested = "<T><Note><OBTP><PRP>my</PRP> mug/NN is <FURTP>on it</FURTP></OBTP></Note></T>";
        let (a, b) = (read(bracketed).expect("read").remove(0), read(nested).expect("read").remove(0));
        assert_eq!((a.text.as_str(), b.text.as_str()), ("my mug is on it", "my mug is on it"));
        let spans =
            |entry: &TokenEntry| entry.chunks.iter().map(|c| (c.tag.clone(), c.start, c.end)).collect::<Vec<_>>();
        assert_eq!(spans(&a), spans(&b));
        assert_eq!(b.tokens[0].1, "PRP");
    }

    #[test]
    fn a_tree_that_nests_without_end_is_refused() {
        let nested = format!("<T><S>{}", "<OBTP>".repeat(100_000));
        assert!(read(&nested).expect_err("deep").contains("levels are more than the 1000"));
        let brackets = format!("<T><S>{}</S></T>", "(OBTP ".repeat(100_000));
        assert!(read(&brackets).expect_err("deep").contains("levels are more than the 1000"));
    }

    #[test]
    fn lines_are_counted_once_however_many_there_are() {
        let many = format!("<T>{}<S></T>", "<S>a</S>\n".repeat(200_000));
        assert!(read(&many).expect_err("not well-formed").starts_with("line 200001"));
    }

    #[test]
    fn what_is_wrong_is_located() {
        assert!(read("<T>\n<S>(S (OBTP mug</S></T>").expect_err("open").contains("item from line 2"));
        assert!(read("<T>\n<S></T>").expect_err("not well-formed").starts_with("line 2"));
    }
}
