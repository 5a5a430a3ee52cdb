//! Which topic plays which part: found by type, or named by the user.

/// The topics in use.
#[derive(Clone, Debug, Default)]
pub(super) struct Roles {
    named: Vec<String>,
    depth: Option<String>,
    color: Option<String>,
    odometry: Option<String>,
}

impl Roles {
    pub(super) fn new(named: Vec<String>) -> Self {
        Self { named, ..Self::default() }
    }

    pub(super) fn has_color(&self) -> bool {
        self.color.is_some()
    }

    /// Whether a picture on this topic is read; an error says that it is passed over and how to have it.
    pub(super) fn takes_picture(&mut self, topic: &str, is_depth: bool) -> Result<bool, String> {
        let is_named = self.named.iter().any(|name| name == topic);
        if !self.named.is_empty() && !is_named {
            return Ok(false);
        }
        let (role, what) = if is_depth { (&mut self.depth, "depth") } else { (&mut self.color, "colour") };
        let chosen = role.get_or_insert_with(|| topic.to_string());
        // The same pictures compressed in another way are no loss.
        let same_source =
            chosen == topic || topic.starts_with(&format!("{chosen}/")) || chosen.starts_with(&format!("{topic}/"));
        if same_source || !self.named.is_empty() {
            return Ok(chosen == topic);
        }
        Err(format!(
            "{what} pictures are read from {chosen}; those on {topic} are passed over (--topic {topic} reads them)"
        ))
    }

    /// Whether odometry on this topic is read: a named one, else the first.
    pub(super) fn takes_odometry(&mut self, topic: &str) -> bool {
        if self.named.iter().any(|name| name == topic) {
            self.odometry = Some(topic.to_string());
        }
        self.odometry.get_or_insert_with(|| topic.to_string()) == topic
    }
}
