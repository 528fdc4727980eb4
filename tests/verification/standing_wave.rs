//! A standing gravity wave in a rectangular tank (Lamb, Hydrodynamics, §228): ω² = g k tanh(k H).

use std::sync::LazyLock;

use evidence::long::long;
use evidence::parameters::Parameters;
use evidence::statistics::period;
use evidence::systems::{advance, scene};
use fsi_coupling::{Body, Coupled, Scheme, Tank};
use run::summary::Summary;
use run::{RunOptions, build, run};
use scene::reference::Table;
use sph_core::Seed;
use sph_core::wcsph::eos::Tait;

/// Largest slope k A of the wave [-]: by its third-order term the period changes by 0.12 (k A)² = 0.1 %.
const STEEPNESS: f64 = 0.1;

/// Half a wavelength of 2 m in a tank 1 m deep, set off with the velocities of the flat moment and no displacement:
/// u = A ω cosh(k(y + H))/sinh(k H) sin(k x), v = −A ω sinh(k(y + H))/sinh(k H) cos(k x).
fn wave(spacing: f64, omega: f64, dissipation: &str) -> Coupled {
    let scene = scene("hydrostatic_tank", &[&format!("resolution.spacing={spacing}"), dissipation]);
    let (k, depth) = (std::f64::consts::PI, 1.0);
    let speed = STEEPNESS / k * omega / (k * depth).sinh();
    let (layout, still) = (scene::layout(&scene), build::build(&scene).expect("a still tank"));
    let mut seeds = Vec::new();
    layout.for_each(|cell| {
        let (x, height) = (cell.at[0] + 0.5, cell.at[1] + depth);
        let velocity = [speed * (k * height).cosh() * (k * x).sin(), -speed * (k * height).sinh() * (k * x).cos()];
        seeds.push(Seed { at: cell.at, velocity, area: cell.area(), pressure: -1000.0 * 9.81 * cell.at[1] });
    });
    let usual = Parameters::of(&still.fluid);
    let parameters = Parameters { eos: Tait { c0: 60.0, ..usual.eos }, ..usual };
    let tank: Box<dyn Body> = Box::new(Tank::new(layout, [-0.5, 0.5], -depth, 0.5, false));
    Coupled::new(parameters.fluid(&seeds), vec![tank], Scheme::Weak, spacing).expect("a tank of water")
}

/// The water's centre of mass swings with the wave; its period meets the exact one within 2 %, and a period takes no more
/// than a tenth of its amplitude (exact: none, without viscosity).
#[test]
fn a_standing_wave_has_lambs_period() {
    let name = "exact/standing_wave_frequency.csv";
    let table = Table::load(name).expect("a reference");
    let first = |column: &str| table.column(name, column).expect("a column")[0];
    assert_eq!([first("wavelength_m"), first("depth_m")], [2.0, 1.0], "another wave stands first in the table");
    let omega = first("omega");
    let lost = ["fluid.dissipation=diffusion", "fluid.dissipation=riemann"].map(|dissipation| {
        let mut system = wave(0.04, omega, dissipation);
        let mut swing = Vec::new();
        advance(&mut system, 2.5, |s| {
            let p = s.fluid.particles();
            let moment: f64 = (0..p.len()).map(|k| p.mass[k] * p.x[k]).sum();
            swing.push([s.fluid.time(), moment / s.fluid.mass()]);
        })
        .expect("a stable run");
        let (ours, exact) = (period(&swing), 2.0 * std::f64::consts::PI / omega);
        // turning points of the first and of the fourth half period, one and a half periods apart
        let turn = |half: f64| {
            let within = |t: f64| t > half * 0.5 * exact && t < (half + 1.0) * 0.5 * exact;
            swing.iter().filter(|s| within(s[0])).map(|s| s[1].abs()).fold(0.0, f64::max)
        };
        let lost = 1.0 - (turn(3.0) / turn(0.0)).powf(1.0 / 1.5);
        println!("{dissipation}: period {ours:.4} s, exact {exact:.4} s; {:.2} % of amplitude a period", 100.0 * lost);
        assert!((ours / exact - 1.0).abs() < 0.02, "{dissipation}: period {ours:.4} s, exact {exact:.4} s");
        lost
    });
    assert!((0.0..0.15).contains(&lost[0]), "density diffusion takes {:.2} % a period", 100.0 * lost[0]);
    assert!((0.0..0.08).contains(&lost[1]), "the Riemann form takes {:.2} % a period", 100.0 * lost[1]);
}

/// `standing_wave` as it is, coarse.
pub static COARSE_WAVE: LazyLock<Summary> = LazyLock::new(|| summary(&["resolution.spacing=0.05"]));

fn summary(sets: &[&str]) -> Summary {
    run(&scene("standing_wave", sets), &RunOptions::default()).expect("a run").summary
}

/// Error of the period, from six periods of the height at the wall [-].
fn period_error(summary: &Summary) -> f64 {
    let line = summary.comparison.iter().find(|c| c.quantity.ends_with("period [s]")).expect("a period");
    println!("period {:.4} s, exact {:.4} s, {:+.2} %", line.ours, line.theirs, 100.0 * line.error);
    line.error
}

/// Let go at its turning point instead, with either solver: the height at a wall has Lamb's period, measured by its zeros.
#[test]
fn a_wave_that_is_let_go_has_lambs_period_with_either_solver() {
    let projection =
        |spacing| summary(&["solver=incompressible", "fluid.cfl=0.2", "fluid.artificial_viscosity=0", spacing]);
    assert!(period_error(&COARSE_WAVE).abs() < 0.02, "weakly compressible");
    assert!(period_error(&projection("resolution.spacing=0.05")).abs() < 0.02, "incompressible");
    if long() {
        let finer = "resolution.spacing=0.033333333333";
        assert!(period_error(&summary(&[finer])).abs() < 0.02, "weakly compressible, finer");
        assert!(period_error(&projection(finer)).abs() < 0.02, "incompressible, finer");
    }
}
