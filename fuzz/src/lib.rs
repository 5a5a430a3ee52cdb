//! What each fuzz target does with its input, as plain functions: the targets call them, and so does a test that runs
//! every seed without nightly (`tests/fuzz_seeds.rs`).

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::time::Duration;

use spatial_fetch::cli::TrialOptions;
use spatial_fetch::evaluation::{import, parse_tree, read_gold, score, with_texts};
use spatial_fetch::force::{AxesName, Describer, ForceName};
use spatial_fetch::frame::{decode_color, decode_depth, picture_size};
use spatial_fetch::grounding::{GroundStage, Grounder, Method, Settings};
use spatial_fetch::language::{Chunker, chunk_text};
use spatial_fetch::map::{RoomMap, SHIPPED_MAPS};
use spatial_fetch::planning::Planner;
use spatial_fetch::record::{Chunk, Detection, Plan, Record, Stage};
use spatial_fetch::recording::{FrameOptions, FrameReader, LogReader, RecordReader, Window};
use spatial_fetch::robot::arcos::client::Odometry;
use spatial_fetch::robot::arcos::codec::{
    CONFIG_PACKET, Command, Config, Decoder, ENCODER_PACKET, Encoder, GYRO_PACKET, Gyro, IO_PACKET, Io, Packet,
    SIP_STOPPED, Sip,
};
use spatial_fetch::robot::arcos::parameters::Parameters;
use spatial_fetch::simulation::Scene;

/// A target: its name, which is that of its folder of seeds, and what it does with an input.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const TARGETS: &[Target] = &[
    ("config", config),
    ("corpus", corpus),
    ("detections", detections),
    ("images", images),
    ("language", language),
    ("map_server", map_server),
    ("mcap", mcap),
    ("meshes", meshes),
    ("options", options),
    ("packets", packets),
    ("plans", plans),
    ("record", record),
    ("shapes", shapes),
    ("sip", sip),
    ("spreadsheets", spreadsheets),
    ("treebank", treebank),
    ("world", world),
];

/// The text of an input that is one.
fn text_of(data: &[u8]) -> Option<&str> {
    std::str::from_utf8(data).ok()
}

/// Files for readers that take a path, in memory where the system has such a place; one folder a process and thread.
fn with_files(files: &[(&str, &[u8])], read: impl FnOnce(&Path)) {
    let memory = Path::new("/dev/shm");
    let base = if memory.is_dir() { memory.to_path_buf() } else { std::env::temp_dir() };
    let thread = format!("{:?}", std::thread::current().id()).replace(|c: char| !c.is_ascii_digit(), "");
    let folder = base.join(format!("fuzz-{}-{thread}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    for (name, bytes) in files {
        std::fs::write(folder.join(name), bytes).expect("written");
    }
    read(&folder);
    let _ = std::fs::remove_dir_all(&folder);
}

/// The two parts of an input that a line `---` parts.
fn halves(data: &[u8]) -> (&[u8], &[u8]) {
    let mark = b"\n---\n";
    let at = data.windows(mark.len()).position(|window| window == mark);
    at.map_or((data, &[]), |at| (&data[..at], &data[at + mark.len()..]))
}

/// Any bytes as a picture: read or refused, and what is read is as large as its head says.
pub fn images(data: &[u8]) {
    let size = picture_size(data);
    if let Ok(picture) = decode_color(data) {
        assert_eq!(size, Ok((picture.width, picture.height)));
        assert_eq!(picture.pixels.len(), picture.width * picture.height);
    }
    if let Ok(picture) = decode_depth(data) {
        assert_eq!(picture.pixels.len(), picture.width * picture.height);
    }
}

/// Any bytes as a sheet of groundings beside a small treebank: read or refused.
pub fn spreadsheets(data: &[u8]) {
    let treebank = b"<T><S>(S (OBTP the/DT mug/NN))</S></T>";
    with_files(&[("treebank.xml", treebank), ("sheet.xlsx", data)], |folder| {
        let _ = import(&folder.join("treebank.xml"), Some(&folder.join("sheet.xlsx")), "fuzz");
    });
}

/// Any JSON as two shapes – GeoJSON, grids – in a record: measured, or refused by name.
pub fn shapes(data: &[u8]) {
    let Some(record) = text_of(data).and_then(|line| Record::parse(line).ok()) else { return };
    // A mask would be read from a path of the input's choice.
    let names_a_file = ["a", "b", "c"].iter().any(|key| record.raw(key).is_some_and(|raw| raw.get().contains("mask")));
    if names_a_file {
        return;
    }
    let describer = Describer {
        forces: vec![ForceName::Power(0.0), ForceName::Power(2.0)],
        directions: 16,
        frame: AxesName::Map,
        fuzzy: Default::default(),
        pictures: None,
    };
    let mut record = record;
    let _ = describer.run(&mut record);
}

/// Any JSON as a record with a grounding or a plan that others made: planned, or refused by name.
pub fn plans(data: &[u8]) {
    let Some(text) = text_of(data) else { return };
    let Ok(mut record) = Record::parse(text) else { return };
    let planner = Planner::new(RoomMap::apartment());
    let _ = planner.run(&mut record);
    let _ = planner.text(&record);
    if let Ok(Some(plan)) = record.get::<Plan>("plan") {
        let again = serde_json::to_string(&plan).expect("a plan serializes");
        assert_eq!(serde_json::from_str::<Plan>(&again).ok().as_ref(), Some(&plan));
    }
}

/// A YAML file and, behind a line `---`, its image: a room map, or refused by name.
pub fn map_server(data: &[u8]) {
    let (yaml, image) = halves(data);
    // Only the image beside it.
    if !text_of(yaml).is_some_and(|yaml| yaml.lines().any(|line| line.trim() == "image: floor.pgm")) {
        return;
    }
    with_files(&[("floor.yaml", yaml), ("floor.pgm", image)], |folder| {
        if let Ok(map) = RoomMap::load(&folder.join("floor.yaml")) {
            let _ = (map.walls(), map.room_at(map.start.position()));
        }
    });
}

/// Any bytes as the mesh of a table: a scene, or refused by name.
pub fn meshes(data: &[u8]) {
    let scene = br#"{"version": 1, "name": "s", "map": "apartment", "furniture": [
        {"id": "t", "category": "table", "x": 4.0, "y": 4.0, "mesh": {"file": "mesh.obj"}}]}"#;
    with_files(&[("home.scene.json", scene), ("mesh.obj", data)], |folder| {
        if let Ok(scene) = Scene::load(&folder.join("home.scene.json"), &RoomMap::apartment()) {
            let _ = (scene.furniture[0].footprint(), scene.furniture[0].solids());
        }
    });
}

/// Any bytes as the options in a log: within their ranges and of a shipped home, or refused by name.
pub fn options(data: &[u8]) {
    let usual =
        br#"{"noise":"default","perception":"truth","depth_noise":1.0,"depth_loss":0.02,"light":1.0,"blind":false,
        "one_frame":false,"first_pair_only":false,"no_fallback":false,"no_glance":false,"no_localization":false,
        "time_limit":900.0,"seed":0}"#;
    let usual: TrialOptions = serde_json::from_slice(usual).expect("what a program told nothing takes");
    if let Ok(replayed) = usual.replaying(data, &usual, |_| false) {
        let TrialOptions { world, map, time_limit, depth_noise, .. } = replayed.options;
        assert!(
            [&world, &map]
                .into_iter()
                .flatten()
                .all(|home| SHIPPED_MAPS.iter().any(|shipped| shipped.name == home.as_str()))
        );
        assert!(time_limit.is_finite() && depth_noise.is_finite() && depth_noise >= 0.0);
    }
}

/// Any JSON as what a detector answers.
pub fn detections(data: &[u8]) {
    if let Ok(found) = serde_json::from_slice::<Vec<Detection>>(data) {
        let again = serde_json::to_string(&found).expect("detections serialize");
        assert!(serde_json::from_str::<Vec<Detection>>(&again).is_ok() || again.contains("null"));
    }
}

/// Any data as a CONFIG, encoder, IO or gyro packet: read without a panic.
pub fn config(data: &[u8]) {
    let packet = |kind| Packet::new(kind, data.to_vec());
    if let Some(config) = Config::from_packet(&packet(CONFIG_PACKET)) {
        let _ = config.to_packet();
    }
    let _ = Encoder::from_packet(&packet(ENCODER_PACKET));
    if let Some(io) = Io::from_packet(&packet(IO_PACKET)) {
        assert_eq!(Io::from_packet(&io.to_packet()), Some(io));
    }
    if let Some(gyro) = Gyro::from_packet(&packet(GYRO_PACKET)) {
        assert_eq!(Gyro::from_packet(&gyro.to_packet()), Some(gyro));
    }
}

/// Gold corpora and the files of meanings and trees beside them are read or refused by line, never with a panic.
pub fn corpus(data: &[u8]) {
    let Some(text) = text_of(data) else { return };
    if let Ok(tree) = parse_tree(text) {
        assert!(tree.chunks.iter().all(|chunk| tree.text.get(chunk.start..chunk.end).is_some()));
    }
    let gold = read_gold(text, "fuzz").unwrap_or_default();
    let _ = with_texts(gold.clone(), gold.clone());
    let lines: Vec<String> = text.lines().map(str::to_string).collect();
    let _ = score(&gold, &lines);
}

/// Any text is read and grounded without a panic, and its chunks lie within it.
pub fn language(data: &[u8]) {
    let Some(text) = text_of(data) else { return };
    let (tokens, chunks) = chunk_text(text);
    assert!(within(text, &chunks));
    Grounder::new(Method::Composed, false).ground(text, &tokens, &chunks);
}

fn within(text: &str, chunks: &[Chunk]) -> bool {
    chunks.iter().all(|chunk| text.get(chunk.start..chunk.end).is_some() && within(text, &chunk.chunks))
}

/// Any bytes are read as a log of frames and of records without a panic, strictly and in recovery.
///
/// The first byte chooses between a log as it is and the body of one message of a type that makes frames.
pub fn mcap(data: &[u8]) {
    match data {
        [0, rest @ ..] => {
            let log = log_of(rest);
            read(log.as_deref().unwrap_or_default());
        }
        log => read(log),
    }
}

const TYPES: [(&str, &str, &str); 9] = [
    ("cdr", "ros2msg", "sensor_msgs/msg/Image"),
    ("cdr", "ros2msg", "sensor_msgs/msg/CompressedImage"),
    ("cdr", "ros2msg", "sensor_msgs/msg/CameraInfo"),
    ("cdr", "ros2msg", "tf2_msgs/msg/TFMessage"),
    ("ros1", "ros1msg", "nav_msgs/Odometry"),
    ("ros1", "ros1msg", "sensor_msgs/Image"),
    ("protobuf", "protobuf", "foxglove.RawImage"),
    ("protobuf", "protobuf", "foxglove.CameraCalibration"),
    ("protobuf", "protobuf", "foxglove.FrameTransforms"),
];

fn read(log: &[u8]) {
    for recover in [false, true] {
        if let Ok(frames) = FrameReader::new(log, "fuzz", FrameOptions { recover, ..FrameOptions::default() }) {
            frames.for_each(drop);
        }
        if let Ok(log) = LogReader::new(log, "fuzz", recover) {
            RecordReader::new(log, "/fetch/plan", Window::default()).for_each(drop);
        }
    }
}

/// A log whose messages are the pieces of `data`: type, length, body.
fn log_of(mut data: &[u8]) -> Option<Vec<u8>> {
    let mut writer = mcap::Writer::new(Cursor::new(Vec::new())).ok()?;
    let mut time = 0;
    while let [kind, length, rest @ ..] = data {
        let (message, encoding, name) = TYPES[usize::from(*kind) % TYPES.len()];
        let body = &rest[..rest.len().min(usize::from(*length) * 8)];
        data = &rest[body.len()..];
        let schema = writer.add_schema(name, encoding, b"").ok()?;
        let channel_id = writer.add_channel(schema, &format!("/{name}"), message, &BTreeMap::new()).ok()?;
        time += 1_000_000;
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, body).ok()?;
    }
    writer.finish().ok()?;
    Some(writer.into_inner().into_inner())
}

/// Any bytes, in any pieces: the decoder takes them in without a panic, and what it finds is written and found again.
///
/// Pieces are a length and as many bytes.
pub fn packets(data: &[u8]) {
    let mut decoder = Decoder::default();
    let (mut rest, mut at) = (data, Duration::ZERO);
    while let [length, following @ ..] = rest {
        let (piece, left) = following.split_at(following.len().min(usize::from(*length)));
        (rest, at) = (left, at + Duration::from_millis(30));
        decoder.push(piece, at);
        while let Some(packet) = decoder.next(at) {
            let bytes = packet.to_bytes();
            assert!(bytes.len() <= 258);
            let mut again = Decoder::default();
            again.push(&bytes, at);
            assert_eq!(again.next(at).as_ref(), Some(&packet));
            let command = Command::from_packet(&packet);
            let _ = command.to_string();
            assert_eq!(Command::from_packet(&command.to_packet()), command);
        }
    }
}

/// A line that is a record comes out byte for byte, or is refused; no stage panics on what it holds.
pub fn record(data: &[u8]) {
    let Some(line) = text_of(data) else { return };
    let Ok(record) = Record::parse(line) else { return };
    let again = serde_json::to_string(&record).expect("a record serializes");
    let once = serde_json::to_string(&Record::parse(&again).expect("what was written reads")).expect("serializes");
    assert_eq!(again, once);
    let grounder = Settings::default().grounder().expect("the shipped one");
    let stages: [&dyn Stage; 3] =
        [&Chunker::default(), &GroundStage { grounder, answer: None }, &Planner::new(RoomMap::apartment())];
    for stage in stages {
        let mut record = Record::parse(line).expect("parsed before");
        let _ = stage.run(&mut record);
        let _ = stage.text(&record);
    }
}

/// Any data as a server information packet: read without a panic, and what is read is written and read alike.
pub fn sip(data: &[u8]) {
    let mut odometry = Odometry::new(Parameters::P3DX_SH, 0.3);
    let (mut rest, mut at) = (data, Duration::ZERO);
    // Packets are a length and as many bytes.
    while let [length, following @ ..] = rest {
        let (packet, left) = following.split_at(following.len().min(usize::from(*length)));
        (rest, at) = (left, at + Duration::from_millis(100));
        let Some(sip) = Sip::from_packet(&Packet::new(SIP_STOPPED, packet.to_vec())) else { continue };
        assert_eq!(Sip::from_packet(&sip.to_packet()).as_ref(), Some(&sip));
        odometry.take(&sip, at);
        assert!(odometry.pose().x.is_finite() && odometry.distance_m() >= 0.0);
    }
}

/// Any text as a treebank file: read or refused by line without a panic, and what is read holds together.
pub fn treebank(data: &[u8]) {
    let Some(xml) = text_of(data) else { return };
    with_files(&[("treebank.xml", xml.as_bytes())], |folder| {
        if let Ok(imported) = import(&folder.join("treebank.xml"), None, "fuzz") {
            for line in &imported.lines {
                assert!(serde_json::from_str::<serde_json::Value>(line).is_ok_and(|line| line["id"].is_string()));
            }
        }
    });
}

/// World files are read or refused, and a world that was accepted can be looked at, without a panic.
pub fn world(data: &[u8]) {
    let Some(text) = text_of(data) else { return };
    if let Ok(map) = RoomMap::from_json(text, "fuzz") {
        let _ = (map.walls(), map.room_at(map.start.position()));
        let _ = Scene::from_json(text, "fuzz", &map);
    }
    let apartment = RoomMap::apartment();
    if let Ok(scene) = Scene::from_json(text, "fuzz", &apartment) {
        for item in &scene.furniture {
            let _ = (item.footprint(), item.solids());
        }
    }
}
