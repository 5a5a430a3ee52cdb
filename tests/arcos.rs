//! Client and served robot in one process, on a virtual clock: what the one does, and what is then true of the other.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::robot::arcos::client::{ArcosSettings, Client, ConnectError};
use spatial_fetch::robot::arcos::codec::{
    Command, Decoder, ENCODER_PACKET, GYRO_PACKET, Gyro, IO_PACKET, Packet, SIP_STOPPED, number,
};
use spatial_fetch::robot::arcos::line::Line;
use spatial_fetch::robot::arcos::parameters::Parameters;
use spatial_fetch::robot::{MobileBase, RobotError};
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::arcos::MemoryLine;
use spatial_fetch::simulation::arcos::{Server, ServerSettings};
use spatial_fetch::simulation::base::{Obstacles, SimulatedBase};

type Robot = Rc<RefCell<Server>>;

fn robot_with(settings: ServerSettings, start: Pose) -> Robot {
    let obstacles = Obstacles::new(&RoomMap::apartment(), &Scene::apartment());
    Rc::new(RefCell::new(Server::new(SimulatedBase::new(obstacles, start), settings)))
}

fn robot() -> Robot {
    robot_with(ServerSettings::default(), Pose::new(-2.0, 0.0, 0.0))
}

fn connect(robot: &Robot, settings: ArcosSettings) -> Client<MemoryLine> {
    Client::connect(MemoryLine::new(Rc::clone(robot)), settings).expect("connects")
}

fn drive(client: &mut Client<MemoryLine>, linear: f64, angular: f64, seconds: f64) {
    for _ in 0..(seconds * 10.0).round() as usize {
        client.drive(linear, angular, 0.1).expect("drives");
    }
}

fn turn(client: &mut Client<MemoryLine>, seconds: f64) {
    for _ in 0..(seconds * 50.0).round() as usize {
        client.turn(Duration::from_millis(20)).expect("linked");
    }
}

fn events(client: &mut Client<MemoryLine>) -> String {
    client.take_events().into_iter().map(|event| event.text + "\n").collect()
}

/// How far what the client believes is from what is true, metres and radians.
fn error_of(client: &Client<MemoryLine>, robot: &Robot, start: Pose) -> (f64, f64) {
    let truth = robot.borrow().truth().borrow().pose;
    let at = start.to_world(client.pose().position());
    let turned = spatial_fetch::geometry::wrap_angle(start.heading + client.pose().heading - truth.heading);
    ((truth.position() - at).norm(), turned.abs())
}

#[test]
fn the_client_believes_what_is_true_after_a_drive_with_turns() {
    let start = Pose::new(-2.0, 0.0, 0.0);
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 4.0);
    drive(&mut client, 0.0, 0.8, 3.0);
    drive(&mut client, 0.2, -0.5, 2.0);
    drive(&mut client, 0.0, 0.0, 2.0);
    let (metres, radians) = error_of(&client, &robot, start);
    assert!(metres < 0.01 && radians < 0.005, "{metres} m, {radians} rad");
    assert!(robot.borrow().truth().borrow().distance_m > 1.2);
}

#[test]
fn zero_set_points_go_before_the_motors_and_limits_before_both() {
    let robot = robot();
    let _client = connect(&robot, ArcosSettings::default());
    let heard: Vec<String> = robot.borrow_mut().take_heard().iter().map(|heard| heard.command.to_string()).collect();
    let at = |what: &str| heard.iter().position(|command| command == what).expect(what);
    assert!(at("SETV 300") < at("VEL 0") && at("VEL 0") < at("RVEL 0") && at("RVEL 0") < at("ENABLE 1"), "{heard:?}");
}

#[test]
fn the_speed_limit_holds_whatever_is_asked() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 5.0, 0.0, 3.0);
    assert!(robot.borrow().velocity().0 <= 0.301, "{:?}", robot.borrow().velocity());
    client.drive(f64::NAN, f64::INFINITY, 0.1).expect("drives");
    turn(&mut client, 2.0);
    assert_eq!(robot.borrow().velocity().0, 0.0);
}

#[test]
fn a_velocity_not_asked_for_again_ends_at_its_deadline() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 2.0);
    turn(&mut client, 0.4);
    assert!(!robot.borrow().is_driven(), "told to stop 300 ms after the last word");
    turn(&mut client, 1.5);
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
    assert!(events(&mut client).contains("no new velocity for 300 ms: stopping"));
}

#[test]
fn a_client_that_is_gone_leaves_the_robot_to_its_watchdog() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 2.0);
    // As by kill -9: nothing is said any more.
    std::mem::forget(client);
    let mut line = MemoryLine::new(Rc::clone(&robot));
    let now = Duration::from_secs(60);
    line.sleep(now);
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
    assert!(robot.borrow_mut().take_log().iter().any(|text| text.contains("stopped by the watchdog")));
}

#[test]
fn good_bye_is_stop_then_motors_off_then_close() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 1.0);
    robot.borrow_mut().take_heard();
    drop(client);
    let heard: Vec<String> = robot.borrow_mut().take_heard().iter().map(|heard| heard.command.to_string()).collect();
    assert_eq!(heard[0], "VEL2 0");
    assert_eq!(heard[heard.len() - 2..], ["ENABLE 0", "CLOSE"]);
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
}

#[test]
fn a_session_left_open_is_taken_over_and_its_old_velocity_not_taken_up() {
    let robot = robot();
    let mut first = connect(&robot, ArcosSettings::default());
    drive(&mut first, 0.3, 0.0, 1.0);
    std::mem::forget(first);
    MemoryLine::new(Rc::clone(&robot)).sleep(Duration::from_secs(30));
    let before = robot.borrow().truth().borrow().pose;
    let mut line = MemoryLine::new(Rc::clone(&robot));
    line.sleep(Duration::from_secs(31));
    let _second = Client::connect(line, ArcosSettings::default()).expect("connects");
    assert_eq!(robot.borrow().truth().borrow().pose, before);
}

#[test]
fn the_stop_button_ends_the_drive_and_says_so() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 1.0);
    robot.borrow_mut().press_stop_button(true);
    let ended = (0..10).find_map(|_| client.drive(0.3, 0.0, 0.1).err());
    assert!(matches!(ended, Some(RobotError::Held(why)) if why.contains("STOP button")));
    robot.borrow_mut().press_stop_button(false);
    turn(&mut client, 3.0);
    assert!(client.drive(0.3, 0.0, 0.1).is_err(), "released is not resumed");
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
}

#[test]
fn after_the_stop_button_resume_enables_the_motors_with_zero_set_points_and_goes_on() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings { resume: true, ..ArcosSettings::default() });
    drive(&mut client, 0.3, 0.0, 1.0);
    robot.borrow_mut().press_stop_button(true);
    drive(&mut client, 0.3, 0.0, 1.0);
    robot.borrow_mut().press_stop_button(false);
    turn(&mut client, 1.5);
    drive(&mut client, 0.3, 0.0, 1.0);
    assert!(robot.borrow().velocity().0 > 0.1);
    let events = events(&mut client);
    assert!(events.contains("the STOP button is pressed: stopping") && events.contains("going on"), "{events}");
}

#[test]
fn motors_that_are_switched_off_are_told_at_once() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    robot.borrow_mut().receive(&Command::int(number::ENABLE, 0).to_packet().to_bytes());
    let ended = (0..10).find_map(|_| client.drive(0.3, 0.0, 0.1).err());
    assert!(matches!(ended, Some(RobotError::Held(why)) if why.contains("motors are disabled")));
}

#[test]
fn the_sonar_stops_the_robot_before_the_wall() {
    let robot = robot_with(ServerSettings::default(), Pose::new(5.5, 0.0, 0.0));
    let mut client = connect(&robot, ArcosSettings::default());
    for _ in 0..100 {
        let _ = client.drive(0.3, 0.0, 0.1);
    }
    let truth = robot.borrow().truth();
    assert!(truth.borrow().collisions == 0 && truth.borrow().pose.x > 6.5, "{:?}", truth.borrow());
    assert!(events(&mut client).contains("sonar: something"));
}

#[test]
fn counters_reset_behind_our_back_do_not_move_the_robot() {
    let start = Pose::new(-2.0, 0.0, 0.0);
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.1, 3.0);
    robot.borrow_mut().reset_odometry();
    drive(&mut client, 0.3, -0.1, 2.0);
    drive(&mut client, 0.0, 0.0, 2.0);
    let (metres, radians) = error_of(&client, &robot, start);
    assert!(metres < 0.02 && radians < 0.01, "{metres} m, {radians} rad");
    assert!(events(&mut client).contains("counters were set anew"));
}

#[test]
fn the_older_model_is_driven_by_its_own_scale() {
    let start = Pose::new(-2.0, 0.0, 0.0);
    let settings = ServerSettings { parameters: Parameters::P3DX, ..ServerSettings::default() };
    let robot = robot_with(settings, start);
    let mut client = connect(&robot, ArcosSettings::default());
    drive(&mut client, 0.3, 0.0, 4.0);
    drive(&mut client, 0.0, 0.0, 2.0);
    assert!(error_of(&client, &robot, start).0 < 0.01);
}

#[test]
fn an_unknown_model_is_refused_with_a_way_out() {
    let parameters = Parameters { subclass: "p9zz", ..Parameters::P3DX_SH };
    let settings = ServerSettings { parameters, ..ServerSettings::default() };
    let robot = robot_with(settings, Pose::default());
    let error = Client::connect(MemoryLine::new(Rc::clone(&robot)), ArcosSettings::default()).err().expect("refused");
    assert!(matches!(error, ConnectError::UnknownModel(..)) && error.to_string().contains("--robot-model"), "{error}");
    connect(&robot, ArcosSettings { model: Some(Parameters::P3DX_SH), ..ArcosSettings::default() });
}

#[test]
fn before_driving_off_one_line_says_what_matters() {
    let robot = robot();
    let mut client = connect(&robot, ArcosSettings::default());
    turn(&mut client, 0.5);
    let line = client.preflight();
    for part in ["p3dx-sh", "battery 12.8 V", "motors on", "16 sonars", "firmware 2.9", "0.30 m/s", "robot: 2000 ms"] {
        assert!(line.contains(part), "{part} in {line}");
    }
}

/// What the robot answers to raw bytes within half a second.
fn answers(robot: &Robot, line: &mut MemoryLine, commands: &[Command]) -> Vec<Packet> {
    for command in commands {
        line.write(&command.to_packet().to_bytes()).expect("memory");
    }
    let (mut decoder, mut packets, mut buffer) = (Decoder::default(), Vec::new(), [0; 512]);
    for _ in 0..25 {
        line.sleep(Duration::from_millis(20));
        while let Ok(count @ 1..) = line.read(&mut buffer, Duration::ZERO) {
            decoder.push(&buffer[..count], line.now());
        }
        packets.extend(std::iter::from_fn(|| decoder.next(line.now())));
    }
    let _ = robot;
    packets
}

#[test]
fn the_served_robot_synchronises_skips_junk_and_takes_open_with_and_without_argument() {
    for open in [Command::bare(number::OPEN), Command::int(number::OPEN, 1)] {
        let robot = robot();
        let mut line = MemoryLine::new(Rc::clone(&robot));
        line.write(b"WMS2\r").expect("memory");
        let packets = answers(&robot, &mut line, &[Command::bare(0), Command::bare(1), Command::bare(2)]);
        assert_eq!(packets.iter().map(|packet| packet.kind).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(packets[2].data, b"spatial-fetch\0Pioneer\0p3dx-sh\0");
        let sips = answers(&robot, &mut line, &[open]);
        assert!(sips.len() >= 4 && sips.iter().all(|packet| packet.kind == SIP_STOPPED), "{sips:?}");
    }
}

fn opened(robot: &Robot) -> MemoryLine {
    let mut line = MemoryLine::new(Rc::clone(robot));
    let numbers = [0, 1, 2, number::OPEN].map(Command::bare);
    answers(robot, &mut line, &numbers);
    line
}

fn let_pass(robot: &Robot, line: &mut MemoryLine, seconds: f64) {
    for _ in 0..(seconds * 2.0) as usize {
        answers(robot, line, &[Command::bare(number::PULSE)]);
    }
}

#[test]
fn move_heading_and_wheel_commands_do_what_the_manual_says() {
    let robot = robot();
    let mut line = opened(&robot);
    answers(&robot, &mut line, &[Command::int(number::ENABLE, 1), Command::int(number::MOVE, 500)]);
    let_pass(&robot, &mut line, 5.0);
    let x = robot.borrow().truth().borrow().pose.x;
    assert!((x + 1.5).abs() < 0.02, "MOVE 500 from -2 ended at {x}");
    answers(&robot, &mut line, &[Command::int(number::DHEAD, 90)]);
    let_pass(&robot, &mut line, 4.0);
    let heading = robot.borrow().truth().borrow().pose.heading.to_degrees();
    assert!((heading - 90.0).abs() < 1.0, "DHEAD 90 ended at {heading}");
    answers(&robot, &mut line, &[Command::int(number::HEAD, -45)]);
    let_pass(&robot, &mut line, 4.0);
    let heading = robot.borrow().truth().borrow().pose.heading.to_degrees();
    assert!((heading + 45.0).abs() < 1.0, "HEAD -45 ended at {heading}");
    // Left wheel 0, right wheel 200 mm/s: ahead and to the left.
    answers(&robot, &mut line, &[Command::int(number::VEL2, 10)]);
    let_pass(&robot, &mut line, 1.0);
    let (linear, angular) = robot.borrow().velocity();
    assert!((linear - 0.1).abs() < 0.01 && angular > 0.4, "{linear} {angular}");
    answers(&robot, &mut line, &[Command::bare(number::STOP)]);
    let_pass(&robot, &mut line, 2.0);
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
}

#[test]
fn an_emergency_stop_overrides_the_deceleration_and_hears_nothing_until_the_robot_stands() {
    let robot = robot();
    let mut line = opened(&robot);
    let drive = [Command::int(number::ENABLE, 1), Command::int(number::SETA, -100), Command::int(number::VEL, 300)];
    answers(&robot, &mut line, &drive);
    let_pass(&robot, &mut line, 2.0);
    let (speed, before) = (robot.borrow().velocity().0, robot.borrow().truth().borrow().pose.x);
    assert!((speed - 0.3).abs() < 0.01, "{speed}");
    answers(&robot, &mut line, &[Command::bare(number::E_STOP), Command::int(number::VEL, 300)]);
    let gone = robot.borrow().truth().borrow().pose.x - before;
    assert!(robot.borrow().velocity() == (0.0, 0.0) && gone < 0.03, "{gone} m, at 0.1 m/s² it would be 0.45");
    answers(&robot, &mut line, &[Command::int(number::VEL, 300)]);
    let_pass(&robot, &mut line, 1.0);
    assert!(robot.borrow().velocity().0 > 0.2, "standing, it obeys again");
}

/// The types of the packets that come in a second.
fn kinds(robot: &Robot, line: &mut MemoryLine, commands: &[Command]) -> Vec<u8> {
    let packets = [answers(robot, line, commands), answers(robot, line, &[Command::bare(number::PULSE)])].concat();
    packets.iter().map(|packet| packet.kind).collect()
}

#[test]
fn encoders_and_inputs_come_once_or_from_now_on_as_asked() {
    for (command, kind) in [(number::ENCODER, ENCODER_PACKET), (number::IOREQUEST, IO_PACKET)] {
        let robot = robot();
        let mut line = opened(&robot);
        let count = |kinds: Vec<u8>| kinds.into_iter().filter(|other| *other == kind).count();
        assert_eq!(count(kinds(&robot, &mut line, &[Command::int(command, 1)])), 1);
        assert!(count(kinds(&robot, &mut line, &[Command::int(command, 2)])) >= 8);
        assert_eq!(count(kinds(&robot, &mut line, &[Command::int(command, 0)])), 0);
    }
}

#[test]
fn the_gyro_goes_before_each_report_and_shows_the_turn() {
    let robot = robot();
    let mut line = opened(&robot);
    let turn = [Command::int(number::ENABLE, 1), Command::int(number::RVEL, 40), Command::int(number::GYRO, 1)];
    answers(&robot, &mut line, &turn);
    let_pass(&robot, &mut line, 1.0);
    let packets = answers(&robot, &mut line, &[Command::bare(number::PULSE)]);
    assert!(packets.chunks_exact(2).all(|pair| (pair[0].kind, pair[1].kind) == (GYRO_PACKET, SIP_STOPPED + 1)));
    let gyro = Gyro::from_packet(&packets[0]).expect("a gyro packet");
    let mean = gyro.samples.iter().map(|(rate, _)| f64::from(*rate) - 512.0).sum::<f64>() / gyro.samples.len() as f64;
    assert!((mean * 1.626 - 40.0).abs() < 1.0, "{mean}");
}

#[test]
fn with_the_motors_off_nothing_moves() {
    let robot = robot();
    let mut line = opened(&robot);
    answers(&robot, &mut line, &[Command::int(number::VEL, 300)]);
    let_pass(&robot, &mut line, 1.0);
    assert_eq!(robot.borrow().truth().borrow().distance_m, 0.0);
}

#[test]
fn close_stops_and_the_next_client_is_served() {
    let robot = robot();
    let mut line = opened(&robot);
    answers(&robot, &mut line, &[Command::int(number::ENABLE, 1), Command::int(number::VEL, 300)]);
    let_pass(&robot, &mut line, 1.0);
    answers(&robot, &mut line, &[Command::int(number::CLOSE, 1)]);
    line.sleep(Duration::from_secs(2));
    assert_eq!(robot.borrow().velocity(), (0.0, 0.0));
    let mut client = Client::connect(line, ArcosSettings::default()).expect("served again");
    turn(&mut client, 0.5);
    assert!(client.report().motors);
}
