//! `splashdown run --converge`: a scene at 4, 2 and 1 times its spacing, and what its main numbers tend to.

use serde_json::Value;

use super::fit::{Sample, fit};
use super::{StudyError, listed_numbers};
use crate::error_bar::{ErrorBar, ErrorBars};
use crate::run::{self, RunOptions};
use crate::scene::{self, Motion, Scene, known_compressibility_error};
use crate::summary::{Status, Summary};

/// Spacings of the coarser runs over the scene's own: in the ratio 2, since in the ratio √2 the scatter between runs moves the
/// order by 0.3.
const COARSER: [f64; 2] = [4.0, 2.0];
const METHOD: &str = "convergence study: spacings 4, 2, 1";

/// The coarser runs of a scene.
pub struct Coarser {
    runs: Vec<(f64, Value)>,
    /// Cost of the runs [s].
    pub core_seconds: f64,
}

/// Run a scene at 4 and 2 times its spacing; `tell` hears of each run before it starts: its number and its spacing [m].
pub fn coarser(scene: &str, sets: &[String], tell: impl Fn(usize, f64)) -> Result<Coarser, StudyError> {
    let spacing = scene::load(scene, sets)?.scene.resolution.spacing;
    let at = |times: f64| {
        let mut sets = sets.to_vec();
        sets.push(format!("resolution.spacing={:?}", times * spacing));
        let loaded = scene::load(scene, &sets).map_err(|why| StudyError::Input {
            key: "--converge",
            given: format!("of a spacing of {spacing} m"),
            expected: format!("one that can be run {times} times as coarse too; {why}"),
        });
        Ok(loaded?.scene)
    };
    let scenes = COARSER.map(at).into_iter().collect::<Result<Vec<_>, StudyError>>()?;
    let mut done = Coarser { runs: Vec::new(), core_seconds: 0.0 };
    for (k, scene) in scenes.iter().enumerate() {
        tell(k + 1, scene.resolution.spacing);
        let summary = run::run(scene, &RunOptions::default())?.summary;
        if summary.status != Status::Completed {
            let (dx, c) = (scene.resolution.spacing, scene.sound_speed());
            return Err(StudyError::Ended(dx, c, summary.message.unwrap_or_default()));
        }
        done.core_seconds += summary.wall_time_s * summary.threads as f64;
        done.runs.push((scene.resolution.spacing, json(&summary)));
    }
    Ok(done)
}

impl Coarser {
    /// An error where the runs have no number at one of the paths.
    pub fn refuse_unknown(&self, quantities: &[String]) -> Result<(), StudyError> {
        let all = self.runs.iter().map(|(_, json)| json);
        let lacks = |path: &&String| all.clone().any(|json| number(json, path).is_none());
        match (quantities.iter().find(lacks), self.runs.first()) {
            (Some(path), Some((_, json))) => Err(StudyError::unknown_quantity(path, &listed_numbers(json))),
            _ => Ok(()),
        }
    }

    /// The error bars of the scene's own run: of the given numbers, or else of its main ones.
    pub fn error_bars(&self, scene: &Scene, summary: &Summary, quantities: &[String]) -> ErrorBars {
        let own = json(summary);
        let share = sound_share(scene);
        let usual = main_numbers(scene, &own);
        let paths = if quantities.is_empty() { &usual } else { quantities };
        let bar = |path: &String| Some((path.clone(), self.error_bar(scene, &own, path, share)?));
        paths.iter().filter_map(bar).collect()
    }

    /// `share`: what the speed of sound takes of the number [-]; `None` where nothing is known of it.
    fn error_bar(&self, scene: &Scene, own: &Value, path: &str, share: Option<f64>) -> Option<ErrorBar> {
        let value = number(own, path)?;
        let sample = |spacing: f64, value: f64| Sample { spacing, law: 1.0, value }; // one sound speed
        let mut samples = vec![sample(scene.resolution.spacing, value)];
        for (spacing, json) in &self.runs {
            samples.push(sample(*spacing, number(json, path)?));
        }
        let fit = fit(&samples)?;
        let sd = number(own, &format!("{path}_sd")).unwrap_or(0.0);
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
        let verdict = match fit.converged {
            true => "converged".into(),
            false => format!("not converged: {}", fit.doubts.join("; ")),
        };
        let band = fit.uncertainty * fit.extrapolated.abs() + sound + sd;
        Some(ErrorBar { value, extrapolated: Some(fit.extrapolated), band, order: fit.order, verdict, method })
    }
}

/// What the speed of sound takes of a number [-]: E19 with an entry, M² of the fastest known speed without, as in the laws of
/// G6; `None` where neither holds.
fn sound_share(scene: &Scene) -> Option<f64> {
    let sound = scene.sound_speed();
    match scene.entry() {
        _ if scene.solver.is_incompressible() => Some(0.0),
        Some(entry) => known_compressibility_error(entry.root_speed(), sound),
        None => Some((scene.fastest_speed() / sound).powi(2)),
    }
}

/// Paths of what a scene is run for: the similarity solution's numbers, or else the peaks of force, acceleration,
/// deflection and pressure, and a free body's mean speed over the last fifth of the run; where nothing moves but the water,
/// what its gauges read in the mean, and its periods.
fn main_numbers(scene: &Scene, json: &Value) -> Vec<String> {
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
    let comparisons = json["comparison"].as_array().map_or(&[][..], Vec::as_slice);
    let periods = comparisons.iter().enumerate().filter(|(_, c)| c["quantity"].as_str().is_some_and(is_period));
    paths.extend(periods.map(|(k, _)| format!("comparison/{k}/ours")));
    paths.retain(|path| number(json, path).is_some_and(|value| value != 0.0));
    paths
}

fn is_period(quantity: &str) -> bool {
    quantity.ends_with(", period [s]")
}

fn json(summary: &Summary) -> Value {
    serde_json::to_value(summary).unwrap_or_default()
}

fn number(json: &Value, path: &str) -> Option<f64> {
    json.pointer(&format!("/{path}")).and_then(Value::as_f64)
}
