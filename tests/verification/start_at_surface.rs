//! A wedge that stands in still water starts to move: the added mass at the surface (exact), on the way out and in.

use run::{RunOptions, load_text, run};

/// Constant acceleration [m/s²], draught [m], and the time over which the force is integrated [s].
const ACCELERATION: f64 = 5.0;
const DRAUGHT: f64 = 1.0;
const TIME: f64 = 0.04;
/// Γ(1/4).
const GAMMA: f64 = 3.625_609_908_221_908;

/// Added mass of a wedge of 45° in the surface, p = 0 there: half of that of the square that it makes with its image [kg/m]. The square of the
/// side s has the conformal radius r = Γ(1/4)² s/(4π^(3/2)) and the added mass ρ(2πr² − s²) in each direction.
fn added_mass() -> f64 {
    let side = 2.0_f64.sqrt() * DRAUGHT;
    let radius = GAMMA.powi(2) * side / (4.0 * std::f64::consts::PI.powf(1.5));
    0.5 * 1000.0 * (2.0 * std::f64::consts::PI * radius.powi(2) - side.powi(2))
}

/// Added mass of a run over the exact one: buoyancy less the force, over the speed reached. `direction`: 1 up, −1 down.
fn ratio(direction: f64, solver: &str, spacings: f64) -> f64 {
    let rows: Vec<String> = (0..=20)
        .map(|k| {
            let t = 0.05 * f64::from(k) * TIME;
            format!("[{t}, 0.0, {}, 0.0]", 0.5 * direction * ACCELERATION * t * t)
        })
        .collect();
    let text = format!(
        "name = \"start\"\nsymmetry = \"x\"\n{solver}\n[time]\nend = {TIME}\n[resolution]\nspacing = {}\n[tank]\nwidth = 12.0\ndepth = 6.0\n\
         [body]\nname = \"wedge\"\nshape = \"wedge\"\ndeadrise_deg = 45.0\nbreadth = 3.0\nside_height = 0.5\nposition = [0.0, -{DRAUGHT}]\n\
         motion = \"tabulated\"\ndisplacements = [{}]\n",
        DRAUGHT / spacings,
        rows.join(", ")
    );
    let scene = load_text("start.toml", &text, &[]).expect("a scene").scene;
    let series = run(&scene, &RunOptions::default()).expect("a run").series;
    let (times, force) = (series.times(), series.column("wedge.fy_N_per_m").expect("a force"));
    let height = series.column("wedge.y_m").expect("a height");
    let missing = |k: usize| 9810.0 * height[k] * height[k] - force[k]; // b = 2 D, so that the area is D²
    let integral: f64 = (1..times.len()).map(|k| 0.5 * (times[k] - times[k - 1]) * (missing(k) + missing(k - 1))).sum();
    integral / (direction * ACCELERATION * times[times.len() - 1]) / added_mass()
}

/// The projection, at 16 spacings.
#[test]
fn incompressible_water_resists_the_start_with_its_added_mass() {
    for direction in [1.0, -1.0] {
        let found = ratio(direction, "solver = \"incompressible\"", 16.0);
        assert!((found - 1.0).abs() < 0.03, "{direction}: {found}");
    }
}

/// Weakly compressible water has no pressure a spacing above its surface, so that its added mass is that of a body a spacing deeper: the error
/// is of first order.
#[test]
fn weakly_compressible_water_has_the_added_mass_of_a_body_a_spacing_deeper() {
    let sound = "[fluid]\nsound_speed = 400.0";
    let [coarse, fine] = [16.0, 32.0].map(|spacings| ratio(1.0, sound, spacings) - 1.0);
    println!("{coarse:+.3} {fine:+.3}");
    assert!(coarse > 0.0 && coarse < 0.16 && fine < 0.65 * coarse, "{coarse}, {fine}");
}
