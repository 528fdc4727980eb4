//! Judges the results of panels (THEORY GE19).

use fsi_coupling::PanelState;

use super::{PanelResults, Quantity, Verdict};
use crate::scene::significant;

/// Band of a stress over that of the force, as shares; fitted on elastic drops against half the spacing [-].
const STRESS_BAND: f64 = 1.3;

/// Results of a panel under a load; a structure averages by itself, and its stress is nearly as good as the force.
///
/// `resonates`: why it vibrates with the water's sound, where it does.
pub(super) fn panel_results(
    panel: &PanelState,
    force: Option<Quantity>,
    resonates: Option<&str>,
) -> (PanelResults, Option<String>) {
    let worst = &panel.worst;
    let stress = worst.stress;
    let [value, time] = match -stress.least > stress.most {
        true => [-stress.least, stress.time_of_least],
        false => [stress.most, stress.time_of_most],
    };
    let reserve = worst.reserve_factor;
    let load = force.map(|force| force.verdict).filter(|verdict| *verdict != Verdict::Resolved);
    let (verdict, doubt) = match (reserve, load) {
        (Some(reserve), _) if reserve < 1.0 => {
            let why = format!("the stress is {} times the allowable one", significant(1.0 / reserve));
            (Verdict::BeyondAllowable, Some(why))
        }
        _ if resonates.is_some() => (Verdict::Acoustic, resonates.map(String::from)),
        (_, Some(verdict)) => (verdict, None),
        _ => (Verdict::Resolved, None),
    };
    let of_force = force.and_then(|force| Some(STRESS_BAND * force.band? / force.value));
    let share = of_force.filter(|share| share.is_finite());
    let quantity = |value: f64| {
        let band = share.map(|share| share * value);
        Quantity { value, time_s: Some(time), band, cutoff_hz: None, raw: value, verdict }.with_known_band()
    };
    (PanelResults { peak_stress_Pa: quantity(value), reserve_factor: reserve.map(quantity) }, doubt)
}
