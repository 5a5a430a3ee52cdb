//! The schema of the record topics: every key the stages add.

use std::sync::LazyLock;

use schemars::JsonSchema;

use crate::record::{Chunk, Grounding, Plan, Token, Trial};

/// A record as it travels; each topic has the keys up to its stage, and any others.
#[derive(JsonSchema)]
#[allow(dead_code)]
struct Record {
    id: Option<String>,
    text: Option<String>,
    tokens: Option<Vec<Token>>,
    chunks: Option<Vec<Chunk>>,
    grounding: Option<Grounding>,
    plan: Option<Plan>,
    trial: Option<Trial>,
}

/// The schema's text.
pub(super) static RECORD_SCHEMA: LazyLock<String> =
    LazyLock::new(|| schemars::schema_for!(Record).as_value().to_string());
