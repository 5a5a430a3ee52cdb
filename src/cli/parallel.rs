//! Work on as many threads as `--jobs` says, counted on standard error.

use std::sync::{Mutex, PoisonError};

use super::{Common, Failure, Progress};

/// Runs `work` on the threads that `--jobs` allows; it calls what it is given once for each of the `total` things done.
pub fn in_parallel<T: Send>(
    common: &Common,
    total: u64,
    work: impl FnOnce(&(dyn Fn() + Sync)) -> T + Send,
) -> Result<T, Failure> {
    let progress = Mutex::new(Progress::new(common, Some(total)));
    let done = || progress.lock().unwrap_or_else(PoisonError::into_inner).add(1);
    // Zero is every core.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(common.jobs).build();
    let pool = pool.map_err(|e| Failure::Failed(format!("cannot start {} threads: {e}", common.jobs)))?;
    Ok(pool.install(|| work(&done)))
}
