//! Who may ask: the page that this process serves, with the token of its address.

use std::borrow::Cow;

use oxhttp::model::StatusCode;
use oxhttp::model::request::Parts;

use crate::http::{Refusal, query};

/// Letters of a token: 128 bits in hexadecimal digits.
const TOKEN: usize = 32;

/// What a request must have.
#[derive(Clone, Debug)]
pub struct Guard {
    /// What the page's address has.
    pub token: String,
    hosts: [String; 2],
}

impl Guard {
    /// For a port of this machine, with a token of 128 random bits.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub fn new(port: u16) -> Result<Guard, getrandom::Error> {
        let token = random_word()?;
        Ok(Guard { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://{}/?token={}", self.hosts[0], self.token)
    }

    /// Refuse what does not come from the page.
    ///
    /// # Errors
    /// Another host or origin, or no token.
    pub fn admit(&self, head: &Parts) -> Result<(), Refusal> {
        let value = |name: &str| head.headers.get(name).map(|value| value.to_str().unwrap_or_default());
        let refuse = |why: &str| Err(Refusal::new(StatusCode::FORBIDDEN, why));
        let Some(host) = value("host").filter(|host| self.hosts.iter().any(|own| own == host)) else {
            return refuse(&format!("expected the host {}", self.hosts[0]));
        };
        if value("origin").is_some_and(|origin| origin != format!("http://{host}")) {
            return refuse("a page of another origin may not ask");
        }
        if value("sec-fetch-site").is_some_and(|site| !matches!(site, "same-origin" | "none")) {
            return refuse("a page of another site may not ask");
        }
        let given = value("x-splashdown-token").map(Cow::from).or_else(|| query(head, "token").next());
        if !same(&given.unwrap_or_default(), &self.token) {
            return refuse("expected the token: open the address that `splashdown studio` printed");
        }
        Ok(())
    }
}

/// 128 random bits in hexadecimal digits.
///
/// # Errors
/// The system has no random numbers.
pub fn random_word() -> Result<String, getrandom::Error> {
    let mut bytes = [0; TOKEN / 2];
    getrandom::fill(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Compares in a time that does not depend on where the texts differ.
fn same(given: &str, own: &str) -> bool {
    let differing = given.bytes().zip(own.bytes()).fold(0, |differing, (a, b)| differing | (a ^ b));
    given.len() == own.len() && differing == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_random_and_compared_whole() {
        let [a, b] = [Guard::new(1), Guard::new(1)].map(|guard| guard.expect("random numbers").token);
        assert_eq!(a.len(), TOKEN);
        assert!(a != b && same(&a, &a) && !same(&a, &b) && !same(&a[..31], &a) && !same("", &a));
    }
}
