//! Parts of an aeroplane that meet the water in addition to the fuselage: lifting surfaces and nacelles (THEORY EN25, EN26).

use std::f64::consts::PI;

use super::attitude::Attitude;
use super::form::Form;
use super::fuselage::{Fuselage, FuselageError, Station};
use super::hull::Hull;
use super::strip::Strip;
use super::swell::Swell;
use crate::EntryModel;

/// Strips along the span of one side of a surface.
const SPAN_STRIPS: usize = 200;
/// Strips along a nacelle.
const STRIPS: usize = 20;
/// Angle from a nacelle's keel at which the water leaves its side [rad].
const NACELLE_EDGE: f64 = PI / 4.0;

/// The end of a lifting surface's half span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rib {
    /// Leading edge: from the nose, from the plane of symmetry, over the body axis [m].
    pub leading_edge: [f64; 3],
    /// Chord [m].
    pub chord: f64,
}

/// A lifting surface whose lower side may meet the water, on both sides of the plane of symmetry: wing, flap, tailplane.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// A word that names it.
    pub name: String,
    /// At the root and at the tip; straight between.
    pub ribs: [Rib; 2],
    /// Angle of the chord over the body axis, nose up [rad].
    pub incidence: f64,
    /// Force of the water at which it is lost [N]; `None`: it holds.
    pub breaks_at: Option<f64>,
}

/// Engines or floats: bodies of revolution along the body axis.
#[derive(Clone, Debug)]
pub struct Nacelle {
    /// A word that names them.
    pub name: String,
    /// How many of them, side by side.
    pub number: f64,
    /// The face: from the nose, and its centre over the body axis [m].
    pub face: [f64; 2],
    /// Diameter [m].
    pub diameter: f64,
    /// Drag coefficient of the immersed part of the face [-].
    pub drag: f64,
    /// Force of the water on one at which it is lost [N]; `None`: it holds.
    pub breaks_at: Option<f64>,
    /// Its bottom.
    pub hull: Hull,
}

/// A part of the fuselage's bottom that gives way: then it carries no load, and the frame at its rear end stands against the water.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// A word that names it.
    pub name: String,
    /// Front and rear end, from the nose [m].
    pub ends: [f64; 2],
    /// Mean pressure over the breadth at which it gives way [Pa].
    pub gives_way_at: f64,
    /// Height of the frame over the keel [m].
    pub frame_height: f64,
    /// Drag coefficient of the frame's immersed part [-].
    pub drag: f64,
}

/// A force in the plane of symmetry at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointForce {
    /// Place from the nose along the body axis [m].
    pub x: f64,
    /// Forward and up [N], and its moment about the centre of mass, nose up [N m].
    pub force: [f64; 3],
}

/// Force [N] along `direction` at a place of an aeroplane.
fn point_force(now: &Attitude, centre: [f64; 2], at: [f64; 2], force: [f64; 2]) -> PointForce {
    let [ax, az] = now.of_point(centre, at);
    let [rx, rz] = [ax - now.place[0], az - now.place[1]];
    PointForce { x: at[0], force: [force[0], force[1], rx * force[1] - rz * force[0]] }
}

/// Depth of a place of an aeroplane below the surface [m].
fn draught(centre: [f64; 2], at: [f64; 2], now: &Attitude, swell: &Swell) -> f64 {
    let [x, z] = now.of_point(centre, at);
    swell.water(x).elevation - z
}

/// EN37: velocity of such a place through the water, forward and up [m/s].
fn through_water(centre: [f64; 2], at: [f64; 2], now: &Attitude, swell: &Swell) -> [f64; 2] {
    let ([u, w], water) = (now.velocity_of(centre, at), swell.water(now.of_point(centre, at)[0]).velocity);
    [u - water[0], w - water[1]]
}

/// EN25: coefficient of the force normal to a planing plate of aspect ratio A at an angle τ [rad] to its way
/// (Shuford 1958): ½π A/(1 + A) τ cos τ + (4/3) sin² τ.
pub fn planing_coefficient(aspect: f64, trim: f64) -> f64 {
    0.5 * PI * aspect / (1.0 + aspect) * trim * trim.cos() + 4.0 / 3.0 * trim.sin().powi(2)
}

/// The wet part of a strip across the span.
struct WetStrip {
    /// Its middle: from the nose, over the body axis [m].
    at: [f64; 2],
    /// Wetted chord [m].
    chord: f64,
    /// Speed of the plate [m/s], and the angle of its way below the chord [rad].
    speed: f64,
    trim: f64,
}

impl Surface {
    /// EN25: forces of the water on the strips of both sides, of density ρ [kg/m³].
    pub fn water(&self, centre: [f64; 2], now: &Attitude, swell: &Swell, rho: f64) -> Vec<PointForce> {
        let [root, tip] = self.ribs;
        let width = (tip.leading_edge[1] - root.leading_edge[1]) / SPAN_STRIPS as f64;
        let shares = (0..SPAN_STRIPS).map(|k| (k as f64 + 0.5) / SPAN_STRIPS as f64);
        let aft = [self.incidence.cos(), -self.incidence.sin()]; // along the chord
        let wet: Vec<WetStrip> = shares.filter_map(|share| self.wet_strip(share, aft, centre, now, swell)).collect();
        let span = width * wet.len() as f64;
        let area: f64 = wet.iter().map(|s| width * s.chord).sum();
        // the fuselage ends the flow at the root: both sides are one plate
        let aspect = 2.0 * span * span / area.max(f64::MIN_POSITIVE);
        let (sin, cos) = (now.place[2] + self.incidence).sin_cos();
        let on_strip = |s: &WetStrip| {
            let pressure = 0.5 * rho * s.speed * s.speed * planing_coefficient(aspect, s.trim);
            let normal = 2.0 * width * s.chord * pressure;
            point_force(now, centre, s.at, [-normal * sin, normal * cos])
        };
        wet.iter().map(on_strip).collect()
    }

    /// Leading and trailing edges at root and tip: from the nose, over the body axis [m].
    pub(super) fn corners(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let edge = |rib: &Rib, s: f64| {
            let [x, _, z] = rib.leading_edge;
            [x + s * rib.chord * self.incidence.cos(), z - s * rib.chord * self.incidence.sin()]
        };
        self.ribs.iter().flat_map(move |rib| [0.0, 1.0].map(|s| edge(rib, s)))
    }

    /// The part of a strip under the surface, from the trailing edge forwards, where it moves against the water.
    fn wet_strip(
        &self,
        share: f64,
        aft: [f64; 2],
        centre: [f64; 2],
        now: &Attitude,
        swell: &Swell,
    ) -> Option<WetStrip> {
        let [root, tip] = self.ribs;
        let mean = |a: f64, b: f64| a + share * (b - a);
        let chord = mean(root.chord, tip.chord);
        let leading = [0, 2].map(|k| mean(root.leading_edge[k], tip.leading_edge[k]));
        let place = |s: f64| [leading[0] + s * aft[0], leading[1] + s * aft[1]];
        let last = draught(centre, place(chord), now, swell);
        if last <= 0.0 {
            return None;
        }
        let first = draught(centre, place(0.0), now, swell);
        let dry = if first < 0.0 { chord * first / (first - last) } else { 0.0 };
        let at = place(0.5 * (dry + chord));
        let [u, w] = through_water(centre, at, now, swell);
        let trim = now.place[2] + self.incidence - w.atan2(u);
        let half_turn = 0.5 * PI;
        (trim > 0.0).then(|| WetStrip { at, chord: chord - dry, speed: u.hypot(w), trim: trim.min(half_turn) })
    }
}

impl Nacelle {
    /// Of its length [m], with the bottom's loads by a theory.
    ///
    /// # Errors
    /// A body that is none.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        name: String,
        number: f64,
        face: [f64; 2],
        diameter: f64,
        length: f64,
        drag: f64,
        breaks_at: Option<f64>,
        model: EntryModel,
    ) -> Result<Nacelle, FuselageError> {
        let station = |x: f64| Station {
            x,
            keel: face[1] - 0.5 * diameter,
            breadth: diameter * NACELLE_EDGE.sin(),
            form: Form::Radius(0.5 * diameter),
        };
        let bottom = Fuselage::new(&[station(face[0]), station(face[0] + length)])?;
        Ok(Nacelle { name, number, face, diameter, drag, breaks_at, hull: Hull::new(bottom, model)? })
    }

    /// Its lowest points: from the nose, over the body axis [m].
    pub(super) fn keel(&self) -> [[f64; 2]; 2] {
        self.hull.fuselage().ends().map(|x| [x, self.face[1] - 0.5 * self.diameter])
    }

    /// Ends of the strips, from the nose [m].
    pub(super) fn edges(&self) -> Vec<f64> {
        let [from, to] = self.hull.fuselage().ends();
        (0..=STRIPS).map(|k| from + (to - from) * k as f64 / STRIPS as f64).collect()
    }

    /// EN26: drag of the faces of all of them, of the part that is under the surface.
    pub fn face_drag(&self, centre: [f64; 2], now: &Attitude, swell: &Swell, rho: f64) -> Option<PointForce> {
        let [x, z] = self.face;
        let radius = 0.5 * self.diameter;
        let depth = draught(centre, [x, z - radius], now, swell);
        let area = segment(radius, depth);
        let middle = [x, z - radius + 0.5 * depth.min(self.diameter)];
        let [u, w] = through_water(centre, middle, now, swell);
        let of_speed = -0.5 * rho * self.drag * self.number * area * u.hypot(w);
        (area > 0.0 && u > 0.0).then(|| point_force(now, centre, middle, [of_speed * u, of_speed * w]))
    }
}

impl Panel {
    /// Is a place within it?
    pub(super) fn covers(&self, x: f64) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&x)
    }

    /// Does one of the strips with their forces [N] press it in?
    pub(super) fn is_pressed_in(&self, fuselage: &Fuselage, strips: &[(Strip, f64)]) -> bool {
        let pressure = |(strip, force): &(Strip, f64)| {
            let entry = strip.entry.filter(|e| self.covers(e.at.x))?;
            Some(force / (entry.length * fuselage.breadth(entry.at.x)))
        };
        strips.iter().filter_map(pressure).any(|pressure| pressure > self.gives_way_at)
    }

    /// EN26: drag of the frame at its rear end.
    pub(super) fn frame_drag(
        &self,
        fuselage: &Fuselage,
        centre: [f64; 2],
        now: &Attitude,
        swell: &Swell,
        rho: f64,
    ) -> Option<PointForce> {
        let x = self.ends[1];
        let keel = fuselage.keel(x).height;
        let depth = draught(centre, [x, keel], now, swell).min(self.frame_height);
        let middle = [x, keel + 0.5 * depth];
        let [u, w] = through_water(centre, middle, now, swell);
        let of_speed = -0.5 * rho * self.drag * fuselage.breadth(x) * depth * u.hypot(w);
        (depth > 0.0 && u > 0.0).then(|| point_force(now, centre, middle, [of_speed * u, of_speed * w]))
    }
}

/// Area of a circle below a chord at a height over its lowest point [m²].
fn segment(radius: f64, height: f64) -> f64 {
    let away = (radius - height.clamp(0.0, 2.0 * radius)) / radius;
    radius * radius * (away.acos() - away * (1.0 - away * away).sqrt())
}
