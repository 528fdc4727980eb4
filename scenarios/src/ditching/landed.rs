//! A landing that was followed: its series and its numbers.

use std::f64::consts::TAU;
use std::time::Instant;

use report::run_page::quantity::digits;
use run::summary::Peak;
use scene::vocabulary::Status;
use serde::Serialize;
use settings::Problem;
use water_entry::ditching::{Bending, Fuselage, LandingEnd, LandingResult, PressureMap, Swell};

use super::aeroplane::masses;
use super::checked::{hull, landing};
use super::flotation::{self, Flotation};
use super::loads::{self, Accelerometer, Bent, PartLoad, StationLoad};
use super::model::Scene;
use super::plating::{self, PlatingStress};
use super::sea::{self, Sea};
use super::series::Series;
use super::windows::{self, WindowLoad};

/// What is said of all loads of a landing.
const NO_BAND: &str = "no band of these loads and accelerations is known: do not design by them";

/// A landing that was followed.
pub struct Landed {
    /// The numbers.
    pub summary: Summary,
    /// The waves at the first touch.
    pub swell: Swell,
    /// Its motion in time.
    pub run: LandingResult,
    /// Motion, accelerometers and loads in time.
    pub series: Series,
    /// Largest pressures along the bottom; `None` by a theory without pressures.
    pub map: Option<PressureMap>,
    fuselage: Fuselage,
}

impl Landed {
    /// Adds the stresses of plating, which take seconds of each section.
    pub(super) fn add_stresses(&mut self, scene: &Scene) {
        let start = Instant::now();
        self.summary.structure.plating = plating::stresses(scene, &self.run);
        self.summary.wall_time_s += start.elapsed().as_secs_f64();
    }

    /// The file of the largest pressures.
    pub(super) fn map_csv(&self) -> String {
        windows::csv(self.map.as_ref(), &self.fuselage)
    }
}

/// Follow a landing that was [loaded](super::load).
///
/// # Panics
/// A scene that was changed by hand into one that [`load`](super::load) refuses.
pub fn follow(scene: &Scene) -> Landed {
    let refused = |problem: Problem| -> ! { panic!("{}", problem.sentence) };
    let hull = hull(scene).unwrap_or_else(|problem| refused(problem));
    let masses = masses(scene).unwrap_or_else(|problem| refused(problem));
    let start = Instant::now();
    let landing = landing(scene, &hull);
    let run = landing.solve();
    let series = Series::new(scene, &landing, &run.moments);
    let (stations, balance_error) = loads::stations(scene, &landing, &masses, &run.moments);
    let places = windows::windows(&scene.windows, &hull, scene.model).unwrap_or_else(|problem| refused(problem));
    let (windows, map) = windows::pressures(&landing, &places, &run.moments);
    let parts = loads::parts(&landing, &run.moments);
    let lost: Vec<String> = parts.iter().filter(|p| p.lost_at_s.is_some()).map(|p| p.name.clone()).collect();
    let bent = landing.aeroplane.bending.as_ref().map(|bending| Bent::of(bending, &run.moments));
    let structure = Structure {
        accelerometers: scene.accelerometers.iter().map(|keys| Accelerometer::of_series(keys, &series)).collect(),
        parts,
        windows,
        plating: Vec::new(),
        flotation: flotation::flotation(scene, hull.fuselage(), &lost),
        deflection_m: bent.map(|bent| bent.deflection),
        frequencies_hz: frequencies(landing.aeroplane.bending.as_ref()),
        stations,
        balance_error,
    };
    let mut summary = Summary::new(scene, &run, &series, structure, start.elapsed().as_secs_f64());
    (summary.sea, summary.warnings) = (Sea::of(scene, &landing), sea::warnings(scene, &landing));
    summary.warnings.extend(bent.and_then(|bent| bent.too_far()));
    Landed { summary, swell: landing.swell, run, series, map, fuselage: hull.fuselage().clone() }
}

/// Frequencies of the bending modes [Hz].
fn frequencies(bending: Option<&Bending>) -> Vec<f64> {
    bending.map_or(Vec::new(), |bending| bending.frequency.map(|omega| omega / TAU).to_vec())
}

/// A time of a landing, in seconds on the whole page.
pub(super) fn seconds(time_s: f64) -> String {
    format!("{}\u{a0}s", digits(time_s))
}

/// The numbers of a landing.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Its name.
    pub scene: String,
    /// How it ended.
    pub status: Status,
    /// Why, where that is no end that was asked for.
    pub message: Option<String>,
    /// What its file assumes; absent when it names nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<String>,
    /// What carried the load.
    pub model: &'static str,
    /// Strips along the fuselage.
    pub strips: usize,
    /// Steps: `time_end_s` over the length of a step.
    pub steps: u64,
    /// Time at the end [s].
    pub time_end_s: f64,
    /// Time that it took here [s].
    pub wall_time_s: f64,
    /// Way on the water up to the end [m].
    pub run_length_m: f64,
    /// Forward speed at which the landing was ended, `landing.least_speed` [m/s]; absent where it was not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended_at_m_per_s: Option<f64>,
    /// Forward speed at the first touch and at the end [m/s], shape (2).
    pub speed_m_per_s: [f64; 2],
    /// Pitch at the first touch, the least and the most [deg], shape (3).
    pub pitch_deg: [f64; 3],
    /// Largest upward acceleration over g.
    pub az_g: Peak,
    /// Largest deceleration over g.
    pub deceleration_g: Peak,
    /// Largest lift of water and wing over the weight: what an accelerometer shows.
    pub load_factor: Peak,
    /// Largest upward force of the water [N].
    pub fz_n: Peak,
    /// Largest moment of the water about the centre of mass, nose up or down [N m].
    pub moment_nm: Peak,
    /// Largest load of a metre of the keel [N/m].
    pub line_load_n_per_m: Peak,
    /// Where that is, from the nose [m].
    pub line_load_at_m: f64,
    /// The waves; absent on calm water.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sea: Option<Sea>,
    /// Warnings about waves and bending; absent when there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// Loads on its structure.
    #[serde(flatten)]
    pub structure: Structure,
}

/// Loads on the structure in a landing.
#[derive(Clone, Debug, Serialize)]
pub struct Structure {
    /// What each accelerometer shows.
    pub accelerometers: Vec<Accelerometer>,
    /// Load of each part that may meet the water.
    pub parts: Vec<PartLoad>,
    /// Windows of the bottom; absent without.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub windows: Vec<WindowLoad>,
    /// Stresses of plating; absent without it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plating: Vec<PlatingStress>,
    /// How it floats after the stop; absent where that is not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flotation: Option<Flotation>,
    /// Largest deflection of the fuselage from its straight axis [m]; absent for a rigid one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deflection_m: Option<Peak>,
    /// Frequencies of the fuselage's bending modes [Hz]; none for a rigid one.
    pub frequencies_hz: Vec<f64>,
    /// Each station: load and pressure of the strips that are nearer to it than to another, shear and bending in its cut.
    pub stations: Vec<StationLoad>,
    /// Error of the balance of loads and inertia: what a cut aft of the tail carries, over the largest in any [-].
    pub balance_error: f64,
}

impl Summary {
    fn new(scene: &Scene, run: &LandingResult, series: &Series, structure: Structure, wall_time_s: f64) -> Summary {
        let rows = &series.rows;
        let column = |name: &str| series.columns.iter().position(|column| column == name).unwrap_or_default();
        let most = |name: &str, measure: fn(f64) -> f64, over: f64| {
            let k = column(name);
            let first = Peak::default();
            rows.iter().fold(first, |worst, row| match measure(row[k] / over) > measure(worst.value) {
                true => Peak { value: row[k] / over, time_s: row[0], verdict: None },
                false => worst,
            })
        };
        let (first, last) = (&rows[0], &rows[rows.len() - 1]);
        let pitch = rows.iter().map(|row| row[column("pitch_deg")]);
        let line_load = most("line_load_N_per_m", |v| v, 1.0);
        let heaviest = rows.iter().find(|row| row[0] == line_load.time_s).unwrap_or(first);
        let deceleration = most("ax_m_per_s2", |v| -v, scene.water.gravity);
        let (status, message) = match &run.ended {
            LandingEnd::Time | LandingEnd::Slow => (Status::Completed, None),
            LandingEnd::Aloft(what) => (Status::CompletedWithDoubts, Some(what.clone())),
            LandingEnd::OutOfRange(what) => (Status::Failed, Some(what.clone())),
        };
        Summary {
            scene: scene.name.clone(),
            status,
            message,
            assumptions: scene.assumptions.clone(),
            model: scene.model.name(),
            strips: scene.landing.strips,
            steps: (last[0] / scene.landing.step).round() as u64,
            time_end_s: last[0],
            wall_time_s,
            ended_at_m_per_s: scene.landing.least_speed.filter(|_| run.ended == LandingEnd::Slow),
            run_length_m: last[column("x_m")] - first[column("x_m")],
            speed_m_per_s: [first, last].map(|row| row[column("u_m_per_s")]),
            pitch_deg: [
                first[column("pitch_deg")],
                pitch.clone().fold(f64::INFINITY, f64::min),
                pitch.fold(f64::NEG_INFINITY, f64::max),
            ],
            az_g: most("az_m_per_s2", |v| v, scene.water.gravity),
            deceleration_g: Peak { value: -deceleration.value, ..deceleration },
            load_factor: most("load_factor", |v| v, 1.0),
            fz_n: most("fz_N", |v| v, 1.0),
            moment_nm: most("moment_Nm", f64::abs, 1.0),
            line_load_n_per_m: line_load,
            line_load_at_m: heaviest[column("line_load_at_m")],
            sea: None,
            warnings: Vec::new(),
            structure,
        }
    }

    /// The file.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// Accelerometers and lost parts, a line for each kind.
    fn structure_text(&self) -> String {
        let Structure { accelerometers, parts, .. } = &self.structure;
        let shown = |a: &Accelerometer| format!("{} {:.2}, {:.2} g", a.name, a.normal_g.value, a.longitudinal_g.value);
        let shown: Vec<String> = accelerometers.iter().map(shown).collect();
        let lost = parts.iter().filter_map(|p| Some(format!("{} at {:.3} s", p.name, p.lost_at_s?)));
        let lost: Vec<String> = lost.collect();
        let line = |words: &str, list: &[String], between: &str| match list {
            [] => String::new(),
            list => format!("\n  {words}: {}", list.join(between)),
        };
        line("accelerometers, upwards and deceleration", &shown, "; ") + &line("lost", &lost, ", ")
    }

    /// Windows and flotation, a line for each.
    fn afloat_text(&self) -> String {
        let window = |w: &WindowLoad| {
            let (mean, time) = (1e-3 * w.mean_pressure_pa.value, w.mean_pressure_pa.time_s);
            format!(
                "\n  window {}: largest mean pressure {mean:.1} kPa at {time:.3} s over {:.2} m2",
                w.name, w.area_m2
            )
        };
        let windows: String = self.structure.windows.iter().map(window).collect();
        let windows = windows + &plating::lines(&self.structure.plating);
        let Some(afloat) = &self.structure.flotation else { return windows };
        let sill = |s: &flotation::SillTime| {
            let when = s.reached_s.map_or("stays dry".to_string(), |t| format!("wet at {t:.0} s"));
            format!("; {} {:.2} m over water, {when}", s.name, s.over_water_m)
        };
        let sills: String = afloat.openings.iter().map(sill).collect();
        let sinks = afloat.sinks_at_s.map_or(String::new(), |t| format!("; sinks at {t:.0} s"));
        match afloat.floats {
            true => format!(
                "{windows}\n  afloat: water {:.2} m over the body axis at the centre of mass, trim {:.1} degrees{sills}{sinks}",
                afloat.waterline_m, afloat.trim_deg
            ),
            false => windows + "\n  afloat: it has no trim within 31 degrees, or sinks at once",
        }
    }

    /// The first contact with the waves, and the warnings, a line for each.
    fn sea_text(&self) -> String {
        let touch = self.sea.as_ref().map_or(String::new(), |sea| {
            let Sea { touchdown_phase_deg: phase, touchdown_at_m: at, elevation_m: elevation, .. } = sea;
            let phase = phase.map_or(String::new(), |phase| format!(" at phase {phase:.0} degrees"));
            format!("\n  first contact {at:.1} m from the nose{phase}, elevation {elevation:.2} m")
        });
        touch + &self.warnings.iter().map(|warning| format!("\n  warning: {warning}")).collect::<String>()
    }

    /// The numbers in a few lines.
    pub fn to_text(&self) -> String {
        let at = |p: &Peak, unit: &str| format!("{:.2}{unit} at {:.3} s", p.value, p.time_s);
        let (line, place) = (&self.line_load_n_per_m, self.line_load_at_m);
        let ended =
            self.ended_at_m_per_s.map_or(String::new(), |v| format!("; ended at landing.least_speed, {v:.1} m/s"));
        let keel = match place.is_finite() {
            true => format!("{:.0} kN/m of keel {place:.1} m from the nose at {:.3} s", 1e-3 * line.value, line.time_s),
            false => "the keel stays dry".to_string(),
        };
        format!(
            "{}: {} strips, {} steps, {:.1} s of wall time\n  vertical {}, load factor {}; deceleration {}\n  water {:.0} kN \
             at {:.3} s; {keel}\n  {:.1} m in {:.2} s, from {:.1} to {:.1} m/s; pitch \
             {:.1} to {:.1} degrees{ended}{}{}{}\n  {NO_BAND}{}",
            self.scene,
            self.strips,
            self.steps,
            self.wall_time_s,
            at(&self.az_g, " g"),
            at(&self.load_factor, ""),
            at(&self.deceleration_g, " g"),
            1e-3 * self.fz_n.value,
            self.fz_n.time_s,
            self.run_length_m,
            self.time_end_s,
            self.speed_m_per_s[0],
            self.speed_m_per_s[1],
            self.pitch_deg[1],
            self.pitch_deg[2],
            self.sea_text(),
            self.structure_text() + &self.afloat_text(),
            self.assumptions.iter().map(|assumed| format!("\n  assumed: {assumed}")).collect::<String>(),
            self.message
                .as_ref()
                .filter(|_| self.status.is_completed())
                .map_or(String::new(), |what| format!("\n  DOUBT: {what}"))
        )
    }
}
