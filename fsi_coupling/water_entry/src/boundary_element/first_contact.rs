//! The first contact of a round bottom that bends: Wagner's plate, as wide as the wet part of the bottom (THEORY EN60–EN62).

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::super::section::Section;
use super::FlowEnded;
use super::before::{CURVED, ROUND};
use super::deflection::{AlongBottom, BottomMotion};
use super::state::EntryFlow;

/// Angles of the means over the plate, and terms of the series of the potential.
const ANGLES: usize = 64;
const TERMS: usize = 24;
/// Places of the pressure, from the edge of the plate to the keel.
const PLACES: usize = 200;
/// Repetitions of the search for the wet part.
const BISECTIONS: usize = 50;
/// Places of the girth.
const GIRTH: usize = 400;
/// Growth of the wet half width per step [-].
const WIDTH_GROWTH: f64 = 0.03;

/// A round bottom that meets the water.
#[derive(Clone, Debug)]
pub(super) struct FirstContact {
    section: Section,
    /// Distance from the plane of symmetry and from the keel along the rigid bottom [m], at even steps of the former.
    girth: Vec<[f64; 2]>,
    gravity: f64,
    /// Draughts of the rigid bottom between which the load goes over to that of the flow [m].
    between: [f64; 2],
}

/// The load at an instant, over the density.
pub(super) struct PlateLoad<'a> {
    of: &'a FirstContact,
    motion: BottomMotion,
    /// Half width c of the wet part [m], and its growth [m/s].
    pub half_width: f64,
    growth: f64,
    potential: Potential,
}

/// EN61: φ on a plate |x| < c with a given even velocity upwards, Σ a_k sin(k arccos(x/c)) of odd k.
struct Potential {
    half_width: f64,
    terms: [f64; TERMS],
}

/// A mean over the plate, (2/π) ∫₀^{π/2} of(c sin θ) dθ.
fn mean_over_plate(half_width: f64, of: impl Fn(f64) -> f64) -> f64 {
    let step = FRAC_PI_2 / ANGLES as f64;
    (0..ANGLES).map(|k| of(half_width * ((k as f64 + 0.5) * step).sin())).sum::<f64>() / ANGLES as f64
}

impl Potential {
    fn new(half_width: f64, upwards: impl Fn(f64) -> f64) -> Potential {
        let step = FRAC_PI_2 / ANGLES as f64;
        let mut terms = [0.0; TERMS];
        for angle in (0..ANGLES).map(|j| (j as f64 + 0.5) * step) {
            let flux = 2.0 * FRAC_2_PI * step * half_width * upwards(half_width * angle.cos()) * angle.sin();
            for (term, k) in terms.iter_mut().zip(odd()) {
                *term += flux * (k * angle).sin() / k;
            }
        }
        Potential { half_width, terms }
    }

    /// φ [m²/s] and φ_x [m/s] at a place inside the plate.
    fn at(&self, x: f64) -> [f64; 2] {
        let angle = (x / self.half_width).acos();
        let terms = || self.terms.iter().zip(odd());
        let phi: f64 = terms().map(|(a, k)| a * (k * angle).sin()).sum();
        let along: f64 = terms().map(|(a, k)| a * k * (k * angle).cos()).sum();
        [phi, -along / (self.half_width * angle.sin())]
    }

    /// B of φ → B √(c² − x²) at the edge [m/s].
    fn at_edge(&self) -> f64 {
        self.terms.iter().zip(odd()).map(|(a, k)| a * k).sum::<f64>() / self.half_width
    }
}

fn odd() -> impl Iterator<Item = f64> {
    (0..TERMS).map(|k| (2 * k + 1) as f64)
}

impl FirstContact {
    /// Of a round bottom whose flow is the one given, under a gravity [m/s²].
    pub fn new(section: &Section, flow: &EntryFlow, gravity: f64) -> FirstContact {
        let half_breadth = section.followed_half_breadth();
        let places = (0..=GIRTH).map(|k| half_breadth * k as f64 / GIRTH as f64);
        let between = match section.radius() {
            Some(radius) => ROUND.map(|share| share * radius),
            None => CURVED.map(|share| share * section.wagner_draught(flow.face.keel_half_width())),
        };
        FirstContact {
            section: section.convex(),
            girth: places.map(|x| [x, flow.along_bottom(x)]).collect(),
            gravity,
            between,
        }
    }

    /// Distance from the keel along the rigid bottom [m].
    fn along(&self, x: f64) -> f64 {
        let last = self.girth.len() - 1;
        let at = (x / self.girth[last][0] * last as f64).max(0.0);
        let k = (at as usize).min(last - 1);
        let [[_, a], [_, b]] = [self.girth[k], self.girth[k + 1]];
        a + (at - k as f64) * (b - a)
    }

    /// Upward part of what is given along the bottom, at x; and its slope there.
    fn upwards(&self, of: &AlongBottom, x: f64) -> [f64; 2] {
        let slope = self.section.slope(x);
        let [value, per_length] = of.sample(self.along(x)).map(|value| value.im);
        [value, per_length * (1.0 + slope * slope).sqrt()]
    }

    /// The half width, of those on the bottom, up to which a mean height of the bottom over the water is below nothing [m].
    pub fn half_width(&self, above: &dyn Fn(f64) -> f64) -> f64 {
        let [mut low, mut high] = [0.0, self.girth[self.girth.len() - 1][0]];
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if above(middle) < 0.0 { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// EN60: the load of a bottom that moves.
    ///
    /// # Errors
    /// A bottom that bends as fast as the water comes.
    pub fn load(&self, motion: BottomMotion) -> Result<PlateLoad<'_>, FlowEnded> {
        let displaced = |x: f64| self.upwards(&motion.deflection.displacement, x)[0];
        let rising = |x: f64| self.upwards(&motion.deflection.velocity, x)[0];
        let above = |c: f64| self.section.wagner_draught(c) + mean_over_plate(c, displaced) - motion.draught;
        let half_width = self.half_width(&above);
        let [less, more] = [0.99, 1.01].map(|share| mean_over_plate(share * half_width, displaced));
        let slope = self.section.wagner_slope(half_width) + (more - less) / (0.02 * half_width);
        let growth = (motion.speed - mean_over_plate(half_width, rising)) / slope;
        if !(growth > 0.0 && growth.is_finite()) {
            return Err(FlowEnded { draught: motion.draught, speed: motion.speed });
        }
        let potential = Potential::new(half_width, |x| rising(x) - motion.speed);
        Ok(PlateLoad { of: self, motion, half_width, growth, potential })
    }

    /// Share of the flow's load where a half width is wet [-].
    pub fn share_of_flow(&self, half_width: f64) -> f64 {
        let [from, to] = self.between;
        ((self.section.wagner_draught(half_width) - from) / (to - from)).clamp(0.0, 1.0)
    }
}

impl PlateLoad<'_> {
    /// Longest step [s].
    pub fn longest_dt(&self) -> f64 {
        WIDTH_GROWTH * self.half_width / self.growth
    }

    /// Downward speed of the rigid bottom under which the wet part would grow as fast [m/s].
    pub fn speed_of_rigid(&self) -> f64 {
        self.growth * self.of.section.wagner_slope(self.half_width)
    }

    /// Upward displacement of the bottom at the edge of the wet part [m].
    pub fn displacement_at_edge(&self) -> f64 {
        self.of.upwards(&self.motion.deflection.displacement, self.half_width)[0]
    }

    /// Distances from the plane of symmetry [m], from the edge to the keel.
    pub fn places(&self) -> Vec<f64> {
        (0..=PLACES).map(|k| self.half_width * (FRAC_PI_2 * k as f64 / PLACES as f64).cos()).collect()
    }

    /// Distance from the keel along the rigid bottom [m].
    pub fn along(&self, x: f64) -> f64 {
        self.of.along(x)
    }

    /// Height of the bottom over still water [m], and its slope.
    fn bottom(&self, x: f64) -> [f64; 2] {
        let [displaced, slope] = self.of.upwards(&self.motion.deflection.displacement, x);
        let section = &self.of.section;
        [section.height(x) + displaced - self.motion.draught, section.slope(x) + slope]
    }

    /// EN62: p/ρ without accelerations [m²/s²] at distances from the plane of symmetry that fall from the edge to the keel.
    pub fn steady(&self, places: &[f64]) -> Vec<f64> {
        let mut dry = true;
        let inside = |x: f64, dry: &mut bool| {
            let slam = self.slam(x);
            *dry &= slam <= 0.0;
            let still = self.of.gravity * (-self.bottom(x)[0]).max(0.0);
            if *dry { still } else { slam + still }
        };
        places.iter().map(|x| if *x < self.half_width { inside(*x, &mut dry) } else { 0.0 }).collect()
    }

    fn slam(&self, x: f64) -> f64 {
        let ([_, phi_x], [height, slope]) = (self.potential.at(x), self.bottom(x));
        let [rising, steeper] = self.of.upwards(&self.motion.deflection.velocity, x);
        let w = rising - self.motion.speed;
        let root = (self.half_width * self.half_width - x * x).sqrt();
        let spreads = self.potential.at_edge() * self.half_width * self.growth / root;
        let along = phi_x + slope * w + height * steeper;
        let across = 1.0 / (1.0 + slope * slope);
        -spreads - w * w - across * (0.5 * along * along - slope * w * along - 0.5 * w * w)
    }

    /// EN62: p/ρ at such places due to accelerations along the bottom [m²/s²].
    pub fn pressure_of(&self, acceleration: &AlongBottom, places: &[f64]) -> Vec<f64> {
        let upwards = |x: f64| self.of.upwards(acceleration, x)[0];
        let potential = Potential::new(self.half_width, upwards);
        let at = |x: f64| -potential.at(x)[0] - self.bottom(x)[0] * upwards(x);
        places.iter().map(|x| if *x < self.half_width { at(*x) } else { 0.0 }).collect()
    }
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::super::super::loads::Loads;
    use super::super::super::model::EntryModel;
    use super::super::deflection::Deflection;
    use super::*;

    fn straight(value: f64, slope: f64) -> AlongBottom {
        AlongBottom::new(&[0.0, 0.3, 0.6], [0.0, 0.3, 0.6].map(|s| c64::new(0.0, value + slope * s)).to_vec())
    }

    /// A rigid bottom has the pressure of the modified Logvinovich model, also when its motion is counted as a deflection.
    #[test]
    fn a_rigid_bottom() {
        let section = Section::arc(1.0, 1.2).expect("an arc");
        let (draught, speed, gravity) = (0.012, 3.0, 0.0);
        let loads = Loads::new(EntryModel::Mlm, &section.convex()).expect("loads");
        let flow = EntryFlow::new(&section, 0.02, speed, gravity).expect("a flow");
        let contact = FirstContact::new(&section, &flow, gravity);
        for lifted in [0.0, 0.02] {
            let deflection = Deflection { displacement: straight(lifted, 0.0), velocity: straight(0.5 * lifted, 0.0) };
            let motion = BottomMotion { draught: draught + lifted, speed: speed + 0.5 * lifted, deflection };
            let load = contact.load(motion).expect("a load");
            assert!((load.half_width / loads.at(draught).wetted - 1.0).abs() < 2e-3, "{}", load.half_width);
            let places = [0.85, 0.6, 0.3, 0.1].map(|share| share * load.half_width);
            let [steady, added] = [load.steady(&places), load.pressure_of(&straight(-2.0, 0.0), &places)];
            for (k, x) in places.into_iter().enumerate() {
                let at = |speed, rate| loads.pressure(x, draught, speed, rate, 1.0).expect("a pressure");
                assert!((steady[k] / at(speed, 0.0) - 1.0).abs() < 0.02, "{x}: {} {}", steady[k], at(speed, 0.0));
                assert!((added[k] / at(0.0, 2.0) - 1.0).abs() < 0.01, "{x}: {} {}", added[k], at(0.0, 2.0));
            }
        }
    }

    /// φ of a plate with the velocity x² upwards is (c² + 2x²) √(c² − x²)/6.
    #[test]
    fn potential_of_a_parabola() {
        let c: f64 = 0.4;
        let potential = Potential::new(c, |x| x * x);
        for x in [0.0, 0.1, 0.25, 0.35] {
            let root = (c * c - x * x).sqrt();
            let [phi, phi_x] = potential.at(x);
            assert!((phi - root * (c * c + 2.0 * x * x) / 6.0).abs() < 1e-5, "{x}: {phi}");
            let exact = 4.0 * x * root / 6.0 - x * (c * c + 2.0 * x * x) / (6.0 * root);
            assert!((phi_x - exact).abs() < 1e-3 * c * c, "{x}: {phi_x} {exact}");
        }
        assert!((potential.at_edge() - 0.5 * c * c).abs() < 1e-4);
    }
}
