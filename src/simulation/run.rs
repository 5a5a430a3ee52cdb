//! Runs one plan in a home.

use super::base::{Obstacles, SimulatedBase};
use super::eyes::{eyes, is_recognisable};
use super::judge::judge;
use super::naming::Naming;
use super::{Home, TrialSettings};
use crate::behavior::{Executive, Report, Watcher};
use crate::behavior::{Run, object_of, rounded};
use crate::geometry::Pose;
use crate::record::{Outcome, PathPoint, Plan, Trial};
use crate::robot::MobileBase;

/// Runs `plan` in `home`. `stream` picks the record's own random numbers under the seed ([`super::stream_of`]).
pub fn run(home: &Home, plan: &Plan, settings: &TrialSettings, stream: u64, watcher: &mut dyn Watcher) -> Run {
    let noise = settings.noise_in(home.scene.noise.unwrap_or_default());
    let obstacles = Obstacles::new(&home.map, &home.scene);
    let mut base = SimulatedBase::with_noise(obstacles, home.map.start, noise, settings.seed, stream);
    let truth = base.truth();
    let mut eyes = eyes(home, settings, stream, base.truth());
    let mut naming = Naming::new(&home.scene, watcher);
    let mut report = Executive::new(&home.map, &mut base, eyes.as_mut(), &mut naming, settings.options).run(plan);
    naming.rename(&mut report);
    let duration_s = base.time_s();
    let truth = truth.borrow().clone();
    confirm(&mut report, home, object_of(plan), truth.pose);
    let verdict = judge(home, object_of(plan), &report.approached, report.found_at, report.outcome, truth.distance_m);
    let mut path = report.journal.path;
    path.push(PathPoint::new(duration_s, report.pose));
    let trial = Trial {
        outcome: report.outcome,
        why: report.why,
        description: report.description,
        final_pose: rounded(report.pose),
        target_id: verdict.target_id,
        approached: verdict.approached,
        right_first: verdict.right_first,
        picture: None,
        duration_s: duration_s.into(),
        distance_m: truth.distance_m.into(),
        spl: verdict.spl.map(Into::into),
        collisions: truth.collisions,
        min_clearance_m: Some(truth.min_clearance_m.into()),
        delivered: report.delivered,
        actions: report.journal.actions,
        path,
    };
    Run { trial, final_pose: truth.pose, found_at: report.found_at, sought: object_of(plan).map(str::to_string) }
}

/// What the robot took for the object need not be it: found is what truly is recognisable in the last picture.
fn confirm(report: &mut Report, home: &Home, object: Option<&str>, pose: Pose) {
    // What was carried away is in no last picture.
    if report.outcome == Outcome::Found && report.delivered.is_empty() && !is_recognisable(home, object, pose) {
        report.outcome = Outcome::NotFound;
        report.why = format!("mistaken: {}", report.why);
        report.description = None;
    }
}
