//! A trial in the record: the plan it is run by, and the pose it ends at.

use crate::geometry::{Pose, Vec2};
use crate::map::RoomMap;
use crate::record::{Action, Note, Outcome, Plan, Record, Rounded, StageError, Trial};

/// A trial with what its files want to know beside the record.
#[derive(Clone, Debug)]
pub struct Run {
    /// The trial, as the record gets it.
    pub trial: Trial,
    /// Where the robot stood at the end: truly, where that is known.
    pub final_pose: Pose,
    /// Where the object was recognised.
    pub found_at: Option<Vec2>,
    /// What was looked for, where it was named.
    pub sought: Option<String>,
}

/// The plan of a record, made for this home.
///
/// # Errors
/// When there is no plan, it is none, or it was made for another map.
pub fn plan_of(record: &Record, map: &RoomMap) -> Result<Plan, StageError> {
    let plan: Plan = record.require_part("pipe the record through `plan` first")?;
    if plan.map != map.name {
        let (plan, home) = (&plan.map, &map.name);
        let message = format!("`plan`: made for the map `{plan}`, the robot is in `{home}`; give both the same --map");
        return Err(StageError::new(message));
    }
    Ok(plan)
}

/// The object that a plan looks for.
pub fn object_of(plan: &Plan) -> Option<&str> {
    plan.actions.iter().find_map(|action| match action {
        Action::Find { object } => object.as_deref(),
        _ => None,
    })
}

/// How a stage did that ran this trial: a robot that looked everywhere in vain was driven, one that could not be driven
/// to the end of its plan was not, and whoever waits for the program's exit code hears of it.
pub fn note_of(trial: &Trial) -> Note {
    match trial.outcome {
        Outcome::LinkLost | Outcome::Stopped | Outcome::Stuck => {
            Note::Lossy(format!("the robot was not driven to the end of its plan: {}", trial.why))
        }
        Outcome::Found | Outcome::Arrived | Outcome::NotFound | Outcome::Blocked | Outcome::Timeout => Note::Done,
    }
}

/// A pose as records hold it.
pub fn rounded(pose: Pose) -> Pose {
    let four = |v: f64| Rounded(v).value();
    Pose::new(four(pose.x), four(pose.y), four(pose.heading))
}
