//! The vertical motion of a section that enters water, by a theory's loads.

use super::given_motion::GivenMotion;
use super::loads::{Load, Loads};
use super::model::{EntryModel, OutOfRange};
use super::section::Section;

/// How the section moves.
#[derive(Clone, Debug)]
pub enum SectionMotion {
    /// On at its speed.
    Constant,
    /// By its weight and the water's load: mass of the whole section [kg/m].
    Free(f64),
    /// As it is given, whatever the load; `draught` and `speed` beside it are those at t = 0.
    Given(GivenMotion),
}

impl SectionMotion {
    /// EN50: speed after contact over that before: a flat keel gives the water the momentum ρMV at once.
    pub(super) fn kept_at_contact(&self, section: &Section, density: f64) -> f64 {
        match self {
            SectionMotion::Constant | SectionMotion::Given(_) => 1.0,
            SectionMotion::Free(mass) => mass / (mass + density * section.mass_at_contact()),
        }
    }

    /// The acceleration in air [m/s²] of a section at a draught [m] and a downward speed [m/s], the time of its contact [s], and its speed then.
    pub fn contact(&self, [draught, speed]: [f64; 2], gravity: f64) -> [f64; 3] {
        if let SectionMotion::Given(way) = self {
            let time = way.contact();
            return [0.0, time, way.at(time)[1]];
        }
        let g = if matches!(self, SectionMotion::Free(_)) { gravity } else { 0.0 };
        let height = -draught;
        let time = if height > 0.0 { 2.0 * height / (speed + (speed * speed + 2.0 * g * height).sqrt()) } else { 0.0 };
        [g, time, speed + g * time]
    }
}

/// A section on its way into the water.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    /// Its loads.
    pub loads: &'a Loads,
    /// How it moves.
    pub motion: SectionMotion,
    /// Draught of the keel at t = 0 [m]; negative above the water.
    pub draught: f64,
    /// Downward speed at t = 0 [m/s].
    pub speed: f64,
    /// Acceleration of gravity, downward [m/s²].
    pub gravity: f64,
    /// Density of the water ρ [kg/m³].
    pub density: f64,
    /// Is the buoyancy of the part below still water included?
    pub buoyancy: bool,
    /// Is it followed where its bottom gets steeper than the theory's range?
    pub steep: bool,
}

/// The section at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time [s].
    pub time: f64,
    /// Draught of the keel [m].
    pub draught: f64,
    /// Downward speed [m/s].
    pub speed: f64,
    /// Downward acceleration [m/s²].
    pub rate: f64,
    /// Upward force of the water [N/m], buoyancy included.
    pub force: f64,
    /// Half width of the wetted bottom [m].
    pub wetted: f64,
}

impl Instant {
    /// A share of the way from one moment to another [-], at a time [s]: draught and speed cubic by their rates, the others linear.
    pub fn between(a: &Instant, b: &Instant, share: f64, time: f64) -> Instant {
        let mix = |a: f64, b: f64| a + share * (b - a);
        let length = b.time - a.time;
        let cubic = |of: [f64; 2], rates: [f64; 2]| {
            let [from, to] = [share, 1.0 - share];
            let bent = to * (rates[0] * length - (of[1] - of[0])) - from * (rates[1] * length - (of[1] - of[0]));
            mix(of[0], of[1]) + from * to * bent
        };
        Instant {
            time,
            draught: cubic([a.draught, b.draught], [a.speed, b.speed]),
            speed: cubic([a.speed, b.speed], [a.rate, b.rate]),
            rate: mix(a.rate, b.rate),
            force: mix(a.force, b.force),
            wetted: mix(a.wetted, b.wetted),
        }
    }
}

/// Least number of steps of the integration.
const STEPS: f64 = 400.0;

impl Entry<'_> {
    /// The section at `times` [s], which increase from 0 on: the classical Runge–Kutta method.
    ///
    /// # Errors
    /// The body stops going down (the models do not describe exit), or its wetted bottom leaves the model's range.
    pub fn solve(&self, times: &[f64]) -> Result<Vec<Instant>, OutOfRange> {
        let (instants, end) = self.solve_while_in_range(times);
        end.map_or(Ok(instants), Err)
    }

    /// The same up to where the model's range ends, and why it does.
    pub fn solve_while_in_range(&self, times: &[f64]) -> (Vec<Instant>, Option<OutOfRange>) {
        let end = times.last().copied().unwrap_or(0.0);
        let (mut state, mut now) = ([self.draught, self.speed], 0.0);
        let mut instants = Vec::with_capacity(times.len());
        for &time in times {
            if let SectionMotion::Given(way) = &self.motion {
                let [draught, speed, _] = way.at(time);
                (state, now) = ([draught, speed], time);
            }
            let steps = ((time - now) / end.max(f64::MIN_POSITIVE) * STEPS).ceil().max(1.0);
            let dt = (time - now) / steps;
            for _ in 0..steps as usize {
                state = self.step(state, dt);
            }
            now = time;
            let instant = self.instant(time, state);
            if let Err(refused) = self.refuse(&instant) {
                return (instants, Some(refused));
            }
            instants.push(instant);
        }
        (instants, None)
    }

    /// EN10: (m + ρM) dV/dt = m g − ρA V² − ρ g S, or V constant.
    fn instant(&self, time: f64, [draught, speed]: [f64; 2]) -> Instant {
        let Load { wetted, slam, added_mass, .. } = self.loads.at(draught);
        let rho = self.density;
        let area = if self.buoyancy { self.loads.section().still_area(draught) } else { 0.0 };
        let steady = rho * (slam * speed * speed + self.gravity * area);
        let rate = match &self.motion {
            SectionMotion::Constant => 0.0,
            SectionMotion::Given(way) => way.at(time)[2],
            SectionMotion::Free(mass) => (mass * self.gravity - steady) / (mass + rho * added_mass),
        };
        Instant { time, draught, speed, rate, force: steady + rho * added_mass * rate, wetted }
    }

    fn step(&self, [h, v]: [f64; 2], dt: f64) -> [f64; 2] {
        let slope = |[h, v]: [f64; 2]| [v, self.instant(0.0, [h, v]).rate];
        let ahead = |[a, b]: [f64; 2], dt: f64| [h + dt * a, v + dt * b];
        let k1 = slope([h, v]);
        let k2 = slope(ahead(k1, 0.5 * dt));
        let k3 = slope(ahead(k2, 0.5 * dt));
        let k4 = slope(ahead(k3, dt));
        let [end, speed] = std::array::from_fn(|i| [h, v][i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        let touches = h <= 0.0 && end > 0.0;
        [end, if touches { speed * self.motion.kept_at_contact(self.loads.section(), self.density) } else { speed }]
    }

    fn refuse(&self, now: &Instant) -> Result<(), OutOfRange> {
        if now.speed <= 0.0 && now.draught > 0.0 {
            let what = format!("a body that leaves the water, from t = {:.4} s on", now.time);
            return Err(OutOfRange { what, range: "bodies on their way down".into(), next: EntryModel::Wcsph });
        }
        if self.steep {
            return Ok(());
        }
        self.loads.model().covers(self.loads.section(), now.wetted)
    }
}
