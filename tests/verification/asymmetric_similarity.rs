//! A wedge with two deadrises (THEORY EN31–EN35), one that moves obliquely (EN47) and a flat plate (EN48): the similar flow against that of a symmetric
//! wedge and the water's momentum, boundary elements against the similar flow.

use evidence::long::with_long;
use run::{RunOptions, load_text, run};
use water_entry::{AsymmetricFlow, Balance, EntryModel, FlowEnded, PlateFlow, RolledFlow, RolledLoad, SimilarityFlow};

/// Downward speed [m/s] and first draught [m].
const SPEED: f64 = 2.0;
const START: f64 = 0.1;

fn similar(left_deg: f64, right_deg: f64) -> AsymmetricFlow {
    AsymmetricFlow::solve(left_deg.to_radians(), right_deg.to_radians()).expect("a solution")
}

/// Equal faces: force and largest pressure of Dobrovolskaya's problem, from equations that do not use the symmetry.
#[test]
fn equal_faces_are_those_of_a_symmetric_wedge() {
    for deadrise in [10.0, 15.0, 20.0, 30.0, 40.0, 45.0, 50.0, 60.0] {
        let (own, exact) = (similar(deadrise, deadrise), SimilarityFlow::solve(deadrise).expect("a solution"));
        let force = own.force[1] / exact.force_coefficient - 1.0;
        let cp_max = own.left.cp_max / exact.cp_max - 1.0;
        assert!(force.abs() < 0.003 && cp_max.abs() < 0.003, "{deadrise}°: force {force:+.5}, pressure {cp_max:+.5}");
    }
}

/// Wedges of 20 to 50 degrees rolled by up to 20 degrees: the force and the moment of the pressure are those that the water's momentum
/// gains, and the work is its energy.
#[test]
fn force_and_moment_are_the_waters_momentum() {
    for deadrise in [20.0, 30.0, 40.0, 50.0] {
        for roll in with_long(&[1.0, 12.0, 20.0_f64], &[5.0]).into_iter().filter(|roll| deadrise - roll >= 8.0) {
            let flow = similar(deadrise - roll, deadrise + roll);
            let Balance { force: [x, y], moment, force_from_energy, flux } = flow.balance;
            let of = [x / flow.force[0], y / flow.force[1], moment / flow.moment, force_from_energy / flow.force[1]];
            assert!(of.iter().all(|of| (of - 1.0).abs() < 0.001), "{deadrise}°, roll {roll}°: {of:.5?}");
            assert!(flux.abs() < 1e-4, "{deadrise}°, roll {roll}°: {flux:e} of the flux is lost");
        }
    }
}

/// Force sideways and moment over a small roll tend to a limit, the same from both sides.
#[test]
fn a_small_roll_changes_the_load_in_proportion() {
    for deadrise in [20.0, 45.0] {
        let at = |roll: f64| {
            let flow = similar(deadrise - roll, deadrise + roll);
            [flow.force[0] / roll, flow.moment / roll]
        };
        let (small, twice, back) = (at(0.25), at(0.5), at(-0.25));
        for k in 0..2 {
            assert!((twice[k] / small[k] - 1.0).abs() < 0.005, "{deadrise}°: {small:?}, {twice:?}");
            assert!((back[k] / small[k] - 1.0).abs() < 1e-5, "{deadrise}°: {small:?}, {back:?}");
        }
    }
}

/// Boundary elements at constant speed: force and moment within 2 % of the similar flow, at every step past the first few.
#[test]
fn boundary_elements_keep_the_similar_flow() {
    let rolled_by_ten = [[10.0, 30.0], [20.0, 40.0], [35.0, 55.0]];
    let others = with_long(&[[41.3, 27.6]], &[[24.0, 51.0], [33.7, 18.2]]);
    for [left, right] in rolled_by_ten.into_iter().chain(others) {
        let exact = similar(left, right);
        let mut flow =
            RolledFlow::new([left.to_radians(), right.to_radians()], [100.0; 2], START, SPEED, 0.0).expect("in range");
        let (mut worst, mut steps) = ([0.0_f64; 3], 0);
        while flow.draught() < 1.25 * START && steps < 400 {
            let h = flow.draught();
            let RolledLoad { force, moment, .. } = flow.step(|_| 0.0).expect("a step").1;
            let [x, y] = force.map(|f| f / (SPEED * SPEED * h));
            let resultant = (x - exact.force[0]).hypot(y - exact.force[1]) / exact.force[0].hypot(exact.force[1]);
            let errors = [
                resultant,
                (moment / (SPEED * SPEED * h * h) / exact.moment - 1.0).abs(),
                (x / exact.force[0] - 1.0).abs(),
            ];
            steps += 1;
            if steps > 8 {
                worst = std::array::from_fn(|k| worst[k].max(errors[k]));
            }
        }
        println!("{left}°, {right}°: resultant, moment, F_x within {worst:.4?} in {steps} steps");
        assert!(worst.iter().all(|e| *e < 0.02), "{left}°, {right}°: {worst:.4?}");
    }
}

/// Wedges that move obliquely: the force and the moment of the pressure are those that the water's momentum gains, and the work is its energy.
/// Boundary elements agree to 1.5 % of the resultant.
#[test]
fn an_oblique_entry_keeps_momentum_and_agrees_with_boundary_elements() {
    let cases = [([30.0, 30.0], 0.25), ([30.0, 30.0], 0.5), ([20.0, 40.0], 0.25)];
    let others = with_long(&[([20.0, 40.0], -0.5)], &[([45.0, 45.0], 0.5), ([15.0, 15.0], 1.0), ([35.0, 25.0], -0.7)]);
    for ([left, right], ratio) in cases.into_iter().chain(others) {
        let deadrises = [left, right].map(f64::to_radians);
        let exact = AsymmetricFlow::oblique(deadrises[0], deadrises[1], ratio).expect("a solution");
        let Balance { force: [x, y], moment, force_from_energy, flux } = exact.balance;
        let of = [x / exact.force[0], y / exact.force[1], moment / exact.moment, force_from_energy / exact.force[1]];
        assert!(of.iter().all(|of| (of - 1.0).abs() < 0.001), "{left}°, {right}°, {ratio}: {of:.5?}");
        assert!(flux.abs() < 1e-4, "{left}°, {right}°, {ratio}: {flux:e} of the flux is lost");
        let velocity = [ratio * SPEED, SPEED];
        let mut flow = RolledFlow::oblique(deadrises, [100.0; 2], START, velocity, 0.0).expect("in range");
        let resultant = exact.force[0].hypot(exact.force[1]);
        while flow.draught() < 1.15 * START {
            let h = flow.draught();
            let RolledLoad { force, moment, .. } = flow.step(|_| 0.0).expect("a step").1;
            let [x, y] = [0, 1].map(|i| (force[i] / (SPEED * SPEED * h) - exact.force[i]) / resultant);
            let moment = moment / (SPEED * SPEED * h * h) / exact.moment - 1.0;
            assert!(x.hypot(y) < 0.015 && moment.abs() < 0.015, "{left}°, {right}°, {ratio}: {x} {y} {moment}");
        }
    }
}

/// U/V = 0 is the vertical entry: the numbers that were stored before there was a speed sideways.
#[test]
fn without_a_speed_sideways_it_is_the_vertical_entry() {
    let flow = similar(20.0, 40.0);
    let [x, y, moment] = [flow.force[0] - 2.41992, flow.force[1] - 19.34739, flow.moment + 35.9391];
    assert!(x.abs() < 1e-5 && y.abs() < 1e-4 && moment.abs() < 1e-4, "{:?} {}", flow.force, flow.moment);
}

/// Where the flow follows both faces of an upright wedge: the ratio U/V at which the force on the face behind the apex vanishes falls with the
/// deadrise.
#[test]
fn a_fast_wedge_is_refused_where_suction_exceeds_pressure() {
    for (deadrise, follows, leaves) in [(20.0, 1.9, f64::NAN), (30.0, 1.5, 1.65), (37.0, 1.1, 1.25), (45.0, 0.8, 1.0)] {
        let at = |ratio: f64| AsymmetricFlow::oblique(f64::to_radians(deadrise), f64::to_radians(deadrise), ratio);
        let behind = at(follows).expect("a flow").left.force_coefficient;
        assert!(behind > 0.0, "{deadrise}°: {behind}");
        assert!(leaves.is_nan() || at(leaves).is_err_and(|none| none.why.contains("leaves the apex")), "{deadrise}°");
    }
}

/// A flat plate whose lower edge the water leaves: momentum, energy, mass, and the place of the tip behind it.
#[test]
fn a_flat_plate_keeps_momentum_energy_and_mass() {
    for (pitch, ratio) in with_long(&[(5.0, 0.0), (10.0, 0.0)], &[(30.0, 0.0), (10.0, 1.0), (45.0, -0.3_f64)]) {
        let flow = PlateFlow::solve(f64::to_radians(pitch), ratio).expect("a solution");
        let Balance { force: [x, y], moment, force_from_energy, flux } = flow.balance;
        let of = [x / flow.force[0], y / flow.force[1], moment / flow.moment, force_from_energy / flow.force[1]];
        assert!(of.iter().all(|of| (of - 1.0).abs() < 5e-4), "{pitch}°, {ratio}: {of:.6?}");
        let off = (flow.tip[0] - flow.tip_velocity[0]).hypot(flow.tip[1] - flow.tip_velocity[1]);
        assert!(flux.abs() < 1e-4 && off < 2e-4, "{pitch}°, {ratio}: {flux:e} {off:e}");
    }
}

/// A wedge that is stopped ends the flow with place and speed.
#[test]
fn a_rolled_wedge_that_stops_ends_with_a_reason() {
    let deadrises = [25.0, 40.0].map(f64::to_radians);
    let mut flow = RolledFlow::new(deadrises, [1.0; 2], START, SPEED, 9.81).expect("in range");
    let FlowEnded { draught, speed } = (0..1000).find_map(|_| flow.step(|_| -1000.0).err()).expect("an end");
    assert!(speed <= 0.0 && draught == flow.draught(), "{draught} m, {speed} m/s");
}

/// A wedge of 30 degrees that is rolled by 10, in a scene file.
const ROLLED: &str = r#"
name = "rolled"
model = "boundary_element"
gravity = [0.0, 0.0]
[time]
end = 0.25
[tank]
width = 40.0
depth = 20.0
[resolution]
spacing = 0.1
[body]
name = "wedge"
shape = "wedge"
deadrise_deg = 30.0
breadth = 8.0
side_height = 2.0
angle_deg = 10.0
motion = "constant_velocity"
velocity = [0.0, -2.0]
"#;

/// A scene with a rolled wedge has the force and the moment of the similar flow; one that may turn is refused.
#[test]
fn a_scene_with_a_rolled_wedge_has_the_similar_load() {
    let scene = load_text("rolled.toml", ROLLED, &[]).expect("a scene").scene;
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    let exact = similar(20.0, 40.0);
    let (rho, h) = (scene.water().density, SPEED * 0.25);
    let expected = [
        ("wedge.fx_N_per_m", rho * SPEED.powi(2) * h * exact.force[0]),
        ("wedge.fy_N_per_m", rho * SPEED.powi(2) * h * exact.force[1]),
        ("wedge.moment_N", rho * (SPEED * h).powi(2) * exact.moment),
    ];
    for (name, value) in expected {
        let peak = outcome.summary.peaks.get(name).expect("a column").value;
        assert!((peak.abs() / value.abs() - 1.0).abs() < 0.02, "{name}: {peak}, exactly {value}");
    }
    let auto =
        load_text("rolled.toml", &ROLLED.replace("\"boundary_element\"", "\"auto\""), &[]).expect("a scene").scene;
    assert_eq!(auto.model, EntryModel::BoundaryElement, "{:?}", auto.model);
    // its error bar is the measured error of the vertical force; the largest force of the results is the whole one
    let [x, y] = [0, 1].map(|k| rho * SPEED.powi(2) * h * exact.force[k]);
    let largest = outcome.summary.results.get(scene::vocabulary::ResultName::PeakForce).expect("a force");
    assert!((largest.value / x.hypot(y) - 1.0).abs() < 0.02, "{largest:?}, exactly {x} and {y}");
    assert!(largest.band.is_some_and(|band| band < 0.03 * largest.value), "{largest:?}");
    let free = ROLLED.replace("motion = \"constant_velocity\"", "motion = \"free\"\nmass = 2000.0\ninertia = 500.0");
    let refused = load_text("rolled.toml", &free, &[]).expect_err("refused").to_string();
    assert!(refused.contains("may turn or move sideways"), "{refused}");
}

/// The same of an upright wedge that moves obliquely: a scene has the similar load by boundary elements, and moves sideways.
#[test]
fn a_scene_with_a_wedge_that_moves_obliquely_has_the_similar_load() {
    let text = ROLLED.replace("angle_deg = 10.0\n", "").replace("[0.0, -2.0]", "[1.0, -2.0]");
    let scene = load_text("oblique.toml", &text, &[]).expect("a scene").scene;
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    let exact = AsymmetricFlow::oblique(f64::to_radians(30.0), f64::to_radians(30.0), 0.5).expect("a solution");
    let (rho, h) = (scene.water().density, SPEED * 0.25);
    let expected = [
        ("wedge.fx_N_per_m", rho * SPEED.powi(2) * h * exact.force[0]),
        ("wedge.fy_N_per_m", rho * SPEED.powi(2) * h * exact.force[1]),
        ("wedge.moment_N", rho * (SPEED * h).powi(2) * exact.moment),
        ("wedge.x_m", 0.25),
    ];
    for (name, value) in expected {
        let last = *outcome.series.column(name).expect("a column").last().expect("a row");
        assert!((last / value - 1.0).abs() < 0.02, "{name}: {last}, exactly {value}");
    }
    let free =
        text.replace("motion = \"constant_velocity\"", "motion = \"free\"\nmass = 2000.0\nfree = [\"x\", \"y\"]");
    let refused = load_text("oblique.toml", &free, &[]).expect_err("refused").to_string();
    assert!(refused.contains("moves sideways"), "{refused}");
}
