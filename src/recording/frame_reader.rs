//! RGB-D frames out of a log: depth, colour, camera and pose of one moment brought together.

use std::collections::{BTreeMap, VecDeque};
use std::io::Read;

use super::assembly::Assembly;
use super::sensed::{Reading, decode, reading_of};
use super::{LogError, LogReader, Loss, TimedFrame, Window};
use crate::perception::Told;

/// Which frames of a log are wanted.
#[derive(Clone, Debug, Default)]
pub struct FrameOptions {
    /// Topics of pictures to read; empty takes the first of colour and of depth, by type.
    pub topics: Vec<String>,
    /// The part of the log to read.
    pub window: Window,
    /// Salvage what is left of damaged chunks.
    pub recover: bool,
    /// What is known of the camera of frames whose transforms do not tell where it was.
    pub told: Told,
}

/// The frames of a log, and everything that was lost or skipped on the way.
pub struct FrameReader<M> {
    log: M,
    window: Window,
    assembly: Assembly,
    ready: VecDeque<Result<TimedFrame, Loss>>,
    channels: BTreeMap<String, Seen>,
    frames: usize,
    newest_ns: u64,
    ended: bool,
}

/// Messages of a log, and what was lost of them.
pub trait Messages: Iterator<Item = Result<mcap::Message<'static>, Loss>> {}
impl<I: Iterator<Item = Result<mcap::Message<'static>, Loss>>> Messages for I {}

/// A message this much earlier than one before it is out of order, nanoseconds.
const DISORDER_NS: u64 = 1_000_000_000;

/// What was seen of a topic.
struct Seen {
    schema: String,
    encoding: String,
    reading: Reading,
    messages: u64,
}

impl<R: Read> FrameReader<LogReader<R>> {
    /// Reads from `source`; `name` is what errors call it.
    ///
    /// # Errors
    /// When the source does not begin as an MCAP log.
    pub fn new(source: R, name: &str, options: FrameOptions) -> Result<Self, LogError> {
        Ok(Self::of(LogReader::new(source, name, options.recover)?, options))
    }
}

impl<M: Messages> FrameReader<M> {
    /// Makes frames of messages that are in the order of their times.
    pub fn of(messages: M, options: FrameOptions) -> Self {
        Self {
            log: messages,
            window: options.window,
            assembly: Assembly::new(options.topics, options.told),
            ready: VecDeque::new(),
            channels: BTreeMap::new(),
            frames: 0,
            newest_ns: 0,
            ended: false,
        }
    }

    /// What the frames are made of.
    pub fn messages(&self) -> &M {
        &self.log
    }

    /// Says once when a stream is not in the order of its times, which frames are put together by.
    fn watch_order(&mut self, log_ns: u64) {
        if log_ns + DISORDER_NS < self.newest_ns {
            let back_s = (self.newest_ns - log_ns) as f64 / 1e9;
            let what = format!(
                "the log is not in the order of its times (a message is {back_s:.1} s earlier than one before it), and \
                 what comes too late is not used: sort it by `mcap sort`, or give it as a file"
            );
            self.ready.extend(self.assembly.losses.note("messages out of order", what).map(Err));
        }
        self.newest_ns = self.newest_ns.max(log_ns);
    }

    fn take(&mut self, message: &mcap::Message) {
        self.watch_order(message.log_time);
        let topic = message.channel.topic.as_str();
        if !self.channels.contains_key(topic) {
            self.meet(message);
        }
        let Some(seen) = self.channels.get_mut(topic) else { return };
        seen.messages += 1;
        // Transforms from before the window still say where things are in it.
        let wanted = self.window.holds(message.log_time);
        if seen.reading != Reading::Known || (!wanted && !is_lasting(&seen.schema)) {
            return;
        }
        match decode(message) {
            Ok(sensed) => self.ready.extend(self.assembly.take(topic, message.log_time, sensed)),
            Err(what) => {
                let schema = &seen.schema;
                let what = format!("a message on {topic} at {} ns is no {schema}: {what}", message.log_time);
                self.ready.extend(self.assembly.losses.note("undecodable messages", what).map(Err));
            }
        }
    }

    fn meet(&mut self, message: &mcap::Message) {
        let channel = &message.channel;
        let schema = channel.schema.as_ref().map(|schema| schema.name.clone()).unwrap_or_default();
        let seen =
            Seen { schema, encoding: channel.message_encoding.clone(), reading: reading_of(channel), messages: 0 };
        if seen.reading == Reading::UnknownEncoding {
            let (topic, Seen { schema, encoding, .. }) = (&channel.topic, &seen);
            let what = format!("{topic} ({schema}) is skipped: its encoding `{encoding}` is not read");
            self.ready.push_back(Err(Loss(format!("{what}; cdr, ros1 and Foxglove protobuf are"))));
        }
        self.channels.insert(channel.topic.clone(), seen);
    }

    fn end(&mut self) {
        self.ended = true;
        self.ready.extend(self.assembly.finish());
        let waiting = self.ready.iter().filter(|item| item.is_ok()).count();
        if self.frames + waiting > 0 {
            return;
        }
        let topics = self.channels.iter();
        let topics: Vec<String> = topics
            .map(|(topic, s)| format!("{topic} ({}, {}, {} messages)", s.schema, s.encoding, s.messages))
            .collect();
        let has = if topics.is_empty() { "no messages at all".to_string() } else { topics.join(", ") };
        let doubtful = self.assembly.doubtful.values().map(|why| format!("; {why}")).collect::<String>();
        self.ready.push_back(Err(Loss(format!("no frame in this log; it has {has}{doubtful}"))));
    }
}

fn is_lasting(schema: &str) -> bool {
    ["TFMessage", "tfMessage", "FrameTransform", "CameraInfo", "CameraCalibration"]
        .iter()
        .any(|name| schema.contains(name))
}

impl<M: Messages> Iterator for FrameReader<M> {
    type Item = Result<TimedFrame, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.ready.is_empty() && !self.ended {
            match self.log.next() {
                None => self.end(),
                Some(Err(loss)) => self.ready.push_back(Err(loss)),
                Some(Ok(message)) => self.take(&message),
            }
        }
        let item = self.ready.pop_front()?;
        self.frames += usize::from(item.is_ok());
        Some(item)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Intrinsics, RgbdFrame};
    use crate::geometry::Pose;
    use crate::recording::FrameWriter;

    fn frame(depth: u16) -> RgbdFrame {
        RgbdFrame {
            width: 2,
            height: 1,
            color: vec![[1, 2, 3], [4, 5, 6]],
            depth: vec![depth, 0],
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: 525.0, fy: 520.0, cx: 0.5, cy: 0.25 },
            world_from_camera: [
                [0.0, 0.0, 1.0, 3.0],
                [-1.0, 0.0, 0.0, -2.0],
                [0.0, -1.0, 0.0, 1.2],
                [0.0, 0.0, 0.0, 1.0],
            ],
        }
    }

    fn written(count: u16) -> Vec<u8> {
        let mut writer = FrameWriter::new(Vec::new()).expect("begun");
        for i in 0..count {
            let robot = Some(Pose::new(f64::from(i), 0.5, 0.25));
            writer.write(&TimedFrame::at(f64::from(i) * 0.1, robot, frame(1000 + i))).expect("written");
        }
        writer.finish().expect("finished")
    }

    fn read(bytes: &[u8], recover: bool) -> (Vec<TimedFrame>, Vec<String>) {
        let options = FrameOptions { recover, ..FrameOptions::default() };
        let reader = FrameReader::new(bytes, "log", options).expect("a log");
        let (frames, losses): (Vec<_>, Vec<_>) = reader.partition(Result::is_ok);
        (frames.into_iter().flatten().collect(), losses.into_iter().filter_map(Result::err).map(|l| l.0).collect())
    }

    #[test]
    fn frames_come_back_as_they_were_written() {
        let (frames, losses) = read(&written(3), false);
        assert_eq!(losses, [""; 0]);
        let depths: Vec<u16> = frames.iter().map(|f| f.frame.depth[0]).collect();
        assert_eq!(depths, [1000, 1001, 1002]);
        let (got, want) = (&frames[1].frame, frame(1001));
        assert_eq!((&got.color, got.intrinsics, frames[1].stamp_ns), (&want.color, want.intrinsics, 100_000_000));
        let pairs = got.world_from_camera.iter().flatten().zip(want.world_from_camera.iter().flatten());
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "{:?}", got.world_from_camera);
        let robot = frames[1].robot.expect("known");
        assert!((robot.x - 1.0).abs() < 1e-12 && (robot.heading - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_frame_is_given_out_before_the_next_one_is_written() {
        // Everything up to the second frame's end, and nothing after it.
        let two = written(2);
        let three = written(3);
        let same = two.iter().zip(&three).take_while(|(a, b)| a == b).count();
        let mut reader = FrameReader::new(&three[..same], "pipe", FrameOptions::default()).expect("a log");
        for depth in [1000, 1001] {
            assert_eq!(reader.next().expect("there").expect("whole").frame.depth[0], depth);
        }
    }

    #[test]
    fn a_cut_log_gives_what_is_whole_and_says_so() {
        let bytes = written(3);
        let index = bytes.len() / 2;
        let (frames, losses) = read(&bytes[..index], false);
        assert!(!frames.is_empty() && frames.len() < 3);
        assert!(losses[0].contains("cut off here"), "{losses:?}");
    }

    #[test]
    fn flipped_bytes_cost_their_chunk_only() {
        let mut bytes = written(3);
        let colors: Vec<usize> = (0..bytes.len() - 6).filter(|&at| bytes[at..at + 6] == [1, 2, 3, 4, 5, 6]).collect();
        bytes[colors[1]] ^= 0xff;
        let (frames, losses) = read(&bytes, false);
        let depths: Vec<u16> = frames.iter().map(|f| f.frame.depth[0]).collect();
        assert_eq!(depths, [1000, 1002]);
        assert!(losses[0].contains("damaged chunk"), "{losses:?}");
        let (frames, losses) = read(&bytes, true);
        assert_eq!(frames.len(), 3);
        assert!(losses[0].contains("no checksum vouches"), "{losses:?}");
    }

    proptest::proptest! {
        #[test]
        fn whatever_is_done_to_a_log_reading_it_ends_without_a_panic(
            changes in proptest::collection::vec((0.0..1.0, proptest::prelude::any::<u8>()), 1..8),
            cut in 0.0..2.0,
        ) {
            let mut bytes = written(2);
            for (place, byte) in changes {
                let at = (place * bytes.len() as f64) as usize;
                bytes[at] = byte;
            }
            bytes.truncate((cut * bytes.len() as f64) as usize);
            for recover in [false, true] {
                if let Ok(frames) = FrameReader::new(&bytes[..], "log", FrameOptions { recover, ..FrameOptions::default() }) {
                    frames.for_each(drop);
                }
            }
        }
    }

    #[test]
    fn a_log_without_frames_names_what_it_has() {
        let (_, losses) = read(&written(0), false);
        assert!(losses[0].contains("no frame in this log"), "{losses:?}");
    }
}
