//! The table of furniture categories in docs/world.md says what the rows of the catalogue say.

use std::path::Path;

use spatial_fetch::catalogue::{CATEGORIES, Category, Holds};

const BEGIN: &str = "UPDATE=1 cargo test --test catalogue -->\n";
const END: &str = "<!-- end of categories -->";

fn row(category: &Category) -> String {
    let size = category.size;
    let holds = if category.holds == Holds::Never { "" } else { "yes" };
    let also: Vec<String> = category.also_called.iter().map(|name| format!("`{name}`")).collect();
    format!(
        "| `{}` | {} | {} | {} × {} × {} | {holds} | {} |\n",
        category.name,
        category.noun.replace('_', " "),
        category.class.name().replace('_', "-"),
        size.length,
        size.width,
        size.height,
        also.join(", ")
    )
}

#[test]
fn the_table_of_categories_is_that_of_the_catalogue() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/world.md");
    let text = std::fs::read_to_string(&path).expect("docs/world.md");
    let begin = text.find(BEGIN).expect("the mark before the table") + BEGIN.len();
    let end = text.find(END).expect("the mark after the table");
    let head = "\n| category | called | class | length × width × height | small things on it | also known as |\n\
                |---|---|---|---|---|---|\n";
    let table = format!("{head}{}\n", CATEGORIES.iter().map(row).collect::<String>());
    if std::env::var_os("UPDATE").is_some() {
        let renewed = format!("{}{table}{}", &text[..begin], &text[end..]);
        return std::fs::write(&path, renewed).expect("written");
    }
    assert!(
        text[begin..end] == table,
        "docs/world.md differs from the catalogue; UPDATE=1 cargo test --test catalogue"
    );
}
