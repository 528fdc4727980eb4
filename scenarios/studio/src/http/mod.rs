//! HTTP/1.1 as far as one page on this machine needs it: one request a connection, within limits.

mod answer;
mod request;

pub use answer::{Answer, Kind};
pub use request::{Head, Refusal, read_body, read_head};
