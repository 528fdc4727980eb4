//! What the log and viewers are shown of a run: named numbers, and pictures of particles and bodies.

use fsi_coupling::Coupled;
use scene::{MODES, Scene};
use sph_core::parallel;
use sph_core::particles::totals::Totals;

use super::Frame;
use super::columns::{body_values, modal_values, panel_values};
use crate::log::{self, BodyView, LogError, Point};

/// Start of the channels of the loads on panels' nodes, before the panel's name.
pub const LOADS: &str = "loads";

/// Names of the fluid's loads on this number of nodes, in the axes of the body's frame.
pub fn load_names(nodes: usize) -> Vec<String> {
    let of = |node: usize| ["fx_N_per_m", "fy_N_per_m", "m_N"].map(|unit| format!("node{node}.{unit}"));
    (1..=nodes).flat_map(of).collect()
}

/// Names and the start of time of what is shown.
pub(super) struct RunView {
    start: f64,
    panels: Vec<(String, Vec<String>)>,
    /// Names of the loads on each panel's nodes.
    loads: Vec<Vec<String>>,
    /// Columns of a structure by its modes.
    modes: Vec<String>,
    gauges: Vec<String>,
}

impl RunView {
    /// Of a scene.
    pub fn new(scene: &Scene) -> RunView {
        let panels = scene.body.iter().flat_map(|body| &body.panels);
        let loads = panels.clone().map(|panel| load_names(panel.elements + 1)).collect();
        let panels = panels.map(|panel| (panel.name.clone(), panel.columns())).collect();
        let gauges = scene.gauges.iter().map(|g| format!("{}.p_Pa", g.name)).collect();
        let modal = scene.body.iter().flat_map(|body| &body.modal);
        let modes = modal.flat_map(|modal| modal.columns()).collect();
        RunView { start: scene.time.start, panels, loads, modes, gauges }
    }

    /// Time since the start of the run [s].
    pub fn time(&self, time: f64) -> f64 {
        time - self.start
    }

    /// Hand each channel's named numbers to `take`: bodies, panels, gauges, audit.
    pub fn curves(
        &self,
        frame: &Frame<'_>,
        mut take: impl FnMut(&str, &[(&str, f64)]) -> Result<(), LogError>,
    ) -> Result<(), LogError> {
        let system = frame.system;
        for body in system.bodies() {
            let Some(m) = body.motion() else { continue };
            take(&format!("body/{}", body.name()), &body_values(&m))?;
            for (((name, columns), loads), panel) in self.panels.iter().zip(&self.loads).zip(body.panels()) {
                // names without the panel's own
                let units = columns.iter().map(|column| &column[name.len() + 1..]);
                let values: Vec<(&str, f64)> = units.zip(panel_values(&panel)).collect();
                take(&format!("panel/{name}"), &values)?;
                let loads = loads.iter().map(String::as_str).zip(panel.load.as_flattened().iter().copied());
                take(&format!("{LOADS}/{name}"), &loads.collect::<Vec<_>>())?;
            }
            if let Some(modes) = body.modes() {
                let units = self.modes.iter().map(|column| &column[MODES.len() + 1..]);
                let values: Vec<(&str, f64)> = units.zip(modal_values(&modes)).collect();
                take(MODES, &values)?;
            }
        }
        if !self.gauges.is_empty() {
            let named: Vec<(&str, f64)> =
                self.gauges.iter().map(String::as_str).zip(frame.gauges.iter().copied()).collect();
            take("gauges", &named)?;
        }
        let Totals { energy, momentum, volume, top_speed, .. } = *frame.held;
        let audit = [
            ("momentum_x_N_s_per_m", momentum[0]),
            ("momentum_y_N_s_per_m", momentum[1]),
            ("momentum_closure", system.momentum_audit().worst),
            ("kinetic_J_per_m", energy.kinetic),
            ("potential_J_per_m", energy.potential),
            ("elastic_J_per_m", energy.elastic),
            ("energy_drift_J_per_m", system.energy_drift_with(&energy)),
            ("volume_m2", volume),
            ("penetrated", frame.penetration.count as f64),
            ("top_speed_m_per_s", top_speed),
        ];
        take("audit", &audit)
    }

    /// The particles and the bodies now.
    pub fn picture(&self, system: &Coupled) -> Result<log::Frame, LogError> {
        let (p, d, w) = (system.fluid.particles(), system.fluid.fields(), &system.walls);
        let mut fluid = vec![Point::default(); p.len()];
        parallel::gather_into(&mut fluid, |k| Point {
            at: [p.x[k], p.y[k]],
            pressure: d.pressure[k],
            velocity: [p.u[k], p.v[k]],
            density: p.rho[k],
            spacing: (p.mass[k] / p.rho[k]).sqrt(),
            id: p.id[k],
        });
        let wall = |k: usize| Point {
            at: [w.x[k], w.y[k]],
            pressure: w.pressure[k],
            velocity: [w.u[k], w.v[k]],
            density: system.fluid.domain().fluid.density,
            spacing: w.volume[k].sqrt(),
            id: k as u32,
        };
        let mut walls: Vec<Point> = (0..w.len()).map(wall).collect();
        if let Some(mirror) = system.fluid.domain().mirror {
            for points in [&mut fluid, &mut walls] {
                points.extend_from_within(..);
                let images = points.len() / 2;
                points[images..].iter_mut().for_each(|point| *point = point.image(mirror.at));
            }
        }
        // one closed line per body: the loops of a compound body are joined by the way back to the first corner
        let shown = system.bodies().filter_map(|b| Some((b.name(), b.motion()?, join(b.outline()?.loops()))));
        let shown: Vec<_> = shown.collect();
        let bodies: Vec<BodyView<'_>> = shown
            .iter()
            .map(|(name, m, outline)| BodyView { name, position: m.position, angle: m.angle, outline })
            .collect();
        log::Frame::new(self.time(system.fluid.time()), &fluid, &walls, &bodies)
    }
}

/// The loops as one closed line that visits each and returns to the first corner of all.
fn join(loops: &[Vec<[f64; 2]>]) -> Vec<[f64; 2]> {
    if let [only] = loops {
        return only.clone();
    }
    let home = loops[0][0];
    loops.iter().flat_map(|l| l.iter().copied().chain([l[0], home])).collect()
}
