//! Where ROS is: `ros1:HOST[:PORT]`, or `ros1:` for where the environment says.

/// The port of a ROS 1 master.
const PORT: u16 = 11311;

/// The master that `ros1:…` names, as `HOST:PORT`; nothing when it is no such address.
///
/// Without a host `ROS_MASTER_URI` says it, or it is on this machine.
///
/// # Errors
/// Says what is wrong with it.
pub fn master_of(text: &str) -> Option<Result<String, String>> {
    let rest = text.strip_prefix("ros1:")?;
    let uri = std::env::var("ROS_MASTER_URI").unwrap_or_default();
    let named = uri.trim_start_matches("http://").trim_end_matches('/');
    let place = match (rest, named) {
        ("", "") => "127.0.0.1",
        ("", named) => named,
        (rest, _) => rest,
    };
    let (host, port) = match place.rsplit_once(':') {
        None => (place, Some(PORT)),
        Some((host, port)) => (host, port.parse::<u16>().ok().filter(|port| *port > 0)),
    };
    Some(match port {
        Some(port) if !host.is_empty() => Ok(format!("{host}:{port}")),
        _ => Err(format!("`{text}` is no ROS master: it is ros1:HOST:{PORT}, or ros1: for ROS_MASTER_URI")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_master_is_a_host_with_a_port() {
        assert_eq!(master_of("ros1:robot"), Some(Ok("robot:11311".to_string())));
        assert_eq!(master_of("ros1:10.0.0.2:1234"), Some(Ok("10.0.0.2:1234".to_string())));
        assert!(master_of("ros1:robot:0").is_some_and(|place| place.is_err()));
        assert_eq!(master_of("tcp:robot:1"), None);
    }
}
