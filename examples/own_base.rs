//! A base of one's own: all that the executive asks of a robot. `cargo run --example own_base`.

use spatial_fetch::behavior::{Executive, Options, Silent};
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::perception::{Eyes, View};
use spatial_fetch::record::{Action, Plan};
use spatial_fetch::robot::{Body, MobileBase, RobotError, SonarReading, Status, p3dx};

/// Goes exactly as it is told.
struct Ideal {
    pose: Pose,
    velocity: (f64, f64),
    time_s: f64,
}

impl MobileBase for Ideal {
    fn body(&self) -> Body {
        p3dx::BODY
    }
    fn pose(&self) -> Pose {
        self.pose
    }
    fn velocity(&self) -> (f64, f64) {
        self.velocity
    }
    fn time_s(&self) -> f64 {
        self.time_s
    }
    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError> {
        let heading = self.pose.heading + angular * seconds;
        let (sin, cos) = heading.sin_cos();
        self.pose = Pose::new(self.pose.x + linear * cos * seconds, self.pose.y + linear * sin * seconds, heading);
        (self.velocity, self.time_s) = ((linear, angular), self.time_s + seconds);
        Ok(())
    }
    fn sonar(&self) -> &[SonarReading] {
        &[]
    }
    fn status(&self) -> Status {
        Status::default()
    }
}

/// Eyes that are shut.
struct Shut;

impl Eyes for Shut {
    fn look(&mut self, _believed: Pose) -> View {
        View::default()
    }
}

fn main() {
    let map = RoomMap::apartment();
    let mut base = Ideal { pose: map.start, velocity: (0.0, 0.0), time_s: 0.0 };
    let actions = vec![Action::Enter { room: Some("bedroom".to_string()), candidates: vec!["bedroom".to_string()] }];
    let plan = Plan { map: map.name.clone(), actions, ..Plan::default() };
    let report = Executive::new(&map, &mut base, &mut Shut, &mut Silent, Options::default()).run(&plan);
    println!(
        "{:?}, {}: the robot is in the {}",
        report.outcome,
        report.why,
        map.room_at(report.pose.position()).map_or("hallway", |room| &room.name)
    );
}
