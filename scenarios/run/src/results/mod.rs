//! The results of a run: the numbers that a designer takes away, each with a band and a verdict (THEORY GE18 to GE20).
//!
//! A curve of particles contains the noise of rows that the body meets, and at first contact a water hammer of the numerical speed of
//! sound. Both last as long as the body takes to fall through a spacing or two. A peak is therefore a mean over the time of three
//! spacings; the largest value of a single step is given beside it, as `raw`.

mod air_pulse;
mod averaging;
mod bands;
mod blunt;
mod doubts;
mod filtered;
mod judge;
mod observer;
mod panel;
mod running_integral;
mod tension;

use std::collections::BTreeMap;

use serde::Serialize;

pub use averaging::BandwidthBy;
pub use filtered::FilteredAcceleration;
pub use filtered::PASS_OVER_CLASS;
pub use observer::ResultsObserver;
pub(crate) use running_integral::{Extreme, RunningIntegral};

/// Why a number is withheld.
const WIDE: &str = "its band is as large as itself";

/// Standard gravity [m/s²].
pub(crate) const STANDARD_GRAVITY: f64 = 9.80665;

/// What may be said of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Right within its band.
    Resolved,
    /// It depends on the speed of sound, or on the averaging time: no value without both.
    Acoustic,
    /// The spacing is too coarse for it.
    NotResolved,
    /// Nothing known speaks against it, and nothing gives a band: no theory or chart is of such a flow.
    NoBand,
}

impl Verdict {
    /// As in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Resolved => "resolved",
            Verdict::Acoustic => "acoustic",
            Verdict::NotResolved => "not_resolved",
            Verdict::NoBand => "no_band",
        }
    }
}

/// A verdict, the band as a share where one is known, and why it is not `resolved`.
type Finding = (Verdict, Option<f64>, Option<String>);

/// A result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantity {
    /// The value, in the unit that its name ends with.
    pub value: f64,
    /// When [s]; `null` where it belongs to the whole run.
    pub time_s: Option<f64>,
    /// Half width of the band about the value, in the same unit; `null` where none is known.
    pub band: Option<f64>,
    /// Frequency at which the averaging halves the power [Hz]; `null` without averaging.
    pub cutoff_hz: Option<f64>,
    /// The largest value of a single step, in the same unit.
    pub raw: f64,
    /// What may be said of it.
    pub verdict: Verdict,
    /// Whether what it belongs to stays within its limits; absent where there is no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<bool>,
}

impl Quantity {
    /// The same: resolved only with a band that is smaller than its value.
    pub(crate) fn with_known_band(self) -> Quantity {
        let verdict = match self.verdict {
            Verdict::Resolved | Verdict::NoBand if self.is_withheld() => Verdict::NotResolved,
            Verdict::Resolved if self.band.is_none() => Verdict::NoBand,
            known => known,
        };
        Quantity { verdict, ..self }
    }

    /// True for a number that tells nothing: its band is as large as itself.
    pub fn is_withheld(&self) -> bool {
        is_withheld(self.value, self.band)
    }
}

/// True for a value that tells nothing: its band is as large as itself.
pub fn is_withheld(value: f64, band: Option<f64>) -> bool {
    band.is_some_and(|band| band > 0.0 && band >= value.abs())
}

/// Results of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case)]
pub struct PanelResults {
    /// Largest magnitude of the stress of an outer fibre [Pa].
    pub peak_stress_Pa: Quantity,
    /// Largest magnitude of the strain of an outer fibre [-]; absent for a panel that has not yielded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_strain: Option<Quantity>,
    /// Allowable stress over the largest; after yield the rupture strain over the largest strain [-]; absent without such a limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reserve_factor: Option<Quantity>,
}

/// The results of a run; what a scene does not have is absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case)]
pub struct Results {
    /// Largest force of the water on the body [N/m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_force_N_per_m: Option<Quantity>,
    /// Largest acceleration of the body's frame, in units of 9.80665 m/s² [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_acceleration_g: Option<Quantity>,
    /// Largest pressure of a gauge [Pa].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_pressure_Pa: Option<Quantity>,
    /// Magnitude of the impulse of the water on the body over the run [N s/m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impulse_N_s_per_m: Option<Quantity>,
    /// What the bandwidth of force and acceleration follows from; absent without an averaged force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bandwidth_by: Option<BandwidthBy>,
    /// Results of each panel, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub panels: BTreeMap<String, PanelResults>,
}

/// Names of the body's results.
pub(in crate::results) const OWN: [&str; 4] =
    ["peak_force_N_per_m", "peak_acceleration_g", "peak_pressure_Pa", "impulse_N_s_per_m"];

impl Results {
    /// The same; where work of the water is lost between fluid and body, what panels bear is not resolved.
    pub(crate) fn with_work_lost(mut self, lost: bool) -> Results {
        for panel in self.panels.values_mut().filter(|_| lost) {
            let others = panel.peak_strain.iter_mut().chain(&mut panel.reserve_factor);
            for quantity in std::iter::once(&mut panel.peak_stress_Pa).chain(others) {
                if matches!(quantity.verdict, Verdict::Resolved | Verdict::NoBand) {
                    quantity.verdict = Verdict::NotResolved;
                }
            }
        }
        self
    }

    /// The body's results, in the order of [`OWN`].
    pub(in crate::results) fn own_mut(&mut self) -> [&mut Option<Quantity>; 4] {
        let Results { peak_force_N_per_m, peak_acceleration_g, peak_pressure_Pa, impulse_N_s_per_m, .. } = self;
        [peak_force_N_per_m, peak_acceleration_g, peak_pressure_Pa, impulse_N_s_per_m]
    }

    /// Results with their names, those of panels as `NAME.peak_stress_Pa`.
    pub fn named(&self) -> Vec<(String, Quantity)> {
        let own = [self.peak_force_N_per_m, self.peak_acceleration_g, self.peak_pressure_Pa, self.impulse_N_s_per_m];
        let own = OWN.into_iter().zip(own).filter_map(|(name, quantity)| Some((name.to_string(), quantity?)));
        let panels = self.panels.iter().flat_map(|(name, panel)| {
            let stress = (format!("{name}.peak_stress_Pa"), panel.peak_stress_Pa);
            let strain = panel.peak_strain.map(|strain| (format!("{name}.peak_strain"), strain));
            let factor = panel.reserve_factor.map(|factor| (format!("{name}.reserve_factor"), factor));
            std::iter::once(stress).chain(strain).chain(factor)
        });
        own.chain(panels).collect()
    }
}
