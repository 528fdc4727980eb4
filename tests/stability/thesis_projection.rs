//! Where the thesis's projection fails (THEORY J16).

use evidence::systems::{of_text, system};
use fsi_coupling::{Coupled, CouplingError};

const WEIGHT: f64 = 1000.0 * 9.81;
const SOLVER: &str = "solver=incompressible_thesis";

fn pressure_error(system: &Coupled) -> f64 {
    let p = &system.fluid.particles;
    let [top, floor] = [p.y.iter().copied().fold(f64::MIN, f64::max), p.y.iter().copied().fold(f64::MAX, f64::min)];
    let of = |k: usize| (system.fluid.derived.pressure[k] - WEIGHT * (top - p.y[k])).abs();
    (0..p.len()).map(of).fold(0.0, f64::max) / (WEIGHT * (top - floor))
}

fn column(sets: &[&str]) -> Coupled {
    let text = "name = \"column\"\n[time]\nend = 10.0\n[resolution]\nspacing = 0.05\n[tank]\nwidth = 0.2\ndepth = 0.8\n";
    of_text(text, &[&[SOLVER], sets].concat())
}

fn walk(name: &str, system: &mut Coupled, end: f64) {
    let m = &system.fluid.particles.mass;
    let wall = system.fluid.thesis.wall_mass.iter().copied().fold(f64::INFINITY, f64::min);
    println!("{name}: masses {:.3} to {:.3}, walls' least {wall:.3}", m.iter().copied().fold(f64::INFINITY, f64::min), m.iter().copied().fold(0.0, f64::max));
    let mut next = 0.0;
    let mut n = 0;
    while system.fluid.time < end {
        let stepped = system.stable_dt().and_then(|dt| system.step(dt));
        n += 1;
        if let Err(e) = stepped {
            println!("{name} ended at step {n}: {e}");
            return;
        }
        if n < 4 || system.fluid.time >= next {
            next = system.fluid.time + end / 10.0;
            let p = &system.fluid.derived.pressure;
            println!("{name} {n} t {:.4} error {:.4} speed {:.2e} pressures {:.3e} to {:.3e} left {:.1e}", system.fluid.time, pressure_error(system), system.fluid.top_speed(), p.iter().copied().fold(0.0, f64::min), p.iter().copied().fold(0.0, f64::max), system.fluid.thesis.density_error);
        }
    }
}

#[test]
fn experiments() {
    walk("good", &mut column(&[]), 5.0);
    walk("inverse", &mut column(&["thesis.masses=inverse"]), 2.0);
    walk("inverse 1.25", &mut column(&["thesis.masses=inverse", "fluid.smoothing_ratio=1.25"]), 2.0);
    walk("inverse 1.5", &mut column(&["thesis.masses=inverse", "fluid.smoothing_ratio=1.5"]), 2.0);
    walk("inverse cubic", &mut column(&["thesis.masses=inverse", "fluid.kernel=cubic_spline", "fluid.smoothing_ratio=1.25"]), 2.0);
    walk("zero gradient", &mut column(&["thesis.limit_rows=zero_gradient"]), 2.0);
    walk("zero gradient, one pass", &mut column(&["thesis.limit_rows=zero_gradient", "thesis.inner_passes=1"]), 2.0);
    walk("old pressure", &mut column(&["thesis.predictor=old_pressure"]), 2.0);
    walk("old pressure, one pass", &mut column(&["thesis.predictor=old_pressure", "thesis.inner_passes=1"]), 2.0);
    walk("side walls", &mut column(&["thesis.side_freedom=false"]), 5.0);
    walk("uncorrected", &mut column(&["thesis.gradient_correction=false"]), 5.0);
    walk("wide 1.5", &mut column(&["fluid.smoothing_ratio=1.5"]), 10.0);
    walk("wide 2.0", &mut column(&["fluid.smoothing_ratio=2.0"]), 10.0);
    walk("one pass", &mut column(&["thesis.inner_passes=1"]), 5.0);
    let t = &["solver=incompressible_thesis", "thesis.side_freedom=false"];
    walk("tank, side walls", &mut system("hydrostatic_tank", t), 0.5);
    walk("wedge", &mut system("wedge", &[SOLVER, "resolution.spacing=0.02"]), 0.05);
    walk("box", &mut system("floating_box", &[SOLVER, "resolution.spacing=0.025"]), 0.5);
    walk("cylinder", &mut system("cylinder_entry", &[SOLVER, "resolution.spacing=0.02"]), 0.5);
    walk("dam break", &mut system("dam_break", &[SOLVER, "resolution.spacing=0.03"]), 0.5);
    let _: Option<CouplingError> = None;
}
