//! An aeroplane at rest on water: waterline and trim (THEORY EN57).

use super::form::Form;
use super::fuselage::Fuselage;
use super::monotone::Monotone;

/// Slices along a fuselage.
const SLICES: usize = 120;
/// Levels between keel and top at which a slice's breadth is taken.
const LEVELS: usize = 64;
/// Steepest trim that is looked for, dz/dx [-].
const STEEPEST: f64 = 0.6;
/// Step of the search for the trim, dz/dx [-].
const SEARCH: f64 = 0.02;
/// Most rounds of the search for a zero.
const ROUNDS: usize = 100;

/// The volume inside a fuselage, by slices across the body axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    slices: Vec<Slice>,
    /// Length of a slice [m].
    length: f64,
}

/// Half breadths of a slice at equal steps of height.
#[derive(Clone, Debug, PartialEq)]
struct Slice {
    /// From the nose [m].
    x: f64,
    /// Heights of keel and top over the body axis [m].
    ends: [f64; 2],
    /// Breadth at each level [m], shape (LEVELS + 1).
    breadth: Vec<f64>,
    /// Area and its moment about the keel below each level [m², m³], shape (LEVELS + 1).
    below: Vec<[f64; 2]>,
}

/// A plane of water in the axes of a body: z = `level` + `slope` (x − `about`) over the body axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Waterline {
    /// Place where its level is given, from the nose [m].
    pub about: f64,
    /// Height over the body axis there [m].
    pub level: f64,
    /// Tangent of the trim, nose up [-].
    pub slope: f64,
}

impl Waterline {
    /// Height over the body axis at x from the nose [m].
    pub fn at(&self, x: f64) -> f64 {
        self.level + self.slope * (x - self.about)
    }
}

impl Slice {
    fn new(x: f64, ends: [f64; 2], half_breadth: impl Fn(f64) -> f64) -> Slice {
        let step = (ends[1] - ends[0]) / LEVELS as f64;
        let breadth: Vec<f64> = (0..=LEVELS).map(|k| 2.0 * half_breadth(k as f64 / LEVELS as f64)).collect();
        let mut below = vec![[0.0; 2]];
        for k in 0..LEVELS {
            let [area, moment] = below[k];
            let [of_part, first] = part(step, breadth[k], breadth[k + 1]);
            below.push([area + of_part, moment + first + of_part * k as f64 * step]);
        }
        Slice { x, ends, breadth, below }
    }

    /// Area below a height over the body axis [m²], and its moment about the body axis [m³].
    fn below(&self, height: f64) -> [f64; 2] {
        let step = (self.ends[1] - self.ends[0]) / LEVELS as f64;
        let at = ((height - self.ends[0]) / step).clamp(0.0, LEVELS as f64);
        let k = (at as usize).min(LEVELS - 1);
        let share = at - k as f64;
        let upper = self.breadth[k] + share * (self.breadth[k + 1] - self.breadth[k]);
        let [of_part, first] = part(share * step, self.breadth[k], upper);
        let [area, moment] = self.below[k];
        let sum = area + of_part;
        [sum, moment + first + of_part * k as f64 * step + self.ends[0] * sum]
    }
}

/// Area of a trapezium of a height and its moment about its lower side.
fn part(height: f64, lower: f64, upper: f64) -> [f64; 2] {
    [0.5 * height * (lower + upper), height * height * (lower + 2.0 * upper) / 6.0]
}

impl Volume {
    /// Of slices of equal length between two places [m]; of each the heights of keel and top over the body axis [m], and the half breadth [m] at a
    /// share of the height between them.
    pub fn new([from, to]: [f64; 2], ends: impl Fn(f64) -> [f64; 2], half_breadth: impl Fn(f64, f64) -> f64) -> Volume {
        let length = (to - from) / SLICES as f64;
        let slice = |k: usize| {
            let x = from + length * (k as f64 + 0.5);
            Slice::new(x, ends(x), |share| half_breadth(x, share))
        };
        Volume { slices: (0..SLICES).map(slice).collect(), length }
    }

    /// EN57: of a fuselage: outlines as they are, arcs as whole circles, wedges with upright sides as high as they are broad.
    pub fn of_fuselage(fuselage: &Fuselage) -> Volume {
        let stations = fuselage.stations();
        let whole: Vec<Vec<[f64; 2]>> = stations.iter().map(|s| whole_half(&s.form, s.breadth)).collect();
        let curve = |of: &dyn Fn(&Vec<[f64; 2]>) -> f64| {
            Monotone::through(stations.iter().map(|s| s.x).collect(), whole.iter().map(of).collect())
        };
        let height = curve(&|line| line.iter().map(|p| p[1]).fold(0.0, f64::max));
        let widest = curve(&|line| line.iter().map(|p| p[0]).fold(0.0, f64::max));
        let shape = |k: usize, share: f64| {
            let [widest, top] = [0, 1].map(|c| whole[k].iter().map(|p| p[c]).fold(0.0, f64::max));
            half_at(&whole[k], share * top) / widest
        };
        let ends = |x: f64| {
            let keel = fuselage.keel(x).height;
            [keel, keel + height.at(x)[0]]
        };
        Volume::new(fuselage.ends(), ends, |x, share| {
            let (k, part) = fuselage.between(x);
            widest.at(x)[0] * (shape(k, share) + part * (shape(k + 1, share) - shape(k, share)))
        })
    }

    /// Volume [m³].
    pub fn whole(&self) -> f64 {
        self.below(&Waterline { level: f64::INFINITY, ..Waterline::default() })[0]
    }

    /// Volume below a plane [m³], and its moments about nose and body axis, ∫x dV and ∫z dV [m⁴].
    pub fn below(&self, plane: &Waterline) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for slice in &self.slices {
            let height = if plane.level.is_finite() { plane.at(slice.x) } else { plane.level };
            let [area, moment] = slice.below(height);
            sum[0] += area * self.length;
            sum[1] += area * self.length * slice.x;
            sum[2] += moment * self.length;
        }
        sum
    }

    /// The plane of a slope below which there is a volume [m³]; of too large a volume the one over all of it.
    pub fn filled(&self, volume: f64, about: f64, slope: f64) -> Waterline {
        let reach = self.slices.iter().map(|s| slope.abs() * (s.x - about).abs()).fold(0.0, f64::max);
        let ends = |k: usize| self.slices.iter().map(move |s| s.ends[k]);
        let low = ends(0).fold(f64::INFINITY, f64::min) - reach;
        let high = ends(1).fold(f64::NEG_INFINITY, f64::max) + reach;
        let plane = |level: f64| Waterline { about, level, slope };
        plane(crossing([low, high], |level| self.below(&plane(level))[0] - volume))
    }

    /// EN57: waterline of a body that floats with a mass over the water's density [m³] and a centre of mass from the nose and over the body axis [m],
    /// with a volume of water inside [m³], and the waterline of that water; `None` where it sinks, or has no attitude of balance within 31°.
    ///
    /// The trim of balance nearest to the slope `near` [-] is taken.
    pub fn afloat(&self, mass: f64, centre: [f64; 2], inside: f64, near: f64) -> Option<[Waterline; 2]> {
        let displaced = mass + inside;
        if displaced >= self.whole() {
            return None;
        }
        let planes = |slope: f64| [displaced, inside].map(|volume| self.filled(volume, centre[0], slope));
        // arm of the buoyancy less that of the water inside about the centre of mass, along the plane of the water
        let arm = |slope: f64| {
            let [outer, inner] = planes(slope).map(|plane| self.below(&plane));
            let along = |k: usize| outer[k] - inner[k] - mass * centre[k - 1];
            along(1) + slope * along(2)
        };
        // nose up sinks the tail: the arm grows with the trim where the trim is stable
        let ends = [near - 0.5 * SEARCH, near + 0.5 * SEARCH];
        let (mut around, mut bracket) = (ends.map(|slope| (slope, arm(slope))), None);
        let is_stable = |a: f64, b: f64| a < 0.0 && b >= 0.0;
        if is_stable(around[0].1, around[1].1) {
            bracket = Some(ends);
        }
        while bracket.is_none() && (around[0].0 > -STEEPEST || around[1].0 < STEEPEST) {
            let out = [around[0].0 - SEARCH, around[1].0 + SEARCH].map(|slope| (slope, arm(slope)));
            if is_stable(out[0].1, around[0].1) {
                bracket = Some([out[0].0, around[0].0]);
            } else if is_stable(around[1].1, out[1].1) {
                bracket = Some([around[1].0, out[1].0]);
            }
            around = out;
        }
        bracket.map(|bracket| planes(crossing(bracket, arm)))
    }
}

/// Where a function that grows crosses zero between two places: the rule of false position (Illinois).
fn crossing([mut low, mut high]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (of(low), of(high));
    if at_low >= 0.0 || at_high <= 0.0 {
        return if at_low >= 0.0 { low } else { high };
    }
    let (tolerance, mut last) = (1e-12 * (high - low), 0);
    for round in 0..ROUNDS {
        // every third round halves the interval
        let secant = low - at_low * (high - low) / (at_high - at_low);
        let middle = if round % 3 == 2 { 0.5 * (low + high) } else { secant.clamp(low, high) };
        let value = of(middle);
        if value == 0.0 || high - low < tolerance {
            return middle;
        }
        match value < 0.0 {
            true => {
                (low, at_low) = (middle, value);
                at_high *= if last == -1 { 0.5 } else { 1.0 };
                last = -1;
            }
            false => {
                (high, at_high) = (middle, value);
                at_low *= if last == 1 { 0.5 } else { 1.0 };
                last = 1;
            }
        }
    }
    0.5 * (low + high)
}

/// The whole half section of a form: from the keel to the top [m].
fn whole_half(form: &Form, breadth: f64) -> Vec<[f64; 2]> {
    match form {
        Form::Outline(points) => points.clone(),
        Form::Radius(radius) => (0..=LEVELS)
            .map(|k| std::f64::consts::PI * k as f64 / LEVELS as f64)
            .map(|angle| [radius * angle.sin(), radius * (1.0 - angle.cos())])
            .collect(),
        Form::DeadriseDeg(deadrise) => {
            let (half, rise) = (0.5 * breadth, 0.5 * breadth * deadrise.to_radians().tan());
            vec![[0.0, 0.0], [half, rise], [half, rise + breadth]]
        }
    }
}

/// Half breadth at a height over the keel, the outermost [m].
fn half_at(line: &[[f64; 2]], height: f64) -> f64 {
    let crossed = line.windows(2).filter_map(|w| {
        let ([x0, z0], [x1, z1]) = (w[0], w[1]);
        let (low, high) = (z0.min(z1), z0.max(z1));
        let share = if z1 == z0 { 1.0 } else { (height - z0) / (z1 - z0) };
        (low - 1e-12..=high + 1e-12).contains(&height).then_some(if z1 == z0 {
            x0.max(x1)
        } else {
            x0 + share * (x1 - x0)
        })
    });
    crossed.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box barge 20 × 4 × 3 m: draught of its mass, and trim by the inclined plane of water: exact centroids of a trapezium.
    #[test]
    fn a_box_floats_at_its_exact_waterline_and_trim() {
        let barge = Volume::new([0.0, 20.0], |_| [-1.0, 2.0], |_, _| 2.0);
        assert!((barge.whole() - 240.0).abs() < 1e-9);
        let level = barge.afloat(80.0, [10.0, 0.0], 0.0, 0.0).expect("it floats")[0];
        assert!((level.level - 0.0).abs() < 1e-8 && level.slope.abs() < 1e-8, "{level:?}");
        // a draught of 1 m in the middle at a trim t has the centre of buoyancy at (L²/12) t aft and ½ + (L²/24) t² over the keel
        for trim in [0.02_f64, 0.05] {
            let above = 0.4 - (-1.0 + 0.5 + 400.0 / 24.0 * trim * trim);
            let aft = 400.0 / 12.0 * trim - above * trim;
            let found = barge.afloat(80.0, [10.0 + aft, 0.4], 0.0, 0.0).expect("it floats")[0];
            assert!((found.slope / trim - 1.0).abs() < 1e-3 && (found.at(10.0)).abs() < 1e-3, "{trim}: {found:?}");
        }
        assert!(
            barge.afloat(250.0, [10.0, 0.0], 0.0, 0.0).is_none() && barge.afloat(80.0, [19.0, 0.0], 0.0, 0.0).is_none()
        );
    }
}
