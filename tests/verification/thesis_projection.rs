//! The thesis's projection.

use evidence::systems::{of_text, system};
use fsi_coupling::Coupled;

/// ρ g [Pa/m] of every scene.
const WEIGHT: f64 = 1000.0 * 9.81;

/// Largest error of a particle's pressure against ρ g times its depth below the top row [Pa].
fn error(system: &Coupled) -> f64 {
    let p = &system.fluid.particles;
    let top = p.y.iter().copied().fold(f64::MIN, f64::max);
    let of = |k: usize| (system.fluid.derived.pressure[k] - WEIGHT * (top - p.y[k])).abs();
    (0..p.len()).map(of).fold(0.0, f64::max)
}

fn experiment(name: &str, system: &mut Coupled, steps: usize, dt: f64) {
    let start = std::time::Instant::now();
    for k in 0..steps {
        let h = if dt > 0.0 { dt } else { system.stable_dt().unwrap() };
        if let Err(e) = system.step(h) {
            println!("{name} step {k}: {e}");
            return;
        }
        if k < 6 || k % (steps / 12).max(1) == 0 {
            let t = &system.fluid.thesis;
            let p = &system.fluid.particles;
            let v = (0..p.len()).map(|k| p.u[k].hypot(p.v[k])).fold(0.0, f64::max);
            println!("{name} step {k} t {:.4} dt {h:.2e} error {:.4} Pa, v {v:.2e}, it {} sol {} left {:.1e} ms/step {:.2}", system.fluid.time, error(system), t.iterations, t.solutions, t.density_error, start.elapsed().as_secs_f64()*1e3/(k+1) as f64);
        }
    }
}

#[test]
fn experiments() {
    let sets = std::env::var("SETS").unwrap_or_default();
    let steps: usize = std::env::var("STEPS").ok().and_then(|s| s.parse().ok()).unwrap_or(60);
    let dt: f64 = std::env::var("DT").ok().and_then(|s| s.parse().ok()).unwrap_or(0.0);
    let which = std::env::var("WHICH").unwrap_or("tank".into());
    let mut sets: Vec<&str> = sets.split(';').filter(|s| !s.is_empty()).collect();
    sets.push("solver=incompressible_thesis");
    if which == "tank" {
        experiment("tank", &mut system("hydrostatic_tank", &sets), steps, dt);
    } else if which == "column" {
        let text = "name = \"column\"\n[time]\nend = 1.0\n[resolution]\nspacing = 0.05\n[tank]\nwidth = 0.2\ndepth = 0.8\n";
        experiment("column", &mut of_text(text, &sets), steps, dt);
    } else {
        experiment(&which, &mut system(&which, &sets), steps, dt);
    }
}
