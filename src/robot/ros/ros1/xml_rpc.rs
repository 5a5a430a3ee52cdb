//! XML-RPC as master and nodes of ROS 1 use it: a call and an answer over HTTP.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use quick_xml::Reader;
use quick_xml::escape::{escape, unescape};
use quick_xml::events::Event;

/// The most that is read of a call or an answer, bytes: the topics of a large robot take a tenth.
const MOST: usize = 4 << 20;
/// The deepest list in a list.
const DEEPEST: usize = 16;
/// An answer comes within this.
const WITHIN: Duration = Duration::from_secs(2);

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A whole number.
    Int(i32),
    /// Words.
    Text(String),
    /// Values in order.
    List(Vec<Value>),
    /// Anything else, which nobody here needs.
    Other,
}

impl Value {
    pub fn text(text: &str) -> Self {
        Self::Text(text.to_string())
    }

    pub fn as_text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    pub fn as_list(&self) -> &[Self] {
        if let Self::List(list) = self { list } else { &[] }
    }

    pub fn as_int(&self) -> Option<i32> {
        if let Self::Int(int) = self { Some(*int) } else { None }
    }

    fn write(&self, out: &mut String) {
        out.push_str("<value>");
        match self {
            Self::Int(int) => out.push_str(&format!("<int>{int}</int>")),
            Self::Text(text) => out.push_str(&format!("<string>{}</string>", escape(text))),
            Self::List(list) => {
                out.push_str("<array><data>");
                list.iter().for_each(|value| value.write(out));
                out.push_str("</data></array>");
            }
            Self::Other => out.push_str("<string></string>"),
        }
        out.push_str("</value>");
    }
}

fn parameters(values: &[Value]) -> String {
    let mut out = String::from("<params>");
    for value in values {
        out.push_str("<param>");
        value.write(&mut out);
        out.push_str("</param>");
    }
    out + "</params>"
}

fn bad(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what.to_string())
}

/// Asks `method` of the node at `host:port`.
///
/// # Errors
/// When nobody answers, or not in XML-RPC.
pub fn call(place: &str, method: &str, values: &[Value]) -> io::Result<Value> {
    let body = format!(
        "<?xml version=\"1.0\"?><methodCall><methodName>{method}</methodName>{}</methodCall>",
        parameters(values)
    );
    let mut stream = connect(place)?;
    let length = body.len();
    let head =
        format!("POST /RPC2 HTTP/1.0\r\nHost: {place}\r\nContent-Type: text/xml\r\nContent-Length: {length}\r\n\r\n");
    stream.write_all((head + &body).as_bytes())?;
    let (_, values) = read(&stream)?;
    values.into_iter().next().ok_or(bad("an empty answer"))
}

/// A connection that waits for nothing for long.
///
/// # Errors
/// When nobody listens there.
pub fn connect(place: &str) -> io::Result<TcpStream> {
    let mut failed = bad("no such host");
    for address in place.to_socket_addrs()? {
        match TcpStream::connect_timeout(&address, WITHIN) {
            Ok(stream) => {
                stream.set_read_timeout(Some(WITHIN))?;
                stream.set_write_timeout(Some(WITHIN))?;
                return Ok(stream);
            }
            Err(error) => failed = error,
        }
    }
    Err(failed)
}

/// Hears one call on `stream`, and answers what `answer` says.
///
/// # Errors
/// When it is no call.
pub fn serve(stream: &TcpStream, answer: impl FnOnce(&str, &[Value]) -> Value) -> io::Result<()> {
    stream.set_read_timeout(Some(WITHIN))?;
    stream.set_write_timeout(Some(WITHIN))?;
    let (method, values) = read(stream)?;
    let body =
        format!("<?xml version=\"1.0\"?><methodResponse>{}</methodResponse>", parameters(&[answer(&method, &values)]));
    let length = body.len();
    let head = format!("HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\nContent-Length: {length}\r\n\r\n");
    let mut stream = stream;
    stream.write_all((head + &body).as_bytes())
}

/// Reads a call or an answer: the method, if any, and its values.
fn read(stream: &TcpStream) -> io::Result<(String, Vec<Value>)> {
    let mut reader = BufReader::new(stream.take(MOST as u64));
    let mut length = None;
    loop {
        let mut line = String::new();
        if reader.read_line(&mut line)? == 0 {
            return Err(bad("the connection ends in the head of a message"));
        }
        let line = line.trim_end();
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse::<usize>().ok();
        }
    }
    let length = length.filter(|length| *length <= MOST).ok_or(bad("no length, or too long a message"))?;
    let mut body = vec![0; length];
    reader.read_exact(&mut body)?;
    parse(&String::from_utf8_lossy(&body))
}

/// The method, if any, and the values of a document.
fn parse(text: &str) -> io::Result<(String, Vec<Value>)> {
    let mut parser = Parser { reader: Reader::from_str(text) };
    let (mut method, mut values) = (String::new(), Vec::new());
    loop {
        match parser.next()? {
            Part::Open(name) if name == "methodName" => method = parser.content()?,
            Part::Open(name) if name == "value" => values.push(parser.value(0)?),
            Part::Open(name) if name == "fault" => return Err(bad("the other side says fault")),
            Part::End => return Ok((method, values)),
            _ => {}
        }
    }
}

enum Part {
    Open(String),
    Close(String),
    Text(String),
    End,
}

struct Parser<'a> {
    reader: Reader<&'a [u8]>,
}

impl Parser<'_> {
    fn next(&mut self) -> io::Result<Part> {
        loop {
            let event = self.reader.read_event().map_err(|error| bad(&error.to_string()))?;
            let name = |text: &str| text.to_string();
            return Ok(match event {
                Event::Start(tag) => Part::Open(name(tag.name().as_ref())),
                Event::End(tag) => Part::Close(name(tag.name().as_ref())),
                Event::Text(text) => {
                    let text = name(text.as_ref());
                    Part::Text(unescape(&text).map_err(|error| bad(&error.to_string()))?.into_owned())
                }
                Event::GeneralRef(reference) => {
                    let text = format!("&{};", name(reference.as_ref()));
                    Part::Text(unescape(&text).map_err(|error| bad(&error.to_string()))?.into_owned())
                }
                Event::Eof => Part::End,
                _ => continue,
            });
        }
    }

    /// The text up to the end of the element that is open.
    fn content(&mut self) -> io::Result<String> {
        let mut text = String::new();
        loop {
            match self.next()? {
                Part::Text(more) => text += &more,
                Part::Close(_) => return Ok(text),
                _ => return Err(bad("an element where text belongs")),
            }
        }
    }

    /// The value whose element is open, to its end.
    fn value(&mut self, depth: usize) -> io::Result<Value> {
        if depth > DEEPEST {
            return Err(bad("lists too deep"));
        }
        let (mut bare, mut value) = (String::new(), None);
        loop {
            match self.next()? {
                Part::Text(text) => bare += &text,
                Part::Close(name) if name == "value" => return Ok(value.unwrap_or(Value::Text(bare))),
                Part::Open(name) => value = Some(self.typed(&name, depth)?),
                Part::Close(_) => {}
                Part::End => return Err(bad("the message ends in a value")),
            }
        }
    }

    fn typed(&mut self, name: &str, depth: usize) -> io::Result<Value> {
        Ok(match name {
            "int" | "i4" => Value::Int(self.content()?.trim().parse().map_err(|_| bad("no whole number"))?),
            "boolean" => Value::Int(i32::from(self.content()?.trim() == "1")),
            "string" => Value::Text(self.content()?),
            "array" => {
                let mut list = Vec::new();
                loop {
                    match self.next()? {
                        Part::Open(name) if name == "value" => list.push(self.value(depth + 1)?),
                        Part::Close(name) if name == "array" => break,
                        Part::End => return Err(bad("the message ends in a list")),
                        _ => {}
                    }
                }
                Value::List(list)
            }
            other => {
                loop {
                    match self.next()? {
                        Part::Close(name) if name == other => break,
                        Part::End => return Err(bad("the message ends in a value")),
                        _ => {}
                    }
                }
                Value::Other
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_is_read_as_it_was_written() {
        let values = [Value::text("/a <&> b"), Value::Int(-3), Value::List(vec![Value::List(vec![]), Value::text("")])];
        let text = format!("<methodCall><methodName>requestTopic</methodName>{}</methodCall>", parameters(&values));
        let (method, read) = parse(&text).expect("a call");
        assert_eq!((method.as_str(), read.as_slice()), ("requestTopic", values.as_slice()));
    }

    #[test]
    fn what_is_cut_off_or_nested_without_end_is_no_call() {
        assert!(parse("<params><param><value><array><data><value>").is_err());
        assert!(parse(&"<value><array>".repeat(10_000)).is_err());
        assert!(parse("<value><int>x</int></value>").is_err());
    }
}
