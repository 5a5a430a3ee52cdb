//! Frames whose furniture is known, and the records that say what was seen in them.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::record::Detection;

/// An item as a gold frame names it; lengths in metres, angles in radians.
#[derive(Clone, Debug, Deserialize)]
pub struct GoldItem {
    /// Which item of the scene it is.
    #[serde(default)]
    pub id: Option<usize>,
    /// What it is.
    pub category: String,
    /// Its middle.
    pub x: f64,
    /// Its middle.
    pub y: f64,
    /// Heading of its front.
    #[serde(default)]
    pub yaw: f64,
    /// Its corners on the floor.
    #[serde(default)]
    pub footprint: Vec<[f64; 2]>,
    /// `facing` when it has a front.
    #[serde(default)]
    pub orientation_kind: String,
    /// Pixels that show with depth.
    #[serde(default)]
    pub depth_px: usize,
    /// Pixels that show.
    #[serde(default)]
    pub visible_px: usize,
    /// Pixels that would show if nothing stood before it.
    #[serde(default)]
    pub unoccluded_px: usize,
    /// Metres from the camera.
    #[serde(default)]
    pub range: f64,
}

impl GoldItem {
    /// Whether enough of it shows to be asked for.
    pub fn is_scored(&self) -> bool {
        self.depth_px > 1500 && 2 * self.visible_px > self.unoccluded_px && self.range < 6.0
    }
}

/// One frame, or one room of fused frames: what is there and what was seen.
#[derive(Clone, Debug)]
pub struct GoldFrame {
    /// The items.
    pub items: Vec<GoldItem>,
    /// The detections.
    pub detections: Vec<Detection>,
}

/// A gold line.
#[derive(Deserialize)]
struct GoldLine {
    frame: String,
    #[serde(default)]
    subset: Option<String>,
    #[serde(default)]
    items: Vec<GoldItem>,
}

/// A record of `perceive`: one frame's, or that of the fused frames it names.
#[derive(Deserialize)]
struct SeenLine {
    frame: Option<String>,
    #[serde(default)]
    frames: Vec<String>,
    detections: Vec<Detection>,
}

/// Gold and what was seen, frame by frame; fused records are held against all that their frames show.
///
/// A frame without a record counts as one in which nothing was seen.
///
/// # Errors
/// When a line is no gold frame or no record, with its number.
pub fn gold_frames(gold: &[String], records: &[String], subset: Option<&str>) -> Result<Vec<GoldFrame>, String> {
    let mut known = BTreeMap::new();
    for (number, line) in (1..).zip(gold) {
        let parsed: GoldLine = serde_json::from_str(line).map_err(|e| format!("gold line {number}: {e}"))?;
        if subset.is_none_or(|subset| parsed.subset.as_deref() == Some(subset)) {
            known.insert(parsed.frame, parsed.items);
        }
    }
    let mut frames = Vec::new();
    for (number, line) in (1..).zip(records) {
        let what = "; it is what `perceive` writes";
        let seen: SeenLine = serde_json::from_str(line).map_err(|e| format!("record {number}: {e}{what}"))?;
        let names: Vec<String> = seen.frame.into_iter().chain(seen.frames).collect();
        let items: Vec<Vec<GoldItem>> = names.iter().filter_map(|name| known.remove(name)).collect();
        if !items.is_empty() {
            frames.push(GoldFrame { items: merged(items), detections: seen.detections });
        }
    }
    frames.extend(known.into_values().map(|items| GoldFrame { items, detections: Vec::new() }));
    Ok(frames)
}

/// The items of several frames of one scene: each once, as the frame shows it that shows most of it.
fn merged(frames: Vec<Vec<GoldItem>>) -> Vec<GoldItem> {
    let mut all: Vec<GoldItem> = Vec::new();
    for item in frames.into_iter().flatten() {
        let same = |other: &&mut GoldItem| {
            other.category == item.category && (other.x - item.x).abs() < 1e-6 && (other.y - item.y).abs() < 1e-6
        };
        match all.iter_mut().find(same) {
            Some(known) if known.is_scored() || !item.is_scored() => {}
            Some(known) => *known = item,
            None => all.push(item),
        }
    }
    all
}
