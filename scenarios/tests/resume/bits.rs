//! A table of scenes, solvers and options, each broken off and continued.

use super::continues;

/// One thread before the break, two after it; and the other way round.
const THREADS: [[usize; 2]; 2] = [[1, 2], [2, 1]];

fn each(cases: &[(&str, &[&str])]) {
    for (k, (name, sets)) in cases.iter().enumerate() {
        continues(name, sets, 0.4 + 0.07 * (k % 7) as f64, THREADS[k % 2]);
    }
}

#[test]
fn weakly_compressible_water() {
    each(&[
        ("dam_break", &["time.end=0.06", "resolution.spacing=0.04"]),
        (
            "dam_break",
            &["time.end=0.04", "resolution.spacing=0.04", "fluid.dissipation=riemann", "observe.volume=true"],
        ),
        ("sloshing", &["time.end=0.1", "resolution.spacing=0.08"]),
        ("wave_maker", &["time.end=0.3", "resolution.spacing=0.1", "tank.width=8", "observe.level=[-2.0, 1.0]"]),
        ("falling_jet", &["time.end=0.06", "resolution.spacing=0.05"]),
        ("hydrostatic_plate", &["time.end=0.005"]),
    ]);
}

#[test]
fn bodies_and_couplings() {
    each(&[
        ("wedge", &["time.end=0.006", "resolution.spacing=0.015", "gauges=[]"]),
        ("two_boxes", &["time.end=0.12", "resolution.spacing=0.033"]),
        ("flap", &["time.end=0.015"]),
        ("floating_box", &["time.end=0.06", "resolution.spacing=0.033", "coupling.scheme=weak"]),
        ("floating_box", &["time.end=0.06", "resolution.spacing=0.033", "coupling.scheme=iqn_ils"]),
        ("floating_box", &["time.end=0.06", "resolution.spacing=0.033", "coupling.scheme=added_mass"]),
        ("heaving_box", &["time.end=0.04", "resolution.spacing=0.05"]),
        ("plunging_body", &["time.end=0.04", "resolution.spacing=0.033"]),
    ]);
}

/// Symmetry, refinement that follows the body, gauges, the similarity window and force rules.
#[test]
fn impacts_with_all_observers() {
    each(&[
        ("wedge_constant", &["time.end=0.3", "resolution.spacing=0.1", "report.force_rules=true"]),
        (
            "wedge_constant",
            &["time.end=0.4", "resolution.spacing=0.1", "resolution.follow=true", "fluid.ventilation=true"],
        ),
        ("wedge25", &["time.end=0.008", "resolution.spacing=0.015"]),
        ("wedge_constant", &["time.end=0.3", "resolution.spacing=0.1", "report.log_budget=0.4"]),
    ]);
}

#[test]
fn panels_and_thin_plates() {
    each(&[
        ("flexible_wedge", &["time.end=0.004", "resolution.spacing=0.016"]),
        ("flexible_wedge", &["time.end=0.002", "resolution.spacing=0.016", "coupling.scheme=iqn_ils"]),
        ("elastic_gate", &["time.end=0.01", "resolution.spacing=0.004"]),
        ("dam_break_baffle", &["time.end=0.02", "resolution.spacing=0.01"]),
        ("plate_drop", &["time.end=0.002", "resolution.spacing=0.015"]),
        ("fuselage_flexible", &["time.end=0.006", "resolution.spacing=0.03"]),
    ]);
}

/// A panel that yields until an end breaks off, which ends the run at 2.9 ms; one on springs and dampers.
#[test]
fn panels_that_yield_break_and_spring() {
    let size = ["time.end=0.004", "resolution.spacing=0.016"];
    let weak = [
        "body.panels[0].yield_stress=2e7",
        "body.panels[0].hardening_modulus=1e9",
        "body.panels[0].rupture_strain=4e-3",
    ];
    for share in [0.3, 0.6, 0.97] {
        continues("flexible_wedge", &[&size[..], &weak].concat(), share, [1, 2]);
    }
    let sprung = [
        "body.panels[0].ends=[\"free\", \"free\"]",
        "body.panels[0].end_springs=[[1e7, 4e5, 0.0], [1e7, 4e5, 0.0]]",
        "body.panels[0].end_dampers=[[0.0, 2e3, 0.0], [0.0, 2e3, 0.0]]",
    ];
    continues("flexible_wedge", &[&size[..], &sprung].concat(), 0.7, [2, 1]);
}

#[test]
fn incompressible_water() {
    each(&[
        ("dam_break", &["time.end=0.1", "resolution.spacing=0.05", "solver=incompressible"]),
        ("dam_break", &["time.end=0.06", "resolution.spacing=0.05", "solver=incompressible_explicit"]),
        ("floating_box", &["time.end=0.06", "resolution.spacing=0.033", "solver=incompressible"]),
        ("wedge", &["time.end=0.004", "resolution.spacing=0.012", "solver=incompressible"]),
        ("wedge_constant", &["resolution.spacing=0.1", "solver=incompressible"]),
        ("elastic_gate", &["time.end=0.006", "resolution.spacing=0.004", "solver=incompressible"]),
    ]);
}

#[test]
fn schemes_of_2010() {
    let of = |sets: &[&str]| {
        let sets = [&["time.end=0.03", "resolution.spacing=0.06"], sets].concat();
        continues("dam_break", &sets, 0.6, [1, 2]);
    };
    of(&["fluid.integrator=verlet"]);
    of(&["fluid.integrator=beeman", "fluid.xsph=0.5"]);
    of(&["fluid.integrator=predictor_corrector"]);
    of(&["fluid.density_filter=mls", "fluid.kinematic_viscosity=1e-6", "fluid.turbulence=sps"]);
    of(&["fluid.density_filter=shepard", "fluid.walls=repulsive"]);
    of(&["fluid.walls=dynamic"]);
    of(&["fluid.walls=dynamic", "fluid.integrator=predictor_corrector"]);
    of(&["fluid.walls=mirror_point"]);
    of(&["fluid.equation_of_state=ideal_gas", "fluid.molar_mass=2.1"]);
    of(&["solver=incompressible_thesis", "time.end=0.02"]);
    continues("column", &["time.end=0.02", "solver=incompressible_thesis"], 0.5, [2, 1]);
}
