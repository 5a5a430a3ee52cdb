//! A relative position in one English sentence.
//!
//! The form is that of Matsakis et al. (2001): a primary direction with a
//! hedge, a secondary one if it matters, and the describer's assessment of its
//! own words; between them the distance. Surrounding and containing come before
//! directions. Thresholds and their reasons are in `wording`.

use super::wording::{
    Assessment, BETWEEN, BOTH, Closeness, DIRECTLY, INSIDE, MOSTLY, NO_DIRECTION, PARTLY_SURROUNDED, PLAINLY, SLIGHTLY,
    SOMEWHAT, SURROUNDED,
};
use super::{Axes, DegreeOfTruth, RelativePosition};

/// What can be said about where one object is of another.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The degrees of the frame's four directions, in its order.
    pub degrees: [DegreeOfTruth; 4],
    /// The direction said first, as an index into the frame's four; nothing where no direction is.
    pub primary: Option<usize>,
    /// The direction said second.
    pub secondary: Option<usize>,
    /// How far apart.
    pub closeness: Closeness,
    /// How well the words fit.
    pub assessment: Assessment,
    axes: Axes,
    around: Around,
}

/// What takes precedence over directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Around {
    Nothing,
    Inside,
    Contains,
    Surrounded { wholly: bool },
    Surrounds { wholly: bool },
}

impl Description {
    /// Describes a relation in the words of a frame of reference.
    ///
    /// ```
    /// use spatial_fetch::force::{Axes, Description, RelativePosition, Shape};
    /// let box_at = |x: f64, y: f64| Shape::from_ring(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]);
    /// let relation = RelativePosition::between(&box_at(0.3, 3.0), &box_at(0.0, 0.0));
    /// let description = Description::of(&relation, Axes::Body { heading: -std::f64::consts::FRAC_PI_2 });
    /// assert_eq!(
    ///     description.sentence("the table", "the couch"),
    ///     "The table is behind the couch and slightly to the left; the description is satisfactory."
    /// );
    /// ```
    pub fn of(relation: &RelativePosition, axes: Axes) -> Self {
        let angles = axes.angles();
        let degrees = relation.degrees(angles);
        let best = (0..4).fold(0, |best, i| if degrees[i].a > degrees[best].a { i } else { best });
        let primary = (degrees[best].a >= NO_DIRECTION).then_some(best);
        let [one, other] = [(best + 1) % 4, (best + 3) % 4];
        let second = if degrees[one].a >= degrees[other].a { one } else { other };
        let secondary = primary.and((degrees[second].a >= SLIGHTLY).then_some(second));
        Self {
            primary,
            secondary,
            closeness: Closeness::of(relation.relative_distance()),
            assessment: Assessment::of(relation.opinions(angles[best])),
            around: around(relation),
            degrees,
            axes,
        }
    }

    /// The description as a sentence about two names, which bring their own articles.
    pub fn sentence(&self, a: &str, b: &str) -> String {
        capitalized(self.statement(a, b))
    }

    /// The sentence for an object that lies between two others to the degree `between`: that it does, where it does.
    pub(super) fn sentence_of_three(&self, between: f64, [a, b, c]: [&str; 3]) -> String {
        if between < BETWEEN {
            return self.sentence(a, b);
        }
        let hedge = if between >= PLAINLY { "" } else { "more or less " };
        capitalized(format!("{a} is {hedge}between {b} and {c}."))
    }

    fn statement(&self, a: &str, b: &str) -> String {
        let partly = |wholly: bool| if wholly { "" } else { "partly " };
        match self.around {
            Around::Inside => return format!("{a} is inside {b}."),
            Around::Contains => return format!("{a} contains {b}."),
            Around::Surrounded { wholly: true } => return format!("{a} is surrounded by {b}."),
            Around::Surrounds { wholly: true } => return format!("{a} surrounds {b}."),
            _ => {}
        }
        let Some(place) = self.place(b) else {
            return match self.closeness {
                Closeness::Touching => format!("{a} and {b} lie in one place; no direction can be said."),
                _ => format!("{a} lies on several sides of {b}; no direction can be said."),
            };
        };
        let around = match self.around {
            Around::Surrounded { wholly } => format!(", {}surrounded by it", partly(wholly)),
            Around::Surrounds { wholly } => format!(", {}surrounding it", partly(wholly)),
            _ => String::new(),
        };
        let (closeness, assessment) = (self.closeness.phrase(), self.assessment.phrase());
        format!("{a} is {place}{around}{closeness}; the description is {assessment}.")
    }

    /// The directions: "mostly behind the couch but somewhat to the left".
    fn place(&self, b: &str) -> Option<String> {
        let words = self.axes.directions();
        let first = self.primary?;
        let (degree, preposition) = (self.degrees[first].a, words[first].preposition);
        let Some(second) = self.secondary else {
            let hedge = if degree >= DIRECTLY {
                "directly "
            } else if degree >= MOSTLY {
                ""
            } else {
                "loosely "
            };
            return Some(format!("{hedge}{preposition} {b}"));
        };
        let (also, addition) = (self.degrees[second].a, words[second].adverb);
        Some(if also >= BOTH {
            format!("{preposition} {b} and as much {addition}")
        } else if also >= SOMEWHAT {
            let hedge = if degree >= PLAINLY {
                ""
            } else if degree >= BOTH {
                "mostly "
            } else {
                "loosely "
            };
            format!("{hedge}{preposition} {b} but somewhat {addition}")
        } else {
            format!("{preposition} {b} and slightly {addition}")
        })
    }
}

fn capitalized(mut text: String) -> String {
    if let Some(first) = text.chars().next() {
        text.replace_range(..first.len_utf8(), &first.to_uppercase().to_string());
    }
    text
}

fn around(relation: &RelativePosition) -> Around {
    let (surrounded, surrounds) = (relation.surrounded(), relation.surround());
    if relation.inside() >= INSIDE {
        Around::Inside
    } else if relation.contains() >= INSIDE {
        Around::Contains
    } else if surrounded >= PARTLY_SURROUNDED {
        Around::Surrounded { wholly: surrounded >= SURROUNDED }
    } else if surrounds >= PARTLY_SURROUNDED {
        Around::Surrounds { wholly: surrounds >= SURROUNDED }
    } else {
        Around::Nothing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::Shape;

    fn square(x: f64, y: f64) -> Shape {
        Shape::from_ring(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
    }

    fn said(a: &Shape, b: &Shape) -> String {
        Description::of(&RelativePosition::between(a, b), Axes::Map).sentence("the box", "the bed")
    }

    fn said_at(degrees: f64, distance: f64) -> String {
        let (sin, cos) = degrees.to_radians().sin_cos();
        said(&square(distance * cos, distance * sin), &square(0.0, 0.0))
    }

    #[test]
    fn the_second_direction_is_told_as_far_as_it_matters() {
        let directions = [
            (0.0, "The box is directly to the right of the bed"),
            (8.0, "The box is to the right of the bed and slightly above"),
            (22.5, "The box is mostly to the right of the bed but somewhat above"),
            (45.0, "The box is to the right of the bed and as much above"),
            (247.5, "The box is mostly below the bed but somewhat to the left"),
        ];
        for (degrees, want) in directions {
            assert_eq!(said_at(degrees, 3.0), format!("{want}; the description is satisfactory."), "{degrees}°");
        }
    }

    #[test]
    fn the_distance_is_told_unless_it_is_ordinary() {
        assert!(said_at(0.0, 1.0).contains("bed, touching it;"));
        assert!(said_at(0.0, 1.2).contains("bed, very close to it;"));
        assert!(said_at(0.0, 1.8).contains("bed, close to it;"));
        assert!(said_at(0.0, 9.0).contains("bed, far from it;"));
    }

    #[test]
    fn containing_and_surrounding_come_before_directions() {
        let ring = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        let frame = Shape::from_parts(&[vec![ring(-3.0, 4.0), ring(-2.0, 3.0)]]).expect("a frame");
        let large = Shape::from_ring(ring(-3.0, 4.0)[..4].to_vec());
        assert_eq!(said(&square(0.0, 0.0), &large), "The box is inside the bed.");
        assert_eq!(said(&square(0.0, 0.0), &frame), "The box is surrounded by the bed.");
        assert_eq!(said(&frame, &square(0.0, 0.0)), "The box surrounds the bed.");
    }

    #[test]
    fn two_of_the_same_have_no_direction() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let cross = Shape::from_ring(corners.iter().map(|[x, y]| [x - y, x + y - 0.5]).collect());
        assert_eq!(said(&cross, &cross), "The box is inside the bed.");
    }

    #[test]
    fn an_object_on_both_sides_is_not_given_one() {
        let ring = |x: f64| vec![vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0], [x, 0.0]]];
        let pair = Shape::from_parts(&[ring(-4.0), ring(4.0)]).expect("two parts");
        assert_eq!(
            said(&pair, &square(0.0, 0.0)),
            "The box lies on several sides of the bed; no direction can be said."
        );
    }
}
