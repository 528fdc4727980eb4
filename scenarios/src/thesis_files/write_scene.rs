//! From a scene to INDAT and IPART.

use fsi_coupling::CouplingError;
use run::build::build;
use scene::Scene;
use scene::keys::{Lattice, Symmetry, WeaklyCompressibleFluid};
use sph_core::legacy::EquationOfState;
use sph_core::{DensityFilter, Integrator, Kernel, Turbulence, WallModel};

use super::{Indat, Ipart, Particle};

/// Both files of a scene at its start, and what of the scene they cannot say.
///
/// # Errors
/// The scene cannot be built.
pub fn files_of(scene: &Scene) -> Result<(Indat, Ipart, Vec<String>), CouplingError> {
    let system = build(scene)?;
    let (fluid, walls) = (system.fluid.particles(), &system.walls);
    let fixed: usize = match &scene.body {
        Some(_) => walls.x.len() - system.range(0).len(),
        None => walls.x.len(),
    };
    let mut notes = Vec::new();
    let mut indat = Indat::default();
    let sound = scene.sound_speed();
    let [density, depth] = [scene.water().density, scene.tank.depth];
    // as the thesis starts: hydrostatic pressure; y from the floor
    let hydrostatic = |y: f64| (density * scene.gravity[1].abs() * -y).max(0.0);
    let particle = |at: [f64; 2], velocity: [f64; 2], density: f64| Particle {
        position: [at[0], at[1] + depth, 0.0],
        velocity: [velocity[0], velocity[1], 0.0],
        state: [hydrostatic(at[1]), density, 0.0, sound],
    };
    // the body's rows stand first in the system, and behind the fixed ones in the file
    let mobile = walls.x.len() - fixed;
    let order = (mobile..walls.x.len()).chain(0..mobile);
    let limit: Vec<Particle> =
        order.map(|k| particle([walls.x[k], walls.y[k]], [walls.u[k], walls.v[k]], density)).collect();
    let water = (0..fluid.len()).map(|k| particle([fluid.x[k], fluid.y[k]], [fluid.u[k], fluid.v[k]], fluid.rho[k]));
    let half = scene.symmetry == Symmetry::X;
    let both_sides = |particles: Vec<Particle>| {
        let images: Vec<Particle> = particles.iter().filter(|own| half && own.position[0] > 0.0).map(image).collect();
        [particles, images].concat()
    };
    let (mobile_rows, fixed_rows) = (limit[fixed..].to_vec(), limit[..fixed].to_vec());
    let [fixed_rows, mobile_rows, water] = [fixed_rows, mobile_rows, water.collect()].map(both_sides);
    let [fixed, limit] = [fixed_rows.len(), fixed_rows.len() + mobile_rows.len()];
    let ipart = Ipart { particles: [fixed_rows, mobile_rows, water].concat() };
    let kernel = match scene.water().kernel {
        Kernel::Gaussian => 1.0,
        Kernel::Quadratic => 2.0,
        Kernel::CubicSpline => 3.0,
        Kernel::WendlandC2 => 5.0,
        other => {
            notes.push(format!("fluid.kernel = {other:?}: i_kernel has no number for it, 5 is written"));
            5.0
        }
    };
    let spacing = scene.resolution.spacing;
    let [half, top] = [0.5 * scene.tank.width, scene.tank.height];
    for (name, value) in [
        ("i_kernel", kernel),
        ("i_algorithm", 1.0),
        ("i_viscos", 1.0),
        ("iBC", 2.0),
        ("lattice", if scene.resolution.lattice == Lattice::Square { 1.0 } else { 2.0 }),
        ("i_EoS", 1.0),
        ("h_SWL", depth),
        ("ZZMAX", depth),
        ("rho0", density),
        ("vlx", scene.tank.width),
        ("vly", top),
        ("dx", spacing),
        ("dy", spacing),
        ("dz", spacing),
        ("h", scene.water().smoothing_ratio * spacing),
        ("NP", ipart.particles.len() as f64),
        ("NB", limit as f64),
        ("NBF", fixed as f64),
        ("ivar_dt", if scene.time.step.is_some() { 0.0 } else { 1.0 }),
        ("dt", scene.time.step.unwrap_or_default()),
        ("i_correct_pb", 1.0),
        ("XMIN", -half),
        ("XMAX", half),
        ("YMAX", top),
        ("CFL_number", scene.courant_number()),
        ("fex", 1.0),
    ] {
        indat.set(name, value);
    }
    numerics(scene, sound, &mut indat, &mut notes);
    if scene.body.is_some() {
        notes.push("[body]: its surface is mobile limit particles; mass, shape and motion have no parameter".into());
    }
    if scene.resolution.growth != 1.0 {
        notes.push("resolution.growth: particles of several sizes; IPART has no mass".into());
    }
    notes.push("time.end, gauges, references: no parameter".into());
    Ok((indat, ipart, notes))
}

/// The image of a particle of a half model at x = 0.
fn image(particle: &Particle) -> Particle {
    let Particle { position: [x, y, z], velocity: [u, v, w], state } = *particle;
    Particle { position: [-x, y, z], velocity: [-u, v, w], state }
}

/// The numbers of the scheme.
fn numerics(scene: &Scene, sound: f64, indat: &mut Indat, notes: &mut Vec<String>) {
    let viscosity = scene.water().kinematic_viscosity;
    let Some(fluid) = scene.solver.weakly_compressible() else {
        indat.set("i_algorithm", 4.0);
        indat.set("i_viscos", if viscosity > 0.0 { 2.0 } else { 1.0 });
        indat.set("viscos_val", viscosity);
        return;
    };
    let exponent = fluid.scheme.eos_exponent;
    let density = scene.water().density;
    indat.set("gamma", exponent);
    indat.set("B", density * sound * sound / exponent);
    indat.set("coef", sound / (9.81 * scene.tank.depth).sqrt());
    indat.set("viscos_val", if viscosity > 0.0 { viscosity } else { fluid.scheme.artificial_viscosity });
    indat.set("i_viscos", if viscosity > 0.0 { 2.0 } else { 1.0 });
    write_options(fluid, indat, notes);
}

/// The options of 2010.
fn write_options(fluid: &WeaklyCompressibleFluid, indat: &mut Indat, notes: &mut Vec<String>) {
    let options = &fluid.options;
    indat.set("eps", options.xsph);
    indat.set(
        "i_algorithm",
        match options.integrator {
            Integrator::PredictorCorrector => 1.0,
            Integrator::Verlet => 2.0,
            Integrator::Beeman => 3.0,
            Integrator::Symplectic => {
                notes.push("fluid.integrator = symplectic: i_algorithm has no number for it, 1 is written".into());
                1.0
            }
        },
    );
    indat.set(
        "i_densityFilter",
        match options.density_filter {
            DensityFilter::None => 0.0,
            DensityFilter::Shepard => 1.0,
            DensityFilter::Mls => 2.0,
        },
    );
    indat.set("i_EoS", if options.equation_of_state == EquationOfState::IdealGas { 2.0 } else { 1.0 });
    indat.set("iBC", if options.walls == WallModel::Repulsive { 1.0 } else { 2.0 });
    if matches!(options.walls, WallModel::Extrapolated | WallModel::MirrorPoint) {
        notes.push(format!("fluid.walls = {:?}: iBC has no number for it, 2 is written", options.walls));
    }
    if options.turbulence == Turbulence::Sps {
        indat.set("i_viscos", 3.0);
    }
}
