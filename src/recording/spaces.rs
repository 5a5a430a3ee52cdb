//! Transforms of several robots in one log, kept apart by the namespaces of their topics.

use std::collections::BTreeMap;

use super::sensed::Transform;
use super::transform_tree::{TransformTree, Trees, Unplaced};

/// A tree for each namespace: `/robot1/tf` and `/robot1/tf_static` make that of `/robot1`, `/tf` that of all.
#[derive(Clone, Debug, Default)]
pub(super) struct Spaces {
    trees: BTreeMap<String, TransformTree>,
}

impl Spaces {
    pub(super) fn insert(&mut self, topic: &str, transforms: &[Transform]) {
        let fixed = topic.ends_with("_static");
        let tree = self.trees.entry(folder(topic).to_string()).or_default();
        transforms.iter().for_each(|one| tree.insert(one, fixed));
    }

    pub(super) fn forget_before(&mut self, stamp_ns: u64) {
        self.trees.values_mut().for_each(|tree| tree.forget_before(stamp_ns));
    }

    pub(super) fn forget_moving(&mut self) {
        self.trees.values_mut().for_each(TransformTree::forget_moving);
    }

    /// The trees that bear on what comes on a topic: those of the namespaces it lies in, the innermost first; or the
    /// only one there is.
    pub(super) fn of(&self, topic: &str) -> Result<Trees<'_>, Unplaced> {
        let own = self.trees.iter().rev().filter(|(space, _)| lies_in(topic, space));
        let own: Vec<&TransformTree> = own.map(|(_, tree)| tree).collect();
        match (own.as_slice(), self.trees.len()) {
            ([], 2..) => Err(Unplaced::OtherRobots(self.trees.keys().map(|space| format!("{space}/tf")).collect())),
            ([], _) => Ok(Trees(self.trees.values().collect())),
            _ => Ok(Trees(own)),
        }
    }
}

/// A topic without its last name: `/robot1` of `/robot1/tf`.
pub(super) fn folder(topic: &str) -> &str {
    topic.rsplit_once('/').map_or("", |(folder, _)| folder)
}

fn lies_in(topic: &str, space: &str) -> bool {
    topic.strip_prefix(space).is_some_and(|rest| rest.starts_with('/'))
}

/// How many names two topics have in common from the first on.
pub(super) fn kinship(a: &str, b: &str) -> usize {
    a.split('/').zip(b.split('/')).skip(1).take_while(|(a, b)| a == b).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Isometry3;

    fn spaces(topics: &[&str]) -> Spaces {
        let mut spaces = Spaces::default();
        for (x, topic) in topics.iter().enumerate() {
            let parent_from_child = Isometry3::translation(x as f64, 0.0, 0.0);
            let (parent, child) = ("odom".to_string(), "base_link".to_string());
            spaces.insert(topic, &[Transform { stamp_ns: 0, parent, child, parent_from_child }]);
        }
        spaces
    }

    fn x_seen_from(spaces: &Spaces, topic: &str) -> Option<f64> {
        let trees = spaces.of(topic).ok()?;
        trees.place("base_link", 0).ok().map(|placed| placed.root_from_frame.translation.x)
    }

    #[test]
    fn a_camera_is_placed_by_the_transforms_of_its_own_namespace() {
        let two = spaces(&["/robot1/tf", "/robot2/tf"]);
        assert_eq!(x_seen_from(&two, "/robot2/camera/depth/image_raw"), Some(1.0));
        assert_eq!(x_seen_from(&two, "/robot1/camera/depth/image_raw"), Some(0.0));
        assert_eq!(x_seen_from(&two, "/camera/depth/image_raw"), None, "whose camera it is nothing says");
        assert_eq!(x_seen_from(&spaces(&["/robot1/tf"]), "/camera/depth/image_raw"), Some(0.0));
        let global = spaces(&["/tf", "/robot2/tf"]);
        assert_eq!(x_seen_from(&global, "/robot1/camera/depth"), Some(0.0));
        assert_eq!(x_seen_from(&global, "/robot2/camera/depth"), Some(1.0));
    }
}
