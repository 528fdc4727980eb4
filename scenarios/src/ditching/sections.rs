//! Scenes of particles of a landing's sections, for quantities that a theory does not have: pressures, spray, the flow.

use std::path::PathBuf;

use run::{RunError, RunOptions, load_text, run};
use scene::SceneError;
use scene::vocabulary::Status;
use serde::Serialize;
use water_entry::ditching::{ImpactingPart, SectionLoad};

use super::checked::{hull, landing};
use super::landed::Landed;
use super::model::Scene;
use super::section_text::SectionEntry;

/// Particle spacings over the breadth of a section, at least.
const SPACINGS: f64 = 200.0;

/// Particle spacings in the draught that is compared, at least: from sixteen on the force of an entry is within 1 %.
const SPACINGS_DEEP: f64 = 16.0;

/// End of a scene over the time of the load that is compared [-].
const BEYOND: f64 = 1.2;

/// Particle spacings in a bay of plating, at least: eight elements.
const SPACINGS_OF_BAY: f64 = 16.0;

/// A section's entry as a scene that `splashdown run` takes.
#[derive(Clone, Debug)]
pub struct SectionScene {
    /// Its name, and its file's without the ending.
    pub name: String,
    /// The scene file.
    pub text: String,
    /// Time at which it is as deep as on the landing [s].
    pub time_s: f64,
    /// Force at that time by the landing's theory, buoyancy included [N/m].
    pub by_theory: f64,
}

/// A section's force by particles beside the theory's.
#[derive(Clone, Debug, Serialize)]
pub struct SectionResult {
    /// Name of its scene.
    pub name: String,
    /// When both are taken [s].
    pub time_s: f64,
    /// By the landing's theory [N/m].
    pub by_theory_n_per_m: f64,
    /// By particles, mean over a tenth of the time before and after [N/m].
    pub by_particles_n_per_m: f64,
    /// Time that it took here [s].
    pub wall_time_s: f64,
}

/// Why a section was not run.
#[derive(Debug, thiserror::Error)]
pub enum SectionError {
    /// Its scene is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Its run cannot be kept.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Its run broke down.
    #[error("{0}: {1}")]
    Ended(String, String),
}

impl SectionScene {
    /// Run it, with its files in a folder.
    pub fn run(&self, out: PathBuf, force: bool) -> Result<SectionResult, SectionError> {
        let loaded = load_text(&format!("{}.toml", self.name), &self.text, &[])?;
        let done = run(
            &loaded.scene,
            &RunOptions { out: Some(out), force, page: Some(report::page_of_run), ..RunOptions::default() },
        )?;
        if let (Status::Failed, Some(why)) = (done.summary.status, &done.summary.message) {
            return Err(SectionError::Ended(self.name.clone(), why.clone()));
        }
        let forces = done.series.column("section.fy_N_per_m").unwrap_or_default();
        let near = |t: f64| (t - self.time_s).abs() <= 0.1 * self.time_s;
        let near: Vec<f64> =
            done.series.times().into_iter().zip(forces).filter(|(t, _)| near(*t)).map(|p| p.1).collect();
        Ok(SectionResult {
            name: self.name.clone(),
            time_s: self.time_s,
            by_theory_n_per_m: self.by_theory,
            by_particles_n_per_m: near.iter().sum::<f64>() / near.len() as f64,
            wall_time_s: done.summary.wall_time_s,
        })
    }
}

/// Scenes of `count` places, spread evenly over the keel that presses when the load of the water is largest.
///
/// Each enters as its plane of water sees it (THEORY EN63), with the panels of plating that the landing has there. Places whose plane meets an
/// end of the fuselage first are left out.
pub fn section_scenes(scene: &Scene, landed: &Landed, count: usize) -> Vec<SectionScene> {
    let moments = &landed.run.moments;
    let heaviest = (0..moments.len()).max_by(|a, b| moments[*a].force[1].total_cmp(&moments[*b].force[1]));
    let (Ok(hull), Some(at)) = (hull(scene), heaviest) else {
        return Vec::new();
    };
    let landing = landing(scene, &hull);
    let pressing = moments[at].strips.iter().filter(|(_, force)| *force > 0.0);
    let entries: Vec<ImpactingPart> = pressing.filter_map(|(strip, _)| strip.entry).collect();
    let place = |k: usize| entries.get((2 * k + 1) * entries.len() / (2 * count));
    let scene_of = |entry: &ImpactingPart| {
        let history = landing.plane_history(&landed.run.flight, moments[at].time, entry.at.x)?;
        Some(section_scene(SectionEntry { scene, hull: &hull, x: entry.at.x, history }, moments[at].time))
    };
    (0..count).filter_map(place).filter_map(scene_of).collect()
}

fn section_scene(mut entry: SectionEntry<'_>, time: f64) -> SectionScene {
    let contact = entry.contact();
    let end = contact + BEYOND * (time - contact);
    let rows = &mut entry.history.rows;
    let kept = rows.iter().position(|row| row.time >= end).map_or(rows.len(), |k| k + 1);
    rows.truncate(kept.max(2));
    let end = end.min(rows[rows.len() - 1].time) - contact;
    let SectionEntry { scene, hull, x, history } = &entry;
    let rows = &history.rows;
    let now = rows.iter().find(|row| row.time >= (1.0 - 1e-9) * time).unwrap_or(&rows[rows.len() - 1]);
    let time_s = now.time - contact;
    let name = format!("{}_{x:04.1}m", scene.name).replace('.', "p");
    let SectionLoad { slam, added_mass, area, .. } = hull.at(*x, now.draught);
    let by_theory =
        scene.water.density * (slam * now.speed * now.speed + added_mass * now.rate + scene.water.gravity * area);
    let head = format!(
        "# The section {x:.2} m from the nose of {} on the way that its plane of water sees, from the contact at {contact:.4} s on. When the load\n\
         # of the water is largest, at t = {time_s:.5} s, its draught is {:.4} m and its speed {:.3} m/s; {} and buoyancy say\n\
         # {by_theory:.0} N/m.\n\
         name = \"{name}\"\n\
         description = \"Section {x:.2} m from the nose of {}, as on the landing\"\n",
        scene.name,
        now.draught,
        now.speed,
        scene.model.name(),
        scene.name,
    );
    let plating = scene.plating.iter().filter(|keys| (keys.from..=keys.to).contains(x));
    let plates: Vec<_> = plating.filter_map(|keys| Some((keys, keys.plate()?))).collect();
    let shortest = plates.iter().flat_map(|(keys, _)| keys.bays()).map(|bay| entry.bay_length(&bay));
    let spacing = (entry.breadth() / SPACINGS).min(now.draught / SPACINGS_DEEP);
    let spacing = shortest.map(|length| length / SPACINGS_OF_BAY).fold(spacing, f64::min);
    let panels: String = plates.iter().map(|(keys, plate)| entry.panels(keys, plate, None)).collect();
    let tail = format!("{panels}\n[[gauges]]\nname = \"keel\"\nat = [0.0, 0.0]\n");
    SectionScene { name, text: entry.text(&head, [end, end / 400.0], spacing, &tail), time_s, by_theory }
}
