//! Links of dry bodies against mechanics: pendulum, impacts, sprung masses, friction.

use super::joint::{JointKind, JointSpec};
use super::*;
use crate::bodies::body::Body;
use crate::bodies::prescribed::PrescribedBody;
use crate::bodies::rigid::RigidBody2d;
use crate::bodies::rigid_spec::RigidSpec;
use crate::coupling::placed_bodies::WorkAudit;
use crate::geometry::outline::Outline;

const DT: f64 = 1e-4;
const G: f64 = 9.81;

fn rectangle(breadth: f64, height: f64) -> Outline {
    let (x, y) = (0.5 * breadth, 0.5 * height);
    Outline::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]]).expect("a rectangle")
}

fn box_at(position: [f64; 2], velocity: [f64; 2], mass: f64, gravity: f64) -> RigidSpec {
    RigidSpec {
        name: "box".into(),
        outline: rectangle(1.0, 0.5),
        mass,
        inertia: mass * (1.0 + 0.25) / 12.0,
        center_of_mass: [0.0; 2],
        free: [true; 3],
        position,
        angle: 0.0,
        velocity,
        angular_velocity: 0.0,
        gravity: [0.0, -gravity],
        half: false,
        sprung: Vec::new(),
    }
}

fn member(body: Box<dyn Body>) -> Member {
    Member { body, range: 0..0, plates: 0..0, work: WorkAudit::default() }
}

fn free(spec: RigidSpec) -> Member {
    member(Box::new(RigidBody2d::new(spec).expect("a body")))
}

fn fixed(at: [f64; 2], outline: Outline) -> Member {
    member(Box::new(PrescribedBody::new("wall", outline, false, PrescribedBody::steady(at, 0.0, [0.0; 2], 0.0))))
}

/// Bodies with links, without water.
struct Dry {
    members: Vec<Member>,
    links: Links,
    time: f64,
}

impl Dry {
    fn new(mut members: Vec<Member>, law: ContactLaw, joints: Vec<JointSpec>) -> Dry {
        let links = Links::new(law, joints, &mut members).expect("rigid bodies");
        Dry { members, links, time: 0.0 }
    }

    fn step(&mut self, dt: f64) {
        self.members.iter_mut().for_each(|m| m.body.advance(dt).expect("a step"));
        self.time += dt;
        self.links.hold(&mut self.members, 1e-6, dt, self.time).expect("contact of rigid bodies");
    }

    fn run(&mut self, end: f64, mut seen: impl FnMut(&Dry)) {
        while self.time < end {
            self.step(DT);
            seen(self);
        }
    }

    fn body(&self, k: usize) -> &dyn Body {
        self.members[k].body.as_ref()
    }

    fn energy(&self) -> f64 {
        let of = |m: &Member| {
            let e = m.body.energy();
            e.kinetic + e.potential
        };
        self.members.iter().map(of).sum::<f64>() + self.links.elastic()
    }

    /// Linear momentum, and angular momentum about the origin, of boxes of these moments of inertia.
    fn momentum(&self, masses: &[[f64; 2]]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (k, [mass, inertia]) in masses.iter().enumerate() {
            let m = self.body(k).motion().expect("a box");
            let [u, v] = m.velocity;
            sum[0] += mass * u;
            sum[1] += mass * v;
            sum[2] += mass * (m.position[0] * v - m.position[1] * u) + inertia * m.angular_velocity;
        }
        sum
    }
}

fn joint(kind: JointKind, at: [f64; 2], bodies: [usize; 2]) -> JointSpec {
    JointSpec { name: "joint".into(), bodies, at, kind, stiffness: 0.0, damping: 0.0, breaks_at: None }
}

/// A compound pendulum of length l and radius of gyration k, from the horizontal: T = 4 K(1/√2) √((l² + k²)/(g l)), K = 1.854 074 677 3.
#[test]
fn a_hinged_box_is_a_pendulum() {
    let spec = box_at([0.5, 0.0], [0.0; 2], 2.0, G);
    let (l, gyration2) = (0.5, spec.inertia / spec.mass);
    let exact = 4.0 * 1.854_074_677_301 * ((l * l + gyration2) / (G * l)).sqrt();
    let hinge = joint(JointKind::Hinge, [0.0; 2], [1, 0]);
    let mut dry = Dry::new(vec![free(spec), fixed([0.0; 2], rectangle(0.1, 0.1))], ContactLaw::default(), vec![hinge]);
    let (mut lowest, mut drift, mut apart, mut returns) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
    let mut gap = 0.0_f64;
    let mut last = 0.0;
    dry.run(1.02 * exact, |dry| {
        let m = dry.body(0).motion().expect("a box");
        lowest = lowest.min(m.angle);
        drift = drift.max(dry.energy().abs());
        let e = dry.body(0).energy();
        gap = gap.max((e.kinetic + e.potential - e.links).abs());
        let end = m.point([-0.5, 0.0]);
        apart = apart.max(end[0].hypot(end[1]));
        if last < 0.0 && m.angular_velocity >= 0.0 || last > 0.0 && m.angular_velocity <= 0.0 {
            returns.push(dry.time);
        }
        last = m.angular_velocity;
    });
    assert!((lowest + std::f64::consts::PI).abs() < 1e-3, "swings through {lowest} rad");
    assert!(drift < 1e-5 * 2.0 * G * l, "energy drifts by {drift} J");
    assert!(gap < 1e-3 * 2.0 * G * l, "work of the hinge is off by {gap} J");
    assert!(apart < 1e-6, "the hinge opens by {apart} m");
    let period = returns[1];
    assert!((period / exact - 1.0).abs() < 2e-4, "period {period} s, exact {exact} s, returns {returns:?}");
    // at the start the reaction of the hinge is that of a rod let go: m g k²/(l² + k²) upwards
    assert!(dry.links.joints()[0].broken.is_none());
}

/// Two boxes that meet off centre: momentum and angular momentum stay, energy is lost and never gained.
#[test]
fn boxes_that_collide_keep_their_momentum() {
    let masses = [[2.0, 2.0 * 1.25 / 12.0], [3.0, 3.0 * 1.25 / 12.0]];
    for law in [
        ContactLaw::default(),
        ContactLaw { friction: 0.3, ..ContactLaw::default() },
        ContactLaw { restitution: 0.7, ..ContactLaw::default() },
    ] {
        let a = free(box_at([-0.7, 0.1], [1.0, 0.1], 2.0, 0.0));
        let b = free(RigidSpec { name: "other".into(), ..box_at([0.7, -0.05], [-0.5, 0.0], 3.0, 0.0) });
        let mut dry = Dry::new(vec![a, b], law, Vec::new());
        let (before, mut energy) = (dry.momentum(&masses), dry.energy());
        let begun = energy;
        dry.run(1.5, |dry| {
            assert!(dry.energy() <= energy + 1e-13, "energy from nowhere at t = {} s: {law:?}", dry.time);
            energy = dry.energy();
        });
        let after = dry.momentum(&masses);
        (0..3).for_each(|k| assert!((after[k] - before[k]).abs() < 1e-12, "{before:?} {after:?}"));
        assert!(energy < 0.9 * begun, "{energy} of {begun} J left");
        assert_eq!(dry.links.touched().len(), 1);
        assert!(dry.links.touched()[0].impulse > 1.0);
    }
}

/// A head-on impact: relative velocity is reversed by e, as in Newton's law.
#[test]
fn restitution_is_newtons() {
    let a = free(box_at([-0.7, 0.0], [1.0, 0.0], 2.0, 0.0));
    let b = free(RigidSpec { name: "other".into(), ..box_at([0.7, 0.0], [-0.5, 0.0], 3.0, 0.0) });
    let mut dry = Dry::new(vec![a, b], ContactLaw { restitution: 0.6, ..ContactLaw::default() }, Vec::new());
    dry.run(0.6, |_| {});
    let [u, v] = [0, 1].map(|k| dry.body(k).motion().expect("a box").velocity[0]);
    assert!((v - u - 0.6 * 1.5).abs() < 1e-12, "{u} {v}");
    assert!((2.0 * u + 3.0 * v - 0.5).abs() < 1e-12);
}

/// A box in free fall that bounces with friction: 50 of any angle, spin, speed, restitution up to 1 and friction up to 2. Newton's law with
/// Coulomb's would give some of them up to a fifth of their energy (Kane and Levinson 1985; Stronge 1990).
#[test]
fn bounces_with_friction_never_gain_energy() {
    let mut seed = 1_u64;
    let mut random = |from: f64, to: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut least_kept = f64::INFINITY;
    for drop in 0..50 {
        let law = match drop % 5 {
            0 => ContactLaw { restitution: 1.0, friction: 2.0, gap: 0.0 },
            _ => ContactLaw { restitution: random(0.2, 1.0), friction: random(0.0, 2.0), gap: 0.0 },
        };
        let spec = RigidSpec {
            angle: random(-3.0, 3.0),
            angular_velocity: random(-6.0, 6.0),
            ..box_at([0.0, random(0.6, 0.9)], [random(-3.0, 3.0), random(-3.0, 0.0)], 2.0, G)
        };
        let mut dry = Dry::new(vec![free(spec), fixed([0.0, -0.5], rectangle(40.0, 1.0))], law, Vec::new());
        let begun = dry.energy();
        let mut energy = begun;
        dry.run(0.8, |dry| {
            let now = dry.energy();
            assert!(now <= energy + 1e-7 * begun, "drop {drop}: {} J/m from nowhere, {law:?}", now - energy);
            energy = now;
        });
        assert!(energy <= begun * (1.0 + 1e-9), "drop {drop}: {energy} of {begun} J/m, {law:?}");
        least_kept = least_kept.min(energy / begun);
    }
    assert!(least_kept < 0.9, "nothing bounced");
}

/// A box of restitution 1 without friction, and one that does not turn with it: their bounce is Newton's.
#[test]
fn a_bounce_that_gains_nothing_is_newtons() {
    for friction in [0.0, 2.0] {
        let spec = RigidSpec { free: [true, true, false], ..box_at([0.0, 0.3], [0.0, -2.0], 2.0, 0.0) };
        let law = ContactLaw { restitution: 1.0, friction, gap: 0.0 };
        let mut dry = Dry::new(vec![free(spec), fixed([0.0, -0.5], rectangle(40.0, 1.0))], law, Vec::new());
        dry.run(0.1, |_| {});
        let [u, v] = dry.body(0).motion().expect("a box").velocity;
        assert!(u.abs() < 1e-12 && (v - 2.0).abs() < 1e-12, "{u} {v}");
    }
}

fn open_tank() -> Member {
    use crate::geometry::layout::{Basin, Layout};
    let basin =
        Basin { x: [-2.0, 2.0], y: [-1.0, 0.0], fine_x: [-2.0, 2.0], fine_depth: 1.0, spacing: 0.1, growth: 1.0 };
    let mut tank = crate::bodies::tank::Tank::new(Layout::new(basin), [-2.0, 2.0], -1.0, 0.5, false);
    let rows = crate::geometry::rows::WallRows::filled(0.1, 4);
    crate::bodies::body::WettedBody::sample(&mut tank, &rows).expect("a tank");
    member(Box::new(tank))
}

/// Walls end at the rim: a box above it flies over, one below it is stopped, one that falls on the rim lies on it, across the wall.
#[test]
fn a_wall_of_the_tank_ends_at_its_rim() {
    let law = ContactLaw { friction: 1.0, ..ContactLaw::default() };
    let after = |at: [f64; 2], velocity: [f64; 2], gravity: f64, end: f64| {
        let mut dry = Dry::new(vec![free(box_at(at, velocity, 2.0, gravity)), open_tank()], law, Vec::new());
        dry.run(end, |_| {});
        dry.body(0).motion().expect("a box")
    };
    let over = after([0.0, 1.5], [4.0, 0.0], 0.0, 1.0);
    assert!((over.position[0] - 4.0).abs() < 1e-3 && over.velocity == [4.0, 0.0], "{over:?}");
    let under = after([0.0, 0.0], [4.0, 0.0], 0.0, 1.0);
    assert!((under.position[0] - 1.5).abs() < 1e-3, "stopped with its side at the wall: {under:?}");
    let on = after([2.2, 0.9], [0.0; 2], G, 1.0);
    assert!((on.position[1] - 0.75).abs() < 1e-3 && on.angle.abs() < 1e-3, "on the rim: {on:?}");
}

/// A tilted box falls on a floor and comes to rest on its bottom under its weight within the fall of one step.
#[test]
fn a_box_that_falls_on_a_floor_lies_there() {
    let spec = RigidSpec { angle: 0.2, ..box_at([0.0, 0.8], [0.0; 2], 2.0, G) };
    let floor = fixed([0.0, -0.5], rectangle(20.0, 1.0));
    let mut dry = Dry::new(vec![free(spec), floor], ContactLaw { friction: 0.5, ..ContactLaw::default() }, Vec::new());
    let mut energy = dry.energy();
    dry.run(4.0, |dry| {
        assert!(dry.energy() <= energy + 1e-9, "energy from nowhere at t = {} s", dry.time);
        energy = dry.energy();
    });
    let m = dry.body(0).motion().expect("a box");
    assert!((m.position[1] - 0.25).abs() < 5e-4, "height {}", m.position[1]);
    assert!(m.angle.abs() < 1e-3 && m.velocity[1].abs() < 1e-9 && m.angular_velocity.abs() < 1e-9, "{m:?}");
    assert!(m.acceleration[1].abs() < 1e-9, "a box at rest does not accelerate: {:?}", m.acceleration);
    let external = dry.body(0).momentum().external[1] + dry.body(1).momentum().external[1];
    let momentum = dry.body(0).momentum().momentum[1];
    assert!((momentum - external).abs() < 1e-10, "momentum {momentum}, external impulses {external}");
}

/// Two masses on a slider with a spring vibrate at √(k (1/m₁ + 1/m₂)).
#[test]
fn a_slider_with_a_spring_vibrates_at_its_frequency() {
    let stiffness = 500.0;
    let omega = (stiffness * (1.0 / 2.0 + 1.0 / 3.0_f64)).sqrt();
    let axis = JointKind::Slider { axis: [0.0, 1.0] };
    for kind in [axis, JointKind::Spring { to: [0.0, 1.5] }] {
        let a = free(box_at([0.0, 0.0], [0.0; 2], 2.0, 0.0));
        let b = free(RigidSpec { name: "other".into(), ..box_at([0.0, 1.5], [0.0, 0.4], 3.0, 0.0) });
        let spec = JointSpec { stiffness, ..joint(kind, [0.0, 0.0], [0, 1]) };
        let mut dry = Dry::new(vec![a, b], ContactLaw::default(), vec![spec]);
        let begun = dry.energy();
        let (mut drift, mut crossings, mut last) = (0.0_f64, Vec::new(), 0.0);
        dry.run(0.5, |dry| {
            drift = drift.max((dry.energy() - begun).abs());
            let value = dry.links.joints()[0].value;
            if last < 0.0 && value >= 0.0 {
                crossings.push(dry.time - DT * value / (value - last));
            }
            last = value;
        });
        let exact = std::f64::consts::TAU / omega;
        assert!((crossings[0] / exact - 1.0).abs() < 1e-4, "{kind:?}: {crossings:?}, exact {exact}");
        assert!(drift < 1e-5 * begun, "{kind:?}: energy drifts by {drift} of {begun} J");
    }
}

/// A joint breaks at its load, and its bodies part: a box on a rope of 2 kg · g = 19.62 N/m.
#[test]
fn a_joint_breaks_at_its_load() {
    for (limit, holds) in [(19.0, false), (20.0, true)] {
        let spec = JointSpec { breaks_at: Some(limit), ..joint(JointKind::Hinge, [0.0, 0.25], [1, 0]) };
        let members = vec![free(box_at([0.0; 2], [0.0; 2], 2.0, G)), fixed([0.0, 5.0], rectangle(0.1, 0.1))];
        let mut dry = Dry::new(members, ContactLaw::default(), vec![spec]);
        dry.run(0.1, |_| {});
        let state = &dry.links.joints()[0];
        assert_eq!(state.broken.is_none(), holds, "{state:?}");
        assert!((state.force[1] - 2.0 * G).abs() < 1e-6, "{state:?}");
        let fallen = -dry.body(0).motion().expect("a box").position[1];
        assert_eq!(fallen < 1e-6, holds, "fell {fallen} m");
    }
}
