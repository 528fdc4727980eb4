//! What a scene may be run with, but not relied on for; in plain words.

use super::auto::{ACOUSTIC_REACH, LEAST_SOUND_RATIO};
use super::chine::past_the_chine;
use super::exchange::{light_body, light_panels};
use super::impact::{Entry, known_compressibility_error};
use super::incompressible::{projection_warnings, thesis_warnings};
use super::panels::doubtful_panels;
use super::settings::{Gauge, Scene, WeaklyCompressibleFluid};
use fsi_coupling::entry_theory::EntryModel;
use fsi_coupling::settings::significant;
use sph_core::{DensityEvolution, Dissipation, Integrator, Kernel};

/// Spacings across the length with 90 % of the peak pressure: 17 give the peak to 2–4 %, 5 to 25 %.
const PEAK_SPACINGS: f64 = 17.0;

/// Draught over spacing from which the force of an entry is within 1 %.
const STARTING_DRAUGHT: f64 = 16.0;

const LARGEST_CFL: f64 = 0.8;

/// Growth of the difference of Verlet's time levels from one Euler step to the next: 2.6 ran, 98 blew up.
const LARGEST_VERLET_GROWTH: f64 = 10.0;
/// Courant number up to which the Riemann form runs with every kernel tried (WC13).
const RIEMANN_CFL: f64 = 0.7;

/// Courant number at which stretched walls run without artificial viscosity.
const STRETCHED_CFL: f64 = 0.4;

/// δ that damps a single particle's density as the Riemann form does [-], with Wendland C2 (WC8).
const RIEMANN_DELTA: f64 = 1.0 / 3.0;

/// Samples in a period of a gauge's bandwidth.
const SAMPLES_PER_PERIOD: f64 = 5.0;

const LARGEST_GROWTH: f64 = 1.2;

/// Warnings about a scene that runs nevertheless: each says what is doubtful, with the number, and what would cure it.
pub fn warnings(scene: &Scene) -> Vec<String> {
    if scene.model.is_theory() {
        return theory_warnings(scene);
    }
    let mut warnings = match scene.solver.weakly_compressible() {
        None => projection_warnings(scene),
        Some(fluid) => sound_warnings(scene, fluid),
    };
    warnings.extend(thesis_warnings(scene));
    if let Some(entry) = scene.entry() {
        match entry.final_draught > 0.0 {
            true => warnings.extend(entry_warnings(scene, &entry)),
            false => warnings.push(format!(
                "the body does not reach the water: at the end of the run it is {} m above it",
                significant(-entry.final_draught)
            )),
        }
    }
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
    let short = scene.entry().filter(|entry| entry.final_draught <= 0.0).map(|entry| {
        let above = significant(-entry.final_draught);
        format!("the body does not reach the water: at the end of the run it is {above} m above it")
    });
    let singular = (scene.model == EntryModel::Wagner && !scene.gauges.is_empty()).then(|| {
        "Wagner's pressure is infinite at the spray root: a gauge's peak depends on time.sample_every".to_string()
    });
    short.into_iter().chain(singular).collect()
}

/// Warnings about water that carries sound: how fast, in which steps, how far, and beside what.
fn sound_warnings(scene: &Scene, fluid: &WeaklyCompressibleFluid) -> Vec<String> {
    let mut warnings = Vec::new();
    let cfl = scene.courant_number();
    warnings.extend(slow_sound(scene));
    if let Some(entry) = scene.entry().filter(|entry| entry.final_draught > 0.0) {
        warnings.extend(lost_force(scene, &entry));
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
    warnings.extend(loose_verlet(fluid, cfl));
    if fluid.options.density_evolution == DensityEvolution::Summation {
        warnings.push("fluid.density_evolution = \"summation\" fails at a free surface: for comparison only".into());
    }
    warnings.extend(light_body(scene));
    warnings.extend(light_panels(scene));
    warnings
}

/// Limits of the step of the Riemann form (WC13) and of stretched walls (WA4).
fn strained_step(fluid: &WeaklyCompressibleFluid, cfl: f64) -> Vec<String> {
    let (scheme, mut warnings) = (&fluid.scheme, Vec::new());
    if scheme.dissipation == Dissipation::Riemann && cfl > RIEMANN_CFL {
        warnings.push(format!(
            "fluid.cfl = {cfl} with fluid.dissipation = \"riemann\": 0.7 ran and 0.75 did not with wendland_c4, 0.85 ran and \
             0.9 did not with wendland_c2"
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

/// Between two Euler steps, dissipation damps the flow by about e^(−d) a step, d = 7 δ C, and grows the difference of
/// Verlet's two time levels by as much (LE3); an Euler step leaves about ½d² of it.
fn loose_verlet(fluid: &WeaklyCompressibleFluid, cfl: f64) -> Option<String> {
    let scheme = &fluid.scheme;
    let every = f64::from(fluid.options.verlet_correction_every);
    let (delta, diffusion) = match scheme.dissipation {
        Dissipation::Diffusion => {
            (scheme.density_diffusion, format!("fluid.density_diffusion = {}", scheme.density_diffusion))
        }
        Dissipation::Riemann => (RIEMANN_DELTA, "fluid.dissipation = \"riemann\"".to_string()),
    };
    let damping = 7.0 * delta * cfl;
    let growth = 0.5 * damping * damping * (damping * every).exp();
    let loose = every == 0.0 || growth > LARGEST_VERLET_GROWTH;
    (fluid.options.integrator == Integrator::Verlet && loose).then(|| {
        format!(
            "fluid.verlet_correction_every = {every}: with fluid.cfl = {cfl} and {diffusion} the two time \
             levels of verlet drift apart; correct more often, or lower either"
        )
    })
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

/// What compressibility takes of an impact's force.
fn lost_force(scene: &Scene, entry: &Entry) -> Option<String> {
    let (root, sound) = (entry.root_speed(), scene.sound_speed());
    match known_compressibility_error(root, sound) {
        None => Some(format!(
            "the spray root starts at Mach {}: what compressibility takes of the force is known up to 0.3; compare with a \
             larger fluid.sound_speed",
            significant(root / sound)
        )),
        Some(error) if error > scene.solver.water().compressibility_error * (1.0 + 1e-9) => Some(format!(
            "compressibility takes about {} % of the force at Mach {} of the spray root; fluid.compressibility_error \
             admits {} %: raise fluid.sound_speed",
            significant(100.0 * error),
            significant(root / sound),
            significant(100.0 * scene.solver.water().compressibility_error)
        )),
        Some(_) => None,
    }
}

fn entry_warnings(scene: &Scene, entry: &Entry) -> Vec<String> {
    let spacing = scene.resolution.spacing;
    let mut warnings = Vec::new();
    let draught = entry.final_draught;
    if draught < STARTING_DRAUGHT * spacing {
        warnings.push(format!(
            "the draught at the end is {} spacings: the force is good to 1 % from {STARTING_DRAUGHT} on",
            significant(draught / spacing)
        ));
    }

    let across = entry.peak_length() / spacing;
    if across < PEAK_SPACINGS {
        warnings.push(format!(
            "peak pressure unreliable: {} spacings across the face near the peak (5 give it to 25 %, {PEAK_SPACINGS} to 2-4 %); \
             {} m would do for resolution.spacing",
            significant(across),
            significant(entry.peak_length() / PEAK_SPACINGS)
        ));
    }

    let root = entry.bottom.wetted_half_width(entry.attached_draught());
    if scene.resolution.growth > 1.0 && scene.resolution.fine_zone[0] < root {
        warnings.push(format!(
            "the spray root goes out to {} m and leaves the fine zone, {} m wide on each side: the peak may be off by a quarter",
            significant(root),
            significant(scene.resolution.fine_zone[0])
        ));
    }

    if draught >= scene.tank.depth {
        warnings.push(format!(
            "the body may reach the floor: draught {} m at the end, depth {} m",
            significant(draught),
            significant(scene.tank.depth)
        ));
    }

    warnings.extend(past_the_chine(scene, entry));
    warnings
}

fn echo(scene: &Scene) -> Option<String> {
    let beside = 0.5 * scene.tank.width - scene.fine_zone_center().abs();
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
