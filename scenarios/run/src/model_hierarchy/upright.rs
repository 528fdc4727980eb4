//! A scene that is nothing but a section which goes straight down, for theories.

use fsi_coupling::Law;
use scene::{Body, GaugeFrame, Motion, Moved, Observe, Scene, Shape};
use water_entry::{EntryModel, GivenMotion, OutOfRange, Section, SectionMotion};

use super::rolled;

/// The body of a scene that is nothing but a symmetric section, for boundary elements a rolled wedge too, going straight down into still water.
pub(super) fn upright_entry(scene: &Scene, model: EntryModel) -> Result<(&Body, Section, SectionMotion), OutOfRange> {
    let body = scene.body.as_ref().ok_or_else(|| refuse("a scene without a body"))?;
    if !scene.bodies.is_empty() || !scene.joints.is_empty() {
        return Err(refuse("several bodies, or joints"));
    }
    scene.entry().ok_or_else(|| refuse("one that stays where it is, or in the air"))?;
    let tank = &scene.tank;
    let still = tank.surface_amplitude == 0.0 && tank.surface_tilt_deg == 0.0 && tank.block().is_none();
    let rolls = rolled::rolls(scene, model);
    let drifts = body.velocity[0] != 0.0 && !(rolls && body.motion == Motion::ConstantVelocity);
    let lopsided = body.angle_deg != 0.0 && !rolls || drifts || body.angular_velocity_deg_per_s != 0.0;
    let on_tank = scene.gauges.iter().any(|gauge| matches!(gauge.on, GaugeFrame::Fixed));
    let obstacles = [
        (lopsided, "a body that is tilted, turns or moves sideways"),
        (scene.gravity[0] != 0.0 || scene.gravity[1] > 0.0, "gravity that pulls sideways or up"),
        (!still || tank.water_width < tank.width, "water that moves"),
        (on_tank, "gauges on the tank"),
        (!body.sprung_masses.is_empty(), "masses on springs"),
        (scene.observe != Observe::default(), "columns of the water, which [observe] asks for"),
        (matches!(body.shape, Shape::Polyline { .. }), "an open plate"),
    ];
    if let Some((_, what)) = obstacles.into_iter().find(|(stands, _)| *stands) {
        return Err(refuse(what));
    }
    let motion = match &body.motion {
        Motion::ConstantVelocity => SectionMotion::Constant,
        Motion::Tabulated(table) if !rolls && table.is_upright() => {
            match body.motion.moved(&scene.motion_at_start(body)) {
                Moved::ByLaw(law) => SectionMotion::Given(given(body, law, scene.time.end)),
                Moved::ByLoads(_) => return Err(refuse("a body that is held or swings")),
            }
        }
        Motion::Free(freedom) if freedom.y() && (!rolls || freedom.free.len() == 1) => {
            SectionMotion::Free(freedom.mass)
        }
        Motion::Free(_) if rolls => return Err(refuse("a rolled wedge that may turn or move sideways")),
        _ => return Err(refuse("a body that is held or swings")),
    };
    Ok((body, fsi_coupling::section_of(&body.shape)?, motion))
}

/// A body's way down by its law up to an `end` [s].
fn given(body: &Body, law: Law, end: f64) -> GivenMotion {
    let (draught, y) = (body.draught(), body.position[1]);
    GivenMotion::new(end, move |time| {
        let now = law(time);
        [draught - (now.position[1] - y), -now.velocity[1], -now.acceleration[1]]
    })
}

/// Draught [m] and downward speed [m/s] at t = 0.
pub(super) fn at_start(body: &Body, motion: &SectionMotion) -> (f64, f64) {
    match motion {
        SectionMotion::Given(way) => (way.at(0.0)[0], way.at(0.0)[1]),
        _ => (body.draught(), -body.velocity[1]),
    }
}

pub(super) fn refuse(what: &str) -> OutOfRange {
    OutOfRange {
        what: what.into(),
        range:
            "a rigid symmetric body that goes straight down into still water (boundary elements: a rolled wedge too, at constant velocity also sideways)"
                .into(),
        next: EntryModel::Wcsph,
    }
}
