//! How large an element would be, before anything is allocated; and the step from there to the element.

use sph_core::{Fluid, Seed};

use super::added_mass::AddedMass;
use super::element::{ElementLimits, FluidElement, shortest_step};
use super::error::HostError;
use super::frame::HostFrame;
use super::nodes::HostNodes;
use super::spec::{ElementScheme, FluidElementSpec};
use super::surface::{HostSurface, HostSurfaceSpec};
use super::topology::{Anchor, Topology, WetSurface};
use crate::bodies::body::{Body, WettedBody};
use crate::bodies::tank::Tank;
use crate::coupling::coupled::Coupled;
use crate::coupling::scheme::Scheme;
use crate::geometry::layout::{Basin, Cell, Layout};
use crate::geometry::outline::Outline;
use crate::geometry::plate_sampling::boundary_particles;
use crate::geometry::polygon::{bounding_box, minimum_width, thinnest_web};
use crate::geometry::rows::WallRows;

/// Memory of an element that has taken its first step and saved: bytes for each particle of water, for each of the walls
/// (measured by `tests/host_size.rs`).
const BYTES: [u64; 2] = [520, 600];
/// More particles than this are refused.
const MOST_PARTICLES: f64 = 1e9;
/// Fine zone, where the specification leaves it open: its half width over half the wet surface's breadth, its depth over
/// the breadth [-]; and their least [spacings].
const FINE: [f64; 2] = [1.6, 0.5];
const LEAST_FINE: [f64; 2] = [10.0, 4.0];

/// An element that has been sized, and can be built.
#[derive(Clone)]
pub struct SizedElement {
    spec: FluidElementSpec,
    topology: Topology,
    outline: Outline,
    layout: Layout,
    x: [f64; 2],
    particles: [usize; 2],
    added_mass: Option<AddedMass>,
    warnings: Vec<String>,
}

impl FluidElementSpec {
    /// Numbers of particles and bytes, the stable step, and warnings: pure, and allocates nothing that grows with the water.
    pub fn size(self, topology: &Topology) -> Result<SizedElement, HostError> {
        self.check()?;
        let rows = self.rows();
        topology.check(rows.reach())?;
        let outline = topology.outline()?;
        refuse_thin(topology, &outline, rows.reach())?;
        let layout = self.layout(&outline)?;
        let x = self.walls(&outline);
        self.refuse_outside(topology, x)?;
        let mut sized = SizedElement {
            added_mass: AddedMass::of(&self, topology),
            spec: self,
            topology: topology.clone(),
            outline,
            layout,
            x,
            particles: [0; 2],
            warnings: Vec::new(),
        };
        let mut fluid = 0;
        sized.for_each_seed(|_| fluid += 1);
        let body = boundary_particles(&sized.outline, &rows, false).0.len();
        let tank = sized.tank().sample(&rows).map_err(HostError::Shape)?.len();
        sized.particles = [fluid, body + tank];
        sized.warnings = sized.find_warnings();
        Ok(sized)
    }

    fn rows(&self) -> WallRows {
        WallRows::of(self.settings().wall_layout(&self.domain()), self.spacing)
    }

    fn walls(&self, outline: &Outline) -> [f64; 2] {
        let [low, high] = extent(outline);
        let middle = self.middle.unwrap_or(0.5 * (low[0] + high[0]));
        [middle - self.reach, middle + self.reach]
    }

    fn layout(&self, outline: &Outline) -> Result<Layout, HostError> {
        let [low, high] = extent(outline);
        let (breadth, middle, x) = (high[0] - low[0], 0.5 * (low[0] + high[0]), self.walls(outline));
        let [wide, deep] = [FINE[0] * 0.5 * breadth, FINE[1] * breadth];
        let half = self.fine_half_width.unwrap_or(wide.max(LEAST_FINE[0] * self.spacing));
        let fine_depth = self.fine_depth.unwrap_or(deep.max(LEAST_FINE[1] * self.spacing));
        let fine_x = [(middle - half).max(x[0]), (middle + half).min(x[1])];
        let fine = if self.growth > 1.0 {
            (fine_x[1] - fine_x[0]) * fine_depth.min(self.depth)
        } else {
            (x[1] - x[0]) * self.depth
        };
        if fine / (self.spacing * self.spacing) >= MOST_PARTICLES {
            let least = (fine / MOST_PARTICLES).sqrt();
            let expected =
                format!("at least {least:.2e} m: the fine zone of {fine:.3} m² would have more than 10⁹ particles");
            return Err(HostError::Value { key: "spacing", given: format!("{:?}", self.spacing), expected });
        }
        let y = [self.still_water - self.depth, self.still_water];
        Ok(Layout::new(Basin { x, y, fine_x, fine_depth, spacing: self.spacing, growth: self.growth }))
    }

    /// Wet nodes stand within the walls and above the floor.
    fn refuse_outside(&self, topology: &Topology, x: [f64; 2]) -> Result<(), HostError> {
        let floor = self.still_water - self.depth;
        let outside = |Anchor { at, .. }: &&Anchor| at[0] <= x[0] || at[0] >= x[1] || at[1] <= floor;
        let sides = topology.sides();
        match sides.as_flattened().iter().find(outside) {
            None => Ok(()),
            Some(Anchor { node, at }) => Err(HostError::Topology {
                place: format!("node {node}"),
                given: format!("{at:?} m"),
                expected: format!("x between the walls at {} and {} m, y above the floor at {floor} m", x[0], x[1]),
            }),
        }
    }
}

/// A closed surface needs room for the layers of boundary particles behind each of its faces.
fn refuse_thin(topology: &Topology, outline: &Outline, rows: f64) -> Result<(), HostError> {
    for (k, (surface, corners)) in topology.surfaces.iter().zip(outline.loops()).enumerate() {
        let thickness = minimum_width(corners).min(thinnest_web(corners));
        if matches!(surface, WetSurface::Closed(_) | WetSurface::Carried { .. })
            && thickness < 2.0 * rows * (1.0 - 1e-9)
        {
            return Err(HostError::Topology {
                place: format!("surface {k}"),
                given: format!("{thickness:.4} m thick where it is thinnest"),
                expected: format!(
                    "{:.4} m at least: twice the depth of the layers of boundary particles; or a finer spacing",
                    2.0 * rows
                ),
            });
        }
    }
    Ok(())
}

impl SizedElement {
    /// Particles of water.
    pub fn fluid_particles(&self) -> usize {
        self.particles[0]
    }

    /// Boundary particles, of the nodes' surface and of the basin.
    pub fn wall_particles(&self) -> usize {
        self.particles[1]
    }

    /// Memory that the element will hold [bytes], with one saved state.
    pub fn bytes(&self) -> u64 {
        self.particles.iter().zip(BYTES).map(|(count, bytes)| *count as u64 * bytes).sum()
    }

    /// The water's step at rest [s] (THEORY WC12, PR14).
    pub fn fluid_dt(&self) -> f64 {
        self.spec.step_at_rest()
    }

    /// The water's inertia against the host's, where the topology has masses.
    pub fn added_mass(&self) -> Option<AddedMass> {
        self.added_mass
    }

    /// Warnings about the specification.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The specification.
    pub fn spec(&self) -> &FluidElementSpec {
        &self.spec
    }

    fn find_warnings(&self) -> Vec<String> {
        let (c0, fastest) = (self.spec.speed_of_sound(), self.spec.fastest_speed.unwrap_or(0.0));
        let slow = (c0 < 10.0 * fastest).then(|| {
            format!("sound_speed = {c0}: below ten times fastest_speed = {fastest}; compressibility will cost force (THEORY WC17)")
        });
        slow.into_iter().chain(self.added_mass.and_then(|a| a.warning())).collect()
    }

    fn tank(&self) -> Tank {
        let floor = self.spec.still_water - self.spec.depth;
        let rim = self.spec.still_water + self.spec.rim.unwrap_or(0.25 * self.spec.depth);
        Tank::new(self.layout.clone(), self.x, floor, rim, false)
    }

    /// Still water at rest under its own weight, without what the surface encloses.
    fn for_each_seed(&self, mut make: impl FnMut(Seed)) {
        let [low, high] = extent(&self.outline);
        let weight = self.spec.water.density * self.spec.gravity[1];
        let thin = self.outline.plate().is_some_and(|plate| plate.is_thin(&self.spec.rows()));
        let clear = |cell: &Cell| {
            let least = cell.clearance(thin);
            let near = (0..2).all(|k| cell.at[k] > low[k] - least && cell.at[k] < high[k] + least);
            !near || self.outline.signed_distance(cell.at) >= least
        };
        self.layout.for_each(|cell| {
            if clear(&cell) {
                let pressure = weight * (cell.at[1] - self.spec.still_water);
                make(Seed { at: cell.at, velocity: [0.0; 2], area: cell.area(), pressure });
            }
        });
    }

    /// The water at t = 0, at rest; the only phase that allocates. `nodes` are where the topology said; their velocities
    /// and rotations are what they start with.
    pub fn build(self, nodes: &HostNodes) -> Result<FluidElement, HostError> {
        let mut seeds = Vec::with_capacity(self.particles[0]);
        self.for_each_seed(|seed| seeds.push(seed));
        let fluid = Fluid::new(self.spec.domain(), self.spec.settings().as_ref(), &seeds);
        drop(seeds);
        let spec = HostSurfaceSpec {
            name: "host".into(),
            frame: HostFrame::default(),
            outline: Some(self.outline.clone()),
            half: false,
        };
        let (body, link) = HostSurface::new(&self.topology, nodes, &self.spec.rows(), spec)?.into_body();
        let bodies: Vec<Box<dyn Body>> = vec![body, Box::new(self.tank())];
        let system = Coupled::new(fluid, bodies, Scheme::Weak, self.spec.spacing).map_err(HostError::Build)?;
        let limits = ElementLimits {
            sound_speed: self.spec.speed_of_sound(),
            most_substeps: self.spec.most_substeps,
            longest_fluid_step: f64::INFINITY,
            shortest_step: shortest_step(matches!(self.spec.scheme, ElementScheme::Projection(_)), self.fluid_dt()),
            added_mass: self.added_mass,
        };
        Ok(FluidElement::of(system, link, limits))
    }
}

/// The smallest upright rectangle around an outline [m].
fn extent(outline: &Outline) -> [[f64; 2]; 2] {
    let corners: Vec<[f64; 2]> = outline.loops().iter().flatten().copied().collect();
    bounding_box(&corners)
}
