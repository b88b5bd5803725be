//! Requests: the first line and the headers of HTTP/1.1, read within limits and checked.

use super::response::Response;
use import::percent_decode;
use std::io::Read;
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Maximum size in bytes of the first line and all headers together.
const MAX_HEAD_BYTES: usize = 16 * 1024;

/// Time within which the first line and the headers must arrive.
const HEAD_TIME: Duration = Duration::from_secs(10);

/// A request that may be answered.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Request {
    /// Whether only the headers of the answer are requested.
    pub(super) is_head: bool,
    /// The path without its leading slash, percent-decoded.
    pub(super) path: String,
    /// The query after `?`, as it was sent.
    pub(super) query: String,
}

/// Reads the head of a request, up to the empty line.
///
/// # Errors
/// Fails with the response to a head that is too long, or with `None` if the connection was closed
/// or too slow.
pub(super) fn read_head(stream: &mut TcpStream) -> Result<Vec<u8>, Option<Response<'static>>> {
    let deadline = Instant::now() + HEAD_TIME;
    let mut head = Vec::new();
    let mut buffer = [0; 2048];
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
            return Err(None);
        }
        match stream.read(&mut buffer) {
            Ok(0) | Err(_) => return Err(None),
            Ok(count) => head.extend_from_slice(&buffer[..count]),
        }
        if let Some(end) = head.windows(4).position(|bytes| bytes == b"\r\n\r\n") {
            head.truncate(end);
            return Ok(head);
        }
        if head.len() > MAX_HEAD_BYTES {
            return Err(Some(Response::text(431, "The headers are too long.")));
        }
    }
}

/// Parses a head and checks that it comes from this server's page or from the user.
///
/// # Errors
/// Fails with the response that refuses the request.
pub(super) fn parse_request(head: &[u8], port: u16) -> Result<Request, Response<'static>> {
    let refuse = |status, text| Err(Response::text(status, text));
    let Ok(head) = std::str::from_utf8(head) else {
        return refuse(400, "The headers are not UTF-8.");
    };
    let mut lines = head.split("\r\n");
    let first: Vec<&str> = lines.next().unwrap_or_default().split(' ').collect();
    let [method, target, "HTTP/1.1" | "HTTP/1.0"] = first[..] else {
        return refuse(400, "Not an HTTP/1.1 request.");
    };
    let Some(headers) = lines.map(split_header).collect::<Option<Vec<_>>>() else {
        return refuse(400, "A header has no name.");
    };
    check_origin(&headers, port)?;
    if !matches!(method, "GET" | "HEAD") {
        return refuse(405, "Only GET and HEAD are supported.");
    }
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    match path.strip_prefix('/').and_then(percent_decode) {
        Some(path) => Ok(Request { is_head: method == "HEAD", path, query: query.to_owned() }),
        None => refuse(400, "The path is invalid."),
    }
}

/// Splits a header into its name in lower case and its value.
fn split_header(line: &str) -> Option<(String, &str)> {
    let (name, value) = line.split_once(':')?;
    let is_name = !name.is_empty() && !name.contains(char::is_whitespace);
    is_name.then(|| (name.to_ascii_lowercase(), value.trim()))
}

/// Refuses requests that do not come from this server's page.
///
/// `Host` must be this server: a foreign name that resolves to this machine (DNS rebinding) would
/// let another site's page read the answers. `Origin` and `Sec-Fetch-Site`, if sent, must indicate
/// this page or an address the user typed.
fn check_origin(headers: &[(String, &str)], port: u16) -> Result<(), Response<'static>> {
    let values = |name: &str| {
        let matching = headers.iter().filter(|(known, _)| known == name);
        matching.map(|(_, value)| *value).collect::<Vec<_>>()
    };
    let is_own = |host: &str| {
        ["127.0.0.1", "localhost"].iter().any(|name| {
            host.strip_prefix(name)
                .is_some_and(|rest| rest == format!(":{port}") || (rest.is_empty() && port == 80))
        })
    };
    match values("host")[..] {
        [host] if is_own(host) => {}
        _ => {
            return Err(Response::text(
                421,
                "This server answers only requests to its own address.",
            ));
        }
    }
    let is_own_origin = |origin: &&str| origin.strip_prefix("http://").is_some_and(is_own);
    let is_own_site = |site: &&str| matches!(*site, "same-origin" | "none");
    let origins = values("origin").iter().all(is_own_origin);
    if origins && values("sec-fetch-site").iter().all(is_own_site) {
        Ok(())
    } else {
        Err(Response::text(403, "This server answers only requests from its own page."))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(lines: &[&str]) -> Result<Request, u16> {
        parse_request(lines.join("\r\n").as_bytes(), 8000).map_err(|response| response.status)
    }

    #[test]
    fn paths_and_queries_are_separated() {
        let request = parse(&["GET /files/a%20b.glb?x=%20 HTTP/1.1", "Host: localhost:8000"]);
        let expected =
            Request { is_head: false, path: "files/a b.glb".into(), query: "x=%20".into() };
        assert_eq!(request, Ok(expected));
        for target in ["files", "/%zz", "/%f", "/%ff", "http://localhost:8000/"] {
            let line = format!("GET {target} HTTP/1.1");
            assert_eq!(parse(&[&line, "Host: localhost:8000"]), Err(400), "{target}");
        }
    }

    #[test]
    fn cross_site_requests_are_refused() {
        let ask = |headers: &[&str]| {
            parse(&[&["GET / HTTP/1.1"], headers].concat()).map(|_| ()).map_err(u32::from)
        };
        let own = "host: 127.0.0.1:8000";
        assert_eq!(ask(&[own]), Ok(()));
        assert_eq!(ask(&[own, "Origin: http://127.0.0.1:8000"]), Ok(()));
        assert_eq!(ask(&[own, "Sec-Fetch-Site: none"]), Ok(()));
        assert_eq!(ask(&[]), Err(421));
        assert_eq!(ask(&[own, own]), Err(421));
        for host in ["a.example:8000", "127.0.0.1:8001", "127.0.0.1", "localhost:8000.a.example"] {
            assert_eq!(ask(&[&format!("Host: {host}")]), Err(421), "{host}");
        }
        for origin in ["null", "http://a.example", "https://127.0.0.1:8000", "http://localhost:1"] {
            assert_eq!(ask(&[own, &format!("Origin: {origin}")]), Err(403), "{origin}");
        }
        for site in ["cross-site", "same-site"] {
            assert_eq!(ask(&[own, &format!("Sec-Fetch-Site: {site}")]), Err(403), "{site}");
        }
        assert_eq!(ask(&[own, "no colon"]), Err(400));
    }

    #[test]
    fn unsupported_methods_are_refused() {
        for method in ["POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "get"] {
            let line = format!("{method} / HTTP/1.1");
            assert_eq!(parse(&[&line, "Host: localhost:8000"]), Err(405), "{method}");
        }
    }
}
