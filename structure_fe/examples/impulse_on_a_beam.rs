//! An impulse on a simply supported beam with damping: `cargo run --release -p structure_fe --example impulse_on_a_beam`.
//!
//! A short slam gives the whole beam the speed v. Theory, by its modes: the middle deflects by
//! sum over odd n of 4 v/(n pi omega_d) sin(n pi/2) exp(-zeta omega t) sin(omega_d t), omega = (n pi/L)^2 sqrt(EI/m),
//! omega_d = omega sqrt(1 - zeta^2). Rayleigh's damping a_M M + a_K K gives each mode zeta = a_M/(2 omega) + a_K omega/2.

use std::f64::consts::PI;
use structure_fe::{Beam, Damping, Dof, Dynamics, Error, Integration, Material, Section, Supports};

fn main() -> Result<(), Error> {
    let steel = Material { youngs_modulus: 210e9, poissons_ratio: 0.3, density: 7850.0 };
    let (length, elements, speed, section) = (2.0_f64, 40, 0.1, Section::rectangular(0.05, 0.05));
    let beam = Beam::straight([0.0, 0.0], [length, 0.0], elements, steel, section)?;
    let mut supports = Supports::default();
    supports.pin(0).fix(elements, Dof::W); // one end slides along the beam
    let unit = (section.bending_stiffness(&steel) / section.mass_per_length(&steel)).sqrt();
    let frequency = |n: f64| (n * PI / length).powi(2) * unit;
    let damping = Damping { mass: 0.04 * frequency(1.0), stiffness: 0.02 / frequency(1.0) }; // 3 % in the first mode

    let exact = |time: f64| -> f64 {
        let of_mode = |n: i32| {
            let omega = frequency(f64::from(n));
            let ratio = 0.5 * (damping.mass / omega + damping.stiffness * omega);
            let damped = omega * (1.0 - ratio * ratio).sqrt();
            let sign = if n % 4 == 1 { 1.0 } else { -1.0 };
            sign * 4.0 * speed / (f64::from(n) * PI * damped) * (-ratio * omega * time).exp() * (damped * time).sin()
        };
        (1..10).step_by(2).map(of_mode).sum() // the damping of mode 11 is above critical, and its deflection negligible
    };

    let rule = Integration::GeneralisedAlpha { spectral_radius: 1.0 };
    let mut dynamics = Dynamics::new(beam, supports, rule, damping)?;
    let mut state = dynamics.at_rest();
    state.velocity[1..elements].iter_mut().for_each(|v| v[1] = speed);
    let load = vec![[0.0; 3]; elements + 1];
    dynamics.equilibrate(&mut state, &load)?;
    let period = 2.0 * PI / frequency(1.0);
    let (mut largest, mut difference) = (0.0_f64, 0.0_f64);
    for step in 1..=2000 {
        dynamics.step(&mut state, &load, period / 400.0)?;
        let (computed, theory) = (state.displacement[elements / 2][1], exact(state.time));
        largest = largest.max(computed);
        difference = difference.max((computed - theory).abs());
        assert!((computed - theory).abs() < 1e-5, "t = {} s: {computed} m, theory {theory} m", state.time);
        if step % 400 == 100 {
            println!("t/T = {:4.2}: {:7.4} mm, theory {:7.4} mm", state.time / period, 1e3 * computed, 1e3 * theory);
        }
    }
    println!("largest deflection {:.4} mm, largest difference {:.5} mm", 1e3 * largest, 1e3 * difference);
    Ok(())
}
