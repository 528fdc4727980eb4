//! A body whose structure is given by its modes, against the panel that the modes are of.

use evidence::systems::{advance, of_text, scene, system};
use fsi_coupling::{Body, Coupled, PanelModes};
use settings::significant;
use structure_fe::Damping;

/// A wedge with a bottom plate, coarse, for the first part of its entry; so thick that it stays linear.
const WEDGE: [&str; 4] =
    ["resolution.spacing=0.012", "time.end=0.006", "tank.height=3.0", "body.panels[0].thickness=0.008"];

/// The same with the modes of its plate in place of the plate.
fn with_modes(count: usize, sets: &[&str]) -> Coupled {
    let scene = scene("flexible_wedge", &WEDGE);
    let body = scene.body.as_ref().expect("a body");
    let line = fsi_coupling::geometry::polyline::Polyline::closed(&body.shape.outline());
    let modes = PanelModes::of(&line, &body.panels[0].spec(), count, Damping::default()).expect("modes");
    let text = scene.to_toml().replace("damping = [0.0, 0.0]\n", "");
    let (start, end) = (text.find("[[body.panels]]").expect("a panel"), text.find("[observe]").expect("the rest"));
    let mut modal = format!("[body.modal]\nnodes = {:?}\nmasses = {:?}\n", modes.nodes, modes.masses);
    for mode in &modes.modes {
        let own = &mode.mode;
        modal += &format!(
            "[[body.modal.modes]]\nfrequency = {:?}\nmass = {:?}\nshape = {:?}\n",
            own.frequency, own.mass, own.shape
        );
    }
    of_text(&format!("{}{modal}\n{}", &text[..start], &text[end..]), sets)
}

fn body(system: &Coupled) -> &dyn Body {
    system.bodies().find(|body| body.motion().is_some()).expect("a body")
}

/// Height and speed of the frame, and how far the middle of the plate has moved against it along y.
fn place(system: &Coupled) -> [f64; 3] {
    let motion = body(system).motion().expect("a motion");
    let middle = [0.15, 0.5 * 0.109191];
    let (point, _) = body(system).material_point(middle).expect("a surface that bends");
    [motion.position[1], motion.velocity[1], point.at[1] - motion.point(middle)[1]]
}

/// Modes and finite elements of the same plate move alike; with fewer modes less so.
#[test]
fn modes_move_as_their_panel() {
    let mut panel = system("flexible_wedge", &WEDGE);
    advance(&mut panel, 0.006, |_| ()).expect("a stable run");
    let exact = place(&panel);
    let error = |count: usize| {
        let mut modal = with_modes(count, &[]);
        advance(&mut modal, 0.006, |_| ()).expect("a stable run");
        let found = place(&modal);
        println!("{count} modes: {found:?}, elements {exact:?}");
        assert!((found[0] - exact[0]).abs() < 1e-5 && (found[1] / exact[1] - 1.0).abs() < 1e-3, "{found:?} {exact:?}");
        (found[2] / exact[2] - 1.0).abs()
    };
    let [one, many] = [error(1), error(30)];
    assert!(
        exact[2] > 1e-5 && many < 1e-2 && many < one,
        "deflection off by {} and {}",
        significant(one),
        significant(many)
    );
}

/// Work that the water does arrives and becomes motion and strain; momentum closes: in every scheme, and with a frame that turns.
#[test]
fn work_and_momentum_close_in_every_scheme() {
    let turning = ["symmetry=none", "body.free=[\"x\",\"y\",\"angle\"]", "body.inertia=2.0"];
    for (scheme, more) in [("weak", &[][..]), ("added_mass", &[]), ("iqn_ils", &[]), ("added_mass", &turning)] {
        let set = format!("coupling.scheme={scheme}");
        let mut system = with_modes(8, &[&[&set[..]], more].concat());
        let held = |s: &Coupled| {
            let e = body(s).energy();
            (e.kinetic + e.potential + e.elastic + e.dissipated, e.work + e.support)
        };
        let (start, _) = held(&system);
        advance(&mut system, 0.006, |_| ()).expect("a stable run");
        let ((end, done), audit) = (held(&system), system.work_audit(0));
        let gap = (end - start - done) / audit.exchanged;
        println!("{scheme}: lost on the way {:.1e}, in the body {gap:.1e}", audit.residual());
        assert!(audit.exchanged > 1.0 && audit.residual() < 2e-3, "{scheme}: {audit:?}");
        // a frame that turns keeps its energy to second order in the step
        let exact = if more.is_empty() { 1e-9 } else { 1e-4 };
        assert!(gap.abs() < exact, "{scheme}: {gap}");
        assert!(system.momentum_audit().worst < 1e-10, "{scheme}: {}", system.momentum_audit().worst);
    }
}

/// A step that is taken back, here or through the state's bytes, and taken again gives the same bits.
#[test]
fn a_step_taken_again_gives_the_same_bits() {
    let bits = |s: &Coupled| [place(s).to_vec(), body(s).modes().expect("modes").amplitude].concat();
    let mut system = with_modes(8, &[]);
    advance(&mut system, 0.004, |_| ()).expect("a stable run");
    let dt = 0.5 * system.stable_dt().expect("a step");
    system.checkpoint();
    let bytes = system.to_bytes();
    let step = |system: &mut Coupled| {
        (0..3).for_each(|_| system.step(dt).expect("a stable step"));
        bits(system)
    };
    let first = step(&mut system);
    system.restore();
    assert_ne!(first, bits(&system));
    assert_eq!(first, step(&mut system));
    let mut other = with_modes(8, &[]);
    other.restore_bytes(&bytes).expect("its own state");
    assert_eq!(first, step(&mut other));
}
