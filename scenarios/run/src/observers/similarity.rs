//! Wedge entry at constant speed: force and pressure against the similarity solution (THEORY GE13).
//!
//! The flow depends on x/(Vt) alone, so every moment of the run is the same flow at another resolution
//! k = Vt/Δx. Numbers are taken over the last fifth of the run.

use fsi_coupling::Coupled;
use scene::reference::WedgeSimilarity;
use scene::vocabulary::Doubt;
use scene::{Scene, Shape};
use serde::{Deserialize, Serialize};
use sph_core::Probe;
use sph_core::state_bytes::{StateError, decode, encode, expect_count};
use water_entry::keel::{KeelLaw, KeelPressure, LARGEST_SHARE};

use super::face_profile::{length_near_peak, noise, peak_place};
use super::{Frame, ObserveError, Observer, mean_and_deviation};

/// Points along the face, in similarity coordinates.
const POINTS: usize = 400;
/// Points in a spacing along the face of the last snapshot.
const POINTS_PER_SPACING: f64 = 4.0;
/// The window starts at this share of the run.
pub const FROM: f64 = 0.8;
/// Least spacings across the length of the face with 90 % of the largest pressure: 9 to 13 gave it to 2 %, 6.5 to 5 %.
const PEAK_SPACINGS: f64 = 8.0;

/// What the run gives for the similarity solution's numbers.
#[derive(Clone, Debug, Serialize)]
pub struct SimilarityResult {
    /// Window the numbers were taken over [s].
    pub window_s: [f64; 2],
    /// Draught at the window's end, Vt [m].
    pub draught_m: f64,
    /// Resolution at the window's end, Vt/Δx [-].
    pub spacings_per_draught: f64,
    /// F/(ρV³t), mean over the steps of the window [-].
    pub force_coefficient: f64,
    /// Standard deviation of the same over the samples of the window [-].
    pub force_coefficient_sd: f64,
    /// Largest pressure on the face over ½ρV², mean over the window's snapshots [-]; above 30° the keel's is read by its law
    /// (THEORY GE21). `null` where the keel's pressure is the largest and not resolved.
    pub cp_max: f64,
    /// Why `cp_max` is missing, or not to be relied on; absent where it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cp_max_unresolved: Option<String>,
    /// Standard deviation of the same over the window [-].
    pub cp_max_sd: f64,
    /// Largest value of the window's mean profile [-].
    pub cp_max_of_mean: f64,
    /// Height of the mean profile's peak above still water over Vt [-]: the top of the parabola that fits what is within 3 %
    /// of its largest value.
    pub z_max_over_vt: f64,
    /// RMS difference of the mean profile from the exact one, from the keel to the pressure peak (to four fifths
    /// of the wetted width where the peak is at the keel), over the exact largest Cp [-]; `null` where no exact
    /// solution is tabulated.
    pub profile_error: Option<f64>,
    /// As `profile_error`, of one snapshot: the last [-].
    pub profile_error_snapshot: Option<f64>,
    /// Pressure noise along the face of the last snapshot: RMS of the profile less its running mean over four spacings,
    /// from two spacings beside the keel to 0.9 of the way to the exact pressure peak (to four fifths of the wetted width
    /// where the peak is at the keel), over `cp_max_of_mean` [-] (THEORY GE14); `null` on a face too short to tell.
    pub cp_noise: Option<f64>,
    /// Relative error of `z_max_over_vt` [-]; `null` where no
    /// exact solution is tabulated.
    pub z_max_error: Option<f64>,
    /// Impulse of the force since first contact, 2∫F dt/(ρV³t²), at the window's end [-] (THEORY GE14): the same number as
    /// the force coefficient in the exact solution, with less scatter and more of the coarse start.
    pub impulse_coefficient: f64,
    /// Mean profile: x/(Vt), Cp.
    pub profile: Vec<[f64; 2]>,
}

impl SimilarityResult {
    /// Why the largest pressure is not resolved.
    pub(crate) fn doubt(&self) -> Option<Doubt> {
        self.cp_max_unresolved.as_ref().map(|why| Doubt::about("similarity.cp_max", why.as_str()))
    }
}

/// A sample of the window.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Sample {
    time: f64,
    /// F/(ρV³t) [-].
    force: f64,
    /// Largest pressure coefficient on the face [-].
    peak: f64,
    /// Pressure coefficient beside the keel by its law, where the face is long enough.
    keel: Option<KeelPressure>,
    /// Pressure coefficients along the face [-].
    profile: Vec<f64>,
}

/// A step of the window.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Step {
    start: f64,
    length: f64,
    /// Integral of F/(ρV³t) over the step [s].
    coefficient: f64,
}

/// Gathers the window.
pub struct SimilarityWindow {
    speed: f64,
    tan: f64,
    rho: f64,
    spacing: f64,
    /// How far the body is above where V t has it [m] (THEORY WA12).
    lift: f64,
    support: f64,
    law: Option<KeelLaw>,
    /// Read the face beside the keel by Shepard means: for a projection, whose water fills half the kernel but roughly there.
    shepard: bool,
    from: f64,
    reach: f64,
    samples: Vec<Sample>,
    steps: Vec<Step>,
    snapshot: Vec<[f64; 2]>,
    /// Time [s], force [N/m] and its coefficient [-] of the last step; the integral of the force over the run.
    before: Option<[f64; 3]>,
    impulse: f64,
}

impl SimilarityWindow {
    /// For a scene whose body is a wedge; `None` for any other.
    pub fn new(scene: &Scene) -> Option<SimilarityWindow> {
        let body = scene.body.as_ref()?;
        let Shape::Wedge { deadrise_deg, .. } = body.shape else {
            return None;
        };
        let tan = deadrise_deg.to_radians().tan();
        let support = 2.0 * scene.water().smoothing_ratio * scene.resolution.spacing;
        Some(SimilarityWindow {
            speed: -body.velocity[1],
            tan,
            rho: scene.water().density,
            spacing: scene.resolution.spacing,
            lift: scene.motion_at_start(body).position[1] - body.position[1] - body.velocity[1] * scene.time.start,
            support,
            law: KeelLaw::new(deadrise_deg.to_radians(), support),
            shepard: scene.solver.is_incompressible(),
            from: FROM * scene.time.end,
            reach: 1.3 * std::f64::consts::FRAC_PI_2 / tan,
            samples: Vec::new(),
            steps: Vec::new(),
            snapshot: Vec::new(),
            before: None,
            impulse: 0.0,
        })
    }

    /// Take the force after a step: integrals by trapezoids.
    pub fn follow(&mut self, system: &Coupled) {
        let Some(motion) = system.bodies().find_map(|b| b.motion()) else { return };
        let (t, force) = (system.fluid.time(), motion.force[1]);
        let coefficient = force / (self.rho * self.speed.powi(3) * t);
        if let Some([t0, force0, coefficient0]) = self.before {
            self.impulse += 0.5 * (force + force0) * (t - t0);
            if t0 >= self.from {
                let coefficient = 0.5 * (coefficient + coefficient0) * (t - t0);
                self.steps.push(Step { start: t0, length: t - t0, coefficient });
            }
        }
        self.before = Some([t, force, coefficient]);
    }

    /// What the window holds, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.samples, &self.steps, &self.snapshot, self.before, self.impulse))
    }

    /// Take what a window held; what is before the start of this one is left out.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        (self.samples, self.steps, self.snapshot, self.before, self.impulse) = decode("the similarity window", bytes)?;
        self.samples.retain(|sample| sample.time >= self.from);
        self.steps.retain(|step| step.start >= self.from);
        self.samples.iter().try_for_each(|sample| expect_count("points of a face", sample.profile.len(), POINTS))
    }

    fn x_over_vt(&self, k: usize) -> f64 {
        self.reach * (k as f64 + 0.5) / POINTS as f64
    }

    /// Why the largest pressure is not resolved, if it is not: at the keel, or elsewhere in a mean profile.
    ///
    /// A coarse run smears the peak, and its own length near it is too long: the exact one counts where it is shorter.
    fn unresolved(
        &self,
        at_keel: bool,
        profile: &[[f64; 2]],
        exact: Option<&WedgeSimilarity>,
        spacing: f64,
    ) -> Option<String> {
        if !at_keel {
            let longest = exact.map_or(f64::INFINITY, |exact| length_near_peak(&exact.profile));
            let across = length_near_peak(profile).min(longest) / spacing;
            let few = || {
                format!("{across:.1} spacings across the face with 90 % of the largest pressure, of {PEAK_SPACINGS}")
            };
            return (across < PEAK_SPACINGS).then(few);
        }
        let Some(keel) = self.samples.iter().map(|sample| sample.keel).collect::<Option<Vec<KeelPressure>>>() else {
            return Some("the face is too short for the law of the keel (THEORY GE21)".into());
        };
        let share = keel.iter().map(|keel| keel.share).sum::<f64>() / keel.len() as f64;
        let [share, most] = [share, LARGEST_SHARE].map(|share| 100.0 * share);
        let far = || {
            format!(
                "{share:.0} % of the pressure at the keel would be extrapolated, {most:.0} % is the most (THEORY GE21)"
            )
        };
        (!(0.0..=most).contains(&share)).then(far)
    }

    /// The numbers, once the window holds samples; judged against `exact`, if there is one.
    pub fn result(&self, exact: Option<&WedgeSimilarity>) -> Option<SimilarityResult> {
        let n = self.samples.len() as f64;
        let (first, last) = (self.samples.first()?.time, self.samples.last()?.time);
        let sum = |k: usize| self.samples.iter().fold(0.0, |sum, sample| sum + sample.profile[k]);
        let profile: Vec<[f64; 2]> = (0..POINTS).map(|k| [self.x_over_vt(k), sum(k) / n]).collect();
        let top = profile.iter().max_by(|a, b| a[1].total_cmp(&b[1]))?;
        let of = |read: fn(&Sample) -> f64| self.samples.iter().map(read).collect::<Vec<f64>>();
        let [[sampled, force_sd], [peak, peak_sd]] = [of(|s| s.force), of(|s| s.peak)].map(|v| mean_and_deviation(&v));
        let [coefficient, seconds] =
            self.steps.iter().fold([0.0; 2], |[c, s], step| [c + step.coefficient, s + step.length]);
        let least = 0.8 * std::f64::consts::FRAC_PI_2 / self.tan;
        let z = |x: f64| x * self.tan - 1.0 + self.lift / (self.speed * last);
        let place = peak_place(&profile)?;
        // Where the peak is at the keel there is no way to it.
        let peak_at = exact.map_or(top[0], |e| (1.0 + e.z_max_over_vt) / self.tan);
        let end = if peak_at < 0.5 * least { least / 0.9 } else { peak_at };
        let cos = 1.0 / self.tan.hypot(1.0);
        let spacing = self.spacing * cos / (self.speed * last);
        // The law, where it holds, is in the profile: its end is the keel's.
        let at_keel = self.law.is_some_and(|law| top[0] * self.speed * last < law.from * cos);
        let keel = self.samples.iter().filter_map(|s| s.keel).map(|keel| keel.pressure).sum::<f64>() / n;
        let cp_max_unresolved = self.unresolved(at_keel, &profile, exact, spacing);
        let [cp_max, cp_max_of_mean] = match (&cp_max_unresolved, at_keel) {
            (Some(_), true) => [f64::NAN; 2],
            (None, true) => [peak, keel.max(top[1])],
            (_, false) => [peak, top[1]],
        };
        Some(SimilarityResult {
            window_s: [first, last],
            draught_m: self.speed * last,
            spacings_per_draught: self.speed * last / self.spacing,
            force_coefficient: if seconds > 0.0 { coefficient / seconds } else { sampled },
            force_coefficient_sd: force_sd,
            cp_max,
            cp_max_unresolved,
            cp_max_sd: peak_sd,
            cp_max_of_mean,
            z_max_over_vt: z(place),
            profile_error: exact.map(|e| e.profile_error(&profile, least)),
            impulse_coefficient: 2.0 * self.impulse / (self.rho * self.speed.powi(3) * last * last),
            profile_error_snapshot: exact.map(|e| e.profile_error(&self.snapshot, least)),
            cp_noise: noise(&self.snapshot, spacing, end, top[1]),
            z_max_error: exact.map(|e| (z(place) - e.z_max_over_vt) / e.z_max_over_vt.abs()),
            profile,
        })
    }
}

impl Observer for SimilarityWindow {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let t = frame.time();
        let Some(motion) = frame.system.bodies().find_map(|b| b.motion()) else {
            return Ok(());
        };
        if t < self.from {
            return Ok(());
        }
        let draught = self.speed * t;
        let force = motion.force[1] / (self.rho * self.speed.powi(3) * t);
        let probe = Probe::new(&frame.system.fluid);
        let (sin, cos) = {
            let c = 1.0 / (1.0 + self.tan * self.tan).sqrt();
            (self.tan * c, c)
        };
        let place = |r: f64| [motion.position[0] + r * cos, motion.position[1] + r * sin];
        let flat = |r: f64| probe.on_flat_face(place(r), [sin, -cos], 0.0);
        let dynamic = 0.5 * self.rho * self.speed * self.speed;
        let read = |r: f64| if self.shepard { probe.shepard(place(r)) } else { flat(r) };
        let keel = self.law.and_then(|law| law.fit(draught, |r| read(r) / dynamic));
        let law = keel.filter(KeelPressure::is_resolved).zip(self.law);
        let cp = |x_over_vt: f64| {
            let r = x_over_vt * draught / cos;
            match law {
                Some((keel, law)) if r < law.from => keel.at(r),
                _ if r < self.support => probe.shepard(place(r)) / dynamic,
                _ => flat(r) / dynamic,
            }
        };
        let profile: Vec<f64> = (0..POINTS).map(|k| cp(self.x_over_vt(k))).collect();
        let peak = profile.iter().copied().fold(law.map_or(0.0, |(keel, _)| keel.pressure), f64::max);
        // The last one stays.
        let step = self.spacing * cos / (POINTS_PER_SPACING * draught);
        let places = (0..(self.reach / step) as usize).map(|k| (k as f64 + 0.5) * step);
        self.snapshot = places.map(|x| [x, cp(x)]).collect();
        self.samples.push(Sample { time: t, force, peak, keel, profile });
        Ok(())
    }
}
