//! Messages of a log file in the order of their times, however they were written: one topic after the other, say.

use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

use mcap::Message;
use mcap::read::ChannelAccumulator;
use mcap::records::op;

use super::Loss;
use super::chunk::{Allowance, Messages, unpack};
use super::link::link;
use super::log_reader::messages_of_chunk;
use super::survey::{Entry, Survey};
use crate::limits::MCAP_RECORD_BYTES;

/// What was read and is not handed on yet.
enum Held {
    Chunk(Messages),
    One(Message<'static>),
}

/// Reads each chunk when its time has come; only chunks that overlap in time are held together.
pub struct SortedLog {
    file: File,
    recover: bool,
    entries: VecDeque<Entry>,
    links: ChannelAccumulator<'static>,
    allowance: Allowance,
    /// By the time of the next message of each, and by the order read.
    pending: BTreeMap<(u64, u64), Held>,
    count: u64,
    lost: VecDeque<Loss>,
}

impl SortedLog {
    pub(super) fn new(file: File, survey: Survey, recover: bool) -> io::Result<Self> {
        let mut entries = survey.entries;
        entries.sort_by_key(|entry| entry.first_ns);
        let mut log = Self {
            file,
            recover,
            entries: entries.into(),
            links: ChannelAccumulator::default(),
            allowance: Allowance::default(),
            pending: BTreeMap::new(),
            count: 0,
            lost: VecDeque::new(),
        };
        for at in &survey.links {
            let (opcode, body) = log.record(*at)?;
            // What is damaged shows again when a message needs it.
            let _ = link(opcode, &body, &mut log.links);
        }
        if survey.links.is_empty() {
            log.link_chunks()?;
        }
        Ok(log)
    }

    /// A log without an index tells its channels only in the chunks that stand first.
    fn link_chunks(&mut self) -> io::Result<()> {
        let mut places: Vec<u64> = self.entries.iter().map(|entry| entry.at_byte).collect();
        places.sort_unstable();
        let mut allowance = Allowance::default();
        for at in places {
            let (opcode, body) = self.record(at)?;
            if opcode == op::CHUNK {
                unpack(body.len() as u64, &body, &mut self.links, &mut allowance, true);
            }
        }
        Ok(())
    }

    /// The kind and body of a record, which the survey found to be whole.
    fn record(&mut self, at_byte: u64) -> io::Result<(u8, Vec<u8>)> {
        self.file.seek(SeekFrom::Start(at_byte))?;
        let mut head = [0; 9];
        self.file.read_exact(&mut head)?;
        let length = u64::from_le_bytes(std::array::from_fn(|i| head[1 + i]));
        if length > MCAP_RECORD_BYTES.value {
            return Err(io::Error::other(format!("a record of {length} bytes is too long to be read")));
        }
        let mut body = Vec::new();
        self.file.by_ref().take(length).read_to_end(&mut body)?;
        Ok((head[0], body))
    }

    fn load(&mut self, entry: Entry) {
        let (opcode, body) = match self.record(entry.at_byte) {
            Ok(record) => record,
            Err(error) => return self.lost.push_back(Loss::at(entry.at_byte, error)),
        };
        self.count += 1;
        if opcode == op::CHUNK {
            let (messages, loss) =
                messages_of_chunk(entry.at_byte, &body, &mut self.links, &mut self.allowance, self.recover);
            self.lost.extend(loss);
            return self.hold(messages, self.count);
        }
        match link(opcode, &body, &mut self.links) {
            Ok(Some(message)) => {
                self.pending.insert((message.log_time, self.count), Held::One(message));
            }
            Ok(None) => {}
            Err(error) => self.lost.push_back(Loss::at(entry.at_byte, format!("damaged record, left out: {error}"))),
        }
    }

    fn hold(&mut self, messages: Messages, number: u64) {
        if let Some(time) = messages.next_ns() {
            self.pending.insert((time, number), Held::Chunk(messages));
        }
    }

    fn next_held(&mut self) -> Option<Message<'static>> {
        let ((_, number), held) = self.pending.pop_first()?;
        match held {
            Held::One(message) => Some(message),
            Held::Chunk(mut messages) => {
                let message = messages.next(&mut self.links);
                self.hold(messages, number);
                message
            }
        }
    }
}

impl Iterator for SortedLog {
    type Item = Result<Message<'static>, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(loss) = self.lost.pop_front() {
                return Some(Err(loss));
            }
            let due = self.pending.first_key_value().map(|(&(time, _), _)| time);
            match self.entries.front() {
                Some(&entry) if due.is_none_or(|due| entry.first_ns <= due) => {
                    self.entries.pop_front();
                    self.load(entry);
                }
                _ => return self.next_held().map(Ok),
            }
        }
    }
}
