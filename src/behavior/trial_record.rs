//! A trial in the record: the plan it is run by, the pose it ends at, and how it reads to people.

use crate::geometry::{Pose, Vec2};
use crate::map::RoomMap;
use crate::record::{Plan, Record, Rounded, StageError, Trial, doubts_of};

/// A trial with what its files want to know beside the record.
#[derive(Clone, Debug)]
pub struct Run {
    /// The trial, as the record gets it.
    pub trial: Trial,
    /// Where the robot stood at the end: truly, where that is known.
    pub final_pose: Pose,
    /// Where the object was recognised.
    pub found_at: Option<Vec2>,
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

/// A trial for people.
///
/// # Errors
/// When there is no trial, or it is none.
pub fn text_of(record: &Record) -> Result<String, StageError> {
    let trial: Trial = record.require_part("it is what `drive` adds")?;
    let mut lines: Vec<String> = record.get::<String>("text")?.into_iter().collect();
    for action in &trial.actions {
        let (start, end) = (action.start_s.0, action.end_s.0);
        lines.push(format!("{start:6.1}–{end:<6.1} {:7} {}", action.action, action.result));
        lines.extend(action.why.split("; ").filter(|why| !why.is_empty()).map(|why| format!("{:22} {why}", "")));
    }
    let outcome = format!("{:?}", trial.outcome).to_lowercase();
    let (metres, seconds) = (trial.distance_m.0, trial.duration_s.0);
    lines.push(format!("{outcome}: {} ({metres:.1} m, {seconds:.0} s, {} collisions)", trial.why, trial.collisions));
    lines.extend(trial.delivered.iter().map(|delivery| {
        let what = delivery.objects.join(" and ").replace('_', " ");
        format!("delivered: {what} {}", delivery.to.phrase())
    }));
    lines.extend(doubts_of(record)?.into_iter().map(|doubt| format!("  !  {doubt}")));
    Ok(lines.join("\n"))
}

/// A pose as records hold it.
pub fn rounded(pose: Pose) -> Pose {
    let four = |v: f64| Rounded(v).value();
    Pose::new(four(pose.x), four(pose.y), four(pose.heading))
}
