//! Conservation over a run, and what of it makes its results doubtful.

use fsi_coupling::{Coupled, Energy};
use scene::vocabulary::Doubt;
use serde::Serialize;
use settings::significant;

use crate::observers::WorstPenetration;

/// Largest gap of the momentum that rounding can make [-].
const MOMENTUM: f64 = 1e-9;
/// Largest energy that may come from nowhere, over the energy exchanged [-].
const ENERGY: f64 = 0.02;
/// Largest share of a body's impulse by which it may differ from that of the pressure on its outline [-]. Rows of particles read pressures beside
/// corners and spray roots that well: in 43 of 49 entries the share was above 0.01, with forces that were right to 3 %; above 0.05 forces were off.
const SURFACE: f64 = 0.05;
/// Largest share of the exchanged work that may be lost between water and body, or within the body [-].
const WORK: f64 = 0.01;

/// Largest share that is written as a number [-].
const MOST_WRITTEN: f64 = 10.0;

/// Conservation over the run (THEORY CO27, CO28).
#[derive(Clone, Debug, Default, Serialize)]
pub struct Audit {
    /// Worst momentum gap of a step over the momentum held and exchanged [-].
    pub momentum: f64,
    /// Energy that left the balance over the largest energy exchanged [-]; negative: dissipated.
    pub energy: f64,
    /// Work of the water that did not reach the body, over the work exchanged (THEORY CO17) [-].
    pub work: f64,
    /// Work on an elastic body that its energies do not contain, over the work exchanged [-].
    pub structure: f64,
    /// Impulse of the pressure on a body's outline that the body did not get, over the impulse exchanged (THEORY CO39) [-]; `null` where no
    /// water pressed on a body, and for walls without a pressure of their own.
    pub surface: Option<f64>,
    /// Change of the fluid's volume Σm/ρ over its start value [-].
    pub volume: f64,
    /// Most fluid particles found beyond a wall's surface at any sample.
    pub penetrated: usize,
    /// The worst of them; absent when there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_penetration: Option<WorstPenetration>,
    /// Times that a particle was stopped at a thin plate (THEORY WA11); absent when never.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_at_plate: Option<u64>,
}

/// What is not a number is not within.
fn beyond(value: f64, bound: f64) -> bool {
    value.is_nan() || value > bound
}

impl Audit {
    /// True where the body took less work than the water did on it.
    pub fn loses_work(&self) -> bool {
        beyond(self.work, WORK)
    }

    /// What is out of bounds.
    pub fn doubts(&self) -> Vec<Doubt> {
        let percent = |share: f64| match share > MOST_WRITTEN {
            true => format!("more than {} %", 100.0 * MOST_WRITTEN),
            false => format!("{} %", significant(100.0 * share)),
        };
        let found = [
            beyond(self.momentum, MOMENTUM).then(|| {
                let gap = significant(self.momentum);
                ("momentum", format!("a step has a gap of {gap} of the momentum: a force has no counterforce"))
            }),
            beyond(self.energy, ENERGY).then(|| {
                let share = percent(self.energy);
                let why = format!(
                    "{share} of the energy exchanged came from nowhere: look at the frames, then use a finer spacing"
                );
                ("energy", why)
            }),
            self.loses_work().then(|| {
                let share = percent(self.work);
                let why = format!(
                    "{share} of the work of the water did not reach the body: the step is too long; set a smaller time.step or fluid.cfl"
                );
                ("work", why)
            }),
            beyond(self.structure, WORK).then(|| {
                ("structure", format!("{} of the work on the body is not in its energies", percent(self.structure)))
            }),
            self.surface.filter(|gap| beyond(*gap, SURFACE)).map(|gap| {
                let why = format!(
                    "the impulse on a body is {} off that of the pressure along its outline: look at both, at a finer spacing",
                    percent(gap)
                );
                ("surface", why)
            }),
            self.worst_penetration.as_ref().map(|worst| ("penetrated", worst.to_string())),
        ];
        found.into_iter().flatten().map(|(part, why)| Doubt::about(format!("audit.{part}"), why)).collect()
    }
}

/// Change of a body's energies plus dissipation minus the work done on it, over the work exchanged (THEORY CO17).
pub(super) fn structure_gap(system: &Coupled, k: usize, start: f64) -> f64 {
    let Some(body) = system.bodies().nth(k).filter(|body| !body.is_prescribed()) else { return 0.0 };
    let (energy, exchanged) = (body.energy(), system.work_audit(k).exchanged);
    let gap = held(&energy) - start + energy.dissipated - energy.work - energy.support - energy.links;
    if exchanged > 0.0 { gap.abs() / exchanged } else { 0.0 }
}

/// Energy that a body holds [J/m].
pub(super) fn held(energy: &Energy) -> f64 {
    energy.kinetic + energy.potential + energy.elastic
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_out_of_bounds_is_named() {
        let fine = Audit { momentum: 1e-12, energy: -0.4, work: 0.005, structure: 1e-3, ..Audit::default() };
        assert!(fine.doubts().is_empty());
        let broken =
            Audit { momentum: 1e-6, energy: 0.3, work: 0.02, structure: 0.05, surface: Some(0.2), ..Audit::default() };
        let doubts = broken.doubts();
        for (doubt, name) in doubts.iter().zip(["momentum", "energy", "work", "structure", "surface"]) {
            assert!(doubt.about == [format!("audit.{name}")], "{doubt}");
        }
        assert_eq!(doubts.len(), 5);
        assert!(broken.loses_work() && !fine.loses_work());
        assert_eq!(Audit { energy: f64::NAN, ..fine }.doubts().len(), 1);
    }
}
