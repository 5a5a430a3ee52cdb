//! Reads a sentence and prints what it means: `cargo run --example read_a_sentence -- 'the mug is on the table'`.

use spatial_fetch::grounding::{Grounder, Method};
use spatial_fetch::language::chunk_text;

fn main() {
    let said = std::env::args().nth(1);
    let text = said.unwrap_or_else(|| "my mug is on the table by the chairs in the bedroom".to_string());
    let (tokens, chunks) = chunk_text(&text);
    let meaning = Grounder::new(Method::Composed, true).ground(&text, &tokens, &chunks);
    println!("room:   {}", meaning.room.and_then(|room| room.name).unwrap_or_else(|| "not said".to_string()));
    println!("object: {}", meaning.object.map_or("not said".to_string(), |object| object.name.to_string()));
    for node in &meaning.nodes {
        let pairs: Vec<String> = node.pairs.iter().map(|pair| pair.phrase()).collect();
        println!("where:  {} – {}", node.target.as_deref().unwrap_or("somewhere"), pairs.join(", "));
    }
    println!("score:  {:.2}", meaning.score.0);
}
