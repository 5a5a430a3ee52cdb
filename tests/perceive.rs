//! `perceive` on rendered frames, through the real executables.

mod common;

use std::path::Path;

use common::{executable, run};
use serde_json::Value;

/// A folder with some rendered frames and their index.
fn frames(count: usize) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = folder.path().join("frames");
    let name = frames.display().to_string();
    run("evaluate", &["frames", "--count", &count.to_string(), "--seed", "77", "--into", &name], "").expect_code(0);
    (folder, frames.join("index.jsonl").display().to_string())
}

fn changed(index: &str, change: impl Fn(&mut Value)) -> String {
    let text = std::fs::read_to_string(index).expect("readable");
    let line = |line: &str| {
        let mut record: Value = serde_json::from_str(line).expect("JSON");
        change(&mut record);
        format!("{record}\n")
    };
    text.lines().map(line).collect()
}

fn folder_of(index: &str) -> String {
    Path::new(index).parent().expect("a folder").display().to_string()
}

#[test]
fn furniture_of_rendered_rooms_is_found_and_scored() {
    let (_folder, index) = frames(6);
    let seen = run("perceive", &["--least-confidence", "0", &index], "").expect_code(0);
    let scores = run("evaluate", &["perception", "--gold", &index], &seen.out).expect_code(0);
    let scores: Value = serde_json::from_str(&scores.out).expect("JSON");
    let (hit, of) = (scores["all"]["found"]["hit"].as_u64(), scores["all"]["found"]["of"].as_u64());
    assert!(of >= Some(6) && hit.map(|hit| 4 * hit) >= of.map(|of| 3 * of), "{hit:?} of {of:?}");
    for detection in seen.records().iter().flat_map(|record| record["detections"].as_array().cloned().expect("a list"))
    {
        assert!(detection["why"].as_str().expect("reasons").contains("m high"), "{detection}");
        let sum: f64 = detection["scores"].as_object().expect("scores").values().filter_map(Value::as_f64).sum();
        assert!(sum <= 1.001, "{sum}");
    }
}

#[test]
fn one_job_and_many_write_the_same_bytes() {
    let (_folder, index) = frames(3);
    let one = run("perceive", &["-j", "1", &index], "").expect_code(0);
    assert_eq!(one.out, run("perceive", &["-j", "4", &index], "").expect_code(0).out);
}

#[test]
fn a_wrong_unit_of_depth_is_told_with_the_likely_one() {
    let (_folder, index) = frames(1);
    let records = changed(&index, |record| record["depth_unit_m"] = 1.0.into());
    let ran = run("perceive", &["--folder", &folder_of(&index)], records).expect_code(1);
    assert!(ran.err.contains("<stdin>:1:") && ran.err.contains("perhaps `depth_unit_m` is 0.001"), "{}", ran.err);
}

#[test]
fn missing_intrinsics_and_sizes_that_differ_are_named_and_the_rest_goes_on() {
    let (_folder, index) = frames(1);
    let without = changed(&index, |record| drop(record.as_object_mut().expect("an object").remove("fx")));
    let smaller = changed(&index, |record| record["width"] = 320.into());
    let sound = std::fs::read_to_string(&index).expect("readable");
    let input = [without, smaller, sound].concat();
    let ran = run("perceive", &["--keep-going", "--folder", &folder_of(&index)], input).expect_code(3);
    assert!(ran.err.contains("missing field `fx`") && ran.err.contains("the record says 320"), "{}", ran.err);
    assert!(ran.records().last().expect("the sound frame")["detections"].is_array());
}

#[test]
fn fused_frames_of_a_scene_make_one_record_with_a_map() {
    let (_folder, index) = frames(2);
    let records = changed(&index, |record| record["scene"] = "home".into());
    let ran = run("perceive", &["--fuse", "--folder", &folder_of(&index)], records).expect_code(0);
    let records = ran.records();
    assert_eq!((records.len(), records[0]["frames"].as_array().map(Vec::len)), (1, Some(2)));
    assert!(records[0]["grid"]["rows"].as_array().expect("a map").len() > 10);
}

#[test]
fn overlays_are_written_and_never_replaced_without_force() {
    let (folder, index) = frames(1);
    let seen = folder.path().join("seen").display().to_string();
    run("perceive", &["--overlay", &seen, &index], "").expect_code(0);
    let picture = std::fs::read_dir(&seen).expect("a folder").next().expect("a picture").expect("readable");
    assert!(std::fs::read(picture.path()).expect("readable").starts_with(b"\x89PNG"));
    assert!(run("perceive", &["--overlay", &seen, &index], "").expect_code(1).err.contains("--force"));
    run("perceive", &["--force", "--overlay", &seen, &index], "").expect_code(0);
}

#[cfg(unix)]
#[test]
fn a_detector_of_ones_own_takes_the_place_of_ours() {
    let (_folder, index) = frames(2);
    // A detector that answers every frame with what our own says of it.
    let own = format!("while read -r frame; do echo \"$frame\" | {} --quiet; done", executable("perceive"));
    let (ours, theirs) =
        (run("perceive", &[&index], ""), run("perceive", &["--detector-only", "--detector", &own, &index], ""));
    let detections = |ran: common::Ran| ran.expect_code(0).records().into_iter().map(|r| r["detections"].clone());
    assert!(detections(ours).eq(detections(theirs)));
    let ran = run("perceive", &["--detector", "exit 7", &index], "").expect_code(1);
    assert!(ran.err.contains("--detector `exit 7`: ended"), "{}", ran.err);
}

#[test]
fn a_file_that_is_no_model_is_refused() {
    let (_folder, index) = frames(1);
    let ran = run("perceive", &["--model", &index, &index], "").expect_code(1);
    assert!(ran.err.contains("not a model of this version; `evaluate train` makes one"), "{}", ran.err);
}

#[test]
fn the_same_seed_trains_the_same_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let train = |name: &str| {
        let path = folder.path().join(name);
        run("evaluate", &["train", "--count", "6", "-o", &path.display().to_string()], "").expect_code(0);
        std::fs::read(path).expect("a model")
    };
    assert_eq!(train("one"), train("other"));
}

#[test]
fn a_frame_without_a_pose_is_seen_from_over_its_own_floor() {
    let (_folder, index) = frames(6);
    let posed = run("perceive", &[&index], "").expect_code(0).records();
    let bare = changed(&index, |record| record["T_world_cam"] = Value::Null);
    // A floor that may as well be the top of something is refused, and said.
    let seen = run("perceive", &["--keep-going", "--folder", &folder_of(&index)], bare).records();
    let count = |record: &Value| record["detections"].as_array().map_or(0, Vec::len);
    let placed: Vec<(&Value, &Value)> =
        seen.iter().zip(&posed).filter(|(bare, _)| bare["detections"].is_array()).collect();
    assert!(placed.len() >= 3 && placed.iter().any(|(_, posed)| count(posed) > 0), "{} placed", placed.len());
    for (bare, posed) in placed {
        assert!(count(bare).abs_diff(count(posed)) <= 1, "{bare}\n{posed}");
        for detection in bare["detections"].as_array().expect("a list") {
            assert!(detection["x"].as_f64() > Some(0.0), "ahead of the camera: {detection}");
        }
    }
}

#[test]
fn text_in_the_place_of_frames_is_told_what_perceive_reads() {
    for arguments in [&[][..], &["--fuse"]] {
        let told = run("perceive", arguments, "# Spatial fetch\n").expect_code(1).err;
        assert!(told.contains("not a JSON object; `perceive` reads a frame a line"), "{told}");
        assert!(!told.contains("chunk"), "text is no way to a frame: {told}");
    }
}

#[test]
fn blank_lines_between_frames_are_passed_over() {
    let (_folder, index) = frames(1);
    let spaced = format!("\n{}\n", std::fs::read_to_string(&index).expect("readable"));
    let folder = folder_of(&index);
    for option in [&[][..], &["--fuse"]] {
        let seen = run("perceive", &[&["--folder", &folder], option].concat(), &spaced).expect_code(0);
        assert_eq!(seen.records().len(), 1, "{}", seen.out);
    }
}
