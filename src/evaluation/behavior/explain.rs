//! Where the first furniture was wrong: do the words allow it, or did the executive err?

use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

use super::{Instruction, Score};
use crate::behavior::motion::RoomFrame;
use crate::behavior::search::{Ranked, Wanted, rank};
use crate::behavior::{Beliefs, Place};
use crate::evaluation::Rate;
use crate::geometry::Pose;
use crate::language::Lexicon;
use crate::record::{Action, Frame, Plan, SearchPair};
use crate::simulation::Item;
use crate::simulation::{Home, ideal_detection};

/// Most choices of frames looked at: four frames for each of three pairs.
const MOST_CHOICES: usize = 64;

/// Why the first furniture was wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// Knowing all furniture the words put the right one first: the executive had seen too little, or stood elsewhere.
    Executive,
    /// In one choice of frames the words put the right one first, in another a wrong one.
    TwoFit,
    /// In no choice of frames do the words put the right one first.
    Words,
}

/// One instruction whose first furniture was wrong in some trial.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Explanation {
    /// The instruction.
    pub id: String,
    /// Its text.
    pub text: String,
    /// The placement.
    pub condition: String,
    /// Trials with the right furniture first.
    pub right_first: Rate,
    /// The furniture approached first in the first trial that erred.
    pub approached: Option<String>,
    /// The furniture that holds the object.
    pub right: Vec<String>,
    /// Whose fault it is.
    pub fault: Fault,
    /// The best two by the words, all furniture known.
    pub because: String,
}

/// Explains every instruction that erred in some trial.
pub fn explain(name: &str, home: &Home, instructions: &[Instruction], scores: &[Vec<Score>]) -> Vec<Explanation> {
    let explanations = instructions.iter().zip(scores).filter_map(|(instruction, scores)| {
        let erred = scores.iter().find(|score| !score.right_first)?;
        let mut right_first = Rate::default();
        scores.iter().for_each(|score| right_first.count(score.right_first));
        let right = holders(home, &instruction.plan);
        let (fault, because) = judge(home, &instruction.plan, erred, &right);
        Some(Explanation {
            id: instruction.id.clone(),
            text: instruction.text.clone(),
            condition: name.to_string(),
            right_first,
            approached: erred.first.clone(),
            right,
            fault,
            because,
        })
    });
    explanations.collect()
}

fn holders(home: &Home, plan: &Plan) -> Vec<String> {
    let object = plan.actions.iter().find_map(|action| match action {
        Action::Find { object } => object.as_deref(),
        _ => None,
    });
    let holds = |item: &Item| {
        home.scene.objects.iter().any(|o| o.on == item.id && object.is_none_or(|object| o.name == object))
    };
    home.scene.furniture.iter().filter(|item| holds(item)).map(|item| item.id.clone()).collect()
}

fn judge(home: &Home, plan: &Plan, erred: &Score, right: &[String]) -> (Fault, String) {
    let Some(wanted) = Wanted::of_plan(plan) else {
        return (Fault::Words, "nothing was said of where to search".to_string());
    };
    let room = erred.arrived.and_then(|pose| home.map.room_at(pose.position()));
    let (Some(room), Some(arrived)) = (room, erred.arrived) else {
        return (Fault::Executive, format!("it never came to search: {}", erred.why));
    };
    let frame = RoomFrame::of(&home.map, &room.name, arrived);
    let items: Vec<&Item> =
        home.scene.furniture.iter().filter(|item| frame.outline.contains(item.pose().position())).collect();
    if !items.iter().any(|item| right.contains(&item.id)) {
        return (Fault::Words, format!("the words lead into the {}, where it is not", room.name.replace('_', " ")));
    }
    let known = Known { items, frame, arrived };
    let ranked = known.rank(&wanted);
    let because = known.describe(&ranked);
    let is_right = |ranked: &[Ranked]| ranked.first().is_some_and(|best| right.contains(&known.items[best.index].id));
    if is_right(&ranked) {
        (Fault::Executive, because)
    } else if choices(&wanted).iter().any(|wanted| is_right(&known.rank(wanted))) {
        (Fault::TwoFit, because)
    } else {
        (Fault::Words, because)
    }
}

/// A room whose furniture is known to the last piece.
struct Known<'h> {
    items: Vec<&'h Item>,
    frame: RoomFrame,
    arrived: Pose,
}

impl Known<'_> {
    fn rank(&self, wanted: &Wanted) -> Vec<Ranked> {
        let beliefs = Beliefs::of(self.items.iter().map(|item| ideal_detection(item)).collect());
        rank(&beliefs, wanted, Place { room: &self.frame, arrived: self.arrived }, Lexicon::embedded())
    }

    fn describe(&self, ranked: &[Ranked]) -> String {
        let one = |r: &Ranked| format!("{} {:.2} ({})", self.items[r.index].id, r.score, r.reading);
        ranked.iter().take(2).map(one).collect::<Vec<_>>().join(" before ")
    }
}

/// Every choice of one frame for each pair.
fn choices(wanted: &Wanted) -> Vec<Wanted> {
    let mut choices: Vec<Vec<SearchPair>> = vec![Vec::new()];
    for pair in &wanted.pairs {
        let frames: &[Frame] = if pair.frames.is_empty() { &[pair.pair.frame] } else { &pair.frames };
        let longer = choices.iter().flat_map(|chosen| {
            frames.iter().map(move |frame| {
                let mut chosen = chosen.clone();
                chosen.push(SearchPair { pair: pair.pair.clone(), frames: vec![*frame] });
                chosen
            })
        });
        choices = longer.take(MOST_CHOICES).collect();
    }
    choices.into_iter().map(|pairs| Wanted { pairs, one_frame: true, ..wanted.clone() }).collect()
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let fault = match self.fault {
            Fault::Executive => "the executive erred: the words put the right one first",
            Fault::TwoFit => "two fit: the words allow either, by the frame in which they are read",
            Fault::Words => "the words do not pick it in any frame",
        };
        let (hit, of) = (self.right_first.hit, self.right_first.of);
        writeln!(f, "{} ({}), right first {hit} of {of}: {fault}", self.id, self.condition)?;
        writeln!(f, "  {}", self.text)?;
        let approached = self.approached.as_deref().unwrap_or("nothing");
        writeln!(f, "  went to {approached} before {}", self.right.join(" or "))?;
        write!(f, "  all furniture known: {}", self.because)
    }
}
