//! A clamped panel under pressure, with and without its membrane force:
//! `cargo run --release -p structure_fe --example panel_under_pressure`.
//!
//! A strip of an aluminium panel, 0.4 m between its frames and 2 mm thick. Linear theory: w = p L^4/(384 D). The frames hold the
//! edges, so that the strip must stretch to deflect: a force S carries a part of the pressure. Theory of both (Timoshenko &
//! Woinowsky-Krieger 1959, article 3): w = p L^4/(384 D) f(u), u^2 = S L^2/(4 D), with u from the length of the deflected strip.

use structure_fe::{Beam, Error, Loads, Material, NonlinearStatics, Section, Statics, Supports};

/// Deflection over that of linear theory at a membrane parameter u.
fn deflection(u: f64) -> f64 {
    24.0 / u.powi(4) * (0.5 * u * u + u / u.sinh() - u / u.tanh())
}

/// U(u) = (E t^4/((1 - nu^2) p L^4))^2: the condition on the length of the strip.
fn stretch(u: f64) -> f64 {
    let (sinh, tanh) = (u.sinh(), u.tanh());
    -81.0 / (16.0 * u.powi(7) * tanh) - 27.0 / (16.0 * u.powi(6) * sinh * sinh)
        + 27.0 / (4.0 * u.powi(8))
        + 9.0 / (8.0 * u.powi(6))
}

fn main() -> Result<(), Error> {
    let aluminium = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };
    let (length, thickness, elements) = (0.4_f64, 0.002_f64, 40);
    let section = Section::strip(thickness);
    let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, aluminium, section)?;
    let mut supports = Supports::default();
    supports.clamp(0).clamp(elements);
    let linear = Statics::new(beam.clone(), supports.clone())?;
    let nonlinear = NonlinearStatics::new(beam, supports)?;
    let stiffness = section.bending_stiffness(&aluminium);

    println!("pressure Pa  linear mm  theory mm  with membrane mm  theory mm  stress at the clamp MPa");
    for pressure in [1e3, 1e4, 1e5] {
        let mut loads = Loads::default();
        (0..elements).for_each(|element| {
            loads.pressure_on_element(element, pressure, pressure);
        });
        let small = -linear.solve(&loads)?.displacement[elements / 2][1];
        let solution = nonlinear.solve(&loads, 10)?;
        let large = -solution.displacement[elements / 2][1];
        let root = solution.section_forces[0][0];
        let stress = root.fibre_stress(&section, 0.5 * thickness).max(root.fibre_stress(&section, -0.5 * thickness));

        let exact = pressure * length.powi(4) / (384.0 * stiffness);
        let given = (12.0 * stiffness * thickness / (pressure * length.powi(4))).powi(2);
        let (mut low, mut high) = (0.02_f64, 100.0_f64);
        for _ in 0..100 {
            let u = (low * high).sqrt();
            if stretch(u) > given { low = u } else { high = u }
        }
        let with_membrane = exact * deflection(low);
        let mm = [small, exact, large, with_membrane].map(|w| 1e3 * w);
        println!("{pressure:11}  {:9.3}  {:9.3}  {:16.3}  {:9.3}  {:8.1}", mm[0], mm[1], mm[2], mm[3], 1e-6 * stress);
        assert!((small / exact - 1.0).abs() < 1e-6 && (large / with_membrane - 1.0).abs() < 0.01);
    }
    Ok(())
}
