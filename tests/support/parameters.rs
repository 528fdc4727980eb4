//! Every option of every scheme in one flat list, for tests that vary one at a time.

use sph_core::legacy::{self, DiffusionForm, EquationOfState, Options};
use sph_core::projection::{self, Projection};
use sph_core::wcsph::{self, Wcsph, eos::Tait};
use sph_core::{
    Dissipation, Domain, Fluid, FluidSettings, Integrator, Kernel, Mirror, Periodic, SchemeSettings, Seed, Slip,
    Solver, WallLayout, WallModel,
};

/// Domain and scheme of a fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Equation of state.
    pub eos: Tait,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over particle spacing h/Δx [-].
    pub smoothing_ratio: f64,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Artificial viscosity α [-].
    pub alpha: f64,
    /// Kinematic viscosity ν [m²/s].
    pub nu: f64,
    /// Density diffusion δ [-].
    pub delta: f64,
    /// Particle shifting.
    pub shifting: bool,
    /// What the fluid does along a wall.
    pub slip: Slip,
    /// Behind walls the water is stretched like that in front.
    pub wall_stretch: bool,
    /// Time integration.
    pub integrator: Integrator,
    /// Courant number.
    pub cfl: f64,
    /// Plane of symmetry.
    pub mirror: Option<Mirror>,
    /// Periodic plane pairs.
    pub periodic: Option<Periodic>,
    /// Steps between two Euler steps of Verlet's integrator.
    pub verlet_correction_every: u32,
    /// The fluid is an ideal gas of this temperature [K] and molar mass [kg/mol].
    pub gas: Option<[f64; 2]>,
    /// How walls keep the fluid out.
    pub walls: WallModel,
    /// What smooths pressures and velocities.
    pub dissipation: Dissipation,
    /// What gives the pressure.
    pub solver: Solver,
    /// Settings of the projection.
    pub projection: projection::Settings,
    /// Largest known speed [m/s].
    pub speed: f64,
}

impl Parameters {
    /// The schemes by default, without gravity and planes of symmetry.
    pub fn usual(eos: Tait) -> Parameters {
        let (water, scheme) = (FluidSettings::default(), wcsph::Settings::default());
        Parameters {
            eos,
            kernel: water.kernel,
            smoothing_ratio: water.smoothing_ratio,
            gravity: [0.0; 2],
            alpha: scheme.artificial_viscosity,
            nu: water.kinematic_viscosity,
            delta: scheme.density_diffusion,
            shifting: scheme.shifting,
            slip: water.wall_slip,
            wall_stretch: scheme.wall_stretch,
            integrator: Integrator::Symplectic,
            cfl: scheme.courant_number(),
            mirror: None,
            periodic: None,
            verlet_correction_every: Options::default().verlet_correction_every,
            gas: None,
            walls: WallModel::Extrapolated,
            dissipation: scheme.dissipation,
            solver: Solver::default(),
            projection: projection::Settings::default(),
            speed: 0.1 * eos.c0,
        }
    }

    /// Those of a fluid with the default scheme, or with the projection.
    pub fn of(fluid: &Fluid) -> Parameters {
        let domain = fluid.domain();
        let eos = Tait { rho0: domain.fluid.density, c0: 10.0 * domain.fastest_speed, gamma: 7.0 };
        let common = Parameters {
            kernel: domain.fluid.kernel,
            smoothing_ratio: domain.fluid.smoothing_ratio,
            gravity: domain.gravity,
            nu: domain.fluid.kinematic_viscosity,
            slip: domain.fluid.wall_slip,
            mirror: domain.mirror,
            periodic: domain.periodic,
            speed: domain.fastest_speed,
            ..Parameters::usual(eos)
        };
        if let Some(Projection { settings, .. }) = fluid.scheme() {
            let solver = match settings.method {
                projection::Method::Solve => Solver::Incompressible,
                projection::Method::OneIteration => Solver::IncompressibleExplicit,
            };
            let projection::FlowSettings { shifting, cfl, .. } = settings.flow;
            return Parameters { solver, projection: *settings, shifting, cfl, ..common };
        }
        let scheme = fluid.scheme::<Wcsph>().expect("the weakly compressible scheme").settings;
        Parameters {
            eos: Tait { c0: scheme.speed_of_sound(domain.fastest_speed), gamma: scheme.eos_exponent, ..eos },
            alpha: scheme.artificial_viscosity,
            delta: scheme.density_diffusion,
            shifting: scheme.shifting,
            wall_stretch: scheme.wall_stretch,
            cfl: scheme.courant_number(),
            dissipation: scheme.dissipation,
            ..common
        }
    }

    /// The water and the space it moves in.
    pub fn domain(&self) -> Domain {
        Domain {
            fluid: FluidSettings {
                density: self.eos.rho0,
                kernel: self.kernel,
                smoothing_ratio: self.smoothing_ratio,
                kinematic_viscosity: self.nu,
                wall_slip: self.slip,
            },
            gravity: self.gravity,
            mirror: self.mirror,
            periodic: self.periodic,
            fastest_speed: self.speed,
            ..Domain::default()
        }
    }

    /// Settings of the scheme.
    pub fn settings(&self) -> Box<dyn SchemeSettings> {
        match self.solver {
            Solver::WeaklyCompressible => Box::new(self.compressible()),
            Solver::Incompressible => Box::new(self.projection(projection::Method::Solve)),
            Solver::IncompressibleExplicit => Box::new(self.projection(projection::Method::OneIteration)),
            Solver::IncompressibleThesis => Box::new(sph_core::ThesisSettings::default()),
        }
    }

    fn compressible(&self) -> legacy::Settings {
        let usual = Options::default();
        let [temperature, molar_mass] = self.gas.unwrap_or([usual.temperature, usual.molar_mass]);
        let equation_of_state = if self.gas.is_some() { EquationOfState::IdealGas } else { EquationOfState::Tait };
        legacy::Settings {
            scheme: wcsph::Settings {
                sound_speed: self.eos.c0.into(),
                eos_exponent: self.eos.gamma,
                dissipation: self.dissipation,
                artificial_viscosity: self.alpha,
                density_diffusion: self.delta,
                shifting: self.shifting,
                wall_stretch: self.wall_stretch,
                cfl: self.cfl.into(),
                ..wcsph::Settings::default()
            },
            options: Options {
                integrator: self.integrator,
                verlet_correction_every: self.verlet_correction_every,
                density_diffusion_form: DiffusionForm::Fourtakas,
                walls: self.walls,
                equation_of_state,
                temperature,
                molar_mass,
                ..usual
            },
        }
    }

    fn projection(&self, method: projection::Method) -> projection::Settings {
        let flow = projection::FlowSettings { shifting: self.shifting, cfl: self.cfl, ..self.projection.flow };
        projection::Settings { flow, method, ..self.projection }
    }

    /// Layers of boundary particles that the walls need.
    pub fn wall_layout(&self) -> WallLayout {
        self.settings().wall_layout(&self.domain())
    }

    /// The fluid.
    pub fn fluid(&self, seeds: &[Seed]) -> Fluid {
        Fluid::new(self.domain(), self.settings().as_ref(), seeds)
    }
}

/// The settings of a fluid's projection, to be changed between steps.
pub fn projection_of(fluid: &mut Fluid) -> &mut projection::Settings {
    &mut fluid.scheme_mut::<Projection>().expect("a projection").settings
}
