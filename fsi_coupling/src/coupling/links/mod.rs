//! Links: contact and joints between bodies (THEORY CO36–CO38).
//!
//! A step has two halves. In the first, bodies are kicked by the reactions that make accelerations admissible; each body drifts. At the end,
//! impulses make velocities admissible: they are the reactions' second half. Each reaction and each impulse acts on both bodies at one point
//! with opposite signs: momentum and angular momentum are conserved to rounding.

pub mod joint;
mod rows;
#[cfg(test)]
mod tests;
mod touch;

use serde::{Deserialize, Serialize};

use sph_core::state_bytes::{StateError, expect_count};
use sph_core::walls::Resultant;

use self::joint::{Constraint, Joint, JointSpec, JointState, Memory};
use self::rows::{Bound, Direction, Row, energy_gained, multipliers, without_gain};
use self::touch::{Touch, touches};
use crate::bodies::state::Solid;
use crate::coupling::error::CouplingError;
use crate::coupling::placed_bodies::Member;

/// Share of a joint's gap that its velocity closes per step [-].
const CLOSING: f64 = 0.1;
/// Approach that bounces, over the velocity that the relative acceleration makes in a step [-]: below it bodies rest on each other.
const BOUNCES: f64 = 10.0;

/// How solids that touch push each other (THEORY CO37).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactLaw {
    /// Coefficient of friction [-].
    pub friction: f64,
    /// Coefficient of restitution: normal speed after over that before an impact [-].
    pub restitution: f64,
    /// Distance at which surfaces touch [m]: room for a film of two layers of particles, the thinnest that holds the water's pressure.
    pub gap: f64,
}

/// How two bodies have touched so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TouchRecord {
    /// Names of the bodies.
    pub bodies: [String; 2],
    /// When they first touched [s].
    pub first: f64,
    /// Where [m].
    pub at: [f64; 2],
    /// Magnitude of the impulses of all contacts so far [N s/m].
    pub impulse: f64,
    /// Largest depth behind the distance of touch [m].
    pub deepest: f64,
}

/// Contact and joints of a system.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    law: ContactLaw,
    joints: Vec<Joint>,
    touched: Vec<TouchRecord>,
    /// Normal reactions of contacts that act now, with the index of their record [N/m].
    pressing: Vec<(usize, f64)>,
}

/// What [`Links`] keep from step to step.
pub(super) type LinksMemory = (Vec<Memory>, Vec<TouchRecord>, Vec<(usize, f64)>);

impl Links {
    /// Links of bodies where they are now, with reactions for the first step.
    pub fn new(law: ContactLaw, joints: Vec<JointSpec>, members: &mut [Member]) -> Result<Links, CouplingError> {
        let solids = solids(members);
        let mut built = Vec::new();
        for spec in joints {
            if let Some(&k) = spec.bodies.iter().find(|k| solids[**k].is_none()) {
                let body = members[k].body.name().to_string();
                return Err(CouplingError::Joint { joint: spec.name, body });
            }
            built.push(Joint::new(spec, &rigid(&solids)));
        }
        let mut links = Links { law, joints: built, ..Links::default() };
        if !links.joints.is_empty() {
            links.set_reactions(members, &[], f64::INFINITY);
        }
        Ok(links)
    }

    /// CO36: after the bodies' advance by `dt` [s] to `time` [s], impulses and reactions of joints and contacts.
    pub fn hold(&mut self, members: &mut [Member], tolerance: f64, dt: f64, time: f64) -> Result<(), CouplingError> {
        let solids = solids(members);
        let holding =
            |a, b| self.joints.iter().any(|j| j.holds() && (j.spec.bodies == [a, b] || j.spec.bodies == [b, a]));
        let touches = touches(members, &solids, [self.law.gap, tolerance], time, holding)?;
        if touches.is_empty() && self.joints.is_empty() && self.pressing.is_empty() {
            return Ok(());
        }
        self.kick_by_springs(members, dt);
        let impulses = self.apply_impulses(members, &touches, dt);
        let records = self.record(members, &touches, &impulses, dt, time);
        let forces = self.set_reactions(members, &touches, dt);
        self.pressing = records.into_iter().zip(forces).collect();
        Ok(())
    }

    /// CO38: the second half of the step under the springs' forces.
    fn kick_by_springs(&mut self, members: &mut [Member], dt: f64) {
        let all = rigid(&solids(members));
        for joint in self.joints.iter_mut().filter(|joint| joint.holds()) {
            let (forces, value) = joint.spring(&all);
            joint.memory.value = value;
            for (solid, force) in joint.spec.bodies.into_iter().zip(forces) {
                apply(members, &all, solid, (0.5 * dt) * force);
            }
            joint.memory.spring = [0, 1].map(|k| joint.memory.spring[k] + forces[k]);
        }
    }

    /// CO36: impulses that make velocities admissible; the multipliers, joints first, in the order of [`Links::rows`].
    fn apply_impulses(&mut self, members: &mut [Member], touches: &[Touch], dt: f64) -> Vec<f64> {
        let all = rigid(&solids(members));
        let (rows, constraints) = self.rows(touches, &all);
        let bounces = |row: &Row, speed: f64| {
            row.bound == Bound::Push && speed < -BOUNCES * dt * row.direction.acceleration(&all).abs()
        };
        let speeds: Vec<f64> = rows.iter().map(|row| row.direction.speed(&all)).collect();
        let after = |restitution: f64| {
            let wanted = |(k, (row, speed)): (usize, (&Row, &f64))| match bounces(row, *speed) {
                true => (1.0 + restitution) * speed,
                false => speed + constraints.get(k).map_or(0.0, |held| CLOSING * held.error / dt),
            };
            let free: Vec<f64> = rows.iter().zip(&speeds).enumerate().map(wanted).collect();
            multipliers(&rows, &all, &free)
        };
        let mut found = after(self.law.restitution);
        if self.law.restitution > 0.0 && energy_gained(&rows, &all, &speeds, &found) > 0.0 {
            found = without_gain(&rows, &all, &speeds, [&after(0.0), &found]);
        }
        let mut whole = vec![Resultant::default(); members.len()];
        for (row, impulse) in rows.iter().zip(&found) {
            for (solid, impulse) in row.direction.solids.into_iter().zip(row.direction.resultants(*impulse)) {
                whole[solid] = whole[solid] + impulse;
            }
        }
        whole.into_iter().enumerate().for_each(|(solid, impulse)| apply(members, &all, solid, impulse));
        found
    }

    /// CO36: reactions of joints, springs and contacts from now on, by which accelerations are admissible; normal ones of the touches.
    fn set_reactions(&mut self, members: &mut [Member], touches: &[Touch], dt: f64) -> Vec<f64> {
        let before = rigid(&solids(members));
        let mut loads = vec![Resultant::default(); members.len()];
        let mut all = before.clone();
        for joint in self.joints.iter_mut().filter(|joint| joint.holds()) {
            let (spring, value) = joint.spring(&before);
            (joint.memory.spring, joint.memory.value) = (spring, value);
            for (solid, force) in joint.spec.bodies.into_iter().zip(spring) {
                loads[solid] = loads[solid] + force;
                all[solid].accelerate(force);
            }
        }
        let (rows, constraints) = self.rows(touches, &all);
        let free: Vec<f64> = rows
            .iter()
            .enumerate()
            .map(|(k, row)| {
                let apparent = constraints.get(k).map_or(0.0, |held| held.apparent);
                row.direction.acceleration(&all) + apparent + row.direction.speed(&all) / dt
            })
            .collect();
        let found = multipliers(&rows, &all, &free);
        let pushes = rows.iter().zip(&found).filter(|(row, _)| row.bound == Bound::Push);
        let normal = pushes.map(|(row, force)| all[row.direction.solids[1]].halves * force).collect();
        let mut rows = rows.iter().zip(&found).map(|(row, force)| (row.direction, row.direction.resultants(*force)));
        for joint in self.joints.iter_mut().filter(|joint| joint.holds()) {
            joint.memory.reaction = [Resultant::default(); 2];
            for (_, forces) in rows.by_ref().take(joint.held()) {
                for ((solid, force), kept) in joint.spec.bodies.into_iter().zip(forces).zip(&mut joint.memory.reaction)
                {
                    loads[solid] = loads[solid] + force;
                    *kept = *kept + force;
                }
            }
        }
        for (direction, forces) in rows {
            for (solid, force) in direction.solids.into_iter().zip(forces) {
                loads[solid] = loads[solid] + force;
            }
        }
        for ((member, load), solid) in members.iter_mut().zip(loads).zip(&before) {
            member.body.set_reaction(solid.whole(load));
        }
        normal
    }

    /// Rows of the joints that hold, then of the touches, each with its normal direction and its friction; and what the joints hold.
    fn rows(&self, touches: &[Touch], all: &[Solid]) -> (Vec<Row>, Vec<Constraint>) {
        let held: Vec<Constraint> =
            self.joints.iter().filter(|joint| joint.holds()).flat_map(|joint| joint.constraints(all)).collect();
        let mut rows: Vec<Row> =
            held.iter().map(|held| Row { direction: held.direction, bound: Bound::Both }).collect();
        for Touch { solids, at, normal, .. } in touches {
            let along = |unit| Direction::between(*solids, all, *at, unit);
            let bound = Bound::Friction { normal: rows.len(), coefficient: self.law.friction };
            rows.push(Row { direction: along(*normal), bound: Bound::Push });
            if self.law.friction > 0.0 {
                rows.push(Row { direction: along([-normal[1], normal[0]]), bound });
            }
        }
        (rows, held)
    }

    /// Keep what the step has done: forces of joints, which may break, and contacts; the record of each touch.
    fn record(&mut self, members: &[Member], touches: &[Touch], impulses: &[f64], dt: f64, time: f64) -> Vec<usize> {
        let all = rigid(&solids(members));
        let mut impulses = impulses.iter();
        for joint in self.joints.iter_mut().filter(|joint| joint.holds()) {
            let constraints = joint.constraints(&all);
            let mut force = (0.5 * (joint.memory.reaction[1] + joint.memory.spring[1])).force;
            for (held, impulse) in constraints.iter().zip(impulses.by_ref().take(constraints.len())) {
                let [_, on_b] = held.direction.resultants(impulse / dt);
                force = [force[0] + on_b.force[0], force[1] + on_b.force[1]];
            }
            let Memory { value, largest, .. } = joint.memory;
            let largest = largest.max(force[0].hypot(force[1]));
            (joint.memory.force, joint.memory.largest) = (force, largest);
            if joint.spec.breaks_at.is_some_and(|limit| largest > limit) {
                joint.memory = Memory { force, largest, value, broken: Some(time), ..Memory::default() };
            }
        }
        for (record, force) in &self.pressing {
            self.touched[*record].impulse += 0.5 * dt * force;
        }
        let (rows_per_touch, mut records) = (if self.law.friction > 0.0 { 2 } else { 1 }, Vec::new());
        for (touch, impulse) in touches.iter().zip(impulses.step_by(rows_per_touch)) {
            let [a, b] = touch.solids.map(|k| members[k].body.name());
            let known = self.touched.iter().position(|t| t.bodies == [a, b] || t.bodies == [b, a]);
            let known = known.unwrap_or_else(|| {
                let bodies = [a.to_string(), b.to_string()];
                self.touched.push(TouchRecord { bodies, first: time, at: touch.at, ..TouchRecord::default() });
                self.touched.len() - 1
            });
            let record = &mut self.touched[known];
            record.impulse += all[touch.solids[1]].halves * impulse;
            record.deepest = record.deepest.max(touch.depth);
            records.push(known);
        }
        records
    }

    /// Energy of all springs [J/m].
    pub fn elastic(&self) -> f64 {
        self.joints.iter().map(Joint::elastic).sum()
    }

    /// Largest step at which the springs are stable [s].
    pub fn stable_dt(&self, members: &[Member]) -> f64 {
        if self.joints.is_empty() {
            return f64::INFINITY;
        }
        let all = rigid(&solids(members));
        self.joints.iter().filter(|joint| joint.holds()).map(|j| j.stable_dt(&all)).fold(f64::INFINITY, f64::min)
    }

    /// States of the joints, in the order they were given.
    pub fn joints(&self) -> Vec<JointState> {
        self.joints.iter().map(Joint::state).collect()
    }

    /// Which bodies have touched, in the order in which they first did.
    pub fn touched(&self) -> &[TouchRecord] {
        &self.touched
    }

    pub fn memory(&self) -> LinksMemory {
        (self.joints.iter().map(|joint| joint.memory).collect(), self.touched.clone(), self.pressing.clone())
    }

    pub fn set_memory(&mut self, (joints, touched, pressing): LinksMemory) -> Result<(), StateError> {
        expect_count("joints", joints.len(), self.joints.len())?;
        self.joints.iter_mut().zip(joints).for_each(|(joint, memory)| joint.memory = memory);
        (self.touched, self.pressing) = (touched, pressing);
        Ok(())
    }
}

fn solids(members: &[Member]) -> Vec<Option<Solid>> {
    members.iter().map(|m| m.body.solid()).collect()
}

/// The solids; one that links cannot hold stands as one at rest that no row names.
fn rigid(solids: &[Option<Solid>]) -> Vec<Solid> {
    solids.iter().map(|solid| solid.unwrap_or_default()).collect()
}

fn apply(members: &mut [Member], all: &[Solid], solid: usize, impulse: Resultant) {
    members[solid].body.apply_link_impulse(all[solid].whole(impulse));
}
