//! The pressure at the keel of a steep wedge (THEORY GE21).

use evidence::systems::scene;
use run::observers::SimilarityResult;
use run::{RunOptions, run};
use water_entry::SimilarityFlow;
use water_entry::keel::KeelLaw;

/// Spacings of draught, and the kernel's support in them.
const DRAUGHT: f64 = 64.0;
const SUPPORT: f64 = 3.0;

/// Mean of f over the kernel's support about r, the face being reflected in the keel: Wendland C2 along the face.
fn smoothed(f: impl Fn(f64) -> f64, r: f64, support: f64) -> f64 {
    let (mut sum, mut whole) = (0.0, 0.0);
    for k in 0..400 {
        let q = 2.0 * ((f64::from(k) + 0.5) / 200.0 - 1.0);
        let weight = (1.0 - 0.5 * q.abs()).powi(4) * (2.0 * q.abs() + 1.0);
        sum += weight * f((r + 0.5 * q * support).abs());
        whole += weight;
    }
    sum / whole
}

/// The exact pressure, smoothed by a kernel: at the keel it is 4.6, 8.1 and 13.6 % low at 55, 60 and 65 degrees, the law from the face
/// next to it 2.8, 2.7 and 2.3 %: the next term of the corner's flow, r^(π/α), is not in the law. A fit of it as well has no bias, and a
/// scatter of 5 to 10 % in runs.
#[test]
fn the_law_of_the_keel_takes_back_what_a_kernel_takes_off_the_cusp() {
    for deadrise in [55.0_f64, 60.0, 65.0] {
        let flow = SimilarityFlow::solve(deadrise).expect("a solution");
        let beta = deadrise.to_radians();
        let read = |r: f64| smoothed(|r| flow.pressure_coefficient(r * beta.cos()), r, SUPPORT / DRAUGHT);
        let kernel = read(0.0) / flow.cp_keel - 1.0;
        let found = KeelLaw::new(beta, SUPPORT / DRAUGHT).expect("a cusp").fit(1.0, read).expect("a face");
        let law = found.pressure / flow.cp_keel - 1.0;
        assert!(law.abs() < 0.03 && law.abs() < 0.65 * kernel.abs(), "{deadrise} degrees: {kernel}, {law}");
        assert!(found.is_resolved(), "{deadrise} degrees: {}", found.share);
    }
}

fn entry(deadrise: &str, spacing: &str) -> SimilarityResult {
    let sets = [&format!("body.deadrise_deg={deadrise}"), "body.breadth=3", &format!("resolution.spacing={spacing}")];
    run(&scene("wedge_constant", &sets), &RunOptions::default()).expect("a run").summary.similarity.expect("numbers")
}

/// At 60 degrees and 32 spacings of draught the largest pressure is within 4 %, where the kernel's mean is 13 % low. At 75 degrees most of
/// the keel's pressure would be extrapolated: there is no number, but a reason; likewise at 60 degrees on a draught of 10 spacings.
#[test]
fn the_largest_pressure_at_a_keel_is_read_or_refused() {
    let exact = SimilarityFlow::solve(60.0).expect("a solution");
    let read = entry("60", "0.03125");
    let error = read.cp_max / exact.cp_max - 1.0;
    assert!(error.abs() < 0.04 && read.cp_max_unresolved.is_none(), "{error}, {:?}", read.cp_max_unresolved);
    for (deadrise, spacing) in [("75", "0.03125"), ("60", "0.1")] {
        let refused = entry(deadrise, spacing);
        let reason = refused.cp_max_unresolved.unwrap_or_default();
        assert!(refused.cp_max.is_nan() && reason.contains("GE21"), "{deadrise}: {} {reason}", refused.cp_max);
    }
}
