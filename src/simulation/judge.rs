//! What a trial was worth, by the truth.

use super::Home;
use super::Item;
use crate::geometry::Vec2;
use crate::record::Outcome;

/// The judge's verdict.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Ids of the furniture approached.
    pub approached: Vec<String>,
    /// The furniture at which the object was found.
    pub target_id: Option<String>,
    /// Whether the first furniture approached holds the object.
    pub right_first: Option<bool>,
    /// Success weighted by path length.
    pub spl: Option<f64>,
}

/// Judges a trial: what was approached, where the object was found, how long the way was against the shortest.
pub fn judge(
    home: &Home,
    object: Option<&str>,
    approached: &[Vec2],
    found_at: Option<Vec2>,
    outcome: Outcome,
    distance_m: f64,
) -> Verdict {
    let id_at = |point: &Vec2| home.scene.furniture_at(*point).map(|item| item.id.clone());
    let holders = holders(home, object);
    // What is not there is the wrong place, too.
    let right_first = approached.first().map(|first| {
        let first = id_at(first);
        holders.iter().any(|item| Some(&item.id) == first.as_ref())
    });
    let approached: Vec<String> = approached.iter().filter_map(id_at).collect();
    let shortest =
        holders.iter().filter_map(|item| home.ways.to(&home.map, &home.scene, item)).fold(f64::INFINITY, f64::min);
    let spl = if outcome == Outcome::Found && shortest.is_finite() {
        Some(shortest / shortest.max(distance_m).max(1e-9))
    } else {
        (!holders.is_empty()).then_some(0.0)
    };
    let target_id = found_at.and_then(|point| home.scene.furniture_at(point)).map(|item| item.id.clone());
    Verdict { approached, target_id, right_first, spl }
}

/// The furniture that holds the object; any that holds something when none is named.
fn holders<'h>(home: &'h Home, object: Option<&str>) -> Vec<&'h Item> {
    match object {
        Some(name) => home.scene.holders_of(name),
        None => home.scene.objects.iter().filter_map(|object| home.scene.item(&object.on)).collect(),
    }
}
