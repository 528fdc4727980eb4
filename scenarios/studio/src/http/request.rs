//! One request, read within limits.

use std::io::{Read, Write};
use std::net::TcpStream;

/// Largest head of a request, its first line included [bytes].
const LARGEST_HEAD: usize = 16 << 10;
/// Largest body of a request [bytes].
pub const LARGEST_BODY: usize = 1 << 20;
/// Most headers of a request.
const MOST_HEADERS: usize = 64;

/// Why a request is not answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Status of HTTP.
    pub status: u16,
    /// The reason, for a reader.
    pub why: String,
}

impl Refusal {
    /// With a status of HTTP and a reason.
    pub fn new(status: u16, why: impl Into<String>) -> Refusal {
        Refusal { status, why: why.into() }
    }
}

/// First line and headers of a request.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// Its method, such as GET.
    pub method: String,
    /// The parts of its path between slashes, decoded.
    pub path: Vec<String>,
    query: Vec<(String, String)>,
    headers: Vec<(String, String)>,
    /// What was read after the head.
    rest: Vec<u8>,
}

impl Head {
    /// The header of a name in small letters; `None` where it is absent.
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(own, _)| own == name).map(|(_, value)| value.as_str())
    }

    /// All values of a key of the query.
    pub fn query<'a>(&'a self, key: &'a str) -> impl Iterator<Item = &'a str> {
        self.query.iter().filter(move |(own, _)| own == key).map(|(_, value)| value.as_str())
    }

    /// Length of its body [bytes].
    fn length(&self) -> Result<usize, Refusal> {
        if self.header("transfer-encoding").is_some() {
            return Err(Refusal::new(411, "expected a Content-Length"));
        }
        let mut lengths = self.headers.iter().filter(|(name, _)| name == "content-length").map(|(_, value)| value);
        let Some(length) = lengths.next() else { return Ok(0) };
        if lengths.any(|other| other != length) {
            return Err(Refusal::new(400, "expected one Content-Length"));
        }
        let length: u64 = length.parse().map_err(|_| Refusal::new(400, "expected a number as Content-Length"))?;
        match usize::try_from(length).ok().filter(|length| *length <= LARGEST_BODY) {
            Some(length) => Ok(length),
            None => {
                Err(Refusal::new(413, format!("expected a body of at most {LARGEST_BODY} bytes, {length} announced")))
            }
        }
    }
}

/// Read the head of a request; `None` where the connection ends without one.
///
/// # Errors
/// A head that is too large, or no HTTP.
pub fn read_head(stream: &mut TcpStream) -> Result<Option<Head>, Refusal> {
    let (mut bytes, mut piece) = (Vec::new(), [0; 4096]);
    loop {
        let count = match stream.read(&mut piece) {
            Ok(0) | Err(_) => return Ok(None),
            Ok(count) => count,
        };
        bytes.extend_from_slice(&piece[..count]);
        if let Some(head) = parse(&bytes)? {
            return Ok(Some(head));
        }
        if bytes.len() > LARGEST_HEAD {
            return Err(Refusal::new(431, format!("expected headers of at most {LARGEST_HEAD} bytes")));
        }
    }
}

/// The head in these bytes; `None` where they end before it does.
fn parse(bytes: &[u8]) -> Result<Option<Head>, Refusal> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    let parsed = request.parse(bytes).map_err(|cause| Refusal::new(400, format!("expected HTTP/1.1: {cause}")))?;
    let httparse::Status::Complete(end) = parsed else { return Ok(None) };
    let target = request.path.unwrap_or_default();
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let pair = |part: &str| {
        let (key, value) = part.split_once('=').unwrap_or((part, ""));
        Some((decoded(&key.replace('+', " "))?, decoded(&value.replace('+', " "))?))
    };
    let query: Option<Vec<_>> = query.split('&').filter(|part| !part.is_empty()).map(pair).collect();
    let path: Option<Vec<_>> = path.split('/').filter(|part| !part.is_empty()).map(decoded).collect();
    let (Some(path), Some(query)) = (path, query) else {
        return Err(Refusal::new(400, "expected an address in UTF-8"));
    };
    let text = |value: &[u8]| String::from_utf8_lossy(value).into_owned();
    Ok(Some(Head {
        method: request.method.unwrap_or_default().to_string(),
        path,
        query,
        headers: request.headers.iter().map(|h| (h.name.to_ascii_lowercase(), text(h.value))).collect(),
        rest: bytes[end..].to_vec(),
    }))
}

/// A text with its `%41` decoded; `None` where that is no UTF-8.
fn decoded(text: &str) -> Option<String> {
    let (mut bytes, mut rest) = (Vec::with_capacity(text.len()), text.as_bytes());
    while let [first, after @ ..] = rest {
        let digits = after.get(..2).filter(|_| *first == b'%').and_then(|two| std::str::from_utf8(two).ok());
        match digits.map(|two| u8::from_str_radix(two, 16)) {
            Some(Ok(byte)) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

/// Read the body of a request.
///
/// # Errors
/// One that is too large, of which nothing is read, and one that ends early.
pub fn read_body(head: &Head, stream: &mut TcpStream) -> Result<Vec<u8>, Refusal> {
    let length = head.length()?;
    if head.header("expect").is_some() {
        // a client that is gone is found by the read
        let _ = stream.write_all(b"HTTP/1.1 100 Continue\r\n\r\n");
    }
    let mut body = head.rest.clone();
    body.truncate(length);
    let mut piece = [0; 16 << 10];
    while body.len() < length {
        let wanted = piece.len().min(length - body.len());
        match stream.read(&mut piece[..wanted]) {
            Ok(0) | Err(_) => return Err(Refusal::new(408, "the body of the request ended early")),
            Ok(count) => body.extend_from_slice(&piece[..count]),
        }
    }
    Ok(body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_has_path_and_query_decoded_and_headers_in_small_letters() {
        let text = b"GET /runs/a%20b/x?token=1&key=a+b%2Bc HTTP/1.1\r\nHost: h\r\nX-One: two\r\n\r\nrest";
        let head = parse(text).expect("valid HTTP").expect("a whole head");
        assert_eq!((head.method.as_str(), head.path.as_slice()), ("GET", &["runs", "a b", "x"].map(String::from)[..]));
        assert_eq!(head.query("key").collect::<Vec<_>>(), ["a b+c"]);
        assert_eq!((head.header("x-one"), head.rest.as_slice()), (Some("two"), &b"rest"[..]));
        assert!(parse(b"GET / HTTP/1.1\r\nHost").expect("no mistake so far").is_none());
    }

    #[test]
    fn a_body_that_is_too_large_or_of_unknown_length_is_refused() {
        let with = |header: &str| {
            let text = format!("POST / HTTP/1.1\r\n{header}\r\n\r\n");
            parse(text.as_bytes())
                .expect("valid HTTP")
                .expect("a whole head")
                .length()
                .map_err(|refused| refused.status)
        };
        assert_eq!(with("Content-Length: 1048576"), Ok(LARGEST_BODY));
        assert_eq!(with("Content-Length: 104857600"), Err(413));
        assert_eq!(with("Content-Length: 99999999999999999999999"), Err(400));
        assert_eq!(with("Content-Length: 1\r\nContent-Length: 2"), Err(400));
        assert_eq!(with("Transfer-Encoding: chunked"), Err(411));
    }
}
