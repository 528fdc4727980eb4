//! Settings that may be left to the program.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A value, or `"auto"`: the program chooses from the rest of the case.
///
/// ```
/// use sph_core::Auto;
/// let cfl: Auto<f64> = Auto::Auto;
/// assert_eq!(cfl.or(0.6), 0.6);
/// assert_eq!(Auto::from(0.4).or(0.6), 0.4);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Auto<T> {
    /// `"auto"`.
    #[default]
    #[serde(with = "word")]
    #[schemars(with = "Word")]
    Auto,
    /// The value itself.
    Value(T),
}

impl<T> Auto<T> {
    /// The value, or `usual` for `"auto"`.
    pub fn or(self, usual: T) -> T {
        self.value().unwrap_or(usual)
    }

    /// The value; `None` for `"auto"`.
    pub fn value(self) -> Option<T> {
        match self {
            Auto::Auto => None,
            Auto::Value(value) => Some(value),
        }
    }
}

impl<T> From<T> for Auto<T> {
    fn from(value: T) -> Auto<T> {
        Auto::Value(value)
    }
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Word {
    Auto,
}

/// The word `auto` in place of a value.
mod word {
    use super::Word;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
        Word::Auto.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(), D::Error> {
        Word::deserialize(deserializer).map(|Word::Auto| ())
    }
}
