//! A Kinect (the first model) as a stream of frames, through Debian's libfreenect.
//!
//! No kept Rust binding of libfreenect is sound, and one of our own could not
//! be safe code: the library's own recorder, `fakenect-record` of the package
//! libfreenect-bin, is run as a process of its own, and the pictures it writes
//! are read and deleted. Under `fakenect FOLDER drive …` it replays a recording
//! instead: nothing here knows the difference.

mod raw;

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use raw::{HEIGHT, WIDTH, registered};

use super::frame_stream::Take;
use crate::frame::Camera;
use crate::geometry::Pose;
use crate::recording::TimedFrame;

/// How often the recorder's folder is looked at; a picture comes every 33 ms.
const AGAIN: Duration = Duration::from_millis(10);
/// Depth and colour farther apart than this are not of one moment, seconds.
const TOGETHER_S: f64 = 0.05;
/// The recorder's name, which is also the name of the program.
const RECORDER: &str = "fakenect-record";

/// The recorder; it ends when this is dropped, or when it next tells a process that is gone of a picture.
struct Recorder {
    child: Child,
    folder: tempfile::TempDir,
}

impl Recorder {
    fn start() -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|error| format!("no place for the pictures: {error}"))?;
        let started = Command::new(RECORDER)
            .arg(folder.path().join("frames"))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = started.map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => format!("no program `{RECORDER}`: run `sudo apt install libfreenect-bin`"),
            _ => format!("{RECORDER}: {error}"),
        })?;
        // It names each picture; a full pipe would hold it up.
        if let Some(mut names) = child.stdout.take() {
            std::thread::spawn(move || std::io::copy(&mut names, &mut std::io::sink()));
        }
        Ok(Self { child, folder })
    }

    fn frames(&self) -> PathBuf {
        self.folder.path().join("frames")
    }

    /// Why it has ended, once it has.
    fn ended(&mut self) -> Option<String> {
        let status = self.child.try_wait().ok().flatten()?;
        let mut said = String::new();
        if let Some(stderr) = &mut self.child.stderr {
            // What cannot be read is not worth telling.
            let _ = stderr.read_to_string(&mut said);
        }
        let said = said.trim().replace('\n', "; ");
        if status.success() && said.is_empty() {
            return Some("the recording has ended".to_string());
        }
        Some(format!("{RECORDER}: {said}; is the Kinect plugged in, and powered? (group `plugdev`, no other program)"))
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A picture as the recorder names it: `d-SECONDS-STAMP.pgm` is depth, `r-….ppm` colour.
#[derive(Clone, Debug, PartialEq)]
struct Picture {
    path: PathBuf,
    kind: char,
    time_s: f64,
}

impl Picture {
    fn named(path: PathBuf) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let (kind, rest) = (name.chars().next()?, name.get(2..)?);
        let time_s = rest.split('-').next()?.parse().ok()?;
        Some(Self { kind, time_s, path })
    }

    /// The pixels, when all of them have been written.
    fn pixels(&self) -> Option<Vec<u8>> {
        let bytes = std::fs::read(&self.path).ok()?;
        let header = bytes.iter().position(|byte| *byte == b'\n')? + 1;
        let wanted = WIDTH * HEIGHT * if self.kind == 'd' { 2 } else { 3 };
        (bytes.len() == header + wanted).then(|| bytes[header..].to_vec())
    }
}

fn pictures(folder: &Path) -> Vec<Picture> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut pictures: Vec<Picture> = entries.filter_map(|entry| Picture::named(entry.path())).collect();
    pictures.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    pictures
}

/// Hands over frames until `take` wants no more, or the Kinect gives no more.
pub(super) fn stream(take: &mut Take) -> Result<(), String> {
    let mut recorder = Recorder::start()?;
    let on_tower = Camera::kinect().world_from_camera(Pose::default());
    loop {
        let ended = recorder.ended();
        let pictures = pictures(&recorder.frames());
        let frame = newest_pair(&pictures).and_then(|(depth, color)| {
            let pixels = (depth.pixels()?, color.pixels()?);
            let frame = registered(&pixels.0, &pixels.1, on_tower);
            Some((depth.time_s.min(color.time_s), TimedFrame::at(depth.time_s, None, frame)))
        });
        let done = match &frame {
            Some((time_s, _)) => *time_s,
            // Nothing stays that can no longer find its partner.
            None => pictures.last().map_or(0.0, |last| last.time_s - 1.0),
        };
        for old in pictures.iter().filter(|picture| picture.time_s <= done) {
            // One that cannot be deleted is looked at once more.
            let _ = std::fs::remove_file(&old.path);
        }
        if !take(frame.map(|(_, frame)| frame)) {
            return Ok(());
        }
        if let Some(why) = ended {
            return Err(why);
        }
        std::thread::sleep(AGAIN);
    }
}

/// The newest depth picture that has a colour picture of the same moment.
fn newest_pair(pictures: &[Picture]) -> Option<(&Picture, &Picture)> {
    let of = |kind: char| pictures.iter().rev().filter(move |picture| picture.kind == kind);
    of('d').find_map(|depth| {
        let color = of('r').find(|color| (color.time_s - depth.time_s).abs() <= TOGETHER_S)?;
        // The last one of each kind may still be being written.
        (depth.pixels().is_some() && color.pixels().is_some()).then_some((depth, color))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(name: &str) -> Picture {
        Picture::named(PathBuf::from(name)).expect("a picture")
    }

    #[test]
    fn pictures_are_told_by_their_names() {
        let depth = picture("/x/d-1795731174.532679-0.pgm");
        assert_eq!((depth.kind, depth.time_s), ('d', 1_795_731_174.532_679));
        assert_eq!(Picture::named(PathBuf::from("/x/INDEX.txt")), None);
    }

    #[test]
    fn a_depth_picture_without_a_colour_picture_of_its_moment_is_no_pair() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, bytes: usize| {
            let header: &[u8] = if name.starts_with('d') { b"P5 640 480 65535\n" } else { b"P6 640 480 255 \n" };
            std::fs::write(folder.path().join(name), [header, &vec![0; bytes]].concat()).expect("written");
        };
        write("d-10.00-1.pgm", WIDTH * HEIGHT * 2);
        write("r-10.20-2.ppm", WIDTH * HEIGHT * 3);
        assert_eq!(newest_pair(&pictures(folder.path())), None);
        write("r-10.02-1.ppm", WIDTH * HEIGHT * 3);
        // Not whole yet: the pair before it is the newest.
        write("d-10.21-2.pgm", 1000);
        let pictures = pictures(folder.path());
        let (depth, color) = newest_pair(&pictures).expect("a pair");
        assert_eq!((depth.time_s, color.time_s), (10.0, 10.02));
    }
}
