//! What a simulated home does not have: there is no need to look for it.

use super::{Home, Scene};
use crate::behavior::{Run, object_of, rounded};
use crate::record::{Outcome, PathPoint, Plan, Trial};

/// The trial of a plan that looks for what the home does not have; nothing when it may be found.
pub(super) fn missing(home: &Home, plan: &Plan) -> Option<Run> {
    let sought = object_of(plan).filter(|name| home.scene.holders_of(name).is_empty())?;
    let start = home.map.start;
    let trial = Trial {
        outcome: Outcome::NotFound,
        why: what_is_there(&home.scene, sought),
        description: None,
        final_pose: rounded(start),
        target_id: None,
        approached: Vec::new(),
        right_first: None,
        picture: None,
        duration_s: 0.0.into(),
        distance_m: 0.0.into(),
        spl: None,
        collisions: 0,
        min_clearance_m: None,
        delivered: Vec::new(),
        actions: Vec::new(),
        path: vec![PathPoint::new(0.0, start)],
    };
    Some(Run { trial, final_pose: start, found_at: None, sought: Some(sought.to_string()) })
}

/// "This home has no keys; it has fork, mug", and how to have them looked for all the same.
fn what_is_there(scene: &Scene, sought: &str) -> String {
    let mut names: Vec<String> = scene.objects.iter().map(|object| object.name.replace('_', " ")).collect();
    names.sort_unstable();
    names.dedup();
    let has = if names.is_empty() { "no small object at all".to_string() } else { names.join(", ") };
    format!("this home has no {}; it has {has} (--search-anyway has it looked for)", sought.replace('_', " "))
}
