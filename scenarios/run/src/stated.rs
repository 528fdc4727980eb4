//! Numbers that stand beside the results, never instead: loads that rules state (THEORY RU1–RU5), and the share of the loads of a section between
//! free ends (THEORY RU6–RU8).

use scene::vocabulary::ResultName;
use scene::{Entry, Motion, Rule, Scene};
use settings::significant;
use water_entry::finite_span::{Ends, Factor};
use water_entry::rules::{self, CHINE, Hull, OutsideRule};

use crate::observers::Series;
use crate::results::STANDARD_GRAVITY;
use crate::stated_numbers::{FiniteLength, RuleLoad, Share};
use crate::summary::Summary;

/// Wetted half width over the half breadth from which chines count as wet [-]: the peak of a wedge comes as its root reaches them, and that of
/// particles, a mean over a time, a little later.
const WET: f64 = 1.05;

/// The wetted bottom in a run.
struct Wetting {
    entry: Entry,
    times: Vec<f64>,
    draughts: Vec<f64>,
}

impl Wetting {
    fn of(scene: &Scene, series: &Series) -> Option<Wetting> {
        let (entry, body) = (scene.entry()?, scene.body.as_ref()?);
        let heights = series.column(&format!("{}.y_m", body.name))?;
        let draught = |y: f64| body.draught() + body.position[1] - y;
        Some(Wetting { entry, times: series.times(), draughts: heights.into_iter().map(draught).collect() })
    }

    fn draught_at(&self, time: f64) -> Option<f64> {
        let after = self.times.partition_point(|t| *t < time);
        let last = self.times.len().checked_sub(1)?;
        let (from, to) = (after.saturating_sub(1).min(last), after.min(last));
        let step = self.times[to] - self.times[from];
        let share = if step > 0.0 { ((time - self.times[from]) / step).clamp(0.0, 1.0) } else { 0.0 };
        Some(self.draughts[from] + share * (self.draughts[to] - self.draughts[from]))
    }

    /// Half width that Wagner's theory wets at a draught [m], past the chines too.
    fn half_width(&self, draught: f64) -> f64 {
        self.entry.bottom.wetted_half_width(draught.max(0.0))
    }

    /// Wetted breadth on the body [m]; `None` of a dry one.
    fn breadth(&self, draught: f64) -> Option<f64> {
        let half = self.half_width(draught).min(self.entry.half_breadth);
        (half > 0.0).then_some(2.0 * half)
    }

    /// The same while it grows: `None` past wet chines.
    fn growing_breadth(&self, draught: f64) -> Option<f64> {
        self.breadth(draught).filter(|_| self.half_width(draught) <= WET * self.entry.half_breadth)
    }
}

/// Writes both into a summary.
pub(crate) fn add(scene: &Scene, summary: &mut Summary, series: &Series) {
    if !summary.status.is_completed() {
        return;
    }
    let wetting = Wetting::of(scene, series);
    summary.ends = scene.report.length.and_then(|length| ends(length, summary, wetting.as_ref()?));
    summary.rule_loads = scene.rule.map_or(Vec::new(), |rule| loads(&rule, scene, summary, wetting.as_ref()));
}

fn ends(length: f64, summary: &Summary, wetting: &Wetting) -> Option<FiniteLength> {
    let share = |value: f64, breadth: f64, of: fn(&Ends) -> Factor| {
        let ends = Ends::of_aspect_ratio(length / breadth);
        let Factor { value: factor, band } = of(&ends);
        let whole = value * length * factor;
        Share { factor, band, wetted_breadth_m: breadth, aspect_ratio: ends.aspect_ratio, whole }
    };
    let known = |name| summary.results.get(name).filter(|result| result.shown().is_some());
    let peak_force = known(ResultName::PeakForce).and_then(|force| {
        let time = force.time_s?;
        Some(share(force.value, wetting.growing_breadth(wetting.draught_at(time)?)?, |ends| ends.force))
    });
    let deepest = wetting.draughts.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let impulse = known(ResultName::Impulse)
        .and_then(|impulse| Some(share(impulse.value, wetting.growing_breadth(deepest)?, |ends| ends.impulse)));
    Some(FiniteLength { length_m: length, peak_force, impulse })
}

fn loads(rule: &Rule, scene: &Scene, summary: &Summary, wetting: Option<&Wetting>) -> Vec<RuleLoad> {
    let result = |name| summary.results.get(name).and_then(|result| Some((result.shown()?, result.time_s)));
    let force = result(ResultName::PeakForce);
    let mean = force.and_then(|(force, time)| {
        let breadth = wetting?.breadth(wetting?.draught_at(time?)?)?;
        Some((force / breadth, format!("peak force over the wetted breadth of {} m", significant(breadth))))
    });
    let peak = result(ResultName::PeakPressure).map(|(value, _)| (value, "peak pressure of a gauge".to_string()));
    let body = scene.body.as_ref();
    let mass = body.and_then(|body| match &body.motion {
        Motion::Free(freedom) => Some(freedom.mass),
        _ => None,
    });
    let factor = force.zip(mass).map(|((force, _), mass)| {
        (force / (mass * STANDARD_GRAVITY), "peak force over the weight of the section".to_string())
    });
    let keel = body.map_or(0.0, |body| body.keel_deadrise_deg());
    let step = rule.step_deadrise_deg.unwrap_or(keel);
    let mut all = Vec::new();
    let mut add =
        |paragraph: &str, load: &str, unit: &str, value: Result<f64, OutsideRule>, computed: Option<(f64, String)>| {
            let (value, reason) = match value {
                Ok(value) => (Some(value), None),
                Err(outside) => (None, Some(outside.to_string())),
            };
            let (computed, computed_is) = computed.unzip();
            all.push(RuleLoad {
                paragraph: paragraph.into(),
                load: load.into(),
                unit: unit.into(),
                value,
                reason,
                computed,
                computed_is,
            });
        };
    if let Some(speed) = rule.takeoff_speed {
        let at_keel = rules::keel_pressure(speed, keel, rule.k2);
        add("25.533(b)(1)", "local pressure at the keel", "Pa", at_keel.clone(), peak);
        add("25.533(b)(1)", "local pressure at the chine, unflared", "Pa", at_keel.map(|keel| CHINE * keel), None);
        add(
            "25.533(b)(2)",
            "local pressure at the chine, flared",
            "Pa",
            rules::flared_chine_pressure(speed, keel, rule.k2),
            None,
        );
        if let Some(mass) = rule.takeoff_mass {
            add("25.531(b)", "load factor, take-off", "-", rules::takeoff_load_factor(speed, mass, step), None);
        }
    }
    if let Some((landing_speed, mass)) = rule.landing_speed.zip(rule.landing_mass) {
        let hull = Hull { landing_speed, mass, step_deadrise_deg: step };
        let of_step = hull.step_load_factor();
        add("25.533(c)(1)", "distributed pressure, symmetrical", "Pa", hull.distributed_pressure(keel, rule.k2), mean);
        add("25.527(a)(1)", "water reaction over weight, step landing", "-", of_step.clone(), factor);
        let part = |k: usize| of_step.clone().and_then(|whole| Ok(whole * rules::unsymmetrical(step)?[k]));
        add("25.529(b)(1)", "its upward part, unsymmetrical landing", "-", part(0), None);
        add("25.529(b)(1)", "its side part, unsymmetrical landing", "-", part(1), None);
    }
    if let Some((load_factor, mass)) = rule.limit_load_factor.zip(rule.rotorcraft_mass) {
        let of = |load: fn(&rules::FloatLanding) -> f64| {
            rules::float_landing(load_factor, mass, rule.floats).map(|loads| load(&loads))
        };
        add("29.521(a)(1)", "vertical load of the floats", "N", of(|loads| loads.vertical), None);
        add("29.521(a)(2)", "aft load with it", "N", of(|loads| loads.aft), None);
        add(
            "29.521(b)(1)",
            "vertical load of each float, side load condition",
            "N",
            of(|loads| loads.vertical_each),
            None,
        );
        add("29.521(b)(2)", "side load on one float", "N", of(|loads| loads.side), None);
        let speed = scene.entry().map(|entry| (entry.speed, "vertical speed at contact".to_string()));
        add("29.563(a)", "limit vertical speed in a ditching, at least", "m/s", Ok(rules::DITCHING_VERTICAL), speed);
    }
    all
}
