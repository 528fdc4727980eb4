//! How far a scene's numbers can be relied on: one file for each phenomenon, with its defaults, refusals, warnings, verdicts, bands and sources.
//! A warning says before the run what a verdict says after it; both read the same constants.
//!
//! | file | phenomenon |
//! |---|---|
//! | [`compressibility`] | what weakly compressible water takes of a force; speed of sound; echo |
//! | [`resolution`] | spacings in a draught and across a pressure peak: bands of force, impulse, pressure |
//! | [`first_contact`] | when a run starts; round bottoms; bodies that start wet |
//! | [`entry`] | what is doubtful about each body that enters |
//! | [`air`] | trapped air, vapour |
//! | [`tension`] | water that pulls |
//! | [`limits`] | forces that cannot be relied on, whatever the run gives |
//! | [`submerged`] | bodies that start under water |
//! | [`projection`] | incompressible water; near walls |
//! | [`exchange`], [`springs`], [`wet_period`] | steps of the coupling: light bodies and panels, springs, vibration with the water's sound |
//! | [`panels`], [`plates`] | results of panels; panels that are too thin, short or slow |
//! | [`gauges`], [`keel`], [`gaps`] | gauges; steep keels; narrow gaps |
//! | [`waves`] | wave makers and beaches |
//! | [`plausible`] | numbers that are hardly meant |
//! | `unusual.rs`, beside this folder | settings with which no band was measured |

pub mod air;
pub mod compressibility;
pub mod entry;
pub mod exchange;
pub mod first_contact;
pub mod gaps;
pub mod gauges;
pub mod keel;
pub mod limits;
pub mod panels;
pub mod plates;
pub mod plausible;
pub mod projection;
pub mod resolution;
pub mod springs;
pub mod submerged;
pub mod tension;
pub mod waves;
pub mod wet_period;

use settings::significant;
use sph_core::{Dissipation, Kernel, Solver};
use water_entry::EntryModel;

use self::compressibility::{WATER_SOUND, echo, lost_forces, slow_sound};
use self::entry::{entry_warnings, short_of_water_all};
use self::exchange::{light_bodies, light_panels};
use self::gauges::coarse_samples;
use self::limits::limit_of_forces;
use self::plates::doubtful_panels;
use self::projection::projection_warnings;
use self::waves::wave_warnings;
use crate::keys::{Body, Scene, WeaklyCompressibleFluid};
use crate::legacy;
use crate::resolve_links::thin_film;

const LARGEST_CFL: f64 = 0.8;

/// Densities of usual liquids [kg/m³].
const LIQUID: [f64; 2] = [500.0, 3000.0];

/// Courant number up to which the Riemann form runs (WC13): with Wendland C6, and with the wider kernels.
const RIEMANN_CFL: [f64; 2] = [0.65, 0.7];

/// Courant number at which stretched walls run without artificial viscosity.
const STRETCHED_CFL: f64 = 0.4;

const LARGEST_GROWTH: f64 = 1.2;

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

/// Acoustic steps per geometry that gain nothing, or cost accuracy.
fn held_geometry(steps: u32) -> Option<String> {
    match steps {
        2 | 3 => Some(format!(
            "fluid.acoustic_steps = {steps}: pair geometry is reused too few times to pay off; in splashes 1 was faster; 4 pays off"
        )),
        13.. => Some(format!("fluid.acoustic_steps = {steps}: no chart gives error bars above 12")),
        _ => None,
    }
}

/// Warnings about water that carries sound: how fast, in which steps, how far.
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
