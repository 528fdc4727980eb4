//! Energies of the fluid over time (THEORY CO28).

use scene::Scene;

use crate::observers::source::{Reader, Source};

pub(in crate::observers) const SOURCE: Source = Source { names, reader };

/// Columns, if the scene asks for them.
const COLUMNS: [&str; 3] = ["kinetic_J_per_m", "potential_J_per_m", "elastic_J_per_m"];

fn names(scene: &Scene) -> Vec<String> {
    COLUMNS.iter().filter(|_| scene.observe.energy).map(|name| name.to_string()).collect()
}

fn reader(scene: &Scene) -> Reader {
    let asked = scene.observe.energy;
    Box::new(move |frame| {
        let energy = frame.held.energy;
        if asked { vec![energy.kinetic, energy.potential, energy.elastic] } else { Vec::new() }
    })
}
