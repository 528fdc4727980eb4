//! `splashdown run --converge`: a scene at 4, 2 and 1 times its spacing, and error bars of its main numbers.

use run::error_bar::{ErrorBar, ErrorBars};
use run::numbers::Numbers;
use run::summary::Summary;
use scene::{Motion, Scene, known_compressibility_error};

use super::fit::{Sample, fit};
use crate::experiments::ExperimentError;
use crate::experiments::runs::{RunRecord, run_to_end, scene_with};

/// Spacings of the coarser runs over the scene's own. The ratio is 2: at √2 the scatter between runs changes the order by 0.3.
const COARSER: [f64; 2] = [4.0, 2.0];
const METHOD: &str = "convergence study: spacings 4, 2, 1";

/// The coarser runs of a scene.
pub struct Refinement {
    runs: Vec<(f64, RunRecord)>,
}

/// Run a scene at 4 and 2 times its spacing; `tell` is called before each run with its number and its spacing [m].
///
/// # Errors
/// The scene cannot be run with these spacings, or a run ended early.
pub fn coarser_runs(scene: &str, sets: &[String], tell: impl Fn(usize, f64)) -> Result<Refinement, ExperimentError> {
    let spacing = run::load(scene, sets)?.scene.resolution.spacing;
    let at = |times: f64| {
        let coarse = scene_with(scene, sets, &[format!("resolution.spacing={:?}", times * spacing)]);
        coarse.map_err(|why| ExperimentError::Input {
            key: "--converge",
            given: format!("of a spacing of {spacing} m"),
            expected: format!("one that can be run {times} times as coarse too; {why}"),
        })
    };
    let scenes = COARSER.map(at).into_iter().collect::<Result<Vec<_>, _>>()?;
    let run = |(k, scene): (usize, &Scene)| {
        tell(k + 1, scene.resolution.spacing);
        Ok((scene.resolution.spacing, run_to_end(scene)?))
    };
    Ok(Refinement { runs: scenes.iter().enumerate().map(run).collect::<Result<_, ExperimentError>>()? })
}

impl Refinement {
    /// Cost of the runs [s].
    pub fn core_seconds(&self) -> f64 {
        self.runs.iter().map(|(_, run)| run.core_seconds()).sum()
    }

    /// # Errors
    /// The runs have no number at one of the paths.
    pub fn refuse_unknown(&self, quantities: &[String]) -> Result<(), ExperimentError> {
        let runs = || self.runs.iter().map(|(_, run)| run);
        let missing = |path: &&String| runs().any(|run| run.numbers.get(path).is_none());
        match (quantities.iter().find(missing), runs().next()) {
            (Some(path), Some(run)) => Err(ExperimentError::unknown_quantity(path, &run.numbers.paths())),
            _ => Ok(()),
        }
    }

    /// The error bars of the scene's own run: of the given numbers, or else of its main ones.
    pub fn error_bars(&self, scene: &Scene, summary: &Summary, quantities: &[String]) -> ErrorBars {
        let own = Numbers::of(summary);
        let share = sound_share(scene);
        let main = main_numbers(scene, summary, &own);
        let paths = if quantities.is_empty() { &main } else { quantities };
        let bar = |path: &String| Some((path.clone(), self.error_bar(scene, &own, path, share)?));
        paths.iter().filter_map(bar).collect()
    }

    /// `share`: relative error of the number due to the sound speed [-]; `None` where it is unknown.
    fn error_bar(&self, scene: &Scene, own: &Numbers, path: &str, share: Option<f64>) -> Option<ErrorBar> {
        let value = own.get(path)?;
        let sample = |spacing: f64, value: f64| Sample { spacing, law: 1.0, value }; // one sound speed
        let mut samples = vec![sample(scene.resolution.spacing, value)];
        for (spacing, run) in &self.runs {
            samples.push(sample(*spacing, run.numbers.get(path)?));
        }
        let fit = fit(&samples)?;
        let sd = own.get(&format!("{path}_sd")).unwrap_or(0.0);
        let sound = share.unwrap_or(0.0) * fit.extrapolated.abs();
        let mut method = METHOD.to_string();
        match share {
            Some(0.0) => {}
            Some(share) => method += &format!("; {:.2} % for the speed of sound", 100.0 * share),
            None => method += "; the speed of sound's share is unknown",
        }
        if sd > 0.0 {
            method += "; its standard deviation over the window";
        }
        let band = fit.uncertainty * fit.extrapolated.abs() + sound + sd;
        Some(ErrorBar {
            value,
            extrapolated: Some(fit.extrapolated),
            band,
            order: fit.order,
            verdict: fit.verdict(),
            method,
        })
    }
}

/// Relative error of a number due to the sound speed [-]: WC17 with an entry, M² of the fastest known speed without, as in the
/// laws of GE16; `None` where neither holds.
pub(crate) fn sound_share(scene: &Scene) -> Option<f64> {
    let sound = scene.sound_speed();
    match scene.entry() {
        _ if scene.solver.is_incompressible() => Some(0.0),
        Some(entry) => known_compressibility_error(entry.root_speed(), sound),
        None => Some((scene.fastest_speed() / sound).powi(2)),
    }
}

/// Paths of a scene's main numbers: the similarity solution's, or else the peaks of force, acceleration, deflection and
/// pressure, and a free body's mean speed over the last fifth of the run; without a body, the mean pressures of its gauges. All
/// have the periods that the scene compares.
fn main_numbers(scene: &Scene, summary: &Summary, own: &Numbers) -> Vec<String> {
    let mut paths: Vec<String> = Vec::new();
    if scene.similarity.is_some() {
        paths.extend(["force_coefficient", "impulse_coefficient", "cp_max"].map(|key| format!("similarity/{key}")));
    } else if let Some(body) = &scene.body {
        let motion = ["fy_N_per_m", "ay_m_per_s2"].map(|unit| format!("{}.{unit}", body.name));
        let panels = body.panels.iter().flat_map(|p| p.columns()).filter(|c| c.ends_with("deflection_m"));
        paths.extend(motion.into_iter().chain(panels).map(|column| format!("peaks/{column}/value")));
        paths.extend(matches!(body.motion, Motion::Free(_)).then(|| format!("means/{}.vy_m_per_s", body.name)));
        paths.extend(scene.gauges.iter().map(|g| format!("gauges/{}/peak_pa", g.name)));
    } else {
        paths.extend(scene.gauges.iter().map(|g| format!("means/{}.p_Pa", g.name)));
    }
    let is_period = |quantity: &str| quantity.ends_with(", period [s]");
    let comparisons = summary.comparison.iter().enumerate();
    let periods = comparisons.filter(|(_, c)| is_period(&c.quantity));
    paths.extend(periods.map(|(k, _)| format!("comparison/{k}/ours")));
    paths.retain(|path| own.get(path).is_some_and(|value| value != 0.0));
    paths
}
