//! Which topic plays which part: found by type, or named by the user.

use super::sensed::Image;

/// The topics in use.
#[derive(Clone, Debug, Default)]
pub(super) struct Roles {
    named: Vec<String>,
    depth: Option<String>,
    color: Option<String>,
}

/// What is done with a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Depth,
    Color,
    /// Another topic has its part, in another packing.
    Double,
    /// Passed over; why, and how to have it.
    Passed(String),
    /// It may be infrared or grey as well as depth or colour; why it is no part of a frame.
    Doubtful(String),
}

impl Roles {
    pub(super) fn new(named: Vec<String>) -> Self {
        Self { named, ..Self::default() }
    }

    pub(super) fn has_color(&self) -> bool {
        self.color.is_some()
    }

    /// What part a picture on this topic plays.
    pub(super) fn of(&mut self, topic: &str, image: &Image) -> Role {
        let is_named = self.named.iter().any(|name| name == topic);
        if !self.named.is_empty() && !is_named {
            return Role::Double;
        }
        let is_depth = image.is_depth() || (is_named && image.may_be_depth());
        if !is_named && let Some(what) = doubt(topic, image) {
            return Role::Doubtful(format!("pictures on {topic} are taken for {what} (--topic {topic} reads them)"));
        }
        let (role, what) = if is_depth { (&mut self.depth, "depth") } else { (&mut self.color, "colour") };
        let chosen = role.get_or_insert_with(|| topic.to_string());
        if chosen == topic {
            return if is_depth { Role::Depth } else { Role::Color };
        }
        // The same pictures compressed in another way are no loss.
        let same_source = topic.starts_with(&format!("{chosen}/")) || chosen.starts_with(&format!("{topic}/"));
        if same_source || !self.named.is_empty() {
            return Role::Double;
        }
        Role::Passed(format!(
            "{what} pictures are read from {chosen}; those on {topic} are passed over (--topic {topic} reads them)"
        ))
    }
}

/// What a picture may be, that is neither depth nor colour.
fn doubt(topic: &str, image: &Image) -> Option<&'static str> {
    const INFRARED: [&str; 8] = ["ir", "infra", "infra1", "infra2", "infrared", "amplitude", "intensity", "confidence"];
    let names = topic.split(['/', '_']).map(str::to_ascii_lowercase);
    if names.into_iter().any(|name| INFRARED.contains(&name.as_str())) {
        return Some("infrared, by the topic's name");
    }
    (image.may_be_depth() && !image.is_depth()).then_some("grey: mono16 is no depth unless it is named")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::sensed::Header;

    fn image(encoding: &str) -> Image {
        let (header, encoding) = (Header { stamp_ns: 0, frame: String::new() }, encoding.to_string());
        Image::Raw { header, width: 1, height: 1, step: 2, encoding, big_endian: false, data: vec![0; 2] }
    }

    #[test]
    fn infrared_is_no_depth_unless_it_is_named() {
        for (topic, encoding) in [("/camera/ir/image", "mono16"), ("/sd/image_ir", "16UC1"), ("/grey", "mono16")] {
            assert!(matches!(Roles::default().of(topic, &image(encoding)), Role::Doubtful(_)), "{topic} {encoding}");
            assert_eq!(Roles::new(vec![topic.to_string()]).of(topic, &image(encoding)), Role::Depth);
        }
        assert_eq!(Roles::default().of("/stairs/depth", &image("16UC1")), Role::Depth);
    }
}
