//! Momentum, and action against reaction, in runs with bodies (THEORY CO27).

use evidence::long::long;
use evidence::systems::{lift, system, take};
use fsi_coupling::Coupled;

/// Σ m (a − g − f) of the fluid, f by WC28, and Σ F on the walls [N/m], and Σ |m (a − g − f)|, the size that rounding is relative to.
fn exchange(system: &Coupled) -> ([f64; 2], [f64; 2], f64) {
    let (p, g) = (system.fluid.particles(), system.fluid.domain().gravity);
    let (mut gained, mut size) = ([0.0; 2], 0.0);
    for k in 0..p.len() {
        let rest = p.rest.each_ref().map(|f| f.get(k).copied().unwrap_or(0.0));
        let force = [p.mass[k] * (p.ax[k] - g[0] - rest[0]), p.mass[k] * (p.ay[k] - g[1] - rest[1])];
        (gained[0], gained[1]) = (gained[0] + force[0], gained[1] + force[1]);
        size += force[0].hypot(force[1]);
    }
    (gained, [system.walls.fx.iter().sum(), system.walls.fy.iter().sum()], size)
}

/// What the fluid gains the walls lose, to rounding, through an oblique impact on a whole (not mirrored) tank: pair
/// forces on walls are those on the fluid with the roles swapped.
#[test]
fn forces_on_walls_are_equal_and_opposite_to_those_on_the_fluid() {
    let oblique =
        ["symmetry=none", "body.velocity=[2.0, -6.15]", "body.angle_deg=5", "body.free=[\"x\", \"y\"]", "time.start=0"];
    for dissipation in ["fluid.dissipation=diffusion", "fluid.dissipation=riemann"] {
        let mut system = system("wedge", &[&oblique[..], &["resolution.spacing=0.016", dissipation]].concat());
        take(&mut system, 150).expect("a stable run");
        let (gained, lost, size) = exchange(&system);
        assert!(lift(&system) > 100.0, "the wedge is not in the water: {} N/m", lift(&system));
        for k in 0..2 {
            let gap = (gained[k] + lost[k]).abs();
            assert!(gap < 1e-12 * size, "axis {k}: the fluid gains {} N/m, the walls {} N/m", gained[k], lost[k]);
        }
    }
}

/// In every step of an impact the momentum of fluid and body changes by the impulses of gravity, guides and tank alone:
/// to 1e-10 of what is held and exchanged, body moved or moving, half a tank or a whole one, for every integrator and
/// with every option that changes forces or velocities.
#[test]
fn momentum_closes_in_every_step_of_an_impact() {
    let float = ["resolution.spacing=0.033", "body.position=[0.1, 0.05]", "body.angle_deg=8"];
    for (scene, sets) in [
        ("wedge_constant", vec!["resolution.spacing=0.1"]),
        ("wedge_constant", vec!["resolution.spacing=0.1", "fluid.integrator=predictor_corrector"]),
        ("wedge_constant", vec!["resolution.spacing=0.1", "fluid.integrator=verlet"]),
        ("wedge_constant", vec!["resolution.spacing=0.1", "fluid.integrator=beeman", "fluid.xsph=0.5"]),
        ("wedge", vec!["resolution.spacing=0.016"]),
        ("wedge", vec!["resolution.spacing=0.016", "fluid.dissipation=riemann", "symmetry=none"]),
        ("floating_box", [&float[..], &["fluid.dissipation=riemann"]].concat()),
        (
            "wedge",
            vec!["resolution.spacing=0.016", "fluid.kinematic_viscosity=1e-6", "fluid.turbulence=sps", "symmetry=none"],
        ),
        ("floating_box", [&float[..], &["fluid.integrator=verlet", "fluid.density_filter=mls"]].concat()),
        ("floating_box", [&float[..], &["fluid.integrator=beeman", "fluid.density_filter=shepard"]].concat()),
        (
            "wedge",
            vec!["resolution.spacing=0.016", "symmetry=none", "body.free=[\"x\", \"y\"]", "body.velocity=[1.0, -6.15]"],
        ),
        ("floating_box", float.to_vec()),
    ] {
        let mut system = system(scene, &[&sets[..], &["time.start=0"]].concat());
        take(&mut system, if long() { 250 } else { 150 }).expect("a stable run");
        let worst = system.momentum_audit().worst;
        assert!(lift(&system) != 0.0, "{scene} {sets:?}: nothing is exchanged");
        assert!(worst < 1e-10, "{scene} {sets:?}: momentum open by {worst:e}");
    }
}
