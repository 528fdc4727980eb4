//! Plate midlines: they hide what is behind them (THEORY WA8), and particles that cross them are found (WA11).

use serde::{Deserialize, Serialize};

use crate::particles::Particles;

/// The middle line of a thin wall, moving; its owner gives it for every step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlateMidline {
    /// Corners of the line at the end of the step [m].
    pub points: Vec<[f64; 2]>,
    /// The same corners at the start of the step [m]; empty: they did not move.
    pub start: Vec<[f64; 2]>,
    /// Half the wall's thickness [m].
    pub half_thickness: f64,
    /// True for a line that is its own image in the plane of symmetry.
    pub own_image: bool,
}

/// A fluid particle that crossed a midline in the step just taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Index of the particle.
    pub particle: usize,
    /// Index of the midline.
    pub midline: usize,
    /// The place of the midline where it went through, at the step's end [m].
    pub at: [f64; 2],
    /// Unit normal of the midline there, to the side that the particle came from [-].
    pub normal: [f64; 2],
}

/// Inner corners of a line overlap by this share of a side, so that nothing slips through while they turn.
const LAP: f64 = 1e-3;

impl PlateMidline {
    /// The midline `offset` [s] from the end of a step of `dt` [s], between its start and its end.
    pub fn at(&self, offset: f64, dt: f64) -> PlateMidline {
        let back = if dt > 0.0 { -offset / dt } else { 0.0 };
        if self.start.len() != self.points.len() || back == 0.0 {
            return PlateMidline { start: Vec::new(), ..self.clone() };
        }
        let between = |(end, start): (&[f64; 2], &[f64; 2])| mix(*end, *start, back);
        PlateMidline { points: self.points.iter().zip(&self.start).map(between).collect(), start: Vec::new(), ..*self }
    }

    /// WA11: where a particle that moved from `from` to `to` [m] in the step crossed the midline, and the normal to
    /// the side it came from; `None` if it is on the same side, or went round an end.
    pub fn passed(&self, from: [f64; 2], to: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
        let start = if self.start.len() == self.points.len() { &self.start } else { &self.points };
        let (mut found, mut times, mut at_corner) = (None, 0, None);
        let sides = self.points.len().saturating_sub(1);
        for k in 0..sides {
            let (before, after) = ([start[k], start[k + 1]], [self.points[k], self.points[k + 1]]);
            let (s0, s1) = (height(before, from), height(after, to));
            if s0 * s1 >= 0.0 {
                continue;
            }
            let t = s0 / (s0 - s1);
            let [a, b] = [0, 1].map(|end| mix(before[end], after[end], t));
            let (way, r) = (minus(b, a), minus(mix(from, to, t), a));
            let along = (r[0] * way[0] + r[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
            let lap = |end: bool| if end { 0.0 } else { LAP };
            if along < -lap(k == 0) || along > 1.0 + lap(k + 1 == sides) {
                continue;
            }
            if along < LAP && at_corner == Some(k) {
                continue; // through the corner that the side before ends at: counted once
            }
            at_corner = (along > 1.0 - LAP).then_some(k + 1);
            times += 1;
            let way = minus(after[1], after[0]);
            let to_left = s0.signum() / way[0].hypot(way[1]);
            found.get_or_insert((mix(after[0], after[1], along), [-way[1] * to_left, way[0] * to_left]));
        }
        found.filter(|_| times % 2 == 1)
    }

    /// Corners [least, largest] of an upright rectangle about the line, at both ends of the step [m].
    fn bounds(&self) -> [[f64; 2]; 2] {
        bounds(self.points.iter().chain(&self.start))
    }
}

/// Corners [least, largest] of an upright rectangle about points [m].
pub(crate) fn bounds<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> [[f64; 2]; 2] {
    points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[lo, hi], p| {
        [[lo[0].min(p[0]), lo[1].min(p[1])], [hi[0].max(p[0]), hi[1].max(p[1])]]
    })
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn mix(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

/// Height of `p` above a side, to its left, times the side's length [m²].
fn height([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// WA11: note where every particle starts the step, where there are thin plates.
pub(crate) fn note_start_positions(start: &mut Vec<[f64; 2]>, p: &Particles, lines: &[PlateMidline]) {
    if lines.is_empty() {
        return;
    }
    start.resize(p.len(), [0.0; 2]);
    for k in 0..p.len() {
        start[p.id[k] as usize] = [p.x[k], p.y[k]];
    }
}

/// WA11: the fluid particles that crossed a midline in the step just taken, in the order of the particles.
pub(crate) fn passages(p: &Particles, start: &[[f64; 2]], lines: &[PlateMidline]) -> Vec<Passage> {
    let mut found = Vec::new();
    if start.len() != p.len() {
        return found;
    }
    for (midline, line) in lines.iter().enumerate() {
        let [lo, hi] = line.bounds();
        for particle in 0..p.len() {
            let (from, to) = (start[p.id[particle] as usize], [p.x[particle], p.y[particle]]);
            let beside = |c: usize| from[c].max(to[c]) < lo[c] || from[c].min(to[c]) > hi[c];
            if beside(0) || beside(1) {
                continue;
            }
            if let Some((at, normal)) = line.passed(from, to) {
                found.push(Passage { particle, midline, at, normal });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn upright(x: f64) -> Vec<[f64; 2]> {
        vec![[x, 0.0], [x, 0.5], [x, 1.0]]
    }

    #[test]
    fn going_through_differs_from_going_round() {
        let still = PlateMidline { points: upright(0.0), ..PlateMidline::default() };
        let (at, normal) = still.passed([0.1, 0.2], [-0.1, 0.4]).expect("through the middle");
        assert!(at[0].abs() < 1e-15 && (at[1] - 0.3).abs() < 1e-15 && normal == [1.0, 0.0], "{at:?} {normal:?}");
        assert!(still.passed([-0.1, 0.5], [0.1, 0.5]).is_some(), "through a corner");
        assert!(still.passed([-0.1, 0.4999], [0.1, 0.5003]).is_some(), "beside a corner");
        let bend = PlateMidline { points: vec![[-0.5, 0.5], [0.0, 0.0], [0.5, 0.5]], ..PlateMidline::default() };
        assert_eq!(bend.passed([-0.2, 0.1], [0.2, 0.1]), None, "in through one side, out through the next");
        assert_eq!(still.passed([0.1, 0.95], [-0.1, 1.06]), None, "round the end");
        assert_eq!(still.passed([0.1, 0.2], [0.001, 0.4]), None);
    }

    /// A plate that moves past a particle at rest has been crossed; one that the particle follows has not.
    #[test]
    fn the_motion_of_the_midline_counts() {
        let moved = PlateMidline { points: upright(0.2), start: upright(0.0), ..PlateMidline::default() };
        let (at, normal) = moved.passed([0.1, 0.3], [0.1, 0.3]).expect("swept over");
        assert!((at[0] - 0.2).abs() < 1e-15 && normal == [1.0, 0.0], "put before the plate: {at:?} {normal:?}");
        assert_eq!(moved.passed([-0.1, 0.3], [0.1, 0.3]), None);
        assert_eq!(moved.at(-0.05, 0.1).points[1][0], 0.1);
    }
}
