//! Columns of a body and of its panels.

use fsi_coupling::{ModesState, Motion, PanelState};
use scene::Scene;

use crate::observers::Frame;
use crate::observers::source::Source;

/// Reads a column from a body's motion.
type Read = fn(&Motion) -> f64;

/// Columns of a body, after its name and a dot.
const BODY: [(&str, Read); 10] = [
    ("x_m", |m| m.position[0]),
    ("y_m", |m| m.position[1]),
    ("angle_deg", |m| m.angle.to_degrees()),
    ("vx_m_per_s", |m| m.velocity[0]),
    ("vy_m_per_s", |m| m.velocity[1]),
    ("ax_m_per_s2", |m| m.acceleration[0]),
    ("ay_m_per_s2", |m| m.acceleration[1]),
    ("fx_N_per_m", |m| m.force[0]),
    ("fy_N_per_m", |m| m.force[1]),
    ("moment_N", |m| m.moment),
];

pub(super) const SOURCE: Source = Source { names, reader: |_| Box::new(read) };

fn names(scene: &Scene) -> Vec<String> {
    let body = |b: &scene::Body| {
        let own = BODY.iter().map(|(column, _)| format!("{}.{column}", b.name));
        let bends = b.panels.iter().flat_map(|panel| panel.columns());
        let sprung =
            b.sprung_masses.iter().flat_map(|mass| mass.columns()).map(|column| format!("{}.{column}", b.name));
        own.chain(sprung).chain(bends).chain(b.modal.iter().flat_map(|modal| modal.columns())).collect::<Vec<_>>()
    };
    scene.all_bodies().flat_map(body).collect()
}

fn read(frame: &Frame<'_>) -> Vec<f64> {
    let moving = frame.system.bodies().filter_map(|b| Some((b, b.motion()?)));
    moving
        .flat_map(|(b, motion)| {
            body_values(&motion)
                .map(|(_, value)| value)
                .into_iter()
                .chain(b.sprung().iter().flat_map(|mass| [mass.extension, mass.acceleration]).collect::<Vec<_>>())
                .chain(b.panels().iter().flat_map(panel_values).collect::<Vec<_>>())
                .chain(b.modes().iter().flat_map(modal_values).collect::<Vec<_>>())
        })
        .collect()
}

/// A body's columns without its name, and their values.
pub fn body_values(motion: &Motion) -> [(&'static str, f64); BODY.len()] {
    BODY.map(|(name, read)| (name, read(motion)))
}

/// Values of a panel's columns, in the order of [`scene::Panel::columns`].
pub(crate) fn panel_values(panel: &PanelState) -> Vec<f64> {
    let watched = panel
        .watched
        .iter()
        .flat_map(|w| [w.displacement[0], w.displacement[1], w.deflection, w.section.moment, w.strain[0], w.strain[1]]);
    watched.chain([panel.stress]).collect()
}

/// Values of the columns of a structure by its modes, in the order of [`scene::Modes::columns`].
pub(crate) fn modal_values(modes: &ModesState) -> Vec<f64> {
    let displacement = modes.displacement.iter().map(|[u, v]| u.hypot(*v)).fold(0.0, f64::max);
    let stress = (!modes.stress.is_empty()).then(|| modes.largest_stress());
    modes.amplitude.iter().copied().chain([displacement]).chain(stress).collect()
}
