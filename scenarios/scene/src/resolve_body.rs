//! The body of a scene and its panels: defaults that depend on shape and motion, and what they exclude.

use fsi_coupling::geometry::polygon;
use fsi_coupling::{PanelEnd, Plane, Shape};
use settings::{Problem, require, significant};
use water_entry::curve::refined;

use super::draft::Draft;
use super::keys::{Axis, Body, Motion, Panel, SprungMass, Symmetry, TheoryName, line, placed};
use super::resolve_modes::check_modes;
use super::source::word;

/// Side height over breadth, where the scene does not say.
const SIDE_OVER_BREADTH: f64 = 0.25;
/// Smallest cosine of the angle by which a plate's middle line turns: sharper corners have no sensible mitre.
const SHARPEST_TURN: f64 = -0.5;
/// Elements, where the scene does not say: this number, or fewer that none is shorter than two spacings, but some in any case.
const ELEMENTS: [f64; 2] = [8.0, 24.0];
/// Places of a panel that are tried for another panel there.
const PROBES: u32 = 64;

/// The body, complete; `None` in a scene without one.
pub(super) fn resolve_body(draft: &mut Draft, symmetry: Symmetry) -> Result<Option<Body>, Problem> {
    if !draft.is_given("body") {
        return Ok(None);
    }
    let shape = resolve_shape(draft)?;
    let shape = smoothed(draft, shape)?;
    draft.fill("body.center_of_mass", shape.centroid());
    resolve_motion(draft, symmetry)?;
    let angle = draft.get("body.angle_deg").unwrap_or(0.0);
    let [lowest, _] = polygon::bounding_box(&placed(shape.outline(), [0.0; 2], angle));
    draft.fill("body.position", [0.0, 0.0 - lowest[1]]);
    fill_panels(draft, &shape)?;
    (0..draft.count("body.sprung_masses"))
        .try_for_each(|i| draft.read::<SprungMass>(&format!("body.sprung_masses[{i}]")).map(drop))?;
    let body: Body = draft.read("body")?;
    word("body.name", &body.name)?;
    check_locked_directions(&body)?;
    for (i, panel) in body.panels.iter().enumerate() {
        check_panel(panel, &body.shape, symmetry, |name| format!("body.panels[{i}].{name}"))?;
    }
    check_overlaps(&body)?;
    check_sprung_masses(&body)?;
    if let Some(modal) = &body.modal {
        let expected = "no body.panels beside body.modal: one or the other is the structure";
        require(body.panels.is_empty(), "body.panels", format_args!("{} panels", body.panels.len()), expected)?;
        check_modes(modal, &body.shape, symmetry)?;
    }
    Ok(Some(body))
}

/// Masses on springs stand on a rigid body that is free in y alone, each under a name of its own.
fn check_sprung_masses(body: &Body) -> Result<(), Problem> {
    let key = |i: usize, name: &str| format!("body.sprung_masses[{i}].{name}");
    for (i, mass) in body.sprung_masses.iter().enumerate() {
        let alone = matches!(&body.motion, Motion::Free(freedom) if freedom.free == [Axis::Y]) && !body.bends();
        let expected = "none, or a rigid body with free = [\"y\"]: the masses move upright over it";
        require(alone, "body.sprung_masses", format_args!("{:?}", mass.name), expected)?;
        word(&key(i, "name"), &mass.name)?;
        let first = body.sprung_masses.iter().position(|other| other.name == mass.name) == Some(i);
        require(first, &key(i, "name"), format_args!("{:?}", mass.name), "a name of its own")?;
    }
    Ok(())
}

/// The shape with arcs through those of its points that stand for a curve.
fn smoothed(draft: &mut Draft, shape: Shape) -> Result<Shape, Problem> {
    let wanted = draft.get::<bool>("body.smooth");
    let bends = draft.count("body.panels") > 0 || draft.is_given("body.modal");
    let expected = "false with body.panels or body.modal, whose places are sides of the polygon";
    require(!(bends && wanted == Some(true)), "body.smooth", true, expected)?;
    let Shape::Polygon { points } = &shape else {
        require(wanted.is_none(), "body.smooth", wanted.unwrap_or_default(), "none but with shape = \"polygon\"")?;
        return Ok(shape);
    };
    match refined(points).filter(|_| wanted.unwrap_or(!bends)) {
        None => Ok(shape),
        Some(points) => {
            draft.set("body.points", &points);
            draft.set("body.smooth", false);
            Ok(Shape::Polygon { points })
        }
    }
}

pub(super) fn resolve_shape(draft: &mut Draft) -> Result<Shape, Problem> {
    let has_sides = draft.get("body.shape").is_some_and(|shape: String| shape == "wedge" || shape == "arc");
    if let (true, Some(breadth)) = (has_sides, draft.get::<f64>("body.breadth")) {
        draft.fill("body.side_height", SIDE_OVER_BREADTH * breadth);
    }
    let shape: Shape = draft.read("body")?;
    match &shape {
        Shape::Arc { radius, breadth, .. } => {
            let widest = 2.0 * radius;
            let expected = format_args!("a chord of at most twice body.radius, {widest} m");
            require(*breadth <= widest, "body.breadth", breadth, expected)?;
        }
        Shape::Polygon { points } => {
            check_points(points, 3, true)?;
            let refuse = |given: String, expected: &str| Err(Problem::new("body.points", given, expected));
            if let Some((i, j)) = polygon::first_crossing(points) {
                let given = format!("a line whose edges {i} and {j} meet");
                return refuse(given, "an outline that does not cross itself");
            }
            let area = polygon::signed_area(points);
            if area <= 0.0 {
                return refuse(format!("points around {} m²", significant(area)), "counter-clockwise points");
            }
        }
        Shape::Polyline { points, thickness } => {
            check_points(points, 2, false)?;
            let sharp = points.windows(3).find(|w| {
                let (a, b) = ([w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]);
                a[0] * b[0] + a[1] * b[1] < SHARPEST_TURN * a[0].hypot(a[1]) * b[0].hypot(b[1])
            });
            if let Some(w) = sharp {
                let given = format!("a sharp corner at {:?}", w[1]);
                return Err(Problem::new("body.points", given, "corners that turn by at most 120 degrees"));
            }
            let plain = polygon::first_crossing(&shape.outline()).is_none();
            let expected = "a plate whose two sides do not cross: thinner, or with longer edges";
            require(plain, "body.thickness", thickness, expected)?;
        }
        _ => {}
    }
    Ok(shape)
}

/// As many points as the line needs, none of them twice in a row.
fn check_points(points: &[[f64; 2]], least: usize, closed: bool) -> Result<(), Problem> {
    let count = points.len();
    require(count >= least, "body.points", format_args!("{count} points"), format_args!("at least {least} points"))?;
    let repeated = points.windows(2).position(|w| w[0] == w[1]);
    let repeated = repeated.or((closed && points.first() == points.last()).then_some(0));
    let given = format_args!("{:?} twice in a row", points[repeated.unwrap_or(0)]);
    require(repeated.is_none(), "body.points", given, "every vertex once")
}

fn resolve_motion(draft: &mut Draft, symmetry: Symmetry) -> Result<(), Problem> {
    let half = symmetry == Symmetry::X;
    let motion = draft.fill("body.motion", "free".to_string());
    if motion == "free" {
        let free = draft.fill("body.free", if half { vec![Axis::Y] } else { vec![Axis::X, Axis::Y, Axis::Angle] });
        if !free.contains(&Axis::Angle) {
            draft.remove("body", "inertia");
        }
    }
    match draft.read("body")? {
        Motion::Free(freedom) => {
            let free = &freedom.free;
            let some = "some of \"x\", \"y\", \"angle\", or motion = \"fixed\"";
            require(!free.is_empty(), "body.free", "[]", some)?;
            let on_axis = !half || free.iter().all(|axis| *axis == Axis::Y);
            require(on_axis, "body.free", format_args!("{free:?}"), "[\"y\"] with symmetry = \"x\"")?;
            match free.contains(&Axis::Angle) && freedom.inertia.is_none() {
                true => {
                    let why = "the moment of inertia [kg m²/m] of a body that is free to rotate";
                    Err(Problem::missing("body.inertia", why))
                }
                false => Ok(()),
            }
        }
        Motion::Oscillating(oscillation) => {
            let given = format_args!("{:?}", oscillation.amplitude);
            let upright = !half || oscillation.amplitude[0] == 0.0;
            require(upright, "body.amplitude", given, "[0, ...] with symmetry = \"x\"")
        }
        Motion::Tabulated(table) => match table.fault(half) {
            Some(expected) => Err(Problem::new("body.displacements", format!("{:?}", table.displacements), expected)),
            None => Ok(()),
        },
        Motion::ConstantVelocity | Motion::Fixed => Ok(()),
    }
}

/// A direction that cannot move has no velocity.
fn check_locked_directions(body: &Body) -> Result<(), Problem> {
    let [x, y, angle] = body.motion.has_initial_velocity();
    let ([vx, vy], spin) = (body.velocity, body.angular_velocity_deg_per_s);
    let expected = "0 along every direction that body.motion and body.free lock";
    let possible = (x || vx == 0.0) && (y || vy == 0.0);
    require(possible, "body.velocity", format_args!("{:?}", body.velocity), expected)?;
    let expected = "0, since body.motion and body.free lock the rotation";
    require(angle || spin == 0.0, "body.angular_velocity_deg_per_s", spin, expected)
}

/// Defaults of all panels.
fn fill_panels(draft: &mut Draft, shape: &Shape) -> Result<(), Problem> {
    let spacing = draft.get("resolution.spacing");
    for i in 0..draft.count("body.panels") {
        let key = |name: &str| format!("body.panels[{i}].{name}");
        draft.fill(&key("name"), format!("panel{}", i + 1));
        fill_from_bars(draft, shape, key)?;
        if let (Some(from), Some(to)) = (draft.get(&key("from")), draft.get(&key("to"))) {
            draft.fill(&key("elements"), enough_elements(shape, [from, to], spacing));
        }
        if let Some(stress) = draft.get::<f64>(&key("yield_stress")) {
            draft.fill(&key("allowable_stress"), stress);
        }
        draft.read::<Panel>(&format!("body.panels[{i}]"))?;
    }
    Ok(())
}

/// What a panel of bars leaves to the program: its place on the line, and the plate with the mean stiffness and mass of its bars.
fn fill_from_bars(draft: &mut Draft, shape: &Shape, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    let (nodes, bars) = (draft.get::<Vec<[f64; 2]>>(&key("nodes")), draft.get::<Vec<[f64; 7]>>(&key("bars")));
    let Some((nodes, bars)) = nodes.zip(bars) else { return Ok(()) };
    let (count, expected) = (bars.len(), format_args!("2 to 2000 bars, one less than the {} nodes", nodes.len()));
    require(
        (2..=2000).contains(&count) && nodes.len() == count + 1,
        &key("bars"),
        format_args!("{count} bars"),
        expected,
    )?;
    for (k, bar) in bars.iter().enumerate() {
        let sound = bar[..5].iter().all(|value| *value > 0.0) && bar[5] <= 0.0 && bar[6] >= 0.0 && bar[5] < bar[6];
        let expected =
            "numbers above 0, then the distance of the right fibre, at most 0, and of the left one, at least 0";
        require(sound, &format!("{}[{k}]", key("bars")), format_args!("{bar:?}"), expected)?;
        let [a, b] = [nodes[k], nodes[k + 1]];
        require(
            a != b,
            &format!("{}[{}]", key("nodes"), k + 1),
            format_args!("{b:?}"),
            "another place than the node before",
        )?;
    }
    let lengths: Vec<f64> = nodes.windows(2).map(|n| (n[1][0] - n[0][0]).hypot(n[1][1] - n[0][1])).collect();
    let whole: f64 = lengths.iter().sum();
    let mean = |of: fn(&[f64; 7]) -> f64| bars.iter().zip(&lengths).map(|(bar, l)| l * of(bar)).sum::<f64>() / whole;
    let [axial, bending, mass] =
        [mean(|bar| bar[0] * bar[3]), mean(|bar| bar[0] * bar[4]), mean(|bar| bar[2] * bar[3])];
    let thickness = (12.0 * bending / axial).sqrt();
    let line = line(shape);
    for (name, at) in [("from", nodes[0]), ("to", nodes[count])] {
        draft.fill(&key(name), line.at(line.nearest(at).0));
    }
    draft.fill(&key("elements"), count);
    require(
        draft.get(&key("elements")) == Some(count),
        &key("elements"),
        draft.get(&key("elements")).unwrap_or(0),
        format_args!("{count}, as many as bars"),
    )?;
    draft.fill(&key("thickness"), thickness);
    draft.fill(&key("youngs_modulus"), axial / thickness);
    draft.fill(&key("density"), mass / thickness);
    let plane = draft.fill(&key("plane"), Plane::Stress);
    require(
        plane == Plane::Stress,
        &key("plane"),
        "\"strain\"",
        "\"stress\" with bars, whose moduli are those of the bars",
    )
}

/// Elements between two points of a body's line, at a particle spacing [m].
fn enough_elements(shape: &Shape, ends: [[f64; 2]; 2], spacing: Option<f64>) -> usize {
    let line = line(shape);
    let [from, to] = ends.map(|at| line.nearest(at).0);
    if !line.is_closed() && to < from {
        return ELEMENTS[1] as usize; // refused by its place
    }
    let length = line.part(from, to).length();
    let enough = spacing.map_or(ELEMENTS[1], |spacing: f64| (0.5 * length / spacing).floor());
    enough.clamp(ELEMENTS[0], ELEMENTS[1]) as usize
}

/// No two panels take the same part of the body's line.
fn check_overlaps(body: &Body) -> Result<(), Problem> {
    let line = line(&body.shape);
    let reach = |panel: &Panel| [panel.from, panel.to].map(|end| line.nearest(end).0);
    for (i, panel) in body.panels.iter().enumerate() {
        let [from, to] = reach(panel);
        let part = line.part(from, to);
        // places of this panel, ends left out
        let within = (1..PROBES).map(|k| line.nearest(part.at(part.length() * f64::from(k) / f64::from(PROBES))).0);
        let within: Vec<f64> = within.collect();
        let taken = |(j, other): &(usize, &Panel)| *j != i && within.iter().any(|s| line.between(*s, reach(other)));
        if let Some((j, _)) = body.panels.iter().enumerate().find(taken) {
            let expected = format!("a part of the line that body.panels[{j}] does not take");
            return Err(Problem::new(&format!("body.panels[{i}].from"), format!("{:?}", panel.from), expected));
        }
    }
    Ok(())
}

/// A panel lies on the body's line, and is held.
fn check_panel(panel: &Panel, shape: &Shape, symmetry: Symmetry, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    word(&key("name"), &panel.name)?;
    let (line, half) = (line(shape), symmetry == Symmetry::X);
    for (name, at) in [("from", panel.from), ("to", panel.to)] {
        let (s, distance) = line.nearest(at);
        let given = format!("{at:?}");
        let ([x, y], away) = (line.at(s).map(significant), significant(distance));
        let expected = format_args!("a point on the body's line: the nearest, [{x}, {y}], is {away} m away");
        require(distance <= 1e-3 * line.length(), &key(name), &given, expected)?;
        let expected = "x >= 0 with symmetry = \"x\": the other half is its image";
        require(!half || at[0] >= 0.0, &key(name), &given, expected)?;
    }
    let [from, to] = [panel.from, panel.to].map(|at| line.nearest(at).0);
    let expected = if line.is_closed() { "another point than from" } else { "a point after from along body.points" };
    let apart = from != to && (line.is_closed() || to > from);
    require(apart, &key("to"), format_args!("{:?}", panel.to), expected)?;
    let part = line.part(from, to);
    let own_half = !half || part.points().iter().all(|point| point[0] >= -1e-9 * line.length());
    let expected = "a panel with x >= 0 all the way, with symmetry = \"x\"; from and to may be the wrong way round";
    require(own_half, &key("to"), format_args!("{:?}", panel.to), expected)?;
    let length = part.length();
    let expected = format_args!("at most half the panel's length of {} m: thicker it is no plate", significant(length));
    require(panel.thickness <= 0.5 * length, &key("thickness"), panel.thickness, expected)?;
    check_end_springs(panel, &key)?;
    check_supports(&key("ends"), panel)?;
    for (end, at) in panel.ends.iter().zip([panel.from, panel.to]) {
        let joined = *end != PanelEnd::Mirror || half && at[0] == 0.0;
        let expected = "mirror only at x = 0, with symmetry = \"x\"";
        require(joined, &key("ends"), format_args!("\"mirror\" at {at:?}"), expected)?;
    }
    for (j, place) in panel.watch.iter().enumerate() {
        let new = !panel.watch[..j].contains(place);
        require(new, &format!("{}[{j}]", key("watch")), place, "every place once")?;
    }
    let elastic = panel.yield_stress.is_none() || panel.theory == TheoryName::EulerBernoulli;
    require(elastic, &key("theory"), "\"timoshenko\"", "\"euler_bernoulli\" with yield_stress")
}

/// Refuses springs and dampers below zero, or along directions that the end's support holds.
fn check_end_springs(panel: &Panel, key: impl Fn(&str) -> String) -> Result<(), Problem> {
    for (name, both) in [("end_springs", panel.end_springs), ("end_dampers", panel.end_dampers)] {
        for (i, (values, end)) in both.into_iter().flatten().zip(panel.ends).enumerate() {
            let free = match end {
                PanelEnd::Clamped | PanelEnd::Guided => [false; 3],
                PanelEnd::Pinned | PanelEnd::Sliding => [false, false, true],
                PanelEnd::Mirror => [true, true, false],
                PanelEnd::Free => [true; 3],
            };
            let key = format!("{}[{i}]", key(name));
            let held = values.iter().zip(free).any(|(value, free)| *value != 0.0 && !free);
            let expected = match end {
                PanelEnd::Clamped | PanelEnd::Guided => "[0, 0, 0] at this end: clamped and guided ends take none",
                PanelEnd::Pinned | PanelEnd::Sliding => "[0, 0, ...] at this end: its support holds its place",
                _ => "[..., ..., 0] at this end: a mirror holds its rotation",
            };
            require(!held, &key, format_args!("{values:?}"), expected)?;
            let sound = values.iter().all(|value| *value >= 0.0 && value.is_finite());
            require(
                sound,
                &key,
                format_args!("{values:?}"),
                "three numbers of at least 0: along, across, in rotation",
            )?;
        }
    }
    Ok(())
}

/// Refuses a panel that nothing holds along, or across.
fn check_supports(key: &str, panel: &Panel) -> Result<(), Problem> {
    use PanelEnd::{Clamped, Guided, Mirror, Pinned, Sliding};
    let ends = panel.ends;
    let sprung = |k: usize| panel.end_springs().iter().any(|spring| spring.stiffness[k] > 0.0);
    let along = sprung(0) || ends.iter().any(|end| matches!(end, Clamped | Pinned | Mirror));
    let across = sprung(1) || ends.iter().any(|end| matches!(end, Clamped | Pinned | Sliding | Guided));
    let expected =
        "at least one end clamped or pinned, or end_springs: with neither the panel is a mechanism that slides away";
    require(along && across, key, format!("{ends:?}").to_lowercase(), expected)
}
