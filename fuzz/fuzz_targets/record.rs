//! A line that is a record comes out byte for byte, or is refused; no stage panics on what it holds.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::grounding::{GroundStage, Settings};
use spatial_fetch::language::Chunker;
use spatial_fetch::planning::Planner;
use spatial_fetch::record::{Record, Stage};
use spatial_fetch::map::RoomMap;

fuzz_target!(|line: &str| {
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
});
