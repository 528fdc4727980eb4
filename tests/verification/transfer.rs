//! One operator H carries motion from a body to its boundary particles, its transpose carries forces back
//! (THEORY CO2). The same three tests for every body.

use evidence::load::Handled;
use evidence::statistics::Noise;
use fsi_coupling::RigidMotion;
use fsi_coupling::geometry::layout::{Basin, Layout};
use fsi_coupling::{Body, Outline, PrescribedBody, RigidBody2d, RigidSpec, Shape, Tank};

/// Spacing of the boundary particles [m].
const SPACING: f64 = 0.05;
/// Largest extent of the bodies below, in the frame they stand in [m]: what rounding is relative to.
const SIZE: f64 = 10.0;

/// A body, and whether only its half x > 0 is simulated.
struct Case {
    what: &'static str,
    half: bool,
    body: Box<dyn Body>,
}

/// A rapier body of mass 7 kg/m; where `half`, upright on the plane of symmetry and free to heave only.
fn rigid(outline: &Outline, half: bool) -> Box<dyn Body> {
    let spec = RigidSpec {
        name: "free".into(),
        outline: outline.clone(),
        mass: 7.0,
        inertia: 1.3,
        center_of_mass: [if half { 0.0 } else { 0.13 }, 0.21],
        sprung: Vec::new(),
        free: [!half, true, !half],
        position: [if half { 0.0 } else { 3.0 }, -6.0],
        angle: if half { 0.0 } else { 0.7 },
        velocity: [if half { 0.0 } else { 1.4 }, -2.3],
        angular_velocity: if half { 0.0 } else { 0.9 },
        gravity: [0.0, -9.81],
        half,
    };
    Box::new(RigidBody2d::new(spec).expect("a sound body"))
}

/// A body whose law has every derivative; where `half`, upright and heaving only.
fn prescribed(outline: &Outline, half: bool) -> Box<dyn Body> {
    let share = if half { 0.0 } else { 1.0 };
    let law = move |t: f64| {
        let (sin, cos) = (3.0 * t + 0.4).sin_cos();
        RigidMotion {
            position: [share * (3.0 + 0.5 * sin), -6.0 + 0.2 * cos],
            angle: share * (0.7 + 0.3 * sin),
            velocity: [share * 1.5 * cos, -0.6 * sin],
            angular_velocity: share * 0.9 * cos,
            acceleration: [-share * 4.5 * sin, -1.8 * cos],
            angular_acceleration: -share * 2.7 * sin,
        }
    };
    Box::new(PrescribedBody::new("given", outline.clone(), half, Box::new(law)))
}

fn tank(half: bool) -> Box<dyn Body> {
    let left = if half { 0.0 } else { -1.0 };
    let (x, y) = ([left, 1.0], [-1.0, 0.0]);
    let layout = Layout::new(Basin { x, y, fine_x: [left, 0.2], fine_depth: 0.2, spacing: SPACING, growth: 1.1 });
    Box::new(Tank::new(layout, x, -1.0, 0.25, half))
}

/// Every body there is, whole and half.
fn cases() -> Vec<Case> {
    let wedge = Outline::of(&Shape::Wedge { deadrise_deg: 25.0, breadth: 1.0, side_height: 0.3 }).expect("a wedge");
    let hull = |x: f64| vec![[x, 0.0], [x + 0.4, 0.0], [x + 0.4, 0.5], [x, 0.5]];
    let hulls = Outline::compound(&[hull(-0.7), hull(0.3)]).expect("two hulls");
    let case = |what, half, body| Case { what, half, body };
    vec![
        case("rapier body", false, rigid(&wedge, false)),
        case("rapier body of two hulls", false, rigid(&hulls, false)),
        case("half a rapier body", true, rigid(&wedge, true)),
        case("prescribed body", false, prescribed(&wedge, false)),
        case("half a prescribed body", true, prescribed(&wedge, true)),
        case("tank", false, tank(false)),
        case("half a tank", true, tank(true)),
    ]
}

/// Distances of all particles from the first and from the middle one, which fix a rigid shape [m].
fn distances(handled: &Handled) -> Vec<f64> {
    let w = &handled.walls;
    let from = |a: usize| (0..w.len()).map(move |b| (w.x[a] - w.x[b]).hypot(w.y[a] - w.y[b]));
    from(0).chain(from(w.len() / 2)).collect()
}

/// Rigid motion keeps all distances, whatever the load: 1e-13 of the distance from the frame's origin.
#[test]
fn rigid_motion_moves_boundary_particles_rigidly() {
    for Case { what, half, mut body } in cases() {
        let mut handled = Handled::new(body.as_mut(), SPACING, half);
        let (before, mut noise) = (distances(&handled), Noise::new(11));
        assert!(before.len() > 50, "{what}: {} distances", before.len());
        let forces: Vec<[f64; 2]> = (0..handled.walls.len()).map(|_| [noise.draw(), noise.draw()]).collect();
        for _ in 0..20 {
            handled.step(body.as_mut(), 0.01, |k, _| forces[k]);
            for (old, new) in before.iter().zip(distances(&handled)) {
                assert!((old - new).abs() < 1e-13 * SIZE, "{what}: a distance of {old} m became {new} m");
            }
        }
    }
}

/// Work is conserved across the interface: Σ f·(H q̇) = (Hᵀ f)·q̇ for any forces f and the body's motion q̇, in a
/// turned and shifted frame too. Half a body stands for both: twice the right half's power.
#[test]
fn the_power_of_any_load_is_the_same_on_both_sides_of_the_interface() {
    let mut noise = Noise::new(5);
    for Case { what, half, mut body } in cases() {
        let mut handled = Handled::new(body.as_mut(), SPACING, half);
        for _ in 0..10 {
            let forces: Vec<[f64; 2]> = (0..handled.walls.len()).map(|_| [noise.draw(), noise.draw()]).collect();
            handled.start(body.as_mut(), |k, _| forces[k]);
            let (w, motion) = (&handled.walls, body.motion().unwrap_or_default());
            let pairs = (0..w.len()).map(|k| [w.fx[k] * w.u[k], w.fy[k] * w.v[k]]);
            let halves = if half { 2.0 } else { 1.0 };
            let at_particles = halves * pairs.clone().map(|p| p[0] + p[1]).sum::<f64>();
            let scale = halves * pairs.map(|p| p[0].abs() + p[1].abs()).sum::<f64>();
            let of_body = motion.force[0] * motion.velocity[0]
                + motion.force[1] * motion.velocity[1]
                + motion.moment * motion.angular_velocity;
            let gap = (at_particles - of_body).abs();
            assert!(gap <= 1e-13 * scale, "{what}: {at_particles} W/m at the particles, {of_body} W/m at the body");
            assert!((scale > 0.0) == body.motion().is_some(), "{what}: only a tank does not move");
            body.advance(0.01).expect("the motion stays finite");
        }
    }
}

/// Largest distance between where a body says its particles will be after `dt` and where they are then [m].
fn placement_error(mut body: Box<dyn Body>, half: bool, dt: f64) -> f64 {
    let mut handled = Handled::new(body.as_mut(), SPACING, half);
    let mut noise = Noise::new(3);
    let forces: Vec<[f64; 2]> = (0..handled.walls.len()).map(|_| [noise.draw(), noise.draw()]).collect();
    handled.start(body.as_mut(), |k, _| forces[k]);
    handled.place(body.as_ref(), dt);
    let promised = (handled.walls.x.clone(), handled.walls.y.clone());
    handled.step(body.as_mut(), dt, |k, _| forces[k]);
    handled.place(body.as_ref(), 0.0);
    let gap = |k: usize| (handled.walls.x[k] - promised.0[k]).hypot(handled.walls.y[k] - promised.1[k]);
    (0..handled.walls.len()).map(gap).fold(0.0, f64::max)
}

/// The motion of `kinematics(dt)` is that of `advance(dt)` to O(dt³): halving the step divides the gap by eight (the test
/// requires six), unless it is rounding already.
#[test]
fn a_body_is_where_it_was_predicted_to_third_order() {
    let rounding = 1e-13 * SIZE;
    for k in 0..cases().len() {
        let error = |dt: f64| {
            let Case { half, body, .. } = cases().swap_remove(k);
            placement_error(body, half, dt)
        };
        let what = cases()[k].what;
        let (coarse, fine) = (error(0.02), error(0.01));
        assert!(coarse < 1e-4, "{what}: {coarse} m off after 0.02 s");
        assert!(fine <= coarse / 6.0 + rounding, "{what}: {coarse} m off after 0.02 s, {fine} m after 0.01 s");
    }
}
