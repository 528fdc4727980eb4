//! Judges the results of panels (THEORY GE19).

use fsi_coupling::{ModesState, PanelState};
use settings::significant;
use structure_fe::Range;

use crate::keys::MODES;
use crate::vocabulary::ResultName::{PeakStrain, PeakStress, ReserveFactor};
use crate::vocabulary::{Named, Quantity, Verdict, WIDE, Why};

/// Band of a stress over that of the force, as shares; fitted on elastic drops against half the spacing [-].
const STRESS_BAND: f64 = 1.3;
/// Largest ratio of a peak of stress to the largest mean over the time of GE18 [-].
const LARGEST_PEAK: f64 = 1.5;

/// Smallest share of the largest strain at the other end of its element [-]: below, the element decides how long the hinge is.
const LEAST_STRAIN_ACROSS: f64 = 0.5;

/// Largest strain of the beams' theory (BE1) [-].
const LARGEST_STRAIN: f64 = 0.05;

/// The largest stress of a panel, or of a structure by its modes.
#[derive(Clone, Debug, PartialEq)]
pub struct StressPeak {
    /// Of the panel; `modes`.
    pub name: String,
    /// Largest magnitude of the stress [Pa].
    pub value: f64,
    /// Its time [s].
    pub time: f64,
    /// Reserve factor [-]: of the stress, or after yield of the strain.
    pub reserve_factor: Option<f64>,
    /// Whether it stays within its limits.
    pub allowed: Option<bool>,
    /// Largest magnitude of the strain [-] and its time [s], of a panel that has yielded.
    pub strain: Option<[f64; 2]>,
    /// The least of both ends of the element of that strain, over it [-].
    pub strain_across: f64,
    /// Strain at which its ends break off [-].
    pub rupture_strain: Option<f64>,
}

impl From<&PanelState> for StressPeak {
    fn from(panel: &PanelState) -> StressPeak {
        let worst = &panel.worst;
        let [value, time] = largest(&worst.stress);
        StressPeak {
            name: panel.name.clone(),
            value,
            time,
            reserve_factor: worst.reserve_factor,
            allowed: worst.allowed,
            strain: worst.yielded.then(|| largest(&worst.strain)),
            strain_across: worst.strain_across,
            rupture_strain: panel.rupture_strain,
        }
    }
}

/// The largest magnitude of a range, and its time [s].
fn largest(range: &Range) -> [f64; 2] {
    match -range.least > range.most {
        true => [-range.least, range.time_of_least],
        false => [range.most, range.time_of_most],
    }
}

impl StressPeak {
    /// Of a structure whose modes tell stresses.
    pub fn of_modes(modes: &ModesState) -> Option<StressPeak> {
        let largest = modes.extremes.stress.iter().max_by(|a, b| a[0].abs().total_cmp(&b[0].abs()));
        let [value, time] = *largest?;
        let (name, value) = (MODES.into(), value.abs());
        let (reserve_factor, allowed, strain, rupture_strain) = (None, None, None, None);
        Some(StressPeak { name, value, time, reserve_factor, allowed, strain, strain_across: 1.0, rupture_strain })
    }

    /// Why the strain of a panel that has yielded is not known, where that is so.
    fn unknown_strain(&self, strain: f64) -> Option<String> {
        if strain > LARGEST_STRAIN {
            let percent = significant(100.0 * strain);
            return Some(format!(
                "its strain of {percent} % is not small: the beams hold up to {} %",
                100.0 * LARGEST_STRAIN
            ));
        }
        (self.strain_across < LEAST_STRAIN_ACROSS).then(|| {
            let percent = significant(100.0 * self.strain_across);
            format!("its strain falls to {percent} % within an element: use more `elements`, or a larger `hardening_modulus`")
        })
    }

    /// Why it is beyond its limits, where it is.
    fn excess(&self) -> Option<String> {
        let reserve = self.reserve_factor;
        let times = reserve.filter(|reserve| *reserve < 1.0).map(|reserve| significant(1.0 / reserve));
        self.allowed.filter(|allowed| !allowed).map(|_| match (self.strain, times) {
            (None, times) if self.rupture_strain.is_some() => {
                format!("the stress or the strain is {} times its limit", times.unwrap_or_default())
            }
            (None, times) => format!("the stress is {} times the allowable one", times.unwrap_or_default()),
            (Some([strain, _]), None) => {
                let percent = significant(100.0 * strain);
                format!("it yields, up to a strain of {percent} %, and no `rupture_strain` says how far it may")
            }
            (Some([strain, _]), Some(times)) if self.rupture_strain.is_some_and(|limit| strain > limit) => {
                format!("its strain is {times} times the rupture strain")
            }
            (Some(_), Some(times)) => format!("it yields, and the stress is {times} times the allowable one"),
        })
    }
}

/// Results of a panel under a load, and doubts; a structure averages by itself, and its stress is nearly as good as the force.
///
/// `mean`: largest mean of its stress over the time of GE18 [Pa]; what the peak has above it is as short as the noise of the force.
/// `resonates`: why it vibrates with the water's sound, where it does. What it may carry is stated in addition to how well it is known.
pub fn panel_results(
    peak: &StressPeak,
    force: Option<Quantity>,
    mean: Option<f64>,
    resonates: Option<&str>,
) -> (Named, Vec<Why>) {
    let value = peak.value;
    let excess = mean.filter(|mean| *mean > 0.0).map_or(0.0, |mean| (value / mean - 1.0).max(0.0));
    let load = force.map(|force| force.verdict).filter(|verdict| *verdict != Verdict::Resolved);
    let (verdict, doubt) = match load {
        _ if resonates.is_some() => (Verdict::Acoustic, resonates.map(String::from)),
        Some(verdict) => (verdict, None),
        _ if excess > LARGEST_PEAK - 1.0 => {
            let ratio = significant(1.0 + excess);
            let why = format!("the stress rises to {ratio} times its mean over the time that the spacing resolves");
            (Verdict::NotResolved, Some(why))
        }
        _ => (Verdict::Resolved, None),
    };
    let of_force = force.and_then(|force| Some(STRESS_BAND * force.band? / force.value));
    judged(peak, (verdict, doubt), of_force.filter(|share| share.is_finite()).map(|share| share + excess))
}

/// The same of a panel in a flow without particles, whose stress is known within a share [-] where it was measured.
pub fn panel_results_within(peak: &StressPeak, share: Option<f64>) -> (Named, Vec<Why>) {
    judged(peak, (Verdict::Resolved, None), share)
}

/// Results of a panel with a verdict on its stress, why, and the stress's band as a share.
fn judged(peak: &StressPeak, (verdict, doubt): (Verdict, Option<String>), share: Option<f64>) -> (Named, Vec<Why>) {
    let &StressPeak { value, time, reserve_factor: reserve, strain, allowed, .. } = peak;
    // a stress that the law of the material bounds does not follow the force
    let share = share.filter(|_| strain.is_none());
    let coarse = strain.and_then(|[strain, _]| peak.unknown_strain(strain));
    let of_strain = match verdict {
        Verdict::Resolved | Verdict::NoBand if coarse.is_some() => Verdict::NotResolved,
        verdict => verdict,
    };
    let quantity = |value: f64, time: f64, share: Option<f64>, verdict: Verdict| {
        let band = share.map(|share| share * value);
        let quantity = Quantity { value, time_s: Some(time), band, cutoff_hz: None, raw: value, verdict, allowed };
        quantity.with_known_band()
    };
    // beyond yield the strain grows faster than the load: no band is known
    let stress = quantity(value, time, share, verdict);
    // a limit over a stress that is a share less is more than that share larger
    let of_factor = share.map(|share| if share < 1.0 { share / (1.0 - share) } else { f64::INFINITY });
    let factor = reserve.map(|factor| match strain {
        Some([_, time]) => quantity(factor, time, None, of_strain),
        None => quantity(factor, time, of_factor, verdict),
    });
    let strain = strain.map(|[strain, time]| quantity(strain, time, None, of_strain));
    let withheld = (verdict == Verdict::Resolved && stress.is_withheld()).then(|| WIDE.to_string());
    let all = [(PeakStress, Some(stress)), (PeakStrain, strain), (ReserveFactor, factor)];
    let results = all.into_iter().filter_map(|(name, quantity)| Some((name, quantity?))).collect();
    let excess = peak.excess().map(|text| Why { beyond_limit: true, ..text.into() });
    (results, excess.into_iter().chain([doubt, withheld, coarse].into_iter().flatten().map(Why::from)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel with a stress of 6 MPa.
    fn panel() -> StressPeak {
        let (name, value, time) = ("plate".into(), 6e6, 0.016);
        let (reserve_factor, allowed, strain, rupture_strain) = (None, None, None, None);
        StressPeak { name, value, time, reserve_factor, allowed, strain, strain_across: 1.0, rupture_strain }
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
            allowed: None,
        };
        let stress = |mean: f64| panel_results(&panel(), Some(force), Some(mean), None);
        let (calm, none) = stress(6e6);
        assert!((calm[&PeakStress].band.expect("a band") / 6e6 - 0.104).abs() < 1e-12 && none.is_empty());
        let (burst, _) = stress(5e6);
        assert!((burst[&PeakStress].band.expect("a band") / 6e6 - 0.304).abs() < 1e-12);
        assert_eq!(burst[&PeakStress].verdict, Verdict::Resolved);
        let (spike, why) = stress(3e6);
        assert_eq!(spike[&PeakStress].verdict, Verdict::NotResolved);
        assert!(why[0].text.contains("2 times its mean"), "{why:?}");
    }

    /// Resolved and allowed are two things: a stress of a force that is not resolved, and of one that is, beyond its limit.
    #[test]
    fn a_stress_beyond_its_limit_is_resolved_or_not() {
        let force = |verdict: Verdict, band: f64| {
            let (value, raw, time_s, cutoff_hz) = (1000.0, 1000.0, Some(0.03), None);
            Some(Quantity { value, time_s, band: Some(band), cutoff_hz, raw, verdict, allowed: None })
        };
        let over = StressPeak { reserve_factor: Some(0.5), allowed: Some(false), ..panel() };
        let stress = |force| panel_results(&over, force, None, None);
        let (resolved, doubts) = stress(force(Verdict::Resolved, 80.0));
        assert_eq!((resolved[&PeakStress].verdict, resolved[&PeakStress].allowed), (Verdict::Resolved, Some(false)));
        assert_eq!(doubts[0].text, "the stress is 2 times the allowable one");
        assert!(doubts[0].beyond_limit && doubts.len() == 1);
        let (unresolved, _) = stress(force(Verdict::NotResolved, 80.0));
        assert_eq!(unresolved.get(&ReserveFactor).expect("a factor").verdict, Verdict::NotResolved);
        assert_eq!(unresolved.get(&ReserveFactor).expect("a factor").allowed, Some(false));
        // 1432 MPa about 751 MPa tell nothing
        let (wide, doubts) = stress(force(Verdict::Resolved, 900.0));
        assert!(wide[&PeakStress].is_withheld() && wide[&PeakStress].verdict == Verdict::NotResolved);
        assert!(doubts[1].text.contains("as large as itself"), "{doubts:?}");
    }

    /// Beyond yield the strain is the result, against the rupture strain.
    #[test]
    fn a_panel_that_yields_is_judged_by_its_strain() {
        let yields = StressPeak { strain: Some([0.004, 0.02]), allowed: Some(false), ..panel() };
        let (results, doubts) = panel_results(&yields, None, None, None);
        let strain = results.get(&PeakStrain).expect("a strain");
        assert_eq!((strain.value, strain.time_s, strain.band, strain.allowed), (0.004, Some(0.02), None, Some(false)));
        assert!(!results.contains_key(&ReserveFactor) && doubts[0].text.contains("0.4 %"), "{doubts:?}");
        let enough =
            StressPeak { reserve_factor: Some(25.0), allowed: Some(true), rupture_strain: Some(0.1), ..yields };
        let (results, doubts) = panel_results(&enough, None, None, None);
        assert!(doubts.is_empty() && results.get(&ReserveFactor).is_some_and(|factor| factor.value == 25.0));
        // a hinge within an element is as long as the element
        let (results, doubts) = panel_results(&StressPeak { strain_across: 0.2, ..enough }, None, None, None);
        let verdicts =
            [results.get(&PeakStrain), results.get(&ReserveFactor)].map(|found| found.expect("a number").verdict);
        assert_eq!((verdicts, doubts.len()), ([Verdict::NotResolved; 2], 1));
        assert_eq!(results[&PeakStress].verdict, Verdict::NoBand);
    }
}
