//! Several bodies: each automatic value is that of the body that asks for most, and each warning holds for every body.

use run::load_text;
use scene::Loaded;

/// A scene of wedges of 20°, 0.4 m wide: place x [m], downward speed [m/s] and mass [kg/m] of each.
fn wedges(wedges: &[[f64; 3]], more: &str) -> Loaded {
    let one = |[x, speed, mass]: &[f64; 3], name: &str| {
        format!(
            "name = \"{name}\"\nshape = \"wedge\"\ndeadrise_deg = 20.0\nbreadth = 0.4\nside_height = 0.2\nmass = {mass}\n\
             free = [\"y\"]\nposition = [{x}, 0.0]\nvelocity = [0.0, -{speed}]\n"
        )
    };
    let further: Vec<String> = wedges[1..].iter().map(|w| format!("[[bodies]]\n{}", one(w, "right"))).collect();
    let head = "name = \"drops\"\n[time]\nend = 0.02\n[resolution]\nspacing = 0.0025\n";
    let text = format!("{head}{more}[body]\n{}{}", one(&wedges[0], "left"), further.concat());
    load_text("drops", &text, &[]).unwrap_or_else(|error| panic!("{error}"))
}

const LEFT: [f64; 3] = [-0.25, 3.0, 60.0];
const FAST: [f64; 3] = [0.25, 5.0, 30.0];

/// They had 30 m/s of sound in place of 329, no fine zone and no approach.
#[test]
fn two_wedges_have_the_settings_of_the_one_that_asks_for_more() {
    let (left, fast, both) = (wedges(&[LEFT], ""), wedges(&[FAST], ""), wedges(&[LEFT, FAST], ""));
    let [a, b, both] = [left, fast, both].map(|loaded| loaded.scene);
    assert_eq!(both.sound_speed(), a.sound_speed().max(b.sound_speed()));
    assert!(both.sound_speed() > 300.0, "{} m/s", both.sound_speed());
    assert_eq!(both.time.start, a.time.start.min(b.time.start));
    assert!(both.time.start < 0.0);
    assert_eq!(both.fastest_speed(), a.fastest_speed().max(b.fastest_speed()));
    let [zone_a, zone_b] = [&a, &b].map(|scene| scene.resolution.fine_zone);
    let zone = both.resolution.fine_zone;
    assert_eq!(both.fine_zone_center(), 0.0);
    assert!(
        (zone[0] - (0.25 + zone_a[0].max(zone_b[0]))).abs() < 1e-12 && zone[1] == zone_a[1].max(zone_b[1]),
        "{zone:?}"
    );
    assert!(both.tank.width >= a.tank.width.max(b.tank.width) && both.tank.depth >= a.tank.depth.max(b.tank.depth));
    let bound = |scene: &scene::Scene| {
        scene
            .solver
            .weakly_compressible()
            .map(|fluid| (fluid.scheme.cavitation_pressure, fluid.scheme.acoustic_steps()))
    };
    let lowest = [bound(&a), bound(&b)].map(|bound| bound.expect("sound").0.expect("a bound"));
    assert_eq!(bound(&both), Some((Some(lowest[0].min(lowest[1])), 12)));
    assert!(both.resolution.follow, "the fine zone follows both");
}

/// The same wedge twice: as one, but for the room between them.
#[test]
fn a_second_wedge_like_the_first_changes_only_the_room() {
    let (one, two) = (wedges(&[LEFT], ""), wedges(&[LEFT, [0.25, LEFT[1], LEFT[2]]], ""));
    let settings = |loaded: &Loaded| {
        let fluid = loaded.scene.solver.weakly_compressible().expect("sound");
        (
            loaded.scene.sound_speed(),
            loaded.scene.time.start,
            fluid.scheme.cavitation_pressure,
            loaded.scene.resolution.fine_zone[1],
        )
    };
    assert_eq!(settings(&one), settings(&two));
    let particles = |loaded: &Loaded| scene::particle_estimate(&loaded.scene).0;
    assert!(particles(&two) < 4 * particles(&one), "{} and {}", particles(&two), particles(&one));
}

#[test]
fn every_body_is_warned_of_by_its_name() {
    let slow_sound = "[fluid]\nsound_speed = 60.0\n";
    let warnings = wedges(&[LEFT, FAST], slow_sound).warnings;
    for name in ["body left: ", "body right: "] {
        let found = |words: &str| warnings.iter().any(|w| w.starts_with(name) && w.contains(words));
        assert!(found("compressibility takes") || found("compressibility"), "{name}: {warnings:#?}");
        assert!(found("peak pressure unreliable"), "{name}: {warnings:#?}");
    }
}

/// A wall that stands beside a falling wedge: nothing but the room is another one.
#[test]
fn a_fixed_body_beside_an_impact_asks_for_nothing() {
    let alone = wedges(&[LEFT], "").scene;
    let post = "[[bodies]]\nshape = \"box\"\nbreadth = 0.1\nheight = 0.2\nposition = [0.3, 0.3]\nmotion = \"fixed\"\n";
    let text = alone_text() + post;
    let beside = load_text("beside", &text, &[]).unwrap_or_else(|error| panic!("{error}")).scene;
    assert_eq!((beside.sound_speed(), beside.time.start), (alone.sound_speed(), alone.time.start));
    assert_eq!((beside.resolution.fine_zone, beside.fine_zone_center()), (alone.resolution.fine_zone, -0.25));
    let motion = beside.motion_at_start(&beside.bodies[0]);
    assert_eq!(motion.position, [0.3, 0.3], "what is fixed is not carried back");
}

/// The similarity solution is that of a wedge alone.
#[test]
fn no_similarity_solution_holds_beside_another_body() {
    let far = "bodies=[{ name = 'far', shape = 'box', breadth = 0.3, height = 0.2, mass = 3, inertia = 1, position = [3, 1] }]";
    let error = run::load("wedge_constant", &[far.to_string(), "symmetry=none".to_string()]);
    let words = error.expect_err("two bodies").to_string();
    assert!(words.contains("`similarity`") && words.contains("a wedge alone"), "{words}");
}

/// A wedge with a box on a slider: the box changes how it decelerates, and a warning names what is left out.
#[test]
fn a_joined_body_that_enters_is_reported_of_the_speed_of_sound_that_it_would_have() {
    let top = "[[bodies]]\nname = \"top\"\nshape = \"box\"\nbreadth = 0.1\nheight = 0.1\nmass = 10.0\nfree = [\"y\"]\n\
        position = [-0.25, 0.6]\nvelocity = [0.0, -3.0]\n[[joints]]\nname = \"rail\"\nkind = \"slider\"\n\
        bodies = [\"left\", \"top\"]\nat = [-0.25, 0.6]\naxis = [0.0, 1.0]\n";
    let text = alone_text().replace("[body]", "[tank]\nwidth = 2.0\ndepth = 0.6\n[body]") + top;
    let warnings = load_text("joined", &text, &[]).unwrap_or_else(|error| panic!("{error}")).warnings;
    let said = |w: &String| w.starts_with("body left: a joint holds it") && w.contains("fluid.sound_speed = 329.4 m/s");
    assert!(warnings.iter().any(said), "{warnings:#?}");
}

fn alone_text() -> String {
    "name = \"drops\"\n[time]\nend = 0.02\n[resolution]\nspacing = 0.0025\n[body]\nname = \"left\"\nshape = \"wedge\"\n\
     deadrise_deg = 20.0\nbreadth = 0.4\nside_height = 0.2\nmass = 60.0\nfree = [\"y\"]\nposition = [-0.25, 0.0]\n\
     velocity = [0.0, -3.0]\n"
        .to_string()
}
