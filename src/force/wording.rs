//! Where one word ends and the next begins: every threshold of the English descriptions, with its reason.
//!
//! Matsakis et al. (2001) give the form of the sentence (primary direction,
//! secondary direction, self-assessment) and some of its words, not the
//! numbers. Ours follow from one picture: an object that appears as a point
//! δ degrees off a direction has the degree of truth 1 − δ/90 there, and
//! sixteen named directions (Skubic et al. 2004) are 22.5° wide.
//!
//! | degree of truth | δ | reason |
//! |---|---|---|
//! | 0.95 | 4.5° | nearer to the axis than people can tell: "directly" |
//! | 0.875 | 11.25° | half a sixteenth: up to there the axis itself is the nearest name |
//! | 0.625 | 33.75° | one and a half sixteenths: up to there "mostly … but somewhat …" |
//! | 0.375 | 56.25° | from there to 0.625 two neighbours say as much: both are named |
//! | 0.125 | 78.75° | the least that a second direction of "somewhat" has at half a sixteenth |
//! | 0.06 | 84.6° | half of that: worth a "slightly" |
//!
//! Below 0.1 no direction is said at all: forces all round, or contradictory ones.

use super::DegreeOfTruth;

/// From here on the primary direction needs no qualification and gets an emphasis.
pub(super) const DIRECTLY: f64 = 0.95;
/// From here down to [`BOTH`] the primary direction is "mostly" when a second one is said.
pub(super) const PLAINLY: f64 = 0.875;
/// From here on the primary direction outweighs any second one.
pub(super) const MOSTLY: f64 = 0.625;
/// From here on a second direction is as good as the first.
pub(super) const BOTH: f64 = 0.375;
/// From here on a second direction is "somewhat" so.
pub(super) const SOMEWHAT: f64 = 0.125;
/// From here on a second direction is "slightly" so.
pub(super) const SLIGHTLY: f64 = 0.06;
/// Below this the best direction is none.
pub(super) const NO_DIRECTION: f64 = 0.1;

/// Openings of less than about a third of half a turn, over most levels: people say "surrounded".
pub(super) const SURROUNDED: f64 = 0.6;
/// Openings of at most half a turn over half the levels: "partly surrounded".
pub(super) const PARTLY_SURROUNDED: f64 = 0.3;
/// Nearly all of the area: what is left outside is the drawing's tolerance.
pub(super) const INSIDE: f64 = 0.95;
/// Both references are opposite within 36° of each other, in the picture above.
pub(super) const BETWEEN: f64 = 0.6;

/// How well the words do justice to the histograms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assessment {
    /// Hardly any force contradicts, and both opinions agree.
    Satisfactory,
    /// Some do, or the opinions differ.
    RatherSatisfactory,
    /// Most forces contradict each other.
    NotSatisfactory,
}

/// Contradicted by less than a third of the forces.
const FEW_CONTRADICT: f64 = 0.7;
/// Contradicted by more than half, with some margin for the four-way split of objects that interlock.
const MOST_CONTRADICT: f64 = 0.4;
/// Two opinions further apart than this (13.5° in the picture above) do not mean the same word.
const AGREE: f64 = 0.15;

impl Assessment {
    /// From what constant and hybrid forces think of the direction that was said.
    pub(super) fn of([whole, near]: [DegreeOfTruth; 2]) -> Self {
        let least = whole.b.min(near.b);
        if least >= FEW_CONTRADICT && (whole.a - near.a).abs() <= AGREE {
            Self::Satisfactory
        } else if least >= MOST_CONTRADICT {
            Self::RatherSatisfactory
        } else {
            Self::NotSatisfactory
        }
    }

    /// "satisfactory", "rather satisfactory" or "not satisfactory".
    pub fn phrase(self) -> &'static str {
        match self {
            Self::Satisfactory => "satisfactory",
            Self::RatherSatisfactory => "rather satisfactory",
            Self::NotSatisfactory => "not satisfactory",
        }
    }
}

/// How far apart two objects are, in diameters of the smaller one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Closeness {
    /// They share a point.
    Touching,
    /// The smaller one could not stand between them, not even a quarter of it.
    VeryClose,
    /// The smaller one could just not stand between them.
    Close,
    /// Neither close nor far: not worth a word.
    Near,
    /// Four of the smaller ones could stand between them.
    Far,
}

impl Closeness {
    /// From the gap in diameters of the smaller object.
    pub(super) fn of(relative_gap: f64) -> Self {
        match relative_gap {
            gap if gap <= 0.0 => Self::Touching,
            gap if gap < 0.25 => Self::VeryClose,
            gap if gap < 1.0 => Self::Close,
            gap if gap < 4.0 => Self::Near,
            _ => Self::Far,
        }
    }

    /// The class in a word or two.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Touching => "touching",
            Self::VeryClose => "very close",
            Self::Close => "close",
            Self::Near => "near",
            Self::Far => "far",
        }
    }

    /// What follows the directions in a sentence.
    pub(super) fn phrase(self) -> &'static str {
        match self {
            Self::Touching => ", touching it",
            Self::VeryClose => ", very close to it",
            Self::Close => ", close to it",
            Self::Near => "",
            Self::Far => ", far from it",
        }
    }
}
