//! `splashdown bands --uncharted`: how often the error bar that a run has from stored charts contains the exact value, for wedges at
//! constant speed that are on no chart.

use report::Table;
use run::compare::similarity_of;
use scene::{SceneError, jet_reach};
use sph_core::SplitMix64;

use super::coverage::Line;
use super::runs::{run_to_end, scene_with};
use super::{ExperimentError, yes};

/// Range of deadrise [deg], of speeds [m/s] and of spacings in the draught [-] that cases are drawn from.
const DEADRISE: [f64; 2] = [10.5, 44.5];
const SPEED: [f64; 2] = [0.3, 30.0];
const SPACINGS: [f64; 2] = [17.0, 44.0];
/// Room on the face beyond the jet's tip [-].
const ROOM: f64 = 1.1;
/// Solvers, in turn.
pub(super) const SOLVERS: [&str; 2] = ["weakly_compressible", "incompressible"];

/// Numbers of case `k` of a seed, each drawn from a range, evenly in the logarithm.
pub(super) fn numbers(seed: u64, k: usize) -> impl FnMut([f64; 2]) -> f64 {
    let mut random = SplitMix64(seed.wrapping_mul(1_000_003).wrapping_add(k as u64));
    move |[low, high]| low * (high / low).powf(random.unit())
}

/// Overrides of `wedge_constant` for case `k` of a seed: a draught of 1 m at the end, and a jet that stays on the face.
pub fn draw(seed: u64, k: usize) -> Vec<String> {
    let mut of = numbers(seed, k);
    let (deadrise, speed, spacings) = (of(DEADRISE), of(SPEED), of(SPACINGS));
    let breadth = 2.0 * ROOM * jet_reach(deadrise).unwrap_or(1.0);
    vec![
        format!("solver={}", SOLVERS[k % SOLVERS.len()]),
        format!("body.deadrise_deg={deadrise:.3}"),
        format!("body.velocity=[0.0, {:.4}]", -speed),
        format!("time.end={:.6}", 1.0 / speed),
        format!("resolution.spacing={:.6}", 1.0 / spacings),
        format!("body.breadth={breadth:.3}"),
    ]
}

/// Run a case: a line for each number with an error bar.
///
/// # Errors
/// The scene is wrong, or the run ended early.
pub fn cover(sets: &[String]) -> Result<Vec<Line>, ExperimentError> {
    let scene = scene_with("wedge_constant", sets, &[])?;
    let run = run_to_end(&scene)?;
    let Some(exact) = similarity_of(&scene) else { return Ok(Vec::new()) };
    let of = |path: &str| if path.ends_with("cp_max") { exact.cp_max } else { exact.force_coefficient };
    let line = |(path, bar): (&String, &run::error_bar::ErrorBar)| Line {
        case: sets.join(" "),
        path: path.clone(),
        exact: of(path),
        holds: bar.holds(of(path)),
        bar: bar.clone(),
        core_seconds: run.core_seconds(),
        source: exact.source.into(),
    };
    Ok(run.summary.error_bars.iter().map(line).collect())
}

/// The table as Markdown, with the share of bars that contain the exact value, and the medians of bands and errors.
pub fn table(lines: &[Line]) -> String {
    let error = |l: &Line| (l.bar.value / l.exact - 1.0).abs();
    let band = |l: &Line| (l.bar.band / l.exact).abs();
    let rows = Table::of(
        "",
        lines,
        &[
            ("case", |l| l.case.clone()),
            ("number", |l| l.path.clone()),
            ("exact", |l| format!("{:.4}", l.exact)),
            ("error", |l| format!("{:+.2} %", 100.0 * (l.bar.value / l.exact - 1.0))),
            ("band ±", |l| format!("{:.2} %", 100.0 * (l.bar.band / l.exact).abs())),
            ("holds", |l| yes(l.holds)),
            ("core-s", |l| format!("{:.0}", l.core_seconds)),
        ],
    );
    let held = lines.iter().filter(|l| l.holds).count();
    let [band, error] = [median(lines.iter().map(band)), median(lines.iter().map(error))].map(|share| 100.0 * share);
    format!(
        "{held} of {} bars hold the exact value. Median band {band:.2} %, median error {error:.2} %.\n\n{}",
        lines.len(),
        rows.markdown()
    )
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Refuses cases that cannot be read, before the first runs.
///
/// # Errors
/// The first that is wrong.
pub fn read_all(cases: &[Vec<String>]) -> Result<(), SceneError> {
    cases.iter().try_for_each(|sets| scene_with("wedge_constant", sets, &[]).map(|_| ()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_the_same_for_a_seed_and_can_be_read() {
        let cases: Vec<_> = (0..20).map(|k| draw(7, k)).collect();
        assert_eq!(draw(7, 3), cases[3]);
        assert_ne!(draw(8, 3), cases[3]);
        read_all(&cases).expect("scenes");
    }
}
