//! How well the program's numbers agree with references, by quantity (THEORY GE28): points, bias and scatter.
//!
//! The points are those of `splashdown validate --all`, and part of the program: a run's page quotes from them.

mod point;
mod quantity;
mod statistics;

use std::sync::LazyLock;

pub use point::{Nature, Pedigree, Point, Setup};
pub use quantity::Quantity;
pub use statistics::{LEAST_POINTS, Statistics};

/// The points of this program, written by `splashdown validate --all --evidence scenarios/run/charts/evidence.json`.
static POINTS: LazyLock<Vec<Point>> = LazyLock::new(|| {
    let text = include_str!("../../charts/evidence.json");
    serde_json::from_str(text).expect("scenarios/run/charts/evidence.json is a list of points")
});

/// Bias and scatter of a quantity by a model, `wcsph` for example, against all references of this program; `None` below [`LEAST_POINTS`].
pub fn known(quantity: Quantity, model: &str) -> Option<Statistics> {
    let points: Vec<&Point> = POINTS.iter().filter(|p| p.quantity == quantity && p.model == model).collect();
    Statistics::of(&points).filter(|found| found.scatter.is_some())
}
