//! Loads on the structure in a landing: stations of the fuselage, and parts that meet the water.

use run::summary::Peak;
use serde::Serialize;
use settings::significant;
use water_entry::ditching::{Bending, Landing, LandingState, Masses};

use super::model::Scene;
use super::parts::AccelerometerKeys;
use super::series::Series;

/// Largest accelerations at a place.
#[derive(Clone, Debug, Serialize)]
pub struct Accelerometer {
    /// Its name.
    pub name: String,
    /// Place from the nose and over the body axis [m], shape (2).
    pub at_m: [f64; 2],
    /// Frequency up to which it follows [Hz].
    pub bandwidth_hz: f64,
    /// Largest acceleration upwards from the body axis over g; 1 at rest.
    pub normal_g: Peak,
    /// Largest deceleration along the body axis over g; with the nose up, gravity takes sin θ off.
    pub longitudinal_g: Peak,
}

/// Loads of a station.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StationLoad {
    /// Its place, from the nose [m].
    pub x_m: f64,
    /// Largest load of a metre of the keel [N/m].
    pub line_load_n_per_m: Peak,
    /// The same over the breadth: largest mean pressure [Pa].
    pub pressure_pa: Peak,
    /// Shear force of largest size in the cut of the fuselage, of the part aft on the part ahead, upwards [N].
    pub shear_n: Peak,
    /// Bending moment of largest size there; positive where it bends the ends upwards [N m].
    pub bending_nm: Peak,
}

/// Load of a part that met the water.
#[derive(Clone, Debug, Serialize)]
pub struct PartLoad {
    /// Its name.
    pub name: String,
    /// Largest force of the water [N].
    pub force_n: Peak,
    /// When it was lost [s].
    pub lost_at_s: Option<f64>,
}

impl Accelerometer {
    /// Of the columns of a series.
    pub(super) fn of_series(keys: &AccelerometerKeys, series: &Series) -> Accelerometer {
        let most = |name: &str| {
            let [times, signal] = ["time_s", name].map(|name| series.column(name).unwrap_or_default());
            let pairs = times.into_iter().zip(signal);
            let worst = pairs.fold([0.0, 0.0], |worst, (t, v)| if v > worst[1] { [t, v] } else { worst });
            Peak { value: worst[1], time_s: worst[0], verdict: None }
        };
        Accelerometer {
            name: keys.name.clone(),
            at_m: keys.at,
            bandwidth_hz: keys.bandwidth,
            normal_g: most(&format!("{}.normal_g", keys.name)),
            longitudinal_g: most(&format!("{}.longitudinal_g", keys.name)),
        }
    }
}

/// Largest slope of a bent axis for which bending is linear [rad].
const LARGEST_SLOPE: f64 = 0.1;

/// How far a fuselage bent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bent {
    /// Largest deflection from its straight axis, upwards [m].
    pub deflection: Peak,
    /// Largest slope of its axis [rad].
    slope: f64,
}

impl Bent {
    /// By the modes' amplitudes at the moments.
    pub fn of(bending: &Bending, moments: &[LandingState]) -> Bent {
        let mut bent = Bent { deflection: Peak::default(), slope: 0.0 };
        for moment in moments {
            for shapes in &bending.shapes {
                let sum =
                    |of: usize| shapes.iter().zip(&moment.attitude.bend).map(|(shape, a)| shape[of] * a).sum::<f64>();
                keep(&mut bent.deflection, sum(0), moment.time);
                bent.slope = bent.slope.max(sum(1).abs());
            }
        }
        bent
    }

    /// What is said where bending is no longer linear.
    pub fn too_far(&self) -> Option<String> {
        (self.slope > LARGEST_SLOPE).then(|| {
            format!(
                "the fuselage bends by {} m and turns by {} degrees: bending is linear up to about 6 degrees",
                significant(self.deflection.value),
                significant(self.slope.to_degrees())
            )
        })
    }
}

/// Keeps the value of larger size.
fn keep(peak: &mut Peak, value: f64, time_s: f64) {
    if value.abs() > peak.value.abs() {
        *peak = Peak { value, time_s, verdict: None };
    }
}

/// Loads of each station, and the error of the balance of the fuselage's cuts: what a cut aft of the tail carries over the largest in any.
pub(super) fn stations(
    scene: &Scene,
    landing: &Landing<'_>,
    masses: &Masses,
    moments: &[LandingState],
) -> (Vec<StationLoad>, f64) {
    let places: Vec<f64> = scene.stations.iter().map(|station| station.x).collect();
    let none = Peak::default();
    let unloaded = |x_m: &f64| StationLoad {
        x_m: *x_m,
        line_load_n_per_m: none,
        pressure_pa: none,
        shear_n: none,
        bending_nm: none,
    };
    let mut loads: Vec<StationLoad> = places.iter().map(unloaded).collect();
    let (mut error, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    let aft_of_tail = places[places.len() - 1] + 1e-9;
    for moment in moments {
        for (strip, force) in &moment.strips {
            let Some(entry) = &strip.entry else { continue };
            let distance = |load: &&mut StationLoad| (load.x_m - entry.at.x).abs();
            if let Some(load) =
                loads.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b))).filter(|_| *force > 0.0)
            {
                keep(&mut load.line_load_n_per_m, force / entry.length, moment.time);
                let breadth = landing.hull.fuselage().breadth(entry.at.x);
                keep(&mut load.pressure_pa, force / (entry.length * breadth), moment.time);
            }
        }
        let cuts = landing.section_forces(moment, masses, &[&places[..], &[aft_of_tail]].concat());
        for (load, cut) in loads.iter_mut().zip(&cuts) {
            keep(&mut load.shear_n, cut.shear, moment.time);
            keep(&mut load.bending_nm, cut.bending, moment.time);
            largest = [largest[0].max(cut.shear.abs()), largest[1].max(cut.bending.abs())];
        }
        if let Some(aft) = cuts.last() {
            error = [error[0].max(aft.shear.abs()), error[1].max(aft.bending.abs())];
        }
    }
    (loads, (error[0] / largest[0]).max(error[1] / largest[1]))
}

/// Load of each part.
pub(super) fn parts(landing: &Landing<'_>, moments: &[LandingState]) -> Vec<PartLoad> {
    let of_part = |(k, name): (usize, &str)| {
        let mut force_n = Peak::default();
        moments.iter().for_each(|m| keep(&mut force_n, size(m, k), m.time));
        let lost_at_s = moments.iter().find(|m| m.lost[k]).map(|m| m.time);
        PartLoad { name: name.to_string(), force_n, lost_at_s }
    };
    landing.aeroplane.part_names().into_iter().enumerate().map(of_part).collect()
}

/// Force of the water on a part [N].
fn size(moment: &LandingState, part: usize) -> f64 {
    let [forward, up] = [0, 1].map(|k| moment.parts[part].iter().map(|p| p.force[k]).sum::<f64>());
    forward.hypot(up)
}
