//! Further bodies and joints of a scene: defaults, and what they exclude.

use fsi_coupling::Outline;
use fsi_coupling::geometry::{polygon, vector::sub};
use serde_json::Value;
use settings::{Problem, require};

use super::draft::Draft;
use super::keys::{Body, Joint, JointName, Scene, Symmetry, TANK};
use super::resolve_body::resolve_body;
use super::source::word;

/// Tables of a body that only the first one may have.
const OF_THE_FIRST: [&str; 6] = ["panels", "modal", "outline", "outline_layer", "motion_file", "modes_file"];

/// All bodies after the first, complete.
pub(super) fn resolve_further_bodies(draft: &mut Draft, symmetry: Symmetry) -> Result<Vec<Body>, Problem> {
    let count = draft.count("bodies");
    let expected = "no further bodies without [body], which is the first";
    require(count == 0 || draft.is_given("body"), "bodies", format_args!("{count} bodies"), expected)?;
    let mut found = Vec::new();
    for i in 0..count {
        let table = format!("bodies[{i}]");
        draft.fill(&format!("{table}.name"), format!("body{}", i + 2));
        for key in OF_THE_FIRST {
            let key = format!("{table}.{key}");
            require(!draft.is_given(&key), &key, "a value", "none: only the first body, [body], may have it")?;
        }
        let mut alone = draft.clone();
        alone.set("body", draft.get::<Value>(&table));
        let body = resolve_body(&mut alone, symmetry).map_err(|problem| further(problem, i))?;
        draft.set(&table, alone.get::<Value>("body"));
        found.extend(body);
    }
    Ok(found)
}

/// A problem of `body`, in the words of further body `i`.
pub(super) fn further(problem: Problem, i: usize) -> Problem {
    let table = format!("bodies[{i}]");
    let rename = |text: &str| text.replace("body.", &format!("{table}."));
    let key = problem.key.strip_prefix("body").map_or(problem.key.clone(), |rest| format!("{table}{rest}"));
    Problem { key, sentence: rename(&problem.sentence), expected: rename(&problem.expected), ..problem }
}

/// Rows of particles that a film of water between solids needs (THEORY CO37) [spacings].
const FILM: f64 = 2.0;

/// A film of water between solids that does not hold pressure.
pub(super) fn thin_film(scene: &Scene) -> Option<String> {
    let gap = scene.contact.gap;
    (gap < FILM && scene.solver.is_incompressible() && scene.all_bodies().any(Body::is_free)).then(|| {
        format!(
            "contact.gap = {gap} leaves less than {FILM} rows of particles between solids under water: the film does not hold its \
             pressure, and a body that lands may be thrown up"
        )
    })
}

/// Refuses joints that hold nothing, and bodies that overlap at the start.
pub(super) fn check_links(scene: &Scene) -> Result<(), Problem> {
    for (i, joint) in scene.joints.iter().enumerate() {
        check_joint(scene, joint, |name| format!("joints[{i}].{name}"))?;
    }
    let linked = !scene.joints.is_empty() || !scene.bodies.is_empty();
    let named = scene.all_bodies().any(|body| body.name == TANK);
    let expected = "another name: joints mean the tank by it";
    require(!(linked && named), "body.name", format_args!("{TANK:?}"), expected)?;
    let outlines: Vec<_> = scene.all_bodies().map(|body| (body, body.placed_outline())).collect();
    for (i, (body, corners)) in outlines.iter().enumerate().skip(1) {
        for (other, of_other) in &outlines[..i] {
            let inside = |line: &[[f64; 2]], outline: &[[f64; 2]]| {
                let mut places =
                    polygon::edges(line).flat_map(|(a, b)| [a, [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]]);
                Outline::polygon(outline).is_ok_and(|outline| places.any(|at| outline.signed_distance(at) < 0.0))
            };
            let joined = scene.joints.iter().any(|joint| joint.joins(&body.name, &other.name));
            let crosses = inside(corners, of_other) || inside(of_other, corners);
            let given = format_args!("{:?}, where {:?} overlaps {:?}", body.position, body.name, other.name);
            let expected = "a place beside all other bodies";
            require(joined || !crosses, &format!("bodies[{}].position", i - 1), given, expected)?;
        }
    }
    Ok(())
}

fn check_joint(scene: &Scene, joint: &Joint, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    word(&key("name"), &joint.name)?;
    require(scene.symmetry == Symmetry::None, &key("kind"), "a joint", "none with symmetry = \"x\"")?;
    let names: Vec<&str> = scene.all_bodies().map(|body| body.name.as_str()).chain([TANK]).collect();
    for (k, name) in joint.bodies.iter().enumerate() {
        let expected = format_args!("one of {}", names.join(", "));
        require(
            names.contains(&name.as_str()),
            &format!("{}[{k}]", key("bodies")),
            format_args!("{name:?}"),
            expected,
        )?;
        let bends = scene.all_bodies().any(|body| body.name == *name && body.bends());
        let expected = "a rigid body: joints do not hold one that bends";
        require(!bends, &format!("{}[{k}]", key("bodies")), format_args!("{name:?}"), expected)?;
    }
    let given = format_args!("{:?}", joint.bodies);
    require(joint.bodies[0] != joint.bodies[1], &key("bodies"), given, "two different bodies")?;
    let free = |name: &str| scene.all_bodies().any(|body| body.name == name && body.is_free());
    let moves = joint.bodies.iter().any(|name| free(name));
    require(moves, &key("bodies"), given, "at least one body with motion = \"free\"")?;
    let along = joint.axis.is_some_and(|[x, y]| x.hypot(y) > 0.0);
    let slides = joint.kind == JointName::Slider;
    require(slides == along, &key("axis"), format_args!("{:?}", joint.axis.unwrap_or_default()), {
        if slides { "a direction [x, y] other than [0, 0]" } else { "none: only a slider has an axis" }
    })?;
    let stretches = joint.kind == JointName::Spring;
    let apart = joint.to.is_some_and(|to| to != joint.at);
    require(stretches == apart, &key("to"), format_args!("{:?}", joint.to.unwrap_or_default()), {
        if stretches { "the spring's other end, another point than at" } else { "none: only a spring has a second end" }
    })?;
    let acts = !stretches || joint.stiffness > 0.0 || joint.damping > 0.0;
    require(acts, &key("stiffness"), joint.stiffness, "a number above 0, or damping: this spring does nothing")?;
    check_start(scene, joint, key)
}

/// Largest difference of velocities at a joint at the start, as they are typed, over the larger of both [-].
const TYPED: f64 = 1e-3;

/// Refuses bodies that a joint would jerk at t = 0: at a hinge their velocities differ, at a slider those across the axis or the turning.
fn check_start(scene: &Scene, joint: &Joint, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    let body = |name: &str| scene.all_bodies().find(|body| body.name == name);
    let velocity = |name: &str| body(name).map_or([0.0; 2], |body| body.velocity_at(joint.at));
    let [first, second] = joint.bodies.each_ref().map(|name| velocity(name));
    let apart = sub(second, first);
    let scale = TYPED * first[0].hypot(first[1]).max(second[0].hypot(second[1]));
    let [x, y] = joint.axis.unwrap_or([1.0, 0.0]);
    let turning = |name: &str| body(name).map_or(0.0, |body| body.angular_velocity_deg_per_s);
    let [one, other] = joint.bodies.each_ref().map(|name| turning(name));
    let jerks = match joint.kind {
        JointName::Hinge => apart[0].hypot(apart[1]) > scale,
        JointName::Slider => {
            let across = (apart[1] * x - apart[0] * y).abs() / x.hypot(y);
            across > scale || (one - other).abs() > TYPED * one.abs().max(other.abs())
        }
        JointName::Spring => false,
    };
    let given = format_args!("{:?}, which start there at {first:?} and {second:?} m/s", joint.bodies);
    let expected = match joint.kind {
        JointName::Hinge => "bodies with the same velocity at the hinge",
        _ => "bodies with the same velocity across the axis and the same angular velocity",
    };
    require(!jerks, &key("bodies"), given, expected)
}
