//! `[fluid]`: defaults that depend on the solver and on the flow, and keys that exclude each other.

use fsi_coupling::settings::{Problem, significant};
use sph_core::legacy::{EquationOfState, Settings};
use sph_core::{Dissipation, IdealGas, Integrator, Turbulence, WallModel};

use super::auto::auto_sound_speed;
use super::draft::Draft;
use super::impact::Entry;
use super::settings::{SolverSettings, Water, WeaklyCompressibleFluid};

/// Smoothing length over spacing of the thesis, h/Δx [-], up to 1.25 of which its surface holds (THEORY LE1).
const SMOOTHING_RATIO_OF_THESIS: f64 = 1.0;

/// Ratio of specific heats of air [-].
const AIR_EXPONENT: f64 = 1.4;

/// The solver's settings, complete. `fastest` is the largest known speed of the flow [m/s].
pub(super) fn resolve_fluid(draft: &mut Draft, entry: Option<&Entry>, fastest: f64) -> Result<SolverSettings, Problem> {
    let solver: String = draft.get("solver").unwrap_or_default();
    let thesis = solver == "incompressible_thesis";
    if thesis {
        draft.fill("fluid.smoothing_ratio", SMOOTHING_RATIO_OF_THESIS);
    }
    if draft.get("fluid.dissipation") == Some(Dissipation::Riemann) {
        no_coefficient(draft, "fluid.artificial_viscosity")?;
        if !thesis {
            no_coefficient(draft, "fluid.density_diffusion")?;
        }
    }
    let given: Option<f64> = draft.get("fluid.sound_speed");
    let gaseous = draft.get("fluid.equation_of_state") == Some(EquationOfState::IdealGas);
    if gaseous {
        draft.fill("fluid.eos_exponent", AIR_EXPONENT);
    }
    let water: Water = draft.read("fluid")?;
    let sound = draft.fill("fluid.sound_speed", auto_sound_speed(water.compressibility_error, entry, fastest));
    if sound == 0.0 && !gaseous {
        let expected = "a speed [m/s]: \"auto\" needs gravity or a moving body";
        return Err(Problem::missing("fluid.sound_speed", expected));
    }
    if solver == "weakly_compressible" {
        resolve_weakly_compressible(draft, &water, given)?;
    }
    draft.read("")
}

/// The Riemann form has no coefficients: nothing else than 0 may be given.
fn no_coefficient(draft: &mut Draft, key: &str) -> Result<(), Problem> {
    match draft.fill(key, 0.0) {
        0.0 => Ok(()),
        value => {
            let expected = "none, or 0, with fluid.dissipation = \"riemann\", which has no coefficients";
            Err(Problem::new(key, value, expected))
        }
    }
}

fn resolve_weakly_compressible(draft: &mut Draft, water: &Water, sound: Option<f64>) -> Result<(), Problem> {
    let WeaklyCompressibleFluid { scheme, options, .. } = draft.read("fluid")?;
    draft.fill("fluid.cfl", Settings { scheme, options }.courant_number());
    if options.turbulence == Turbulence::Sps && water.fluid.kinematic_viscosity == 0.0 {
        return Err(Problem::new("fluid.turbulence", "\"sps\"", "none, or a fluid.kinematic_viscosity above 0"));
    }
    let steps_density_itself = matches!(options.integrator, Integrator::Verlet | Integrator::Beeman);
    if options.walls == WallModel::Dynamic && steps_density_itself {
        let given = "\"verlet\" or \"beeman\" with fluid.walls = \"dynamic\"";
        let expected = "symplectic or predictor_corrector, which advance the density of dynamic walls too";
        return Err(Problem::new("fluid.integrator", given, expected));
    }
    if options.equation_of_state == EquationOfState::IdealGas {
        let gas = IdealGas {
            rho0: water.fluid.density,
            gamma: scheme.eos_exponent,
            temperature: options.temperature,
            molar_mass: options.molar_mass,
        };
        draft.set("fluid.sound_speed", gas_sound_speed(&gas, sound)?);
    }
    Ok(())
}

/// Speed of sound of a gas at rest [m/s], which follows from its temperature; another one that is given is refused.
fn gas_sound_speed(gas: &IdealGas, given: Option<f64>) -> Result<f64, Problem> {
    if gas.gamma <= 1.0 {
        return Err(Problem::new("fluid.eos_exponent", gas.gamma, "a ratio of specific heats above 1"));
    }
    let sound = gas.sound_speed_at_rest();
    match given {
        Some(speed) if (speed / sound - 1.0).abs() > 1e-9 => {
            let expected = format!("{} m/s, that of fluid.temperature in an ideal gas, or none", significant(sound));
            Err(Problem::new("fluid.sound_speed", speed, expected))
        }
        _ => Ok(sound),
    }
}
