//! The peaks that a run quotes, against theory through the same mean (THEORY GE18–GE20).

use evidence::long::long;
use evidence::systems::scene;
use run::summary::Summary;
use run::{RunOptions, run};
use scene::vocabulary::{BandwidthBy, Quantity, Verdict};

fn summary(name: &str, sets: &[&str]) -> Summary {
    run(&scene(name, sets), &RunOptions::default()).expect("a scene that can be built").summary
}

fn peak_force(summary: &Summary) -> Quantity {
    summary.results.get(scene::vocabulary::ResultName::PeakForce).expect("a body")
}

/// A round-bottomed section that flies in, at two speeds of sound: the mean is the same within 4 % at 10 mm, and within its band of the modified
/// Logvinovich model's mean over the same 6 ms, 122.4 kN/m; single steps differ by a fifth.
#[test]
fn the_quoted_peak_of_a_round_bottom_does_not_follow_the_speed_of_sound() {
    let of =
        |sound: &str| peak_force(&summary("fuselage_section", &["resolution.spacing=0.01", "time.end=0.012", sound]));
    let (slow, fast) = (of("fluid.sound_speed=240"), of("fluid.sound_speed=480"));
    assert_eq!((slow.verdict, fast.verdict), (Verdict::Resolved, Verdict::Resolved));
    assert!((slow.value / fast.value - 1.0).abs() < 0.04, "{slow:?} {fast:?}");
    assert!(fast.raw / slow.raw > 1.15, "{slow:?} {fast:?}");
    // a start on the water meets a layer at once: an eighth more, at either speed of sound, and not resolved
    let touch = ["resolution.spacing=0.01", "time.end=0.012", "fluid.sound_speed=480", "time.start=0"];
    let touching = peak_force(&summary("fuselage_section", &touch));
    assert_eq!(touching.verdict, Verdict::Acoustic);
    assert!((1.10..1.20).contains(&(touching.value / fast.value)), "{touching:?} {fast:?}");
    for quoted in [slow, fast] {
        let band = quoted.band.expect("a band");
        assert!((quoted.value - 122.4e3).abs() < band, "{quoted:?}");
    }
}

/// The first contact of two arcs: boundary elements, whose first row is up to twice as high, quote what particles quote.
#[test]
fn boundary_elements_and_particles_quote_the_same_first_contact() {
    for (radius, speed, mass, finite_rise) in [(0.6, 3.5, 226.0, 0.9), (2.0, 6.9, 905.0, 0.8)] {
        let sets = [
            format!("body.radius={radius}"),
            format!("body.breadth={radius}"),
            format!("body.side_height={}", 0.3 * radius),
            format!("body.mass={mass}"),
            format!("body.velocity=[0.0, -{speed}]"),
            format!("time.end={}", 0.05 * radius / speed),
            format!("resolution.spacing={}", 0.0025 * radius),
            "compare=[]".to_string(),
        ];
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        let particles = peak_force(&summary("fuselage_section", &sets));
        let of_flow = summary("fuselage_section", &[&sets[..], &["model=boundary_element"]].concat());
        let flow = peak_force(&of_flow);
        assert_eq!(of_flow.results.bandwidth_by, Some(BandwidthBy::Impact));
        assert_eq!((particles.verdict, flow.verdict), (Verdict::Resolved, Verdict::Resolved));
        assert_eq!(particles.cutoff_hz.map(f64::round), flow.cutoff_hz.map(f64::round));
        assert!(
            (flow.value / particles.value - 1.0).abs() < flow.band.expect("a band") / flow.value,
            "{flow:?} {particles:?}"
        );
        assert!(flow.value < finite_rise * flow.raw, "{flow:?}");
    }
}

/// Boundary elements about a round bottom: the mean follows from the body's loss of speed and not from the rows, and is not resolved where
/// the run is too short for it or the body starts in the water.
#[test]
fn the_mean_of_a_round_bottom_does_not_depend_on_rows_or_on_a_nanometre() {
    let of = |sets: &[&str]| summary("fuselage_section", &[&["model=boundary_element", "compare=[]"], sets].concat());
    let whole = peak_force(&of(&[]));
    assert_eq!(whole.verdict, Verdict::Resolved);
    for sets in [["body.position=[0,-1e-9]"], ["time.end=0.2"], ["time.sample_every=5e-6"]] {
        let other = peak_force(&of(&sets));
        assert_eq!(other.verdict, Verdict::Resolved, "{sets:?}");
        assert!((other.value / whole.value - 1.0).abs() < 2e-3, "{sets:?}: {other:?} {whole:?}");
    }
    // m ΔV/τ of a body that loses a third of its speed within the mean: 8874 N/m from its own speeds at 20000 rows
    let light = peak_force(&of(&["body.mass=8"]));
    assert!((light.value - 8874.0).abs() < 20.0 && light.band.is_none(), "{light:?}");
    for (sets, verdict, why) in [
        (["time.end=0.003"], Verdict::NotResolved, "wet for less than the time of the mean"),
        (["body.position=[0,-0.02]"], Verdict::Acoustic, "starts 0.02 m deep at speed"),
        (["report.bandwidth=1e5"], Verdict::Acoustic, "the sound of water"),
    ] {
        let doubted = of(&sets);
        let doubts: Vec<String> = doubted.doubts.iter().map(ToString::to_string).collect();
        assert!(doubts.iter().any(|doubt| doubt.contains(why)), "{sets:?}: {doubts:?}");
        assert_eq!((peak_force(&doubted).verdict, peak_force(&doubted).band), (verdict, None), "{sets:?}");
    }
    let deep = scene("fuselage_section", &["model=boundary_element", "compare=[]", "body.position=[0,-0.006]"]);
    let refused = run(&deep, &RunOptions::default()).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(refused.contains("where its flow begins 0.0135 m deep"), "{refused}");
    let late =
        summary("arc_constant", &["model=boundary_element", "compare=[]", "body.position=[0,0.49]", "time.end=0.5"]);
    assert_eq!(peak_force(&late).verdict, Verdict::NotResolved);
}

/// A drop whose peak comes at a draught of three spacings: the peak is not quoted as resolved, and the doubt names a spacing.
#[test]
fn a_peak_within_six_spacings_of_draught_is_not_resolved() {
    let drop = ["body.deadrise_deg=15", "body.mass=250", "body.velocity=[0.0, -6.0]", "time.end=0.01"];
    let summary = summary("wedge", &[&drop[..], &["resolution.spacing=0.012"]].concat());
    assert_eq!(peak_force(&summary).verdict, Verdict::NotResolved);
    assert!(
        summary.doubts.iter().any(|doubt| doubt.to_string().contains("resolution.spacing")),
        "{:?}",
        summary.doubts
    );
}

/// A light drop at 8 mm, whose peak comes at 6.8 mm: the doubt gives the spacing that theory requires, before and after the run.
#[test]
fn a_light_drop_is_not_resolved_whatever_draught_the_run_shows() {
    let summary = summary("wedge", &["body.mass=2.72", "time.end=0.006", "resolution.spacing=0.008"]);
    assert_eq!(peak_force(&summary).verdict, Verdict::NotResolved);
    assert!(
        summary.doubts.iter().any(|doubt| doubt.to_string().contains("0.00114 m would do")),
        "{:?}",
        summary.doubts
    );
}

/// A drop at 0.1 m/s that gravity makes ten times as fast, against the modified Logvinovich model. The force grows to the end of the run: no peak.
#[test]
fn a_slow_drop_is_right_and_its_force_at_the_end_is_no_peak() {
    let spacing = if long() { "resolution.spacing=0.008" } else { "resolution.spacing=0.009" };
    let set = ["body.velocity=[0.0, -0.1]", "time.end=0.3", spacing];
    let force = |sets: &[&str]| peak_force(&summary("wedge", &[&set[..], sets].concat()));
    let (particles, theory) = (force(&[]), force(&["model=mlm"]));
    println!("{particles:?} {theory:?}");
    assert_eq!([particles.verdict, theory.verdict], [Verdict::NotResolved; 2]);
    assert!((particles.value / theory.value - 1.0).abs() < 0.05, "{particles:?} {theory:?}");
}

/// A flat bottom: no peak is right, and the impulse is the momentum that the water takes, with that of its weight.
#[test]
fn a_flat_contact_is_refused_by_name_and_keeps_its_impulse() {
    let body = "body={ name = 'plate', shape = 'box', breadth = 0.5, height = 0.2, mass = 100.0, free = ['y'], \
        velocity = [0.0, -5.0] }";
    let of = |solver: &str, spacing: &str| summary("wedge", &[body, solver, spacing, "compare=[]", "time.end=0.01"]);
    let spacings = if long() { [0.01, 0.007] } else { [0.014, 0.01] };
    let mut impulses = Vec::new();
    for solver in ["fluid.sound_speed=1480", "solver=incompressible"] {
        for spacing in spacings {
            let summary = of(solver, &format!("resolution.spacing={spacing}"));
            assert_eq!(peak_force(&summary).verdict, Verdict::Acoustic, "{solver} {spacing}");
            assert!(
                summary.doubts.iter().any(|doubt| doubt.to_string().contains("impulse_N_s_per_m")),
                "{:?}",
                summary.doubts
            );
            let peak = summary.peaks["plate.fy_N_per_m"];
            assert_eq!((peak.value, peak.verdict), (peak_force(&summary).raw, Some(Verdict::Acoustic)));
            impulses.push(summary.results.get(scene::vocabulary::ResultName::Impulse).expect("a body").value);
        }
    }
    let mean = impulses.iter().sum::<f64>() / 4.0;
    println!("{impulses:?}");
    assert!(impulses.iter().all(|impulse| (impulse / mean - 1.0).abs() < 0.03), "{impulses:?}");
    // as soft as the air beneath: the pressure of Chuang (1966) over the breadth, within the band
    let force = peak_force(&of("solver=weakly_compressible", "resolution.spacing=0.01"));
    let cushion = 4.5 * 6894.757 / 0.3048 * 5.0 * 0.5;
    assert_eq!(force.verdict, Verdict::Resolved);
    let shallow = summary("flat_bottom", &["tank.width=3", "tank.depth=0.2"]);
    assert_eq!(peak_force(&shallow).verdict, Verdict::Acoustic, "an echo of the floor");
    assert!((force.value - cushion).abs() < force.band.expect("a band"), "{force:?}, {cushion}");
}

/// One drop at three spacings: at a bandwidth of its own each spacing quotes another peak; at a fixed one they agree.
#[test]
fn a_peak_at_a_fixed_bandwidth_does_not_follow_the_spacing() {
    let of = |sets: &[&str]| {
        let drop = ["time.end=0.012", "fluid.sound_speed=240"];
        ["resolution.spacing=0.016", "resolution.spacing=0.01", "resolution.spacing=0.008"].map(|spacing| {
            let found = summary("fuselage_section", &[&drop[..], sets, &[spacing]].concat());
            (peak_force(&found), found.results.bandwidth_by)
        })
    };
    let [coarse, middle, fine] = of(&["report.bandwidth=45"]);
    let difference = (middle.0.value / fine.0.value - 1.0).abs();
    assert!(difference < 0.03, "{middle:?} {fine:?}");
    assert!([coarse, middle, fine].iter().all(|(_, by)| *by == Some(BandwidthBy::Scene)));
    let [coarse, _, fine] = of(&[]);
    assert!(fine.0.value / coarse.0.value > 1.1 && fine.1 == Some(BandwidthBy::Spacing), "{coarse:?} {fine:?}");
}

/// Bands were measured with the keys that the program chooses: with another one there is none, and the key is named.
#[test]
fn a_key_of_the_method_that_no_band_was_measured_with_takes_the_band() {
    let usual = ["resolution.spacing=0.06", "time.end=0.6", "compare=[]"];
    let of = |set: &str| summary("wedge_constant", &[&usual[..], &[set]].concat());
    let (with, without) = (of("fluid.cfl=0.5"), of("fluid.artificial_viscosity=0.5"));
    assert!(peak_force(&with).band.is_some() && with.doubts.iter().all(|doubt| !doubt.to_string().contains("no band")));
    assert!(peak_force(&without).band.is_none() && without.error_bars.is_empty());
    assert!(
        without.doubts.iter().any(|doubt| doubt.to_string().contains("fluid.artificial_viscosity = 0.5")),
        "{:?}",
        without.doubts
    );
}

/// The peak of a theory is averaged as `report.bandwidth` asks, as that of particles is.
#[test]
fn a_theory_quotes_the_mean_that_the_scene_asks_for() {
    let of = |sets: &[&str]| peak_force(&summary("wedge", &[&["model=boundary_element"], sets].concat()));
    let (free, wide, narrow) = (of(&[]), of(&["report.bandwidth=150"]), of(&["report.bandwidth=40"]));
    assert_eq!((free.cutoff_hz, wide.cutoff_hz, narrow.cutoff_hz), (None, Some(150.0), Some(40.0)));
    assert!(narrow.value < wide.value && wide.value < free.value && wide.raw == free.value, "{free:?} {wide:?}");
}

/// Narrow round bottoms (b/R < 1.2) wet their chines before water leaves the sides: air comes in there too, so that the impulse is that of
/// boundary elements; where water clung to them it was 11 % low. The projection's is low by 2 to 5 %, within its band.
#[test]
fn water_leaves_the_chines_of_a_narrow_round_bottom() {
    let section = ["body.radius=0.885", "body.breadth=0.855", "body.side_height=0.285"];
    let drop = ["body.velocity=[0.0, -3.04]", "time.end=0.0408", "resolution.spacing=0.006"];
    let impulse = |more: &[&str]| {
        let summary = summary("arc_constant", &[&section[..], &drop, more].concat());
        summary.results.get(scene::vocabulary::ResultName::Impulse).expect("a body")
    };
    let exact = impulse(&["model=boundary_element"]).value;
    for (solver, within) in [("solver=weakly_compressible", 0.02), ("solver=incompressible", 0.06)] {
        let found = impulse(&[solver]);
        let error = found.value / exact - 1.0;
        assert!(error.abs() < within, "{solver}: {error}");
        assert!((found.value - exact).abs() < found.band.expect("a band"), "{solver}: {found:?}, exact {exact}");
    }
}
