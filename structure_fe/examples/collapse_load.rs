//! Plastic hinges and the collapse load of a clamped beam: `cargo run --release -p structure_fe --example collapse_load`.
//!
//! A force P at the middle of a beam of a steel without hardening. First yield: P = 8 M_y/L with M_y = sigma_y b t^2/6.
//! Collapse (limit analysis): hinges at both ends and at the middle, P = 8 M_p/L with M_p = sigma_y b t^2/4 = 1.5 M_y. The right
//! end slides along the beam, so that there is no membrane force. The search finds the load at which the middle deflects by a
//! twentieth of the span, about ten times what is elastic.

use structure_fe::{Beam, Dof, Error, Loads, Material, NonlinearStatics, Plasticity, Section, Supports};

fn main() -> Result<(), Error> {
    let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    let plasticity = Plasticity { yield_stress: 355e6, hardening_modulus: 0.0 };
    let (length, thickness, width, elements) = (1.0_f64, 0.04_f64, 0.02_f64, 80);
    let section = Section::rectangular(thickness, width);
    let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, steel, section)?.with_plasticity(plasticity)?;
    let mut supports = Supports::default();
    supports.clamp(0).fix(elements, Dof::W).fix(elements, Dof::Theta);
    let model = NonlinearStatics::new(beam, supports)?;
    let middle = elements / 2;
    let under = |force: f64| {
        let mut loads = Loads::default();
        loads.at_node(middle, [0.0, -force, 0.0]);
        model.solve(&loads, 10)
    };

    let yield_moment = plasticity.yield_stress * width * thickness.powi(2) / 6.0;
    let (first_yield, collapse) = (8.0 * yield_moment / length, 12.0 * yield_moment / length);
    let elastic = |force: f64| force * length.powi(3) / (192.0 * section.bending_stiffness(&steel));
    println!("P/P_yield  deflection mm  elastic mm  plastic curvature at the clamp, a quarter, the middle 1/m");
    for share in [0.9, 1.2, 1.4] {
        let solution = under(share * first_yield)?;
        let curvature = [0, elements / 4, middle].map(|element| solution.plastic_curvature[element][0] + 0.0);
        println!(
            "{share:9}  {:13.3}  {:10.3}  {curvature:.4?}",
            -1e3 * solution.displacement[middle][1],
            1e3 * elastic(share * first_yield)
        );
    }

    let (mut low, mut high) = (first_yield, 2.0 * first_yield);
    while high - low > 1e-3 * first_yield {
        let force = 0.5 * (low + high);
        match under(force) {
            Ok(solution) if -solution.displacement[middle][1] < length / 20.0 => low = force,
            _ => high = force,
        }
    }
    println!("collapse at {:.2} kN, limit analysis {:.2} kN: {:.3}", 1e-3 * low, 1e-3 * collapse, low / collapse);
    assert!((low / collapse - 1.0).abs() < 0.03);
    Ok(())
}
