//! Scenes of particles of a landing's sections, for what a theory does not say: pressures, spray, the flow.

use fsi_coupling::theory::ditching::{Entering, Form, Hull};

use super::check::hull;
use super::model::Scene;
use super::run::Landed;

/// Particle spacings over the breadth of a section.
const SPACINGS: f64 = 200.0;

/// A section's entry as a scene that `splashdown run` takes.
#[derive(Clone, Debug)]
pub struct SectionScene {
    /// Its name, and its file's without the ending.
    pub name: String,
    /// The scene file.
    pub text: String,
}

/// Scenes of `count` places, spread evenly over the keel that presses when the water bears most.
///
/// Each enters at a constant speed, that of the keel in its plane of water then: a speed that changes with time is not among the
/// motions of a scene.
pub fn section_scenes(scene: &Scene, landed: &Landed, count: usize) -> Vec<SectionScene> {
    let heaviest = landed.run.moments.iter().max_by(|a, b| a.force[1].total_cmp(&b.force[1]));
    let (Ok(hull), Some(moment)) = (hull(scene), heaviest) else {
        return Vec::new();
    };
    let pressing = moment.strips.iter().filter(|(_, force)| *force > 0.0);
    let entries: Vec<Entering> = pressing.filter_map(|(strip, _)| strip.entry).collect();
    let place = |k: usize| entries.get((2 * k + 1) * entries.len() / (2 * count));
    (0..count).filter_map(place).map(|entry| section_scene(scene, entry, moment.time, &hull)).collect()
}

fn section_scene(scene: &Scene, entry: &Entering, time: f64, hull: &Hull) -> SectionScene {
    let (x, draught, speed) = (entry.at.x, entry.at.draught, entry.at.speed);
    let breadth = hull.fuselage().breadth(x);
    let shape = match hull.form(x) {
        Form::Radius(radius) => format!("shape = \"arc\"\nradius = {radius:?}"),
        Form::DeadriseDeg(deadrise) => format!("shape = \"wedge\"\ndeadrise_deg = {deadrise:?}"),
    };
    let name = format!("{}_{x:04.1}m", scene.name).replace('.', "p");
    let force = scene.water.density * hull.at(x, draught).slam * speed * speed;
    let text = format!(
        "# The section {x:.2} m from the nose of {} when the water bears most, t = {time:.3} s: draught {draught:.4} m and\n\
         # {speed:.3} m/s in its plane of water. It enters at that speed from the first touch on, to 1.2 times that draught, at\n\
         # t = {:.5} s, where {} says {force:.0} N/m.\n\
         name = \"{name}\"\n\
         description = \"Section {x:.2} m from the nose of {}: entry at constant speed\"\n\
         symmetry = \"x\"\n\n\
         [time]\nend = {:?}\n\n[resolution]\nspacing = {:?}\n\n\
         [fluid]\ndensity = {:?}\n\n\
         [body]\nname = \"section\"\n{shape}\nbreadth = {breadth:?}\nside_height = {:?}\n\
         motion = \"constant_velocity\"\nvelocity = [0.0, {:?}]\n\n\
         [[gauges]]\nname = \"keel\"\nat = [0.0, 0.0]\n",
        scene.name,
        draught / speed,
        scene.model.name(),
        scene.name,
        1.2 * draught / speed,
        breadth / SPACINGS,
        scene.water.density,
        0.5 * breadth,
        -speed
    );
    SectionScene { name, text }
}
