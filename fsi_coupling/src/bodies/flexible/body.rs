//! A body whose surface bends: panels of beam elements on a rigid frame, one set of equations (THEORY K1–K6).

use structure_fe::{Dynamics, Envelope, State};

use sph_core::{Screen, WallForces, WallPoint, WallsMut, Yields};

use crate::bodies::body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
use crate::bodies::flexible::deformed_outline::Skin;
use crate::bodies::flexible::interface::FlexibleYield;
use crate::bodies::flexible::model::{FlexibleSpec, Frame, Model};
use crate::bodies::flexible::panel_state::{PanelState, state_of};
use crate::bodies::flexible::state::{Moving, pairing};
use crate::bodies::flexible::surface_map::Carrier;
use crate::bodies::prescribed::Law;
use crate::bodies::rigid_motion::{Rigid, rotate};
use crate::geometry::outline::Outline;
use crate::geometry::rows::Arrangement;
use crate::geometry::thin_plate::{self, Plate};

/// See the module's text. The load of a step is the mean force of the fluid, carried to the nodes by the transpose of
/// what places the boundary particles; the structure's step changes momentum by exactly that (THEORY S21).
pub struct FlexibleBody {
    name: String,
    model: Model,
    arrangement: Arrangement,
    rest: Outline,
    half: bool,
    law: Option<Law>,
    free: [bool; 3],
    carriers: Vec<Carrier>,
    /// The plate that it is sampled as, where it is a thin one, and what carries its middle line (THEORY T1, T2).
    plate: Option<Plate>,
    screen: Vec<Carrier>,
    skin: Skin,
    gravity: [f64; 2],
    weight: Vec<[f64; 3]>,
    outline: Outline,
    state: Moving,
    saved: Option<(Moving, Outline)>,
}

impl FlexibleBody {
    /// The body at the start, its panels undeformed, under its own weight alone.
    pub fn new(spec: FlexibleSpec) -> Result<FlexibleBody, BodyError> {
        let (mut model, mut nodes) = Model::new(&spec)?;
        let FlexibleSpec { name, outline, frame, gravity, half, .. } = spec;
        let weight = model.dynamics.gravity_load(gravity);
        let (law, free) = match frame {
            Frame::Given(law) => (Some(law), [false; 3]),
            Frame::Free { free, .. } => (None, free),
        };
        if let Some(law) = &law {
            model.prescribe(&law(0.0)).map_err(|error| BodyError::structure(&name, &error))?;
        }
        model.dynamics.equilibrate(&mut nodes, &weight).map_err(|error| BodyError::structure(&name, &error))?;
        let skin = Skin::new(&outline, &model, half);
        let state = Moving::new(nodes, Envelope::new(model.dynamics.beam()));
        let (arrangement, carriers) = (Arrangement::default(), Vec::new());
        let rest = outline.clone();
        Ok(FlexibleBody {
            name,
            model,
            arrangement,
            rest,
            half,
            law,
            free,
            carriers,
            plate: None,
            screen: Vec::new(),
            skin,
            gravity,
            weight,
            outline,
            state,
            saved: None,
        })
    }

    /// The structure's motion: displacements, velocities and accelerations of its nodes.
    pub fn nodes(&self) -> &State {
        &self.state.nodes
    }

    /// The structure.
    pub fn dynamics(&self) -> &Dynamics {
        &self.model.dynamics
    }

    /// Mean load of the fluid over the last step, `[nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub fn load_of_fluid(&self) -> &[[f64; 3]] {
        &self.state.mean
    }

    /// Displacements `ahead` [s] from now, at constant acceleration.
    fn ahead(&self, ahead: f64) -> Vec<[f64; 3]> {
        let State { displacement, velocity, acceleration, .. } = &self.state.nodes;
        let each = displacement.iter().zip(velocity).zip(acceleration);
        each.map(|((q, v), a)| [0, 1, 2].map(|k| q[k] + ahead * (v[k] + 0.5 * ahead * a[k]))).collect()
    }

    /// After a step, or a step taken back: what broke off carries its own weight, and the frame's node may be elsewhere.
    fn settle(&mut self) {
        self.model.settle();
        self.weight = self.model.dynamics.gravity_load(self.gravity);
    }

    /// −Σ W·x: potential energy of the structure that is simulated [J/m].
    fn potential(&self) -> f64 {
        let places = self.model.dynamics.beam().nodes().iter().zip(&self.state.nodes.displacement);
        let each = self.weight.iter().zip(places);
        -each.map(|(w, (x, q))| w[0] * (x[0] + q[0]) + w[1] * (x[1] + q[1]) + w[2] * q[2]).sum::<f64>()
    }

    /// Loads on the nodes of an impulse [N s/m] at a place of the surface in space [m].
    fn loads_of(&self, at: [f64; 2], impulse: [f64; 2]) -> Vec<[f64; 3]> {
        let mut loads = vec![[0.0; 3]; self.weight.len()];
        let (found, q) = (self.to_frame(at), &self.state.nodes.displacement);
        self.skin.carry(&self.model.carriage, &self.outline, found, q, impulse, &mut loads);
        loads
    }

    /// Velocities that impulses on the nodes give within a step of `dt` [s] (S24); none where that has no answer.
    fn answer(&mut self, impulses: &[[f64; 3]], dt: f64) -> Vec<[f64; 3]> {
        let still = || vec![[0.0; 3]; impulses.len()];
        if dt <= 0.0 {
            return still();
        }
        let inertia = self.model.dynamics.effective_inertia(&self.state.nodes, dt);
        inertia.solve(impulses).unwrap_or_else(|_| still())
    }

    fn frame(&self) -> Rigid {
        self.model.frame(&self.state.nodes)
    }

    /// The outline where the structure is now.
    fn follow(&mut self) -> Result<(), BodyError> {
        let frame = self.frame();
        let nodes = &self.state.nodes;
        let placed = self.skin.outline(&self.model.carriage, &nodes.displacement, &frame);
        let lost = || BodyError::NotFinite { name: self.name.clone(), time: nodes.time };
        self.outline = placed.ok_or_else(lost)?;
        Ok(())
    }

    /// A point in space, in the body's frame.
    fn to_frame(&self, at: [f64; 2]) -> [f64; 2] {
        let frame = self.frame();
        rotate([at[0] - frame.pole[0], at[1] - frame.pole[1]], -frame.angle)
    }

    /// Of a half that is simulated, both count: what acts along y twice, what acts along x not at all.
    fn both(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.half { [0.0, 2.0 * y] } else { [x, y] }
    }
}

impl WettedBody for FlexibleBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn arrange(&mut self, arrangement: Arrangement) {
        self.arrangement = arrangement;
    }

    fn sample(&mut self, spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError> {
        self.plate = self.rest.plate().filter(|plate| plate.is_thin(spacing, layers)).cloned();
        let mut points = match &self.plate {
            None => crate::geometry::sampling::sample(&self.rest, spacing, layers, self.half, self.arrangement),
            Some(plate) => {
                let points = thin_plate::sample(&plate.line(), plate.thickness, spacing, layers);
                if self.half { thin_plate::right_half(points, spacing) } else { points }
            }
        };
        let start = self.model.start;
        if let Some(plate) = &self.plate {
            self.screen = self.model.divided(&plate.line());
        }
        for point in &mut points {
            let foot = [0, 1].map(|k| point.at[k] + point.depth * point.normal[k]);
            self.carriers.push(self.model.carrier(foot, point.at, point.normal));
            (point.at, point.normal) = (start.point(point.at), rotate(point.normal, start.angle));
        }
        Ok(points)
    }

    fn place(&self, ahead: f64, out: WallsMut<'_>) {
        let State { displacement: now, velocity, acceleration, .. } = &self.state.nodes;
        let then = self.ahead(ahead);
        let carriage = &self.model.carriage;
        for (k, carrier) in self.carriers.iter().enumerate() {
            let from = self.state.shown.get(k).copied().unwrap_or_else(|| carriage.place(carrier, now).at);
            let to = carriage.place(carrier, &then);
            [out.x[k], out.y[k]] = to.at;
            [out.nx[k], out.ny[k]] = to.normal;
            [out.u[k], out.v[k]] = if ahead > 0.0 {
                [0, 1].map(|axis| (to.at[axis] - from[axis]) / ahead)
            } else {
                carriage.velocity(carrier, now, velocity)
            };
            [out.ax[k], out.ay[k]] = carriage.acceleration(carrier, &then, velocity, acceleration);
        }
    }

    fn screens(&self, ahead: f64) -> Vec<Screen> {
        let Some(plate) = &self.plate else { return Vec::new() };
        let (now, then) = (&self.state.nodes.displacement, self.ahead(ahead));
        let placed = |q: &[[f64; 3]]| self.screen.iter().map(|c| self.model.carriage.place(c, q).at).collect();
        let half_thickness = 0.5 * plate.thickness;
        vec![Screen { points: placed(&then), start: placed(now), half_thickness, own_image: self.half }]
    }

    fn yielding(&mut self, ahead: f64) -> Result<Option<Box<dyn Yields>>, BodyError> {
        let now = &self.state.nodes;
        let each = now.velocity.iter().zip(&now.acceleration);
        let velocity = each.map(|(v, a)| [0, 1, 2].map(|k| v[k] + ahead * a[k])).collect();
        let then = State { displacement: self.ahead(ahead), velocity, ..now.clone() };
        let (dynamics, riders) = (&mut self.model.dynamics, (&self.model.carriage, &self.carriers[..]));
        let owner = FlexibleYield::new(&self.name, dynamics, riders, (now, &then), &self.weight, ahead)?;
        Ok(Some(Box::new(owner)))
    }

    fn load(&mut self, force: WallForces<'_>) {
        let (m, carriage) = (&mut self.state, &self.model.carriage);
        m.mean.fill([0.0; 3]);
        m.now.fill([0.0; 3]);
        m.force = [0.0; 3];
        m.shown.clear();
        m.shown.extend(force.x.iter().zip(force.y).map(|(x, y)| [*x, *y]));
        for (k, carrier) in self.carriers.iter().enumerate() {
            let (q, now) = (&m.nodes.displacement, [force.fx[k], force.fy[k]]);
            carriage.carry(carrier, q, [force.mean_fx[k], force.mean_fy[k]], &mut m.mean);
            carriage.carry(carrier, q, now, &mut m.now);
            let moment = force.x[k] * now[1] - force.y[k] * now[0];
            m.force = [m.force[0] + now[0], m.force[1] + now[1], m.force[2] + moment];
        }
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        if let Some(law) = &self.law {
            let told = law(self.state.nodes.time + dt);
            self.model.prescribe(&told).map_err(|error| BodyError::structure(&self.name, &error))?;
        }
        let (m, dynamics) = (&mut self.state, &mut self.model.dynamics);
        let before = (m.nodes.displacement.clone(), dynamics.momentum(&m.nodes));
        let all: Vec<[f64; 3]> = (0..self.weight.len())
            .map(|n| [0, 1, 2].map(|k| m.mean[n][k] + self.weight[n][k] + m.struck[n][k] / dt))
            .collect();
        let stepped = dynamics.step(&mut m.nodes, &all, dt);
        let report = stepped.map_err(|error| BodyError::structure(&self.name, &error))?;
        let moved: Vec<[f64; 3]> =
            m.nodes.displacement.iter().zip(&before.0).map(|(q, p)| [0, 1, 2].map(|k| q[k] - p[k])).collect();
        let after = dynamics.momentum(&m.nodes);
        for k in 0..2 {
            let sum = |loads: &[[f64; 3]]| loads.iter().map(|load| load[k]).sum::<f64>();
            let fluid = dt * sum(&m.mean) + sum(&m.struck);
            // a guide gives what weight and fluid do not
            m.external[k] += if self.free[k] { dt * sum(&self.weight) } else { after[k] - before.1[k] - fluid };
        }
        let work = pairing(&m.mean, &moved) + pairing(&m.struck, &moved) / dt;
        m.work += work;
        m.dissipated += report.dissipated;
        m.support += report.support_work;
        m.struck.fill([0.0; 3]);
        m.shaken.fill([0.0; 3]);
        let now: Vec<[f64; 3]> =
            m.now.iter().zip(&self.weight).map(|(load, weight)| [0, 1, 2].map(|k| load[k] + weight[k])).collect();
        dynamics.equilibrate_over(&mut m.nodes, &now, dt).map_err(|error| BodyError::structure(&self.name, &error))?;
        m.envelope.record(dynamics, &m.nodes);
        self.settle();
        self.follow()
    }

    fn stable_dt(&self) -> f64 {
        self.model.dynamics.stable_dt()
    }

    fn save(&mut self) {
        self.saved = Some((self.state.clone(), self.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((state, outline)) = &self.saved {
            (self.state, self.outline) = (state.clone(), outline.clone());
            // a model that was laid out before can be laid out again
            let _ = self.model.dynamics.apply_ruptures(&self.state.nodes);
            self.settle();
        }
    }

    fn energy(&self) -> Energy {
        let (nodes, whole) = (&self.state.nodes, 1.0 / self.model.share);
        Energy {
            kinetic: whole * self.model.dynamics.kinetic_energy(nodes),
            potential: whole * self.potential(),
            elastic: whole * self.model.dynamics.strain_energy(nodes),
            work: whole * self.state.work,
            support: whole * self.state.support,
            dissipated: whole * self.state.dissipated,
        }
    }

    fn ledger(&self) -> Ledger {
        let [px, py, _] = self.model.dynamics.momentum(&self.state.nodes);
        let struck = |k: usize| self.state.struck.iter().map(|node| node[k]).sum::<f64>();
        let momentum = self.both([px + struck(0), py + struck(1)]);
        Ledger { momentum, external: self.both(self.state.external) }
    }

    /// Motion of the rigid frame.
    fn motion(&self) -> Option<Motion> {
        let (frame, [fx, fy, about]) = (self.frame(), self.state.force);
        let force = self.both([fx, fy]);
        let moment = if self.half { 0.0 } else { about };
        Some(Motion {
            position: frame.pole,
            angle: frame.angle,
            velocity: frame.velocity,
            spin: frame.spin,
            acceleration: frame.acceleration,
            force,
            moment: moment - frame.pole[0] * force[1] + frame.pole[1] * force[0],
        })
    }

    fn panels(&self) -> Vec<PanelState> {
        let (model, state, frame) = (&self.model, &self.state, self.frame());
        let parts = (&model.dynamics, &model.carriage);
        model.panels.iter().map(|panel| state_of(panel, parts, &state.nodes, &frame, &state.envelope)).collect()
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.outline)
    }

    fn crossing(&self) -> Option<[f64; 2]> {
        let (at, frame) = (self.outline.crossing()?, self.frame());
        let at = rotate(at, frame.angle);
        Some([0, 1].map(|k| frame.pole[k] + at[k]))
    }

    fn clearance(&self, at: [f64; 2]) -> f64 {
        self.outline.signed_distance(self.to_frame(at))
    }

    fn surface(&self, at: [f64; 2]) -> Surface {
        let (frame, nodes) = (self.frame(), &self.state.nodes);
        let (found, normal) = self.outline.nearest(self.to_frame(at));
        let at = rotate(found, frame.angle);
        let each = nodes.velocity.iter().zip(&self.state.shaken);
        let moving: Vec<[f64; 3]> = each.map(|(v, s)| [0, 1, 2].map(|k| v[k] + s[k])).collect();
        let velocity = self.skin.velocity(&self.model.carriage, &self.outline, found, (&nodes.displacement, &moving));
        Surface { at: [0, 1].map(|k| frame.pole[k] + at[k]), normal: rotate(normal, frame.angle), velocity }
    }

    fn ride(&self, at: [f64; 2]) -> Option<(Surface, [f64; 2])> {
        let (_, normal) = self.rest.nearest(at);
        let (carriage, carrier) = (&self.model.carriage, self.model.carrier(at, at, normal));
        let State { displacement, velocity, acceleration, .. } = &self.state.nodes;
        let place = carriage.place(&carrier, displacement);
        let surface = Surface {
            at: place.at,
            normal: place.normal,
            velocity: carriage.velocity(&carrier, displacement, velocity),
        };
        Some((surface, carriage.acceleration(&carrier, displacement, velocity, acceleration)))
    }

    fn strike(&mut self, at: [f64; 2], impulse: [f64; 2]) {
        let loads = self.loads_of(at, impulse);
        let shaken = self.answer(&loads, self.state.dt);
        let m = &mut self.state;
        let sums = m.struck.iter_mut().zip(&loads).chain(m.shaken.iter_mut().zip(&shaken));
        sums.for_each(|(sum, more)| (0..3).for_each(|k| sum[k] += more[k]));
    }

    fn mobility(&mut self, at: [f64; 2], normal: [f64; 2], dt: f64) -> f64 {
        self.state.dt = dt;
        let loads = self.loads_of(at, normal);
        pairing(&loads, &self.answer(&loads, dt)).max(0.0)
    }

    /// The half that is simulated feels its own blow; its image is the other half's.
    fn strike_both(&mut self, at: [f64; 2], impulse: [f64; 2]) {
        self.strike(at, impulse);
    }

    fn prescribed(&self) -> bool {
        false
    }
}
