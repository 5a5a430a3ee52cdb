//! `hof` through the real executable.

mod common;

use common::run;

const SQUARES: &str = r#"{"id":"s","a":{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,1],[3,0]]]},"b":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}}"#;

#[test]
fn forces_degrees_and_a_sentence_are_added() {
    let record =
        run("hof", &["--forces", "0,2,hybrid", "--directions", "8"], SQUARES).expect_code(0).records().remove(0);
    let hof = &record["hof"];
    assert_eq!(hof["forces"]["0"][0], 1.0);
    assert!((hof["forces"]["2"][0].as_f64().unwrap_or(0.0) - 0.117_783_035_656_383_46).abs() < 1e-12);
    assert!(hof["degrees"]["right"]["a"].as_f64().is_some_and(|a| a > 0.95));
    assert_eq!(hof["distance_m"], 2.0);
}

#[test]
fn a_force_that_diverges_is_said_to_be_infinite() {
    let touching = SQUARES.replace("[3,0],[4,0],[4,1],[3,1],[3,0]", "[1,0],[2,0],[2,1],[1,1],[1,0]");
    let record = run("hof", &[], touching).expect_code(0).records().remove(0);
    assert_eq!(record["hof"]["forces"]["2"], "infinite");
    assert!(record["hof"]["forces"]["hybrid"].is_array());
}

#[test]
fn a_bad_shape_is_called_by_its_fault() {
    let open = SQUARES.replace("[3,1],[3,0]]", "[3,1]]");
    let ran = run("hof", &[], open).expect_code(1);
    assert!(ran.err.contains("`a`: ring 1 is open") && ran.err.contains("(record \"s\")"), "{}", ran.err);
}

fn spoken(arguments: &[&str], input: &str) -> String {
    run("hof", &[&["--format", "text"], arguments].concat(), input).expect_code(0).out
}

#[test]
fn text_is_the_sentence_with_the_names_and_in_the_frame_asked_for() {
    let named = SQUARES
        .replace(r#""a":{"#, r#""heading":1.5707963267948966,"a":{"name":"table","#)
        .replace(r#""b":{"#, r#""b":{"name":"couch","#);
    let sentence = |place: &str| format!("The table is {place} the couch; the description is satisfactory.\n");
    assert_eq!(spoken(&[], &named), sentence("directly to the right of"));
    assert_eq!(spoken(&["--frame", "facing"], &named), sentence("directly to the left of"));
    let error = run("hof", &["--frame", "robot"], SQUARES).expect_code(1).err;
    assert!(error.contains("`heading`: missing"), "{error}");
}

#[test]
fn grids_and_the_squares_they_are_say_the_same() {
    let grids = r#"{"id":"s","a":{"grid":{"rows":["...9"],"cell_m":1.0}},"b":{"grid":{"rows":["9..."],"cell_m":1.0}}}"#;
    let cells = run("hof", &[], grids).expect_code(0).records().remove(0);
    let squares = run("hof", &[], SQUARES).expect_code(0).records().remove(0);
    assert_eq!(cells["hof"], squares["hof"]);
}

#[test]
fn masks_are_read_from_png_files_and_pictures_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let mask = |name: &str, pixels: &[u8]| {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).expect("a file");
        let mut encoder = png::Encoder::new(file, 4, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().and_then(|mut w| w.write_image_data(pixels)).expect("an image");
        serde_json::json!({"mask": path, "cell_m": 1.0})
    };
    let (a, b) = (mask("a.png", &[0, 0, 0, 255]), mask("b.png", &[255, 0, 0, 0]));
    let record = serde_json::json!({"id": "x/1", "a": a, "b": b}).to_string();
    let pictures = folder.path().join("roses");
    let svg = ["--svg", pictures.to_str().expect("UTF-8")];
    let hof = run("hof", &svg, &record).expect_code(0).records().remove(0);
    assert_eq!(hof["hof"]["forces"]["0"][0], 1.0);
    let drawn = std::fs::read_to_string(pictures.join("x%2F1.svg")).expect("a picture");
    assert!(drawn.starts_with("<svg") && drawn.contains("directly to the right of"), "{drawn}");
    let again = run("hof", &svg, &record).expect_code(1).err;
    assert!(again.contains("exists") && again.contains("--force"), "{again}");
    run("hof", &[&svg[..], &["--force"]].concat(), &record).expect_code(0);
}

#[test]
fn each_bad_record_is_reported_and_passed_on_when_told_to_go_on() {
    let bad = |a: &str| SQUARES.replacen(r#"{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,1],[3,0]]]}"#, a, 1);
    let faults = [
        (r#"{"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}"#, "ring 1 crosses itself"),
        (r#"{"type":"Polygon","coordinates":[]}"#, "the shape is empty"),
        (r#"{"type":"Polygon","coordinates":[[[0,0],[1e999,0],[1,1],[0,0]]]}"#, "number out of range"),
        (r#"{"grid":{"rows":["1"],"cell_m":1}}"#, "give both in one form"),
        (r#"{"mask":"no/such.png"}"#, "no/such.png: "),
        ("7", "invalid type: integer"),
    ];
    for (shape, message) in faults {
        let input = format!("{}\n{SQUARES}\n", bad(shape));
        let ran = run("hof", &["--keep-going"], input).expect_code(3);
        assert!(ran.err.contains(message) && ran.err.contains("<stdin>:1:"), "{}", ran.err);
        assert_eq!(ran.out.lines().count(), 2, "the bad record is passed on as it came");
    }
}

#[test]
fn grids_that_do_not_fit_each_other_or_the_machine_are_refused() {
    let pair = |a: &str, b: &str| format!(r#"{{"a":{{"grid":{a}}},"b":{{"grid":{b}}}}}"#);
    let error = |input: String| run("hof", &[], input).expect_code(1).err;
    let cell = r#"{"rows":["1"],"cell_m":1}"#;
    assert!(error(pair(cell, r#"{"rows":["1"],"cell_m":2}"#)).contains("the cells measure 1 m and 2 m"));
    assert!(error(pair(cell, r#"{"rows":["1","1"],"cell_m":1}"#)).contains("1 × 1 and 1 × 2 cells"));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("huge.png");
    let file = std::fs::File::create(&path).expect("a file");
    // A header that promises 10^9 pixels, and nothing behind it.
    png::Encoder::new(file, 40_000, 25_000).write_header().expect("a header");
    let huge = serde_json::json!({"mask": path}).to_string();
    assert!(error(format!(r#"{{"a":{huge},"b":{huge}}}"#)).contains("1000000000 pixels are more than"));
}
