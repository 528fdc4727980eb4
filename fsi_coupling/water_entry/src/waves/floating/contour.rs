//! The closed line round the water about a section: its wet outline, the surface on both sides, and two ends (THEORY WA17).

use std::f64::consts::TAU;

/// Panels per wavelength on the surface, and at least on the wet outline.
const PER_WAVE: f64 = 64.0;
const ON_OUTLINE: f64 = 96.0;
/// Panels of an end.
const ON_END: usize = 28;
/// Panels shrink towards the section, the waterline and the surface with this power of their number.
const GRADED: f64 = 1.3;
/// Reach of the surface to each side: wavelengths and depths.
const REACH: [f64; 2] = [1.8, 1.2];
/// Most panels of the surface on a side, and fewest per wavelength.
const MOST: f64 = 420.0;
const FEWEST: f64 = 24.0;
/// Depth that counts, in wavelengths and in draughts: below it the water is at rest.
const DEEP: [f64; 2] = [1.5, 10.0];

/// What a panel is a part of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    Section,
    Surface,
    End,
}

/// A straight panel; the water is to its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub ends: [[f64; 2]; 2],
    pub middle: [f64; 2],
    pub tangent: [f64; 2],
    /// Out of the water [-].
    pub normal: [f64; 2],
    pub length: f64,
    pub part: Part,
}

impl Panel {
    fn between(a: [f64; 2], b: [f64; 2], part: Part) -> Panel {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let tangent = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        Panel { ends: [a, b], middle, tangent, normal: [tangent[1], -tangent[0]], length, part }
    }
}

/// Panels from the right end of the surface to the section, round it, to the left end, down and up the ends; and the depth that counts [m]. `None` where they would be
/// too many.
pub(super) fn contour(wet: &[[f64; 2]], wave_number: f64, depth: f64) -> Option<(Vec<Panel>, f64)> {
    let wave = TAU / wave_number;
    let draught = -wet.iter().map(|p| p[1]).fold(0.0, f64::min);
    let depth = depth.min((DEEP[0] * wave).max(DEEP[1] * draught));
    let reach = REACH[0] * wave + REACH[1] * depth;
    let mut panels = Vec::new();
    // shares of a line, graded towards its end (towards = 1), its start (0) or not at all
    let mut line = |a: [f64; 2], b: [f64; 2], n: usize, towards: Option<bool>, part: Part| {
        let share = |i: usize| {
            let s = i as f64 / n as f64;
            match towards {
                Some(true) => 1.0 - (1.0 - s).powf(GRADED),
                Some(false) => s.powf(GRADED),
                None => s,
            }
        };
        let at = |i: usize| [0, 1].map(|k| a[k] + (b[k] - a[k]) * share(i));
        panels.extend((0..n).map(|i| Panel::between(at(i), at(i + 1), part)));
    };
    let per_wave = PER_WAVE.min(MOST * wave / reach);
    (per_wave >= FEWEST).then_some(())?;
    let on_surface = (per_wave * reach / wave).ceil() as usize;
    let (right, left) = (wet[0], wet[wet.len() - 1]);
    line([right[0] + reach, 0.0], right, on_surface, Some(true), Part::Surface);
    let total: f64 = wet.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
    let size = (total / ON_OUTLINE).min(wave / PER_WAVE);
    for (k, p) in wet.windows(2).enumerate() {
        let n = ((p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]) / size).ceil().max(1.0) as usize;
        let towards = match k {
            0 => Some(false),
            _ if k + 2 == wet.len() => Some(true),
            _ => None,
        };
        line(p[0], p[1], n, towards, Part::Section);
    }
    line(left, [left[0] - reach, 0.0], on_surface, Some(false), Part::Surface);
    line([left[0] - reach, 0.0], [left[0] - reach, -depth], ON_END, Some(false), Part::End);
    line([right[0] + reach, -depth], [right[0] + reach, 0.0], ON_END, Some(true), Part::End);
    Some((panels, depth))
}

/// The part below y = 0 of a counter-clockwise outline, from the right waterline to the left one; `None` where the outline does not cross the
/// surface just twice.
pub(super) fn wet_part(outline: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let n = outline.len();
    let falls = |i: usize| outline[i][1] > 0.0 && outline[(i + 1) % n][1] <= 0.0;
    let rises = |i: usize| outline[i][1] <= 0.0 && outline[(i + 1) % n][1] > 0.0;
    let (down, up): (Vec<usize>, Vec<usize>) =
        ((0..n).filter(|i| falls(*i)).collect(), (0..n).filter(|i| rises(*i)).collect());
    let ([down], [up]) = (&down[..], &up[..]) else { return None };
    let crossing = |i: usize| {
        let (a, b) = (outline[i], outline[(i + 1) % n]);
        [a[0] + (b[0] - a[0]) * a[1] / (a[1] - b[1]), 0.0]
    };
    let mut wet = vec![crossing(*down)];
    let mut i = (down + 1) % n;
    while i != (up + 1) % n {
        if outline[i][1] < 0.0 {
            wet.push(outline[i]);
        }
        i = (i + 1) % n;
    }
    wet.push(crossing(*up));
    wet.reverse();
    (wet.len() >= 3 && wet[0][0] > wet[wet.len() - 1][0]).then_some(wet)
}
