//! `--jobs` and progress for work that is no filter.

use super::{Common, Failure, Progress, on_interrupt};

/// Does `work` with its parallel parts on so many threads; 0 is one for each core.
///
/// # Errors
/// When the threads cannot be started, or what `work` answers.
pub fn on_threads<T: Send>(jobs: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    // Nothing is open yet that would have to be closed: an interrupt wants the exit code only.
    on_interrupt(|| ());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
    let pool = pool.map_err(|error| Failure::Failed(format!("cannot start {jobs} threads: {error}")))?;
    Ok(pool.install(work))
}

/// The same, counted on standard error: `work` calls what it is given once for each of the `total` things done.
///
/// # Errors
/// When the threads cannot be started, or what `work` answers.
pub fn counted_on_threads<T: Send>(
    common: &Common,
    total: u64,
    work: impl FnOnce(&(dyn Fn() + Sync)) -> T + Send,
) -> Result<T, Failure> {
    let progress = Progress::new(common, Some(total));
    let done = || progress.add(1);
    on_threads(common.jobs, || work(&done))
}
