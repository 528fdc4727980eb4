//! What every scheme shares: the fluid's properties, the kernel, gravity, and the planes that bound the flow; the schemes' names.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::kernel::Kernel;
use crate::planes::{Mirror, Periodic};

/// What the fluid does along a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Slip {
    /// The water slides along walls: no viscous traction.
    #[default]
    Free,
    /// The water sticks to walls: they show it the velocity 2V_w − ũ (WA5, Adami et al. 2012).
    None,
}

/// Properties of the fluid and of its discretisation that every scheme reads: the keys of a scene's table `[fluid]` that
/// do not depend on the solver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FluidSettings {
    /// Density of the undisturbed water (INDAT rho0) [kg/m^3].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density: f64,
    /// Smoothing kernel (INDAT i_kernel 1 | 2 | 3 | 5: gaussian, quadratic, cubic_spline, wendland_c2).
    pub kernel: Kernel,
    /// Smoothing length over spacing h/dx (INDAT h), 1 to 3 [-]. The kernel's support is 2h. With solver =
    /// incompressible_thesis it is 1.0 by default.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub smoothing_ratio: f64,
    /// Kinematic viscosity (INDAT i_viscos 2 | 3: viscos_val; 3 with fluid.turbulence); 0 is none [m^2/s].
    #[schemars(range(min = 0.0))]
    pub kinematic_viscosity: f64,
    /// Tangential condition on walls.
    #[schemars(extend("x-when" = ".kinematic_viscosity"))]
    pub wall_slip: Slip,
}

impl Default for FluidSettings {
    fn default() -> FluidSettings {
        FluidSettings {
            density: 1000.0,
            kernel: Kernel::WendlandC2,
            smoothing_ratio: 1.5,
            kinematic_viscosity: 0.0,
            wall_slip: Slip::Free,
        }
    }
}

impl FluidSettings {
    /// ν between fluid and wall [m²/s]: 0 where walls slip.
    pub fn wall_viscosity(&self) -> f64 {
        if self.wall_slip == Slip::None { self.kinematic_viscosity } else { 0.0 }
    }
}

/// The space in which the fluid moves, and the fluid's properties.
///
/// ```
/// use sph_core::{Domain, FluidSettings};
/// let fluid = FluidSettings { density: 1025.0, ..FluidSettings::default() };
/// let sea = Domain { fluid, gravity: [0.0, -9.81], fastest_speed: 4.5, ..Domain::default() };
/// assert_eq!(sea.up(), [0.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The fluid.
    pub fluid: FluidSettings,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Plane of symmetry, if there is one.
    pub mirror: Option<Mirror>,
    /// Pairs of periodic planes, if there are any (OP9).
    pub periodic: Option<Periodic>,
    /// Largest speed of the flow that is known before the run [m/s]: of the body, of the spray root, or of falling water.
    pub fastest_speed: f64,
    /// The water starts at rest below a level surface and between walls: what accelerates its coarser particles then is an error of their
    /// grading, and is taken off (THEORY WC28; weakly compressible scheme).
    pub starts_level: bool,
    /// Sum four targets side by side where the processor can. False: one at a time, for comparison.
    pub simd: bool,
}

impl Default for Domain {
    /// Unbounded, without gravity.
    fn default() -> Domain {
        Domain {
            fluid: FluidSettings::default(),
            gravity: [0.0; 2],
            mirror: None,
            periodic: None,
            fastest_speed: 1.0,
            starts_level: false,
            simd: true,
        }
    }
}

impl Domain {
    /// Unit vector against gravity [-]; upwards where there is none.
    pub fn up(&self) -> [f64; 2] {
        let g = self.gravity;
        let size = g[0].hypot(g[1]);
        if size > 0.0 { g.map(|c| -c / size) } else { [0.0, 1.0] }
    }
}

/// Which equations give the pressure: a scene's key `solver`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// An equation of state: pressures run through the water as sound (THEORY WC2–WC12, WA3–WA5).
    #[default]
    WeaklyCompressible,
    /// A Poisson equation: pressures are those that leave the water's volume as it is (THEORY PR2–PR14).
    Incompressible,
    /// The same with the diagonal instead of the matrix: one iteration per step (THEORY PR15).
    IncompressibleExplicit,
    /// Pilorget's (2010) projection, with the choices of its thesis (THEORY LE18–LE28).
    IncompressibleThesis,
}

impl Solver {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Solver::WeaklyCompressible => "weakly_compressible",
            Solver::Incompressible => "incompressible",
            Solver::IncompressibleExplicit => "incompressible_explicit",
            Solver::IncompressibleThesis => "incompressible_thesis",
        }
    }

    /// True where densities do not determine pressures.
    pub fn is_incompressible(self) -> bool {
        self != Solver::WeaklyCompressible
    }
}
