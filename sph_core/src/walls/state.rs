//! What the fluid does at its walls: a verb for each wall model (THEORY E9, W1–W3).

use crate::domain::Slip;
use crate::fluid::Fluid;
use crate::interactions::gather::WallState;
use crate::interactions::pair::Extrapolated;
use crate::legacy::dynamic_walls::{DynamicWalls, OwnVelocityRate};
use crate::legacy::mirror_point::MirrorState;
use crate::legacy::repulsive::{push_fluid, push_walls};
use crate::legacy::wall_model::WallModel;
use crate::timers::Phase;
use crate::walls::Walls;

impl Fluid {
    /// W2: the walls' own velocities compress the fluid, and the fluid compresses the walls.
    pub(crate) fn evaluate_dynamic_walls(&mut self) {
        let (fluid, walls, search) = (&self.rows.fluid, &self.rows.walls, &self.search);
        let (kernel, rho) = (self.parameters.kernel, &self.particles.rho);
        self.scratch.resize(rho.len(), 0.0);
        let (lists, out) = (&search.walls_of_fluid, &mut self.scratch[..]);
        kernel.run(OwnVelocityRate { targets: fluid, rho, others: walls, lists, out });
        for (rate, beside_walls) in self.density_rate.iter_mut().zip(&self.scratch) {
            *rate += beside_walls;
        }
        let DynamicWalls { rho, rate, .. } = &mut self.dynamic_walls;
        let lists = &search.fluid_of_wall;
        kernel.run(OwnVelocityRate { targets: walls, rho, others: fluid, lists, out: rate });
    }

    /// W2: dynamic walls start at the pressure of the water beside them, or at none.
    pub(crate) fn start_dynamic_walls(&mut self, walls: &mut Walls) {
        if self.parameters.walls.model != WallModel::Dynamic {
            return;
        }
        if self.parameters.walls.hydrostatic_start {
            self.equation_of_state();
            self.pack(walls, 0.0);
            self.extrapolate_to_walls(walls);
        }
        self.dynamic_walls.start(&walls.pressure, self.parameters.eos);
    }

    /// E9: pressures of the walls extrapolated from the fluid.
    pub(crate) fn extrapolate_to_walls(&mut self, walls: &mut Walls) {
        self.phases.begin(Phase::Walls);
        self.extrapolated.resize(walls.len(), Extrapolated::default());
        let gather = WallState {
            fluid: &self.rows.fluid,
            walls: &self.rows.walls,
            acceleration: (&walls.ax, &walls.ay),
            search: &self.search,
            constants: self.parameters.constants(),
        };
        self.parameters.sweep_walls(&gather, &mut self.extrapolated[..]);
        self.dress_walls(walls);
    }

    /// W3: pressures of the walls from their mirror points.
    pub(crate) fn read_mirror_points(&mut self, walls: &mut Walls) {
        self.phases.begin(Phase::Walls);
        self.extrapolated.resize(walls.len(), Extrapolated::default());
        self.parameters.kernel.run(MirrorState {
            fluid: &self.rows.fluid,
            walls: &self.rows.walls,
            points: (&self.rows.mirror_points.0, &self.rows.mirror_points.1),
            search: &self.search,
            out: &mut self.extrapolated,
        });
        self.dress_walls(walls);
    }

    /// W2: pressures of the walls from their densities; they show the fluid their own velocity.
    pub(crate) fn state_of_dynamic_walls(&mut self, walls: &mut Walls) {
        self.phases.begin(Phase::Walls);
        let found = self.dynamic_walls.pressures(self.parameters.eos).enumerate();
        self.extrapolated.clear();
        self.extrapolated
            .extend(found.map(|(k, pressure)| Extrapolated { pressure, velocity: [walls.u[k], walls.v[k]] }));
        self.dress_walls(walls);
    }

    /// The walls show the fluid what they found, and their owners the pressure.
    fn dress_walls(&mut self, walls: &mut Walls) {
        let image_side = if self.parameters.periodic.is_some() { 1.0 } else { -1.0 };
        let stick = self.parameters.slip == Slip::None;
        self.rows.dress_walls(&self.extrapolated, &self.search.wall_images, image_side, stick);
        for (pressure, found) in walls.pressure.iter_mut().zip(&self.extrapolated) {
            *pressure = found.pressure;
        }
    }

    /// W1: the push of repulsive walls, and its reaction.
    pub(crate) fn repel(&mut self) {
        let (fluid, faces, search, law) =
            (&self.rows.fluid, &self.rows.faces, &self.search, self.parameters.repulsion());
        let mut pushes = vec![[0.0; 2]; self.particles.len()];
        push_fluid(fluid, faces, search, law, &mut pushes);
        push_walls(fluid, faces, search, law, &mut self.wall_force);
        self.add_forces(&pushes);
    }
}
