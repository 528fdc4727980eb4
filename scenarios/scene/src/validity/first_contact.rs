//! First contact: when the run of a body that falls into weakly compressible water starts (THEORY WA12), and what may be said of round bottoms
//! and of bodies that start wet.

use fsi_coupling::RigidMotion;
use settings::{Problem, require, significant};
use sph_core::Solver;

use crate::impact::Entry;
use crate::keys::{Body, Motion, Scene};
use crate::vocabulary::{Finding, Verdict};

/// Height of a body that flies in above its place at t = 0 [spacings]: water meets it so much early.
pub const STANDOFF: f64 = 0.5;
/// A body that flies in starts so far above its place at t = 0 [spacings], out of the kernel's reach.
pub const START_GAP: f64 = 2.5;
/// A body whose lowest point is so far above the water at t = 0 needs no approach [spacings].
pub const LEAST_GAP: f64 = 2.0;

/// A body starts at most so far above the water [spacings].
const HIGHEST: f64 = 1000.0;

/// A speed at the start that is 0 but for rounding [m/s].
const ROUNDING: f64 = 1e-9;

/// When the run of a body starts that is at its place at t = 0 [s]: at the start of its approach, or at 0 where it has none.
///
/// It falls through 2 Δx from there to t = 0, if it is free under gravity g [m/s²] too:
/// V T − g T²/2 = 2 Δx, or from rest where it is so slow that it cannot, T = V/g.
fn automatic_start(body: &Body, entry: &Entry, solver: Solver, gravity: [f64; 2], spacing: f64) -> f64 {
    let gap = -body.draught() / spacing;
    let speed = -body.velocity[1];
    if obstacle(body, Some(entry), solver).is_some()
        || entry.final_draught < spacing // no force of such a run is resolved, and its approach may last long
        || speed <= 0.0
        || !(0.0..LEAST_GAP).contains(&gap)
    {
        return 0.0;
    }
    let height = (START_GAP - STANDOFF) * spacing;
    let [_, pull] = pull_on(body, gravity).map(|g| -g);
    if pull <= 0.0 {
        return -height / speed;
    }
    let before = speed * speed - 2.0 * pull * height;
    -(speed - before.max(0.0).sqrt()) / pull
}

/// When the run of all bodies starts [s]: with the earliest of those that fly in; at 0 where another body cannot be carried back so far.
pub(crate) fn earliest_start(
    bodies: &[(&Body, Option<Entry>)],
    solver: Solver,
    gravity: [f64; 2],
    spacing: f64,
) -> f64 {
    let start =
        |(body, entry): &(&Body, Option<Entry>)| Some(automatic_start(body, entry.as_ref()?, solver, gravity, spacing));
    let earliest = bodies.iter().filter_map(start).fold(0.0, f64::min);
    if check_start(earliest, bodies, solver, gravity, spacing).is_ok() { earliest } else { 0.0 }
}

/// Refuses a start before t = 0 where a body that is not fixed cannot be carried back to it, or would not come down through the air from there.
pub(crate) fn check_start(
    start: f64,
    bodies: &[(&Body, Option<Entry>)],
    solver: Solver,
    gravity: [f64; 2],
    spacing: f64,
) -> Result<(), Problem> {
    require(start <= 0.0, "time.start", start, "at most 0 s")?;
    if start == 0.0 {
        return Ok(());
    }
    require(!bodies.is_empty(), "time.start", start, "0 in a scene without a body")?;
    let moving = bodies.iter().filter(|(body, _)| bodies.len() == 1 || body.motion != Motion::Fixed);
    moving.into_iter().try_for_each(|(body, entry)| {
        let obstacle = obstacle(body, entry.as_ref(), solver);
        require(obstacle.is_none(), "time.start", start, obstacle.unwrap_or_default())?;
        let pull = pull_on(body, gravity)[1];
        let (speed, height) = (-body.velocity[1] - start * pull, start * (body.velocity[1] + 0.5 * start * pull));
        let gap = (height - body.draught()) / spacing + STANDOFF;
        let expected = format!(
            "a time at which the body comes down, 0 to {HIGHEST} spacings above the water: it would be {} spacings above, at {} m/s downwards",
            significant(gap),
            significant(speed)
        );
        require(speed >= -ROUNDING && (0.0..=HIGHEST).contains(&gap), "time.start", start, expected)
    })
}

/// Why a body has no approach: what is expected of `time.start` instead.
fn obstacle(body: &Body, entry: Option<&Entry>, solver: Solver) -> Option<&'static str> {
    let flies = matches!(body.motion, Motion::Free(_) | Motion::ConstantVelocity);
    match () {
        () if solver != Solver::WeaklyCompressible => Some("0 with this solver, whose bodies start on the water"),
        () if !flies => Some("0 with a body that is neither free nor at constant velocity"),
        () if entry.is_some_and(Entry::is_flat) => Some("0 with a flat bottom, which meets the water all at once"),
        () if body.angular_velocity_deg_per_s != 0.0 => Some("0 with a body that turns at t = 0"),
        () => None,
    }
}

/// Acceleration of a body in the air [m/s²], shape (2).
fn pull_on(body: &Body, gravity: [f64; 2]) -> [f64; 2] {
    let Motion::Free(freedom) = &body.motion else { return [0.0; 2] };
    [(freedom.x(), gravity[0]), (freedom.y(), gravity[1])].map(|(free, g)| if free { g } else { 0.0 })
}

impl Scene {
    /// Motion of a body's origin when the run starts: as the scene has it at t = 0, carried back along its path through the air to
    /// `time.start`, and half a spacing higher.
    pub fn motion_at_start(&self, body: &Body) -> RigidMotion {
        let at_zero = RigidMotion {
            position: body.position,
            angle: body.angle_deg.to_radians(),
            velocity: body.velocity,
            angular_velocity: body.angular_velocity_deg_per_s.to_radians(),
            ..RigidMotion::default()
        };
        let (t, pull) = (self.time.start, pull_on(body, self.gravity));
        if t == 0.0 || body.motion == Motion::Fixed {
            return at_zero;
        }
        let lift = [0.0, STANDOFF * self.resolution.spacing];
        let [position, velocity] = [
            [0, 1].map(|k| body.position[k] + lift[k] + t * (body.velocity[k] + 0.5 * t * pull[k])),
            [0, 1].map(|k| body.velocity[k] + t * pull[k]),
        ];
        RigidMotion { position, velocity, ..at_zero }
    }
}

/// A round bottom's peak needs an averaging time of this multiple of R V/c₀² (GE20) [-].
pub const ACOUSTIC_TIMES: f64 = 10.0;
/// Draught at which the water's mass is a fifth of a round body's, at least (GE22) [spacings].
const LEAST_ROUND: f64 = 1.25;
/// Least band of a round bottom's peak through its window (GE20), weakly compressible and incompressible, shares of the force: the projection
/// gives 7 to 10 % less than boundary elements at every spacing [-].
const LEAST_ROUND_BAND: [f64; 2] = [0.05, 0.12];
/// The band that a radius of one spacing would have, a share of the force [-].
const ROUND_BAND: f64 = 3.0;

/// A force on a round bottom.
pub struct RoundContact {
    /// Radius R [m].
    pub radius: f64,
    /// Gap to the water at the start [m].
    pub gap: f64,
    /// Time over which the force is averaged [s].
    pub window: f64,
    /// Spacing [m].
    pub spacing: f64,
    /// Speed of sound [m/s]; `None` where water is incompressible.
    pub sound_speed: Option<f64>,
}

impl RoundContact {
    /// What may be said of it.
    pub fn finding(&self, entry: &Entry) -> Finding {
        let RoundContact { radius, gap, window, spacing, sound_speed } = *self;
        if sound_speed.is_some() && gap < LEAST_GAP * spacing {
            let why = format!(
                "a round bottom that starts on the water meets a layer of particles at once: leave time.start to the program, or \
                 start the body {} m above",
                significant(START_GAP * spacing)
            );
            return (Verdict::Acoustic, None, Some(why.into()));
        }
        let least = sound_speed.map_or(0.0, |c| ACOUSTIC_TIMES * radius * entry.speed / (c * c));
        if window < least {
            let why = format!(
                "it is averaged over {} s; the numerical speed of sound acts on a round bottom for {} s",
                significant(window),
                significant(least)
            );
            return (Verdict::Acoustic, None, Some(why.into()));
        }
        let spacings = entry.peak_draught / spacing;
        if spacings < LEAST_ROUND {
            let why = format!(
                "a light round body loses its speed within {} spacings; {LEAST_ROUND} are needed: {} m would do for \
                 resolution.spacing",
                significant(spacings),
                significant(entry.peak_draught / LEAST_ROUND)
            );
            return (Verdict::NotResolved, None, Some(why.into()));
        }
        let share = LEAST_ROUND_BAND[usize::from(sound_speed.is_none())].max(ROUND_BAND * spacing / radius);
        (Verdict::Resolved, Some(share), None)
    }
}

/// What may be said of a force on a body that starts wet at speed, at a depth [m].
pub fn wet_start(draught: f64) -> Finding {
    let wet = significant(draught);
    let why =
        format!("the body starts {wet} m deep at speed: the water in its way is hit at once, at an infinite force");
    (Verdict::Acoustic, None, Some(why.into()))
}

#[cfg(test)]
mod tests {
    use crate::load;

    /// A body carried back under water, moving up, and one from 10⁹ s before.
    #[test]
    fn a_start_from_which_the_body_does_not_come_down_is_refused() {
        for start in ["-1.3", "-1e9"] {
            let error = load("wedge", &[format!("time.start={start}")]).expect_err("a start that is none").to_string();
            assert!(error.contains("`time.start`") && error.contains("comes down"), "{error}");
        }
        assert!(load("wedge", &["time.start=-0.005".to_string()]).is_ok());
    }
}
