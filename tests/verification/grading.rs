//! Spacings that grow must not be felt: sound goes through them, and still water stands in them as in equal ones.

use evidence::parameters::Parameters;
use evidence::systems::{advance, system};
use sph_core::wcsph::eos::Tait;
use sph_core::{Fluid, Periodic, Seed, Walls};

const SOUND: f64 = 50.0;
const DENSITY: f64 = 1000.0;
/// Height of the strip [m], periodic, and particles across it in each column: 0.01 m apart, then about a tenth more each
/// column, as by default in a scene, to 0.03 m.
const HEIGHT: f64 = 0.48;
const FINE: usize = 48;
const GROWING: [usize; 10] = [44, 40, 36, 33, 30, 27, 24, 22, 20, 18];
const COARSE: usize = 16;
/// The pulse: Gaussian, of Mach 10⁻⁴.
const SPEED: f64 = 1e-4 * SOUND;
const START: f64 = -0.7;

/// A strip of water, and a pulse of standard deviation `width` [m]: fine to the left of x = 0, coarse right of where its columns have grown, unless `even`.
fn strip(even: bool, width: f64) -> Fluid {
    let mut seeds = Vec::new();
    let mut column = |left: f64, across: usize| {
        let side = HEIGHT / across as f64;
        let x = left + 0.5 * side;
        let u = SPEED * (-((x - START) / width).powi(2) / 2.0).exp();
        let pressure = DENSITY * SOUND * u;
        seeds.extend((0..across).map(|k| Seed {
            at: [x, (k as f64 + 0.5) * side],
            velocity: [u, 0.0],
            area: side * side,
            pressure,
        }));
        left + side
    };
    (0..150).fold(-1.5, |x, _| column(x, FINE));
    let growing = GROWING.iter().fold(0.0, |x, &across| column(x, if even { FINE } else { across }));
    let (across, columns) = if even { (FINE, 150) } else { (COARSE, 50) };
    (0..columns).fold(growing, |x, _| column(x, across));
    let parameters = Parameters {
        gravity: [0.0; 2],
        periodic: Some(Periodic { x: None, y: Some([0.0, HEIGHT]) }),
        ..Parameters::usual(Tait { rho0: DENSITY, c0: SOUND, gamma: 7.0 })
    };
    let mut fluid = parameters.fluid(&seeds);
    fluid.initialise(&mut Walls::default()).expect("water at rest");
    fluid
}

/// Largest pressure that moves to the left through the fine columns, over the pulse's [-], once the pulse has gone through
/// the growing ones.
fn sent_back(even: bool, width: f64) -> f64 {
    let (mut fluid, mut walls) = (strip(even, width), Walls::default());
    while fluid.time() < 1.4 / SOUND {
        let dt = fluid.stable_dt(&walls).expect("sound");
        fluid.step(&mut walls, dt).expect("a stable run");
    }
    let (p, pressure) = (fluid.particles(), &fluid.fields().pressure);
    let mut back = [[0.0; 2]; 120]; // sums and counts of columns between x = −1.2 and 0
    for k in 0..p.len() {
        let column = ((p.x[k] + 1.2) / 0.01).floor();
        if (0.0..120.0).contains(&column) {
            let [sum, count] = &mut back[column as usize];
            *sum += 0.5 * (pressure[k] - DENSITY * SOUND * p.u[k]);
            *count += 1.0;
        }
    }
    let largest = back.iter().filter(|b| b[1] > 0.0).map(|b| (b[0] / b[1]).abs()).fold(0.0, f64::max);
    largest / (DENSITY * SOUND * SPEED)
}

/// A pulse of six coarse spacings between its flanks loses less than a hundredth; the longest lose 1.8 %, however slowly
/// the columns grow: Σ V ∇W of columns that grow and have not settled is not nothing, and its integral is ln 3 times a
/// number of the kernel.
#[test]
fn columns_that_grow_send_back_little_of_a_pulse() {
    for (width, bound) in [(0.1, 0.01), (0.3, 0.02)] {
        let (graded, even) = (sent_back(false, width), sent_back(true, width));
        println!("{width} m: sent back {graded:.5} of the pulse by columns that grow, {even:.5} by even ones");
        assert!(graded < bound, "{graded} of a pulse of {width} m; even columns {even}");
    }
}

/// Root mean square of p − ρ g depth over ρ g H in the tank's middle, mean over its last second [-].
fn hydrostatic_error(growth: &str) -> f64 {
    let fine = ["resolution.fine_zone=[0.2, 0.4]", "time.end=4"];
    let sets: Vec<&str> = fine.into_iter().chain([growth]).collect();
    let (mut sum, mut count) = (0.0, 0.0);
    let mut tank = system("hydrostatic_tank", &sets);
    advance(&mut tank, 4.0, |s| {
        if s.fluid.time() < 3.0 {
            return;
        }
        let (p, d) = (s.fluid.particles(), s.fluid.fields());
        let error = |k: usize| d.pressure[k] / (DENSITY * 9.81) + p.y[k];
        let inside: Vec<usize> =
            (0..p.len()).filter(|&k| p.x[k].abs() < 1.0 / 3.0 && (-0.9..-0.1).contains(&p.y[k])).collect();
        sum += (inside.iter().map(|&k| error(k).powi(2)).sum::<f64>() / inside.len() as f64).sqrt();
        count += 1.0;
    })
    .expect("a stable run");
    sum / count
}

#[test]
fn a_graded_tank_stands_as_still_as_an_even_one() {
    let (even, graded) = (hydrostatic_error("resolution.growth=1.0"), hydrostatic_error("resolution.growth=1.1"));
    println!("error of the pressure over that of the depth: even {even:.5}, graded {graded:.5}");
    assert!(graded < even + 0.003, "even {even}, graded {graded}");
}
