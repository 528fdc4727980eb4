//! What the schemes and options of 2010 ask of a scene.

use settings::{Problem, require, significant};
use sph_core::legacy::pilorget2010::Thesis;
use sph_core::legacy::{EquationOfState, Settings};
use sph_core::{
    DensityEvolution, Dissipation, Fluid, FluidSettings, IdealGas, SchemeSettings, Turbulence, WallModel, wcsph,
};

pub use sph_core::legacy::Options;
pub use sph_core::legacy::pilorget2010::settings::FlowSettings as ThesisFlow;
pub use sph_core::{Integrator, ThesisSettings};

use super::draft::Draft;

/// Growth of the difference of Verlet's time levels from one Euler step to the next: 2.6 ran, 98 blew up.
const LARGEST_VERLET_GROWTH: f64 = 10.0;
/// δ that damps a single particle's density as the Riemann form does [-], with Wendland C2 (WC8).
const RIEMANN_DELTA: f64 = 1.0 / 3.0;
/// h/Δx of the thesis, and up to which the free surface of its projection holds (LE1) [-].
const SMOOTHING_RATIO_OF_THESIS: f64 = 1.0;
const LARGEST_RATIO_OF_THESIS: f64 = 1.25;
/// Ratio of specific heats of air [-].
const AIR_EXPONENT: f64 = 1.4;

/// Courant number C = Δt (c₀ + |v|)/h (THEORY WC12) at which a dam break and a wedge at constant speed break down or
/// gain energy, with the default kernel and diffusion (THEORY WC16; `tests/stability/courant.rs`) [-]. Other kernels and
/// less diffusion may allow a little more; nothing is gained by it.
pub(super) fn breakdown_cfl(options: &Options) -> (f64, &'static str) {
    let largest = match options.integrator {
        Integrator::Symplectic | Integrator::PredictorCorrector => 1.2,
        Integrator::Beeman => 1.4,
        // with an Euler step every other step; with fewer it breaks down sooner (LE3), of which `check` warns
        Integrator::Verlet => 0.7,
    };
    (largest, options.integrator.name())
}

/// The scheme with its options; `depth` is that of the water [m].
pub(crate) fn scheme(scheme: wcsph::Settings, options: &Options, depth: f64) -> Box<dyn SchemeSettings> {
    Box::new(Settings { scheme, options: Options { water_depth: depth, ..*options } })
}

/// True where the geometry of pairs may be held for several acoustic steps (THEORY WC22).
pub(super) fn holds_geometry(options: &Options) -> bool {
    options.is_neutral()
}

/// Fills in what the options imply, and refuses those that exclude each other; `sound` is the given speed of sound.
pub(super) fn complete(
    draft: &mut Draft,
    water: &FluidSettings,
    scheme: wcsph::Settings,
    options: Options,
    sound: Option<f64>,
) -> Result<(), Problem> {
    draft.fill("fluid.cfl", Settings { scheme, options }.courant_number());
    let viscous = options.turbulence != Turbulence::Sps || water.kinematic_viscosity != 0.0;
    require(viscous, "fluid.turbulence", "\"sps\"", "none, or a fluid.kinematic_viscosity above 0")?;
    let acoustic_steps = draft.fill("fluid.acoustic_steps", 1_u32);
    require(
        acoustic_steps == 1 || options.is_neutral(),
        "fluid.acoustic_steps",
        acoustic_steps,
        "1 with options of 2010: with others geometry is found in each step",
    )?;
    let steps_density_itself = matches!(options.integrator, Integrator::Verlet | Integrator::Beeman);
    require(
        options.walls != WallModel::Dynamic || !steps_density_itself,
        "fluid.integrator",
        "\"verlet\" or \"beeman\" with fluid.walls = \"dynamic\"",
        "symplectic or predictor_corrector, which advance the density of dynamic walls too",
    )?;
    if options.equation_of_state == EquationOfState::IdealGas {
        let Options { temperature, molar_mass, .. } = options;
        let gas = IdealGas { rho0: water.density, gamma: scheme.eos_exponent, temperature, molar_mass };
        require(gas.gamma > 1.0, "fluid.eos_exponent", gas.gamma, "a ratio of specific heats above 1")?;
        let cavitates = scheme.cavitation_pressure.is_some();
        require(!cavitates, "fluid.cavitation_pressure", "a pressure", "none: an ideal gas does not cavitate")?;
        let own = gas.sound_speed_at_rest();
        let other = sound.filter(|speed| (speed / own - 1.0).abs() > 1e-9);
        let expected = format_args!("{} m/s, that of fluid.temperature in an ideal gas, or none", significant(own));
        require(other.is_none(), "fluid.sound_speed", other.unwrap_or_default(), expected)?;
        draft.set("fluid.sound_speed", own);
    }
    Ok(())
}

/// Defaults of `[fluid]` that the thesis's projection and a gas have; true for a gas, whose speed of sound is its own.
pub(super) fn fill(draft: &mut Draft, thesis: bool) -> bool {
    if thesis {
        draft.fill("fluid.smoothing_ratio", SMOOTHING_RATIO_OF_THESIS);
    }
    let gaseous = draft.get("fluid.equation_of_state") == Some(EquationOfState::IdealGas);
    if gaseous {
        draft.fill("fluid.eos_exponent", AIR_EXPONENT);
    }
    gaseous
}

/// Rows of wall particles beside water of a smoothing ratio h/Δx [-].
pub(super) fn wall_rows(options: &Options, ratio: f64) -> f64 {
    match options.walls {
        WallModel::Extrapolated | WallModel::MirrorPoint => (2.0 * ratio).ceil(),
        WallModel::Dynamic => 2.0,
        WallModel::Repulsive => 1.0,
    }
}

/// True where walls take the acceleration of their body.
pub(super) fn extrapolates(options: &Options) -> bool {
    options.walls == WallModel::Extrapolated
}

/// True for walls of points that push (THEORY LE15).
pub(super) fn repulsive_walls(options: &Options) -> bool {
    options.walls == WallModel::Repulsive
}

/// The name of walls that do not fill a plate (THEORY WA9).
pub(super) fn hollow_walls(options: &Options) -> Option<String> {
    let fills = matches!(options.walls, WallModel::Extrapolated | WallModel::MirrorPoint);
    (!fills).then(|| format!("{:?}", options.walls).to_lowercase())
}

/// Refuses an iterated coupling beside a half step: it moves the body by the half step's force, whose acceleration is not the one
/// iterated for (THEORY CO8).
pub(super) fn check_coupling(options: &Options, iterated: bool) -> Result<(), Problem> {
    let half_step = options.integrator == Integrator::PredictorCorrector;
    require(
        !(iterated && half_step),
        "coupling.scheme",
        "\"iqn_ils\"",
        "\"added_mass\" with fluid.integrator = \"predictor_corrector\", or another integrator",
    )
}

/// True for Verlet's leapfrog, whose mean force of a step alternates about that at its end (THEORY LE3): a panel that sees both by an
/// implicit exchange breaks within milliseconds.
pub(super) fn leaps(options: &Options) -> bool {
    options.integrator == Integrator::Verlet
}

/// Options beside which the fine zone cannot grow (THEORY WC21): what is expected instead of `true`.
pub(super) fn obstacle_to_tracking(options: &Options) -> Option<&'static str> {
    if options.equation_of_state == EquationOfState::IdealGas {
        return Some("false with an ideal gas: split particles get their pressures from Tait's equation");
    }
    if options.integrator != Integrator::Symplectic {
        return Some("false with this fluid.integrator: only \"symplectic\" keeps nothing of a particle between steps");
    }
    (!extrapolates(options)).then_some(
        "false with these fluid.walls: only \"extrapolated\" ones are checked before a particle is split into them",
    )
}

/// Warnings about options.
pub(super) fn warnings(scheme: &wcsph::Settings, options: &Options, cfl: f64) -> Vec<String> {
    let summation = (options.density_evolution == DensityEvolution::Summation)
        .then(|| "fluid.density_evolution = \"summation\" fails at a free surface: for comparison only".to_string());
    loose_verlet(scheme, options, cfl).into_iter().chain(summation).collect()
}

/// Between two Euler steps, dissipation damps the flow by about e^(−d) a step, d = 7 δ C, and grows the difference of
/// Verlet's two time levels by as much (LE3); an Euler step leaves about ½d² of it.
fn loose_verlet(scheme: &wcsph::Settings, options: &Options, cfl: f64) -> Option<String> {
    let every = f64::from(options.verlet_correction_every);
    let (delta, diffusion) = match scheme.dissipation {
        Dissipation::Diffusion => {
            (scheme.density_diffusion, format!("fluid.density_diffusion = {}", scheme.density_diffusion))
        }
        Dissipation::Riemann => (RIEMANN_DELTA, "fluid.dissipation = \"riemann\"".to_string()),
    };
    let damping = 7.0 * delta * cfl;
    let growth = 0.5 * damping * damping * (damping * every).exp();
    let loose = every == 0.0 || growth > LARGEST_VERLET_GROWTH;
    (options.integrator == Integrator::Verlet && loose).then(|| {
        format!(
            "fluid.verlet_correction_every = {every}: with fluid.cfl = {cfl} and {diffusion} the two time \
             levels of verlet drift apart; correct more often, or lower either"
        )
    })
}

/// What the thesis's projection is not to be relied on for, at a smoothing ratio h/Δx and with a body or not.
pub(super) fn thesis_warnings(ratio: f64, body: bool) -> Vec<String> {
    let wide = (ratio > LARGEST_RATIO_OF_THESIS).then(|| {
        format!(
            "fluid.smoothing_ratio = {ratio}: with solver = \"incompressible_thesis\" the free surface holds up to \
             {LARGEST_RATIO_OF_THESIS}"
        )
    });
    let entering = body.then(|| {
        "solver = \"incompressible_thesis\" breaks down where a body enters the surface (THEORY LE1): take \"incompressible\""
            .to_string()
    });
    wide.into_iter().chain(entering).collect()
}

/// Iterations and solutions of the thesis's pressure equations.
pub fn thesis_work(fluid: &Fluid) -> Option<(u64, u64)> {
    fluid.scheme::<Thesis>().map(|thesis| (thesis.iterations, thesis.solutions))
}
