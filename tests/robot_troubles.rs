//! What `drive` does when something goes wrong with output, disk, line, robot or itself in the middle of a drive.
#![cfg(target_os = "linux")]

mod common;
#[path = "common/served.rs"]
mod served;

use std::io::{self, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::Command;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use common::{executable, run};
use served::{AHEAD, FAR_AHEAD, Served, home_in, start_with_plan, wait_for};
use spatial_fetch::behavior::Options;
use spatial_fetch::field::{NoEyes, RealDriver};
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::load_map;
use spatial_fetch::perception::{Eyes, View};
use spatial_fetch::record::{Record, Stage};
use spatial_fetch::recording::Outputs;
use spatial_fetch::robot::arcos::client::{ArcosBase, ArcosSettings};
use spatial_fetch::robot::arcos::line::{Line, SerialLine};
use spatial_fetch::robot::{MobileBase, RobotError};
use spatial_fetch::simulation::arcos::{ServeAddress, Server, ServerSettings, serve};
use spatial_fetch::simulation::base::{Obstacles, SimulatedBase};

/// The robot stands, and it was our program that brought it to stand and said good-bye.
fn expect_good_bye(served: &Served) {
    wait_for("a standstill", || served.speed() == 0.0);
    wait_for("a good-bye", || served.log().contains("the client has closed the robot"));
    assert!(!served.log().contains("watchdog"), "{}", served.log());
}

/// Metres driven where the whole plan would be more than four.
fn expect_broken_off(served: &Served) {
    let driven = served.truth()["distance_m"].as_f64().expect("a distance");
    assert!(driven < 3.0, "{driven} m driven");
}

/// `drive` with the robot at `address` and the map `map`.
fn drive(address: &str, map: &str) -> Command {
    let mut client = Command::new(executable("drive"));
    client.args(["--robot", address, "--map", map]);
    client
}

#[test]
fn an_output_that_is_closed_in_mid_drive_stops_the_robot() {
    let served = Served::start(&[]);
    let mut child = start_with_plan(&mut drive(&served.address(), &served.map()), FAR_AHEAD);
    wait_for("motion", || served.speed() > 0.1);
    drop(child.stdout.take());
    assert_eq!(child.wait().expect("ends").code(), Some(0), "a closed pipe is a quiet end");
    expect_good_bye(&served);
    expect_broken_off(&served);
}

#[test]
fn a_disk_that_fills_up_in_mid_drive_stops_the_robot_and_is_said() {
    let served = Served::start(&[]);
    let log = served.path("trial.mcap");
    // No file of this process may grow beyond 34 blocks of 512 bytes: what is written before driving off, and a little.
    let mut limited = Command::new("sh");
    limited
        .args(["-c", r#"ulimit -f 34; exec "$@""#, "sh", executable("drive")])
        .args(["--robot", &served.address(), "--map", &served.map(), "--record"])
        .arg(&log);
    let ended = start_with_plan(&mut limited, FAR_AHEAD).wait_with_output().expect("ends");
    let said = String::from_utf8(ended.stderr).expect("UTF-8");
    // The trial was driven: its record comes out, and the log that could not be written is said.
    assert_eq!(ended.status.code(), Some(3), "{said}");
    assert!(String::from_utf8_lossy(&ended.stdout).contains(r#""outcome":"stopped""#), "{said}");
    assert!(said.contains("trial.mcap: ") && said.contains("too large"), "{said}");
    expect_good_bye(&served);
    expect_broken_off(&served);
    let driven = served.truth()["distance_m"].as_f64().expect("a distance");
    assert!(driven > 0.1, "it was on its way: {driven} m");
}

#[test]
fn a_full_disk_behind_the_record_or_the_output_leaves_a_robot_that_stands_with_its_motors_off() {
    let plan = r#"{"id":"1","plan":{"map":"apartment","room":"hallway","actions":[{"do":"enter","room":"hallway"},{"do":"move","direction":"left"}],"problems":[]}}"#;
    for option in ["--record", "--output"] {
        let served = Served::start(&[]);
        let arguments = ["--robot", &served.address(), "--map", &served.map(), option, "/dev/full"];
        let ran = run("drive", &arguments, plan).expect_code(1);
        assert!(ran.err.contains("/dev/full: the disk is full; free space"), "{}", ran.err);
        expect_good_bye(&served);
    }
}

#[test]
fn an_adapter_that_is_unplugged_ends_the_trial_as_link_lost() {
    let mut served = Served::start(&[]);
    let mut child = served::client(&served, &served.path("trial.mcap"), FAR_AHEAD);
    wait_for("motion", || served.speed() > 0.1);
    // The other end of the pseudo-terminal goes, and with it the device.
    served.child.kill().expect("killed");
    served.child.wait().expect("ends");
    assert_eq!(child.wait().expect("ends").code(), Some(3), "not driven to the end");
    let said = std::fs::read_to_string(served.path("client.log")).expect("a log");
    assert!(said.contains("link lost: the adapter"), "{said}");
    let records = spatial_fetch::recording::records(&served.path("trial.mcap"), "/fetch/drive").expect("a whole log");
    assert!(records[0].contains(r#""outcome":"link_lost""#), "{records:?}");
}

/// Passes bytes between a client and the served robot, until it is told to let go of both; then takes the next client.
fn cable(to: u16, cut: Arc<AtomicBool>) -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = listener.local_addr().expect("an address").port();
    std::thread::spawn(move || {
        for client in listener.incoming().map_while(Result::ok) {
            let Ok(robot) = TcpStream::connect(("127.0.0.1", to)) else { return };
            let ends = [(client.try_clone(), robot.try_clone()), (Ok(robot), Ok(client))];
            let threads = ends.map(|(from, to)| {
                let (from, to) = (from.expect("open"), to.expect("open"));
                let cut = Arc::clone(&cut);
                std::thread::spawn(move || pass(from, to, &cut))
            });
            threads.into_iter().for_each(|thread| thread.join().expect("passes"));
            cut.store(false, Ordering::SeqCst);
        }
    });
    port
}

fn pass(mut from: TcpStream, mut to: TcpStream, cut: &AtomicBool) {
    from.set_read_timeout(Some(Duration::from_millis(10))).expect("a time limit");
    let mut buffer = [0; 512];
    while !cut.load(Ordering::SeqCst) {
        match from.read(&mut buffer) {
            Ok(0) => break,
            Ok(count) if to.write_all(&buffer[..count]).is_ok() => {}
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
            _ => break,
        }
    }
    cut.store(true, Ordering::SeqCst);
}

#[test]
fn a_line_that_breaks_is_connected_again_when_asked_and_the_trial_goes_on() {
    let robot = TcpListener::bind("127.0.0.1:0").expect("a port").local_addr().expect("an address").port();
    let served = Served::start_at_port(robot);
    let cut = Arc::new(AtomicBool::new(false));
    let port = cable(robot, Arc::clone(&cut));
    let mut client = drive(&format!("tcp:127.0.0.1:{port}"), &served.map());
    let child = start_with_plan(client.arg("--reconnect"), FAR_AHEAD);
    wait_for("motion", || served.speed() > 0.1);
    cut.store(true, Ordering::SeqCst);
    let ended = child.wait_with_output().expect("ends");
    let (out, said) =
        (String::from_utf8(ended.stdout).expect("UTF-8"), String::from_utf8(ended.stderr).expect("UTF-8"));
    assert_eq!(ended.status.code(), Some(0), "{said}");
    assert!(said.contains("link lost: ") && said.contains("connected again after"), "{said}");
    let record: serde_json::Value = serde_json::from_str(&out).expect("a record");
    assert_eq!(record["trial"]["outcome"], "arrived", "{record} {said}");
    assert_eq!(served.log().matches("a client has opened the robot").count(), 2, "{}", served.log());
}

/// A robot served by this process, so that someone can press its STOP button.
struct OwnRobot {
    folder: tempfile::TempDir,
    stop_button: Arc<AtomicBool>,
    quit: Arc<AtomicBool>,
    /// mm/s.
    speed: Arc<AtomicU64>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl OwnRobot {
    fn start() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        home_in(folder.path());
        let [stop_button, quit] = [(); 2].map(|()| Arc::new(AtomicBool::new(false)));
        let speed = Arc::new(AtomicU64::new(0));
        let path = folder.path().join("p3dx");
        let (button, done, moves, at) = (stop_button.clone(), quit.clone(), speed.clone(), path.clone());
        let thread = std::thread::spawn(move || {
            let base = SimulatedBase::new(Obstacles::nothing(), Pose::default());
            let mut server = Server::new(base, ServerSettings::default());
            serve(&mut server, &ServeAddress::Pty(at, 38400), |server| {
                server.press_stop_button(button.load(Ordering::SeqCst));
                moves.store((server.velocity().0.abs() * 1000.0) as u64, Ordering::SeqCst);
                !done.load(Ordering::SeqCst)
            })
            .expect("served");
        });
        wait_for("the pseudo-terminal", || path.exists());
        Self { folder, stop_button, quit, speed, thread: Some(thread) }
    }

    fn is_moving(&self) -> bool {
        self.speed.load(Ordering::SeqCst) > 100
    }

    /// Drives with the STOP button pressed in mid-motion, and let go when the robot stands.
    fn drive_through_a_stop(&self, option: &[&str]) -> (serde_json::Value, String) {
        let map = self.folder.path().join("home.map.json").display().to_string();
        let address = format!("serial:{}@38400", self.folder.path().join("p3dx").display());
        let child = start_with_plan(drive(&address, &map).arg("--no-localization").args(option), AHEAD);
        wait_for("motion", || self.is_moving());
        self.stop_button.store(true, Ordering::SeqCst);
        wait_for("a standstill", || self.speed.load(Ordering::SeqCst) == 0);
        std::thread::sleep(Duration::from_millis(300));
        self.stop_button.store(false, Ordering::SeqCst);
        let ended = child.wait_with_output().expect("ends");
        let said = String::from_utf8(ended.stderr).expect("UTF-8");
        let goes_on = option.contains(&"--resume");
        assert_eq!(ended.status.code(), Some(if goes_on { 0 } else { 3 }), "{said}");
        (serde_json::from_slice(&ended.stdout).expect("a record"), said)
    }
}

impl Drop for OwnRobot {
    fn drop(&mut self) {
        self.quit.store(true, Ordering::SeqCst);
        // A robot whose thread failed has failed its test already.
        let _ = self.thread.take().map(std::thread::JoinHandle::join);
    }
}

#[test]
fn the_stop_button_ends_a_trial_and_with_resume_only_interrupts_it() {
    let robot = OwnRobot::start();
    let (record, said) = robot.drive_through_a_stop(&[]);
    assert_eq!(record["trial"]["outcome"], "stopped", "{said}");
    assert!(record["trial"]["why"].as_str().is_some_and(|why| why.contains("STOP button")), "{record}");
    let (record, said) = robot.drive_through_a_stop(&["--resume"]);
    assert_eq!(record["trial"]["outcome"], "arrived", "{record} {said}");
    assert!(said.contains("the STOP button is pressed: stopping") && said.contains("free again: going on"), "{said}");
}

/// A driver in this process, at the served robot's line, that sees through `eyes`; and what it says.
fn own_driver(served: &Served, line: Box<dyn Line + Send>, eyes: Box<dyn Eyes + Send>) -> (RealDriver, Said) {
    let map = load_map(served.map().as_ref()).expect("a map");
    let base = ArcosBase::connect(line, ArcosSettings::default(), map.start).expect("connects");
    let said: Said = Arc::default();
    let hears = Arc::clone(&said);
    let tell = Arc::new(move |text: &str| hears.lock().expect("whole").push_str(&format!("{text}\n")));
    (RealDriver::new(map, Options::default(), Outputs::default(), Box::new(base), eyes, tell), said)
}

type Said = Arc<Mutex<String>>;

fn serial(served: &Served) -> SerialLine {
    SerialLine::open(&served.path("p3dx"), Some(38400)).expect("opens")
}

/// Eyes that do something unexpected once the robot is on its way.
struct Trap<F>(F);

impl<F: FnMut()> Eyes for Trap<F> {
    fn look(&mut self, _believed: Pose) -> View {
        View::default()
    }

    fn glimpse(&mut self, _believed: Pose) -> Option<View> {
        (self.0)();
        None
    }

    /// The moves are enough for these tests: nothing is looked for.
    fn can_see(&self) -> bool {
        false
    }
}

#[test]
fn a_panic_in_mid_drive_stops_the_robot_switches_its_motors_off_and_closes_the_line() {
    let served = Served::start(&[]);
    let eyes = Trap(|| panic!("made for this test"));
    let (driver, _) = own_driver(&served, Box::new(serial(&served)), Box::new(eyes));
    let mut record = Record::parse(FAR_AHEAD).expect("a record");
    assert!(catch_unwind(AssertUnwindSafe(|| driver.run(&mut record))).is_err());
    // The driver lives on: it was not its end that closed the line.
    expect_good_bye(&served);
    expect_broken_off(&served);
    drop(driver);
}

/// A line that panics once when told to.
struct Panicking(SerialLine, Arc<AtomicBool>);

impl Line for Panicking {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        assert!(!self.1.swap(false, Ordering::SeqCst), "made for this test");
        self.0.read(buffer, wait)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write(bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        self.0.reopen()
    }

    fn now(&self) -> Duration {
        self.0.now()
    }

    fn name(&self) -> String {
        self.0.name()
    }
}

#[test]
fn a_panic_in_the_thread_that_talks_to_the_robot_stops_it_and_is_told_to_the_program() {
    let served = Served::start(&[]);
    let panics = Arc::new(AtomicBool::new(false));
    let line = Panicking(serial(&served), Arc::clone(&panics));
    let mut base = ArcosBase::connect(Box::new(line), ArcosSettings::default(), Pose::default()).expect("connects");
    while served.speed() < 0.1 {
        base.drive(0.3, 0.0, 0.1).expect("drives");
    }
    panics.store(true, Ordering::SeqCst);
    let told = (0..20).find_map(|_| base.drive(0.3, 0.0, 0.1).err());
    assert!(matches!(&told, Some(RobotError::Link(why)) if why.contains("internal error")), "{told:?}");
    expect_good_bye(&served);
}

#[test]
fn a_control_loop_that_hangs_in_mid_drive_leaves_a_robot_that_stands() {
    let served = Served::start(&[]);
    let (hangs, hung): (Sender<()>, Receiver<()>) = channel();
    let (release, held): (Sender<()>, Receiver<()>) = channel();
    let eyes = Trap(move || {
        // The first time only: afterwards nobody listens, and nobody answers.
        if hangs.send(()).is_ok() {
            let _ = held.recv();
        }
    });
    let (driver, said) = own_driver(&served, Box::new(serial(&served)), Box::new(eyes));
    let outcome = std::thread::scope(|scope| {
        let trial = scope.spawn(|| {
            let mut record = Record::parse(FAR_AHEAD).expect("a record");
            driver.run(&mut record).expect("a trial");
            record.raw("trial").expect("a trial").to_string()
        });
        hung.recv().expect("drives");
        wait_for("a standstill while the loop hangs", || served.speed() == 0.0);
        drop((hung, release));
        trial.join().expect("goes on")
    });
    assert!(said.lock().expect("whole").contains("no new velocity for 300 ms: stopping"));
    assert!(!served.log().contains("watchdog"), "{}", served.log());
    assert!(outcome.contains(r#""outcome":"arrived""#), "{outcome}");
}

#[test]
fn the_end_of_the_input_is_a_good_bye() {
    let served = Served::start(&[]);
    let (driver, said) = own_driver(&served, Box::new(serial(&served)), Box::new(NoEyes));
    drop(driver);
    expect_good_bye(&served);
    assert!(said.lock().expect("whole").contains("p3dx-sh"), "the line before driving off");
}
