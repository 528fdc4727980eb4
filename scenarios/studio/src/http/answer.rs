//! The answer to a request.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::Duration;

use serde_json::Value;

use super::request::Refusal;

/// What the page may load: itself, nothing from elsewhere.
const OF_PAGE: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; \
                       frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// A report has its scripts and pictures in itself. It is a document of its own, which cannot speak to the studio.
const OF_REPORT: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; \
                         base-uri 'none'; form-action 'none'; frame-ancestors 'self'; sandbox allow-scripts allow-downloads";
/// Of what is left of a refused request, read at most so much and so long: the sender would not read the refusal otherwise.
const LEFT: usize = 256 << 10;
const PATIENCE: Duration = Duration::from_millis(200);

/// What an answer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The page.
    Page,
    /// The report of a run.
    Report,
    /// Its script.
    Script,
    /// Its styles.
    Style,
    /// JSON.
    Json,
    /// A picture.
    Png,
    /// Plain text.
    Text,
}

impl Kind {
    fn mime(self) -> &'static str {
        match self {
            Kind::Page | Kind::Report => "text/html; charset=utf-8",
            Kind::Script => "text/javascript; charset=utf-8",
            Kind::Style => "text/css; charset=utf-8",
            Kind::Json => "application/json",
            Kind::Png => "image/png",
            Kind::Text => "text/plain; charset=utf-8",
        }
    }

    fn policy(self) -> &'static str {
        match self {
            Kind::Page => OF_PAGE,
            Kind::Report => OF_REPORT,
            _ => "default-src 'none'; frame-ancestors 'none'",
        }
    }
}

/// An answer.
#[derive(Clone, Debug)]
pub struct Answer {
    status: u16,
    kind: Kind,
    body: Vec<u8>,
}

impl Answer {
    /// With a body.
    pub fn new(kind: Kind, body: impl Into<Vec<u8>>) -> Answer {
        Answer { status: 200, kind, body: body.into() }
    }

    /// JSON.
    pub fn json(value: &Value) -> Answer {
        Answer::new(Kind::Json, value.to_string())
    }

    /// Send it, and end the connection.
    pub fn send(&self, stream: &mut TcpStream) {
        let Answer { status, kind, body } = self;
        let head = format!(
            "HTTP/1.1 {status} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\n\
             Content-Security-Policy: {}\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
             Cross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\n\r\n",
            reason(*status),
            kind.mime(),
            body.len(),
            kind.policy()
        );
        // a reader that is gone needs no answer
        let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(body));
        let _ = stream.shutdown(Shutdown::Write);
        if *status >= 400 {
            let _ = stream.set_read_timeout(Some(PATIENCE));
            let (mut left, mut piece) = (LEFT, [0; 16 << 10]);
            while let Ok(count @ 1..) = stream.read(&mut piece) {
                left = left.saturating_sub(count);
                if left == 0 {
                    break;
                }
            }
        }
    }
}

impl From<Refusal> for Answer {
    fn from(Refusal { status, why }: Refusal) -> Answer {
        Answer { status, kind: Kind::Text, body: format!("{why}\n").into_bytes() }
    }
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        408 => "Request Timeout",
        411 => "Length Required",
        413 => "Content Too Large",
        431 => "Request Header Fields Too Large",
        503 => "Service Unavailable",
        _ => "Error",
    }
}
