//! Extremes of a body's panels over a run.

use fsi_coupling::{Coupled, PanelState, Station};
use scene::vocabulary::{Doubt, Results};
use serde::Serialize;
use settings::significant;
use structure_fe::{Break, Range};

/// Extremes of a quantity over a panel and the run.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Extremes {
    /// Smallest value.
    pub least: f64,
    /// When [s].
    pub least_at_s: f64,
    /// Largest value.
    pub most: f64,
    /// When [s].
    pub most_at_s: f64,
}

impl From<Range> for Extremes {
    fn from(range: Range) -> Extremes {
        Extremes {
            least: range.least,
            least_at_s: range.time_of_least,
            most: range.most,
            most_at_s: range.time_of_most,
        }
    }
}

/// An end of a panel that broke off.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Rupture {
    /// When [s].
    pub time_s: f64,
    /// Where [m].
    pub x_m: f64,
    /// Where [m].
    pub y_m: f64,
    /// Strain of the outer fibre [-].
    pub strain: f64,
}

/// The first rupture of a panel, in words.
pub(super) fn first_rupture(system: &Coupled) -> Option<String> {
    system.bodies().find_map(|body| {
        let (panel, Break { place: [x, y], time, value, .. }) = body.first_rupture()?;
        let (strain, time) = (significant(100.0 * value), significant(1e3 * time));
        Some(format!("{panel} broke off at ({x:.4}, {y:.4}) m at {time} ms, at a strain of {strain} %"))
    })
}

/// What a rupture means for the results.
pub(super) fn rupture_doubt(system: &Coupled, results: &Results) -> Option<Doubt> {
    let about = results.named().map(|(id, _)| id.to_string()).collect();
    Some(Doubt { about, why: format!("{}; they hold up to that moment", first_rupture(system)?).into() })
}

/// Extremes over every step of the run, not only over the samples.
#[derive(Clone, Debug, Serialize)]
pub struct PanelResult {
    /// Normal force [N/m].
    pub normal_n_per_m: Extremes,
    /// Shear force [N/m].
    pub shear_n_per_m: Extremes,
    /// Bending moment [N].
    pub moment_n: Extremes,
    /// Stress of outer fibres along the panel [Pa].
    pub stress_pa: Extremes,
    /// Their strain, plastic strain included [-].
    pub strain: Extremes,
    /// Allowable stress over the largest; after yield the rupture strain over the largest strain [-]; `null` without such a limit.
    pub reserve_factor: Option<f64>,
    /// Whether it yielded anywhere.
    pub yielded: bool,
    /// Whether it stayed within its limits; `null` without a limit.
    pub allowed: Option<bool>,
    /// Largest plastic curvature left [1/m].
    pub plastic_curvature_per_m: f64,
    /// Deflection at the places that are watched, at the end of the run [m].
    pub deflection_at_end_m: Vec<f64>,
    /// Extremes at each station along it.
    pub envelope: PanelEnvelope,
    /// Ends that broke off.
    pub ruptures: Vec<Rupture>,
}

impl From<&PanelState> for PanelResult {
    fn from(panel: &PanelState) -> PanelResult {
        let worst = &panel.worst;
        let rupture =
            |b: &structure_fe::Break| Rupture { time_s: b.time, x_m: b.place[0], y_m: b.place[1], strain: b.value };
        PanelResult {
            normal_n_per_m: worst.normal.into(),
            shear_n_per_m: worst.shear.into(),
            moment_n: worst.moment.into(),
            stress_pa: worst.stress.into(),
            strain: worst.strain.into(),
            reserve_factor: worst.reserve_factor,
            yielded: worst.yielded,
            allowed: worst.allowed,
            plastic_curvature_per_m: worst.plastic_curvature,
            deflection_at_end_m: panel.watched.iter().map(|w| w.deflection).collect(),
            envelope: PanelEnvelope::from(panel),
            ruptures: panel.ruptures.iter().map(rupture).collect(),
        }
    }
}

/// Extremes over every step at each station of a panel: its nodes, from its start to its end.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PanelEnvelope {
    /// Distance from its start along its middle line [m].
    pub station_m: Vec<f64>,
    /// Normal force [N/m].
    pub normal_n_per_m: Vec<Extremes>,
    /// Shear force [N/m].
    pub shear_n_per_m: Vec<Extremes>,
    /// Bending moment [N].
    pub moment_n: Vec<Extremes>,
    /// Stress of the outer fibres [Pa].
    pub stress_pa: Vec<Extremes>,
    /// Allowable stress over the largest there [-]; empty without an allowable stress, and after yield.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reserve_factor: Vec<f64>,
}

impl From<&PanelState> for PanelEnvelope {
    fn from(panel: &PanelState) -> PanelEnvelope {
        let of = |range: fn(&Station) -> Range| panel.stations.iter().map(|s| range(s).into()).collect();
        let reserve = |allowable: f64| panel.stations.iter().map(|s| allowable / s.stress.largest()).collect();
        PanelEnvelope {
            station_m: panel.stations.iter().map(|s| s.along).collect(),
            normal_n_per_m: of(|s| s.normal),
            shear_n_per_m: of(|s| s.shear),
            moment_n: of(|s| s.moment),
            stress_pa: of(|s| s.stress),
            reserve_factor: panel.allowable_stress.filter(|_| !panel.worst.yielded).map_or(Vec::new(), reserve),
        }
    }
}
