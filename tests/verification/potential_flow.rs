//! Fully nonlinear potential flow by boundary elements (THEORY EN20–EN24, EN30) against the similarity solution and others' boundary elements.

use evidence::systems::scene;
use run::model_hierarchy::{Theory, measured};
use run::{RunOptions, load_text, run};
use scene::QuantityOfInterest;
use water_entry::{EntryFlow, EntryModel, FlowEntry, FlowLoad, Loads, Section, SectionMotion, SimilarityFlow};

/// Draught at the start [m] and downward speed [m/s].
const START: f64 = 0.1;
const SPEED: f64 = 2.0;

/// A wedge whose chines stay dry.
fn wedge(deadrise_deg: f64) -> Section {
    Section::wedge(deadrise_deg, 100.0).expect("a section")
}

/// At constant speed without gravity force and largest pressure stay those of the exact solution, at deadrises that are no round numbers too.
#[test]
fn a_wedge_at_constant_speed_has_the_similar_flow() {
    for deadrise in [13.0, 22.0, 30.0, 37.0, 38.0, 43.5, 52.0, 58.0, 60.0] {
        let exact = SimilarityFlow::solve(deadrise).expect("a solution");
        let mut flow = EntryFlow::new(&wedge(deadrise), START, SPEED, 0.0).expect("in range");
        let mut samples = Vec::new();
        while flow.draught() < 3.0 * START {
            let draught = flow.draught();
            let (_, load) = flow.step(|_| 0.0).expect("a step");
            if draught > 1.1 * START {
                let highest = load.pressure.iter().map(|p| p[1]).fold(0.0, f64::max);
                samples.push([load.force / (SPEED * SPEED * draught), 2.0 * highest / (SPEED * SPEED)]);
            }
        }
        let mean = |of: usize| samples.iter().map(|s| s[of]).sum::<f64>() / samples.len() as f64;
        let last = samples[samples.len() - 1][1] / exact.cp_max - 1.0;
        assert!(last.abs() < 0.01, "{deadrise}°: largest pressure at the end {:+.2} %", 100.0 * last);
        let [force, cp_max] = [mean(0) / exact.force_coefficient - 1.0, mean(1) / exact.cp_max - 1.0];
        assert!(force.abs() < 0.005, "{deadrise}°: force {:+.2} %", 100.0 * force);
        assert!(cp_max.abs() < 0.01, "{deadrise}°: largest pressure {:+.2} %", 100.0 * cp_max);
        let scatter = samples.iter().map(|s| (s[0] / mean(0) - 1.0).powi(2)).sum::<f64>() / samples.len() as f64;
        assert!(scatter.sqrt() < 0.003, "{deadrise}°: scatter of the force {:.2} %", 100.0 * scatter.sqrt());
    }
}

/// A falling wedge of 25°, 78.3 kg/m and 5.05 m/s slows down as in the boundary elements of Zhao & Faltinsen (1993), digitised by others from
/// a figure of Sun, Ming & Zhang (2015), until its chines are wet. This needs the added mass: without it the wedge is slower.
#[test]
fn a_free_wedge_slows_down_as_in_others_boundary_elements() {
    let (density, mass, gravity, start) = (1000.0, 78.3, 9.81, 0.005);
    let file = "/../scenarios/scene/reference/external/wedge25_yettou2006_velocity_bem_zf.csv";
    let text = std::fs::read_to_string(format!("{}{file}", env!("CARGO_MANIFEST_DIR"))).expect("a reference");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let theirs: Vec<[f64; 2]> = rows
        .map(|row| {
            let (time, speed) = row.split_once(',').expect("two columns");
            [1e-3 * time.parse::<f64>().expect("ms"), speed.parse().expect("m/s")]
        })
        .collect();
    let mut flow = EntryFlow::new(&wedge(25.0), start, 5.05, gravity).expect("in range");
    let (mut time, mut ours) = (start / 5.05, Vec::new());
    while flow.draught() < 0.15 {
        ours.push([time, flow.speed()]);
        let load = |load: &FlowLoad| (mass * gravity - density * load.force) / (mass + density * load.added_mass);
        time += flow.step(load).expect("a step").0;
    }
    let at = |t: f64| {
        let after = ours.partition_point(|row| row[0] <= t);
        let [[t0, v0], [t1, v1]] = [ours[after - 1], ours[after]];
        v0 + (v1 - v0) * (t - t0) / (t1 - t0)
    };
    let compared: Vec<_> = theirs.iter().filter(|row| row[0] > 2.0 * start / 5.05 && row[0] < time - 1e-3).collect();
    assert!(compared.len() > 10, "{}", compared.len());
    for [t, speed] in compared {
        assert!((at(*t) / speed - 1.0).abs() < 0.03, "{t} s: {} m/s, theirs {speed}", at(*t));
    }
}

/// Past wet chines: the same drops with elements half as large, which grow by 0.05, and steps of half the way. With linear elements the force at
/// 15 degrees was 3 % larger.
#[test]
fn the_force_past_wet_chines_is_that_of_finer_elements() {
    for (deadrise_deg, end, finer) in [(15.0, 0.0125, 13_136.0), (30.0, 0.025, 10_277.0)] {
        let section = Section::wedge(deadrise_deg, 0.5).expect("a wedge");
        let motion = SectionMotion::Free(241.0);
        let entry = FlowEntry { section: &section, motion, draught: 0.0, speed: 6.15, gravity: 9.81, density: 1000.0 };
        let (instants, _, ended) = entry.solve(&[0.0, end]).expect("in range");
        assert!(ended.is_none(), "{ended:?}");
        let force = instants[1].force;
        println!("{deadrise_deg} degrees: {:+.2} %", 100.0 * (force / finer - 1.0));
        assert!((force / finer - 1.0).abs() < 0.005, "{deadrise_deg} degrees: {force} N/m for {finer}");
    }
}

/// A wedge that is stopped ends the flow with place and speed.
#[test]
fn a_wedge_that_stops_ends_with_a_reason() {
    let mut flow = EntryFlow::new(&wedge(30.0), START, SPEED, 9.81).expect("in range");
    let ended = (0..1000).find_map(|_| flow.step(|_| -1000.0).err()).expect("an end");
    assert!(ended.speed <= 0.0 && ended.draught == flow.draught(), "{ended}");
}

/// Outside its range the model names the next that can.
#[test]
fn what_is_outside_the_range_is_refused() {
    for (deadrise, next) in [(9.0, "similarity"), (61.0, "similarity"), (82.0, "wcsph")] {
        let refused = EntryFlow::new(&wedge(deadrise), START, SPEED, 0.0).expect_err("out of range").to_string();
        assert!(refused.contains("10 to 60 degrees") && refused.contains(next), "{refused}");
    }
    let flat = Section::arc(1.0, 0.5).expect("a section");
    let refused = EntryFlow::new(&flat, 0.02, SPEED, 0.0).expect_err("out of range").to_string();
    assert!(
        refused.contains(
            "arcs of 20 degrees and more, and round bottoms that end at 17, not an arc that ends at 14.5 degrees"
        ),
        "{refused}"
    );
    let early = EntryFlow::new(&Section::arc(1.0, 1.5).expect("a section"), 0.001, SPEED, 0.0).expect_err("too early");
    assert!(early.to_string().contains("from a draught of 0.01"), "{early}");
    for (draught, speed) in [(0.0, SPEED), (START, -1.0), (f64::NAN, SPEED)] {
        let refused = EntryFlow::new(&wedge(30.0), draught, speed, 0.0).expect_err("out of range").to_string();
        assert!(refused.contains("above zero"), "{refused}");
    }
}

/// Under gravity a formula's pressures have the part at rest, as its force has buoyancy (EN10): half of the pressure at the keel here.
#[test]
fn pressures_of_formulas_have_the_part_at_rest() {
    let peak = |model: &str| {
        let text = format!(
            "name = \"a\"\nmodel = \"{model}\"\n[time]\nend = 0.25\n[body]\nname = \"w\"\nshape = \"wedge\"\ndeadrise_deg = 48.0\n\
             breadth = 1.0\nside_height = 1.0\nmotion = \"constant_velocity\"\nvelocity = [0.0, -1.35]\n[[gauges]]\nname = \"keel\"\n\
             at = [0.0, 0.0]\n"
        );
        let scene = load_text("a.toml", &text, &[]).expect("a scene").scene;
        let summary = run(&scene, &RunOptions::default()).expect("a run").summary;
        summary.results.get(scene::vocabulary::ResultName::PeakPressure).expect("a pressure").value
    };
    let [formula, flow] = ["similarity", "boundary_element"].map(peak);
    assert!((formula / flow - 1.0).abs() < 0.04, "{formula} Pa, {flow} Pa by boundary elements");
}

/// Where the flow of a free drop begins makes no difference while the chines are dry: an entry begins it at a sixth (light
/// wedge) to half of the draught of wet chines (heavy one), here it begins at a thirtieth. With wet chines both stay near: their steps, and so their instants of separation, differ.
#[test]
fn a_free_drop_does_not_depend_on_where_its_flow_begins() {
    for [mass, speed] in [[60.0, 4.0], [240.0, 6.0]] {
        begins_anywhere(mass, speed);
    }
}

/// Mass [kg/m], speed [m/s].
fn begins_anywhere(mass: f64, speed: f64) {
    let (deadrise_deg, breadth, gravity, density) = (30.0_f64, 0.5, 9.81, 1000.0);
    let wet = 0.5 * breadth * deadrise_deg.to_radians().tan() * std::f64::consts::FRAC_2_PI;
    let section = Section::wedge(deadrise_deg, breadth).expect("a section");
    let motion = SectionMotion::Free(mass);
    let entry = FlowEntry { section: &section, motion, draught: 0.0, speed, gravity, density };
    let times: Vec<f64> = (0..=300).map(|k| 2e-4 * f64::from(k)).collect();
    let (instants, history, end) = entry.solve(&times).expect("in range");
    assert!(end.is_none(), "{end:?}");
    let begin = wet / 30.0;
    let mut flow = EntryFlow::new(&section, begin, speed, gravity).expect("in range");
    let rate = |load: &FlowLoad| (mass * gravity - density * load.force) / (mass + density * load.added_mass);
    let mut compared = [0, 0];
    while flow.draught() < 1.6 * wet {
        let (draught, speed, chines_wet) = (flow.draught(), flow.speed(), flow.chines_wet());
        let (_, load) = flow.step(rate).expect("a step");
        let force = density * (load.force + load.added_mass * rate(&load));
        let after = instants.partition_point(|now| now.draught < draught);
        if draught < 0.1 * wet {
            continue;
        }
        let [a, b] = [instants[after - 1], instants[after]];
        let share = (draught - a.draught) / (b.draught - a.draught);
        let theirs = a.force + share * (b.force - a.force);
        let [of_force, of_speed] = [theirs / force - 1.0, (a.speed + share * (b.speed - a.speed)) / speed - 1.0];
        // the instant of separation is known to a step, and the load falls by half after it
        let within = if draught < 0.95 * wet { [0.01, 0.0015] } else { [0.04, 0.012] };
        assert!(of_force.abs() < within[0], "{draught} m: {theirs} N/m, {force} from an earlier begin");
        assert!(of_speed.abs() < within[1], "{draught} m: speed {of_speed:+.4}");
        if draught < 0.95 * wet {
            let highest = load.pressure.iter().map(|p| density * (p[1] + p[2] * rate(&load))).fold(0.0, f64::max);
            let time = a.time + share * (b.time - a.time);
            let read = (0..2000).map(|k| history.pressure(time, 0.25 * f64::from(k) / 2000.0)).fold(0.0, f64::max);
            assert!((read / highest - 1.0).abs() < 0.02, "{draught} m: largest pressure {read}, {highest}");
        }
        compared[usize::from(chines_wet)] += 1;
    }
    assert!(compared[0] > 30 && compared[1] > 10, "{compared:?}");
}

/// The validated drop, by the model as a scene has it: its error is the one that `auto` and error bars take.
#[test]
fn the_validated_drop_is_as_near_as_it_is_said_to_be() {
    let scene = scene("wedge25", &["model=boundary_element"]);
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    let bem = outcome.summary.comparison.iter().find(|c| c.reference.contains("bem")).expect("a comparison");
    let said = measured(&scene, &Theory::of(&scene, scene.model).expect("in range"), QuantityOfInterest::Motion);
    let said = said.expect("a measured error").error;
    assert!(bem.error.abs() <= said && said < 1.2 * bem.error.abs(), "{} against {said}", bem.error);
}

/// A round bottom at constant speed: at small draughts the load is a few per cent below the modified Logvinovich model's (Korobkin 2004), which
/// overrates the added mass; at half a radius it is near the formula that Campbell & Weynberg (1980) fitted to tests, 5.15/(1 + 8.5 h/R) +
/// 0.275 h/R, whose flow has left the cylinder too.
#[test]
fn a_round_bottom_is_near_the_formula_at_first_and_near_tests_at_last() {
    let section = Section::arc(1.0, 1.98).expect("a section");
    let formula = Loads::new(EntryModel::Mlm, &section).expect("in range");
    let mut flow = EntryFlow::new(&section, 0.03, 1.0, 0.0).expect("in range");
    let mut compared = [0, 0];
    while flow.draught() < 0.55 {
        let draught = flow.draught();
        let (_, load) = flow.step(|_| 0.0).expect("a step");
        if draught < 0.05 {
            let share = load.force / formula.at(draught).slam;
            assert!((0.94..1.0).contains(&share), "{draught}: {share} of the formula");
            compared[0] += 1;
        }
        if draught > 0.4 {
            let tests = 5.15 / (1.0 + 8.5 * draught) + 0.275 * draught;
            assert!((load.force / tests - 1.0).abs() < 0.06, "{draught}: {} for {tests}", load.force);
            compared[1] += 1;
        }
    }
    assert!(compared.iter().all(|count| *count > 5), "{compared:?}");
    assert!(flow.chines_wet());
}

/// A slow arc whose jet falls back behind its chine: the flow stays where it left the bottom, and the force has no step.
#[test]
fn a_jet_behind_the_chine_does_not_wet_the_bottom_again() {
    let section = Section::arc(1.0, 1.8).expect("a section");
    let motion = SectionMotion::Free(2000.0);
    let entry = FlowEntry { section: &section, motion, draught: 0.0, speed: 2.0, gravity: 9.81, density: 1000.0 };
    let times: Vec<f64> = (0..=300).map(|k| 1e-3 * f64::from(k)).collect();
    let (instants, _, end) = entry.solve(&times).expect("in range");
    assert!(end.is_none(), "{end:?}");
    for pair in instants.windows(2).filter(|pair| pair[0].draught > 0.2) {
        let step = pair[1].force / pair[0].force - 1.0;
        assert!(step.abs() < 0.06, "{} s: force {} after {} N/m", pair[1].time, pair[1].force, pair[0].force);
    }
}

/// A cylinder of half the water's density, by the model as a scene has it, against the boundary elements of Sun et al. (2018).
#[test]
fn a_light_cylinder_goes_as_deep_as_in_others_boundary_elements() {
    let scene = scene("cylinder_entry", &["model=boundary_element", "time.end=0.07"]);
    let outcome = run(&scene, &RunOptions::default()).expect("a run");
    let error =
        |of: &str| outcome.summary.comparison.iter().find(|c| c.reference.contains(of)).expect("a comparison").error;
    assert!(error("bem") < 0.035 && error("exp") < 0.045, "{} {}", error("bem"), error("exp"));
}
