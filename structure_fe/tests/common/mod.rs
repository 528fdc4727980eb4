//! What the tests share: a material, a bar, supports by name, and the reference tables.
#![allow(dead_code)] // each test binary uses its own part

use std::collections::HashMap;

use structure_fe::{Beam, Damping, Dynamics, Integration, Loads, Material, Section, State, Supports, natural_modes};

/// Aluminium, about.
pub const MATERIAL: Material = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };

/// Length of the test beams [m].
pub const LENGTH: f64 = 1.5;

/// A plate strip of 20 mm: slender, so that its lowest modes are bending modes.
pub fn section() -> Section {
    Section::strip(0.02)
}

/// Bending stiffness EI of the test beams [N m^2].
pub fn bending_stiffness() -> f64 {
    section().bending_stiffness(&MATERIAL)
}

/// A straight test beam at `angle` [rad].
pub fn beam_at(angle: f64, elements: usize) -> Beam {
    let to = [LENGTH * angle.cos(), LENGTH * angle.sin()];
    Beam::straight([0.0, 0.0], to, elements, MATERIAL, section()).unwrap()
}

/// A straight test beam along x.
pub fn beam(elements: usize) -> Beam {
    beam_at(0.0, elements)
}

/// The supports of a straight beam whose last node is `last`.
pub fn supports(name: &str, last: usize) -> Supports {
    let mut supports = Supports::default();
    match name {
        "cantilever" => supports.clamp(0),
        "simply_supported" => supports.pin(0).pin(last),
        "clamped_clamped" => supports.clamp(0).clamp(last),
        "clamped_pinned" => supports.clamp(0).pin(last),
        other => panic!("no supports called {other}"),
    };
    supports
}

/// The load `[q_x, q_y]` [N/m] on every element.
pub fn uniform(beam: &Beam, load: [f64; 2]) -> Loads {
    let mut loads = Loads::default();
    for element in 0..beam.elements().len() {
        loads.along_element(element, load, load);
    }
    loads
}

/// Rows of a reference table as column name -> text. Lines that begin with `#` are comments.
pub fn table(name: &str) -> Vec<HashMap<String, String>> {
    let path = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/scene/reference/exact/{}.csv"), name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), names.len(), "{path}: {line}");
            names.iter().zip(cells).map(|(name, cell)| (name.to_string(), cell.to_string())).collect()
        })
        .collect()
}

/// A cell of a table as a number.
pub fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|error| panic!("{column} = {}: {error}", row[column]))
}

/// The trapezoidal rule without dissipation.
pub const CONSERVING: Integration = Integration::Trapezoidal { spectral_radius: 1.0 };

/// No load.
pub fn none(nodes: usize) -> Vec<[f64; 3]> {
    vec![[0.0; 3]; nodes]
}

/// A body with a panel clamped to it that begins away from its centre of mass.
pub fn body_with_panel(material: Material, thickness: f64, elements: usize) -> (Beam, Supports, usize) {
    let panel = Beam::straight([0.1, 0.05], [0.6, 0.05], elements, material, Section::strip(thickness)).unwrap();
    let (model, body) = panel.with_rigid_body([-0.05, 0.0], 20.0, 0.3).unwrap();
    let mut held = Supports::default();
    held.link(body, 0);
    (model, held, body)
}

/// Rubber, about.
pub const RUBBER: Material = Material { youngs_modulus: 5e6, poissons_ratio: 0.45, density: 1100.0 };

/// The scalar product of two fields over the nodes.
pub fn pairing(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

/// What moved between two states.
pub fn moved(from: &State, to: &State) -> Vec<[f64; 3]> {
    let each = to.displacement.iter().zip(&from.displacement);
    each.map(|(to, from)| [0, 1, 2].map(|dof| to[dof] - from[dof])).collect()
}

/// omega = (kL)^2 sqrt(EI/(rho A L^4)) of the strip of the tests.
pub fn exact_frequency(root: f64) -> f64 {
    (root / LENGTH).powi(2) * (bending_stiffness() / section().mass_per_length(&MATERIAL)).sqrt()
}

/// Angular frequency of a small vibration in one mode, from the zeros of the tip's deflection over ten periods.
pub fn frequency_in_time(integration: Integration, mode: usize, elements: usize, steps_a_period: f64) -> f64 {
    let held = supports("cantilever", elements);
    let shape = natural_modes(&beam(elements), &held, mode + 1).unwrap().swap_remove(mode);
    let mut dynamics = Dynamics::new(beam(elements), held, integration, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    let scale = 1e-6 / shape.shape[elements][1];
    for (u, phi) in state.displacement.iter_mut().zip(&shape.shape) {
        *u = phi.map(|phi| scale * phi);
    }
    let load = none(elements + 1);
    let period = std::f64::consts::TAU / shape.angular_frequency;
    let dt = (period / steps_a_period).min(0.9 * dynamics.stable_dt());
    dynamics.equilibrate_over(&mut state, &load, dt).unwrap();
    let mut crossings = Vec::new();
    while crossings.len() < 11 {
        let before = (state.time, state.displacement[elements][1]);
        dynamics.step(&mut state, &load, dt).unwrap();
        let now = state.displacement[elements][1];
        if before.1 < 0.0 && now >= 0.0 {
            crossings.push(before.0 + dt * before.1 / (before.1 - now));
        }
    }
    std::f64::consts::TAU * 10.0 / (crossings[10] - crossings[0])
}
