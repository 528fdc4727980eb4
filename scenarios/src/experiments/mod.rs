//! Experiments: many runs of scenes, and what they show together.
//!
//! Every experiment has the same five parts. A **case** is a TOML file in `scenarios/cases` that names a scene, overrides and
//! numbers of `summary.json` ([`catalogue`]). Its **axes** give one list of overrides per run. The **runs** ([`runs`]) are all
//! read before the first starts; they are made one after another or side by side, and may be stored and resumed. A **judge**
//! reads their numbers. The result is written as JSON, as a Markdown table, and for most as a page.
//!
//! | command | module | axes | judge |
//! |---|---|---|---|
//! | `validate` | [`validation`] | the case; a coarser run | tolerances against measured and exact values |
//! | `study`, `run --converge` | [`convergence`] | spacings, sound speeds | observed order, extrapolated value, error bar |
//! | `run --to` | [`accuracy`] | models, spacings | bands of the quoted results |
//! | `bands` | [`coverage`] | spacings in the ratio 4 : 2 : 1 | does the error bar contain the exact value? |
//! | `bands --uncharted` | [`uncharted`] | angles, speeds, spacings at random | does a charted error bar contain the exact value? |
//! | `bands --drops` | [`drops`] | drops of wedges and arcs at random | does the band of a quoted result contain that of boundary elements? |
//! | `chart` | [`work_precision`] | families of settings at growing effort | error against cost, Pareto front |
//! | `stability` | [`stability`] | two parameters | stable, inaccurate or failed, against a theoretical boundary |
//!
//! # Example
//! ```
//! use scenarios::experiments::validation::CASES;
//!
//! let case = CASES.select(&["hydrostatic_tank".to_string()])?.remove(0);
//! assert_eq!(case.scene, "hydrostatic_tank");
//! # Ok::<(), scenarios::experiments::ExperimentError>(())
//! ```

pub mod accuracy;
pub mod catalogue;
pub mod convergence;
pub mod coverage;
pub mod drops;
mod error;
pub mod runs;
pub mod stability;
pub mod uncharted;
pub mod validation;
pub mod work_precision;

pub use error::ExperimentError;

/// Whether a number holds, in a Markdown table.
fn yes(holds: bool) -> String {
    if holds { "yes" } else { "**no**" }.into()
}
