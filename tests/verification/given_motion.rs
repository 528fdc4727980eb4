//! A motion that is given: the water's load is that of the same motion under the load (THEORY EN22, EN53).

use run::{RunOptions, load, run};
use water_entry::{Entry, EntryModel, FlowEntry, GivenMotion, Instant, Loads, Section, SectionMotion};

/// Speed at t = 0 [m/s].
const SPEED: f64 = 4.0;

/// The way of a section that was followed: cubic between its moments.
fn way_of(moments: &[Instant]) -> GivenMotion {
    let moments = moments.to_vec();
    let end = moments[moments.len() - 1].time;
    GivenMotion::new(end, move |time| {
        let after = moments.partition_point(|now| now.time <= time).clamp(1, moments.len() - 1);
        let [a, b] = [&moments[after - 1], &moments[after]];
        let now = Instant::between(a, b, (time - a.time) / (b.time - a.time), time);
        [now.draught, now.speed, now.rate]
    })
}

fn impulse(moments: &[Instant]) -> f64 {
    moments.windows(2).map(|pair| 0.5 * (pair[0].force + pair[1].force) * (pair[1].time - pair[0].time)).sum()
}

fn peak(moments: &[Instant]) -> f64 {
    moments.iter().map(|now| now.force).fold(0.0, f64::max)
}

/// A free drop from above the water, and the same way again by a given motion: peaks within 0.2 %, impulses within 0.1 %.
#[test]
fn the_flow_about_a_given_way_is_that_of_the_free_drop() {
    let wedge = |deadrise_deg: f64| Section::wedge(deadrise_deg, 1.0).expect("a wedge");
    let sections = [(wedge(30.0), 241.0), (wedge(15.0), 100.0), (Section::arc(0.6, 1.0).expect("an arc"), 200.0)];
    for (section, mass) in &sections {
        let motion = SectionMotion::Free(*mass);
        let free = FlowEntry { section, motion, draught: -0.05, speed: SPEED, gravity: 9.81, density: 1000.0 };
        let times: Vec<f64> = (0..=400).map(|k| 2e-4 * f64::from(k)).collect();
        let (own, _, ended) = free.solve(&times).expect("in range");
        assert!(ended.is_none(), "{ended:?}");
        let given = FlowEntry { motion: SectionMotion::Given(way_of(&own)), ..free };
        let (found, _, ended) = given.solve(&times).expect("in range");
        assert!(ended.is_none(), "{ended:?}");
        let [force, whole] = [peak(&found) / peak(&own) - 1.0, impulse(&found) / impulse(&own) - 1.0];
        println!("mass {mass}: peak {:+.3} %, impulse {:+.3} %", 100.0 * force, 100.0 * whole);
        assert!(force.abs() < 2e-3 && whole.abs() < 1e-3, "mass {mass}: {force}, {whole}");
    }
}

/// The same by a formula, whose load is a function of draught, speed and acceleration.
#[test]
fn the_load_of_a_formula_follows_a_given_way() {
    let section = Section::wedge(20.0, 1.0).expect("a wedge");
    let loads = Loads::new(EntryModel::Mlm, &section).expect("in range");
    let motion = SectionMotion::Free(150.0);
    let (draught, speed, gravity, density) = (-0.02, SPEED, 9.81, 1000.0);
    let free = Entry { loads: &loads, motion, draught, speed, gravity, density, buoyancy: true, steep: false };
    let times: Vec<f64> = (0..=200).map(|k| 1e-4 * f64::from(k)).collect();
    let own = free.solve(&times).expect("in range");
    let given = Entry { motion: SectionMotion::Given(way_of(&own)), ..free };
    for (found, own) in given.solve(&times).expect("in range").iter().zip(&own) {
        assert!(
            (found.force - own.force).abs() < 1e-9 * peak(std::slice::from_ref(own)).max(1.0),
            "{found:?}, {own:?}"
        );
    }
}

/// A wedge with panels under an acceleration that is given by a table: the largest stress is that of finer rows within 0.5 %, and at a constant
/// speed that of `constant_velocity`.
#[test]
fn panels_of_a_body_that_follows_a_table() {
    let stress = |sets: &[String]| {
        let mut all = vec![
            "model=boundary_element".to_string(),
            "body.motion=tabulated".into(),
            "body.velocity=[0.0, 0.0]".into(),
        ];
        all.extend_from_slice(sets);
        let scene = load("elastic_wedge", if sets.is_empty() { &all[..1] } else { &all }).expect("a scene").scene;
        let done = run(&scene, &RunOptions::default()).expect("a run");
        done.summary.panels["plate"].stress_pa.most
    };
    let table = |rows: u32, at: &dyn Fn(f64) -> [f64; 2]| {
        let times = || (0..=rows).map(|k| 2.5e-3 * f64::from(k) / f64::from(rows));
        let places: Vec<String> = times().map(|t| format!("[{t:?}, 0.0, {:?}, 0.0]", at(t)[0])).collect();
        let rates: Vec<String> = times().map(|t| format!("[0.0, {:?}, 0.0]", at(t)[1])).collect();
        ["displacements", "displacement_rates"]
            .iter()
            .zip([places, rates])
            .map(|(key, rows)| format!("body.{key}=[{}]", rows.join(", ")))
            .collect::<Vec<_>>()
    };
    let steady = stress(&table(4, &|t| [-30.0 * t, -30.0]));
    let own = stress(&[]);
    assert!((steady / own - 1.0).abs() < 1e-6, "{steady} Pa, {own} Pa");
    // from 30 to 20 m/s
    let slows = |t: f64| [-30.0 * t + 2e3 * t * t, -30.0 + 4e3 * t];
    let [coarse, fine] = [5, 50].map(|rows| stress(&table(rows, &slows)));
    println!("from 30 to 20 m/s: {coarse:.4e} Pa of 5 rows, {fine:.4e} of 50; at 30 m/s {own:.4e}");
    assert!((coarse / fine - 1.0).abs() < 5e-3, "{coarse} Pa, {fine} Pa");
    assert!(fine < 0.9 * own, "{fine} Pa at a falling speed, {own} at a constant one");
}
