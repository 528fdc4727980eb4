//! The load before a flow by boundary elements can be followed (THEORY EN20, EN30, EN50).

use std::array::from_fn;

use super::super::loads::{Load, Loads};
use super::super::model::OutOfRange;
use super::super::section::Section;
use super::solution::FlowLoad;
use super::state::EntryFlow;

/// Places of the pressure under a round bottom.
const PLACES: usize = 200;
/// Draughts between which the load of a round bottom goes over to that of its flow: of an arc over its radius, of another over that at which its
/// added keel is wet [-].
pub(super) const ROUND: [f64; 2] = [0.02, 0.04];
pub(super) const CURVED: [f64; 2] = [1.2, 2.4];
/// The half widths between which it does under a flat or nearly flat keel, over that of the added keel [-].
const FLAT: [f64; 2] = [1.2, 1.4];

/// The load at small draughts.
pub(super) enum Before {
    /// Of a wedge: that of the similar flow at a draught [m] and a downward speed [m/s].
    Similar(FlowLoad, [f64; 2]),
    /// Of a round bottom: the modified Logvinovich model (Korobkin 2004) and the buoyancy of still water, under a gravity [m/s²], and the draughts
    /// between which the flow takes over [m].
    Round(Box<Loads>, f64, [f64; 2]),
}

impl Before {
    /// Before a flow that has just begun, under a gravity [m/s²].
    pub fn new(section: &Section, flow: &EntryFlow, gravity: f64) -> Result<Before, OutOfRange> {
        let between = match section.radius() {
            Some(radius) => ROUND.map(|share| share * radius),
            None if section.is_round() => {
                CURVED.map(|share| share * section.wagner_draught(flow.face.keel_half_width()))
            }
            None if section.is_blunt() => FLAT.map(|share| section.wagner_draught(share * flow.face.keel_half_width())),
            None => return Ok(Before::Similar(flow.load(), [flow.draught(), flow.speed()])),
        };
        Ok(Before::Round(Box::new(Loads::before_flow(section)), gravity, between))
    }

    /// At a draught h [m] and a downward speed V [m/s]: force at constant speed and added mass, over the density [m³/s², m²].
    pub fn forces(&self, h: f64, v: f64) -> [f64; 2] {
        match self {
            Before::Similar(load, [draught, speed]) => load.scaled_forces(h / draught, v / speed),
            Before::Round(loads, gravity, _) => {
                let Load { slam, added_mass, .. } = loads.at(h);
                [slam * v * v + gravity * loads.section().still_area(h), added_mass]
            }
        }
    }

    /// The same with the pressure.
    pub fn load(&self, h: f64, v: f64) -> FlowLoad {
        match self {
            Before::Similar(load, [draught, speed]) => load.scaled(h / draught, v / speed),
            Before::Round(loads, ..) => {
                let Load { wetted: c, spreading, .. } = loads.at(h);
                let place = |k: usize| c * (0.5 * std::f64::consts::PI * k as f64 / PLACES as f64).cos();
                let at = |x: f64| {
                    let within = h > 0.0 && x <= loads.section().half_breadth();
                    let [slam, added] = if within { loads.pressure_factors(x, h, [c, spreading]) } else { [0.0; 2] };
                    [x, slam * v * v, added]
                };
                let [force, added_mass] = self.forces(h, v);
                FlowLoad { force, added_mass, pressure: (0..=PLACES).map(|k| at(place(k))).collect() }
            }
        }
    }

    /// Power of the draughts before the flow: under a flat keel A begins as h^{−1/3}.
    pub fn grading(&self) -> i32 {
        match self {
            Before::Round(loads, ..) if loads.section().flat_keel().is_some() => 3,
            _ => 1,
        }
    }

    /// Share of the flow's load at a draught [-].
    pub fn share_of_flow(&self, draught: f64) -> f64 {
        match self {
            Before::Similar(..) => 1.0,
            Before::Round(_, _, [from, to]) => ((draught - from) / (to - from)).clamp(0.0, 1.0),
        }
    }

    /// Force and added mass of a flow's load at a draught, or what stands for them: they change over linearly.
    pub fn forces_instead_of(&self, of_flow: &FlowLoad, draught: f64, speed: f64) -> [f64; 2] {
        let (share, of_flow) = (self.share_of_flow(draught), [of_flow.force, of_flow.added_mass]);
        if share >= 1.0 {
            return of_flow;
        }
        let own = self.forces(draught, speed);
        from_fn(|k| own[k] + share * (of_flow[k] - own[k]))
    }

    /// The same with the pressure, which changes over at the half.
    pub fn instead_of(&self, of_flow: FlowLoad, draught: f64, speed: f64) -> FlowLoad {
        let [force, added_mass] = self.forces_instead_of(&of_flow, draught, speed);
        let is_of_flow = self.share_of_flow(draught) > 0.5;
        let pressure = if is_of_flow { of_flow.pressure } else { self.load(draught, speed).pressure };
        FlowLoad { force, added_mass, pressure }
    }
}

impl FlowLoad {
    /// Of the similar flow with all lengths times `length` and all velocities times `speed`.
    fn scaled(&self, length: f64, speed: f64) -> FlowLoad {
        let ([force, added_mass], square) = (self.scaled_forces(length, speed), speed * speed);
        FlowLoad {
            force,
            added_mass,
            pressure: self.pressure.iter().map(|[x, p, m]| [x * length, p * square, m * length]).collect(),
        }
    }

    /// Its force and its added mass.
    fn scaled_forces(&self, length: f64, speed: f64) -> [f64; 2] {
        [self.force * length * (speed * speed), self.added_mass * length * length]
    }

    /// Half breadth of the wet face [m].
    pub(super) fn half_breadth(&self) -> f64 {
        self.pressure.first().map_or(0.0, |p| p[0])
    }
}
