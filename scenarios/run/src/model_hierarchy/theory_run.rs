//! The files of a run by a theory.

use std::time::Instant as Clock;

use scene::reference::WedgeSimilarity;
use scene::validity::panels::panel_results_within;
use scene::vocabulary::{CUTOFF, Doubt, Doubts, Quantity, ResultName, Results, Status, Verdict};
use scene::{Body, Gauge, Motion, QuantityOfInterest, Scene};
use settings::significant;
use water_entry::Instant;

use super::largest_mean::{Averaging, Largest, doubt, largest};
use super::{Measured, Theory, measured};
use crate::compare::{self, ReferenceCurve};
use crate::error_bar::{ErrorBar, ErrorBars};
use crate::log::{BodyView, Frame, Logged};
use crate::observers::{ObserveError, Series, SimilarityResult, body_values, create_log, mean_and_deviation};
use crate::results::{OF_FREE_FALL, RunningIntegral};
use crate::summary::{Log, Peak, Summary};
use crate::{Outcome, RunError, RunOptions};

/// Least pressure in the rows beside a peak that they follow, over it [-]: it is then within about 1 % of the largest between rows.
const BESIDE_PEAK: f64 = 0.95;
/// Points of a pressure profile, in x/(V t) up to the jet's tip.
const PROFILE: usize = 800;

/// A scene that a theory followed.
pub(crate) struct Followed {
    theory: Theory,
    start: Clock,
}

impl Followed {
    /// Follow a scene to its end; nothing is written.
    pub fn new(scene: &Scene) -> Result<Followed, RunError> {
        let start = Clock::now();
        let theory = Theory::of(scene, scene.model).map_err(|e| RunError::Theory(scene.model.name(), e))?;
        Ok(Followed { theory, start })
    }
}

/// Files and numbers of a scene whose model is a theory; `out` is ready for files.
pub(crate) fn run(
    scene: &Scene,
    Followed { theory, start }: Followed,
    options: &RunOptions<'_>,
    references: Vec<ReferenceCurve>,
) -> Result<Outcome, RunError> {
    let body = scene.body.as_ref().expect("a theory has a body");
    let file = |name: &str| options.out.as_ref().map(|dir| dir.join(name));
    let mut series = Series::new(scene, file("series.csv").as_deref())?;
    theory.rows(scene).into_iter().for_each(|row| series.push(row));
    series.flush()?;
    let log = file("log.mcap").filter(|_| !options.without_log);
    let log = log.map(|path| write_log(scene, body, &theory, &path)).transpose()?;
    let exact = compare::similarity_of(scene);
    let similarity = scene.similarity.and_then(|_| similarity(scene, &theory, exact.as_ref()));
    let (comparison, not_compared) = compare::against_all(scene, &references, &series, similarity.as_ref());
    let bars = error_bars(scene, body, &theory, &series);
    let end = theory.instants.last().map_or(0.0, |i| i.time);
    let detailed = detailed(scene, &theory)?;
    let (results, of_peaks) = results(scene, body, detailed.as_ref().unwrap_or(&theory), &bars);
    let (mut results, mut doubts) = with_panels(results, scene, &theory);
    doubts.extend(of_peaks);
    if body.is_free() {
        doubts.extend(results.still_growing([0.0, end]));
        doubts.extend(still_falling(&mut results, body, &theory));
    }
    let panels = theory.bending_flow().map(|flow| flow.panels.clone()).unwrap_or_default();
    let peak = |(name, value, time_s): (&str, f64, f64)| (name.to_string(), Peak { value, time_s, verdict: None });
    let summary = Summary {
        scene: scene.name.clone(),
        status: Status::Completed.with(&results, !doubts.is_empty()),
        model: scene.model.name(),
        choice: scene.choice.clone(),
        host: None,
        version: env!("CARGO_PKG_VERSION"),
        steps: theory.instants.len() as u64,
        time_end_s: end,
        wall_time_s: start.elapsed().as_secs_f64(),
        threads: 1,
        log: log.map(|Logged { bytes, frames, left_out }| Log {
            bytes,
            frames,
            frames_left_out: left_out,
            budget_megabytes: scene.report.log_budget,
        }),
        peaks: series.peaks().map(peak).collect(),
        means: series.means(0.8 * end).map(|(name, mean)| (name.to_string(), mean)).collect(),
        results,
        doubts,
        error_bars: bars,
        panels,
        similarity,
        comparison,
        not_compared,
        ..Summary::default()
    };
    Ok(Outcome { summary, series })
}

/// Least number of instants in a run whose peaks and impulses are results.
const LEAST_INSTANTS: f64 = 500.0;

/// The theory at more instants, where a scene's rows are few.
fn detailed(scene: &Scene, theory: &Theory) -> Result<Option<Theory>, RunError> {
    let of_mean = Averaging::of(scene, theory).filter(|_| theory.section.is_round());
    let of_mean = of_mean.map_or(f64::INFINITY, |averaging| averaging.longest_row(scene.time.end));
    let every = (scene.time.end / LEAST_INSTANTS).min(of_mean);
    if scene.time.sample_every <= every * (1.0 + 1e-9) {
        return Ok(None);
    }
    if let Some(detailed) = theory.resampled(scene.time.end, every) {
        return Ok(Some(detailed));
    }
    let mut detailed = scene.clone();
    detailed.time.sample_every = every;
    Theory::of(&detailed, scene.model).map(Some).map_err(|e| RunError::Theory(scene.model.name(), e))
}

/// Largest difference of the true value from a computed one whose error is the share `error` of the true value, over the
/// computed one [-].
fn reach(error: f64) -> f64 {
    match error < 1.0 {
        true => error / (1.0 - error) * (1.0 + 1e-9), // it may be too low
        false => 1.0,                                 // it is too high
    }
}

/// Error bars of a run by a theory: its error in the nearest measured case (THEORY EN9).
fn error_bars(scene: &Scene, body: &Body, theory: &Theory, series: &Series) -> ErrorBars {
    let bar = |want: QuantityOfInterest, path: String, value: f64| {
        let Measured { error, case } = measured(scene, theory, want)?;
        let (method, verdict) = (format!("measured in {case}"), "as far off as it was there".into());
        Some((
            path,
            ErrorBar { value, extrapolated: None, band: reach(error) * value.abs(), order: None, verdict, method },
        ))
    };
    let column = format!("{}.fy_N_per_m", body.name);
    let peak = series.peaks().find(|(name, ..)| *name == column);
    // what lasts shorter than a quoted peak is none
    let peak = peak.filter(|_| !theory.section.is_round() && theory.bending_flow().is_none());
    let force =
        peak.and_then(|(name, value, _)| bar(QuantityOfInterest::PeakForce, format!("peaks/{name}/value"), value));
    let pressure = |gauge: &Gauge| {
        let column = format!("{}.p_Pa", gauge.name);
        let (name, value, _) = series.peaks().find(|(name, ..)| *name == column)?;
        // rows that do not follow the peak, and a front that has not passed, give no peak
        let rows = series.column(name)?;
        let at = rows.iter().position(|p| *p == value)?;
        let beside = [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|k| rows.get(k));
        if beside.into_iter().any(|p| *p < BESIDE_PEAK * value) {
            return None;
        }
        bar(QuantityOfInterest::PeakPressure, format!("peaks/{name}/value"), value)
    };
    let mut pressures: Vec<(String, ErrorBar)> = scene.gauges.iter().filter_map(pressure).collect();
    if theory.model.is_formula() && body.is_free() {
        // of a drop by a formula only the largest was compared
        let largest = pressures.iter().map(|(_, bar)| bar.value).fold(f64::NEG_INFINITY, f64::max);
        pressures.retain(|(_, bar)| bar.value == largest);
    }
    force.into_iter().chain(pressures).collect()
}

/// Results of a theory.
fn results(scene: &Scene, body: &Body, theory: &Theory, bars: &ErrorBars) -> (Results, Vec<Doubt>) {
    let averaging = Averaging::of(scene, theory);
    let largest = largest(scene, body, theory, averaging.map(|averaging| averaging.time));
    let doubted = largest.and_then(|_| doubt(scene, body, theory, averaging));
    // at the contact of a flat keel sound and air decide the peaks; the impulse does not depend on them
    let at_once = theory.section.meets_at_once() || scene.entry().is_some_and(|entry| entry.is_flat());
    let of_peak = match &doubted {
        _ if at_once => Verdict::Acoustic,
        Some((verdict, _)) => *verdict,
        None => Verdict::Resolved,
    };
    let with_verdict = |verdict: Verdict, value: f64, time_s: Option<f64>, band: Option<f64>| {
        Quantity { value, time_s, band, cutoff_hz: None, raw: value, verdict, allowed: None }.with_known_band()
    };
    let quantity =
        |value: f64, time_s: Option<f64>, band: Option<f64>| with_verdict(Verdict::Resolved, value, time_s, band);
    // an acceleration and an impulse are as good as the force
    let share = measured(scene, theory, QuantityOfInterest::PeakForce).map(|found| reach(found.error));
    let is_unmeasured = averaging.is_some_and(|averaging| averaging.is_unmeasured(scene, theory));
    let of_mean = share.filter(|_| of_peak == Verdict::Resolved && !is_unmeasured);
    let peak = |Largest { mean, row }: Largest, subtracted: f64| Quantity {
        raw: row.value,
        cutoff_hz: averaging.map(|averaging| CUTOFF / averaging.time),
        ..with_verdict(of_peak, mean.value, Some(mean.time), of_mean.map(|share| share * (mean.value + subtracted)))
    };
    let free = matches!(body.motion, Motion::Free(_));
    // formulas were measured on faces alone: their force past wet chines, and the impulse with it, was not
    let of_impulse = share.filter(|_| !(theory.wets_chines() && theory.model.is_formula()));
    let mut forces = RunningIntegral::<2>::default();
    theory.instants.iter().zip(theory.motions(body)).for_each(|(now, motion)| forces.take(now.time, motion.force));
    let [x, y] = forces.total();
    let impulse = x.hypot(impulse_of_momentum(scene, body, theory).unwrap_or(y + theory.impulse_at_contact()));
    let gauges = bars.iter().filter(|(path, _)| path.ends_with(".p_Pa/value"));
    let pressure = gauges.max_by(|(_, a), (_, b)| a.value.total_cmp(&b.value));
    let all = [
        (ResultName::PeakForce, largest.map(|[force, _]| peak(force, 0.0))),
        (ResultName::PeakAcceleration, largest.filter(|_| free).map(|[_, acceleration]| peak(acceleration, 1.0))),
        (ResultName::PeakPressure, pressure.map(|(_, bar)| quantity(bar.value, None, Some(bar.band)))),
        (ResultName::Impulse, Some(quantity(impulse, None, of_impulse.map(|share| share * impulse)))),
    ];
    let body = all.into_iter().filter_map(|(name, quantity)| Some((name, quantity?))).collect();
    let results = Results { body, bandwidth_by: averaging.map(|averaging| averaging.by), ..Results::default() };
    let of_peaks = [ResultName::PeakForce, ResultName::PeakAcceleration];
    let of_peaks = of_peaks.into_iter().filter(|name| results.get(*name).is_some());
    let about = |name: ResultName| doubted.as_ref().map(|(_, why)| Doubt::about(name.name(), why.clone()));
    let doubts = of_peaks.filter_map(about).collect();
    (results, doubts)
}

/// Impulse upwards on a rigid free body, exact where the force of the first contact is shorter than the rows: m (g Δt − ΔV).
fn impulse_of_momentum(scene: &Scene, body: &Body, theory: &Theory) -> Option<f64> {
    let Motion::Free(freedom) = &body.motion else { return None };
    let (first, last) = (theory.instants.first()?, theory.instants.last()?);
    let of_water = -scene.gravity[1] * (last.time - first.time) - last.speed - body.velocity[1];
    theory.bending_flow().is_none().then_some(freedom.mass * of_water)
}

/// A largest acceleration that is downward is that of the fall.
fn still_falling(results: &mut Results, body: &Body, theory: &Theory) -> Option<Doubt> {
    let peak = results.body.get_mut(&ResultName::PeakAcceleration)?;
    let now = theory.instants.iter().position(|now| peak.time_s.is_some_and(|time| now.time >= time))?;
    let motion = theory.motions(body)[now];
    if motion.acceleration[1] >= 0.0 {
        return None;
    }
    *peak = Quantity { band: None, verdict: Verdict::NotResolved, ..*peak };
    Some(Doubt::about(ResultName::PeakAcceleration.name(), OF_FREE_FALL.to_string()))
}

/// The same with those of panels that bend in a flow that was followed, and doubts about them.
fn with_panels(mut results: Results, scene: &Scene, theory: &Theory) -> (Results, Doubts) {
    let mut doubts = Doubts::default();
    let error = measured(scene, theory, QuantityOfInterest::Strain).map(|found| reach(found.error));
    for peak in theory.bending_flow().iter().flat_map(|flow| &flow.stresses) {
        let (of_panel, reasons) = panel_results_within(peak, error);
        doubts.extend(reasons.into_iter().map(|why| Doubt::about(&peak.name, why)));
        results.panels.insert(peak.name.clone(), of_panel);
    }
    let Some(flow) = theory.bending_flow() else { return (results, doubts) };
    if let Some([from, share]) = flow.suction {
        let (since, share) = (significant(from), significant(100.0 * share));
        let why =
            format!("from t = {since} s on suction takes up to {share} % of the largest force off: air would come in");
        let later = |quantity: &Quantity| quantity.time_s.is_none_or(|time| time >= from);
        for (name, quantity) in results.body.iter_mut().filter(|(_, quantity)| later(quantity)) {
            quantity.verdict = Verdict::NotResolved;
            doubts.extend([Doubt::about(name.name(), why.clone())]);
        }
        doubts.extend(unresolved(&mut results, later, &why));
    }
    let end = AT_END * theory.instants.last().map_or(f64::INFINITY, |now| now.time);
    let why = "the largest stress comes at the end of the run and may go on growing: a later time.end would show it";
    doubts.extend(unresolved(&mut results, |quantity| quantity.time_s.is_some_and(|time| time >= end), why));
    let last = scene.body.as_ref().and_then(|body| theory.motions(body).last().copied());
    doubts.extend(last.and_then(|now| results.not_passed(&scene.panels_not_passed(&now))));
    (results, doubts)
}

/// Share of the run after which a largest stress may go on growing [-].
const AT_END: f64 = 0.995;

/// Results of panels that are not resolved, and a doubt about each panel.
fn unresolved(results: &mut Results, is: impl Fn(&Quantity) -> bool, why: &str) -> Vec<Doubt> {
    let mut doubts = Vec::new();
    for (panel, of_panel) in &mut results.panels {
        let found: Vec<&mut Quantity> = of_panel.values_mut().filter(|quantity| is(quantity)).collect();
        if !found.is_empty() {
            doubts.push(Doubt::about(panel, why.to_string()));
        }
        found.into_iter().for_each(|quantity| quantity.verdict = Verdict::NotResolved);
    }
    doubts
}

/// Poses of the body, and its curves.
fn write_log(scene: &Scene, body: &Body, theory: &Theory, path: &std::path::Path) -> Result<Logged, ObserveError> {
    let mut log = create_log(path, scene)?;
    let outline = body.shape.outline();
    let mut next = 0.0;
    for (k, (now, motion)) in theory.instants.iter().zip(theory.motions(body)).enumerate() {
        log.sample(now.time, &format!("body/{}", body.name), &body_values(&motion))?;
        let last = k + 1 == theory.instants.len();
        if now.time >= next || last {
            next = scene.time.frame_every * ((now.time / scene.time.frame_every + 1e-9).floor() + 1.0);
            let view = BodyView { name: &body.name, position: motion.position, angle: motion.angle, outline: &outline };
            log.frame(Frame::new(now.time, &[], &[], &[view])?, last)?;
        }
    }
    Ok(log.finish()?)
}

/// The similarity solution's numbers, by this theory.
fn similarity(scene: &Scene, theory: &Theory, exact: Option<&WedgeSimilarity>) -> Option<SimilarityResult> {
    let rho = scene.water().density;
    let over = |i: &Instant| i.force / (rho * i.speed.powi(2) * i.draught);
    let late: Vec<usize> = theory.late().collect();
    let (first, last) = (*late.first()?, *late.last()?);
    let coefficients: Vec<f64> = late.iter().map(|&k| over(&theory.instants[k])).collect();
    let [mean, sd] = mean_and_deviation(&coefficients);
    let Instant { draught, speed, .. } = theory.instants[last];
    let dynamic = 0.5 * rho * speed * speed;
    let [peak, place] = theory.peak_pressure(last).unwrap_or([f64::NAN; 2]);
    let tan = theory.section.slope(0.0);
    let profile = theory.profile(last, PROFILE);
    let finite = theory.peak_pressure(last).is_some();
    let error = exact.filter(|_| finite).map(|e| e.profile_error(&profile, 0.8 * std::f64::consts::FRAC_PI_2 / tan));
    let z = place * tan / draught - 1.0;
    Some(SimilarityResult {
        window_s: [theory.instants[first].time, theory.instants[last].time],
        draught_m: draught,
        spacings_per_draught: f64::INFINITY,
        force_coefficient: mean,
        force_coefficient_sd: sd,
        cp_max: peak / dynamic,
        cp_max_unresolved: None,
        cp_max_sd: 0.0,
        cp_max_of_mean: peak / dynamic,
        z_max_over_vt: z,
        profile_error: error,
        profile_error_snapshot: error,
        cp_noise: None,
        z_max_error: exact.filter(|_| finite).map(|e| (z - e.z_max_over_vt) / e.z_max_over_vt.abs()),
        impulse_coefficient: mean,
        profile,
    })
}
