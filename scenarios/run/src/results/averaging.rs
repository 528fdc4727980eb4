//! Times over which peaks are averaged (THEORY GE18).

use scene::vocabulary::{BandwidthBy, CUTOFF};
use scene::{Bottom, Entry, Scene};
use settings::significant;

/// Time that a spacing resolves, in times that the body takes to fall through it (GE18) [-].
const WINDOW: f64 = 3.0;
/// Averaging time over the time in which a wedge falls to the draught of its largest force [-].
const SHARE_OF_RISE: f64 = 0.1;
/// Averaging time of a round bottom over R/V [-].
const SHARE_OF_RADIUS: f64 = 0.015;
/// Times that differ by less are equal [-].
const EQUAL: f64 = 1e-9;

/// Averaging time of a peak.
#[derive(Clone, Copy, Debug)]
pub(super) struct Averaging {
    /// The time τ [s].
    pub time: f64,
    /// The shortest that the spacing resolves [s].
    pub least: f64,
    pub by: BandwidthBy,
}

impl Averaging {
    /// Of forces and accelerations. `speed`: with which rows of particles are met [m/s]; `air`: averaging time under trapped air [s].
    pub fn of_force(scene: &Scene, entry: Option<&Entry>, speed: f64, air: Option<f64>) -> Averaging {
        let least = WINDOW * scene.resolution.spacing / speed;
        match (scene.report.bandwidth, air) {
            (Some(bandwidth), _) => Averaging { time: CUTOFF / bandwidth, least, by: BandwidthBy::Scene },
            (None, Some(time)) => Averaging { time, least: time, by: BandwidthBy::Air },
            (None, None) => match entry.and_then(time_of_impact).filter(|time| *time >= least) {
                Some(time) => Averaging { time, least, by: BandwidthBy::Impact },
                None => Averaging { time: least, least, by: BandwidthBy::Spacing },
            },
        }
    }

    /// Of pressures, which the spray root passes at `speed` [m/s].
    pub fn of_pressure(scene: &Scene, speed: f64, air: Option<f64>) -> Averaging {
        let least = air.unwrap_or(WINDOW * scene.resolution.spacing / speed);
        match scene.report.pressure_bandwidth {
            Some(bandwidth) => Averaging { time: CUTOFF / bandwidth, least, by: BandwidthBy::Scene },
            None if air.is_some() => Averaging { time: least, least, by: BandwidthBy::Air },
            None => Averaging { time: least, least, by: BandwidthBy::Spacing },
        }
    }

    /// True where the averaging time does not change with the spacing, so that neither does what it takes off a peak.
    pub fn is_fixed(self) -> bool {
        matches!(self.by, BandwidthBy::Scene | BandwidthBy::Impact)
    }

    /// Why there is no mean in a run that is too short for it.
    pub fn longer_than_run(self, key: &str) -> String {
        let [time, bandwidth] = [self.time, CUTOFF / self.time].map(significant);
        format!(
            "the run is shorter than the time of its mean, {time} s: set a later time.end, or report.{key} above {bandwidth} Hz"
        )
    }

    /// Why a bandwidth that a scene asks for is not resolved.
    pub fn too_short(self, key: &str, spacing: f64) -> Option<String> {
        (self.time < self.least * (1.0 - EQUAL)).then(|| {
            format!(
                "report.{key} asks for {} Hz; the spacing resolves {} Hz: {} m would do for resolution.spacing",
                significant(CUTOFF / self.time),
                significant(CUTOFF / self.least),
                significant(spacing * self.time / self.least)
            )
        })
    }
}

/// A time that resolves the force of an impact, whatever the spacing [s]; `None` under flat bottoms, which meet the water at once.
pub fn time_of_impact(entry: &Entry) -> Option<f64> {
    match entry.bottom {
        _ if entry.is_flat() => None,
        Bottom::Arc { radius } => Some(SHARE_OF_RADIUS * radius / entry.speed),
        _ => Some(SHARE_OF_RISE * entry.peak_draught.min(entry.final_draught) / entry.attached_speed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load;

    fn averaging(scene: &str, sets: &[&str]) -> Averaging {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        let scene = load(scene, &sets).expect("a scene").scene;
        let entry = scene.entry().expect("an entry");
        Averaging::of_force(&scene, Some(&entry), entry.attached_speed, None)
    }

    #[test]
    fn the_bandwidth_of_an_impact_is_the_same_at_each_fine_spacing() {
        let at = |spacing: &str| averaging("wedge", &[&format!("resolution.spacing={spacing}")]);
        let [fine, finer, coarse] = ["0.0015", "0.001", "0.01"].map(at);
        assert_eq!((fine.by, finer.by, coarse.by), (BandwidthBy::Impact, BandwidthBy::Impact, BandwidthBy::Spacing));
        assert_eq!(fine.time, finer.time);
        assert!(coarse.time > fine.time && finer.least < fine.least);
    }

    #[test]
    fn a_bandwidth_that_the_spacing_does_not_resolve_is_named() {
        let at = |set: &str| averaging("wedge", &["resolution.spacing=0.01", set]);
        let asked = at("report.bandwidth=50");
        assert!((asked.time - CUTOFF / 50.0).abs() < 1e-15 && asked.too_short("bandwidth", 0.01).is_none());
        let why = at("report.bandwidth=1000").too_short("bandwidth", 0.01).expect("too fine");
        assert!(why.contains("report.bandwidth asks for 1000 Hz") && why.contains("resolution.spacing"), "{why}");
    }
}
