//! `--jobs` for work that is no filter.

use super::Failure;

/// Does `work` with its parallel parts on so many threads; 0 is one for each core.
pub fn on_threads<T: Send>(jobs: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
    let pool = pool.map_err(|error| Failure::Failed(format!("cannot start {jobs} threads: {error}")))?;
    Ok(pool.install(work))
}
