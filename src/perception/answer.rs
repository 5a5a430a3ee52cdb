//! What a detector of one's own answers for a frame: furniture on the floor, or boxes in the picture.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::record::Detection;

/// An answer; other keys are the detector's own.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct Answer {
    /// Furniture with its place in the room.
    #[serde(default)]
    pub detections: Option<Vec<Detection>>,
    /// Furniture with its place in the picture, which the depth tells the rest of.
    #[serde(default)]
    pub boxes: Option<Vec<PictureBox>>,
    /// The number of the frame it answers, where it says so.
    #[serde(default)]
    pub number: Option<u64>,
}

/// A piece where it shows in the picture.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct PictureBox {
    /// What it is: a category, or what COCO or LVIS call one; what is no furniture is passed over.
    pub category: String,
    /// How sure that is, 0 to 1.
    pub confidence: f64,
    /// Left, top, right, bottom, pixels.
    #[serde(rename = "box")]
    pub sides: [f64; 4],
    /// Which of the picture's pixels it covers.
    #[serde(default)]
    pub mask: Option<Mask>,
}

/// Pixels by run lengths, as COCO writes them: down each column, from the left; first those that are not covered.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Mask {
    /// Lengths of the runs.
    pub counts: Vec<u32>,
}

impl Mask {
    /// Whether each pixel is covered, row by row.
    pub(super) fn covered(&self, width: usize, height: usize) -> Vec<bool> {
        let mut covered = vec![false; width * height];
        let (mut at, mut is_on) = (0_usize, false);
        for count in &self.counts {
            let end = at.saturating_add(*count as usize).min(width * height);
            if is_on {
                (at..end).for_each(|i| covered[i % height * width + i / height] = true);
            }
            (at, is_on) = (end, !is_on);
        }
        covered
    }
}

impl Answer {
    /// Checks the numbers, and fills in what may be left out.
    ///
    /// # Errors
    /// Names the place and what is wrong with it.
    pub(super) fn checked(mut self) -> Result<Self, String> {
        if self.detections.is_none() && self.boxes.is_none() {
            return Err("neither `detections` nor `boxes`".to_string());
        }
        for (i, piece) in self.detections.iter_mut().flatten().enumerate() {
            check(piece).map_err(|what| format!("`detections[{i}]` {what}"))?;
            if piece.scores.is_empty() {
                piece.scores = BTreeMap::from([(piece.category.clone(), 1.0)]);
            }
        }
        for (i, seen) in self.boxes.iter().flatten().enumerate() {
            let [left, top, right, bottom] = seen.sides;
            let is_box = seen.sides.iter().all(|v| v.is_finite()) && left < right && top < bottom;
            let shape = is_box.then_some(()).ok_or("has a `box` that is not left, top, right, bottom in pixels");
            let sound = shape.map_err(str::to_string).and_then(|()| check_chance(seen.confidence));
            sound.map_err(|what| format!("`boxes[{i}]` {what}"))?;
        }
        Ok(self)
    }
}

fn check(piece: &Detection) -> Result<(), String> {
    check_chance(piece.confidence)?;
    if piece.category.is_empty() {
        return Err("has no `category`".to_string());
    }
    let numbers = [piece.x, piece.y, piece.length, piece.width, piece.height, piece.yaw.unwrap_or(0.0)];
    if !numbers.iter().chain(piece.footprint.iter().flatten()).all(|v| v.is_finite()) {
        return Err("holds something that is not a number".to_string());
    }
    if piece.footprint.len() < 3 || piece.length < 0.0 || piece.width < 0.0 || piece.height < 0.0 {
        return Err("needs a `footprint` of three corners or more, and sizes in metres".to_string());
    }
    Ok(())
}

fn check_chance(confidence: f64) -> Result<(), String> {
    let sound = (0.0..=1.0).contains(&confidence);
    sound.then_some(()).ok_or_else(|| format!("has a `confidence` of {confidence}; it must be from 0 to 1"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(text: &str) -> Result<Answer, String> {
        serde_json::from_str::<Answer>(text).expect("JSON").checked()
    }

    #[test]
    fn what_is_wrong_with_an_answer_is_told_with_its_place() {
        let sure = checked(r#"{"boxes":[{"category":"chair","confidence":80,"box":[1,2,3,4]}]}"#);
        assert_eq!(sure.expect_err("80"), "`boxes[0]` has a `confidence` of 80; it must be from 0 to 1");
        let turned = checked(r#"{"boxes":[{"category":"chair","confidence":0.8,"box":[3,2,1,4]}]}"#);
        assert!(turned.expect_err("turned").contains("left, top, right, bottom"));
        assert!(checked("{}").expect_err("empty").contains("neither"));
        let line = r#"{"detections":[{"category":"bed","confidence":0.5,"x":1,"y":2,"yaw":null,"length":2,"width":1,"height":0.5,"footprint":[[0,0],[1,0]]}]}"#;
        assert!(checked(line).expect_err("a line").contains("`detections[0]` needs a `footprint`"));
    }

    #[test]
    fn a_mask_runs_down_the_columns() {
        let mask = Mask { counts: vec![1, 2, 9] };
        assert_eq!(mask.covered(2, 2), [false, true, true, false]);
    }
}
