//! What happens on signals: what must be brought to rest is, and then what the signal says is done.
//!
//! Signals that end a process end it after the actions: INT, TERM and HUP
//! with 130, the others as they always do (QUIT with its core dump). Ctrl-Z
//! suspends it, after what moves stands. A file that may not grow (XFSZ) is an
//! error of the write, as a closed pipe is. What cannot be caught – KILL,
//! STOP, a failed allocation's abort – is left to `robot::standby`.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use signal_hook::consts::*;
use signal_hook::iterator::{Handle, Signals};
use signal_hook::low_level::emulate_default_handler;

use super::exit::INTERRUPTED;
use crate::files;

type Action = Box<dyn FnOnce() + Send>;

/// No action takes longer.
const LONGEST_GOOD_BYE: Duration = Duration::from_secs(10);
/// Signals that end a process, of those that can be caught.
const ENDING: [i32; 11] =
    [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU, SIGABRT];
/// Signals that suspend it.
const SUSPENDING: [i32; 3] = [SIGTSTP, SIGTTIN, SIGTTOU];

static UNDER_WAY: AtomicBool = AtomicBool::new(false);
static ACTIONS: Mutex<Vec<Action>> = Mutex::new(Vec::new());
static PAUSES: Mutex<Vec<Arc<dyn Pause>>> = Mutex::new(Vec::new());
static LISTENER: OnceLock<Option<Handle>> = OnceLock::new();

/// Something that must stand while the process is suspended.
pub trait Pause: Send + Sync {
    /// Brings it to rest; returns when it is.
    fn pause(&self);
    /// The process goes on.
    fn go_on(&self);
}

fn locked<T>(list: &Mutex<Vec<T>>) -> MutexGuard<'_, Vec<T>> {
    list.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Listens from now on: the first thing a program does, so that no signal comes before it is heard.
pub(super) fn listen() {
    LISTENER.get_or_init(|| {
        // Without listener a signal still ends the process, only less tidily.
        let _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
        let mut signals = Signals::new(ENDING).ok()?;
        let handle = signals.handle();
        let thread = std::thread::Builder::new().name("signals".to_string());
        thread.spawn(move || signals.forever().for_each(heard)).ok().map(|_| handle)
    });
}

/// Runs `action` when the process is told to end, before it does.
///
/// Actions run in the order given, on a thread of their own. A second call
/// adds to the first; one that comes when the process is about to end runs at once.
pub fn on_interrupt(action: impl FnOnce() + Send + 'static) {
    listen();
    if UNDER_WAY.load(Ordering::SeqCst) {
        return action();
    }
    locked(&ACTIONS).push(Box::new(action));
}

/// Brings `thing` to rest before the process is suspended, as by Ctrl-Z, and tells it when the process goes on.
pub fn on_suspend(thing: Arc<dyn Pause>) {
    listen();
    locked(&PAUSES).push(thing);
    for signal in SUSPENDING {
        if let Some(Some(handle)) = LISTENER.get() {
            // Without it the signal suspends the process as ever.
            let _ = handle.add_signal(signal);
        }
    }
}

/// Waits for the process to end when it has been told to: a program that finishes meanwhile was interrupted all the same.
pub fn yield_to_interrupt() {
    if UNDER_WAY.load(Ordering::SeqCst) {
        std::thread::sleep(LONGEST_GOOD_BYE);
    }
}

fn heard(signal: i32) {
    if SUSPENDING.contains(&signal) { suspend(signal) } else { end(signal) }
}

fn suspend(signal: i32) {
    let things = locked(&PAUSES).clone();
    things.iter().for_each(|thing| thing.pause());
    // It returns when the process goes on.
    let _ = emulate_default_handler(signal);
    things.iter().for_each(|thing| thing.go_on());
}

fn end(signal: i32) {
    UNDER_WAY.store(true, Ordering::SeqCst);
    let waiting = std::mem::take(&mut *locked(&ACTIONS));
    for action in waiting {
        action();
    }
    files::end_writing();
    if !matches!(signal, SIGINT | SIGTERM | SIGHUP) {
        // It does not return, but for a signal that it does not know.
        let _ = emulate_default_handler(signal);
    }
    std::process::exit(i32::from(INTERRUPTED));
}
