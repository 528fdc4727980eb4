//! Error bars of a run from stored work–precision charts (THEORY GE17).
//!
//! A chart's [`ErrorLaw`] gives the error of a number over the resolution. It applies to runs of the same kind, near the
//! charted deadrise, resolution and Mach number.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use scene::{Bottom, Kernel, Motion, Scene, Shape, share_of_walls};
use serde::{Deserialize, Serialize};

use crate::compare;
use crate::error_bar::{ErrorBar, ErrorBars};
use crate::numbers::Numbers;
use crate::power_law::PowerLaw;
use crate::summary::Summary;

/// The laws of this program, written by `splashdown chart --all --fits scenarios/run/charts/fits.json`.
static LAWS: LazyLock<Vec<ErrorLaw>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../charts/fits.json")).expect("scenarios/run/charts/fits.json is a list of fits")
});

/// Standard deviations above the law that 90 % of lognormally scattered errors stay below [-].
const NINETY_PERCENT: f64 = 1.2816;
/// Keys of the method that laws are distinguished by; all others are those that the program chooses.
const PARAMETERS: [&str; 3] = ["solver", "fluid.kernel", "fluid.smoothing_ratio"];
/// Runs this much finer than a chart's are still near, and this much coarser: at 13 spacings of draught, beside a chart from 16, a wedge of 40 degrees
/// had 1.5 times the bar [-].
const FINER: f64 = 1.3;
const COARSER: f64 = 1.1;
/// Spray roots this much nearer to the speed of sound than a chart's are still near [-].
const FASTER: f64 = 1.1;
/// Deadrise beside a charted one that is still near [deg].
const BESIDE: f64 = 2.0;

/// Spacings in the draught among which a resolution is looked for [-], and how many.
const COARSEST: f64 = 8.0;
const FINEST: f64 = 150.0;
const RESOLUTIONS: u32 = 120;

/// Error of a number over the resolution, for runs of one kind.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ErrorLaw {
    /// The chart.
    pub case: String,
    /// Its family.
    pub family: String,
    /// The kind of the runs.
    pub kind: Kind,
    /// Deadrise [deg].
    pub deadrise_deg: f64,
    /// Speed of the spray root over that of sound [-]; absent where water is incompressible.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mach: Option<f64>,
    /// Path of the number in `summary.json`, with `BODY` for the body's name.
    pub number: String,
    /// The value that the error is relative to.
    pub share_of: ShareOf,
    /// Error over k, spacings in the draught [-].
    pub law: PowerLaw,
    /// Least and largest k charted [-].
    pub spacings: [f64; 2],
}

/// Settings that must be equal for a law to apply.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Kind {
    /// Whether the wedge falls freely; else its speed is constant.
    pub falls: bool,
    /// The pressure solver.
    pub solver: String,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over spacing [-].
    pub smoothing_ratio: f64,
}

/// The value that an error is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ShareOf {
    /// The number itself.
    Value,
    /// The speed at contact.
    ContactSpeed,
}

/// The parameters of a wedge entry that its error depends on.
pub struct WedgeEntry {
    /// The kind of the run.
    pub kind: Kind,
    /// Name of the body.
    pub body: String,
    /// Deadrise [deg].
    pub deadrise_deg: f64,
    /// Speed of the spray root over that of sound [-]; absent where water is incompressible.
    pub mach: Option<f64>,
    contact_speed: f64,
    /// Spacings in the draught k [-].
    spacings: f64,
}

impl WedgeEntry {
    /// `None` for anything but a rigid wedge that enters at constant speed without gravity, or falls.
    pub fn of(scene: &Scene) -> Option<WedgeEntry> {
        let (body, entry) = (scene.body.as_ref()?, scene.entry()?);
        let Shape::Wedge { deadrise_deg, .. } = body.shape else { return None };
        let falls = match &body.motion {
            Motion::Free(_) => true,
            Motion::ConstantVelocity if scene.similarity.is_some() => false,
            _ => return None,
        };
        if !falls && compare::wet_chines(scene, entry.final_draught).is_some() {
            return None; // the flow is not similar
        }
        let upright =
            matches!(entry.bottom, Bottom::Wedge { slope } if (slope - deadrise_deg.to_radians().tan()).abs() < 1e-9);
        if !scene.unusual_keys(&PARAMETERS).is_empty() || share_of_walls(scene) > 0.0 {
            return None;
        }
        let sound = (!scene.solver.is_incompressible()).then_some(scene.sound_speed());
        (upright && !body.bends()).then(|| WedgeEntry {
            kind: Kind {
                falls,
                solver: scene.solver.name().into(),
                kernel: scene.water().kernel,
                smoothing_ratio: scene.water().smoothing_ratio,
            },
            body: body.name.clone(),
            deadrise_deg,
            mach: sound.map(|sound| entry.root_speed() / sound),
            contact_speed: entry.speed,
            spacings: entry.attached_draught() / scene.resolution.spacing,
        })
    }

    fn is_near(&self, fit: &ErrorLaw) -> bool {
        let [coarse, fine] = fit.spacings;
        let slower = match (self.mach, fit.mach) {
            (Some(own), Some(charted)) => own <= FASTER * charted,
            _ => true,
        };
        self.kind == fit.kind && slower && self.spacings >= coarse / COARSER && self.spacings <= FINER * fine
    }
}

/// The error bars of a run that is near a charted one; none where nothing is near.
pub fn error_bars(scene: &Scene, summary: &Summary) -> ErrorBars {
    near_bars(&LAWS, scene, summary)
}

/// The error that 90 % of charted runs like this one stay below [-], and the charts' names; for a number of the summary as charts
/// have it, with `BODY` for the body's name. `None` where nothing is near.
pub fn charted_error(scene: &Scene, number: &str) -> Option<(f64, String)> {
    error_of(&LAWS, &WedgeEntry::of(scene)?, number)
}

/// The coarsest spacing [m] at which that error is at most `within`; `None` where no charted resolution is so good.
pub fn spacing_within(scene: &Scene, number: &str, within: f64) -> Option<f64> {
    coarsest(&LAWS, WedgeEntry::of(scene)?, scene.resolution.spacing, number, within)
}

fn error_of(fits: &[ErrorLaw], own: &WedgeEntry, number: &str) -> Option<(f64, String)> {
    let near: Vec<&ErrorLaw> = fits.iter().filter(|fit| fit.number == number && own.is_near(fit)).collect();
    between(own, &near)
}

fn coarsest(fits: &[ErrorLaw], own: WedgeEntry, spacing: f64, number: &str, within: f64) -> Option<f64> {
    let draught = own.spacings * spacing;
    let mut own = own;
    (0..=RESOLUTIONS).find_map(|k| {
        own.spacings = COARSEST * (FINEST / COARSEST).powf(f64::from(k) / f64::from(RESOLUTIONS));
        let (error, _) = error_of(fits, &own, number)?;
        (error <= within).then_some(draught / own.spacings)
    })
}

fn near_bars(fits: &[ErrorLaw], scene: &Scene, summary: &Summary) -> ErrorBars {
    let Some(own) = WedgeEntry::of(scene) else { return ErrorBars::new() };
    let mut by_number: BTreeMap<&str, Vec<&ErrorLaw>> = BTreeMap::new();
    for fit in fits.iter().filter(|fit| own.is_near(fit)) {
        by_number.entry(&fit.number).or_default().push(fit);
    }
    if by_number.is_empty() {
        return ErrorBars::new();
    }
    let numbers = Numbers::of(summary);
    let bar = |(number, fits): (&str, Vec<&ErrorLaw>)| {
        let path = number.replace("BODY", &own.body);
        let value = numbers.get(&path)?;
        let (error, from) = between(&own, &fits)?;
        let whole = match fits[0].share_of {
            ShareOf::Value => value.abs(),
            ShareOf::ContactSpeed => own.contact_speed,
        };
        let method = format!(
            "chart of {from}, {}: its error at {:.0} spacings in the draught, with its scatter",
            fits[0].family, own.spacings
        );
        let verdict = "holds 90 % of the charted law's scatter".into();
        Some((path, ErrorBar { value, extrapolated: None, band: error * whole, order: None, verdict, method }))
    };
    by_number.into_iter().filter_map(bar).collect()
}

/// Errors of wedges between the charted ones over those of the laws [-]: with 1, bars of the largest pressure held in 33 of 39
/// (`splashdown bands --uncharted 20 --seed 101`, and 202), in weakly compressible water in 14 of 20.
fn beside_charts(fit: &ErrorLaw) -> f64 {
    if fit.number.ends_with("cp_max") { 1.4 } else { 1.0 }
}

/// The error that 90 % stay below at the run's deadrise, linear in its logarithm between two charted ones [-], and the
/// charts' names. Of several charts at one deadrise, the largest.
fn between(own: &WedgeEntry, fits: &[&ErrorLaw]) -> Option<(f64, String)> {
    let error =
        |fit: &ErrorLaw| beside_charts(fit) * fit.law.at(own.spacings) * (NINETY_PERCENT * fit.law.scatter).exp();
    let nearest = |below: bool| {
        let side =
            fits.iter().filter(|f| (f.deadrise_deg <= own.deadrise_deg) == below || f.deadrise_deg == own.deadrise_deg);
        let distance = |f: &ErrorLaw| (f.deadrise_deg - own.deadrise_deg).abs();
        side.copied().min_by(|a, b| distance(a).total_cmp(&distance(b)).then(error(b).total_cmp(&error(a))))
    };
    let (low, high) = match (nearest(true), nearest(false)) {
        (Some(low), Some(high)) => (low, high),
        (Some(one), None) | (None, Some(one)) if (one.deadrise_deg - own.deadrise_deg).abs() <= BESIDE => (one, one),
        _ => return None,
    };
    if low.deadrise_deg == high.deadrise_deg {
        return Some((error(low), low.case.clone()));
    }
    let share = (own.deadrise_deg - low.deadrise_deg) / (high.deadrise_deg - low.deadrise_deg);
    let error = error(low).powf(1.0 - share) * error(high).powf(share);
    Some((error, format!("{} and {}", low.case, high.case)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn charted(case: &str, deadrise_deg: f64, factor: f64) -> ErrorLaw {
        ErrorLaw {
            case: case.into(),
            family: "weakly compressible".into(),
            kind: likeness(20.0, 0.02).kind,
            deadrise_deg,
            mach: Some(0.05),
            number: "similarity/force_coefficient".into(),
            share_of: ShareOf::Value,
            law: PowerLaw { factor, exponent: -1.0, exponent_error: 0.1, scatter: 0.0 },
            spacings: [20.0, 60.0],
        }
    }

    fn likeness(deadrise_deg: f64, spacing: f64) -> WedgeEntry {
        let sets = [format!("body.deadrise_deg={deadrise_deg:?}"), format!("resolution.spacing={spacing:?}")];
        WedgeEntry::of(&crate::load("wedge_constant", &sets).expect("a scene").scene).expect("a wedge")
    }

    #[test]
    fn between_charts_the_error_goes_geometrically_and_falls_with_the_resolution() {
        let fits = [charted("twenty", 20.0, 1.0), charted("worse", 20.0, 4.0), charted("forty", 40.0, 1.0)];
        let all: Vec<&ErrorLaw> = fits.iter().collect();
        let at = |deadrise: f64, spacing: f64| between(&likeness(deadrise, spacing), &all);
        let (error, from) = at(30.0, 0.025).expect("between");
        assert!((error - 2.0 / 40.0).abs() < 1e-12 && from == "worse and forty", "{error} {from}");
        assert!((at(20.0, 0.025).expect("charted").0 - 4.0 / 40.0).abs() < 1e-12);
        assert!((at(41.0, 0.02).expect("beside").0 - 1.0 / 50.0).abs() < 1e-12);
        assert_eq!(at(45.0, 0.025), None);
    }

    #[test]
    fn the_coarsest_spacing_within_a_tolerance_is_the_laws() {
        let fits = [charted("thirty", 30.0, 1.0)]; // error 1/k
        let at = |within: f64| coarsest(&fits, likeness(30.0, 0.02), 0.02, "similarity/force_coefficient", within);
        let spacing = at(0.025).expect("k = 40");
        assert!((1.0 / spacing - 40.0).abs() < 1.0 && 1.0 / spacing >= 40.0 - 1e-9, "{spacing}");
        assert_eq!(at(0.01), None, "k = 100 is beyond the chart");
    }

    #[test]
    fn what_is_coarse_fast_or_of_another_kind_is_not_near() {
        let (fit, own) = (charted("twenty", 20.0, 1.0), likeness(20.0, 0.02));
        assert!(own.is_near(&fit));
        assert!(!likeness(20.0, 0.1).is_near(&fit), "k = 10");
        assert!(!WedgeEntry { mach: Some(0.06), ..own }.is_near(&fit));
        let gaussian = crate::load("wedge_constant", &["fluid.kernel=gaussian".into()]).expect("a scene").scene;
        assert!(!WedgeEntry::of(&gaussian).expect("a wedge").is_near(&fit));
        let bent = crate::load("elastic_wedge", &[]).expect("a scene").scene;
        assert!(
            WedgeEntry::of(&bent).is_none()
                && WedgeEntry::of(&crate::load("floating_box", &[]).expect("a scene").scene).is_none()
        );
    }
}
