//! Judges the results of panels (THEORY GE19).

use fsi_coupling::{ModesState, PanelState};

use super::{PanelResults, Quantity, Verdict};
use crate::scene::{MODES, significant};

/// Band of a stress over that of the force, as shares; fitted on elastic drops against half the spacing [-].
const STRESS_BAND: f64 = 1.3;
/// Largest ratio of a peak of stress to the largest mean over the time of GE18 [-].
const LARGEST_PEAK: f64 = 1.5;

/// The largest stress of a panel, or of a structure by its modes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StressPeak {
    /// Of the panel; `modes`.
    pub name: String,
    /// Its magnitude [Pa].
    pub value: f64,
    /// Its time [s].
    pub time: f64,
    /// Allowable stress over it [-].
    pub reserve_factor: Option<f64>,
}

impl From<&PanelState> for StressPeak {
    fn from(panel: &PanelState) -> StressPeak {
        let stress = panel.worst.stress;
        let [value, time] = match -stress.least > stress.most {
            true => [-stress.least, stress.time_of_least],
            false => [stress.most, stress.time_of_most],
        };
        StressPeak { name: panel.name.clone(), value, time, reserve_factor: panel.worst.reserve_factor }
    }
}

impl StressPeak {
    /// Of a structure whose modes tell stresses.
    pub fn of_modes(modes: &ModesState) -> Option<StressPeak> {
        let largest = modes.extremes.stress.iter().max_by(|a, b| a[0].abs().total_cmp(&b[0].abs()));
        let [value, time] = *largest?;
        Some(StressPeak { name: MODES.into(), value: value.abs(), time, reserve_factor: None })
    }
}

/// Results of a panel under a load; a structure averages by itself, and its stress is nearly as good as the force.
///
/// `mean`: largest mean of its stress over the time of GE18 [Pa]; what the peak has above it is as short as the noise of the force.
/// `resonates`: why it vibrates with the water's sound, where it does.
pub(super) fn panel_results(
    &StressPeak { value, time, reserve_factor: reserve, .. }: &StressPeak,
    force: Option<Quantity>,
    mean: Option<f64>,
    resonates: Option<&str>,
) -> (PanelResults, Option<String>) {
    let excess = mean.filter(|mean| *mean > 0.0).map_or(0.0, |mean| (value / mean - 1.0).max(0.0));
    let load = force.map(|force| force.verdict).filter(|verdict| *verdict != Verdict::Resolved);
    let (verdict, doubt) = match (reserve, load) {
        (Some(reserve), _) if reserve < 1.0 => {
            let why = format!("the stress is {} times the allowable one", significant(1.0 / reserve));
            (Verdict::BeyondAllowable, Some(why))
        }
        _ if resonates.is_some() => (Verdict::Acoustic, resonates.map(String::from)),
        (_, Some(verdict)) => (verdict, None),
        _ if excess > LARGEST_PEAK - 1.0 => {
            let ratio = significant(1.0 + excess);
            let why = format!("the stress rises to {ratio} times its mean over the time that the spacing resolves");
            (Verdict::NotResolved, Some(why))
        }
        _ => (Verdict::Resolved, None),
    };
    let of_force = force.and_then(|force| Some(STRESS_BAND * force.band? / force.value));
    let share = of_force.filter(|share| share.is_finite()).map(|share| share + excess);
    let quantity = |value: f64| {
        let band = share.map(|share| share * value);
        Quantity { value, time_s: Some(time), band, cutoff_hz: None, raw: value, verdict }.with_known_band()
    };
    (PanelResults { peak_stress_Pa: quantity(value), reserve_factor: reserve.map(quantity) }, doubt)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel that bore a stress of 6 MPa.
    fn panel() -> StressPeak {
        StressPeak { name: "plate".into(), value: 6e6, time: 0.016, reserve_factor: None }
    }

    /// A burst of force of 3 ms rang a panel at 28 degrees: 6.4 MPa, and 5 MPa with half the spacing.
    #[test]
    fn a_stress_far_above_its_mean_widens_its_band() {
        let force = Quantity {
            value: 1000.0,
            time_s: Some(0.03),
            band: Some(80.0),
            cutoff_hz: Some(75.0),
            raw: 1100.0,
            verdict: Verdict::Resolved,
        };
        let stress = |mean: f64| panel_results(&panel(), Some(force), Some(mean), None);
        let (calm, none) = stress(6e6);
        assert!((calm.peak_stress_Pa.band.expect("a band") / 6e6 - 0.104).abs() < 1e-12 && none.is_none());
        let (burst, _) = stress(5e6);
        assert!((burst.peak_stress_Pa.band.expect("a band") / 6e6 - 0.304).abs() < 1e-12);
        assert_eq!(burst.peak_stress_Pa.verdict, Verdict::Resolved);
        let (spike, why) = stress(3e6);
        assert_eq!(spike.peak_stress_Pa.verdict, Verdict::NotResolved);
        assert!(why.is_some_and(|why| why.contains("2 times its mean")));
    }
}
