//! A wetted beam structure: a surface that rides on finite elements, and loads that go back to their nodes.

use structure_fe::{Beam, Dynamics, Loads, State};

use sph_core::{WallForces, WallPoint, WallsMut};

use crate::beam_surface::{BeamSurface, Perch};
use crate::body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
use crate::outline::Outline;
use crate::rows::Arrangement;

/// What a wetted beam structure is made of.
pub struct BeamSpec {
    /// Name, as in output columns.
    pub name: String,
    /// The structure: per metre of span, so of [strips](structure_fe::Section::strip).
    pub dynamics: Dynamics,
    /// Its surface at rest [m]; the fluid is outside. Each place rides on the element nearest to it. Behind a face that is
    /// wet on one side only the outline may be as thick as the rows of boundary particles need.
    pub outline: Outline,
    /// Gravity on the structure [m/s²].
    pub gravity: [f64; 2],
}

/// See the module's text. The load of a step is the mean force of the fluid, carried to the nodes by the transpose of
/// what places the boundary particles (THEORY K1–K3).
pub struct BeamBody {
    name: String,
    dynamics: Dynamics,
    surface: BeamSurface,
    arrangement: Arrangement,
    rest: Outline,
    corners: Vec<Vec<Perch>>,
    perches: Vec<Perch>,
    weight: Vec<[f64; 3]>,
    mass: f64,
    outline: Outline,
    state: Moving,
    saved: Option<(Moving, Outline)>,
}

/// What a step changes.
#[derive(Clone)]
struct Moving {
    nodes: State,
    /// Mean load of the fluid over the step, on the nodes.
    load: Vec<[f64; 3]>,
    /// Impulses of blows that the next step takes up.
    struck: Vec<[f64; 3]>,
    /// Resultant force of the fluid now [N/m], and its moment about the origin [N].
    force: [f64; 3],
    external: [f64; 2],
    work: f64,
}

fn failed(name: &str, error: &structure_fe::Error) -> BodyError {
    BodyError::Structure { name: name.into(), reason: error.to_string() }
}

impl BeamBody {
    /// The structure at rest, undeformed, under its own weight alone.
    pub fn new(spec: BeamSpec) -> Result<BeamBody, BodyError> {
        let BeamSpec { name, mut dynamics, outline, gravity } = spec;
        let beam = dynamics.beam();
        let elements = beam.elements().iter().map(|element| element.nodes).collect();
        let surface = BeamSurface::new(beam.nodes().to_vec(), elements);
        let weight = own_weight(dynamics.beam(), gravity).map_err(|error| failed(&name, &error))?;
        let mass = dynamics.beam().mass();
        let nodes = surface.nodes();
        let lengths = (0..dynamics.beam().elements().len()).map(|element| dynamics.beam().length(element));
        let longest = lengths.fold(f64::INFINITY, f64::min);
        let perches = |part: &Vec<[f64; 2]>| divided(part, longest).map(|at| surface.perch(at, [0.0; 2])).collect();
        let corners = outline.loops().iter().map(perches).collect();
        let mut state = Moving {
            nodes: dynamics.at_rest(),
            load: vec![[0.0; 3]; nodes],
            struck: vec![[0.0; 3]; nodes],
            force: [0.0; 3],
            external: [0.0; 2],
            work: 0.0,
        };
        dynamics.equilibrate(&mut state.nodes, &weight).map_err(|error| failed(&name, &error))?;
        Ok(BeamBody {
            rest: outline.clone(),
            arrangement: Arrangement::default(),
            perches: Vec::new(),
            saved: None,
            name,
            dynamics,
            surface,
            corners,
            weight,
            mass,
            outline,
            state,
        })
    }

    /// The structure's motion: displacements, velocities and accelerations of its nodes.
    pub fn nodes(&self) -> &State {
        &self.state.nodes
    }

    /// The structure.
    pub fn dynamics(&self) -> &Dynamics {
        &self.dynamics
    }

    /// Mean load of the fluid over the last step, `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn load_of_fluid(&self) -> &[[f64; 3]] {
        &self.state.load
    }

    /// Displacements `ahead` [s] from now, at constant acceleration.
    fn ahead(&self, ahead: f64) -> Vec<[f64; 3]> {
        let State { displacement, velocity, acceleration, .. } = &self.state.nodes;
        let each = displacement.iter().zip(velocity).zip(acceleration);
        each.map(|((q, v), a)| [0, 1, 2].map(|k| q[k] + ahead * (v[k] + 0.5 * ahead * a[k]))).collect()
    }

    /// The outline where the structure is now.
    fn follow(&mut self) -> Result<(), BodyError> {
        let q = &self.state.nodes.displacement;
        let parts: Vec<Vec<[f64; 2]>> =
            self.corners.iter().map(|l| l.iter().map(|perch| self.surface.place(perch, q).at).collect()).collect();
        self.outline = Outline::compound(&parts)?;
        Ok(())
    }

    /// The perch of a place of the surface as it is now.
    fn perch_now(&self, at: [f64; 2]) -> Perch {
        let (nodes, q) = (self.dynamics.beam().nodes(), &self.state.nodes.displacement);
        let moved = nodes.iter().zip(q).map(|(x, q)| [x[0] + q[0], x[1] + q[1]]).collect();
        let elements = (0..self.dynamics.beam().elements().len()).map(|e| self.surface.ends(e)).collect();
        BeamSurface::new(moved, elements).perch(at, [0.0; 2])
    }
}

/// Loads of gravity [m/s²] on the undeformed elements.
fn own_weight(beam: &Beam, gravity: [f64; 2]) -> Result<Vec<[f64; 3]>, structure_fe::Error> {
    let mut weight = Loads::default();
    for (index, element) in beam.elements().iter().enumerate() {
        let q = gravity.map(|g| g * element.section.mass_per_length(&element.material));
        weight.along_element(index, q, q);
    }
    weight.at_nodes(beam, &vec![[0.0; 3]; beam.nodes().len()])
}

/// The corners of a polygon, with places between them no farther apart than `longest` [m].
fn divided(corners: &[[f64; 2]], longest: f64) -> impl Iterator<Item = [f64; 2]> {
    (0..corners.len()).flat_map(move |k| {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        let parts = ((b[0] - a[0]).hypot(b[1] - a[1]) / longest).ceil().max(1.0) as usize;
        (0..parts).map(move |i| [0, 1].map(|axis| a[axis] + i as f64 / parts as f64 * (b[axis] - a[axis])))
    })
}

fn pairing(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

impl WettedBody for BeamBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn arrange(&mut self, arrangement: Arrangement) {
        self.arrangement = arrangement;
    }

    fn sample(&mut self, spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError> {
        let points = crate::sampling::sample(&self.rest, spacing, layers, false, self.arrangement);
        self.perches = points.iter().map(|p| self.surface.perch(p.at, p.normal)).collect();
        Ok(points)
    }

    fn place(&self, ahead: f64, out: WallsMut<'_>) {
        let State { displacement: now, velocity, acceleration, .. } = &self.state.nodes;
        let then = self.ahead(ahead);
        for (k, perch) in self.perches.iter().enumerate() {
            let (from, to) = (self.surface.place(perch, now).at, self.surface.place(perch, &then));
            [out.x[k], out.y[k]] = to.at;
            [out.nx[k], out.ny[k]] = to.normal;
            [out.u[k], out.v[k]] = if ahead > 0.0 {
                [0, 1].map(|axis| (to.at[axis] - from[axis]) / ahead)
            } else {
                self.surface.velocity(perch, now, velocity)
            };
            [out.ax[k], out.ay[k]] = self.surface.velocity(perch, &then, acceleration);
        }
    }

    fn load(&mut self, force: WallForces<'_>) {
        let m = &mut self.state;
        m.load.fill([0.0; 3]);
        m.force = [0.0; 3];
        for (k, perch) in self.perches.iter().enumerate() {
            self.surface.carry(perch, &m.nodes.displacement, [force.mean_fx[k], force.mean_fy[k]], &mut m.load);
            let (fx, fy) = (force.fx[k], force.fy[k]);
            let moment = force.x[k] * fy - force.y[k] * fx;
            m.force = [m.force[0] + fx, m.force[1] + fy, m.force[2] + moment];
        }
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let m = &mut self.state;
        let before = (m.nodes.displacement.clone(), self.dynamics.momentum(&m.nodes));
        let all: Vec<[f64; 3]> = (0..self.weight.len())
            .map(|n| [0, 1, 2].map(|k| m.load[n][k] + self.weight[n][k] + m.struck[n][k] / dt))
            .collect();
        self.dynamics.step(&mut m.nodes, &all, dt).map_err(|error| failed(&self.name, &error))?;
        let after = self.dynamics.momentum(&m.nodes);
        // supports and gravity gave what neither the fluid nor blows did
        for k in 0..2 {
            let fluid: f64 = m.load.iter().zip(&m.struck).map(|(load, struck)| dt * load[k] + struck[k]).sum();
            m.external[k] += after[k] - before.1[k] - fluid;
        }
        let moved: Vec<[f64; 3]> =
            m.nodes.displacement.iter().zip(&before.0).map(|(q, p)| [0, 1, 2].map(|k| q[k] - p[k])).collect();
        m.work += pairing(&m.load, &moved) + pairing(&m.struck, &moved) / dt;
        m.struck.fill([0.0; 3]);
        self.follow()
    }

    fn stable_dt(&self) -> f64 {
        self.dynamics.stable_dt()
    }

    fn save(&mut self) {
        self.saved = Some((self.state.clone(), self.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((state, outline)) = &self.saved {
            (self.state, self.outline) = (state.clone(), outline.clone());
        }
    }

    fn energy(&self) -> Energy {
        let nodes = &self.state.nodes;
        Energy {
            kinetic: self.dynamics.kinetic_energy(nodes),
            potential: -pairing(&self.weight, &nodes.displacement),
            elastic: self.dynamics.strain_energy(nodes),
            work: self.state.work,
        }
    }

    fn ledger(&self) -> Ledger {
        let [px, py, _] = self.dynamics.momentum(&self.state.nodes);
        let struck = |k: usize| self.state.struck.iter().map(|node| node[k]).sum::<f64>();
        Ledger { momentum: [px + struck(0), py + struck(1)], external: self.state.external }
    }

    /// Its centre of mass at rest, moved as its nodes' masses are on average; it does not turn.
    fn motion(&self) -> Option<Motion> {
        let nodes = &self.state.nodes;
        let [px, py, _] = self.dynamics.momentum(nodes);
        let beam = self.dynamics.beam();
        let (mut position, mut acceleration) = ([0.0; 2], [0.0; 2]);
        for (index, element) in beam.elements().iter().enumerate() {
            let half = 0.5 * beam.length(index) * element.section.mass_per_length(&element.material) / self.mass;
            for node in element.nodes {
                for k in 0..2 {
                    position[k] += half * (beam.nodes()[node][k] + nodes.displacement[node][k]);
                    acceleration[k] += half * nodes.acceleration[node][k];
                }
            }
        }
        let [fx, fy, about] = self.state.force;
        Some(Motion {
            position,
            velocity: [px / self.mass, py / self.mass],
            acceleration,
            force: [fx, fy],
            moment: about - position[0] * fy + position[1] * fx,
            ..Motion::default()
        })
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.outline)
    }

    fn clearance(&self, at: [f64; 2]) -> f64 {
        self.outline.signed_distance(at)
    }

    fn surface(&self, at: [f64; 2]) -> Surface {
        let (found, normal) = self.outline.nearest(at);
        let perch = self.perch_now(found);
        let nodes = &self.state.nodes;
        Surface { at: found, normal, velocity: self.surface.velocity(&perch, &nodes.displacement, &nodes.velocity) }
    }

    fn strike(&mut self, at: [f64; 2], impulse: [f64; 2]) {
        let perch = self.perch_now(at);
        let m = &mut self.state;
        self.surface.carry(&perch, &m.nodes.displacement, impulse, &mut m.struck);
    }

    fn prescribed(&self) -> bool {
        false
    }
}
