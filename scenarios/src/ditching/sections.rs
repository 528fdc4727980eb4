//! Scenes of particles of a landing's sections, for quantities that a theory does not have: pressures, spray, the flow.

use std::path::PathBuf;

use run::{RunError, RunOptions, load_text, run};
use scene::SceneError;
use scene::vocabulary::Status;
use serde::Serialize;
use water_entry::ditching::{Hull, ImpactingPart, SectionLoad};

use super::checked::hull;
use super::landed::Landed;
use super::model::Scene;
use super::stations::shape_keys;

/// Particle spacings over the breadth of a section, at least.
const SPACINGS: f64 = 200.0;

/// Particle spacings in the draught that is compared, at least: from sixteen on the force of an entry is within 1 %.
const SPACINGS_DEEP: f64 = 16.0;

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
/// Each enters at a constant speed, that of the keel in its plane of water then: a speed that changes with time is not among the
/// motions of a scene.
pub fn section_scenes(scene: &Scene, landed: &Landed, count: usize) -> Vec<SectionScene> {
    let heaviest = landed.run.moments.iter().max_by(|a, b| a.force[1].total_cmp(&b.force[1]));
    let (Ok(hull), Some(moment)) = (hull(scene), heaviest) else {
        return Vec::new();
    };
    let pressing = moment.strips.iter().filter(|(_, force)| *force > 0.0);
    let entries: Vec<ImpactingPart> = pressing.filter_map(|(strip, _)| strip.entry).collect();
    let place = |k: usize| entries.get((2 * k + 1) * entries.len() / (2 * count));
    (0..count).filter_map(place).map(|entry| section_scene(scene, entry, moment.time, &hull)).collect()
}

fn section_scene(scene: &Scene, entry: &ImpactingPart, time: f64, hull: &Hull) -> SectionScene {
    let (x, draught, speed) = (entry.at.x, entry.at.draught, entry.at.speed);
    let breadth = hull.fuselage().breadth(x);
    let shape = shape_keys(&hull.form(x), breadth);
    let name = format!("{}_{x:04.1}m", scene.name).replace('.', "p");
    let SectionLoad { slam, area, .. } = hull.at(x, draught);
    let (time_s, by_theory) =
        (draught / speed, scene.water.density * (slam * speed * speed + scene.water.gravity * area));
    let text = format!(
        "# The section {x:.2} m from the nose of {} when the load of the water is largest, t = {time:.3} s: draught {draught:.4} m and\n\
         # {speed:.3} m/s in its plane of water. It enters at that speed from the first touch on, to 1.2 times that draught, at\n\
         # t = {:.5} s, where {} and buoyancy say {by_theory:.0} N/m.\n\
         name = \"{name}\"\n\
         description = \"Section {x:.2} m from the nose of {}: entry at constant speed\"\n\
         symmetry = \"x\"\ngravity = [0.0, {:?}]\n\n\
         [time]\nend = {:?}\n\n[resolution]\nspacing = {:?}\n\n\
         [fluid]\ndensity = {:?}\n\n\
         [body]\nname = \"section\"\n{shape}\n\
         motion = \"constant_velocity\"\nvelocity = [0.0, {:?}]\n\n\
         [[gauges]]\nname = \"keel\"\nat = [0.0, 0.0]\n",
        scene.name,
        time_s,
        scene.model.name(),
        scene.name,
        -scene.water.gravity,
        1.2 * draught / speed,
        (breadth / SPACINGS).min(draught / SPACINGS_DEEP),
        scene.water.density,
        -speed
    );
    SectionScene { name, text, time_s, by_theory }
}
