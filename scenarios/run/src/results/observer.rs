//! Gathers the curves of the results in every step.

use fsi_coupling::{Body, Coupled, Motion, TouchRecord};
use scene::Scene;
use scene::validity::panels::StressPeak;
use scene::vocabulary::{Doubts, ResultName, Results, Verdict};
use settings::significant;
use sph_core::state_bytes::{StateError, decode, encode, expect_count};

use super::filtered::FilteredAcceleration;
use super::judge::{Curves, Judge};
use super::running_integral::RunningIntegral;

/// Gathers the curves of the results in every step.
pub struct ResultsObserver {
    curves: Curves,
    free: bool,
}

impl ResultsObserver {
    /// Of a scene, before its first step.
    pub fn new(scene: &Scene) -> ResultsObserver {
        let free = scene.body.as_ref().is_some_and(|body| matches!(body.motion, scene::Motion::Free(_)));
        let pressures = vec![RunningIntegral::default(); scene.gauges.len()];
        let modal = |body: &scene::Body| body.modal.as_ref().is_some_and(scene::Modes::with_stress);
        let panels = scene.body.as_ref().map_or(0, |body| body.panels.len() + usize::from(modal(body)));
        let stresses = vec![RunningIntegral::default(); panels];
        ResultsObserver { curves: Curves { pressures, stresses, ..Curves::default() }, free }
    }

    /// Take the state after a step, with the pressures of the scene's gauges [Pa].
    pub fn follow(&mut self, system: &Coupled, pressures: &[f64]) {
        let time = system.fluid.time();
        for (curve, &pressure) in self.curves.pressures.iter_mut().zip(pressures) {
            curve.take(time, [pressure]);
        }
        let Some((index, body, motion)) =
            system.bodies().enumerate().find_map(|(k, body)| Some((k, body, body.motion()?)))
        else {
            return;
        };
        self.curves.force.take(time, motion.force);
        // in the film between solids no air comes in
        let tension = if first_touch(system, body.name()).is_some() { [0.0; 2] } else { tension(system, index) };
        self.curves.tension.take(time, tension);
        if self.free {
            self.curves.acceleration.take(time, motion.acceleration);
        }
        self.curves.draught.extend(draught(body, &motion).map(|draught| [time, draught]));
        let stresses = body.panels().into_iter().map(|panel| panel.stress);
        let stresses = stresses.chain(body.modes().map(|modes| modes.largest_stress()));
        for (curve, stress) in self.curves.stresses.iter_mut().zip(stresses) {
            curve.take(time, [stress]);
        }
    }

    /// The largest acceleration through the filter of a channel frequency class [Hz], with the verdict of the unfiltered one; `None`
    /// for a body that is not free.
    pub fn filtered(&self, class: f64, results: &Results) -> Option<FilteredAcceleration> {
        let verdict = results.get(ResultName::PeakAcceleration).map_or(Verdict::NoBand, |peak| peak.verdict);
        FilteredAcceleration::of(&self.curves.acceleration, class, verdict)
    }

    /// The curves, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&self.curves)
    }

    /// Take curves of as many gauges and panels.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let curves: Curves = decode("the curves of the results", bytes)?;
        expect_count("curves of pressure", curves.pressures.len(), self.curves.pressures.len())?;
        expect_count("curves of stress", curves.stresses.len(), self.curves.stresses.len())?;
        self.curves = curves;
        Ok(())
    }

    /// The results so far, and doubts about them.
    pub fn results(&self, scene: &Scene, system: &Coupled) -> (Results, Doubts) {
        let panels = system.bodies().flat_map(|body| body.panels());
        let modes = system.bodies().filter_map(|body| StressPeak::of_modes(&body.modes()?));
        let panels: Vec<StressPeak> = panels.map(|panel| StressPeak::from(&panel)).chain(modes).collect();
        let judge = Judge::new(scene);
        let (mut results, mut doubts) = judge.results(&self.curves, &panels);
        let enters = scene.entry().is_some_and(|entry| entry.final_draught > 0.0);
        if enters && scene.body.as_ref().is_some_and(scene::Body::is_free) {
            doubts.extend(results.still_growing([scene.time.start, system.fluid.time()]));
        }
        let now = system.bodies().find_map(|body| body.motion()).filter(|_| enters);
        doubts.extend(now.and_then(|now| results.not_passed(&scene.panels_not_passed(&now))));
        // a mean reaches forward by its time
        doubts.extend(touch(system).and_then(|(time, why)| results.unresolve(time - judge.of_force.time, &why)));
        (results, doubts)
    }
}

/// When the first body touched another or the tank [s], from when on its forces are not known, and why.
fn touch(system: &Coupled) -> Option<(f64, String)> {
    let own = system.bodies().find(|body| body.motion().is_some())?;
    let TouchRecord { bodies: [a, b], first, .. } = first_touch(system, own.name())?;
    let why = format!(
        "`{a}` and `{b}` touch at {} s: the pressure of the film of water between them is 5 to 30 % off or of the wrong sign",
        significant(*first)
    );
    Some((*first, why))
}

/// The first touch of a body.
fn first_touch<'a>(system: &'a Coupled, name: &str) -> Option<&'a TouchRecord> {
    let of_body = system.touched().iter().filter(|touch| touch.bodies.iter().any(|own| own == name));
    of_body.min_by(|a, b| a.first.total_cmp(&b.first))
}

/// Force with which the water pulls on a body where its pressure is below the air's [N/m]; of both halves of a symmetric one.
fn tension(system: &Coupled, body: usize) -> [f64; 2] {
    let walls = &system.walls;
    // still water's pressure acts on the first row alone (THEORY WC29): there the wall's own pressure tells whether it pulls
    let pushes = |k: usize| system.fluid.external_force_varies() && walls.pressure[k] >= 0.0;
    let pull = |k: usize| (walls.fx[k] * walls.nx[k] + walls.fy[k] * walls.ny[k]).max(0.0);
    let outwards = |k: usize| if pushes(k) { 0.0 } else { pull(k) };
    let sum =
        system.range(body).fold([0.0; 2], |[x, y], k| [x + outwards(k) * walls.nx[k], y + outwards(k) * walls.ny[k]]);
    if system.fluid.domain().mirror.is_some() { [0.0, 2.0 * sum[1]] } else { sum }
}

/// Depth of a body's lowest point below still water [m].
fn draught(body: &dyn Body, motion: &Motion) -> Option<f64> {
    let outline = body.outline()?;
    outline.loops().iter().flatten().map(|&at| -motion.point(at)[1]).reduce(f64::max)
}
