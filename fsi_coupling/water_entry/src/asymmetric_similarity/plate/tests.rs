//! Conservation, convergence, Wagner's limit.

use super::*;

fn flow(pitch_deg: f64, ratio: f64, step: f64) -> PlateFlow {
    PlateFlow::with_step(pitch_deg.to_radians(), ratio, step).expect("a solution")
}

/// Force and moment from the pressure are those from the momentum, the angular momentum and the energy of the water, and mass is kept. None of
/// this is an equation of the solution, nor is the place of the tip behind the plate, at which the water rests.
#[test]
fn momentum_energy_mass_and_the_second_tip_agree() {
    for (pitch, ratio) in [(5.0, 0.0), (10.0, 0.0), (20.0, 0.5), (45.0, 0.0), (45.0, -0.2), (60.0, 0.0)] {
        let flow = flow(pitch, ratio, USUAL_STEP);
        let Balance { force: [x, y], moment, force_from_energy, flux } = flow.balance;
        let of = [x / flow.force[0], y / flow.force[1], force_from_energy / flow.force[1], moment / flow.moment];
        assert!(of.iter().all(|of| (of - 1.0).abs() < 5e-4), "{pitch}°, {ratio}: {of:.6?}");
        let off = (flow.tip[0] - flow.tip_velocity[0]).hypot(flow.tip[1] - flow.tip_velocity[1]);
        assert!(flux.abs() < 1e-4 && off < 1e-4, "{pitch}°, {ratio}: {flux:e} {off:e}");
    }
}

/// The errors of half the usual step are at least four times as small as those of the usual one.
#[test]
fn it_converges_with_the_number_of_nodes() {
    let [coarse, usual, fine] = [1.0, 0.5, 0.25].map(|step| {
        let flow = flow(10.0, 0.0, step);
        [flow.force[1], flow.moment, flow.face.cp_max, flow.tip[1]]
    });
    for k in 0..4 {
        let [first, second] = [coarse[k] / fine[k] - 1.0, usual[k] / fine[k] - 1.0];
        assert!(second.abs() < 1e-4 && second.abs() < first.abs() / 4.0, "{k}: {first:e} {second:e}");
    }
}

/// Wagner 1932 with a free edge: the wet breadth is 4/(3 tan β) and the force 4π/(9 tan² β), for β → 0. The excess of the force falls with the
/// pitch, like its root.
#[test]
fn a_flat_plate_tends_to_wagners_limit() {
    let excess = [4.0, 8.0, 16.0_f64].map(|pitch| {
        let (flow, tan) = (flow(pitch, 0.0, USUAL_STEP), pitch.to_radians().tan());
        let breadth = flow.face.peak * pitch.to_radians().cos() * tan / (4.0 / 3.0) - 1.0;
        assert!(breadth > 0.0 && breadth < 0.012 * pitch, "{pitch}°: {breadth}");
        flow.force[1] * tan * tan / (4.0 * PI / 9.0) - 1.0
    });
    println!("{excess:.4?}");
    assert!(excess[0] > 0.0 && excess[0] < 0.8 * excess[1] && excess[1] < 0.9 * excess[2], "{excess:?}");
}

#[test]
fn what_has_no_flow_is_refused() {
    let why = |pitch: f64, ratio: f64| PlateFlow::solve(pitch.to_radians(), ratio).expect_err("none").why;
    assert!(why(3.0, 0.0).contains("4 to 60") && why(f64::NAN, 0.0).contains("4 to 60"));
    assert!(why(20.0, -1.0).contains("-0.5 to 2"));
}
