//! Kernels against an exact solution, a stretched drop (Monaghan 1994): `cargo run --release -p sph_core --example elliptic_drop`.

mod tank;

use sph_core::{Breakdown, Domain, Fluid, FluidSettings, Kernel, Seed, Walls, wcsph};

/// Strain rate at first [1/s]; the radius is 1 m.
const STRAIN: f64 = 1.0;

/// Time [s] at which b has doubled: a' = −A a, b' = A b, A' = A² (a² − b²)/(a² + b²) by the midpoint rule.
fn doubled_at() -> f64 {
    let slope = |a: f64, b: f64, strain: f64| strain * strain * (a * a - b * b) / (a * a + b * b);
    let (mut time, mut a, mut b, mut strain, dt) = (0.0, 1.0_f64, 1.0_f64, STRAIN, 1e-4);
    while b < 2.0 {
        let middle = strain + 0.5 * dt * slope(a, b, strain);
        strain += dt * slope(a * (1.0 - 0.5 * dt * strain), b * (1.0 + 0.5 * dt * strain), middle);
        (a, b, time) = (a * (-middle * dt).exp(), b * (middle * dt).exp(), time + dt);
    }
    time
}

/// A drop on a lattice that plane strain does not collapse: turned by the golden ratio less 1 (Kraynik & Reinelt 1992).
fn drop(spacing: f64) -> Vec<Seed> {
    let (sin, cos) = 0.618_033_988_749_895_f64.atan().sin_cos();
    let side = (1.5 / spacing) as i32;
    let lattice =
        (-side..side).flat_map(|i| (-side..side).map(move |j| [i, j].map(|c| (f64::from(c) + 0.5) * spacing)));
    let seed = |[p, q]: [f64; 2]| {
        let at = [cos * p - sin * q, sin * p + cos * q];
        let pressure = 500.0 * STRAIN * STRAIN * (1.0 - at[0] * at[0] - at[1] * at[1]);
        Seed { at, velocity: [-STRAIN * at[0], STRAIN * at[1]], area: spacing * spacing, pressure }
    };
    lattice.map(seed).filter(|seed| seed.pressure > 0.0).collect()
}

/// Semi-axes a and b [m]: Σ m x² = M a²/4 in an ellipse.
fn axes(fluid: &Fluid) -> [f64; 2] {
    let p = fluid.particles();
    [&p.x, &p.y].map(|x| (4.0 * p.mass.iter().zip(x).map(|(m, x)| m * x * x).sum::<f64>() / fluid.mass()).sqrt())
}

fn main() -> Result<(), Breakdown> {
    println!("kernel         h/dx  spacing  a/a exact  b/b exact  energy left");
    for (kernel, smoothing_ratio) in [(Kernel::WendlandC2, 1.5), (Kernel::WendlandC4, 2.0), (Kernel::Gaussian, 1.2)] {
        for spacing in [0.1, 0.05] {
            let water = FluidSettings { kernel, smoothing_ratio, ..FluidSettings::default() };
            let domain = Domain { fluid: water, fastest_speed: 1.4 * STRAIN, ..Domain::default() };
            let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &drop(spacing));
            fluid.initialise(&mut Walls::default())?;
            let (before, energy) = (axes(&fluid), fluid.energy().total());
            tank::advance(&mut fluid, &mut Walls::default(), doubled_at())?;
            let (now, left) = (axes(&fluid), fluid.energy().total() / energy);
            let [a, b] = [now[0] / (0.5 * before[0]), now[1] / (2.0 * before[1])];
            let name = format!("{kernel:?}");
            println!("{name:13}  {smoothing_ratio:4.1}  {spacing:7.2}  {a:9.4}  {b:9.4}  {left:11.4}");
            assert!((a - 1.0).abs() < 0.02 && (b - 1.0).abs() < 0.01);
        }
    }
    Ok(())
}
