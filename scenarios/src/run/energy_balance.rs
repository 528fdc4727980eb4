//! The energy balance of an elastic body.

use fsi_coupling::{Coupled, Energy};

/// Change of a body's energies plus dissipation minus the work done on it, over the work exchanged (THEORY CO17).
pub fn structure_gap(system: &Coupled, k: usize, start: f64) -> f64 {
    let Some(body) = system.bodies().nth(k).filter(|body| !body.is_prescribed()) else { return 0.0 };
    let (energy, exchanged) = (body.energy(), system.work_audit(k).exchanged);
    let gap = held(&energy) - start + energy.dissipated - energy.work - energy.support;
    if exchanged > 0.0 { gap.abs() / exchanged } else { 0.0 }
}

/// Energy that a body holds [J/m].
pub fn held(energy: &Energy) -> f64 {
    energy.kinetic + energy.potential + energy.elastic
}
