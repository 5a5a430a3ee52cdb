//! The simulated robot, served by a process of its own.
#![allow(dead_code)]

use std::io::Write;
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::common::executable;

/// However slow the machine, something has gone wrong after this.
pub const PATIENCE: Duration = Duration::from_secs(40);

/// Through the door before which the robot starts, and half a metre on.
pub const AHEAD: &str = r#"{"id":"1","plan":{"map":"apartment","room":"living_room","actions":[{"do":"enter","room":"living_room"},{"do":"move","direction":"front","amount":{"meters":0.5}}],"problems":[]}}"#;
/// Far enough to be interrupted.
pub const FAR_AHEAD: &str = r#"{"id":"1","plan":{"map":"apartment","room":"living_room","actions":[{"do":"enter","room":"living_room"},{"do":"move","direction":"front","amount":{"meters":3.0}}],"problems":[]}}"#;

/// A served robot, ended when dropped.
pub struct Served {
    pub child: Child,
    folder: tempfile::TempDir,
}

impl Served {
    /// Before the door of an empty room, so that no test has far to go.
    pub fn start(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let home = home_in(folder.path());
        let home: Vec<&str> = home.iter().map(String::as_str).collect();
        Self::start_in(folder, &[&home, arguments].concat())
    }

    pub fn start_in(folder: tempfile::TempDir, arguments: &[&str]) -> Self {
        let pty = folder.path().join("p3dx");
        let served = Self::spawn(folder, &format!("pty:{}@38400", pty.display()), arguments);
        wait_for("the pseudo-terminal", || pty.exists());
        served
    }

    /// The same at a port of this machine.
    pub fn start_at_port(port: u16) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let home = home_in(folder.path());
        let home: Vec<&str> = home.iter().map(String::as_str).collect();
        let served = Self::spawn(folder, &format!("tcp:127.0.0.1:{port}"), &home);
        wait_for("the port", || TcpStream::connect(("127.0.0.1", port)).is_ok());
        served
    }

    fn spawn(folder: tempfile::TempDir, address: &str, arguments: &[&str]) -> Self {
        let log = std::fs::File::create(folder.path().join("served.log")).expect("a log");
        let child = Command::new(executable("drive"))
            .args(["--serve", address, "--truth-out"])
            .arg(folder.path().join("truth.jsonl"))
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(log)
            .spawn()
            .expect("starts");
        Self { child, folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn address(&self) -> String {
        format!("serial:{}@38400", self.path("p3dx").display())
    }

    /// What the robot may know of its home.
    pub fn map(&self) -> String {
        self.path("home.map.json").display().to_string()
    }

    pub fn log(&self) -> String {
        std::fs::read_to_string(self.path("served.log")).expect("a log")
    }

    /// The last whole line of the truth.
    pub fn truth(&self) -> Value {
        let text = std::fs::read_to_string(self.path("truth.jsonl")).unwrap_or_default();
        let whole = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        whole.lines().last().and_then(|line| serde_json::from_str(line).ok()).unwrap_or(Value::Null)
    }

    pub fn speed(&self) -> f64 {
        self.truth()["speed"].as_f64().unwrap_or(0.0)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The arguments of a home made for these tests.
pub fn home_in(folder: &Path) -> Vec<String> {
    let map = include_str!("../../fixtures/apartment.map.json");
    let start = r#"{"x": 5.0, "y": 0.0, "heading": 3.141592653589793}"#;
    assert!(map.contains(start));
    let map = map.replace(start, r#"{"x": 2.63, "y": 0.7, "heading": 1.5708}"#);
    let scene = r#"{"version":1,"name":"empty","map":"apartment","furniture":[],"objects":[]}"#;
    let (map_file, scene_file) = (folder.join("home.map.json"), folder.join("home.scene.json"));
    std::fs::write(&map_file, map).expect("written");
    std::fs::write(&scene_file, scene).expect("written");
    ["--map".into(), map_file.display().to_string(), "--scene".into(), scene_file.display().to_string()].to_vec()
}

pub fn wait_for(what: &str, mut done: impl FnMut() -> bool) {
    let until = Instant::now() + PATIENCE;
    while !done() {
        assert!(Instant::now() < until, "{what} did not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}

pub fn client(served: &Served, log: &Path, plan: &str) -> Child {
    let mut child = Command::new(executable("drive"))
        .args(["--robot", &served.address(), "--map", &served.map(), "--record"])
        .arg(log)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(std::fs::File::create(served.path("client.log")).expect("a log"))
        .spawn()
        .expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    writeln!(stdin, "{plan}").expect("written");
    child
}

/// Starts a client with pipes on all sides, gives it `plan` and closes its input.
pub fn start_with_plan(client: &mut Command, plan: &str) -> Child {
    let mut child = client.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
    writeln!(child.stdin.take().expect("piped"), "{plan}").expect("written");
    child
}
