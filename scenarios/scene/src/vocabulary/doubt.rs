//! Doubts about results.

use std::fmt;

use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};

/// Why a number is doubted.
#[derive(Clone, Debug, PartialEq)]
pub struct Why {
    /// In a sentence.
    pub text: String,
    /// Where a draught is too small: how small, and what would do.
    pub shallow: Option<Shallow>,
    /// True where a panel is beyond its limits: what it may carry is then doubted, not how well its stress is known.
    pub beyond_limit: bool,
}

/// A draught that is too small for a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shallow {
    /// The draught [spacings].
    pub draught_spacings: f64,
    /// What would do.
    pub cure: String,
}

impl Why {
    /// A draught that is too small: what it is the draught of, in words that end before the number.
    pub fn shallow(what: &str, draught_spacings: f64, cure: String) -> Why {
        let spacings = settings::significant(draught_spacings);
        Why {
            text: format!("{what} {spacings} spacings; {cure}"),
            shallow: Some(Shallow { draught_spacings, cure }),
            beyond_limit: false,
        }
    }
}

impl From<String> for Why {
    fn from(text: String) -> Why {
        Why { text, shallow: None, beyond_limit: false }
    }
}

impl From<&str> for Why {
    fn from(text: &str) -> Why {
        text.to_string().into()
    }
}

/// A doubt: about which numbers of `summary.json`, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// Names of results, or of other numbers such as `audit.energy`; empty for a doubt about the whole run.
    pub about: Vec<String>,
    /// Why.
    pub why: Why,
}

impl Doubt {
    /// About one number.
    pub fn about(name: impl fmt::Display, why: impl Into<Why>) -> Doubt {
        Doubt { about: vec![name.to_string()], why: why.into() }
    }

    /// About the whole run.
    pub fn of_run(why: impl Into<Why>) -> Doubt {
        Doubt { about: Vec::new(), why: why.into() }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.about.is_empty() {
            write!(out, "{}: ", self.about.join(", "))?;
        }
        out.write_str(&self.why.text)
    }
}

/// The doubts of a run, each reason once. In `summary.json` they are `doubts`, in sentences, and `doubt_details`, in the same order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Doubts(Vec<Doubt>);

impl Doubts {
    /// A doubt more; one with a known reason adds its numbers to that.
    pub fn add(&mut self, doubt: Doubt) {
        match self.0.iter_mut().find(|known| known.why == doubt.why) {
            Some(known) => known.about.extend(doubt.about),
            None => self.0.push(doubt),
        }
    }

    /// All.
    pub fn iter(&self) -> impl Iterator<Item = &Doubt> {
        self.0.iter()
    }

    /// True without any.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Extend<Doubt> for Doubts {
    fn extend<T: IntoIterator<Item = Doubt>>(&mut self, doubts: T) {
        doubts.into_iter().for_each(|doubt| self.add(doubt));
    }
}

impl FromIterator<Doubt> for Doubts {
    fn from_iter<T: IntoIterator<Item = Doubt>>(doubts: T) -> Doubts {
        Doubts(doubts.into_iter().collect())
    }
}

/// A doubt in `doubt_details`.
#[derive(Serialize, Deserialize)]
struct Detail {
    about: Vec<String>,
    why: String,
    #[serde(flatten)]
    shallow: Option<Shallow>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    beyond_limit: bool,
}

impl Serialize for Doubts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let sentences: Vec<String> = self.0.iter().map(Doubt::to_string).collect();
        let detail = |Doubt { about, why: Why { text, shallow, beyond_limit } }: &Doubt| Detail {
            about: about.clone(),
            why: text.clone(),
            shallow: shallow.clone(),
            beyond_limit: *beyond_limit,
        };
        let mut map = serializer.serialize_map(Some(2))?;
        map.serialize_entry("doubts", &sentences)?;
        map.serialize_entry("doubt_details", &self.0.iter().map(detail).collect::<Vec<_>>())?;
        map.end()
    }
}

/// Both lists, as read. A summary of an earlier version has sentences alone, `NAMES: WHY`.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Read {
    doubts: Vec<String>,
    doubt_details: Vec<Detail>,
}

impl<'de> Deserialize<'de> for Doubts {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Doubts, D::Error> {
        let Read { doubts, doubt_details } = Read::deserialize(deserializer)?;
        let detailed = |Detail { about, why, shallow, beyond_limit }: Detail| Doubt {
            about,
            why: Why { text: why, shallow, beyond_limit },
        };
        if doubt_details.len() == doubts.len() {
            return Ok(doubt_details.into_iter().map(detailed).collect());
        }
        let of_sentence = |sentence: String| match sentence.split_once(": ") {
            Some((names, why)) => Doubt { about: names.split(", ").map(String::from).collect(), why: why.into() },
            None => Doubt::of_run(sentence),
        };
        Ok(doubts.into_iter().map(of_sentence).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_is_given_once_and_comes_back_from_its_file() {
        let mut doubts = Doubts::default();
        let shallow = Why::shallow("the peak comes at a draught of", 1.6718, "6 are needed".into());
        doubts.add(Doubt::about("peak_force_N_per_m", shallow.clone()));
        doubts.add(Doubt::of_run("it broke down"));
        doubts.add(Doubt::about("peak_acceleration_g", shallow));
        let sentences: Vec<String> = doubts.iter().map(Doubt::to_string).collect();
        let expected =
            "peak_force_N_per_m, peak_acceleration_g: the peak comes at a draught of 1.672 spacings; 6 are needed";
        assert_eq!(sentences, [expected, "it broke down"]);
        let text = serde_json::to_string(&doubts).expect("JSON");
        assert_eq!(serde_json::from_str::<Doubts>(&text).expect("what was written"), doubts);
        let old = serde_json::json!({"doubts": sentences});
        let read: Doubts = serde_json::from_value(old).expect("sentences");
        assert_eq!(read.iter().next().map(|doubt| doubt.about.len()), Some(2));
    }
}
