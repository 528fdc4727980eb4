//! Requests and answers: what is read of a request, within limits, and the headers of an answer.

use std::borrow::Cow;
use std::io::{Read, copy, sink};

use form_urlencoded::parse;
use oxhttp::model::request::Parts;
use oxhttp::model::{Body, HeaderValue, Response, StatusCode, Uri, header};
use percent_encoding::percent_decode_str;

/// Largest body of a request [bytes].
const LARGEST_BODY: u64 = 1 << 20;
/// Largest body that is read to its end though it is refused [bytes]: a sender would not read the refusal otherwise.
const LARGEST_REFUSED: u64 = 4 << 20;

/// What the page may load: itself, nothing from elsewhere.
const OF_PAGE: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; \
                       frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// A report has its scripts and pictures in itself. It is a document of its own, which cannot speak to the studio.
const OF_REPORT: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; \
                         base-uri 'none'; form-action 'none'; frame-ancestors 'self'; sandbox allow-scripts allow-downloads";
/// Files and data load nothing.
const OF_DATA: &str = "default-src 'none'; frame-ancestors 'none'";

/// Why a request is not answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    status: StatusCode,
    why: String,
}

impl Refusal {
    /// With a status and a reason for a reader.
    pub fn new(status: StatusCode, why: impl Into<String>) -> Refusal {
        Refusal { status, why: why.into() }
    }
}

/// What an answer holds: its type and its content security policy.
pub type Kind = [&'static str; 2];
pub const PAGE: Kind = ["text/html; charset=utf-8", OF_PAGE];
pub const REPORT: Kind = ["text/html; charset=utf-8", OF_REPORT];
pub const SCRIPT: Kind = ["text/javascript; charset=utf-8", OF_DATA];
pub const STYLE: Kind = ["text/css; charset=utf-8", OF_DATA];
pub const JSON: Kind = ["application/json", OF_DATA];
pub const PNG: Kind = ["image/png", OF_DATA];
pub const TEXT: Kind = ["text/plain; charset=utf-8", OF_DATA];

/// An answer with a body.
pub fn answer([mime, policy]: Kind, body: impl Into<Body>) -> Response<Body> {
    let mut answer = Response::new(body.into());
    for (name, value) in [
        (header::CONTENT_TYPE, mime),
        (header::CONTENT_SECURITY_POLICY, policy),
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (header::HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ] {
        answer.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    answer
}

impl From<Refusal> for Response<Body> {
    fn from(Refusal { status, why }: Refusal) -> Response<Body> {
        let mut refusal = answer(TEXT, format!("{why}\n"));
        *refusal.status_mut() = status;
        refusal
    }
}

/// The parts of an address's path between slashes, decoded.
///
/// # Errors
/// A path that is no UTF-8.
pub fn path(uri: &Uri) -> Result<Vec<Cow<'_, str>>, Refusal> {
    let parts = uri.path().split('/').filter(|part| !part.is_empty());
    let parts: Result<_, _> = parts.map(|part| percent_decode_str(part).decode_utf8()).collect();
    parts.map_err(|_| Refusal::new(StatusCode::BAD_REQUEST, "expected an address in UTF-8"))
}

/// All values of a key of a query, decoded.
pub fn query<'a>(head: &'a Parts, key: &'a str) -> impl Iterator<Item = Cow<'a, str>> {
    let pairs = parse(head.uri.query().unwrap_or_default().as_bytes());
    pairs.filter(move |(own, _)| own == key).map(|(_, value)| value)
}

/// Read the body of a request.
///
/// # Errors
/// One that is too large, of which nothing is kept, and one that ends early.
pub fn read(mut body: Body) -> Result<Vec<u8>, Refusal> {
    let announced = body.len().unwrap_or(0);
    let mut content = Vec::new();
    if announced <= LARGEST_BODY {
        let read = body.by_ref().take(LARGEST_BODY + 1).read_to_end(&mut content);
        read.map_err(|_| Refusal::new(StatusCode::REQUEST_TIMEOUT, "the body of the request ended early"))?;
        if content.len() as u64 <= LARGEST_BODY {
            return Ok(content);
        }
    }
    if announced <= LARGEST_REFUSED {
        // a sender that breaks off needs no refusal
        let _ = copy(&mut body.take(LARGEST_REFUSED), &mut sink());
    }
    Err(Refusal::new(StatusCode::PAYLOAD_TOO_LARGE, format!("expected a body of at most {LARGEST_BODY} bytes")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_and_query_are_decoded() {
        let uri = Uri::from_static("/runs/a%20b//x?token=1&key=a+b%2Bc&key=");
        assert_eq!(path(&uri), Ok(["runs", "a b", "x"].map(Cow::from).to_vec()));
        let (head, ()) = oxhttp::model::Request::get(uri).body(()).expect("a request").into_parts();
        assert_eq!(query(&head, "key").collect::<Vec<_>>(), ["a b+c", ""]);
        assert!(path(&Uri::from_static("/%ff")).is_err());
    }

    #[test]
    fn a_body_is_read_up_to_its_limit_announced_or_not() {
        let of = |length: u64| vec![b'x'; usize::try_from(length).expect("a length")];
        let [whole, more] = [of(LARGEST_BODY), of(LARGEST_BODY + 1)];
        let too_large = |body: Body| read(body).is_err_and(|refused| refused.status == StatusCode::PAYLOAD_TOO_LARGE);
        assert_eq!(read(Body::from(whole.clone())), Ok(whole.clone()));
        assert_eq!(read(Body::from_read(std::io::Cursor::new(whole.clone()))), Ok(whole));
        assert!(too_large(Body::from(more)) && too_large(Body::from_read(std::io::repeat(b'x'))));
    }
}
