//! What a scene may be run with, but not relied on for; in plain words.

use std::f64::consts::TAU;

use fsi_coupling::PanelEnd;
use settings::significant;
use sph_core::{Dissipation, Kernel, Solver};
use water_entry::EntryModel;

use super::auto::{ACOUSTIC_REACH, WATER_SOUND};
use super::entry_warnings::{entry_warnings, lost_forces, short_of_water_all};
use super::exchange::{light_bodies, light_panels};
use super::force_limits::limit_of_forces;
use super::impact::LEAST_SOUND_RATIO;
use super::incompressible::projection_warnings;
use super::keys::{Body, Gauge, Panel, Scene, WeaklyCompressibleFluid, panel_length};
use super::legacy;
use super::resolve_links::thin_film;
use super::waves::wave_warnings;

const LARGEST_CFL: f64 = 0.8;

/// Densities of usual liquids [kg/m³].
const LIQUID: [f64; 2] = [500.0, 3000.0];

/// Courant number up to which the Riemann form runs (WC13): with Wendland C6, and with the wider kernels.
const RIEMANN_CFL: [f64; 2] = [0.65, 0.7];

/// Courant number at which stretched walls run without artificial viscosity.
const STRETCHED_CFL: f64 = 0.4;

/// Samples in a period of a gauge's bandwidth.
const SAMPLES_PER_PERIOD: f64 = 5.0;

const LARGEST_GROWTH: f64 = 1.2;
/// Deflection over length from which a clamped or pinned plate is rather a membrane [-].
const MEMBRANE: f64 = 0.1;
/// Elements this short, in spacings, held with a light and soft panel; 0.83 did not [-].
const SHORTEST: f64 = 1.5;
/// Mass of a panel over that of a row of water below which it counts as light [-].
const LIGHT: f64 = 1.0;
/// Periods of the first dry mode in a step from which the step leaves the panel's vibration out [-].
const UNRESOLVED: f64 = 0.1;

/// Warnings about a scene that runs nevertheless: each says what is doubtful, with the number, and what would cure it.
pub fn warnings(scene: &Scene) -> Vec<String> {
    if scene.model.is_theory() {
        return theory_warnings(scene);
    }
    let mut warnings: Vec<String> = match scene.solver.weakly_compressible() {
        None => projection_warnings(scene),
        Some(fluid) => sound_warnings(scene, fluid),
    };
    warnings.extend(thin_film(scene));
    let density = scene.water().density;
    if !(LIQUID[0]..=LIQUID[1]).contains(&density) {
        warnings.push(format!(
            "fluid.density = {density} kg/m^3 is that of no usual liquid: the weakly compressible laws and bands were measured in water"
        ));
    }
    if scene.solver.kind() == Solver::IncompressibleThesis {
        warnings.extend(legacy::thesis_warnings(scene.water().smoothing_ratio, scene.body.is_some()));
    }
    warnings.extend(entry_warnings(scene));
    if scene.resolution.growth > LARGEST_GROWTH {
        warnings.push(format!(
            "resolution.growth = {}: up to 1.2 is harmless, 1.5 costs 9 % of the force",
            scene.resolution.growth
        ));
    }
    if scene.water().kernel == Kernel::Quadratic && scene.body.is_some() {
        warnings
            .push("fluid.kernel = \"quadratic\" broke down in the jet of a wedge: use it for comparison only".into());
    }
    warnings.extend(limit_of_forces(scene));
    warnings.extend(scene.all_bodies().filter_map(|body| body.short_table(scene.time.end)));
    warnings.extend(wave_warnings(scene));
    warnings.extend(scene.all_bodies().filter_map(Body::kinks));
    warnings.extend(doubtful_panels(scene));
    warnings.extend(scene.gauges.iter().filter_map(|gauge| coarse_samples(scene, gauge)));
    let late = scene.compare.iter().filter(|compare| compare.window[0] >= scene.time.end);
    warnings.extend(late.map(|compare| {
        format!(
            "{} is compared from {} s on, after the end of the run at {} s",
            compare.quantity, compare.window[0], scene.time.end
        )
    }));
    warnings
}

/// Warnings about a run by a theory.
fn theory_warnings(scene: &Scene) -> Vec<String> {
    let singular = (scene.model == EntryModel::Wagner && !scene.gauges.is_empty()).then(|| {
        "Wagner's pressure is infinite at the spray root: a gauge's peak depends on time.sample_every".to_string()
    });
    short_of_water_all(scene).into_iter().chain(singular).collect()
}

/// Warnings about water that carries sound: how fast, in which steps, how far, and beside what.
/// Acoustic steps per geometry that gain nothing, or cost accuracy.
fn held_geometry(steps: u32) -> Option<String> {
    match steps {
        2 | 3 => Some(format!(
            "fluid.acoustic_steps = {steps}: weights are made for too few steps, which was slower than 1 in splashes; 4 is faster"
        )),
        8.. => Some(format!(
            "fluid.acoustic_steps = {steps}: forces are two to six times as noisy as with 1, the largest pressure of a wedge was up to 23 % high \
             with 16; no chart gives error bars above 4"
        )),
        _ => None,
    }
}

fn sound_warnings(scene: &Scene, fluid: &WeaklyCompressibleFluid) -> Vec<String> {
    let mut warnings = Vec::new();
    let cfl = scene.courant_number();
    warnings.extend(slow_sound(scene));
    if scene.sound_speed() > WATER_SOUND {
        warnings.push(format!(
            "fluid.sound_speed = {} m/s is above that of water, {WATER_SOUND} m/s: steps are shorter and first contacts harder than in water",
            significant(scene.sound_speed())
        ));
    }
    warnings.extend(held_geometry(fluid.scheme.acoustic_steps()));
    warnings.extend(lost_forces(scene));
    if scene.entries().iter().any(|(_, entry)| entry.final_draught > 0.0) {
        warnings.extend(echo(scene));
    }
    if cfl > LARGEST_CFL {
        warnings.push(format!("fluid.cfl = {cfl}: 0.8 ran, 1.2 blew up"));
    }
    warnings.extend(strained_step(fluid, cfl));
    let h = fluid.water.fluid.smoothing_ratio * scene.resolution.spacing;
    let acoustic = h / (scene.sound_speed() + scene.fastest_speed());
    if let Some(step) = scene.time.step.filter(|step| *step > LARGEST_CFL * acoustic) {
        warnings.push(format!(
            "time.step = {step} s is {} times h/(c0 + |v|) at the fastest known speed: 0.8 ran, 1.2 blew up",
            significant(step / acoustic)
        ));
    }
    warnings.extend(legacy::warnings(&fluid.scheme, &fluid.options, cfl));
    warnings.extend(light_bodies(scene));
    warnings.extend(light_panels(scene));
    warnings
}

/// Limits of the step of the Riemann form (WC13) and of stretched walls (WA4).
fn strained_step(fluid: &WeaklyCompressibleFluid, cfl: f64) -> Vec<String> {
    let (scheme, mut warnings) = (&fluid.scheme, Vec::new());
    let narrow = fluid.water.fluid.kernel == Kernel::WendlandC6;
    if scheme.dissipation == Dissipation::Riemann && cfl > RIEMANN_CFL[usize::from(!narrow)] {
        warnings.push(format!(
            "fluid.cfl = {cfl} with fluid.dissipation = \"riemann\": 0.7 ran and 0.75 did not with wendland_c4, 0.85 ran and \
             0.9 did not with wendland_c2; the limit of wendland_c6 is 0.673"
        ));
    }
    if scheme.wall_stretch && cfl > STRETCHED_CFL {
        warnings.push(format!(
            "fluid.wall_stretch at fluid.cfl = {cfl}: the force on a wedge broke into oscillation late in some runs; at 0.4 \
             it did not"
        ));
    }
    warnings
}

/// A filtered curve is shown whole by samples at more than twice its bandwidth (Shannon 1949); 5 times for its shape.
fn coarse_samples(scene: &Scene, gauge: &Gauge) -> Option<String> {
    let (bandwidth, every) = (gauge.bandwidth?, scene.time.sample_every);
    (every * bandwidth > 1.0 / SAMPLES_PER_PERIOD).then(|| {
        format!(
            "{} has a bandwidth of {} Hz and is sampled at {} Hz: the filter sees every step, but the series misses peaks; \
             {} s would do for time.sample_every",
            gauge.name,
            significant(bandwidth),
            significant(1.0 / every),
            significant(1.0 / (SAMPLES_PER_PERIOD * bandwidth))
        )
    })
}

fn slow_sound(scene: &Scene) -> Option<String> {
    let (fastest, sound) = (scene.fastest_speed(), scene.sound_speed());
    // A hair of slack: an "auto" speed of sound is exactly the least.
    (sound < LEAST_SOUND_RATIO * fastest * (1.0 - 1e-9)).then(|| {
        format!(
            "fluid.sound_speed = {} m/s is {} times the flow's fastest known speed, {} m/s, Mach {}: water is nearly \
             incompressible from {LEAST_SOUND_RATIO} times on, up to Mach {}",
            significant(sound),
            significant(sound / fastest),
            significant(fastest),
            significant(fastest / sound),
            1.0 / LEAST_SOUND_RATIO
        )
    })
}

fn echo(scene: &Scene) -> Option<String> {
    let beside = scene
        .entries()
        .iter()
        .map(|(body, _)| 0.5 * scene.tank.width - body.middle().abs())
        .fold(f64::INFINITY, f64::min);
    let reach = beside.min(scene.tank.depth);
    let needed = ACOUSTIC_REACH * scene.sound_speed() * scene.time.end;
    // A hair of slack: an "auto" tank is exactly as large as needed.
    (reach < needed * (1.0 - 1e-9)).then(|| {
        format!(
            "the echo from the tank's walls, {} m away, reaches the body after about {} s: {} m would keep it out",
            significant(reach),
            significant(scene.time.end * reach / needed),
            significant(needed)
        )
    })
}

/// Warnings about a scene's panels, each with its number and a cure.
fn doubtful_panels(scene: &Scene) -> Vec<String> {
    let Some(body) = &scene.body else { return Vec::new() };
    let each = body.panels.iter();
    each.flat_map(|panel| [thin(scene, body, panel), short(scene, body, panel), slow(scene, body, panel)])
        .flatten()
        .collect()
}

/// Bending stiffness D = E h³/(12 (1 − ν²)), without the bracket in plane stress [N m].
fn stiffness(panel: &Panel) -> f64 {
    panel.plane.modulus(&panel.material()) * panel.thickness.powi(3) / 12.0
}

/// A plate on two supports under the mean pressure of a wedge's entry (Wagner 1932) or of the depth: w = q L⁴/(384 D) clamped, five
/// times that pinned.
fn thin(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    use PanelEnd::{Clamped, Free, Guided};
    let both = !panel.ends.contains(&Free);
    let softest = if panel.ends.iter().all(|end| matches!(end, Clamped | Guided)) { 1.0 } else { 5.0 };
    // rho V dc/dt
    let pressure = match scene.entry() {
        Some(entry) => scene.water().density * body.velocity[0].hypot(body.velocity[1]) * entry.root_speed(),
        None => scene.water().density * scene.tank.depth * scene.gravity[1].abs(),
    };
    let long = panel_length(body, panel);
    let deflection = softest * pressure * long.powi(4) / (384.0 * stiffness(panel));
    (both && deflection > MEMBRANE * long).then(|| {
        format!(
            "{} is so thin that {} Pa bend it by {} of its length in plate theory: it will carry its load as a membrane, and \
             strains may be far beyond what its material bears",
            panel.name,
            significant(pressure),
            significant(deflection / long)
        )
    })
}

/// Elements much shorter than a spacing let a light panel crumple between particles.
fn short(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    let spacings = panel_length(body, panel) / panel.elements as f64 / scene.resolution.spacing;
    let light = panel.density * panel.thickness < LIGHT * scene.water().density * scene.resolution.spacing;
    (light && spacings < SHORTEST).then(|| {
        format!(
            "{} is light, and its elements are {} spacings long: below {SHORTEST} soft panels crumpled between the particles and \
             the run broke down; {} elements would do",
            panel.name,
            significant(spacings),
            (panel_length(body, panel) / (SHORTEST * scene.resolution.spacing)).floor().max(2.0)
        )
    })
}

/// First dry mode of a clamped or pinned plate, ω = (λ/L)² √(D/m), at the least λ that its ends allow.
fn slow(scene: &Scene, body: &Body, panel: &Panel) -> Option<String> {
    let step = scene.time.step?;
    let free = panel.ends.contains(&PanelEnd::Free);
    let lambda = if free { 1.875 } else { 4.730 };
    let mass = panel.density * panel.thickness;
    let omega = (lambda / panel_length(body, panel)).powi(2) * (stiffness(panel) / mass).sqrt();
    let share = step * omega / TAU;
    (share > UNRESOLVED).then(|| {
        format!(
            "time.step = {step} s is {} of the period of {}'s first dry mode: steps longer than a tenth leave its vibration out",
            significant(share),
            panel.name
        )
    })
}
