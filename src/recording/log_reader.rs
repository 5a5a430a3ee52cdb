//! Messages out of an MCAP log, from a file, a pipe or a log still being written.
//!
//! Records are framed here, so that a damaged chunk is named by its place and
//! the next one still read; chunks and everything else are the mcap crate's
//! work (format: mcap.dev/spec).

use std::collections::VecDeque;
use std::io::{self, Read};

use mcap::Message;
use mcap::read::{ChannelAccumulator, parse_record};
use mcap::records::{Record, op};

use super::chunk::{Allowance, Messages, unpack};
use super::link::link;
use super::{LogError, Loss};
use crate::limits::MCAP_RECORD_BYTES;

/// A length beyond this is damage, bytes.
const IMPOSSIBLE: u64 = 1 << 42;

/// Kinds of records that bear on the messages.
const WANTED: [u8; 6] = [op::CHUNK, op::SCHEMA, op::CHANNEL, op::MESSAGE, op::DATA_END, op::FOOTER];
/// What is passed over is read in pieces, bytes.
const PIECE: usize = 1 << 16;

/// The messages of a log in its order, those of a chunk by their time, with everything that was lost on the way.
///
/// Checksums are checked before a message is given out. A log that is cut or
/// damaged gives everything its checksums vouch for; with `recover` also what
/// can be salvaged of damaged chunks.
pub struct LogReader<R> {
    source: R,
    recover: bool,
    at_byte: u64,
    checksum: crc32fast::Hasher,
    links: ChannelAccumulator<'static>,
    allowance: Allowance,
    /// What is left of the last chunk; it comes before what is ready.
    chunk: Messages,
    ready: VecDeque<Result<Message<'static>, Loss>>,
    whole: bool,
    state: State,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Data,
    /// What follows is index; it is read to the end so that the writer of a pipe is not cut off.
    Index,
    Ended,
}

impl<R: Read> LogReader<R> {
    /// Reads from `source`; `name` is what errors call it.
    ///
    /// # Errors
    /// When nothing can be read, or it is no MCAP log.
    pub fn new(mut source: R, name: &str, recover: bool) -> Result<Self, LogError> {
        let mut magic = [0; 8];
        match source.read_exact(&mut magic) {
            Err(error) if error.kind() != io::ErrorKind::UnexpectedEof => {
                return Err(LogError::System(name.to_string(), error));
            }
            _ if magic != mcap::MAGIC => return Err(LogError::NotMcap(name.to_string())),
            _ => {}
        }
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(&magic);
        Ok(Self {
            source,
            recover,
            at_byte: magic.len() as u64,
            checksum,
            links: ChannelAccumulator::default(),
            allowance: Allowance::default(),
            chunk: Messages::default(),
            ready: VecDeque::new(),
            whole: true,
            state: State::Data,
        })
    }

    /// Reads one record and makes its messages ready.
    fn advance(&mut self) {
        let begins = self.at_byte;
        let mut head = [0; 9];
        let got = self.fill(&mut head);
        let length = u64::from_le_bytes([head[1], head[2], head[3], head[4], head[5], head[6], head[7], head[8]]);
        if got < head.len() {
            return self.cut(begins);
        }
        if length > IMPOSSIBLE {
            return self.lose(Loss::at(begins, "damaged: a record with an impossible length; what follows is lost"));
        }
        let is_wanted = WANTED.contains(&head[0]);
        if !is_wanted || length > MCAP_RECORD_BYTES.value {
            return self.pass_over(begins, head, length, is_wanted);
        }
        let mut body = Vec::new();
        if let Err(error) = self.source.by_ref().take(length).read_to_end(&mut body) {
            return self.lose(Loss::at(begins, error));
        }
        self.at_byte += body.len() as u64;
        if (body.len() as u64) < length {
            if head[0] == op::CHUNK && self.recover {
                self.salvage(begins, length, &body);
            }
            return self.cut(begins);
        }
        self.take(begins, head, &body);
    }

    /// Reads past a record without holding it: an attachment may be larger than the memory.
    fn pass_over(&mut self, begins: u64, head: [u8; 9], length: u64, is_wanted: bool) {
        if self.state == State::Data {
            self.checksum.update(&head);
        }
        let (mut left, mut piece) = (length, vec![0; PIECE]);
        while left > 0 {
            let want = left.min(PIECE as u64) as usize;
            let got = self.fill(&mut piece[..want]);
            if self.state == State::Data {
                self.checksum.update(&piece[..got]);
            }
            if got < want {
                return self.cut(begins);
            }
            left -= got as u64;
        }
        if is_wanted {
            self.whole = false;
            let what = format!(
                "a record of {length} bytes is left out: no more than {} are read at once",
                MCAP_RECORD_BYTES.value
            );
            self.ready.push_back(Err(Loss::at(begins, what)));
        }
    }

    fn take(&mut self, begins: u64, head: [u8; 9], body: &[u8]) {
        if head[0] == op::DATA_END {
            self.check_data_section(begins, body);
            self.state = State::Index;
        } else if head[0] == op::FOOTER {
            let mut magic = [0; 8];
            self.fill(&mut magic);
            self.state = State::Ended;
        } else if self.state == State::Data {
            self.checksum.update(&head);
            self.checksum.update(body);
            match head[0] {
                op::CHUNK => self.take_chunk(begins, body),
                op::SCHEMA | op::CHANNEL | op::MESSAGE => self.take_plain(begins, head[0], body),
                _ => {}
            }
        }
    }

    fn take_chunk(&mut self, begins: u64, body: &[u8]) {
        let (messages, loss) = messages_of_chunk(begins, body, &mut self.links, &mut self.allowance, self.recover);
        self.whole &= loss.is_none();
        self.chunk = messages;
        self.ready.extend(loss.map(Err));
    }

    /// Takes what can be unpacked of a damaged or cut chunk.
    fn salvage(&mut self, begins: u64, length: u64, body: &[u8]) {
        let (messages, loss) = salvaged(begins, length, body, &mut self.links, &mut self.allowance);
        self.chunk = messages;
        self.ready.push_back(Err(loss));
    }

    fn take_plain(&mut self, begins: u64, opcode: u8, body: &[u8]) {
        match link(opcode, body, &mut self.links) {
            Ok(Some(message)) => self.ready.push_back(Ok(message)),
            Ok(None) => {}
            Err(error) => {
                self.whole = false;
                self.ready.push_back(Err(Loss::at(begins, format!("damaged record, left out: {error}"))));
            }
        }
    }

    /// Messages outside chunks are covered by no other checksum than this.
    fn check_data_section(&mut self, begins: u64, body: &[u8]) {
        let Ok(Record::DataEnd(end)) = parse_record(op::DATA_END, body) else { return };
        let found = self.checksum.clone().finalize();
        if self.whole && end.data_section_crc != 0 && end.data_section_crc != found {
            let what = "the log fails its checksum: something before here was changed";
            self.ready.push_back(Err(Loss::at(begins, what)));
        }
    }

    fn cut(&mut self, begins: u64) {
        if self.state == State::Index {
            // Only the index is missing, and nothing here needs it.
            self.state = State::Ended;
            return;
        }
        let hint = if self.recover { "" } else { "; --recover also reads what is left of its last chunk" };
        self.lose(Loss::at(begins, format!("the log is cut off here: everything before was read{hint}")));
    }

    fn lose(&mut self, loss: Loss) {
        self.ready.push_back(Err(loss));
        self.state = State::Ended;
    }

    /// Reads until `buffer` is full or the source ends; an error ends it too, and shows as a cut.
    fn fill(&mut self, buffer: &mut [u8]) -> usize {
        let mut got = 0;
        while got < buffer.len() {
            match self.source.read(&mut buffer[got..]) {
                Ok(0) => break,
                Ok(n) => got += n,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(_) => break,
            }
        }
        self.at_byte += got as u64;
        got
    }
}

impl<R: Read> Iterator for LogReader<R> {
    type Item = Result<Message<'static>, Loss>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(message) = self.chunk.next(&mut self.links) {
                return Some(Ok(message));
            }
            if !self.ready.is_empty() || self.state == State::Ended {
                return self.ready.pop_front();
            }
            self.advance();
        }
    }
}

/// The messages of a chunk, and what is wrong with it; of a damaged one nothing, or with `recover` what can be unpacked.
pub(super) fn messages_of_chunk(
    begins: u64,
    body: &[u8],
    links: &mut ChannelAccumulator<'static>,
    allowance: &mut Allowance,
    recover: bool,
) -> (Messages, Option<Loss>) {
    let unpacked = unpack(body.len() as u64, body, links, allowance, true);
    let Some(damage) = unpacked.damage else { return (unpacked.messages, None) };
    if recover {
        let (messages, loss) = salvaged(begins, body.len() as u64, body, links, allowance);
        return (messages, Some(loss));
    }
    let hint = "its messages are left out; --recover takes what can be unpacked, unchecked";
    (Messages::default(), Some(Loss::at(begins, format!("damaged chunk ({damage}): {hint}"))))
}

fn salvaged(
    begins: u64,
    length: u64,
    body: &[u8],
    links: &mut ChannelAccumulator<'static>,
    allowance: &mut Allowance,
) -> (Messages, Loss) {
    let unpacked = unpack(length, body, links, allowance, false);
    let messages = unpacked.messages;
    let damage = unpacked.damage.map_or(String::new(), |damage| format!(" ({damage})"));
    let what = format!("damaged chunk{damage}: {} messages salvaged, which no checksum vouches for", messages.count());
    (messages, Loss::at(begins, what))
}
