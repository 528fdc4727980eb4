//! Settings of the weakly compressible scheme.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::auto::Auto;
use crate::domain::Domain;
use crate::interactions::dissipation::Dissipation;
use crate::wcsph::eos::{Tait, WATER_EXPONENT};

/// Courant number by default (WC12) [-].
const CFL: f64 = 0.6;
/// The same with `wall_stretch`: two thirds of it keep forces steady (WA4).
const CFL_WITH_WALL_STRETCH: f64 = 0.4;
/// Speed of sound over the largest known speed of the flow, where the speed of sound is `"auto"` [-].
const SOUND_RATIO: f64 = 10.0;

/// Settings of the weakly compressible scheme: the keys of a scene's table `[fluid]` that belong to
/// `solver = "weakly_compressible"`.
///
/// ```
/// use sph_core::wcsph::Settings;
/// let settings = Settings { sound_speed: 40.0.into(), ..Settings::default() };
/// assert_eq!(settings.courant_number(), 0.6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Speed of sound c0 (INDAT coef, which makes B = density sound_speed^2/eos_exponent) [m/s]. auto: compressibility costs an
    /// impact fluid.compressibility_error of its force, and it is at least 10 times the largest known speed of the flow. Under a flat
    /// bottom slower than 8.5 m/s water is as soft as the trapped air (THEORY WC27).
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub sound_speed: Auto<f64>,
    /// Exponent of Tait's equation of state (INDAT gamma), 1 to 10; 1 is linear [-].
    #[schemars(range(min = 1.0, max = 10.0), extend("x-ignored-elsewhere" = true))]
    pub eos_exponent: f64,
    /// What smooths pressures and velocities between particles of water.
    pub dissipation: Dissipation,
    /// Coefficient alpha of artificial viscosity (INDAT i_viscos 1: viscos_val); 0 is none [-]. Absent or 0 with
    /// dissipation = riemann.
    #[schemars(range(min = 0.0), extend("x-neutral" = 0, "x-default" = "0.02; 0.005 with a rigid body that starts under water"))]
    pub artificial_viscosity: f64,
    /// Coefficient delta of density diffusion; 0 is none [-]. Absent or 0 with dissipation = riemann.
    #[schemars(range(min = 0.0), extend("x-neutral" = 0))]
    pub density_diffusion: f64,
    /// Particle shifting.
    #[schemars(extend("x-ignored-elsewhere" = true))]
    pub shifting: bool,
    /// Particles that see the surface are shifted too, which evens out the water around a body and in a splash, and lifts gently
    /// moving water: its energy grows (THEORY WC10). Without effect where fluid.shifting is false.
    #[schemars(extend("x-ignored-elsewhere" = true, "x-default" = "true; false in a tank of water without a body"))]
    pub shifting_at_surface: bool,
    /// Share of h^2 grad C by which particles are shifted in each step before t = 0, and later those that were just split, whatever
    /// their speed, away from the surface (THEORY WC10), 0 to 0.3 [-]. Without effect where fluid.shifting is false.
    #[schemars(range(min = 0.0, max = 0.3), extend("x-ignored-elsewhere" = true))]
    pub settling: f64,
    /// Behind walls the water is stretched along them like that in front (THEORY WA4). Sound along walls is nearer its speed and
    /// particles keep their volume better; noisier at coarse spacing.
    #[schemars(extend("x-ignored-elsewhere" = true, "x-default" = "false; true with a rigid body that starts under water"))]
    pub wall_stretch: bool,
    /// Pairs act by the pressure less that of still water below the lowest surface, which acts exactly on water and closed bodies (THEORY
    /// WC29). Else water under pressure resists bodies that move in it, however deep. Not with fluid.acoustic_steps above 1.
    #[schemars(extend("x-ignored-elsewhere" = true, "x-default" = "false; true with a rigid body that starts under water"))]
    pub still_pressure: bool,
    /// Water within the kernel of both a wall and the air holds no tension (THEORY WC2), so that air comes in between and flow
    /// leaves a round bottom. It cuts noise to one side, which costs accuracy at coarse spacing. false: flow is sucked along.
    #[schemars(extend("x-ignored-elsewhere" = true))]
    pub ventilation: bool,
    /// Cavitation: water is not thinner than at this pressure, relative to the atmosphere; -99000 is the vapour pressure of water at
    /// 20 C [Pa]. Absent: the water holds any tension. Beside a rigid body with a keel whose chines get wet, at a given speed or with 0.4
    /// of its added mass there, and under a round bottom that goes deeper than 0.15 radii or wets its chines, it is 0. Beside another free body with a keel
    /// that enters from the air it is the dynamic pressure of its speed V and the hydrostatic one of its breadth or height L, so that jets
    /// and cavities leave it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 0.0), extend("x-default" = "0 for a rigid wedge whose chines get wet, not lighter than 0.4 of its added mass, and for a round bottom deeper than 0.15 radii or with wet chines; -density (V^2/2 + g L) for another free wedge from the air; else absent"))]
    pub cavitation_pressure: Option<f64>,
    /// Acoustic steps for which the geometry of pairs may be held (THEORY WC22), 1 to 64 [-]. Fewer are taken where neighbours part
    /// fast or the water is under pressure; 1 finds the geometry in each step. auto: 12 where a rigid body with a keel or a round bottom enters the water, with
    /// kernel wendland_c2 or wendland_c4, unless resolution.follow = false, coupling.scheme = "iqn_ils" or an option of 2010 is given; else 1. Other
    /// kernels are noisier above 1; incompressible solvers do not use it.
    #[schemars(extend("minimum" = 1, "maximum" = 64, "x-ignored-elsewhere" = true))]
    pub acoustic_steps: Auto<u32>,
    /// Factor of the limits of an advective step (THEORY WC25), above 0 to 16 [-]. Beyond 1 forces are noisier and water under pressure
    /// loses its order; to find out where. Without effect where fluid.acoustic_steps is 1.
    #[schemars(range(max = 16.0), extend("exclusiveMinimum" = 0, "x-ignored-elsewhere" = true))]
    pub advective_limit: f64,
    /// Courant number of the step limit dt <= cfl h/(c0 + |v|) (INDAT CFL_number) [-]. auto: 0.6, with wall_stretch 0.4.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cfl: Auto<f64>,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            sound_speed: Auto::Auto,
            eos_exponent: WATER_EXPONENT,
            dissipation: Dissipation::Diffusion,
            artificial_viscosity: 0.02,
            density_diffusion: 0.3,
            shifting: true,
            shifting_at_surface: true,
            settling: 0.1,
            wall_stretch: false,
            still_pressure: false,
            ventilation: false,
            cavitation_pressure: None,
            acoustic_steps: Auto::Auto,
            advective_limit: 1.0,
            cfl: Auto::Auto,
        }
    }
}

impl Settings {
    /// Courant number [-].
    pub fn courant_number(&self) -> f64 {
        self.cfl.or(if self.wall_stretch { CFL_WITH_WALL_STRETCH } else { CFL })
    }

    /// Acoustic steps for which the geometry of pairs may be held, 1 where a scene does not say [-].
    pub fn acoustic_steps(&self) -> u32 {
        self.acoustic_steps.or(1)
    }

    /// Speed of sound [m/s] where the largest known speed of the flow is `fastest` [m/s].
    pub fn speed_of_sound(&self, fastest: f64) -> f64 {
        self.sound_speed.or(SOUND_RATIO * fastest)
    }

    /// Tait's law with these settings.
    pub(crate) fn equation_of_state(&self, domain: &Domain) -> Tait {
        let (rho0, c0) = (domain.fluid.density, self.speed_of_sound(domain.fastest_speed));
        Tait { rho0, c0, gamma: self.eos_exponent }
    }
}
