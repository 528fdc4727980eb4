//! Judges the results: over which time they are averaged, how wide their bands are, and what may be said of them (THEORY GE18–GE20).

use scene::validity::air::{air_pulse, flat_finding};
use scene::validity::compressibility::lost_beyond;
use scene::validity::first_contact::{RoundContact, wet_start};
use scene::validity::panels::{StressPeak, panel_results};
use scene::validity::resolution::{Depth, LEAST_DRAUGHT, pressure_share};
use scene::validity::tension::with_tension;
use scene::vocabulary::{CUTOFF, Doubt, Doubts, Finding, Named, Quantity, ResultName, Results, Verdict, WIDE, Why};
use scene::{Body, Bottom, Entry, Scene, Unusual, limit_of_forces, resonant_panels, share_of_walls};
use serde::{Deserialize, Serialize};
use settings::significant;

use super::averaging::Averaging;
use super::running_integral::{Extreme, RunningIntegral};
use super::{OF_FREE_FALL, OF_SUCTION, OF_UNRESOLVED_FALL, STANDARD_GRAVITY};

/// Largest acceleration of a body that still falls over gravity [-].
const FALLING: f64 = 1.03;
/// Factors in the band of a peak on its drop when the averaging time is doubled, of wedges and of round bottoms (GE19, GE20), each weakly
/// compressible and incompressible [-]: a third of the drop is what the time of averaging takes off a parabola.
const SMOOTHING: [[f64; 2]; 2] = [[0.65, 1.0], [1.0, 1.5]];
/// Factor in the bands of forces and impulses on panels that bend: on 14 set-ups up to 1.2 of the rigid body's were needed [-].
const SOFT: f64 = 1.3;
/// Largest ratio of a single step's value to the mean [-].
const LARGEST_RAW: f64 = 2.0;

/// The curves of the results, with the values of every step.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Curves {
    /// Force of the water on the body [N/m].
    pub force: RunningIntegral<2>,
    /// Force of the water on the body where it pulls [N/m].
    pub tension: RunningIntegral<2>,
    /// Acceleration of the body's frame [m/s²]; without values for a body that is not free.
    pub acceleration: RunningIntegral<2>,
    /// Time [s] and depth of the body's lowest point [m].
    pub draught: Vec<[f64; 2]>,
    /// Pressure of each gauge [Pa].
    pub pressures: Vec<RunningIntegral<1>>,
    /// Largest stress along each panel [Pa].
    pub stresses: Vec<RunningIntegral<1>>,
}

impl Curves {
    /// Depth of the body's lowest point [m] at a time [s].
    fn draught_at(&self, time: f64) -> f64 {
        let k = self.draught.partition_point(|row| row[0] < time).min(self.draught.len().saturating_sub(1));
        self.draught.get(k).map_or(0.0, |row| row[1])
    }
}

/// What a scene's results are judged by.
pub(super) struct Judge {
    pub(super) spacing: f64,
    /// Averaging times of forces, and of pressures.
    pub(super) of_force: Averaging,
    of_pressure: Averaging,
    entry: Option<Entry>,
    /// Magnitude of gravity [m/s²].
    gravity: f64,
    /// Speed of sound; `None` where water is incompressible [m/s].
    pub(super) sound_speed: Option<f64>,
    /// Averaging time and end of the pulse [s] under a flat bottom that traps air.
    pub(super) air: Option<[f64; 2]>,
    /// Why no force of the run can be relied on, where that is so.
    limit: Option<String>,
    /// Panels that vibrate with the water's sound, and why.
    resonant: Vec<(String, String)>,
    /// Factor in the bands of force and impulse, more than 1 on panels that bend [-].
    of_panels: f64,
    /// Share that walls take of forces in incompressible water [-].
    of_walls: f64,
    /// Keys of the method with which no band was measured, in words.
    unusual: Vec<String>,
}

impl Judge {
    pub fn new(scene: &Scene) -> Judge {
        let entry = scene.entry().filter(|entry| entry.final_draught > 0.0);
        let speed = entry.map_or_else(|| scene.fastest_speed(), |entry| entry.attached_speed);
        let of_root = entry.map_or(speed, |entry| entry.root_speed().max(entry.speed));
        let air = entry.and_then(|entry| air_pulse(scene, &entry));
        let of_air = air.map(|[time, _]| time);
        Judge {
            spacing: scene.resolution.spacing,
            of_force: Averaging::of_force(scene, entry.as_ref(), speed, of_air),
            of_pressure: Averaging::of_pressure(scene, of_root, of_air),
            entry,
            gravity: scene.gravity[0].hypot(scene.gravity[1]),
            sound_speed: (!scene.solver.is_incompressible()).then(|| scene.sound_speed()),
            air,
            limit: limit_of_forces(scene),
            resonant: resonant_panels(scene),
            of_panels: if scene.all_bodies().any(Body::bends) { SOFT } else { 1.0 },
            of_walls: share_of_walls(scene),
            unusual: scene.unusual_keys(&[]).iter().map(Unusual::words).collect(),
        }
    }

    /// The results, and doubts about them.
    pub fn results(&self, curves: &Curves, panels: &[StressPeak]) -> (Results, Doubts) {
        let mut doubts = Doubts::default();
        let mut body = Named::new();
        let mut keep = |name: ResultName, found: Option<(Quantity, Option<Why>)>| {
            let Some((quantity, why)) = found else { return };
            let wide = quantity.verdict == Verdict::Resolved && quantity.is_withheld();
            let why = why.or(wide.then(|| WIDE.into()));
            doubts.extend(why.map(|why| Doubt::about(name.name(), why)));
            body.insert(name, quantity.with_known_band());
        };
        let window = self.of_force.time;
        let by_force = |peak: Extreme, raw: Extreme| {
            let mean = |curve: &RunningIntegral<2>| curve.mean_about(peak.time, window).unwrap_or_default();
            let force = mean(&curves.force);
            with_tension(self.force_finding(curves, window, [peak, raw], force[1]), mean(&curves.tension), force)
        };
        let force = self.peak(&curves.force, (self.of_force, "bandwidth"), [1.0, 0.0], &by_force);
        let known = force.as_ref().is_some_and(|(quantity, _)| quantity.verdict == Verdict::Resolved);
        let by_acceleration = |peak: Extreme, raw: Extreme| {
            let dry = curves.draught_at(peak.time) <= self.spacing;
            let falls = dry && self.gravity > 0.0 && peak.value <= FALLING * self.gravity; // before the water carries it
            if !falls {
                return by_force(peak, raw);
            }
            let why = if known { OF_FREE_FALL } else { OF_UNRESOLVED_FALL };
            (Verdict::NotResolved, None, Some(why.into()))
        };
        let unit = [1.0 / STANDARD_GRAVITY, self.gravity];
        let acceleration = self.peak(&curves.acceleration, (self.of_force, "bandwidth"), unit, &by_acceleration);
        let pressure = self.peak_pressure(curves);
        let impulse = curves.force.largest().map(|_| self.impulse(curves));
        let of_force = force.as_ref().map(|(quantity, _)| *quantity);
        keep(ResultName::PeakForce, force);
        keep(ResultName::PeakAcceleration, acceleration);
        keep(ResultName::PeakPressure, pressure);
        keep(ResultName::Impulse, impulse);
        let panels = panels.iter().enumerate().map(|(k, panel)| {
            let resonates = self.resonant.iter().find(|(name, _)| *name == panel.name).map(|(_, why)| why.as_str());
            // GE18 averages over spacings that an entering body falls through: elsewhere a plate may vibrate faster
            let stress = curves.stresses.get(k).filter(|_| self.entry.is_some());
            let mean = stress.and_then(|curve| curve.largest_mean(self.of_force.least));
            let (results, reasons) = panel_results(panel, of_force, mean.map(|mean| mean.value), resonates);
            doubts.extend(reasons.into_iter().map(|why| Doubt::about(&panel.name, why)));
            (panel.name.clone(), results)
        });
        let (panels, bandwidth_by) = (panels.collect(), of_force.map(|_| self.of_force.by));
        let results = Results { body, bandwidth_by, panels };
        let results = match self.unusual.is_empty() {
            true => results,
            false => results.without_bands(&self.unusual, &mut doubts),
        };
        (results, doubts)
    }

    /// The largest mean of a curve times a factor; its band's share is of the value and what is subtracted in it. `None`
    /// without a curve.
    fn peak<const N: usize>(
        &self,
        curve: &RunningIntegral<N>,
        (averaging, key): (Averaging, &str),
        [factor, subtracted]: [f64; 2],
        finding: &dyn Fn(Extreme, Extreme) -> Finding,
    ) -> Option<(Quantity, Option<Why>)> {
        let (raw, window) = (curve.largest()?, averaging.time);
        let Some(mean) = curve.largest_mean(window) else {
            let (value, why) = (factor * raw.value, averaging.longer_than_run(key));
            let quantity = Quantity {
                value,
                time_s: Some(raw.time),
                band: None,
                cutoff_hz: None,
                raw: value,
                verdict: Verdict::NotResolved,
                allowed: None,
            };
            return Some((quantity, Some(why.into())));
        };
        // GE19: what twice the time takes off the peak, where the time follows the spacing
        let twice = curve.largest_mean(2.0 * window).map_or(0.0, |longer| longer.value);
        let round = matches!(self.entry, Some(Entry { bottom: Bottom::Arc { .. }, .. }));
        let solver = usize::from(self.sound_speed.is_none());
        let times = if averaging.is_fixed() { 0.0 } else { SMOOTHING[usize::from(round)][solver] };
        let smoothed = times * (mean.value - twice).max(0.0);
        let (verdict, band, why) = match averaging.too_short(key, self.spacing) {
            Some(why) => (Verdict::NotResolved, None, Some(why.into())),
            None => finding(mean, raw),
        };
        let quantity = Quantity {
            value: factor * mean.value,
            time_s: Some(mean.time),
            band: band.map(|share| factor * (share * (mean.value + subtracted) + smoothed)),
            cutoff_hz: Some(CUTOFF / window),
            raw: factor * raw.value,
            verdict,
            allowed: None,
        };
        Some((quantity, why))
    }

    /// What may be said of a force, or of an acceleration.
    fn force_finding(&self, curves: &Curves, window: f64, [peak, raw]: [Extreme; 2], lift: f64) -> Finding {
        if let Some(why) = &self.limit {
            return (Verdict::NotResolved, None, Some(why.clone().into()));
        }
        let Some(entry) = &self.entry else { return self.unforeseen(curves, peak, raw) };
        if lift < 0.0 {
            return (Verdict::NotResolved, None, Some(OF_SUCTION.into()));
        }
        if entry.is_flat() {
            return self.flat(curves, entry, peak);
        }
        if let Some([start, draught]) = curves.draught.first().filter(|[_, draught]| *draught > self.spacing)
            && peak.time < start + 2.0 * window
        {
            return wet_start(*draught);
        }
        if let Bottom::Arc { radius } = entry.bottom {
            let gap = -curves.draught.first().map_or(0.0, |row| row[1]);
            let (spacing, sound_speed) = (self.spacing, self.sound_speed);
            return RoundContact { radius, gap, window, spacing, sound_speed }.finding(entry);
        }
        let found = self.by_draught(curves, entry, peak);
        if found.0 == Verdict::Resolved { self.spike(window, peak, raw).unwrap_or(found) } else { found }
    }

    fn flat(&self, curves: &Curves, entry: &Entry, peak: Extreme) -> Finding {
        let contact = curves.draught.iter().find(|[_, draught]| *draught > 0.0).map_or(0.0, |[time, _]| *time);
        flat_finding(entry, self.spacing, self.air.map(|[_, end]| contact + end), peak.time)
    }

    fn depth(&self, draught: f64) -> Depth {
        Depth { draught, spacing: self.spacing, incompressible: self.sound_speed.is_none() }
    }

    /// Verdict and band by the draught at the peak (GE19): the run's, and no more than the theory's (GE22).
    fn by_draught(&self, curves: &Curves, entry: &Entry, peak: Extreme) -> Finding {
        let draught = curves.draught_at(peak.time).min(entry.peak_draught);
        let share = match self.depth(draught).force_share(entry) {
            Ok(share) => share,
            Err(why) => return (Verdict::NotResolved, None, Some(why)),
        };
        match lost_beyond(self.sound_speed, entry) {
            Ok(lost) => (Verdict::Resolved, Some(self.of_panels * share + lost + self.of_walls), None),
            Err(why) => (Verdict::Acoustic, None, Some(why)),
        }
    }

    /// What may be said of a peak that no theory of entry foresees: of a body that comes from the air, as much as its draught allows.
    fn unforeseen(&self, curves: &Curves, peak: Extreme, raw: Extreme) -> Finding {
        match self.shallow(curves, curves.draught_at(peak.time)) {
            Some(why) => (Verdict::NotResolved, None, Some(why)),
            None => self.spike(f64::INFINITY, peak, raw).unwrap_or((Verdict::Resolved, None, None)),
        }
    }

    /// A body that comes from the air and is too little in the water.
    fn shallow(&self, curves: &Curves, draught: f64) -> Option<Why> {
        let from_air = curves.draught.first().is_some_and(|row| row[1] <= self.spacing);
        let spacings = draught / self.spacing;
        (from_air && spacings > 0.0 && spacings < LEAST_DRAUGHT)
            .then(|| Why::shallow("it comes at a draught of", spacings, format!("{LEAST_DRAUGHT} are needed")))
    }

    /// Single steps within the time of the mean that reach far above it.
    fn spike(&self, window: f64, peak: Extreme, raw: Extreme) -> Option<Finding> {
        let within = (raw.time - peak.time).abs() <= 0.5 * window;
        (within && raw.value > LARGEST_RAW * peak.value).then(|| {
            let ratio = significant(raw.value / peak.value);
            let (verdict, cause) = match self.sound_speed {
                Some(c) => (Verdict::Acoustic, format!("sound of {} m/s acts on them", significant(c))),
                None => (Verdict::NotResolved, "the mean depends on them: use a finer spacing, or the impulse".into()),
            };
            (verdict, None, Some(format!("single steps reach {ratio} times the mean: {cause}").into()))
        })
    }

    /// The gauge with the largest peak.
    fn peak_pressure(&self, curves: &Curves) -> Option<(Quantity, Option<Why>)> {
        let finding = |peak: Extreme, raw: Extreme| {
            let Some(entry) = &self.entry else { return self.unforeseen(curves, peak, raw) };
            if entry.is_flat() {
                return self.flat(curves, entry, peak);
            }
            let (verdict, _, why) = self.by_draught(curves, entry, peak);
            if verdict != Verdict::Resolved {
                return (verdict, None, why);
            }
            let draught = curves.draught_at(peak.time);
            let spacings = entry.peak_length_at(draught) / self.spacing;
            let tip = self.depth(draught).tip_share(entry);
            match pressure_share(spacings) {
                Ok(share) => (Verdict::Resolved, Some(share.max(tip)), None),
                Err(why) => (Verdict::NotResolved, None, Some(why)),
            }
        };
        let each = curves
            .pressures
            .iter()
            .filter_map(|curve| self.peak(curve, (self.of_pressure, "pressure_bandwidth"), [1.0, 0.0], &finding));
        each.max_by(|(a, _), (b, _)| a.value.total_cmp(&b.value))
    }

    /// The impulse over the run: an integral averages by itself. That of a flat contact has no known band.
    fn impulse(&self, curves: &Curves) -> (Quantity, Option<Why>) {
        let [x, y] = curves.force.total();
        let value = x.hypot(y);
        let deepest = curves.draught.iter().fold(0.0_f64, |deepest, row| deepest.max(row[1]));
        let entry = self.entry.filter(|entry| !entry.is_flat() && value > 0.0);
        let of_depth = |entry: &Entry| self.depth(deepest).impulse_share(entry);
        let lost = |entry: &Entry| match entry.bottom {
            Bottom::Arc { .. } => Ok::<_, Why>(0.0), // its root is fast at first contact alone
            _ => lost_beyond(self.sound_speed, entry),
        };
        let with_lost = |entry| Ok::<_, Why>(self.of_panels * of_depth(&entry)? + lost(&entry)? + self.of_walls);
        let share = entry.map(with_lost);
        let (share, why) = match (&self.limit, share) {
            (Some(limit), _) => (None, Some(limit.as_str().into())),
            (None, Some(Err(why))) => (None, Some(why)),
            (None, Some(Ok(share))) => (Some(share), None),
            (None, None) => (None, self.shallow(curves, deepest).filter(|_| self.entry.is_none())),
        };
        let verdict = if why.is_some() { Verdict::NotResolved } else { Verdict::Resolved };
        let (verdict, share, why) = with_tension((verdict, share, why), curves.tension.total(), curves.force.total());
        let band = share.map(|share| share * curves.force.largest_and_later());
        (Quantity { value, time_s: None, band, cutoff_hz: None, raw: value, verdict, allowed: None }, why)
    }
}

#[cfg(test)]
mod tests {
    use scene::vocabulary::BandwidthBy;

    use super::*;

    /// A judge of a flow that no theory foresees.
    fn still() -> Judge {
        let of_force = Averaging { time: 0.3, least: 0.3, by: BandwidthBy::Spacing };
        let (limit, air, resonant, unusual, of_walls) = (None, None, Vec::new(), Vec::new(), 0.0);
        let (spacing, gravity, of_pressure, of_panels) = (0.1, 9.81, of_force, 1.0);
        Judge {
            spacing,
            of_force,
            of_pressure,
            entry: None,
            gravity,
            sound_speed: None,
            air,
            limit,
            resonant,
            unusual,
            of_panels,
            of_walls,
        }
    }

    /// A force of 1 N/m for a second, with a step of 0.01 s that is larger by this factor.
    fn judged(spike: f64, sound_speed: Option<f64>) -> Quantity {
        let mut curves = Curves::default();
        for k in 0..=100 {
            curves.force.take(0.01 * f64::from(k), [0.0, if k == 50 { spike } else { 1.0 }]);
        }
        let judge = Judge { sound_speed, ..still() };
        judge.results(&curves, &[]).0.get(ResultName::PeakForce).expect("a force")
    }

    /// A steady force of 1 N/m, with tension that takes a share off it.
    #[test]
    fn tension_widens_the_band_of_a_force_and_beyond_a_twentieth_refuses_it() {
        let judged = |share: f64| {
            let mut curves = Curves::default();
            for k in 0..=100 {
                curves.force.take(0.01 * f64::from(k), [0.0, 1.0]);
                curves.tension.take(0.01 * f64::from(k), [0.3, -share]);
            }
            let judge = Judge { sound_speed: Some(40.0), ..still() };
            judge.results(&curves, &[])
        };
        let verdict = |share: f64| judged(share).0.get(ResultName::PeakForce).expect("a force").verdict;
        assert_eq!(
            (verdict(0.049), verdict(0.051), verdict(-2.0)),
            (Verdict::NoBand, Verdict::NotResolved, Verdict::NoBand)
        );
        let (results, doubts) = judged(0.08);
        assert_eq!(results.get(ResultName::Impulse).expect("an impulse").verdict, Verdict::NotResolved);
        let doubt = doubts.iter().next().map(Doubt::to_string).unwrap_or_default();
        assert!(doubt.contains("8 %") && doubt.contains("fluid.cavitation_pressure"), "{doubt}");
    }

    #[test]
    fn a_step_far_above_its_mean_is_not_resolved() {
        assert_eq!(judged(1.5, None).verdict, Verdict::NoBand);
        assert_eq!(judged(5.0, None).verdict, Verdict::NotResolved);
        assert_eq!(judged(5.0, Some(40.0)).verdict, Verdict::Acoustic);
    }
}
