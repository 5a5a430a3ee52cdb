//! The master: who publishes what, and where.

use std::io;

use super::xml_rpc::{Value, call};
use crate::robot::ros::RosError;

/// A master, and who we are to it.
#[derive(Clone, Debug)]
pub struct Master {
    /// `HOST:PORT`.
    pub place: String,
    /// Our name among the nodes.
    pub caller: String,
    /// Where we are called back.
    pub uri: String,
}

impl Master {
    /// Asks, and takes the third of what every answer of ROS consists of.
    fn ask(&self, method: &str, rest: &[Value]) -> Result<Value, RosError> {
        let values: Vec<Value> = [Value::text(&self.caller)].into_iter().chain(rest.iter().cloned()).collect();
        let answer = call(&self.place, method, &values).map_err(|error| RosError::Master(self.name(), error))?;
        match answer.as_list() {
            [code, _, value] if code.as_int() == Some(1) => Ok(value.clone()),
            [_, why, _] => Err(RosError::Refused(self.name(), why.as_text().unwrap_or("refused").to_string())),
            _ => {
                let what = io::Error::new(io::ErrorKind::InvalidData, "no answer of a ROS master");
                Err(RosError::Master(self.name(), what))
            }
        }
    }

    /// What to call it in messages.
    pub fn name(&self) -> String {
        format!("ros1:{}", self.place)
    }

    /// Whether it answers.
    pub fn is_alive(&self) -> bool {
        self.ask("getPid", &[]).is_ok()
    }

    /// Topics that are published, and their types.
    ///
    /// # Errors
    /// When it does not answer.
    pub fn topics(&self) -> Result<Vec<(String, String)>, RosError> {
        let answer = self.ask("getPublishedTopics", &[Value::text("")])?;
        let pair = |value: &Value| match value.as_list() {
            [topic, kind] => Some((topic.as_text()?.to_string(), kind.as_text()?.to_string())),
            _ => None,
        };
        Ok(answer.as_list().iter().filter_map(pair).collect())
    }

    /// We publish it.
    ///
    /// # Errors
    /// When it does not answer, or refuses.
    pub fn publish(&self, topic: &str, kind: &str) -> Result<(), RosError> {
        let uri = Value::text(&self.uri);
        self.ask("registerPublisher", &[Value::text(topic), Value::text(kind), uri]).map(drop)
    }

    /// We listen to it; the nodes that publish it.
    ///
    /// # Errors
    /// When it does not answer, or refuses.
    pub fn subscribe(&self, topic: &str, kind: &str) -> Result<Vec<String>, RosError> {
        let uri = Value::text(&self.uri);
        let answer = self.ask("registerSubscriber", &[Value::text(topic), Value::text(kind), uri])?;
        Ok(answer.as_list().iter().filter_map(|uri| uri.as_text().map(str::to_string)).collect())
    }

    /// Good-bye: a master that is gone need not hear it.
    pub fn leave(&self, published: &[String], subscribed: &[String]) {
        let uri = || Value::text(&self.uri);
        for (method, topics) in [("unregisterPublisher", published), ("unregisterSubscriber", subscribed)] {
            for topic in topics {
                if self.ask(method, &[Value::text(topic), uri()]).is_err() {
                    return;
                }
            }
        }
    }
}
