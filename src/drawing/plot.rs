//! The way of one trial through the home, as in the paper's Fig. 6.

use std::fmt::Write;

use crate::escape::for_markup;
use crate::geometry::{Pose, Vec2, angle_between};

/// Pixels a metre.
const SCALE: f64 = 56.0;
/// Nearer to the point drawn before, a point of the way is not drawn, metres; nor a tick so near in heading, radians.
const SAME_POINT_M: f64 = 0.03;
const SAME_HEADING_RAD: f64 = 0.1;
/// Pixels around the rooms.
const MARGIN: f64 = 24.0;
/// Pixels above them, for the sentence.
const TITLE: f64 = 30.0;
/// Pixels below the scale, for what the signs mean.
const LEGEND: f64 = 26.0;
/// Characters a line of the title holds, for a metre of width.
const TITLE_CHARACTERS_PER_M: f64 = 7.4;

/// A labelled outline, metres.
#[derive(Clone, Debug)]
pub struct Outline {
    /// What is written in it.
    pub label: String,
    /// Its corners.
    pub corners: Vec<Vec2>,
    /// Whether the object was found on it.
    pub found: bool,
    /// Where its front points, radians, where it has one.
    pub front: Option<f64>,
    /// As which it was visited, counted from 1.
    pub visits: Vec<usize>,
}

/// What a plot shows.
#[derive(Clone, Debug, Default)]
pub struct Plot {
    /// The sentence.
    pub title: String,
    /// How it ended.
    pub caption: String,
    /// Names and middles of the rooms.
    pub rooms: Vec<(String, Vec2)>,
    /// The walls.
    pub walls: Vec<(Vec2, Vec2)>,
    /// The furniture.
    pub furniture: Vec<Outline>,
    /// Where the robot was, half a second apart.
    pub path: Vec<Pose>,
    /// Where the object was found.
    pub found_at: Option<Vec2>,
    /// What was looked for, and where it truly lies.
    pub sought: Vec<(String, Vec2)>,
}

struct Canvas {
    svg: String,
    low: Vec2,
    high: Vec2,
    top: f64,
}

impl Plot {
    /// The plot as an SVG document; the same plot gives the same bytes.
    pub fn to_svg(&self) -> String {
        let (low, high) = self.bounds();
        let per_line = ((high.x - low.x) * TITLE_CHARACTERS_PER_M).max(20.0) as usize;
        let title = wrapped(&self.title, per_line);
        let mut canvas = Canvas { svg: String::new(), low, high, top: MARGIN + TITLE + 20.0 * title.len() as f64 };
        canvas.open(&self.title);
        canvas.title(&title, &self.caption);
        for outline in &self.furniture {
            canvas.furniture(outline);
        }
        for (name, middle) in &self.rooms {
            canvas.text(*middle, &name.replace('_', " "), "room");
        }
        for (a, b) in &self.walls {
            canvas.line(*a, *b, "wall");
        }
        canvas.path(&self.path);
        for outline in self.furniture.iter().filter(|outline| !outline.visits.is_empty()) {
            canvas.visits(outline);
        }
        for (name, at) in &self.sought {
            canvas.object(*at, name, self.found_at.is_none());
        }
        if let Some(point) = self.found_at {
            canvas.star(point);
        }
        canvas.scale_bar();
        canvas.legend(self);
        canvas.svg.push_str("</svg>\n");
        canvas.svg
    }

    fn bounds(&self) -> (Vec2, Vec2) {
        let points = self.walls.iter().flat_map(|&(a, b)| [a, b]).chain(self.path.iter().map(|pose| pose.position()));
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let (low, high) = points.fold(start, |(low, high), p| (low.inf(&p), high.sup(&p)));
        if low.x.is_finite() { (low, high) } else { (Vec2::zeros(), Vec2::repeat(1.0)) }
    }
}

impl Canvas {
    fn put(&mut self, text: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.svg.write_fmt(text);
        self.svg.push('\n');
    }

    fn xy(&self, point: Vec2) -> (f64, f64) {
        let round = |v: f64| (v * 10.0).round() / 10.0 + 0.0;
        (round(MARGIN + (point.x - self.low.x) * SCALE), round(self.top + (self.high.y - point.y) * SCALE))
    }

    fn open(&mut self, title: &str) {
        let width = 2.0 * MARGIN + (self.high.x - self.low.x) * SCALE;
        let height = self.top + MARGIN + 20.0 + LEGEND + (self.high.y - self.low.y) * SCALE;
        self.put(format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0} {height:.0}" width="{width:.0}" height="{height:.0}" role="img" font-family="sans-serif">"#
        ));
        self.put(format_args!("<title>{}</title>", for_markup(title)));
        self.put(format_args!("<style>.wall{{stroke:#333;stroke-width:4;stroke-linecap:square}}.item{{fill:#e8dcc8;stroke:#8a7350;stroke-width:1.5}}.found{{fill:#cfe8cf;stroke:#2e7d32;stroke-width:2.5}}.path{{fill:none;stroke:#c2185b;stroke-width:2.2;stroke-linecap:round}}.tick{{stroke:#c2185b;stroke-width:1.1;opacity:.5}}.label{{font-size:12px;fill:#4a3c22;text-anchor:middle}}.room{{font-size:17px;fill:#b9bcc2;text-anchor:middle}}.title{{font-size:16px;fill:#111}}.caption{{font-size:13px;fill:#555}}.front{{stroke:#8a7350;stroke-width:4}}.visit{{fill:#c2185b}}.number{{font-size:11px;font-weight:bold;fill:#fff;text-anchor:middle}}.lay{{fill:none;stroke:#1565c0;stroke-width:2.5}}.object{{font-size:12px;fill:#1565c0}}</style>"));
        self.put(format_args!(r##"<rect width="100%" height="100%" fill="#fff"/>"##));
    }

    fn title(&mut self, lines: &[String], caption: &str) {
        for (i, line) in lines.iter().enumerate() {
            let y = MARGIN + 4.0 + 20.0 * i as f64;
            self.put(format_args!(r#"<text class="title" x="{MARGIN}" y="{y}">{}</text>"#, for_markup(line)));
        }
        let y = MARGIN + 4.0 + 20.0 * lines.len() as f64;
        self.put(format_args!(r#"<text class="caption" x="{MARGIN}" y="{y}">{}</text>"#, for_markup(caption)));
    }

    fn line(&mut self, a: Vec2, b: Vec2, class: &str) {
        let ((x1, y1), (x2, y2)) = (self.xy(a), self.xy(b));
        self.put(format_args!(r#"<line class="{class}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"/>"#));
    }

    fn text(&mut self, at: Vec2, text: &str, class: &str) {
        let (x, y) = self.xy(at);
        self.put(format_args!(r#"<text class="{class}" x="{x}" y="{:.1}">{}</text>"#, y + 4.0, for_markup(text)));
    }

    fn furniture(&mut self, outline: &Outline) {
        let points: Vec<String> =
            outline.corners.iter().map(|&c| self.xy(c)).map(|(x, y)| format!("{x},{y}")).collect();
        let class = if outline.found { "item found" } else { "item" };
        self.put(format_args!(r#"<polygon class="{class}" points="{}"/>"#, points.join(" ")));
        if let Some((a, b)) = outline.front.and_then(|heading| front_edge(&outline.corners, heading)) {
            self.line(a, b, "front");
        }
        let sum = outline.corners.iter().fold(Vec2::zeros(), |sum, corner| sum + corner);
        // Above the mark that shows where the object was found.
        let aside = if outline.found { Vec2::new(0.0, 0.28) } else { Vec2::zeros() };
        self.text(sum / outline.corners.len().max(1) as f64 + aside, &outline.label, "label");
    }

    /// The numbers of the visits to a piece, at its upper left corner.
    fn visits(&mut self, outline: &Outline) {
        let corner = outline.corners.iter().fold(Vec2::new(f64::INFINITY, f64::NEG_INFINITY), |corner, c| {
            Vec2::new(corner.x.min(c.x), corner.y.max(c.y))
        });
        for (i, visit) in outline.visits.iter().enumerate() {
            let (x, y) = self.xy(corner + Vec2::new(0.32 * i as f64, 0.0));
            self.badge(x, y, &visit.to_string());
        }
    }

    fn badge(&mut self, x: f64, y: f64, number: &str) {
        self.put(format_args!(r#"<circle class="visit" cx="{x}" cy="{y}" r="8"/>"#));
        self.put(format_args!(r#"<text class="number" x="{x}" y="{:.1}">{number}</text>"#, y + 4.0));
    }

    /// A ring where the object lies, with its name where the robot did not find it.
    fn object(&mut self, at: Vec2, name: &str, named: bool) {
        let (x, y) = self.xy(at);
        self.put(format_args!(r#"<circle class="lay" cx="{x}" cy="{y}" r="9"/>"#));
        if named {
            let name = for_markup(&name.replace('_', " "));
            self.put(format_args!(r#"<text class="object" x="{:.1}" y="{:.1}">{name}</text>"#, x + 12.0, y - 8.0));
        }
    }

    /// What the signs mean: those that this plot has.
    fn legend(&mut self, plot: &Plot) {
        let y = self.top + (self.high.y - self.low.y) * SCALE + 52.0;
        let ring = |x: f64| {
            format!(
                r##"<circle cx="{x}" cy="{y}" r="6" fill="#fff" stroke="#c2185b" stroke-width="2.5"/><line class="tick" style="opacity:1;stroke-width:2.5" x1="{}" y1="{y}" x2="{}" y2="{y}"/>"##,
                x + 6.0,
                x + 15.0
            )
        };
        let arrow = |x: f64| {
            format!(
                r##"<polygon points="{},{y} {},{} {},{}" fill="#c2185b"/>"##,
                x + 9.0,
                x - 6.0,
                y - 6.0,
                x - 6.0,
                y + 6.0
            )
        };
        let front = |x: f64| format!(r#"<line class="front" x1="{x}" y1="{}" x2="{x}" y2="{}"/>"#, y - 8.0, y + 8.0);
        let visit = |x: f64| {
            format!(
                r#"<circle class="visit" cx="{x}" cy="{y}" r="8"/><text class="number" x="{x}" y="{}">1</text>"#,
                y + 4.0
            )
        };
        let found =
            |x: f64| format!(r##"<circle cx="{x}" cy="{y}" r="7" fill="#2e7d32" stroke="#fff" stroke-width="2"/>"##);
        let lay = |x: f64| format!(r#"<circle class="lay" cx="{x}" cy="{y}" r="9"/>"#);
        let one = plot.sought.iter().all(|(name, _)| Some(name) == plot.sought.first().map(|(first, _)| first));
        let named =
            |name: &str| if one { format!("where the {} is", name.replace('_', " ")) } else { "objects".to_string() };
        let sought = plot.sought.first().map(|(name, _)| named(name));
        type Sign<'s> = (bool, &'s dyn Fn(f64) -> String, String);
        let signs: [Sign; 6] = [
            (!plot.path.is_empty(), &ring, "start and heading".to_string()),
            (plot.path.len() > 1, &arrow, "end".to_string()),
            (plot.furniture.iter().any(|o| o.front.is_some()), &front, "front of a piece".to_string()),
            (plot.furniture.iter().any(|o| !o.visits.is_empty()), &visit, "order of visits".to_string()),
            (plot.found_at.is_some(), &found, "found here".to_string()),
            (sought.is_some(), &lay, sought.unwrap_or_default()),
        ];
        let (mut x, most) = (MARGIN + 8.0, MARGIN + (self.high.x - self.low.x) * SCALE);
        for (_, sign, text) in signs.iter().filter(|(is_there, ..)| *is_there) {
            let width = 34.0 + 6.6 * text.chars().count() as f64;
            if x + width > most.max(MARGIN + 9.0 + width) {
                break;
            }
            self.put(format_args!("{}", sign(x)));
            self.put(format_args!(
                r#"<text class="caption" x="{:.1}" y="{:.1}">{}</text>"#,
                x + 18.0,
                y + 4.0,
                for_markup(text)
            ));
            x += width;
        }
    }

    /// A line, with ticks for the heading two seconds apart, a ring with its heading at the start and an arrow at the end.
    fn path(&mut self, path: &[Pose]) {
        // What stands or turns in place adds nothing to the line.
        let way = moved(path.iter(), |a, b| a.distance_to(b.position()) >= SAME_POINT_M);
        let points = way.into_iter().map(|pose| self.xy(pose.position())).map(|(x, y)| format!("{x},{y}"));
        let points: Vec<String> = points.collect();
        self.put(format_args!(r#"<polyline class="path" points="{}"/>"#, points.join(" ")));
        let is_other_tick = |a: &Pose, b: &Pose| {
            a.distance_to(b.position()) >= SAME_POINT_M || angle_between(a.heading, b.heading) >= SAME_HEADING_RAD
        };
        for pose in moved(path.iter().step_by(4), is_other_tick) {
            self.line(pose.position(), pose.position() + pose.forward() * 0.18, "tick");
        }
        if let (Some(first), Some(last)) = (path.first(), path.last()) {
            let (x, y) = self.xy(first.position());
            let (tip_x, tip_y) = self.xy(first.position() + first.forward() * 0.32);
            self.put(format_args!(
                r##"<line x1="{x}" y1="{y}" x2="{tip_x}" y2="{tip_y}" stroke="#c2185b" stroke-width="2.5"/>"##
            ));
            self.put(format_args!(
                r##"<circle cx="{x}" cy="{y}" r="6" fill="#fff" stroke="#c2185b" stroke-width="2.5"/>"##
            ));
            if path.len() < 2 {
                return;
            }
            let tip = |along: f64, across: f64| self.xy(last.to_world(Vec2::new(along, across)));
            let [(ax, ay), (bx, by), (cx, cy)] = [tip(0.3, 0.0), tip(-0.2, 0.2), tip(-0.2, -0.2)];
            self.put(format_args!(r##"<polygon points="{ax},{ay} {bx},{by} {cx},{cy}" fill="#c2185b"/>"##));
        }
    }

    fn star(&mut self, point: Vec2) {
        let (x, y) = self.xy(point);
        self.put(format_args!(r##"<circle cx="{x}" cy="{y}" r="7" fill="#2e7d32" stroke="#fff" stroke-width="2"/>"##));
    }

    fn scale_bar(&mut self) {
        let y = self.top + (self.high.y - self.low.y) * SCALE + 26.0;
        let end = MARGIN + SCALE;
        self.put(format_args!(
            r##"<line x1="{MARGIN}" y1="{y}" x2="{end}" y2="{y}" stroke="#555" stroke-width="3"/>"##
        ));
        self.put(format_args!(r#"<text class="caption" x="{}" y="{}">1 m</text>"#, end + 8.0, y + 4.0));
    }
}

/// The side of an outline that lies farthest in the direction of its front.
fn front_edge(corners: &[Vec2], heading: f64) -> Option<(Vec2, Vec2)> {
    let ahead = Vec2::new(heading.cos(), heading.sin());
    let edges = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
    edges.max_by(|(a, b), (c, d)| (a + b).dot(&ahead).total_cmp(&(c + d).dot(&ahead)))
}

fn wrapped(text: &str, per_line: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + word.chars().count() >= per_line {
            lines.push(word.to_string());
        } else {
            if !lines[last].is_empty() {
                lines[last].push(' ');
            }
            lines[last].push_str(word);
        }
    }
    lines
}

/// The poses that differ from the one kept before, with the last.
fn moved<'p>(poses: impl Iterator<Item = &'p Pose>, differs: impl Fn(&Pose, &Pose) -> bool) -> Vec<&'p Pose> {
    let poses: Vec<&Pose> = poses.collect();
    let mut kept: Vec<&Pose> = Vec::new();
    for (at, pose) in poses.iter().enumerate() {
        if at + 1 == poses.len() || kept.last().is_none_or(|last| differs(last, pose)) {
            kept.push(pose);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_cannot_break_the_picture() {
        let plot = Plot { title: "a <b> & \"c\" \u{7}".to_string(), ..Plot::default() };
        let svg = plot.to_svg();
        assert!(svg.contains("a &lt;b&gt; &amp; &quot;c&quot;") && !svg.contains('\u{7}'));
    }

    #[test]
    fn a_plot_says_what_its_signs_mean_and_only_of_those_it_has() {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let piece = Outline { label: "chair 1".to_string(), corners, found: false, front: Some(0.0), visits: vec![2] };
        let walls = vec![(Vec2::zeros(), Vec2::new(14.0, 9.0))];
        let sought = vec![("glasses_case".to_string(), Vec2::new(3.0, 3.0))];
        let plot = Plot { furniture: vec![piece], walls, sought, path: vec![Pose::default()], ..Plot::default() };
        let svg = plot.to_svg();
        for sign in
            ["start and heading", "front of a piece", "order of visits", "where the glasses case is", ">2</text>"]
        {
            assert!(svg.contains(sign), "{sign}: {svg}");
        }
        assert!(!svg.contains("found here"));
    }

    #[test]
    fn the_front_is_the_edge_that_the_piece_faces_with() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        let (a, b) = front_edge(&corners, std::f64::consts::FRAC_PI_2).expect("an edge");
        assert_eq!((a.y, b.y), (1.0, 1.0));
    }

    #[test]
    fn long_sentences_are_wrapped_between_words() {
        assert_eq!(wrapped("one two three four", 9), ["one two", "three", "four"]);
    }
}
