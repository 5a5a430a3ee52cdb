//! Regular plurals of English nouns.

/// What a word may be the plural of, likeliest first; nothing for a word that ends like none.
pub fn singulars(word: &str) -> impl Iterator<Item = String> {
    let irregular = match word {
        "knives" => Some("knife"),
        "shelves" => Some("shelf"),
        "bookshelves" => Some("bookshelf"),
        "loaves" => Some("loaf"),
        "mice" => Some("mouse"),
        "children" => Some("child"),
        "people" => Some("person"),
        "men" => Some("man"),
        "women" => Some("woman"),
        "dice" => Some("die"),
        _ => None,
    };
    let long = word.len() > 3;
    let stem = |ending: &str, new: &str| word.strip_suffix(ending).filter(|_| long).map(|stem| format!("{stem}{new}"));
    let plain = if word.ends_with("ss") || word.ends_with("us") || word.ends_with("is") { None } else { stem("s", "") };
    let hissing = ["shes", "ches", "xes", "ses", "zes", "oes"].iter().any(|ending| word.ends_with(ending));
    let es = if hissing { stem("es", "") } else { None };
    irregular.map(str::to_string).into_iter().chain(stem("ies", "y")).chain(plain).chain(es)
}

/// The likeliest singular of a word that may be a plural; the word itself when it ends like none.
pub fn singular(word: &str) -> String {
    let hissing = ["shes", "ches", "xes", "sses", "zes"].iter().any(|ending| word.ends_with(ending));
    let all: Vec<String> = singulars(word).collect();
    let best = if hissing { all.last() } else { all.first() };
    best.cloned().unwrap_or_else(|| word.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_plurals_lose_their_ending_and_others_stay() {
        let all = ["terrariums", "boxes", "berries", "knives", "glass", "cactus", "bus", "tissues", "couches"];
        let one: Vec<String> = all.iter().map(|word| singular(word)).collect();
        assert_eq!(one, ["terrarium", "box", "berry", "knife", "glass", "cactus", "bus", "tissue", "couch"]);
    }
}
