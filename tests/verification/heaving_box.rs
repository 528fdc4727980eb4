//! Linear theory of a heaving box (`tests/support/heave.rs`) against what is known of it, the scene's reference against the theory, and
//! the scene's box, coarse, against bounds of its period.

use evidence::heave::HeavingBox;
use evidence::statistics::period;
use evidence::systems::{advance, system};
use scene::reference::Table;

/// The box of the scene `heaving_box`.
fn the_box() -> HeavingBox {
    HeavingBox { density: 1000.0, gravity: 9.81, half_breadth: 0.2, draught: 0.2, depth: 0.6 }
}

/// Damping is the energy of the waves (to rounding), tends to 2ρa²√(g/h) for long ones, and added mass without bound of
/// the frequency to half of a square's in endless water, 4.754 ρa² (Newman 1977): the depth's share falls as 1/h².
#[test]
fn the_theory_has_its_known_limits() {
    let heaving = the_box();
    for omega in [0.5, 2.0, 5.0, 8.0] {
        let found = heaving.radiation(omega);
        let gap = (found.damping - found.radiated).abs();
        assert!(gap < 1e-9 * found.radiated, "{omega}: {} by pressure, {} by waves", found.damping, found.radiated);
    }
    let slow = heaving.radiation(0.01).damping / (2.0 * 1000.0 * 0.04 * (9.81_f64 / 0.6).sqrt());
    assert!((slow - 1.0).abs() < 1e-4, "{slow} of the limit for long waves");
    let deep = |h: f64| {
        let square = HeavingBox { half_breadth: 1.0, draught: 1.0, depth: h, ..the_box() };
        square.added_mass_at_once() / 1000.0
    };
    let endless = (4.0 * deep(10.0) - deep(5.0)) / 3.0;
    assert!((endless / (0.5 * 4.754) - 1.0).abs() < 3e-3, "{endless} of rho a^2, textbook {}", 0.5 * 4.754);
}

/// The reference of the scene is this theory's, and does not depend on its step.
#[test]
fn the_reference_of_the_scene_is_the_theorys() {
    let name = "exact/heaving_box.csv";
    let table = Table::load(name).expect("a built-in table");
    let [t, y] = ["t_s", "y_over_start"].map(|column| table.column(name, column).expect("a column"));
    assert!(t.len() > 100 && t[t.len() - 1] >= 2.3);
    let ours = the_box().release(0.005, 500);
    for (t, y) in t.iter().zip(&y) {
        let theirs = ours[(t / 0.005).round() as usize];
        assert!((y - theirs).abs() < 5e-4, "{t} s: {y} in the table, {theirs} with twice its step");
    }
}

/// The box of the scene, coarse: its period lies between that without any added mass and that with the most it has in waves
/// of that length or shorter, and the waves take more than a quarter of its height in a period.
#[test]
fn a_coarse_box_heaves_with_a_period_between_its_bounds_and_decays() {
    let mut system = system("heaving_box", &["resolution.spacing=0.025"]);
    let mut heave = Vec::new();
    advance(&mut system, 1.7, |s| {
        let motion = s.bodies().find_map(|body| body.motion()).expect("the scene has a body");
        heave.push([s.fluid.time(), motion.position[1]]);
    })
    .expect("a stable run");
    let found = period(&heave);
    let bound = |added: f64| std::f64::consts::TAU * ((80.0 + added) / (1000.0 * 9.81 * 0.4)).sqrt();
    let [least, most] = [bound(0.0), bound(the_box().added_mass_at_once())];
    assert!((least..most).contains(&found), "period {found:.3} s, bounds {least:.3} and {most:.3} s");
    let start = heave[0][1].abs();
    let rebound = heave.iter().filter(|p| p[0] > 0.9).map(|p| p[1].abs()).fold(0.0, f64::max);
    assert!(rebound < 0.75 * start, "after a period {rebound:.4} m of {start:.4} m");
}
