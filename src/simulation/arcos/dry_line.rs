//! A line that touches nothing: an ideal robot answers, and every command is printed.

use std::io::{self, Write};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use super::{Server, ServerSettings};
use crate::geometry::Pose;
use crate::robot::arcos::codec::{Command, Decoder, number};
use crate::robot::arcos::line::Line;
use crate::simulation::base::{Obstacles, SimulatedBase};

/// How often the ideal robot lives on.
const TICK: Duration = Duration::from_millis(10);

/// Prints commands, by the names of the manual, on standard error.
pub struct DryLine {
    commands: Sender<Vec<u8>>,
    answers: Receiver<Vec<u8>>,
    waiting: Vec<u8>,
    decoder: Decoder,
    synchronised: bool,
    opened: Instant,
}

/// Whoever listened may have gone, as `head` does: no reason to fail.
fn say(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

impl Default for DryLine {
    fn default() -> Self {
        let (commands, from_client) = channel::<Vec<u8>>();
        let (to_client, answers) = channel();
        // The simulated base does not leave its thread. It ends when either end of the line is dropped.
        std::thread::spawn(move || {
            let base = SimulatedBase::new(Obstacles::nothing(), Pose::default());
            let mut server = Server::new(base, ServerSettings::default());
            let began = Instant::now();
            loop {
                match from_client.recv_timeout(TICK) {
                    Ok(bytes) => server.receive(&bytes),
                    Err(std::sync::mpsc::RecvTimeoutError::Disconnected) => return,
                    Err(std::sync::mpsc::RecvTimeoutError::Timeout) => {}
                }
                server.advance_to(began.elapsed());
                let output = server.take_output();
                if !output.is_empty() && to_client.send(output).is_err() {
                    return;
                }
            }
        });
        Self {
            commands,
            answers,
            waiting: Vec::new(),
            decoder: Decoder::default(),
            synchronised: false,
            opened: Instant::now(),
        }
    }
}

impl Line for DryLine {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        if self.waiting.is_empty()
            && let Ok(bytes) = self.answers.recv_timeout(wait)
        {
            self.waiting.extend(bytes);
        }
        while let Ok(bytes) = self.answers.try_recv() {
            self.waiting.extend(bytes);
        }
        let count = self.waiting.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.waiting[..count]);
        self.waiting.drain(..count);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.decoder.push(bytes, self.now());
        while let Some(packet) = self.decoder.next(self.now()) {
            let now = self.now().as_secs_f64();
            // Before OPEN, the numbers of PULSE, OPEN and CLOSE are the three of synchronisation.
            if !self.synchronised && packet.kind <= 2 {
                say(&format!("{now:8.3} SYNC{}", packet.kind));
                self.synchronised = packet.kind == 2;
            } else if packet.kind != number::PULSE {
                say(&format!("{now:8.3} {}", Command::from_packet(&packet)));
            }
        }
        self.commands.send(bytes.to_vec()).map_err(|_| io::ErrorKind::BrokenPipe.into())
    }

    fn reopen(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn now(&self) -> Duration {
        self.opened.elapsed()
    }

    fn name(&self) -> String {
        "dry run".to_string()
    }
}
