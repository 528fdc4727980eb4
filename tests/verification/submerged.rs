//! Closed bodies under water and afloat: Archimedes' force and added mass, wherever the particles are (THEORY PR19, WC29).

use evidence::systems::{advance, of_text};
use fsi_coupling::Coupled;
use fsi_coupling::bodies::state::Motion;
use fsi_coupling::coupling::force_rules::reaction_and_pressure;

/// Gravity [m/s²].
const G: f64 = 9.81;
/// Diameter of the cylinder [m].
const D: f64 = 0.25;
/// Corners of the cylinder's outline.
const CORNERS: usize = 64;

/// The cylinder's section [m²].
fn area() -> f64 {
    CORNERS as f64 / 8.0 * D * D * (std::f64::consts::TAU / CORNERS as f64).sin()
}

fn cylinder() -> String {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / CORNERS as f64;
        format!("[{:.12}, {:.12}]", 0.5 * D * angle.sin(), -0.5 * D * angle.cos())
    };
    let points: Vec<String> = (0..CORNERS).map(corner).collect();
    format!("shape = \"polygon\"\nsmooth = false\npoints = [{}]", points.join(", "))
}

const SOLVERS: [&str; 2] = ["incompressible", "weakly_compressible"];

/// Water with a body, `width` and `depth` [m].
fn in_water(solver: &str, spacing: f64, [width, depth]: [f64; 2], end: f64, body: &str) -> Coupled {
    let text = format!(
        "name = \"body\"\ndescription = \"a body in water\"\nsource = \"exact\"\nsolver = \"{solver}\"\n\
         [time]\nend = {end}\n[resolution]\nspacing = {spacing}\ngrowth = 1.0\n[tank]\nwidth = {width}\ndepth = {depth}\n\
         [coupling]\nscheme = \"added_mass\"\n[body]\nname = \"body\"\n{body}\n"
    );
    of_text(&text, &[])
}

fn motion(system: &Coupled) -> Motion {
    system.bodies().find_map(|body| body.motion()).expect("a body")
}

/// From the first sample on, at any place between the particles: before PR19 0.87 to 1.04 of it and 5 % sideways, before WC29 0.37 to 0.98.
#[test]
fn a_body_at_rest_under_water_carries_the_weight_of_the_water_that_it_displaces() {
    let tilted = "shape = \"box\"\nbreadth = 0.25\nheight = 0.16\nangle_deg = 20.0".to_string();
    let cases = [
        (cylinder(), area(), 0.6, [0.0, 0.0]),
        (cylinder(), area(), 2.4, [0.0, 0.0]),
        (cylinder(), area(), 1.2, [0.5, 0.5]),
        (cylinder(), area(), 1.2, [0.13, 0.37]),
        (tilted, 0.25 * 0.16, 2.4, [0.2, 0.3]),
    ];
    for (solver, (shape, area, depth, shift)) in
        SOLVERS.iter().flat_map(|solver| cases.iter().map(move |case| (solver, case)))
    {
        let spacing = 0.025;
        let at = [shift[0] * spacing, shift[1] * spacing - depth];
        let mut system = in_water(
            solver,
            spacing,
            [1.0, depth + 0.6],
            0.1,
            &format!("{shape}\nmotion = \"fixed\"\nposition = {at:?}"),
        );
        let weight = 1000.0 * G * area;
        let check = |system: &Coupled| {
            let moment = motion(system).moment / (weight * 0.5 * D);
            assert!(
                moment.abs() < 5e-4,
                "{solver}, {depth} m, {shift:?}: a moment of {moment} times the weight at half of the breadth"
            );
            let [x, y] = motion(system).force.map(|f| f / weight);
            let t = system.fluid.time();
            assert!(
                (y - 1.0).abs() < 0.012 && x.abs() < 0.005,
                "{solver}, {depth} m, {shift:?}, t = {t}: {x} sideways, {y} up"
            );
        };
        check(&system);
        advance(&mut system, 0.1, check).expect("a stable run");
        // the pressure along the outline gives the same (THEORY CO39)
        let index = system.bodies().position(|body| body.motion().is_some()).expect("a body");
        let [coupled, pressed] =
            reaction_and_pressure(&system, index).expect("an outline").map(|force| force[1] / weight);
        assert!((coupled - 1.0).abs() < 0.012 && (pressed - coupled).abs() < 0.01, "{coupled} {pressed}");
    }
}

/// Half as dense as water and twice as dense: (ρ_b − ρ) g/(ρ_b + C ρ), where C = (1 + q)/(1 − q), q = (πR/W)²/3, is the added mass of a
/// cylinder between walls W apart over that of its own water (a row of doublets; Lamb 1932, §68). Before PR19 the light one had a fifth of that speed
/// in incompressible water, before WC29 0.8 of it in weakly compressible water.
#[test]
fn a_cylinder_let_go_under_water_has_the_acceleration_of_its_added_mass() {
    let width = 1.5;
    let q = (std::f64::consts::PI * 0.5 * D / width).powi(2) / 3.0;
    let added = 1000.0 * (1.0 + q) / (1.0 - q);
    for (solver, allowed) in SOLVERS.into_iter().zip([0.07, 0.015]) {
        for (density, depth) in [(500.0, 1.2), (2000.0, 0.6)] {
            let mass = density * area();
            let inertia = mass * D * D / 8.0;
            let body = format!("{}\nmass = {mass}\ninertia = {inertia}\nposition = [0.0, {}]", cylinder(), -depth);
            let mut system = in_water(solver, 0.025, [width, 1.8], 0.25, &body);
            advance(&mut system, 0.25, |_| {}).expect("a stable run");
            let expected = (1000.0 - density) / (added + density) * G * system.fluid.time();
            let [x, y] = motion(&system).velocity;
            println!("{solver}, {density} kg/m3: {y} m/s, {expected} expected");
            assert!(
                (y / expected - 1.0).abs() < allowed && x.abs() < 0.01,
                "{solver}, {density} kg/m3: {x}, {y} m/s, {expected} expected"
            );
        }
    }
}

/// As dense as water: it stays. Before PR19 it moved by spacings.
#[test]
fn a_neutral_cylinder_stays() {
    let mass = 1000.0 * area();
    let inertia = mass * D * D / 8.0;
    let body = format!("{}\nmass = {mass}\ninertia = {inertia}\nposition = [0.004, -0.707]", cylinder());
    for (solver, allowed) in SOLVERS.into_iter().zip([0.05, 0.2]) {
        let mut system = in_water(solver, 0.025, [1.0, 1.4], 2.0, &body);
        let start = motion(&system).position;
        advance(&mut system, 2.0, |_| {}).expect("a stable run");
        let gap = [0, 1].map(|i| (motion(&system).position[i] - start[i]) / 0.025);
        println!("{solver}: moved by {gap:?} spacings");
        assert!(gap.iter().all(|gap| gap.abs() < allowed), "{solver}: moved by {gap:?} spacings");
    }
}

/// A box afloat off the lattice: before PR19 the mean force sideways was 6.6 % of that of still water on a side.
#[test]
fn a_box_afloat_off_the_lattice_is_not_pushed_sideways() {
    let spacing = 0.0125;
    let body = "shape = \"box\"\nbreadth = 0.4\nheight = 0.2\nmass = 40.0\ninertia = 0.667\nposition = [0.003, 0.0]";
    let mut system = in_water("incompressible", spacing, [1.0, 0.4], 1.5, body);
    let (side, mut impulse, mut before) = (0.5 * 1000.0 * G * 0.1_f64.powi(2), 0.0, 0.0);
    advance(&mut system, 1.5, |system| {
        let t = system.fluid.time();
        impulse += (t - before) * motion(system).force[0];
        before = t;
    })
    .expect("a stable run");
    let (mean, now) = (impulse / before / side, motion(&system));
    let drift = (now.position[0] - 0.003) / spacing;
    println!("{mean} of the force on a side, drift {drift} spacings, heel {} deg", now.angle.to_degrees());
    assert!(mean.abs() < 0.005 && drift.abs() < 0.3 && now.angle.to_degrees().abs() < 0.15, "{mean}, {drift}, {now:?}");
}
