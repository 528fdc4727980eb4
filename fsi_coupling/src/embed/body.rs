//! The host's nodes as a wetted body: their motion is given, their loads are collected (THEORY CO29–CO31).

use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};

use super::exchange::{Exchanged, Shared};
use super::frame::{HostFrame, MovingFrame};
use super::node_map::{Ends, NodeMap};
use super::nodes::HostNodes;
use super::topology::Topology;
use crate::bodies::bending::beam_surface::BeamAttachment;
use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::rigid_motion::RigidMotion;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::plate::Plate;
use crate::geometry::plate_sampling::boundary_particles;
use crate::geometry::rows::WallRows;
use crate::geometry::vector::{cross, rotate};

/// A difference in time for accelerations, in steps of the water [-].
const DIFFERENCE: f64 = 1e-3;

/// See the module's text.
pub(super) struct HostBody {
    name: String,
    map: NodeMap,
    /// At t = 0.
    rest: Outline,
    frame: MovingFrame,
    /// The frame now.
    motion: RigidMotion,
    /// In the frame.
    outline: Outline,
    /// Corners of the outline, where the surface is not rigid.
    corners: Vec<Vec<BeamAttachment>>,
    /// Only the part x > 0 is simulated.
    half: bool,
    attachments: Vec<BeamAttachment>,
    node_count: usize,
    /// The image of each node in x = 0, where a half is simulated; else empty.
    images: Vec<usize>,
    plate: Option<Plate>,
    midline: Vec<BeamAttachment>,
    shared: Shared,
    checkpoint: Option<(Exchanged, Outline)>,
}

/// A surface of a host, without its topology.
pub(super) struct SurfaceParts {
    pub name: String,
    /// What the topology encloses at t = 0.
    pub rest: Outline,
    pub frame: HostFrame,
    /// Length that divides the outline of bent sides [m].
    pub spacing: f64,
    /// The image of each node in x = 0, where only the part x > 0 is simulated; else empty.
    pub images: Vec<usize>,
}

impl HostBody {
    /// Of a topology that has been checked; `nodes` are those at t = 0.
    pub fn new(topology: &Topology, nodes: &HostNodes, parts: SurfaceParts, shared: Shared) -> HostBody {
        let SurfaceParts { name, rest, frame, spacing, images } = parts;
        let map = NodeMap::new(topology, nodes);
        let frame = MovingFrame::new(topology, nodes, frame);
        let motion = frame.at(nodes);
        let corners = if frame.is_rigid() { Vec::new() } else { map.corners(topology, spacing) };
        let start = frame.at_start();
        let in_frame = |line: &Vec<[f64; 2]>| line.iter().map(|at| start.local(*at)).collect();
        let outline = Outline::deformed(rest.loops().iter().map(in_frame).collect()).unwrap_or_else(|| rest.clone());
        let (attachments, midline, plate, half) = (Vec::new(), Vec::new(), None, !images.is_empty());
        HostBody {
            name,
            map,
            rest,
            frame,
            motion,
            outline,
            corners,
            half,
            attachments,
            node_count: topology.nodes.len(),
            images,
            plate,
            midline,
            shared,
            checkpoint: None,
        }
    }

    /// The loads of forces on the boundary particles, mean (0) or now (1), and of their images.
    fn loads(&self, pushed: &[[[f64; 2]; 2]], which: usize, ends: &Ends) -> Vec<[f64; 3]> {
        self.loads_of(self.attachments.iter().zip(pushed.iter().map(|force| force[which])), ends)
    }

    /// The loads of forces at points, and of the images of these forces where a half is simulated.
    fn loads_of<'a>(&self, forces: impl Iterator<Item = (&'a BeamAttachment, [f64; 2])>, ends: &Ends) -> Vec<[f64; 3]> {
        let mut loads = vec![[0.0; 3]; self.node_count];
        self.map.add_loads(forces, ends, &mut loads);
        let image = |node: &usize| loads[*node];
        match self.images.is_empty() {
            true => loads,
            false => loads
                .iter()
                .zip(self.images.iter().map(image))
                .map(|(own, [fx, fy, m])| [own[0] - fx, own[1] + fy, own[2] - m])
                .collect(),
        }
    }

    /// Time since the start of the host's step [s].
    fn elapsed(&self) -> f64 {
        self.shared.open().elapsed
    }

    fn ends(&self, elapsed: f64) -> Ends {
        let nodes = self.shared.open().path.at(elapsed);
        self.map.ends(&nodes)
    }

    /// Length of time for differences about a moment of the host's step [s].
    fn difference(&self, ahead: f64) -> f64 {
        DIFFERENCE * if ahead > 0.0 { ahead } else { self.shared.open().path.duration() }
    }

    /// Frame and outline where the nodes are now.
    fn follow(&mut self, ends: &Ends) -> Result<(), BodyError> {
        let nodes = {
            let shared = self.shared.open();
            shared.path.at(shared.elapsed)
        };
        self.motion = self.frame.at(&nodes);
        if !self.corners.is_empty() {
            let place = |attachment: &BeamAttachment| self.motion.local(self.map.place(attachment, ends).at);
            let parts: Vec<Vec<[f64; 2]>> = self.corners.iter().map(|part| part.iter().map(place).collect()).collect();
            self.outline = Outline::compound(&parts)?;
        }
        Ok(())
    }

    fn follow_restored(&mut self, outline: Outline) {
        self.outline = outline;
        let shared = self.shared.open();
        self.motion = self.frame.at(&shared.path.at(shared.elapsed));
    }

    /// Velocity and acceleration of a point of the surface.
    fn point_motion(&self, attachment: &BeamAttachment) -> ([f64; 2], [f64; 2]) {
        let (elapsed, moment) = (self.elapsed(), self.difference(0.0));
        let velocity = |elapsed: f64| self.map.velocity(attachment, &self.ends(elapsed));
        let about = [-moment, moment].map(|ahead| velocity(elapsed + ahead));
        (velocity(elapsed), rate(about, moment))
    }
}

/// Acceleration from the velocities `moment` [s] before and after [m/s²]; none without a difference in time.
fn rate([before, after]: [[f64; 2]; 2], moment: f64) -> [f64; 2] {
    [0, 1].map(|k| if moment > 0.0 { (after[k] - before[k]) / (2.0 * moment) } else { 0.0 })
}

impl WettedBody for HostBody {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        let (points, plate) = boundary_particles(&self.rest, rows, self.half);
        self.attachments = points.iter().map(|p| self.map.attach(p.at, p.normal)).collect();
        self.midline = plate.iter().flat_map(|plate| self.map.along(&plate.line(), rows.spacing)).collect();
        self.plate = plate;
        Ok(points)
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let elapsed = self.elapsed();
        let (now, then) = (self.ends(elapsed), self.ends(elapsed + ahead));
        let moment = self.difference(ahead);
        let about = [self.ends(elapsed + ahead - moment), self.ends(elapsed + ahead + moment)];
        for (k, attachment) in self.attachments.iter().enumerate() {
            let place = self.map.place(attachment, &then);
            [out.x[k], out.y[k]] = place.at;
            [out.nx[k], out.ny[k]] = place.normal;
            [out.u[k], out.v[k]] = if ahead > 0.0 {
                let from = self.map.place(attachment, &now).at;
                [0, 1].map(|axis| (place.at[axis] - from[axis]) / ahead)
            } else {
                self.map.velocity(attachment, &now)
            };
            [out.ax[k], out.ay[k]] = rate([0, 1].map(|k| self.map.velocity(attachment, &about[k])), moment);
        }
        let placed = |ends: &Ends| self.midline.iter().map(|point| self.map.place(point, ends).at).collect();
        let midline = |plate: &Plate| PlateMidline {
            points: placed(&then),
            start: placed(&now),
            half_thickness: 0.5 * plate.thickness,
            own_image: self.half,
        };
        self.plate.iter().map(midline).collect()
    }

    fn load(&mut self, force: WallForces<'_>) {
        let of = |k: usize| [[force.mean_fx[k], force.mean_fy[k]], [force.fx[k], force.fy[k]]];
        let pushed: Vec<_> = (0..force.x.len()).map(of).collect();
        let first = self.shared.open().pushed.is_empty();
        if first {
            let now = self.loads(&pushed, 1, &self.ends(0.0));
            self.shared.open().now = now;
        }
        self.shared.open().pushed = pushed;
    }

    /// The nodes move on along their path; the step's impulse goes to them (CO31), taken in the middle of the step.
    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        let (elapsed, pushed) = {
            let mut shared = self.shared.open();
            (shared.elapsed, std::mem::take(&mut shared.pushed))
        };
        let (before, middle, after) = (self.ends(elapsed), self.ends(elapsed + 0.5 * dt), self.ends(elapsed + dt));
        let (mean, now) = (self.loads(&pushed, 0, &middle), self.loads(&pushed, 1, &after));
        let halves = if self.half { 2.0 } else { 1.0 };
        let work: f64 = self
            .attachments
            .iter()
            .zip(&pushed)
            .map(|(attachment, [mean, _])| {
                let (from, to) = (self.map.place(attachment, &before).at, self.map.place(attachment, &after).at);
                mean[0] * (to[0] - from[0]) + mean[1] * (to[1] - from[1])
            })
            .sum(); // CO31
        let mut shared = self.shared.open();
        for (impulse, mean) in shared.impulse.iter_mut().zip(&mean) {
            (0..3).for_each(|k| impulse[k] += dt * mean[k]);
        }
        for mean in &mean {
            (0..2).for_each(|k| shared.external[k] -= dt * mean[k]);
        }
        shared.work += halves * work;
        (shared.now, shared.pushed) = (now, pushed);
        shared.elapsed += dt;
        drop(shared);
        self.follow(&after)
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some((self.shared.open().clone(), self.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((exchanged, outline)) = &self.checkpoint {
            *self.shared.open() = exchanged.clone();
            self.follow_restored(outline.clone());
        }
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&(&*self.shared.open(), self.outline.loops()))
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        const BODY: &str = "the host's surface";
        let (exchanged, loops): (Exchanged, Vec<Vec<[f64; 2]>>) = decode(BODY, bytes)?;
        exchanged.check(&self.shared.open(), self.attachments.len())?;
        let not_finite = || StateError::Unreadable(BODY, "its outline is not finite".into());
        let outline = Outline::deformed(loops).ok_or_else(not_finite)?;
        *self.shared.open() = exchanged;
        self.follow_restored(outline);
        Ok(())
    }
}

impl Contact for HostBody {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.outline.signed_distance(self.motion.local(at))
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let (found, normal) = self.outline.nearest(self.motion.local(at));
        let (found, normal) = (self.motion.point(found), rotate(normal, self.motion.angle));
        let ends = self.ends(self.elapsed());
        let attachment = self.map.attach_now(found, &ends);
        SurfacePoint { at: found, normal, velocity: self.map.velocity(&attachment, &ends) }
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let ends = self.ends(self.elapsed());
        let attachment = self.map.attach_now(contact.at, &ends);
        let (velocity, impulse) = (self.map.velocity(&attachment, &ends), contact.impulse);
        let loads = self.loads_of([(&attachment, impulse)].into_iter(), &ends);
        let mut shared = self.shared.open();
        for (sum, load) in shared.impulse.iter_mut().zip(&loads) {
            (0..3).for_each(|k| sum[k] += load[k]);
        }
        let total = contact.resultant().1;
        (0..2).for_each(|k| shared.external[k] -= total[k]);
        let halves = if contact.mirrored { 2.0 } else { 1.0 };
        shared.work += halves * (impulse[0] * velocity[0] + impulse[1] * velocity[1]);
    }
}

impl Linked for HostBody {}

impl Inspect for HostBody {
    fn name(&self) -> &str {
        &self.name
    }

    /// The frame's, and the force of the water.
    fn motion(&self) -> Option<Motion> {
        let moment = self.difference(0.0);
        let shared = self.shared.open();
        let position = shared.path.at(shared.elapsed).position;
        let about = self.motion.position;
        let mut load = Resultant::default();
        for (at, [fx, fy, moment]) in position.iter().zip(&shared.now) {
            load.force = [load.force[0] + fx, load.force[1] + fy];
            load.moment += moment + cross([at[0] - about[0], at[1] - about[1]], [*fx, *fy]);
        }
        let velocity = |elapsed: f64| self.frame.at(&shared.path.at(elapsed)).velocity;
        let acceleration = rate([-moment, moment].map(|ahead| velocity(shared.elapsed + ahead)), moment);
        Some(Motion::new(&RigidMotion { acceleration, ..self.motion }, load))
    }

    fn material_point(&self, at: [f64; 2]) -> Option<(SurfacePoint, [f64; 2])> {
        if self.frame.is_rigid() {
            return None;
        }
        let rest = self.frame.at_start().point(at);
        let attachment = self.map.attach(rest, self.rest.nearest(rest).1);
        let place = self.map.place(&attachment, &self.ends(self.elapsed()));
        let (velocity, acceleration) = self.point_motion(&attachment);
        Some((SurfacePoint { at: place.at, normal: place.normal, velocity }, acceleration))
    }

    fn outline(&self) -> Option<&Outline> {
        Some(&self.outline)
    }

    fn energy(&self) -> Energy {
        Energy { work: self.shared.open().work, ..Energy::default() }
    }

    fn momentum(&self) -> Momentum {
        Momentum { momentum: [0.0; 2], external: self.shared.open().external }
    }

    fn is_prescribed(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::embed::nodes::Path;

    /// A contact impulse acts on the nodes next to it, its reaction is an external impulse; a restored state has neither.
    #[test]
    fn a_contact_impulse_acts_on_the_nodes_and_counts_as_external() {
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let topology = Topology::of(corners.clone()).closed(0..4);
        let mut nodes = HostNodes::at_rest(corners);
        nodes.velocity.fill([0.5, -2.0]);
        let shared = Shared::new(Path::resting(&nodes));
        let rest = topology.outline().expect("a square");
        let frame = HostFrame::default();
        let parts = SurfaceParts { name: "square".into(), rest, frame, spacing: 0.1, images: Vec::new() };
        let mut body = HostBody::new(&topology, &nodes, parts, shared.clone());
        body.checkpoint();
        body.apply_impulse(&ContactImpulse { at: [0.25, 0.0], impulse: [3.0, 4.0], mirrored: false });
        let impulse = shared.open().impulse.clone();
        for (found, exact) in impulse.iter().zip([[2.25, 3.0, 0.0], [0.75, 1.0, 0.0], [0.0; 3], [0.0; 3]]) {
            assert!((0..3).all(|k| (found[k] - exact[k]).abs() < 1e-14), "{impulse:?}");
        }
        assert_eq!((body.momentum().external, body.energy().work), ([-3.0, -4.0], 3.0 * 0.5 - 4.0 * 2.0));
        let velocity = body.surface([0.3, -0.2]).velocity;
        assert!((velocity[0] - 0.5).hypot(velocity[1] + 2.0) < 1e-15, "{velocity:?}");
        body.restore();
        assert_eq!((body.momentum(), body.energy()), (Momentum::default(), Energy::default()));
    }
}
