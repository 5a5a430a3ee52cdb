//! Names of topics: a namespace before all, and others in place of some.

/// How our names of topics become the robot's.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Put before every name that is not remapped, such as `/robot1`.
    pub namespace: String,
    /// Ours, and the robot's.
    pub remapped: Vec<(String, String)>,
}

impl Names {
    /// The robot's name of the topic we call `topic`.
    pub fn of(&self, topic: &str) -> String {
        if let Some((_, theirs)) = self.remapped.iter().find(|(ours, _)| ours == topic) {
            return theirs.clone();
        }
        // Transforms of all robots are on one topic.
        if self.namespace.is_empty() || topic == "/tf" || topic == "/tf_static" || topic == "/clock" {
            return topic.to_string();
        }
        format!("/{}{topic}", self.namespace.trim_matches('/'))
    }
}

/// `/ours:=/theirs`, as ROS writes it.
///
/// # Errors
/// Says what is wrong with it.
pub fn remapping(text: &str) -> Result<(String, String), String> {
    let (ours, theirs) = text.split_once(":=").ok_or(format!("`{text}` is no /ours:=/theirs"))?;
    let named = |name: &str| {
        let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '/'));
        if !plain || name.trim_matches('/').is_empty() {
            return Err(format!("`{name}` is no name of a topic: letters, digits, _ and /"));
        }
        Ok(format!("/{}", name.trim_start_matches('/')))
    };
    Ok((named(ours)?, named(theirs)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_remapped_or_put_in_the_namespace() {
        let names = Names { namespace: "/r1/".into(), remapped: vec![remapping("cmd_vel:=/base/cmd").expect("one")] };
        let named = ["/cmd_vel", "/odom", "/tf"].map(|topic| names.of(topic));
        assert_eq!(named, ["/base/cmd", "/r1/odom", "/tf"]);
        assert!(remapping("/a=/b").is_err() && remapping("/a:=/b\n").is_err() && remapping(":=/b").is_err());
    }
}
