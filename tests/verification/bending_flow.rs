//! Water by boundary elements about bottoms that bend (THEORY EN51–EN53).

use fsi_coupling::{
    BendingEntry, FlexibleBody, FlexibleSpec, Frame, Outline, PanelEnd, PanelSpec, Plane, PrescribedBody, RigidMotion,
    Shape,
};
use structure_fe::{Damping, Material, Theory};
use water_entry::{BendingWater, FlowEntry, Section, SectionMotion, SimilarityFlow};

const DENSITY: f64 = 1000.0;
const HALF_BREADTH: f64 = 0.3;

/// A wedge of 0.6 m with a panel from keel to chine on each side.
#[derive(Clone, Copy)]
struct Wedge {
    deadrise_deg: f64,
    speed: f64,
    thickness: f64,
    material: Material,
    ends: [PanelEnd; 2],
    /// Mass of the frame [kg/m] of one that falls.
    mass: Option<f64>,
}

impl Wedge {
    fn section(&self) -> Section {
        Section::wedge(self.deadrise_deg, 2.0 * HALF_BREADTH).expect("a wedge")
    }

    fn entry(&self) -> BendingEntry {
        let water = BendingWater::new(&self.section(), 0.0, self.speed, 0.0).expect("a flow");
        let (position, velocity) = ([0.0, -water.draught()], [0.0, -self.speed]);
        let shape = Shape::Wedge { deadrise_deg: self.deadrise_deg, breadth: 2.0 * HALF_BREADTH, side_height: 0.2 };
        let frame = match self.mass {
            Some(mass) => Frame::Free { mass, inertia: 1.0, center_of_mass: [0.0; 2], free: [false, true, false] },
            None => Frame::Given(PrescribedBody::steady(position, 0.0, velocity, 0.0)),
        };
        let panel = PanelSpec {
            name: "face".into(),
            span: [[0.0; 2], [HALF_BREADTH, HALF_BREADTH * self.deadrise_deg.to_radians().tan()]],
            elements: 20,
            mesh: None,
            thickness: self.thickness,
            plane: Plane::Strain,
            material: self.material,
            theory: Theory::EulerBernoulli,
            plasticity: None,
            rupture_strain: None,
            allowable_stress: None,
            ends: self.ends,
            end_springs: Default::default(),
            watch: vec![0.5],
        };
        let body = FlexibleBody::new(FlexibleSpec {
            name: "wedge".into(),
            outline: Outline::of(&shape).expect("an outline"),
            middle: None,
            panels: vec![panel],
            frame,
            start: RigidMotion { position, velocity, ..RigidMotion::default() },
            gravity: [0.0; 2],
            damping: Damping { mass: 0.0, stiffness: 0.0 },
            half: true,
        });
        BendingEntry::new(Box::new(body.expect("a body")), &self.section(), water, DENSITY).expect("an entry")
    }

    /// The draught at which Wagner's width reaches the chines [m].
    fn wet(&self) -> f64 {
        self.section().wagner_draught(HALF_BREADTH)
    }
}

const ALUMINIUM: Material = Material { youngs_modulus: 70e9, poissons_ratio: 0.33, density: 2700.0 };
const STIFF: Material = Material { youngs_modulus: 70e14, ..ALUMINIUM };

/// Panels that hardly bend leave the similar flow as it is.
#[test]
fn stiff_panels_have_the_force_of_the_similar_flow() {
    for deadrise_deg in [20.0, 35.0] {
        let wedge = Wedge {
            deadrise_deg,
            speed: 5.0,
            thickness: 0.02,
            material: STIFF,
            ends: [PanelEnd::Clamped; 2],
            mass: None,
        };
        let exact = SimilarityFlow::solve(deadrise_deg).expect("a flow").force_coefficient;
        let mut entry = wedge.entry();
        let [mut impulse, mut expected] = [0.0; 2];
        while entry.draught() < 0.8 * wedge.wet() {
            let before = entry.draught();
            let dt = entry.step(1.0).expect("a step");
            let force = entry.body().motion().expect("a motion").force[1];
            impulse += dt * force;
            expected += dt * exact * DENSITY * 25.0 * 0.5 * (before + entry.draught());
        }
        let error = impulse / expected - 1.0;
        assert!(error.abs() < 0.01, "{deadrise_deg} degrees: {error:+.4}");
    }
}

/// Such a wedge falls as a rigid one of the same mass.
#[test]
fn a_frame_with_stiff_panels_falls_as_a_rigid_wedge() {
    let wedge = Wedge {
        deadrise_deg: 25.0,
        speed: 5.0,
        thickness: 0.02,
        material: STIFF,
        ends: [PanelEnd::Clamped, PanelEnd::Pinned],
        mass: Some(40.0),
    };
    let mut entry = wedge.entry();
    let momentum = entry.body().momentum().momentum[1];
    let (section, draught) = (wedge.section(), entry.draught());
    let motion = SectionMotion::Free(-momentum / wedge.speed);
    let rigid = FlowEntry { section: &section, motion, draught, speed: wedge.speed, gravity: 0.0, density: DENSITY };
    let (now, ..) = rigid.solve(&[0.0, 0.01, 0.02]).expect("a rigid entry");
    for at in &now[1..] {
        while entry.time() < at.time * (1.0 - 1e-9) {
            entry.step(at.time).expect("a step");
        }
        let speed = -entry.body().motion().expect("a motion").velocity[1];
        assert!((speed - at.speed).abs() < 0.005 * wedge.speed, "{} s: {speed}, {}", at.time, at.speed);
    }
}

/// Thin plates bend by more than their thickness, and light ones have a hundredth of the mass of the water that they move: accelerations and load
/// fit within a few iterations, and the work of the water is what the body lost and the plates hold.
#[test]
fn soft_and_light_panels_keep_the_balance_of_energy() {
    let light = Material { youngs_modulus: 7e9, poissons_ratio: 0.33, density: 100.0 };
    for (name, material, thickness, ends) in [
        ("thin aluminium", ALUMINIUM, 0.003, [PanelEnd::Clamped; 2]),
        ("light", light, 0.008, [PanelEnd::Clamped, PanelEnd::Pinned]),
        ("sliding", ALUMINIUM, 0.005, [PanelEnd::Sliding, PanelEnd::Pinned]),
    ] {
        let wedge = Wedge { deadrise_deg: 20.0, speed: 4.0, thickness, material, ends, mass: Some(40.0) };
        let mut entry = wedge.entry();
        let start = entry.body().energy();
        let (mut steps, mut deepest) = (0, 0.0_f64);
        while entry.draught() < 1.3 * wedge.wet() {
            entry.step(1.0).expect("a step");
            steps += 1;
            deepest = deepest.max(entry.body().panels()[0].watched[0].deflection);
        }
        let end = entry.body().energy();
        let gained = end.kinetic + end.elastic + end.dissipated - start.kinetic - start.elastic;
        assert!(end.work < 0.0 && (gained / end.work - 1.0).abs() < 0.01, "{name}: {gained} J/m of {}", end.work);
        let per_step = entry.iterations() / steps;
        assert!(per_step <= 9 && entry.chines_wet() && deepest > 5e-4, "{name}: {per_step} per step, {deepest} m");
    }
}

/// A section with a round bottom of 1 m of radius, 0.8 m wide, with a panel between clamps on each side.
fn round(thickness: f64, material: Material) -> (Section, BendingEntry) {
    let (radius, half_breadth, speed) = (1.0, 0.4, 4.0);
    let section = Section::arc(radius, 2.0 * half_breadth).expect("an arc");
    let water = BendingWater::new(&section, 0.0, speed, 0.0).expect("water");
    let chine = radius - f64::sqrt(radius * radius - half_breadth * half_breadth);
    let panel = PanelSpec {
        name: "bottom".into(),
        span: [[0.0; 2], [half_breadth, chine]],
        elements: 24,
        mesh: None,
        thickness,
        plane: Plane::Strain,
        material,
        theory: Theory::EulerBernoulli,
        plasticity: None,
        rupture_strain: None,
        allowable_stress: None,
        ends: [PanelEnd::Clamped; 2],
        end_springs: Default::default(),
        watch: vec![0.5],
    };
    let (position, velocity) = ([0.0, -water.draught()], [0.0, -speed]);
    let body = FlexibleBody::new(FlexibleSpec {
        name: "section".into(),
        outline: Outline::of(&Shape::Arc { radius, breadth: 2.0 * half_breadth, side_height: 0.2 })
            .expect("an outline"),
        middle: None,
        panels: vec![panel],
        frame: Frame::Free { mass: 150.0, inertia: 1.0, center_of_mass: [0.0; 2], free: [false, true, false] },
        start: RigidMotion { position, velocity, ..RigidMotion::default() },
        gravity: [0.0; 2],
        damping: Damping { mass: 0.0, stiffness: 0.0 },
        half: true,
    });
    let entry = BendingEntry::new(Box::new(body.expect("a body")), &section, water, DENSITY).expect("an entry");
    (section, entry)
}

/// EN60–EN62: a round bottom that hardly bends falls as a rigid one, through its first contact and the flow after it.
#[test]
fn a_stiff_round_bottom_falls_as_a_rigid_one() {
    let (section, mut entry) = round(0.02, STIFF);
    let mass = -entry.body().momentum().momentum[1] / 4.0;
    let (draught, motion) = (entry.draught(), SectionMotion::Free(mass));
    let rigid = FlowEntry { section: &section, motion, draught: 0.0, speed: 4.0, gravity: 0.0, density: DENSITY };
    let begun = draught / 4.0;
    let times: Vec<f64> = std::iter::once(0.0).chain([0.002, 0.006, 0.012, 0.02].map(|t| t + begun)).collect();
    let (now, ..) = rigid.solve(&times).expect("a rigid entry");
    for at in &now[1..] {
        while entry.time() + begun < at.time * (1.0 - 1e-9) {
            entry.step(at.time - begun).expect("a step");
        }
        let speed = -entry.body().motion().expect("a motion").velocity[1];
        assert!((speed - at.speed).abs() < 0.03, "{} s: {speed}, {}", at.time, at.speed);
    }
}

/// The work of the water on a soft round bottom is what the body lost and the plates hold.
#[test]
fn a_soft_round_bottom_keeps_the_balance_of_energy() {
    let (section, mut entry) = round(0.005, ALUMINIUM);
    let start = entry.body().energy();
    let mut deepest = 0.0_f64;
    while entry.draught() < 1.2 * section.wagner_draught(0.4) {
        entry.step(1.0).expect("a step");
        deepest = deepest.max(entry.body().panels()[0].watched[0].deflection.abs());
    }
    let end = entry.body().energy();
    let gained = end.kinetic + end.elastic + end.dissipated - start.kinetic - start.elastic;
    assert!(end.work < 0.0 && (gained / end.work - 1.0).abs() < 0.01, "{gained} J/m of {}", end.work);
    assert!(entry.chines_wet() && deepest > 5e-4, "{deepest} m");
}
