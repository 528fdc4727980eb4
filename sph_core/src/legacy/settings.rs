//! Settings of the weakly compressible scheme's options of 2010.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::domain::Domain;
use crate::legacy::ideal_gas::IdealGas;
use crate::wcsph;

/// Time integration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Kick–drift–kick with the density advanced about the midpoint: second order, one sum of each kind per step (WC11).
    #[default]
    Symplectic,
    /// Monaghan's (1989) predictor–corrector: second order, two sums of each kind per step (LE2).
    PredictorCorrector,
    /// Verlet's (1967) two-step leapfrog with an Euler step now and then: one sum of each kind per step (LE3).
    Verlet,
    /// Beeman's (1976) with the corrector of Adams and Moulton: third order, two sums of each kind per step (LE4).
    Beeman,
}

impl Integrator {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::Symplectic => "symplectic",
            Integrator::PredictorCorrector => "predictor_corrector",
            Integrator::Verlet => "verlet",
            Integrator::Beeman => "beeman",
        }
    }
}

/// How densities are smoothed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityFilter {
    /// Not at all.
    #[default]
    None,
    /// LE6, zeroth order (Shepard 1968): keeps a constant.
    Shepard,
    /// LE7, first order, moving least squares (Colagrossi & Landrini 2003): keeps a linear field.
    Mls,
}

/// Where densities come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DensityEvolution {
    /// WC3: advanced with the divergence of velocity.
    #[default]
    Continuity,
    /// LE13: counted from masses in each step (M. Pilorget 2010, eq. 13). Low where neighbours are missing.
    Summation,
}

/// What stands for the eddies smaller than a particle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Turbulence {
    /// Nothing.
    #[default]
    None,
    /// LE9, Smagorinsky's model on particles (Gotoh, Shao & Memita 2004; Dalrymple & Rogers 2006).
    Sps,
}

/// How boundary particles keep the fluid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallModel {
    /// Rows of particles that fill the kernel's support; pressure extrapolated from the fluid (WA3, Adami, Hu & Adams
    /// 2012), reflected velocity in continuity (WA4).
    #[default]
    Extrapolated,
    /// One row of points half a spacing below the surface that push by a law of distance (LE15, Monaghan 1994; Monaghan & Kos 1999).
    Repulsive,
    /// Two staggered rows of fluid particles that do not move: density by continuity (LE16, Dalrymple & Knio 2001).
    Dynamic,
    /// As `Extrapolated`, but the pressure comes from the wall particle's mirror point in the fluid, by a corrected
    /// first-order interpolation (LE17, English et al. 2022).
    MirrorPoint,
}

impl WallModel {
    /// True where the fluid behind the wall moves with the reflected velocity (WA4).
    pub(crate) fn reflects(self) -> bool {
        matches!(self, WallModel::Extrapolated | WallModel::MirrorPoint)
    }

    /// True where wall particles push by their pressure (WC5) and count as neighbours (OP4, OP5, WC10).
    pub(crate) fn has_pressure(self) -> bool {
        self != WallModel::Repulsive
    }
}

/// What gives the pressure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EquationOfState {
    /// Tait's law for water: of the density alone.
    #[default]
    Tait,
    /// An ideal gas, with the energy equation (LE11, LE12); the pressure is that over the gas at rest.
    IdealGas,
}

/// What density diffusion diffuses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DiffusionForm {
    /// Pressure less its hydrostatic part (Fourtakas et al. 2019).
    #[default]
    Fourtakas,
    /// The whole pressure (LE14; Molteni & Colagrossi 2009).
    Molteni,
}

/// Options of 2010 of the weakly compressible scheme: further keys of a scene's table `[fluid]` with
/// `solver = "weakly_compressible"`. With the defaults the scheme is [`crate::wcsph`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Time integration (INDAT i_algorithm 1 | 2 | 3: predictor_corrector, verlet, beeman). The default Courant number is 0.3 for
    /// predictor_corrector and beeman, 0.05 for verlet.
    pub integrator: Integrator,
    /// verlet: steps between two Euler steps, which keep its two time levels together; 0 is never [-].
    #[schemars(extend("x-when" = ".integrator = verlet"))]
    pub verlet_correction_every: u32,
    /// How densities are smoothed now and then (INDAT i_densityFilter 0 | 1 | 2).
    pub density_filter: DensityFilter,
    /// Steps between two filterings, 1 or more [-].
    #[schemars(range(min = 1), extend("x-when" = ".density_filter = shepard | mls"))]
    pub density_filter_every: u32,
    /// Share of the neighbours' mean velocity that particles move with (INDAT eps, there 0.5), 0 to 1; 0 is none [-].
    #[schemars(range(min = 0.0, max = 1.0))]
    pub xsph: f64,
    /// Model of the eddies smaller than a particle (INDAT i_viscos 2 | 3). Needs fluid.kinematic_viscosity.
    pub turbulence: Turbulence,
    /// What gives the pressure (INDAT i_EoS 1 | 2).
    pub equation_of_state: EquationOfState,
    /// ideal_gas: temperature at rest (INDAT TE0: its thermal energy) [K].
    #[schemars(extend("exclusiveMinimum" = 0, "x-when" = ".equation_of_state = ideal_gas"))]
    pub temperature: f64,
    /// ideal_gas: molar mass; the default is that of dry air [kg/mol].
    #[schemars(extend("exclusiveMinimum" = 0, "x-when" = ".equation_of_state = ideal_gas"))]
    pub molar_mass: f64,
    /// Where densities come from.
    pub density_evolution: DensityEvolution,
    /// What density diffusion diffuses.
    pub density_diffusion_form: DiffusionForm,
    /// How walls keep the water out (INDAT iBC 1 | 2: repulsive, dynamic).
    pub walls: WallModel,
    /// Dynamic walls at the start (INDAT i_correct_pb 0 | 1): 0: density rho0, no pressure, 1: the pressure of the water beside
    /// them [-].
    #[schemars(range(max = 1), extend("x-when" = ".walls = dynamic"))]
    pub limit_pressure: u8,
    /// Repulsive walls: depth of the still water below y = 0, over which their force grows (LE15) [m].
    #[serde(skip)]
    pub water_depth: f64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            integrator: Integrator::Symplectic,
            verlet_correction_every: 40,
            density_filter: DensityFilter::None,
            density_filter_every: 20,
            xsph: 0.0,
            turbulence: Turbulence::None,
            equation_of_state: EquationOfState::Tait,
            temperature: 288.15,
            molar_mass: 0.028_964_4,
            density_evolution: DensityEvolution::Continuity,
            density_diffusion_form: DiffusionForm::Fourtakas,
            walls: WallModel::Extrapolated,
            limit_pressure: 1,
            water_depth: 1.0,
        }
    }
}

impl Options {
    /// True where no option differs from the default scheme.
    pub fn is_neutral(&self) -> bool {
        let usual = Options::default();
        let idle = Options {
            verlet_correction_every: usual.verlet_correction_every,
            density_filter_every: usual.density_filter_every,
            temperature: usual.temperature,
            molar_mass: usual.molar_mass,
            limit_pressure: usual.limit_pressure,
            water_depth: usual.water_depth,
            ..*self
        };
        idle == usual
    }
}

/// The weakly compressible scheme with the options of 2010.
///
/// ```
/// use sph_core::legacy::{Options, Settings};
/// use sph_core::Integrator;
/// let options = Options { integrator: Integrator::Verlet, ..Options::default() };
/// assert_eq!(Settings { options, ..Settings::default() }.courant_number(), 0.05);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// The scheme.
    pub scheme: wcsph::Settings,
    /// The options.
    pub options: Options,
}

impl Settings {
    /// Courant number [-]; by default each integrator's own.
    pub fn courant_number(&self) -> f64 {
        match self.options.integrator {
            Integrator::Symplectic => self.scheme.courant_number(),
            Integrator::PredictorCorrector | Integrator::Beeman => self.scheme.cfl.or(0.3),
            Integrator::Verlet => self.scheme.cfl.or(0.05),
        }
    }

    /// The gas, if the fluid is one; its ratio of specific heats is the equation of state's exponent.
    pub(crate) fn gas(&self, domain: &Domain) -> Option<IdealGas> {
        let Options { temperature, molar_mass, equation_of_state, .. } = self.options;
        let gas = IdealGas { rho0: domain.fluid.density, gamma: self.scheme.eos_exponent, temperature, molar_mass };
        (equation_of_state == EquationOfState::IdealGas).then_some(gas)
    }
}
