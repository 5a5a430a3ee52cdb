//! A line that drops, doubles, corrupts, cuts, delays, stalls, dies and comes back, between client and served robot.

#[path = "common/faulty_line.rs"]
mod faulty_line;

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use faulty_line::{FaultyLine, Rates};
use spatial_fetch::geometry::{Pose, wrap_angle};
use spatial_fetch::robot::MobileBase;
use spatial_fetch::robot::arcos::client::{ArcosSettings, Client};
use spatial_fetch::robot::arcos::line::{Line, PtyLine, SerialLine};
use spatial_fetch::simulation::arcos::MemoryLine;
use spatial_fetch::simulation::arcos::{Server, ServerSettings};
use spatial_fetch::simulation::base::{Obstacles, SimulatedBase};

/// A robot whose watchdog is set as short as our own deadline allows: with it, even a dead line stops in time.
const WATCHDOG: Duration = Duration::from_millis(300);
/// From the last good word of the control loop to the beginning of a standstill.
const STOPS_WITHIN: Duration = Duration::from_millis(500);
const TURN: Duration = Duration::from_millis(20);

fn settings() -> ArcosSettings {
    ArcosSettings { reconnect: Some(Duration::from_secs(60)), resume: true, ..ArcosSettings::default() }
}

fn server() -> Server {
    let settings = ServerSettings { watchdog: WATCHDOG, ..ServerSettings::default() };
    Server::new(SimulatedBase::new(Obstacles::nothing(), Pose::default()), settings)
}

/// What a run showed.
#[derive(Debug, Default)]
struct Seen {
    /// How long after the control loop's last word the robot was still driven, at most.
    latest: Duration,
    off_m: f64,
    off_rad: f64,
    driven_m: f64,
    log: String,
    faults: [usize; 2],
    stalls: u32,
    deaths: u32,
    robot_faults: u64,
}

/// Twelve drives of a second, each followed by a control loop that hangs for one.
fn run(seed: u64) -> Seen {
    let robot = Rc::new(RefCell::new(server()));
    let rates = [
        Rates { byte: 20, exchange: 100, death: 0 },
        Rates { byte: 60, exchange: 200, death: 8 },
        Rates { byte: 5, exchange: 20, death: 15 },
    ];
    let line = FaultyLine::new(MemoryLine::new(Rc::clone(&robot)), seed, rates[(seed % 3) as usize]);
    let mut client = Client::connect(line, settings()).expect("connects");
    client.line().armed = true;
    let mut seen = Seen::default();
    for leg in 0..12_u64 {
        let (linear, angular) = [(0.3, 0.0), (0.25, 0.4), (0.0, 0.8), (-0.2, 0.0)][((leg + seed) % 4) as usize];
        let mut last_word = Duration::ZERO;
        for _ in 0..10 {
            last_word = client.line().now();
            let _ = client.drive(linear, angular, 0.1);
        }
        for _ in 0..50 {
            let _ = client.turn(TURN);
            let since = robot.borrow().now().saturating_sub(last_word);
            if robot.borrow().is_driven() {
                seen.latest = seen.latest.max(since);
            }
        }
    }
    client.line().armed = false;
    for _ in 0..400 {
        let _ = client.turn(TURN);
    }
    let truth = robot.borrow().truth();
    let truth = truth.borrow();
    seen.off_m = truth.pose.position().metric_distance_to(client.pose());
    seen.off_rad = wrap_angle(truth.pose.heading - client.pose().heading).abs();
    seen.driven_m = truth.distance_m;
    seen.log = client.take_events().into_iter().map(|event| event.text + "\n").collect();
    let line = client.line();
    seen.faults = [line.to_client.len(), line.to_robot.len()];
    (seen.stalls, seen.deaths) = (line.stalls, line.deaths);
    seen.robot_faults = robot.borrow().counters().faults();
    seen
}

trait Distance {
    fn metric_distance_to(&self, pose: Pose) -> f64;
}

impl Distance for spatial_fetch::geometry::Vec2 {
    fn metric_distance_to(&self, pose: Pose) -> f64 {
        (self - pose.position()).norm()
    }
}

fn check(seed: u64, seen: &Seen) {
    assert!(seen.latest <= STOPS_WITHIN, "seed {seed}: driven {:?} after the last word\n{}", seen.latest, seen.log);
    let allowed = 0.01 * seen.driven_m + 0.005;
    assert!(seen.off_m <= allowed, "seed {seed}: {:.3} m off after {:.2} m\n{}", seen.off_m, seen.driven_m, seen.log);
    assert!(seen.off_rad <= 0.01, "seed {seed}: {:.3} rad off\n{}", seen.off_rad, seen.log);
    if seen.faults[0] > 0 && seen.deaths == 0 {
        assert!(
            seen.log.contains("the line:")
                || seen.log.contains("no information packet")
                || seen.log.contains("link lost"),
            "seed {seed}: {:?}\n{}",
            seen.faults,
            seen.log
        );
    }
    if seen.faults[1] > 0 && seen.deaths == 0 {
        assert!(seen.robot_faults > 0, "seed {seed}: {:?}", seen.faults);
    }
    if seen.stalls > 0 {
        assert!(
            seen.log.contains("no information packet for") || seen.log.contains("link lost"),
            "seed {seed}\n{}",
            seen.log
        );
    }
    if seen.deaths > 0 {
        assert!(seen.log.contains("link lost") && seen.log.contains("connected again"), "seed {seed}\n{}", seen.log);
    }
}

#[test]
fn a_thousand_bad_lines_neither_keep_the_robot_moving_nor_lose_its_place() {
    let (mut latest, mut worst, mut faults, mut deaths) = (Duration::ZERO, 0.0_f64, 0, 0);
    for seed in 0..1000 {
        let seen = run(seed);
        check(seed, &seen);
        latest = latest.max(seen.latest);
        worst = worst.max(seen.off_m / seen.driven_m.max(0.1));
        faults += seen.faults[0] + seen.faults[1];
        deaths += seen.deaths;
    }
    println!(
        "latest motion {latest:?} after the last word; odometry off by at most {:.2} %; {faults} faults, {deaths} deaths",
        100.0 * worst
    );
}

/// In real time, over pseudo-terminals: `cargo test --release --test arcos_faults -- --ignored --nocapture`.
#[test]
#[ignore = "takes a quarter of a minute of real time"]
fn twenty_bad_pseudo_terminals_do_no_more_harm() {
    std::thread::scope(|scope| {
        for seed in 0..20 {
            scope.spawn(move || over_a_pseudo_terminal(seed));
        }
    });
}

fn over_a_pseudo_terminal(seed: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("p3dx");
    let quit = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
    let (theirs, at) = (quit.clone(), path.clone());
    let served = std::thread::spawn(move || serve_on(&at, &theirs));
    while !path.exists() {
        std::thread::sleep(TURN);
    }
    let inner = SerialLine::open(&path, Some(38400)).expect("opens");
    let line = FaultyLine::new(inner, seed, Rates { byte: 20, exchange: 60, death: 3 });
    let mut client = Client::connect(line, settings()).expect("connects");
    client.line().armed = true;
    for _ in 0..4 {
        for _ in 0..10 {
            let _ = client.drive(0.25, 0.3, 0.1);
        }
        for _ in 0..50 {
            let _ = client.turn(TURN);
        }
    }
    client.line().armed = false;
    for _ in 0..200 {
        let _ = client.turn(TURN);
    }
    let believed = client.pose();
    let log: String = client.take_events().into_iter().map(|event| event.text + "\n").collect();
    drop(client);
    quit.store(true, std::sync::atomic::Ordering::Relaxed);
    let (truth, driven, idle) = served.join().expect("served");
    let off = (truth.position() - believed.position()).norm();
    println!("seed {seed}: {off:.4} m off after {driven:.2} m, longest motion without a command {idle:?}");
    assert!(off <= 0.01 * driven + 0.01, "seed {seed}: {off} m\n{log}");
    assert!(idle <= STOPS_WITHIN, "seed {seed}: {idle:?}\n{log}");
}

/// Serves until told to quit; the truth, and the longest the robot was driven without hearing anything.
fn serve_on(path: &std::path::Path, quit: &std::sync::atomic::AtomicBool) -> (Pose, f64, Duration) {
    let mut server = server();
    let mut line = PtyLine::create(path, 38400).expect("a pseudo-terminal");
    let (mut heard, mut longest, mut buffer) = (Duration::ZERO, Duration::ZERO, [0; 512]);
    while !quit.load(std::sync::atomic::Ordering::Relaxed) {
        let count = line.read(&mut buffer, Duration::from_millis(5)).expect("reads");
        server.advance_to(line.now());
        server.receive(&buffer[..count]);
        let output = server.take_output();
        if !output.is_empty() {
            line.write(&output).expect("writes");
        }
        heard = server.take_heard().last().map_or(heard, |heard| heard.at);
        if server.is_driven() {
            longest = longest.max(server.now().saturating_sub(heard));
        }
    }
    let truth = server.truth();
    let truth = truth.borrow();
    (truth.pose, truth.distance_m, longest)
}
