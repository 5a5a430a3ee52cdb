//! Several views of one room made into one: what stands where, as all of them together tell.
//!
//! Detections are associated by footprint, never by label: gating on a label
//! that flickers would double the furniture. Class posteriors multiply, boxes
//! are averaged.

use std::collections::BTreeMap;

use super::detector::{overlap, rounded};
use crate::geometry::{Polygon, Pose, Vec2, vec2, wrap_angle};
use crate::record::Detection;

/// Views of one thing are not independent: each counts this much of a whole one.
const INDEPENDENCE: f64 = 0.7;
/// What no view has named is still this likely.
const UNNAMED: f64 = 0.01;
/// Share of the smaller footprint that must be common to both.
const LEAST_SHARED: f64 = 0.45;
/// Things of very different height are not one, metres.
const MOST_HEIGHT_M: f64 = 0.6;

/// The furniture of a room as many views show it.
#[derive(Clone, Debug, Default)]
pub struct FurnitureMap {
    tracks: Vec<Track>,
    /// Frames so far.
    frames: usize,
}

/// One piece, and every view of it.
#[derive(Clone, Debug)]
struct Track {
    views: Vec<View>,
}

/// What one frame shows of a piece.
#[derive(Clone, Debug)]
struct View {
    frame: usize,
    seen: Detection,
}

impl FurnitureMap {
    /// Adds what one frame shows; all detections must be in the same world.
    pub fn add(&mut self, furniture: &[Detection]) {
        let known = self.tracks.len();
        let fused: Vec<Detection> = self.tracks.iter().map(Track::fused).collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, detection) in furniture.iter().enumerate() {
            let one = fused.iter().enumerate().filter(|(_, track)| shared(track, detection) > LEAST_SHARED);
            pairs.extend(one.map(|(j, track)| (likeness(track, detection), i, j)));
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut taken = vec![false; furniture.len()];
        let mut matched = vec![false; known];
        for (_, i, j) in pairs {
            if !taken[i] && !matched[j] {
                (taken[i], matched[j]) = (true, true);
                self.tracks[j].views.push(View { frame: self.frames, seen: furniture[i].clone() });
            }
        }
        let fresh = furniture.iter().zip(&taken).filter(|(_, taken)| !**taken);
        let begun = fresh.map(|(seen, _)| Track { views: vec![View { frame: self.frames, seen: seen.clone() }] });
        self.tracks.extend(begun);
        self.frames += 1;
    }

    /// What stands in the room, the surest first.
    pub fn furniture(&self) -> Vec<Detection> {
        let mut joined = self.clone();
        joined.join_doubles();
        let mut furniture: Vec<Detection> = joined.tracks.iter().map(Track::fused).collect();
        furniture.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
        furniture
    }

    /// Two tracks that began apart and grew into one another are one, unless one frame showed both, one on the other:
    /// a lamp on its table.
    fn join_doubles(&mut self) {
        let mut first = 0;
        while first < self.tracks.len() {
            let mine = self.tracks[first].fused();
            let rest = first + 1..self.tracks.len();
            let double = rest.into_iter().find(|other| {
                let (other, their) = (&self.tracks[*other], self.tracks[*other].fused());
                shared(&mine, &their) > 0.6 && !(is_on(&mine, &their) && self.tracks[first].was_seen_with(other))
            });
            match double {
                Some(other) => {
                    let gone = self.tracks.remove(other);
                    self.tracks[first].views.extend(gone.views);
                }
                None => first += 1,
            }
        }
    }
}

impl Track {
    fn was_seen_with(&self, other: &Self) -> bool {
        self.views.iter().any(|view| other.views.iter().any(|theirs| theirs.frame == view.frame))
    }

    fn seen(&self) -> impl Iterator<Item = &Detection> {
        self.views.iter().map(|view| &view.seen)
    }

    fn fused(&self) -> Detection {
        let scores = self.scores();
        let best = scores.iter().fold(("", 0.0), |best, (name, p)| if *p > best.1 { (name, *p) } else { best });
        let first = &self.views[0].seen;
        let surest = self.seen().fold(first, |s, view| if view.confidence > s.confidence { view } else { s });
        // The surest view of the category that won tells how it stands.
        let of_best = self.seen().filter(|view| view.category == best.0);
        let model = of_best.fold(None::<&Detection>, |s, v| s.filter(|s| s.confidence >= v.confidence).or(Some(v)));
        let model = model.unwrap_or(surest);
        let missed = self.seen().map(|view| 1.0 - view.confidence).product::<f64>();
        let (pose, [length, width, height]) = self.average(model, best.0);
        let mut fused = Detection {
            category: best.0.to_string(),
            confidence: best.1 * (1.0 - missed),
            x: pose.x,
            y: pose.y,
            yaw: model.yaw.map(|_| pose.heading),
            length,
            width,
            height,
            footprint: Polygon::rectangle(pose, length, width).corners().iter().map(|c| [c.x, c.y]).collect(),
            attributes: model.attributes.clone(),
            why: if self.views.len() > 1 {
                format!("{} views; {}", self.views.len(), model.why)
            } else {
                model.why.clone()
            },
            scores: BTreeMap::new(),
        };
        fused.scores = scores.into_iter().filter(|(_, p)| *p >= 0.02).collect();
        rounded(fused)
    }

    /// The product of the views' posteriors, each weighed by how sure it is that there is furniture at all.
    fn scores(&self) -> BTreeMap<String, f64> {
        let names: Vec<&String> = self.seen().flat_map(|view| view.scores.keys()).collect();
        let mut logs: BTreeMap<String, f64> = names.into_iter().map(|name| (name.clone(), 0.0)).collect();
        for (name, log) in &mut logs {
            let chance = |view: &Detection| view.scores.get(name).copied().unwrap_or(0.0).max(UNNAMED);
            let power = if self.views.len() > 1 { INDEPENDENCE } else { 1.0 };
            *log = self.seen().map(|view| chance(view).ln() * power).sum();
        }
        let most = logs.values().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = logs.values().map(|log| (log - most).exp()).sum();
        logs.into_iter().map(|(name, log)| (name, (log - most).exp() / sum)).collect()
    }

    /// The mean box of the views that stand as the model does, the surer ones counting more.
    fn average(&self, model: &Detection, category: &str) -> (Pose, [f64; 3]) {
        let heading = heading(model);
        let (mut middle, mut sides, mut total) = (Vec2::zeros(), [0.0; 3], 0.0);
        let (mut sin, mut cos) = (0.0, 0.0);
        for view in self.seen() {
            let turn = self::heading(view) - heading;
            let quarter = (turn / std::f64::consts::FRAC_PI_2).round();
            let off = wrap_angle(turn - quarter * std::f64::consts::FRAC_PI_2);
            if off.abs() > 0.3 {
                continue;
            }
            // A box is completed to what the view takes the piece for.
            let agrees = view.scores.get(category).copied().unwrap_or(0.0);
            let weight = (view.confidence * agrees).powi(2).max(1e-6);
            let (length, width) =
                if quarter.rem_euclid(2.0) == 0.0 { (view.length, view.width) } else { (view.width, view.length) };
            middle += vec2(view.x, view.y) * weight;
            [length, width, view.height].iter().zip(&mut sides).for_each(|(v, s)| *s += v * weight);
            (sin, cos) = (sin + off.sin() * weight, cos + off.cos() * weight);
            total += weight;
        }
        let middle = middle / total;
        let heading = wrap_angle(heading + sin.atan2(cos));
        (Pose::new(middle.x, middle.y, heading), sides.map(|side| side / total))
    }
}

/// The heading of the length, where there is no front too.
fn heading(detection: &Detection) -> f64 {
    detection.yaw.unwrap_or_else(|| match detection.footprint.as_slice() {
        [a, b, ..] if detection.footprint.len() == 4 => (b[1] - a[1]).atan2(b[0] - a[0]),
        _ => 0.0,
    })
}

/// How well two that may be one agree in footprint and height.
fn likeness(a: &Detection, b: &Detection) -> f64 {
    overlap(a, b) + 0.5 * (1.0 - (a.height - b.height).abs() / MOST_HEIGHT_M)
}

/// Whether one may stand on the other: it is much smaller.
fn is_on(a: &Detection, b: &Detection) -> bool {
    let (a, b) = (a.length * a.width, b.length * b.width);
    a.min(b) < 0.4 * a.max(b)
}

/// Share of the smaller footprint that lies in both, zero for things of very different height.
fn shared(a: &Detection, b: &Detection) -> f64 {
    if (a.height - b.height).abs() > MOST_HEIGHT_M || a.footprint.len() < 3 || b.footprint.len() < 3 {
        return 0.0;
    }
    let polygon = |d: &Detection| Polygon::new(d.footprint.iter().map(|c| vec2(c[0], c[1])).collect());
    let (a, b) = (polygon(a), polygon(b));
    let overlap = a.overlap(&b);
    let common = overlap * (a.area() + b.area()) / (1.0 + overlap);
    common / a.area().min(b.area()).max(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(category: &str, confidence: f64, other: &str, x: f64) -> Detection {
        let pose = Pose::new(x, 1.0, 0.0);
        Detection {
            category: category.to_string(),
            confidence,
            scores: BTreeMap::from([(category.to_string(), confidence), (other.to_string(), 1.0 - confidence)]),
            x,
            y: 1.0,
            yaw: Some(0.0),
            length: 0.8,
            width: 1.2,
            height: 0.74,
            footprint: Polygon::rectangle(pose, 0.8, 1.2).corners().iter().map(|c| [c.x, c.y]).collect(),
            attributes: Vec::new(),
            why: String::new(),
        }
    }

    #[test]
    fn a_label_that_flickers_makes_no_second_piece() {
        let mut map = FurnitureMap::default();
        for view in
            [seen("table", 0.6, "desk", 2.0), seen("desk", 0.55, "table", 2.05), seen("table", 0.7, "desk", 1.95)]
        {
            map.add(&[view]);
        }
        let furniture = map.furniture();
        assert_eq!(furniture.len(), 1);
        assert_eq!(furniture[0].category, "table");
        assert!((furniture[0].x - 2.0).abs() < 0.03 && furniture[0].why.starts_with("3 views"));
    }

    #[test]
    fn pieces_beside_each_other_stay_two() {
        let mut map = FurnitureMap::default();
        map.add(&[seen("table", 0.8, "desk", 0.0), seen("table", 0.8, "desk", 0.9)]);
        map.add(&[seen("table", 0.8, "desk", 0.05), seen("table", 0.8, "desk", 0.95)]);
        assert_eq!(map.furniture().len(), 2);
    }

    #[test]
    fn a_lamp_stays_apart_from_the_nightstand_it_stands_on() {
        let lamp = |x: f64| Detection { height: 1.1, ..small(seen("lamp", 0.7, "chair", x), 0.2) };
        let stand = |x: f64| small(seen("nightstand", 0.8, "stool", x), 0.5);
        let mut map = FurnitureMap::default();
        map.add(&[stand(0.0), lamp(0.05)]);
        map.add(&[lamp(0.04), stand(0.02)]);
        let categories: Vec<String> = map.furniture().into_iter().map(|piece| piece.category).collect();
        assert_eq!(categories, ["nightstand", "lamp"]);
    }

    fn small(detection: Detection, side: f64) -> Detection {
        let pose = Pose::new(detection.x, detection.y, 0.0);
        let footprint = Polygon::rectangle(pose, side, side).corners().iter().map(|c| [c.x, c.y]).collect();
        Detection { length: side, width: side, footprint, ..detection }
    }
}
