//! A wedge that stands in still water starts to move: the added mass at the surface (exact), on the way out and in.

use run::{RunOptions, load_text, run};

use std::f64::consts::{FRAC_PI_2, PI};

/// Constant acceleration [m/s²], draught [m], and the time over which the force is integrated [s].
const ACCELERATION: f64 = 5.0;
const DRAUGHT: f64 = 1.0;
const TIME: f64 = 0.04;
/// Sound of the weakly compressible runs.
const SOUND: &str = "[fluid]\nsound_speed = 400.0";

/// Added mass of a wedge in the surface, p = 0 there: half of that of the rhombus that it makes with its image [kg/m]. The circle of the radius r
/// goes to the rhombus by dz/dw = (1 − r²/w²)^p (1 + r²/w²)^q, p = 1 − 2β/π, q = 2β/π, and its added mass is ρ(4πp r² − A).
fn added_mass(deadrise: f64) -> f64 {
    let q = 2.0 * deadrise / PI;
    let p = 1.0 - q;
    // side over radius: 2 ∫ sin^p cos^q, by θ = (π/2) x²(3 − 2x)
    let n = 4000;
    let at = |k: usize| {
        let x = (k as f64 + 0.5) / n as f64;
        let theta = FRAC_PI_2 * x * x * (3.0 - 2.0 * x);
        theta.sin().powf(p) * theta.cos().powf(q) * FRAC_PI_2 * 6.0 * x * (1.0 - x) / n as f64
    };
    let radius = DRAUGHT / deadrise.sin() / (2.0 * (0..n).map(at).sum::<f64>());
    0.5 * 1000.0 * (4.0 * PI * p * radius * radius - 2.0 * DRAUGHT * DRAUGHT / deadrise.tan())
}

/// The square has r = Γ(1/4)² s/(4π^(3/2)) and 2πr² − s²; half a flat rhombus has that of half a plate, ½ρπb².
#[test]
fn the_added_mass_of_a_rhombus_has_its_limits() {
    const GAMMA: f64 = 3.625_609_908_221_908;
    let side = 2.0_f64.sqrt() * DRAUGHT;
    let radius = GAMMA.powi(2) * side / (4.0 * PI.powf(1.5));
    let square = 0.5 * 1000.0 * (2.0 * PI * radius.powi(2) - side.powi(2));
    assert!((added_mass(PI / 4.0) / square - 1.0).abs() < 1e-6, "{} {square}", added_mass(PI / 4.0));
    let flat: f64 = 0.002;
    let plate = 0.5 * 1000.0 * PI * (DRAUGHT / flat.tan()).powi(2);
    assert!((added_mass(flat) / plate - 1.0).abs() < 0.01, "{} {plate}", added_mass(flat));
}

/// Added mass of a run over the exact one: buoyancy less the force, over the speed reached. `direction`: 1 up, −1 down.
fn ratio(deadrise_deg: f64, direction: f64, solver: &str, spacings: f64) -> f64 {
    let deadrise = deadrise_deg.to_radians();
    let half = DRAUGHT / deadrise.tan();
    let rows: Vec<String> = (0..=20)
        .map(|k| {
            let t = 0.05 * f64::from(k) * TIME;
            format!("[{t}, 0.0, {}, 0.0]", 0.5 * direction * ACCELERATION * t * t)
        })
        .collect();
    let text = format!(
        "name = \"start\"\nsymmetry = \"x\"\n{solver}\n[time]\nend = {TIME}\n[resolution]\nspacing = {}\n[tank]\nwidth = {}\ndepth = {}\n\
         [body]\nname = \"wedge\"\nshape = \"wedge\"\ndeadrise_deg = {deadrise_deg}\nbreadth = {}\nside_height = 0.5\nposition = [0.0, -{DRAUGHT}]\n\
         motion = \"tabulated\"\ndisplacements = [{}]\n",
        DRAUGHT / spacings,
        12.0 * half,
        6.0 * half.max(DRAUGHT),
        3.0 * half,
        rows.join(", ")
    );
    let scene = load_text("start.toml", &text, &[]).expect("a scene").scene;
    let series = run(&scene, &RunOptions::default()).expect("a run").series;
    let (times, force) = (series.times(), series.column("wedge.fy_N_per_m").expect("a force"));
    let height = series.column("wedge.y_m").expect("a height");
    let missing = |k: usize| 9810.0 * height[k] * height[k] / deadrise.tan() - force[k]; // the area is D²/tan β
    let integral: f64 = (1..times.len()).map(|k| 0.5 * (times[k] - times[k - 1]) * (missing(k) + missing(k - 1))).sum();
    integral / (direction * ACCELERATION * times[times.len() - 1]) / added_mass(deadrise)
}

/// The mean of the ways out and in: an error of the buoyancy at rest falls out, up to 4.5 % of the added mass in incompressible water.
fn mean_ratio(deadrise_deg: f64, solver: &str, spacings: f64) -> f64 {
    let [out, into] = [1.0, -1.0].map(|direction| ratio(deadrise_deg, direction, solver, spacings));
    println!("{deadrise_deg}°, {spacings} spacings: out {out:.4}, in {into:.4}");
    0.5 * (out + into)
}

/// The projection, at 16 spacings.
#[test]
fn incompressible_water_resists_the_start_with_its_added_mass() {
    for deadrise in [45.0, 30.0, 60.0] {
        let found = mean_ratio(deadrise, "solver = \"incompressible\"", 16.0);
        assert!((found - 1.0).abs() < 0.03, "{deadrise}°: {found}");
    }
}

/// Each way at 45°.
#[test]
fn incompressible_water_resists_a_start_out_and_in() {
    for direction in [1.0, -1.0] {
        let found = ratio(45.0, direction, "solver = \"incompressible\"", 16.0);
        assert!((found - 1.0).abs() < 0.03, "{direction}: {found}");
    }
}

/// Weakly compressible water has no pressure a spacing above its surface, so that its added mass is that of a body a spacing deeper: the error
/// is of first order.
#[test]
fn weakly_compressible_water_has_the_added_mass_of_a_body_a_spacing_deeper() {
    let [coarse, fine] = [16.0, 32.0].map(|spacings| ratio(45.0, 1.0, SOUND, spacings) - 1.0);
    println!("{coarse:+.3} {fine:+.3}");
    assert!(coarse > 0.0 && coarse < 0.16 && fine < 0.65 * coarse, "{coarse}, {fine}");
}

/// The same for flatter and steeper wedges, in the mean of both ways, each of which is up to 18 % off that: the buoyancy at rest, 0.9 and 3.1
/// times the force of the added mass, swings.
#[test]
fn the_error_of_the_added_mass_falls_with_the_spacing() {
    for deadrise in [30.0, 60.0] {
        let [coarse, fine] = [16.0, 32.0].map(|spacings| mean_ratio(deadrise, SOUND, spacings) - 1.0);
        assert!(coarse > 0.0 && coarse < 0.2 && fine > 0.0 && fine < 0.75 * coarse, "{deadrise}°: {coarse}, {fine}");
    }
}
