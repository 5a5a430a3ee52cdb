//! What the seven binaries share: arguments, JSON lines in and out, diagnostics, exit codes.
