//! The host's nodes as a wetted body: their motion is given, their loads are collected (THEORY CO29–CO31).

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, decode, encode, expect_count};
use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};

use super::node_map::{Ends, NodeMap};
use super::nodes::Path;
use super::topology::Topology;
use crate::bodies::beam_surface::BeamAttachment;
use crate::bodies::body::{Contact, Inspect, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Motion, SurfacePoint};
use crate::geometry::outline::Outline;
use crate::geometry::rows::WallRows;

/// A difference in time for accelerations, in steps of the water [-].
const DIFFERENCE: f64 = 1e-3;
/// Most straight pieces that the outline of a bent side is drawn with.
const PIECES: f64 = 8.0;

/// What the element and the body inside its [`Coupled`](crate::Coupled) share: the way of the nodes goes in, what the water
/// gave them comes out.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Exchanged {
    /// How the nodes move in this step of the host.
    pub path: Path,
    /// Time since its start [s].
    pub elapsed: f64,
    /// Impulses on the nodes since its start, `[nodes][J_x, J_y, L]` [N s/m, N s/m, N s].
    pub impulse: Vec<[f64; 3]>,
    /// Forces on the nodes now [N/m, N/m, N].
    pub now: Vec<[f64; 3]>,
    /// Work done on the nodes since the start of the run [J/m].
    pub work: f64,
    /// Impulse given to the system from outside since the start of the run [N s/m].
    external: [f64; 2],
    /// Mean forces of the step just taken on the boundary particles, and forces now [N/m].
    pushed: Vec<[[f64; 2]; 2]>,
}

impl Exchanged {
    /// An error unless there are as many nodes as in `like`, and `particles` of the boundary, or none.
    fn check(&self, like: &Exchanged, particles: usize) -> Result<(), StateError> {
        expect_count("nodes with an impulse", self.impulse.len(), like.impulse.len())?;
        expect_count("nodes with a force", self.now.len(), like.now.len())?;
        self.path.check_like(&like.path)?;
        match self.pushed.len() {
            0 => Ok(()),
            found => expect_count("boundary particles", found, particles),
        }
    }
}

/// One exchange, held at both ends.
#[derive(Clone)]
pub(super) struct Shared(Arc<Mutex<Exchanged>>);

impl Shared {
    /// Before the first step.
    pub fn new(path: Path) -> Shared {
        let none = vec![[0.0; 3]; path.end().len()];
        let (impulse, now) = (none.clone(), none);
        let (elapsed, work, external, pushed) = (0.0, 0.0, [0.0; 2], Vec::new());
        Shared(Arc::new(Mutex::new(Exchanged { path, elapsed, impulse, now, work, external, pushed })))
    }

    /// To be read and written; one end at a time.
    pub fn open(&self) -> MutexGuard<'_, Exchanged> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// See the module's text.
pub(super) struct HostBody {
    map: NodeMap,
    /// At t = 0.
    rest: Outline,
    outline: Outline,
    corners: Vec<Vec<BeamAttachment>>,
    attachments: Vec<BeamAttachment>,
    shared: Shared,
    checkpoint: Option<(Exchanged, Outline)>,
}

impl HostBody {
    /// Of a topology that has been checked, which encloses `rest`; `spacing` [m] divides the outline of bent sides.
    pub fn new(topology: &Topology, rest: Outline, map: NodeMap, spacing: f64, shared: Shared) -> HostBody {
        let (mut corners, mut first) = (Vec::new(), 0);
        for (surface, corner_points) in topology.surfaces.iter().zip(topology.loops()) {
            let (nodes, sides) = surface.counts();
            let mut attachments = Vec::new();
            for side in first..first + sides {
                let ends = [map.start_of(side, 0), map.start_of(side, 1)];
                let length = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
                let pieces = if topology.rotations { (length / spacing).ceil().clamp(1.0, PIECES) } else { 1.0 };
                attachments.extend((0..pieces as usize).map(|k| NodeMap::on_side(side, k as f64 / pieces)));
            }
            if nodes > sides {
                attachments.push(NodeMap::on_side(first + sides - 1, 1.0));
            }
            attachments.extend(corner_points[nodes..].iter().map(|at| map.attach(*at, [0.0; 2])));
            corners.push(attachments);
            first += sides;
        }
        let (outline, attachments) = (rest.clone(), Vec::new());
        HostBody { map, rest, outline, corners, attachments, shared, checkpoint: None }
    }

    /// Add the loads of forces on the boundary particles, mean (0) or now (1).
    fn loads(&self, pushed: &[[[f64; 2]; 2]], which: usize, ends: &Ends) -> Vec<[f64; 3]> {
        let mut loads = vec![[0.0; 3]; self.shared.open().impulse.len()];
        self.map.add_loads(self.attachments.iter().zip(pushed.iter().map(|force| force[which])), ends, &mut loads);
        loads
    }

    /// Time since the start of the host's step [s].
    fn elapsed(&self) -> f64 {
        self.shared.open().elapsed
    }

    fn ends(&self, elapsed: f64) -> Ends {
        let nodes = self.shared.open().path.at(elapsed);
        self.map.ends(&nodes)
    }
}

impl WettedBody for HostBody {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        let points = crate::geometry::sampling::sample(&self.rest, rows, false);
        self.attachments = points.iter().map(|p| self.map.attach(p.at, p.normal)).collect();
        Ok(points)
    }

    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let (elapsed, duration) = {
            let shared = self.shared.open();
            (shared.elapsed, shared.path.duration())
        };
        let (now, then) = (self.ends(elapsed), self.ends(elapsed + ahead));
        let moment = DIFFERENCE * if ahead > 0.0 { ahead } else { duration };
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
            [out.ax[k], out.ay[k]] = if moment > 0.0 {
                let [before, after] = [0, 1].map(|k| self.map.velocity(attachment, &about[k]));
                [0, 1].map(|axis| (after[axis] - before[axis]) / (2.0 * moment))
            } else {
                [0.0; 2]
            };
        }
        Vec::new()
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
        let work: f64 = self
            .attachments
            .iter()
            .zip(&pushed)
            .map(|(attachment, [mean, _])| {
                let (from, to) = (self.map.place(attachment, &before).at, self.map.place(attachment, &after).at);
                mean[0] * (to[0] - from[0]) + mean[1] * (to[1] - from[1])
            })
            .sum(); // CO31
        let parts: Vec<Vec<[f64; 2]>> = self
            .corners
            .iter()
            .map(|part| part.iter().map(|attachment| self.map.place(attachment, &after).at).collect())
            .collect();
        self.outline = Outline::compound(&parts)?;
        let mut shared = self.shared.open();
        for (impulse, mean) in shared.impulse.iter_mut().zip(&mean) {
            (0..3).for_each(|k| impulse[k] += dt * mean[k]);
        }
        for mean in &mean {
            (0..2).for_each(|k| shared.external[k] -= dt * mean[k]);
        }
        shared.work += work;
        (shared.now, shared.pushed) = (now, pushed);
        shared.elapsed += dt;
        Ok(())
    }

    fn checkpoint(&mut self) {
        self.checkpoint = Some((self.shared.open().clone(), self.outline.clone()));
    }

    fn restore(&mut self) {
        if let Some((exchanged, outline)) = &self.checkpoint {
            *self.shared.open() = exchanged.clone();
            self.outline = outline.clone();
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
        self.outline = Outline::deformed(loops).ok_or_else(not_finite)?;
        *self.shared.open() = exchanged;
        Ok(())
    }
}

impl Contact for HostBody {
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        self.outline.signed_distance(at)
    }

    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let (found, normal) = self.outline.nearest(at);
        let ends = self.ends(self.elapsed());
        let attachment = self.map.attach_now(found, &ends);
        SurfacePoint { at: found, normal, velocity: self.map.velocity(&attachment, &ends) }
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let (at, impulse) = contact.resultant();
        let ends = self.ends(self.elapsed());
        let attachment = self.map.attach_now(at, &ends);
        let velocity = self.map.velocity(&attachment, &ends);
        let mut shared = self.shared.open();
        self.map.add_loads([(&attachment, impulse)], &ends, &mut shared.impulse);
        for k in 0..2 {
            shared.external[k] -= impulse[k];
            shared.work += impulse[k] * velocity[k];
        }
    }
}

impl Inspect for HostBody {
    fn name(&self) -> &str {
        "host"
    }

    /// The force of the water; the frame is space itself, in which the outline moves.
    fn motion(&self) -> Option<Motion> {
        let shared = self.shared.open();
        let mut total = Motion::default();
        let position = shared.path.at(shared.elapsed).position;
        for (at, [fx, fy, moment]) in position.iter().zip(&shared.now) {
            total.force = [total.force[0] + fx, total.force[1] + fy];
            total.moment += moment + at[0] * fy - at[1] * fx;
        }
        Some(total)
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
    use crate::embed::{HostNodes, Topology};

    /// A contact impulse acts on the nodes next to it, its reaction is an external impulse; a restored state has neither.
    #[test]
    fn a_contact_impulse_acts_on_the_nodes_and_counts_as_external() {
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let topology = Topology::of(corners.clone()).closed(0..4);
        let mut nodes = HostNodes::at_rest(corners);
        nodes.velocity.fill([0.5, -2.0]);
        let shared = Shared::new(Path::resting(&nodes));
        let map = NodeMap::new(&topology, &nodes);
        let rest = topology.outline().expect("a square");
        let mut body = HostBody::new(&topology, rest, map, 0.1, shared.clone());
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
