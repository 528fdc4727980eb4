//! Seeded variations of three situations in which water turns from inside to surface and back: a light body comes up from
//! below, a light body falls in and comes out again, water falls back onto water.
//!
//! A run holds if it ends, no particle is beyond a wall at any step, no speed exceeds three times √(2gH) + the speeds at the
//! start (H: from the highest point to the floor), and the energy of water and body never exceeds its start by more than a
//! share of the largest kinetic energy, or by that of a ripple as high as a spacing, ½ρgΔx²B, where that is more.

use std::f64::consts::TAU;
use std::fmt::Write;

use fsi_coupling::geometry::polygon;
use fsi_coupling::{Coupled, CouplingError};
use run::build;
use scene::Scene;
use sph_core::SplitMix64;

use crate::statistics::Noise;

/// Half width, depth and height of the walls of the tank [m].
const TANK: [f64; 3] = [0.7, 0.75, 1.8];
/// Spacing [m]: 900 particles.
const SPACING: f64 = 0.0335;
/// End of a run [s].
const END: f64 = 1.2;
/// Largest speed over that of everything falling from the highest to the floor.
const SPEED: f64 = 3.0;
/// Steps after which a run has stalled.
const MOST_STEPS: u64 = 20_000;

/// What a seed stands for.
pub struct Variation {
    /// Its number.
    pub seed: u64,
    /// What it is, in words and numbers.
    pub what: String,
    /// The scene.
    pub scene: Scene,
    /// A speed that nothing should come near: that of a fall from the highest point to the floor, and the speeds at the
    /// start [m/s].
    pub fall: f64,
}

/// How a run went.
pub struct Verdict {
    /// Fluid particles.
    pub particles: usize,
    /// Steps.
    pub steps: u64,
    /// Where the run ended [s], and why, if early.
    pub end: String,
    /// Fastest particle over the fall's speed, and when [s].
    pub fastest: [f64; 2],
    /// Largest energy from nowhere over the largest kinetic energy, and when [s].
    pub gain: [f64; 2],
    /// The step that gained most: how much [J/m], when and where.
    pub jump: String,
    /// What failed; empty if nothing did.
    pub failures: Vec<String>,
}

struct Draw(Noise);

impl Draw {
    fn of(seed: u64) -> Draw {
        Draw(Noise::new(SplitMix64(seed).bits())) // neighbouring seeds far apart
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + 0.5 * (self.0.draw() + 1.0) * (to - from)
    }
}

/// A body's outline about its centroid, counter-clockwise, and what it is.
fn outline(draw: &mut Draw) -> (String, Vec<[f64; 2]>) {
    let size = draw.between(0.22, 0.32);
    let (what, points) = match draw.between(0.0, 3.0) {
        kind if kind < 1.0 => {
            let corner = |k: u32| (TAU * f64::from(k) / 24.0).sin_cos();
            let points = (0..24).map(corner).map(|(s, c)| [0.5 * size * s, -0.5 * size * c]).collect();
            (format!("cylinder of {size:.3} m"), points)
        }
        kind if kind < 2.0 => {
            let [x, y] = [0.5 * size, 0.5 * draw.between(0.21, 0.3)];
            (format!("box of {:.3} by {:.3} m", 2.0 * x, 2.0 * y), vec![[-x, -y], [x, -y], [x, y], [-x, y]])
        }
        _ => {
            let (x, deadrise, side) = (0.5 * size + 0.03, draw.between(15.0, 45.0), draw.between(0.18, 0.24));
            let chine = x * deadrise.to_radians().tan();
            let points = vec![[0.0, 0.0], [x, chine], [x, chine + side], [-x, chine + side], [-x, chine]];
            (format!("wedge of {deadrise:.0} degrees, {:.3} m broad, sides {side:.3} m", 2.0 * x), points)
        }
    };
    let [cx, cy] = polygon::centroid(&points);
    (what, points.into_iter().map(|[x, y]| [x - cx, y - cy]).collect())
}

/// Moment of inertia of a polygon about its centroid, the origin, over its density [m⁴]: Σ (a × b)(a·a + a·b + b·b)/12.
fn second_moment(points: &[[f64; 2]]) -> f64 {
    let of = |([ax, ay], [bx, by]): ([f64; 2], [f64; 2])| {
        (ax * by - bx * ay) * (ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by) / 12.0
    };
    polygon::edges(points).map(of).sum()
}

/// The variation of a seed: seeds 0, 1, 2 modulo 3 rise, plunge, pour.
pub fn variation(seed: u64, sets: &[&str]) -> Variation {
    let mut draw = Draw::of(seed);
    let [half, depth, height] = TANK;
    let mut text = format!(
        "name = \"surfacing\"\ntime = {{ end = {END} }}\nresolution = {{ spacing = {SPACING}, growth = 1.0 }}\n\
         fluid = {{ sound_speed = 40.0, artificial_viscosity = 0.0 }}\ncoupling = {{ scheme = \"added_mass\" }}\n\
         [tank]\nwidth = {}\ndepth = {depth}\nheight = {height}\n",
        2.0 * half
    );
    let (what, top, speed) = match seed % 3 {
        0 => rises(&mut draw, &mut text),
        1 => plunges(&mut draw, &mut text),
        _ => pours(&mut draw, &mut text),
    };
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    let scene = run::load_text("surfacing", &text, &sets).unwrap_or_else(|e| panic!("seed {seed}: {e}\n{text}")).scene;
    Variation { seed, what, scene, fall: (2.0 * 9.81 * (depth + top)).sqrt() + speed }
}

fn body(text: &mut String, points: &[[f64; 2]], density: f64, at: [f64; 2], angle: f64, velocity: [f64; 2], spin: f64) {
    let (mass, inertia) = (density * polygon::signed_area(points), density * second_moment(points));
    let _ = write!(
        text,
        "[body]\nshape = \"polygon\"\npoints = {points:?}\nmass = {mass}\ninertia = {inertia}\nposition = {at:?}\n\
         angle_deg = {angle}\nvelocity = {velocity:?}\nangular_velocity_deg_per_s = {spin}\n"
    );
}

fn radius(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max)
}

fn rises(draw: &mut Draw, text: &mut String) -> (String, f64, f64) {
    let (what, points) = outline(draw);
    let share = draw.between(0.05, 0.8);
    let r = radius(&points);
    let at = [draw.between(-0.1, 0.1), draw.between(r + 0.07 - TANK[1], -r - 0.02)];
    let (angle, spin) = (draw.between(-180.0, 180.0), draw.between(-200.0, 200.0));
    let velocity = [draw.between(-0.3, 0.3), draw.between(0.0, 1.0)];
    body(text, &points, 1000.0 * share, at, angle, velocity, spin);
    let speed = velocity[0].hypot(velocity[1]) + spin.abs().to_radians() * r;
    let words = format!(
        "rises: {what}, density {share:.3}, from ({:.3}, {:.3}) m at {angle:.0} degrees with ({:.2}, {:.2}) m/s, {spin:.0} degrees/s",
        at[0], at[1], velocity[0], velocity[1]
    );
    (words, 0.0, speed)
}

fn plunges(draw: &mut Draw, text: &mut String) -> (String, f64, f64) {
    let (what, points) = outline(draw);
    let share = draw.between(0.05, 0.8);
    let r = radius(&points);
    let at = [draw.between(-0.15, 0.15), r + draw.between(0.01, 0.05)];
    let (angle, spin) = (draw.between(-180.0, 180.0), draw.between(-300.0, 300.0));
    // heavier bodies slower: none is to reach the floor
    let velocity = [draw.between(-0.4, 0.4), -draw.between(1.0, 3.0 - 1.5 * share)];
    body(text, &points, 1000.0 * share, at, angle, velocity, spin);
    let speed = velocity[0].hypot(velocity[1]) + spin.abs().to_radians() * r;
    let words = format!(
        "plunges: {what}, density {share:.3}, from ({:.3}, {:.3}) m at {angle:.0} degrees with ({:.2}, {:.2}) m/s, {spin:.0} degrees/s",
        at[0], at[1], velocity[0], velocity[1]
    );
    (words, at[1] + r, speed)
}

fn pours(draw: &mut Draw, text: &mut String) -> (String, f64, f64) {
    let [width, tall] = [draw.between(0.14, 0.4), draw.between(0.14, 0.5)];
    let (x, gap) = (draw.between(-TANK[0], TANK[0] - width), draw.between(0.0, 0.5));
    let velocity = [draw.between(-1.5, 1.5), draw.between(-3.0, 1.0)];
    let depth = draw.between(0.2, 0.6);
    *text = text.replacen(&format!("depth = {}", TANK[1]), &format!("depth = {depth}"), 1);
    let (from, to) = ([x, gap], [x + width, gap + tall]);
    let _ = write!(text, "block_from = {from:?}\nblock_to = {to:?}\nblock_velocity = {velocity:?}\n");
    let words = format!(
        "pours: {width:.3} by {tall:.3} m from ({x:.3}, {gap:.3}) m with ({:.2}, {:.2}) m/s onto {depth:.3} m",
        velocity[0], velocity[1]
    );
    (words, to[1], velocity[0].hypot(velocity[1]))
}

/// Run a variation to its end or its failure: the first particle that is too fast ends it. A body that glides to the tank's
/// wall ends it too, and has not failed: contact of solids is not modelled.
pub fn run(variation: &Variation) -> Verdict {
    let mut system = build::build(&variation.scene).expect("a scene that loads can be built");
    let mut seen = Seen::default();
    let (mut failures, mut why) = (Vec::new(), "");
    while system.fluid.time() < variation.scene.time.end && failures.is_empty() {
        let stepped = system.stable_dt().and_then(|dt| system.step(dt));
        match stepped {
            Err(CouplingError::Collision { .. }) => {
                why = ", at the tank's wall";
                break;
            }
            stepped => failures.extend(stepped.err().map(|error| error.to_string())),
        }
        failures.extend(seen.look(&system, SPEED * variation.fall));
        if system.fluid.steps() > MOST_STEPS {
            failures.push(format!("still at t = {:.4} s after {MOST_STEPS} steps", system.fluid.time()));
        }
    }
    // at least the energy of a ripple as high as a spacing, ½ρgΔx²B: water at rest has a scale too
    let gain = seen.gained[0] / seen.kinetic.max(0.5 * 9810.0 * SPACING * SPACING * 2.0 * TANK[0]);
    failures.extend(seen.breach);
    Verdict {
        particles: system.fluid.particles().len(),
        steps: system.fluid.steps(),
        end: format!("{:.3} s{why}", system.fluid.time()),
        fastest: [seen.fastest[0] / variation.fall, seen.fastest[1]],
        gain: [gain, seen.gained[1]],
        jump: format!("{:.3e} J/m {}", seen.jump, seen.where_jump),
        failures,
    }
}

#[derive(Default)]
struct Seen {
    kinetic: f64,
    gained: [f64; 2],
    fastest: [f64; 2],
    breach: Option<String>,
    drift: f64,
    jump: f64,
    where_jump: String,
}

impl Seen {
    /// Take note of a step; what is wrong if a particle is faster than `most` [m/s].
    fn look(&mut self, system: &Coupled, most: f64) -> Option<String> {
        let (p, time) = (system.fluid.particles(), system.fluid.time());
        let speed = |k: usize| p.u[k].hypot(p.v[k]);
        let k = (0..p.len()).max_by(|&a, &b| speed(a).total_cmp(&speed(b)))?;
        if speed(k) > most || !speed(k).is_finite() {
            return Some(format!(
                "particle {} at ({:.4}, {:.4}) m has {:.3e} m/s at t = {time:.4} s, pressure {:.3e} Pa",
                p.id[k],
                p.x[k],
                p.y[k],
                speed(k),
                system.fluid.fields().pressure[k],
            ));
        }
        if speed(k) > self.fastest[0] {
            self.fastest = [speed(k), time];
        }
        let of_bodies: f64 = system.bodies().map(|b| b.energy().kinetic).sum();
        self.kinetic = self.kinetic.max(system.fluid_energy().kinetic + of_bodies);
        let drift = system.energy_drift();
        if drift > self.gained[0] {
            self.gained = [drift, time];
        }
        if drift - self.drift > self.jump {
            let pressure = &system.fluid.fields().pressure;
            let k = (0..p.len()).max_by(|&a, &b| pressure[a].abs().total_cmp(&pressure[b].abs()))?;
            let (at, p) = ([p.x[k], p.y[k]], pressure[k]);
            self.jump = drift - self.drift;
            self.where_jump = format!("at t = {time:.4} s, where ({:.4}, {:.4}) m has {p:.2e} Pa", at[0], at[1]);
        }
        self.drift = drift;
        if let (None, Some(b)) = (&self.breach, system.penetration().worst) {
            self.breach = Some(format!(
                "particle {} at ({:.4}, {:.4}) m is {:.2e} m beyond `{}` at t = {time:.4} s",
                b.id, b.at[0], b.at[1], b.depth, b.owner
            ));
        }
        None
    }
}
