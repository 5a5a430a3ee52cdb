//! A piece in words: its attributes, and what decided.

use super::footprint::Footprint;
use super::measures::{Measured, Measures};
use crate::catalogue;

/// Attributes and reasons.
pub fn describe(measured: &Measured, category: &str, whole: &Footprint) -> (Vec<String>, String) {
    let m = &measured.measures;
    (attributes(m, category, whole), why(m, whole))
}

fn attributes(m: &Measures, category: &str, whole: &Footprint) -> Vec<String> {
    let (long, short) = (whole.length.max(whole.width), whole.length.min(whole.width));
    let mut words = vec![color_word(m.color)];
    let may = catalogue::category(category).map(|row| row.looks).unwrap_or_default();
    if may.round && m.rectangularity < 0.86 && long < 1.25 * short {
        words.push("round");
    }
    match () {
        () if may.long && long > 2.0 * short => words.push("long"),
        () if may.small && long * short < 0.4 => words.push("small"),
        () if may.tall && m.height > 1.4 => words.push("tall"),
        () => {}
    }
    words.into_iter().map(str::to_string).collect()
}

/// The nearest of the colours people name, by hue where there is one.
pub fn color_word([r, g, b]: [f64; 3]) -> &'static str {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let saturation = if most > 0.0 { (most - least) / most } else { 0.0 };
    if most < 0.2 {
        return "black";
    }
    if saturation < 0.15 {
        return if most > 0.72 { "white" } else { "gray" };
    }
    let hue = match () {
        () if most == r => 60.0 * ((g - b) / (most - least)).rem_euclid(6.0),
        () if most == g => 60.0 * ((b - r) / (most - least) + 2.0),
        () => 60.0 * ((r - g) / (most - least) + 4.0),
    };
    let dark_wood = most < 0.45 && saturation < 0.7;
    match hue {
        h if h < 14.0 && dark_wood => "brown",
        h if h < 14.0 => "red",
        h if h < 45.0 && saturation > 0.75 && most > 0.75 => "orange",
        h if h < 45.0 || (h < 70.0 && saturation < 0.4) => "brown",
        h if h < 70.0 => "yellow",
        h if h < 165.0 => "green",
        h if h < 260.0 => "blue",
        h if h < 330.0 => "purple",
        _ => "red",
    }
}

fn why(m: &Measures, whole: &Footprint) -> String {
    let mut reasons = vec![format!("top plate {:.2} m high over {:.0} % of it", m.plate, 100.0 * m.plate_share)];
    reasons.push(format!("{:.2} × {:.2} m seen, {:.2} m high", m.long, m.short, m.height));
    reasons.push(if m.above_share > 0.06 {
        format!("{:.0} % of it rises above the plate", 100.0 * m.above_share)
    } else {
        "nothing rises above the plate".to_string()
    });
    reasons.push(if m.filled > 0.6 { "closed below" } else { "open below" }.to_string());
    if m.wall < 0.15 {
        reasons.push("at the wall".to_string());
    }
    if m.cut > 0.03 {
        reasons.push("cut by the picture's edge".to_string());
    }
    let grown = whole.length * whole.width > 1.1 * m.long * m.short;
    if grown {
        reasons.push(format!("completed to {:.2} × {:.2} m", whole.length, whole.width));
    }
    reasons.join(", ")
}

#[cfg(test)]
mod tests {
    use super::color_word;

    #[test]
    fn colours_are_called_what_people_call_them() {
        let wood = color_word([0.59, 0.41, 0.25]);
        assert_eq!((wood, color_word([0.9, 0.9, 0.88]), color_word([0.1, 0.1, 0.12])), ("brown", "white", "black"));
        assert_eq!((color_word([0.9, 0.05, 0.05]), color_word([0.2, 0.3, 0.7])), ("red", "blue"));
    }
}
