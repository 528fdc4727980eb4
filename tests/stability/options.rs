//! Every option runs a dam break to its end, or fails as it is known to.

use evidence::systems::{advance, scene, system};
use run::summary::Summary;
use run::{self, RunOptions};
use scene::vocabulary::Status;

/// A coarse dam break to its end, 1.8 s.
fn dam_break(sets: &[&str]) -> Summary {
    let scene = scene("dam_break", &[&["resolution.spacing=0.08"], sets].concat());
    run::run(&scene, &RunOptions::default()).expect("a scene that can be built").summary
}

/// Runs to the end with momentum closed to 1e-10 in each step.
fn completes(sets: &[&str]) {
    let summary = dam_break(sets);
    assert!(summary.status.is_completed(), "{sets:?}: {:?}", summary.message);
    assert!(summary.audit.momentum < 1e-10, "{sets:?}: momentum open by {:e}", summary.audit.momentum);
}

/// Breaks down with a density that no weakly compressible flow has.
fn breaks_down(sets: &[&str]) {
    let summary = dam_break(sets);
    let message = summary.message.unwrap_or_default();
    assert_eq!(summary.status, Status::Failed, "{sets:?} ran");
    assert!(message.contains("has density") || message.contains("non-finite"), "{sets:?}: {message}");
}

/// What the thesis's compressible solver ran with (M. Pilorget 2010): no diffusion, no shifting, much viscosity.
const LEGACY: [&str; 3] = ["fluid.density_diffusion=0", "fluid.shifting=false", "fluid.artificial_viscosity=0.5"];

/// An ideal gas of 288 K so heavy that its sound is as slow as the water's, 40 m/s.
const HEAVY_GAS: [&str; 2] = ["fluid.equation_of_state=ideal_gas", "fluid.molar_mass=2.1"];

/// Verlet's integrator in a quarter of its usual number of steps.
const VERLET: [&str; 3] = ["fluid.integrator=verlet", "fluid.cfl=0.2", "fluid.verlet_correction_every=6"];

#[test]
fn every_kernel_and_integrator_runs_a_dam_break() {
    completes(&["fluid.kernel=gaussian"]);
    completes(&["fluid.kernel=cubic_spline"]);
    completes(&["fluid.integrator=predictor_corrector"]);
    completes(&["fluid.integrator=verlet"]);
    completes(&["fluid.integrator=beeman"]);
}

#[test]
fn every_filter_viscosity_and_law_runs_a_dam_break() {
    completes(&["fluid.density_filter=shepard"]);
    completes(&["fluid.density_filter=mls"]);
    completes(&["fluid.xsph=0.5"]);
    completes(&["fluid.density_diffusion_form=molteni"]);
    completes(&["fluid.eos_exponent=1"]);
    completes(&["fluid.kinematic_viscosity=1e-6", "fluid.turbulence=sps"]);
    completes(&["fluid.kinematic_viscosity=1e-3", "fluid.wall_slip=none"]);
}

/// The Riemann form (THEORY WC8, WC9) in place of density diffusion and artificial viscosity.
#[test]
fn the_riemann_form_runs_a_dam_break_with_every_integrator_and_in_gas() {
    let riemann = "fluid.dissipation=riemann";
    for integrator in ["symplectic", "predictor_corrector", "beeman"] {
        completes(&[riemann, &format!("fluid.integrator={integrator}")]);
    }
    completes(&[&VERLET[..], &[riemann]].concat());
    completes(&[&HEAVY_GAS[..], &[riemann]].concat());
}

#[test]
fn options_run_together_and_as_the_thesis_had_them() {
    let all = ["fluid.density_filter=mls", "fluid.xsph=0.5", "fluid.kinematic_viscosity=1e-6", "fluid.turbulence=sps"];
    for integrator in [
        &["fluid.integrator=symplectic"][..],
        &["fluid.integrator=predictor_corrector"],
        &VERLET,
        &["fluid.integrator=beeman"],
    ] {
        completes(&[&LEGACY, integrator].concat());
        completes(&[&all, integrator].concat());
        completes(&[&HEAVY_GAS, integrator].concat());
    }
}

/// A heavy gas under p₀ falls as the water does, and dissipates as much. For that its spray must be compressed, and its
/// density diffused, along isentropes (THEORY LE11, LE12): with e left alone p₀ dV goes astray, many times what falls.
#[test]
fn a_gas_does_not_lose_more_energy_than_falls() {
    let energy = dam_break(&HEAVY_GAS).audit.energy;
    assert!((-1.0..0.0).contains(&energy), "energy changes by {energy} of what changed hands");
}

/// The quadratic kernel's gradient is largest where particles touch and drops to zero at 2h with a kink. Failure: with
/// the default recipe its jets end in a breakdown. Remedy: another kernel, or the viscosity that the thesis used.
#[test]
fn the_quadratic_kernel_breaks_down_without_much_viscosity() {
    breaks_down(&["fluid.kernel=quadratic", "resolution.spacing=0.05"]);
    completes(&[&["fluid.kernel=quadratic", "resolution.spacing=0.05"], &LEGACY[..]].concat());
}

/// Failure: counted from masses (THEORY LE13), water at a free surface misses half of its neighbours and is taken for
/// thin: at the column's corner so thin that the run cannot begin. Remedy: the continuity equation (WC3).
#[test]
fn summed_densities_break_down_at_a_free_surface() {
    let scene = scene("dam_break", &["resolution.spacing=0.06", "fluid.density_evolution=summation"]);
    let Err(error) = run::run(&scene, &RunOptions::default()) else { panic!("summed densities ran") };
    assert!(error.to_string().contains("has density"), "{error}");
    completes(&["fluid.density_evolution=continuity"]);
}

/// Failure: a fixed step of 1.5 h/c₀, which a scene is refused for (THEORY WC16). Remedy: one of a third of that, or none, so
/// that the limit (WC12) rules.
#[test]
fn a_fixed_step_above_the_acoustic_limit_breaks_down() {
    let limit = 1.5 * 0.06 / 34.3; // h/c₀ of the scene [s]
    let set = |step: f64| vec!["resolution.spacing=0.06".to_string(), format!("time.step={step}")];
    let message = run::load("dam_break", &set(1.5 * limit)).expect_err("a step that breaks down").to_string();
    assert!(message.contains("`time.step`") && message.contains("1.2 h/c0"), "{message}");
    let mut scene = scene("dam_break", &["resolution.spacing=0.06"]);
    scene.time.step = Some(1.5 * limit);
    let summary = run::run(&scene, &RunOptions::default()).expect("a scene that can be built").summary;
    assert_eq!(summary.status, Status::Failed, "1.5 h/c0 ran");
    completes(&[&format!("time.step={}", 0.5 * limit)]);
}

/// Lowest pressure [Pa] in 5 ms of a cylinder that is pulled upwards through water at 10 m/s.
fn lowest_pressure(sets: &[&str]) -> f64 {
    let pulled = ["body.motion=constant_velocity", "body.velocity=[0.0, 10.0]", "coupling.scheme=weak"];
    let mut system = system("rising_body", &[&pulled, sets].concat());
    let mut lowest = 0.0_f64;
    advance(&mut system, 0.005, |s| lowest = s.fluid.fields().pressure.iter().fold(lowest, |least, &p| least.min(p)))
        .expect("a stable run");
    lowest
}

/// Failure: water behind a body that leaves it fast holds tensions that no water holds. Remedy: a cavitation pressure.
#[test]
fn water_behind_a_fast_body_holds_tension_down_to_the_cavitation_pressure() {
    let (without, with) = (lowest_pressure(&[]), lowest_pressure(&["fluid.cavitation_pressure=-99000"]));
    let mild = lowest_pressure(&["fluid.cavitation_pressure=-1000"]);
    assert!((mild / -1e3 - 1.0).abs() < 1e-9, "{mild} Pa");
    assert!(without < -200e3, "{without} Pa");
    assert!((with / -99e3 - 1.0).abs() < 1e-9, "{with} Pa");
}
