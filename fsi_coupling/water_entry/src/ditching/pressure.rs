//! Pressure along the girth of a section of a landing, and its mean over windows (THEORY EN55).

use super::attitude::FREEDOMS;
use super::fuselage::Fuselage;
use super::hull::Hull;
use super::landing::{Landing, LandingState};
use super::strip::{ImpactingPart, along};

/// Parts of a wetted half breadth, of equal angles θ with y = c sin θ.
const PARTS: usize = 48;
/// Places along a window where its girth is taken.
const PLACES: usize = 50;

/// Pressure along half a girth at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct GirthPressure {
    /// Distances from the keel along the bottom [m], up to the edge of the wetted part; shape (n).
    pub girth: Vec<f64>,
    /// Integral of the pressure along the girth up to there [N/m], shape (n).
    pub integral: Vec<f64>,
}

/// A part of the bottom of each side.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// A word that names it.
    pub name: String,
    /// Front and rear end, from the nose [m].
    pub ends: [f64; 2],
    /// Its lower and upper border.
    pub girth: GirthRange,
}

/// Borders of a window along the girth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GirthRange {
    /// Share of the girth from the keel, 0, to the edge, 1 [-].
    Share([f64; 2]),
    /// Height over the body axis [m].
    Height([f64; 2]),
}

impl GirthPressure {
    /// EN55: of a part of a strip that presses with `force` [N] at accelerations of the aeroplane, in water of density ρ [kg/m³]; `None` where
    /// the theory has no pressure, and where the force is none.
    pub fn new(
        hull: &Hull,
        part: &ImpactingPart,
        force: f64,
        acceleration: &[f64; FREEDOMS],
        rho: f64,
    ) -> Option<GirthPressure> {
        let (b, loads) = (hull.fuselage().breadth(part.at.x), hull.nearest(part.at.x));
        let draught = part.at.draught / b;
        let c = loads.at(draught).wetted;
        if force <= 0.0 || c <= 0.0 {
            return None;
        }
        let (speed, rate) = (part.at.speed.max(0.0), part.at.bending - along(&part.lever, acceleration));
        let end = (0.5 / c).min(1.0).asin();
        let angle = |k: f64| end * k / PARTS as f64;
        // pressures at the middles of the parts, and their widths
        let middles: Option<Vec<[f64; 3]>> = (0..PARTS)
            .map(|k| {
                let (y, theta) = (c * angle(k as f64 + 0.5).sin(), angle(k as f64 + 0.5));
                let width = b * c * (angle(k as f64 + 1.0).sin() - angle(k as f64).sin());
                Some([loads.pressure(y, draught, speed, b * rate, rho)?, width, 1.0 / theta.cos()])
            })
            .collect();
        let middles = middles?;
        let sum = |k: usize| 2.0 * middles.iter().map(|m| m[k] * m[1]).sum::<f64>();
        let (by_theory, of_root, wanted) = (sum(0), sum(2), force / part.length);
        // what the change of the section adds grows as that of the wetted width does
        let (factor, added) = match wanted >= by_theory {
            true => (1.0, (wanted - by_theory) / of_root),
            false => (wanted / by_theory, 0.0),
        };
        let (mut girth, mut integral) = (vec![0.0], vec![0.0]);
        let (mut s, mut sum) = (0.0, 0.0);
        for (k, [pressure, width, root]) in middles.iter().enumerate() {
            let slope = loads.section().slope(c * angle(k as f64 + 0.5).sin());
            let length = width * (1.0 + slope * slope).sqrt();
            let pressure = factor * pressure + added * root;
            (s, sum) = (s + length, sum + pressure * length);
            girth.push(s);
            integral.push(sum);
        }
        Some(GirthPressure { girth, integral })
    }

    /// Integral of the pressure over a part of the girth, from and to distances from the keel [N/m].
    pub fn over(&self, [from, to]: [f64; 2]) -> f64 {
        let up_to = |s: f64| {
            let last = self.girth.len() - 1;
            let k = self.girth.partition_point(|at| *at < s).clamp(1, last);
            let share = ((s - self.girth[k - 1]) / (self.girth[k] - self.girth[k - 1])).clamp(0.0, 1.0);
            self.integral[k - 1] + share * (self.integral[k] - self.integral[k - 1])
        };
        up_to(to) - up_to(from)
    }
}

impl Hull {
    /// Girth of half the bottom at a place, from the keel to the edge [m].
    pub fn girth(&self, x: f64) -> f64 {
        let corners = self.nearest(x).section().corners();
        self.fuselage().breadth(x)
            * corners.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum::<f64>()
    }

    /// Distance from the keel along the bottom to a height over the keel, up to the edge [m].
    fn girth_to(&self, x: f64, height: f64) -> f64 {
        let b = self.fuselage().breadth(x);
        let of_face = |w: &[[f64; 2]]| {
            let rise = w[1][1] - w[0][1];
            let share = if rise > 0.0 {
                ((height / b - w[0][1]) / rise).clamp(0.0, 1.0)
            } else {
                f64::from(u8::from(height > b * w[0][1]))
            };
            share * (w[1][0] - w[0][0]).hypot(rise)
        };
        b * self.nearest(x).section().corners().windows(2).map(of_face).sum::<f64>()
    }
}

impl Window {
    /// Its borders at a place, from the keel along the bottom [m]; what lies above the edge of the bottom does not count.
    pub fn borders(&self, hull: &Hull, x: f64) -> [f64; 2] {
        match self.girth {
            GirthRange::Share(shares) => shares.map(|share| share * hull.girth(x)),
            GirthRange::Height(heights) => heights.map(|z| hull.girth_to(x, z - hull.fuselage().keel(x).height)),
        }
    }

    /// Its area on one side [m²].
    pub fn area(&self, hull: &Hull) -> f64 {
        let [from, to] = self.ends;
        let middle = |k: usize| from + (to - from) * (k as f64 + 0.5) / PLACES as f64;
        let girth = (0..PLACES).map(|k| self.borders(hull, middle(k))).map(|[low, high]| high - low).sum::<f64>();
        girth * (to - from) / PLACES as f64
    }

    /// Force of the pressure on it, of one side, over its area [Pa].
    pub fn mean_pressure(&self, landing: &Landing<'_>, now: &LandingState, area: f64) -> f64 {
        let of_strip = |(strip, force): &(super::Strip, f64)| {
            let part = strip.entry.as_ref()?;
            let half = 0.5 * part.length / part.at.shortening;
            let length = (part.at.x + half).min(self.ends[1]) - (part.at.x - half).max(self.ends[0]);
            if length <= 0.0 {
                return None;
            }
            let pressure = GirthPressure::new(landing.hull, part, *force, &now.acceleration, landing.water.density)?;
            Some(length * pressure.over(self.borders(landing.hull, part.at.x)))
        };
        now.strips.iter().filter_map(of_strip).sum::<f64>() / area
    }
}

/// Largest pressures on the cells of a grid of places × shares of the girth, in a landing.
#[derive(Clone, Debug, PartialEq)]
pub struct PressureMap {
    /// Borders of the cells, from the nose [m].
    pub places: Vec<f64>,
    /// Number of cells from keel to edge, of equal shares of the girth.
    pub shares: usize,
    /// Largest mean pressure over each cell [Pa] and its time [s], shape (places − 1, shares).
    pub mean: Vec<Vec<[f64; 2]>>,
}

impl PressureMap {
    /// A grid of `count` × `shares` cells of equal length along a fuselage.
    pub fn new(fuselage: &Fuselage, count: usize, shares: usize) -> PressureMap {
        let [from, to] = fuselage.ends();
        PressureMap {
            places: (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).collect(),
            shares,
            mean: vec![vec![[0.0; 2]; shares]; count],
        }
    }

    /// Add what a moment has; a cell's mean is over its whole length.
    pub fn add(&mut self, landing: &Landing<'_>, now: &LandingState) {
        let mut sums = vec![vec![0.0; self.shares]; self.mean.len()];
        for (strip, force) in &now.strips {
            let Some(part) = &strip.entry else { continue };
            let Some(pressure) =
                GirthPressure::new(landing.hull, part, *force, &now.acceleration, landing.water.density)
            else {
                continue;
            };
            let half = 0.5 * part.length / part.at.shortening;
            let girth = landing.hull.girth(part.at.x);
            let over = |k: usize| pressure.over([k, k + 1].map(|k| girth * k as f64 / self.shares as f64));
            let of_cells: Vec<f64> = (0..self.shares).map(|k| over(k) * self.shares as f64 / girth).collect();
            let first = self.places.partition_point(|x| *x <= part.at.x - half).max(1) - 1;
            for cell in first..self.mean.len() {
                let length = (part.at.x + half).min(self.places[cell + 1]) - (part.at.x - half).max(self.places[cell]);
                if length <= 0.0 {
                    break;
                }
                let share = length / (self.places[cell + 1] - self.places[cell]);
                sums[cell].iter_mut().zip(&of_cells).for_each(|(sum, mean)| *sum += share * mean);
            }
        }
        for (cells, sums) in self.mean.iter_mut().zip(&sums) {
            for (most, sum) in cells.iter_mut().zip(sums) {
                if *sum > most[0] {
                    *most = [*sum, now.time];
                }
            }
        }
    }
}
