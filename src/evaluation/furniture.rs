//! Detections against what truly stands there: found, named, placed and turned right, and what is not there at all.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::Rate;
use super::furniture_gold::{GoldFrame, GoldItem};
use crate::catalogue::class_of;
use crate::geometry::{Polygon, angle_between, vec2};
use crate::record::{Detection, Rounded};

/// Footprints that overlap by this much (intersection over union) are one piece.
const LEAST_OVERLAP: f64 = 0.25;

/// How well furniture was seen.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct FurnitureScores {
    /// Frames.
    pub frames: usize,
    /// All items.
    pub all: SeenGroup,
    /// By true category.
    pub by_category: BTreeMap<String, SeenGroup>,
    /// Detections that match no item.
    pub extra: usize,
    /// True category → said category → how often.
    pub confusion: BTreeMap<String, BTreeMap<String, usize>>,
}

/// Some items.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct SeenGroup {
    /// Found of those that show enough.
    pub found: Rate,
    /// Of the found, right among the six kinds.
    pub kind: Rate,
    /// Of the found, the very name.
    pub name: Rate,
    /// Median distance of the middles, metres.
    pub centre_m: Rounded,
    /// Median error of the front's heading, degrees.
    pub yaw_deg: Rounded,
    #[serde(skip)]
    centres: Vec<f64>,
    #[serde(skip)]
    yaws: Vec<f64>,
}

/// Scores frames.
pub fn score_furniture(frames: &[GoldFrame]) -> FurnitureScores {
    let mut scores = FurnitureScores { frames: frames.len(), ..FurnitureScores::default() };
    frames.iter().for_each(|frame| scores.add(frame));
    scores.all.close();
    scores.by_category.values_mut().for_each(SeenGroup::close);
    scores
}

impl FurnitureScores {
    fn add(&mut self, frame: &GoldFrame) {
        let boxes: Vec<Polygon> = frame.detections.iter().map(|d| polygon(&d.footprint)).collect();
        let mut used = vec![false; boxes.len()];
        let furniture = frame.items.iter().filter(|i| class_of(&i.category).is_some() && i.footprint.len() > 2);
        for item in furniture {
            let outline = polygon(&item.footprint);
            let free = (0..boxes.len()).filter(|i| !used[*i]).map(|i| (boxes[i].overlap(&outline), i));
            let best = free.max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).filter(|b| b.0 >= LEAST_OVERLAP);
            if let Some((_, i)) = best {
                used[i] = true;
            }
            if item.is_scored() {
                let detection = best.map(|(_, i)| &frame.detections[i]);
                self.count(item, detection);
            }
        }
        self.extra += used.iter().filter(|used| !**used).count();
    }

    fn count(&mut self, item: &GoldItem, detection: Option<&Detection>) {
        let group = self.by_category.entry(item.category.clone()).or_default();
        group.count(item, detection);
        self.all.count(item, detection);
        let said = detection.map_or("(not found)", |d| d.category.as_str());
        *self.confusion.entry(item.category.clone()).or_default().entry(said.to_string()).or_default() += 1;
    }
}

impl SeenGroup {
    fn count(&mut self, item: &GoldItem, detection: Option<&Detection>) {
        self.found.count(detection.is_some());
        let Some(detection) = detection else { return };
        self.kind.count(class_of(&detection.category) == class_of(&item.category));
        self.name.count(detection.category == item.category);
        self.centres.push((vec2(detection.x, detection.y) - vec2(item.x, item.y)).norm());
        if let Some(yaw) = detection.yaw.filter(|_| item.orientation_kind == "facing") {
            self.yaws.push(angle_between(yaw, item.yaw).to_degrees());
        }
    }

    fn close(&mut self) {
        (self.centre_m, self.yaw_deg) = (median(&mut self.centres).into(), median(&mut self.yaws).into());
    }
}

fn polygon(corners: &[[f64; 2]]) -> Polygon {
    Polygon::new(corners.iter().map(|c| vec2(c[0], c[1])).collect())
}

/// The upper median; zero of none.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;

    fn corners(x: f64) -> Vec<[f64; 2]> {
        Polygon::rectangle(Pose::new(x, 0.0, 0.0), 1.0, 1.0).corners().iter().map(|c| [c.x, c.y]).collect()
    }

    fn item(category: &str, x: f64) -> GoldItem {
        GoldItem {
            id: None,
            category: category.to_string(),
            x,
            y: 0.0,
            yaw: 0.0,
            footprint: corners(x),
            orientation_kind: "facing".to_string(),
            depth_px: 2000,
            visible_px: 2000,
            unoccluded_px: 2500,
            range: 2.0,
        }
    }

    fn detection(category: &str, x: f64) -> Detection {
        let json = serde_json::json!({"category": category, "confidence": 1.0, "x": x, "y": 0.0, "yaw": 0.1,
            "length": 1.0, "width": 1.0, "height": 0.7, "footprint": corners(x), "why": ""});
        serde_json::from_value(json).expect("a detection")
    }

    #[test]
    fn a_desk_called_table_is_found_and_of_the_right_kind_but_misnamed() {
        let frame = GoldFrame {
            items: vec![item("desk", 0.0), item("bed", 5.0)],
            detections: vec![detection("table", 0.2), detection("lamp", 9.0)],
        };
        let scores = score_furniture(&[frame]);
        assert_eq!(scores.all.found, Rate { hit: 1, of: 2 });
        assert_eq!((scores.all.kind.hit, scores.all.name.hit, scores.extra), (1, 0, 1));
        assert!((scores.all.centre_m.0 - 0.2).abs() < 1e-9);
        assert_eq!(scores.confusion["bed"]["(not found)"], 1);
    }

    #[test]
    fn what_hardly_shows_is_not_asked_for() {
        let hidden = GoldItem { visible_px: 900, ..item("desk", 0.0) };
        let scores = score_furniture(&[GoldFrame { items: vec![hidden], detections: vec![detection("desk", 0.0)] }]);
        assert_eq!((scores.all.found.of, scores.extra), (0, 0));
    }
}
