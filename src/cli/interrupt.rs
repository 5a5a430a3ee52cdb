//! What happens on SIGINT, SIGTERM and SIGHUP.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Duration;

use super::exit::INTERRUPTED;
use crate::files;

type Action = Box<dyn FnOnce() + Send>;

/// No action takes longer.
const LONGEST_GOOD_BYE: Duration = Duration::from_secs(10);

static UNDER_WAY: AtomicBool = AtomicBool::new(false);
static ACTIONS: OnceLock<Mutex<Vec<Action>>> = OnceLock::new();

/// Runs `action` when the process is told to stop, before it exits with 130.
///
/// Actions run in the order given, on a thread of their own. A second call
/// adds to the first.
pub fn on_interrupt(action: impl FnOnce() + Send + 'static) {
    let actions = ACTIONS.get_or_init(|| {
        // Without the handler an interrupt still ends the process, only less tidily.
        let _ = ctrlc::set_handler(stop);
        Mutex::new(Vec::new())
    });
    actions.lock().unwrap_or_else(PoisonError::into_inner).push(Box::new(action));
}

/// Waits for the process to end when it has been told to: a program that finishes meanwhile was interrupted all the same.
pub fn yield_to_interrupt() {
    if UNDER_WAY.load(Ordering::SeqCst) {
        std::thread::sleep(LONGEST_GOOD_BYE);
    }
}

fn stop() {
    UNDER_WAY.store(true, Ordering::SeqCst);
    if let Some(actions) = ACTIONS.get() {
        let waiting = std::mem::take(&mut *actions.lock().unwrap_or_else(PoisonError::into_inner));
        for action in waiting {
            action();
        }
    }
    files::end_writing();
    std::process::exit(i32::from(INTERRUPTED));
}
