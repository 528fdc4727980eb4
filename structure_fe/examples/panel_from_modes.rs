//! A panel from its natural modes under a sudden pressure: `cargo run --release -p structure_fe --example panel_from_modes`.
//!
//! Frequencies, generalised masses and shapes describe the panel; any finite-element program gives them, here `natural_modes`.
//! Theory of a clamped strip: at rest w = p L^4/(384 D). If the pressure comes at once, the first peak is 1 + exp(-pi zeta/sqrt(1 - zeta^2))
//! times as large, as the first mode has nearly all of the deflection.

use std::f64::consts::{PI, TAU};
use structure_fe::modal::{Frame, ModalMode, ModalState, ModalStructure, Step};
use structure_fe::{Beam, Error, Loads, Material, Section, Supports, natural_modes};

fn main() -> Result<(), Error> {
    let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    let (length, elements, pressure, ratio, section) = (0.5_f64, 20, 1e3, 0.05_f64, Section::strip(0.004));
    let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, steel, section)?;
    let mut supports = Supports::default();
    supports.clamp(0).clamp(elements);

    let of_mode = |mode: structure_fe::Mode| ModalMode {
        frequency: mode.angular_frequency / TAU,
        mass: 1.0, // the shapes of `natural_modes` are normalised to it
        damping_ratio: ratio,
        shape: mode.shape,
    };
    let modes: Vec<ModalMode> = natural_modes(&beam, &supports, 5)?.into_iter().map(of_mode).collect();
    let period = 1.0 / modes[0].frequency;
    // a frame at rest: the masses at the nodes, which link it with the modes, do not matter
    let frame = Frame { mass: 0.0, inertia: 0.0, center_of_mass: [0.0; 2], held: [true; 3] };
    let masses = vec![0.0; elements + 1];
    let structure = ModalStructure::new(frame, beam.nodes().to_vec(), masses, modes)?;

    let mut loads = Loads::default();
    (0..elements).for_each(|element| {
        loads.pressure_on_element(element, pressure, pressure);
    });
    let forces = loads.at_nodes(&beam, &vec![[0.0; 3]; elements + 1])?;
    let mut state = structure.at_rest([0.0; 2], 0.0);
    // generalised load: the forces at the nodes times the derivatives of the nodes' places by the unknowns
    let mut load = vec![0.0; structure.unknowns()];
    for (rows, force) in structure.jacobian(&state).iter().zip(&forces) {
        (0..3).for_each(|i| load.iter_mut().zip(&rows[i]).for_each(|(sum, row)| *sum += row * force[i]));
    }
    let middle = |state: &ModalState| -structure.places(state)[elements / 2][1];
    let mut peak = 0.0_f64;
    for _ in 0..4000 {
        structure.step(&mut state, &load, &Step { dt: period / 100.0, gravity: [0.0; 2], frame: None })?;
        peak = peak.max(middle(&state));
    }
    let exact = pressure * length.powi(4) / (384.0 * section.bending_stiffness(&steel));
    let factor = 1.0 + (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
    let [rest, largest, theory] = [middle(&state), peak, exact].map(|w| 1e3 * w);
    println!(
        "at rest {rest:.4} mm, theory {theory:.4} mm; first peak {largest:.4} mm, theory {:.4} mm",
        factor * theory
    );
    assert!((rest / theory - 1.0).abs() < 0.01 && (largest / (factor * theory) - 1.0).abs() < 0.03);
    Ok(())
}
