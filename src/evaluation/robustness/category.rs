//! Which furniture category stands for a noun.

use crate::catalogue::CATEGORIES;
use crate::language::{Class, Lexicon};

/// What a landmark's noun becomes in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Furniture of this category.
    Furniture(&'static str),
    /// A thing on the same support.
    Object,
    /// Nothing that can be put there: a window, a corner.
    Nothing,
}

/// The furniture category nearest to a noun: its own, that of its head noun, else the usual one of its class.
pub fn body_of(noun: &str, lexicon: &Lexicon) -> Body {
    let own = |name: &str| CATEGORIES.iter().find(|c| c.name == name || c.noun == name).map(|c| c.name);
    if let Some(name) = own(noun) {
        return Body::Furniture(name);
    }
    let usual = match lexicon.class_of(noun) {
        Some(Class::TableLike) => small_table(noun),
        Some(Class::Seat) => "chair",
        Some(Class::Couch) => "couch",
        Some(Class::Bed) => "bed",
        Some(Class::Storage) => "cabinet",
        Some(Class::Lamp | Class::Plant) => {
            own("plant").filter(|_| lexicon.class_of(noun) == Some(Class::Plant)).unwrap_or("lamp")
        }
        Some(Class::Screen) => "tv_stand",
        Some(Class::Appliance) => "counter",
        Some(Class::Object) | None => return Body::Object,
        Some(_) => return Body::Nothing,
    };
    Body::Furniture(usual)
}

fn small_table(noun: &str) -> &'static str {
    match noun {
        "bedside_table" => "nightstand",
        "side_table" | "drum_table" | "stand" | "tray" => "end_table",
        "dining_table" | "kitchen_table" => "dinner_table",
        noun if noun.ends_with("desk") => "desk",
        noun if noun.contains("counter") || noun == "island" || noun == "bar" => "counter",
        _ => "table",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_furniture_noun_of_the_lexicon_has_a_body() {
        let lexicon = Lexicon::embedded();
        assert_eq!(body_of("bedside_table", lexicon), Body::Furniture("nightstand"));
        assert_eq!(body_of("computer_desk", lexicon), Body::Furniture("desk"));
        assert_eq!(body_of("headboard", lexicon), Body::Furniture("bed"));
        assert_eq!(body_of("clock", lexicon), Body::Object);
        assert_eq!(body_of("xyzzy", lexicon), Body::Object);
        assert_eq!(body_of("window", lexicon), Body::Nothing);
    }
}
