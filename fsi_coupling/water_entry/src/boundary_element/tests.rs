//! Work and energy, and the keel of a round bottom.

use super::*;

/// Between two placements of the nodes the boundary moves with the water: what the body does as work is energy of the water, with dry and
/// with wet chines, past knuckles, and before and after the flow leaves a round bottom.
#[test]
fn the_bodys_work_is_energy_of_the_water() {
    let wedge = |deadrise: f64| Section::wedge(deadrise, 1.0).expect("a section");
    let round = |breadth: f64| Section::arc(0.5, breadth).expect("a section");
    let bent = |corners: [[f64; 2]; 3]| Section::new(&corners).expect("a section");
    let ellipse = |height: f64| {
        let at = |k: u32| std::f64::consts::TAU * f64::from(k) / 40.0;
        let points: Vec<[f64; 2]> = (0..40).map(at).map(|t| [0.5 * t.sin(), -height * t.cos()]).collect();
        Section::of_polygon(&points).expect("a section")
    };
    // wedges, gravity and the deepest draught; those of 30° and 47° in the long variant, with `LONG=1`
    let mut cases = vec![
        (bent([[0.0, 0.0], [0.25, 0.091], [0.5, 0.266]]), 0.0, 0.4), // 20°, then 35°
        (bent([[0.0, 0.0], [0.3, 0.14], [0.5, 0.194]]), 9.81, 0.3),  // 25°, then 15°
        (bent([[0.0, 0.0], [0.2, 0.073], [0.5, 0.373]]), 2.0, 0.5),  // 20°, then 45°
        (wedge(22.0), 9.81, 0.45),
        (wedge(58.0), 2.0, 0.6),
        (round(1.0), 0.0, 0.4),
        (round(0.7), 9.81, 0.4),
        (ellipse(0.35), 0.0, 0.3),
        (ellipse(0.8), 9.81, 0.4),
    ];
    if std::env::var("LONG").is_ok_and(|value| value == "1") {
        cases.extend([(wedge(22.0), 9.81, 0.6), (wedge(30.0), 0.0, 0.6), (wedge(47.0), 9.81, 0.6)]);
    }
    for (section, gravity, deepest) in cases {
        let mut flow = EntryFlow::new(&section, 0.05, 2.0, gravity).expect("in range");
        let (mut dry, mut wet) = ([0.0; 2], [0.0; 2]);
        while flow.draught() < deepest {
            let mut before = flow.solve();
            if flow.separate(&before, 0.0) {
                before = flow.solve();
            }
            let dt = flow.stable_dt(&before.sides[0]);
            let middle = flow.moved(2.0, &before.sides[0], 0.0, 0.5 * dt).solve();
            let end = flow.moved(2.0, &middle.sides[0], 0.0, dt);
            let sums = if flow.chines_wet() { &mut wet } else { &mut dry };
            let keel = flow.keel_speed();
            let force = middle.load.force * keel / 2.0 + middle.load.added_mass * (end.keel_speed() - keel) / dt;
            sums[0] += force * keel * dt;
            sums[1] += end.solve().sides[0].energy(gravity) - before.sides[0].energy(gravity);
            flow = end.attached().redistributed();
        }
        let while_dry = if section.curve().is_some() { 0.015 } else { 0.013 };
        for (chines, [work, energy], within) in [("dry", dry, while_dry), ("wet", wet, 0.016)] {
            let error = energy / work - 1.0;
            let of = section.deadrise_deg().map_or("round or bent".into(), |deadrise| format!("{deadrise:.0}°"));
            println!("{of}, {chines} chines: energy {:+.2} % off", 100.0 * error);
            assert!(error.abs() < within, "{of}, {chines} chines: energy {:+.2} % off", 100.0 * error);
        }
    }
}

/// The keel that is added to a round bottom is forgotten at twice its half width.
#[test]
fn the_flow_about_a_round_bottom_does_not_depend_on_its_keel() {
    let section = Section::arc(1.0, 1.9).expect("a section");
    let loads = |keel: f64| {
        let mut flow = EntryFlow::first(&section, 0.1, 1.0, AddedKeel { deg: keel, first: 0.8 }).expect("a flow");
        let mut loads = Vec::new();
        while flow.draught() < 0.1 {
            let draught = flow.draught();
            let (_, load) = flow.step(|_| 0.0).expect("a step");
            loads.push([draught, load.force, load.added_mass]);
        }
        loads
    };
    let (flat, steep) = (loads(12.5), loads(15.0));
    for [draught, force, mass] in steep.into_iter().filter(|load| load[0] > 0.04) {
        let Some([a, b]) = flat.windows(2).map(|w| [w[0], w[1]]).find(|[_, b]| b[0] > draught) else { break };
        let share = (draught - a[0]) / (b[0] - a[0]);
        let other = |k: usize| a[k] + share * (b[k] - a[k]);
        let [of_force, of_mass] = [force / other(1) - 1.0, mass / other(2) - 1.0];
        assert!(of_force.abs() < 0.008 && of_mass.abs() < 0.03, "{draught} m: {of_force:+.4}, {of_mass:+.4}");
    }
}
