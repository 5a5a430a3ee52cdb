//! Records back out of a log.

use std::path::Path;

/// Why a log cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be read.
    #[error("{0}: {1}")]
    Unreadable(String, std::io::Error),
    /// The file is no MCAP, or a damaged one.
    #[error("{file}: after {messages} messages: {message}")]
    Damaged {
        /// The file.
        file: String,
        /// Messages read before the damage.
        messages: usize,
        /// What is wrong.
        message: String,
    },
}

/// The record messages of a log (`/fetch/record`), in order, byte for byte.
pub fn records(path: &Path) -> Result<Vec<String>, LogError> {
    let file = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| LogError::Unreadable(file.clone(), error))?;
    let damaged = |messages, message: String| LogError::Damaged { file: file.clone(), messages, message };
    let stream = mcap::MessageStream::new(&bytes).map_err(|error| damaged(0, error.to_string()))?;
    let (mut lines, mut count) = (Vec::new(), 0);
    for message in stream {
        let message = message.map_err(|error| damaged(count, error.to_string()))?;
        count += 1;
        if message.channel.topic == "/fetch/record" {
            let line = String::from_utf8(message.data.into_owned());
            lines.push(line.map_err(|_| damaged(count, "a record that is not UTF-8".to_string()))?);
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_log_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("no.mcap");
        std::fs::write(&path, "hello").expect("written");
        let error = records(&path).expect_err("no log").to_string();
        assert!(error.contains("no.mcap: after 0 messages"), "{error}");
    }
}
