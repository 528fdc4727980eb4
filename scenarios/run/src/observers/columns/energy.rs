//! Energies of the fluid over time (THEORY CO28).

use scene::Scene;

use crate::observers::source::{Reader, Source};

pub(in crate::observers) const SOURCE: Source = Source { names, reader };

/// Columns, if the scene asks for them.
const COLUMNS: [&str; 3] = ["kinetic_J_per_m", "potential_J_per_m", "elastic_J_per_m"];

fn names(scene: &Scene) -> Vec<String> {
    let energies = COLUMNS.iter().chain(&["mechanical_J_per_m"]).filter(|_| scene.observe.energy).map(|name| name.to_string());
    energies.chain(scene.observe.speed.then(|| "speed_m_per_s".to_string())).collect()
}

fn reader(scene: &Scene) -> Reader {
    let (asked, speed) = (scene.observe.energy, scene.observe.speed);
    Box::new(move |frame| {
        let energy = frame.held.energy;
        let energies = if asked { vec![energy.kinetic, energy.potential, energy.elastic, energy.kinetic + energy.potential + energy.elastic] } else { Vec::new() };
        let p = frame.system.fluid.particles();
        let fastest = || p.u.iter().zip(&p.v).map(|(u, v)| u.hypot(*v)).fold(0.0, f64::max);
        energies.into_iter().chain(speed.then(fastest)).collect()
    })
}
