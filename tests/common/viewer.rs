//! Someone who looks on as Foxglove does: a WebSocket client that subscribes to all it is told of.

use std::collections::{BTreeMap, BTreeSet};
use std::net::TcpStream;
use std::path::Path;
use std::sync::{Arc, Mutex};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::http::HeaderValue;
use tungstenite::{Message, WebSocket};

/// How a topic is made known: encoding, schema's name, its encoding, and the schema.
pub type Kind = (String, String, String, Vec<u8>);

/// What is said on a topic.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Said {
    pub kind: Kind,
    /// Times in nanoseconds, and bytes.
    pub messages: Vec<(u64, Vec<u8>)>,
}

pub type Topics = BTreeMap<String, Said>;

/// What has come so far.
#[derive(Clone, Default)]
pub struct Seen {
    pub topics: Topics,
    /// The sessions that the server has named.
    pub sessions: BTreeSet<String>,
    /// The newest time of its clock.
    pub clock_ns: u64,
    subscribed: BTreeMap<u64, String>,
}

pub struct Viewer(Arc<Mutex<Seen>>);

/// Connects as Foxglove does.
pub fn connect(port: u16) -> WebSocket<TcpStream> {
    let mut request = format!("ws://127.0.0.1:{port}/").into_client_request().expect("an address");
    request.headers_mut().insert("sec-websocket-protocol", HeaderValue::from_static("foxglove.sdk.v1"));
    let stream = TcpStream::connect(("127.0.0.1", port)).expect("served");
    let (socket, answer) = tungstenite::client(request, stream).expect("a WebSocket");
    assert_eq!(answer.headers()["sec-websocket-protocol"], "foxglove.sdk.v1");
    socket
}

impl Viewer {
    pub fn connected_to(port: u16) -> Self {
        let seen = Arc::new(Mutex::new(Seen::default()));
        let mut socket = connect(port);
        let viewer = Self(Arc::clone(&seen));
        std::thread::spawn(move || {
            while let Ok(message) = socket.read() {
                let answer = seen.lock().expect("unbroken").hear(&message);
                if let Some(answer) = answer {
                    let _ = socket.send(Message::text(answer));
                }
            }
        });
        viewer
    }

    pub fn seen(&self) -> Seen {
        self.0.lock().expect("unbroken").clone()
    }
}

impl Seen {
    /// Takes a message; answers a topic that is made known by subscribing to it.
    pub fn hear(&mut self, message: &Message) -> Option<String> {
        match message {
            Message::Text(text) => {
                let told: Value = serde_json::from_str(text).expect("JSON");
                match told["op"].as_str().expect("an operation") {
                    "advertise" => return Some(self.subscribe(&told["channels"])),
                    "serverInfo" => {
                        self.sessions.insert(told["sessionId"].to_string());
                    }
                    _ => {}
                }
            }
            Message::Binary(bytes) => {
                let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"));
                match bytes[0] {
                    1 => {
                        let id = u64::from(u32::from_le_bytes(bytes[1..5].try_into().expect("four bytes")));
                        let said = self.topics.entry(self.subscribed[&id].clone()).or_default();
                        said.messages.push((number(5), bytes[13..].to_vec()));
                    }
                    2 => self.clock_ns = number(1),
                    other => panic!("an unknown message: {other}"),
                }
            }
            _ => {}
        }
        None
    }

    fn subscribe(&mut self, channels: &Value) -> String {
        let mut subscriptions = Vec::new();
        for channel in channels.as_array().expect("a list") {
            let text = |key: &str| channel[key].as_str().unwrap_or_default().to_string();
            let schema = match text("schemaEncoding").as_str() {
                "protobuf" => BASE64_STANDARD.decode(text("schema")).expect("base64"),
                _ => text("schema").into_bytes(),
            };
            let kind = (text("encoding"), text("schemaName"), text("schemaEncoding"), schema);
            self.topics.entry(text("topic")).or_default().kind = kind;
            let id = channel["id"].as_u64().expect("a number");
            self.subscribed.insert(id, text("topic"));
            subscriptions.push(json!({"id": id, "channelId": id}));
        }
        json!({"op": "subscribe", "subscriptions": subscriptions}).to_string()
    }
}

/// What stands in a log.
pub fn recorded(path: &Path) -> Topics {
    let bytes = std::fs::read(path).expect("a log");
    let mut topics = Topics::new();
    for message in mcap::MessageStream::new(&bytes).expect("a log") {
        let message = message.expect("undamaged");
        let said = topics.entry(message.channel.topic.clone()).or_default();
        let schema = message.channel.schema.as_ref().expect("a schema");
        let encoding = message.channel.message_encoding.clone();
        said.kind = (encoding, schema.name.clone(), schema.encoding.clone(), schema.data.to_vec());
        said.messages.push((message.log_time, message.data.to_vec()));
    }
    topics
}
