//! An axis of a chart: its range, its place on paper, its ticks.

use super::ticks::{nice_step, powers, proper_range, tick_label, ticks};

/// An axis from `range` to `pixels`, which may run either way.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Values at its ends.
    pub range: [f64; 2],
    /// Where its ends are on paper [pixels].
    pub pixels: [f64; 2],
    /// In powers of ten.
    pub logarithmic: bool,
}

impl Axis {
    /// The place of a value on paper [pixels].
    ///
    /// Values far outside come out just as far outside on the same side: SVG readers calculate in single precision.
    pub fn at(&self, value: f64) -> f64 {
        const SPANS: f64 = 1e3;
        let map = |v: f64| if self.logarithmic { v.log10() } else { v };
        let [low, high] = self.range.map(map);
        let share = ((map(value) - low) / (high - low)).clamp(-SPANS, SPANS);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }

    /// Round values with their labels, about `count` of them.
    pub fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        let [low, high] = self.range;
        if !self.logarithmic {
            let step = nice_step(high - low, count);
            return ticks(self.range, step).map(|value| (value, powers(&tick_label(value, step)))).collect();
        }
        let multiples: &[f64] = if (high / low).log10() < 2.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
        let values = decades.flat_map(|k| multiples.iter().map(move |m| m * 10f64.powi(k)));
        let shown = values.filter(|v| *v >= low && *v <= high);
        shown.map(|value| (value, powers(&tick_label(value, value)))).collect()
    }
}

/// Least and greatest coordinate of all points, with a margin as a fraction of their distance. A
/// quantity that never changes sign and comes near zero is shown from zero.
pub(super) fn extent(curves: &[Vec<[f64; 2]>], axis: usize, margin: f64) -> [f64; 2] {
    let values = curves.iter().flatten().map(|p| p[axis]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let [low, high] = proper_range([low, high]);
    let margin = margin * (high - low);
    let end = |end: f64, other: f64, margin: f64| {
        let from_zero = margin != 0.0 && end * other >= 0.0 && end.abs() < 0.25 * other.abs();
        if from_zero { 0.0 } else { end + margin }
    };
    [end(low, high, -margin), end(high, low, margin)]
}

/// Least and greatest coordinate of all points, all above zero, with a margin in powers of ten.
pub(super) fn decades(curves: &[Vec<[f64; 2]>], axis: usize) -> [f64; 2] {
    let points = curves.iter().flatten().map(|p| p[axis].log10());
    let (low, high) = points.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let [low, high] = proper_range([low, high]);
    [low - 0.1, high + 0.1].map(|e| 10f64.powf(e.clamp(-300.0, 300.0)))
}
