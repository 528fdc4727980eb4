//! Natural frequencies of a clamped steel strip against theory: `cargo run --release -p structure_fe --example natural_modes`.
//!
//! A strip of a plate, 0.5 m between its clamps and 4 mm thick, in plane strain; everything is per metre of span. Theory
//! (Euler and Bernoulli): omega = (kL)^2 sqrt(D/(m L^4)), where cos kL cosh kL = 1, m is the mass per area and
//! D = E t^3/(12 (1 - nu^2)). With water on one face the frequencies are lower: `structure_fe::wet_modes`.

use std::f64::consts::TAU;
use structure_fe::{Beam, Error, Material, Section, Supports, natural_modes};

/// Roots kL of the first modes of a strip clamped at both ends.
const ROOTS: [f64; 4] = [4.730040745, 7.853204624, 10.995607838, 14.137165491];

fn main() -> Result<(), Error> {
    let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    let (length, elements, section) = (0.5_f64, 16, Section::strip(0.004));
    let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, steel, section)?;
    let mut supports = Supports::default();
    supports.clamp(0).clamp(elements);

    let modes = natural_modes(&beam, &supports, ROOTS.len())?;
    let unit = (section.bending_stiffness(&steel) / section.mass_per_length(&steel)).sqrt() / length.powi(2);
    println!("mode  computed Hz  theory Hz   error %  deflection at a quarter over that at the middle");
    for (number, (mode, root)) in modes.iter().zip(ROOTS).enumerate() {
        let exact = root * root * unit;
        let error = mode.angular_frequency / exact - 1.0;
        let [quarter, middle] = [elements / 4, elements / 2].map(|node| mode.shape[node][1]);
        let ratio = if number % 2 == 0 { format!("{:.3}", quarter / middle) } else { "antisymmetric".into() };
        println!(
            "{:4}  {:11.3}  {:9.3}  {:8.5}  {ratio}",
            number + 1,
            mode.angular_frequency / TAU,
            exact / TAU,
            100.0 * error
        );
        // the finite elements are stiffer than the strip: frequencies are upper bounds
        assert!((0.0..1e-3).contains(&error), "mode {}: {error:e}", number + 1);
    }
    Ok(())
}
