//! Settings that document and check themselves.
//!
//! A struct of settings is declared once. Its doc comments, types and serde defaults become a JSON Schema (`schemars`), and
//! the schema gives the keywords, the reference page and the checks:
//!
//! | on a field | effect |
//! |---|---|
//! | doc comment | the meaning; `[m/s]` at the end of its first sentence is the unit |
//! | serde's default | the value of an absent key |
//! | `schemars(range(min = 0.0, max = 1.0))`, `extend("exclusiveMinimum" = 0)` | other values are refused |
//! | `schemars(extend("x-default" = "end/500"))` | the program finds the value of an absent key, as described |
//! | `schemars(with = "Auto<f64>")` | the word `auto` means the same as an absent key (`sph_core::Auto`) |
//! | `schemars(extend("x-when" = ".scheme = iqn_ils"))` | the key is refused where it has no effect |
//! | `schemars(extend("x-neutral" = 0))` | under another tag the key may stand with this value only, else off or with its default |
//! | `schemars(extend("x-ignored-elsewhere" = true))` | under another tag the key is ignored |
//! | a map | each key has a value of its kind; `serde_json::Value` takes anything |
//! | an untagged enum of values of several kinds | the kind of the given value selects; `x-takes` says what is expected |
//! | `serde(flatten)` of an enum with `serde(tag = "shape")` | the tag's value selects the keys; `x-shape-default`, `x-shape-doc` |
//!
//! ```
//! use settings::Schema;
//!
//! /// A drop of water.
//! #[derive(serde::Deserialize, schemars::JsonSchema)]
//! struct Droplet {
//!     /// Radius [m].
//!     #[schemars(extend("exclusiveMinimum" = 0))]
//!     radius: f64,
//! }
//!
//! let schema = Schema::of::<Droplet>("a drop");
//! assert_eq!(schema.keywords()[0].help(), "radius [m]: Radius; a finite number above 0 (required)");
//! let refused = schema.check(&serde_json::json!({"radius": -1.0})).unwrap_err();
//! assert_eq!(refused.sentence, "`radius` = -1: expected a finite number above 0");
//! let unknown = schema.check(&serde_json::json!({"radios": 1.0})).unwrap_err();
//! assert_eq!(unknown.sentence, "unknown key `radios`: expected a key of a drop, such as `radius`");
//! ```

mod check;
mod keyword;
mod node;
mod problem;
mod schema;
#[cfg(test)]
mod tests;
mod units;

pub use keyword::Keyword;
pub use problem::{DataLine, Problem, require, significant};
pub use schema::{OrTouching, Schema};
pub use units::{convert, is_quantity};
