//! `log.mcap`: curves and conservation numbers at every sample, particles at every frame.

use std::path::Path;

use fsi_coupling::Coupled;
use sph_core::parallel;
use sph_core::particles::totals::Totals;

use super::columns::{body_values, panel_values};
use super::{Frame, ObserveError, Observer};
use crate::log::{self, BackgroundLog, BodyView, Budget, Level, LogError, LogMetadata, Logged, Point, StoredLog};
use crate::scene::Scene;

/// Writes the log.
pub struct LogObserver {
    writer: BackgroundLog,
    start: f64,
    end: f64,
    panels: Vec<(String, Vec<String>)>,
    gauges: Vec<String>,
}

impl LogObserver {
    /// Create the file.
    pub fn create(path: &Path, scene: &Scene) -> Result<LogObserver, ObserveError> {
        Ok(LogObserver::with(create_log(path, scene)?, scene))
    }

    fn with(writer: BackgroundLog, scene: &Scene) -> LogObserver {
        let panels = scene.body.iter().flat_map(|body| &body.panels);
        let panels = panels.map(|panel| (panel.name.clone(), panel.columns())).collect();
        let gauges = scene.gauges.iter().map(|g| format!("{}.p_Pa", g.name)).collect();
        LogObserver { writer, start: scene.time.start, end: scene.time.end, panels, gauges }
    }

    /// Continue the file from where it was `stored`.
    pub fn resume(path: &Path, scene: &Scene, stored: StoredLog) -> Result<LogObserver, ObserveError> {
        Ok(LogObserver::with(resume_log(path, scene, stored)?, scene))
    }

    /// What a later process needs to continue from here.
    pub fn stored(&mut self) -> Result<StoredLog, ObserveError> {
        Ok(self.writer.stored()?)
    }

    /// Write a note.
    pub fn note(&mut self, time: f64, level: Level, text: &str) -> Result<(), ObserveError> {
        Ok(self.writer.note(time - self.start, level, text)?)
    }

    /// Complete the file.
    pub fn finish(self) -> Result<Logged, ObserveError> {
        Ok(self.writer.finish()?)
    }

    fn curves(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let (t, system) = (frame.time() - self.start, frame.system);
        for body in system.bodies() {
            let Some(m) = body.motion() else { continue };
            self.writer.sample(t, &format!("body/{}", body.name()), &body_values(&m))?;
            for ((name, columns), panel) in self.panels.iter().zip(body.panels()) {
                // names without the panel's own
                let units = columns.iter().map(|column| &column[name.len() + 1..]);
                let values: Vec<(&str, f64)> = units.zip(panel_values(&panel)).collect();
                self.writer.sample(t, &format!("panel/{name}"), &values)?;
            }
        }
        if !self.gauges.is_empty() {
            let named: Vec<(&str, f64)> =
                self.gauges.iter().map(String::as_str).zip(frame.gauges.iter().copied()).collect();
            self.writer.sample(t, "gauges", &named)?;
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
        self.writer.sample(t, "audit", &audit)?;
        Ok(())
    }
}

/// The empty log of a scene.
pub(crate) fn create_log(path: &Path, scene: &Scene) -> Result<BackgroundLog, LogError> {
    BackgroundLog::create(path, &metadata(scene, &scene.to_toml()), budget(scene))
}

fn resume_log(path: &Path, scene: &Scene, stored: StoredLog) -> Result<BackgroundLog, LogError> {
    BackgroundLog::resume(path, &metadata(scene, &scene.to_toml()), budget(scene), stored)
}

fn metadata<'a>(scene: &'a Scene, toml: &'a str) -> LogMetadata<'a> {
    LogMetadata { scene: &scene.name, scene_toml: toml, version: env!("CARGO_PKG_VERSION") }
}

fn budget(scene: &Scene) -> Option<Budget> {
    let end = scene.time.end - scene.time.start;
    scene.report.log_budget.map(|megabytes| Budget { bytes: (1e6 * megabytes) as u64, end })
}

/// The loops as one closed line that visits each and returns to the first corner of all.
fn join(loops: &[Vec<[f64; 2]>]) -> Vec<[f64; 2]> {
    if let [only] = loops {
        return only.clone();
    }
    let home = loops[0][0];
    loops.iter().flat_map(|l| l.iter().copied().chain([l[0], home])).collect()
}

impl LogObserver {
    /// Write the present state, whether due or not.
    pub fn keep(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        self.curves(frame)?;
        self.picture(frame.system, true)
    }

    /// Write a frame of particles; the `last` of a run is written if a budget has room for it alone.
    pub fn picture(&mut self, system: &Coupled, last: bool) -> Result<(), ObserveError> {
        let (p, d, w) = (system.fluid.particles(), system.fluid.fields(), &system.walls);
        let speed = |u: f64, v: f64| (u * u + v * v).sqrt();
        let mut fluid = vec![Point::default(); p.len()];
        parallel::gather_into(&mut fluid, |k| Point {
            at: [p.x[k], p.y[k]],
            pressure: d.pressure[k],
            speed: speed(p.u[k], p.v[k]),
            density: p.rho[k],
            spacing: (p.mass[k] / p.rho[k]).sqrt(),
            id: p.id[k],
        });
        let wall = |k: usize| Point {
            at: [w.x[k], w.y[k]],
            pressure: w.pressure[k],
            speed: speed(w.u[k], w.v[k]),
            density: system.fluid.domain().fluid.density,
            spacing: w.volume[k].sqrt(),
            id: k as u32,
        };
        let walls: Vec<Point> = (0..w.len()).map(wall).collect();
        // one closed line per body: the loops of a compound body are joined by the way back to the first corner
        let shown = system.bodies().filter_map(|b| Some((b.name(), b.motion()?, join(b.outline()?.loops()))));
        let shown: Vec<_> = shown.collect();
        let bodies: Vec<BodyView<'_>> = shown
            .iter()
            .map(|(name, m, outline)| BodyView { name, position: m.position, angle: m.angle, outline })
            .collect();
        Ok(self.writer.frame(log::Frame::new(system.fluid.time() - self.start, &fluid, &walls, &bodies)?, last)?)
    }
}

impl Observer for LogObserver {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        self.curves(frame)?;
        if frame.particles { self.picture(frame.system, frame.time() >= self.end) } else { Ok(()) }
    }
}
