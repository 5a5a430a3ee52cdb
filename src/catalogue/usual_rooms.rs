//! In which rooms a piece of furniture usually stands: which is tried first when nobody said.

/// Rooms and the furniture by which people know them, by the nouns of the lexicon.
const USUAL: [(&str, &[&str]); 9] = [
    ("bedroom", &["bed", "nightstand", "dresser", "wardrobe", "headboard", "bunk_bed", "crib"]),
    ("living_room", &["couch", "coffee_table", "tv_stand", "recliner", "fireplace", "armchair", "loveseat", "ottoman"]),
    ("kitchen", &["refrigerator", "stove", "oven", "counter", "sink", "microwave", "dishwasher", "kitchen_table"]),
    ("dining_room", &["dinner_table", "dining_table", "sideboard"]),
    ("bathroom", &["toilet", "bathtub", "shower", "washbasin"]),
    ("office", &["desk", "computer_desk", "filing_cabinet", "office_chair"]),
    ("study", &["desk", "computer_desk", "bookshelf"]),
    ("laundry_room", &["washing_machine", "dryer"]),
    ("hallway", &["coat_rack", "shoe_rack"]),
];

/// The rooms in which a piece of furniture usually stands, by their names.
pub fn usual_rooms(noun: &str) -> impl Iterator<Item = &'static str> {
    USUAL.iter().filter(move |(_, furniture)| furniture.contains(&noun)).map(|(room, _)| *room)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bed_stands_in_a_bedroom_and_a_chair_anywhere() {
        assert_eq!(usual_rooms("bed").collect::<Vec<_>>(), ["bedroom"]);
        assert_eq!(usual_rooms("chair").count(), 0);
    }
}
