//! The peaks that a run quotes, against theory through the same mean (THEORY GE18–GE20).

use evidence::systems::scene;
use scenarios::results::{Quantity, Verdict};
use scenarios::run::summary::Summary;
use scenarios::run::{RunOptions, run};

fn summary(name: &str, sets: &[&str]) -> Summary {
    run(&scene(name, sets), &RunOptions::default()).expect("a scene that can be built").summary
}

fn peak_force(summary: &Summary) -> Quantity {
    summary.results.peak_force_N_per_m.expect("a body")
}

/// A round-bottomed section that flies in, at two speeds of sound: the mean is the same, and within its band of the modified
/// Logvinovich model's mean over the same 6 ms, 122.4 kN/m; single steps differ by a fifth.
#[test]
fn the_quoted_peak_of_a_round_bottom_does_not_follow_the_speed_of_sound() {
    let of =
        |sound: &str| peak_force(&summary("fuselage_section", &["resolution.spacing=0.01", "time.end=0.012", sound]));
    let (slow, fast) = (of("fluid.sound_speed=240"), of("fluid.sound_speed=480"));
    assert_eq!((slow.verdict, fast.verdict), (Verdict::Resolved, Verdict::Resolved));
    assert!((slow.value / fast.value - 1.0).abs() < 0.03, "{slow:?} {fast:?}");
    assert!(fast.raw / slow.raw > 1.15, "{slow:?} {fast:?}");
    // a start on the water meets a row at once: an eighth more, at either speed of sound, and not resolved
    let touch = ["resolution.spacing=0.01", "time.end=0.012", "fluid.sound_speed=480", "time.start=0"];
    let touching = peak_force(&summary("fuselage_section", &touch));
    assert_eq!(touching.verdict, Verdict::Acoustic);
    assert!((1.10..1.20).contains(&(touching.value / fast.value)), "{touching:?} {fast:?}");
    for quoted in [slow, fast] {
        let band = quoted.band.expect("a band");
        assert!((quoted.value - 122.4e3).abs() < band, "{quoted:?}");
    }
}

/// A drop whose peak comes at a draught of three spacings: the peak is not quoted as resolved, and the doubt names a spacing.
#[test]
fn a_peak_within_six_spacings_of_draught_is_not_resolved() {
    let drop = ["body.deadrise_deg=15", "body.mass=250", "body.velocity=[0.0, -6.0]", "time.end=0.01"];
    let summary = summary("wedge", &[&drop[..], &["resolution.spacing=0.012"]].concat());
    assert_eq!(peak_force(&summary).verdict, Verdict::NotResolved);
    assert!(summary.doubts.iter().any(|doubt| doubt.contains("resolution.spacing")), "{:?}", summary.doubts);
}
