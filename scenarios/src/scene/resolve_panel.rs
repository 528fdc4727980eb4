//! Panels of a body: their defaults, and what their places and ends exclude.

use fsi_coupling::geometry::polyline::Polyline;
use fsi_coupling::settings::{Problem, significant};
use fsi_coupling::{PanelEnd, Shape};

use super::draft::Draft;
use super::settings::{Body, Panel, Symmetry, TheoryName};
use super::word::word;

/// Elements, where the scene does not say: so many, or fewer that none is shorter than two spacings, but some in any case.
const ELEMENTS: [f64; 2] = [8.0, 24.0];
/// Places of a panel that are tried for another panel there.
const PROBES: u32 = 64;

/// The line that a body's panels lie along [m, body's frame].
pub(super) fn line(shape: &Shape) -> Polyline {
    match shape {
        Shape::Polyline { points, .. } => Polyline::open(points.clone()),
        _ => Polyline::closed(&shape.outline()),
    }
}

/// Defaults of all panels.
pub(super) fn fill_panels(draft: &mut Draft, shape: &Shape) -> Result<(), Problem> {
    let spacing = draft.get("resolution.spacing");
    for i in 0..draft.count("body.panels") {
        let key = |name: &str| format!("body.panels[{i}].{name}");
        draft.fill(&key("name"), format!("panel{}", i + 1));
        if let (Some(from), Some(to)) = (draft.get(&key("from")), draft.get(&key("to"))) {
            draft.fill(&key("elements"), enough_elements(&line(shape), [from, to], spacing));
        }
        if let Some(stress) = draft.get::<f64>(&key("yield_stress")) {
            draft.fill(&key("allowable_stress"), stress);
        }
        draft.read::<Panel>(&format!("body.panels[{i}]"))?;
    }
    Ok(())
}

/// Elements between two points of a line, at a particle spacing [m].
fn enough_elements(line: &Polyline, ends: [[f64; 2]; 2], spacing: Option<f64>) -> usize {
    let [from, to] = ends.map(|at| line.nearest(at).0);
    if !line.is_closed() && to < from {
        return ELEMENTS[1] as usize; // refused by its place
    }
    let length = line.part(from, to).length();
    let enough = spacing.map_or(ELEMENTS[1], |spacing: f64| (0.5 * length / spacing).floor());
    enough.clamp(ELEMENTS[0], ELEMENTS[1]) as usize
}

/// Each panel lies on the body's line and is held, and no two take the same part of the line.
pub(super) fn check_panels(body: &Body, symmetry: Symmetry) -> Result<(), Problem> {
    let panels = &body.panels;
    for (i, panel) in panels.iter().enumerate() {
        check_panel(i, panel, body, symmetry)?;
    }
    let line = line(&body.shape);
    let reach = |panel: &Panel| [panel.from, panel.to].map(|end| line.nearest(end).0);
    for (i, panel) in panels.iter().enumerate() {
        let [from, to] = reach(panel);
        let part = line.part(from, to);
        // places of this panel, ends left out
        let within = (1..PROBES).map(|k| line.nearest(part.at(part.length() * f64::from(k) / f64::from(PROBES))).0);
        let within: Vec<f64> = within.collect();
        let taken = |(j, other): &(usize, &Panel)| *j != i && within.iter().any(|s| line.between(*s, reach(other)));
        if let Some((j, _)) = panels.iter().enumerate().find(taken) {
            let expected = format!("a part of the line that body.panels[{j}] does not take");
            return Err(Problem::new(&format!("body.panels[{i}].from"), format!("{:?}", panel.from), expected));
        }
    }
    Ok(())
}

fn check_panel(i: usize, panel: &Panel, body: &Body, symmetry: Symmetry) -> Result<(), Problem> {
    let key = |name: &str| format!("body.panels[{i}].{name}");
    word(&key("name"), &panel.name)?;
    let line = line(&body.shape);
    for (name, at) in [("from", panel.from), ("to", panel.to)] {
        check_end(&line, &key(name), at, symmetry)?;
    }
    let [from, to] = [panel.from, panel.to].map(|at| line.nearest(at).0);
    if from == to || (!line.is_closed() && to < from) {
        let expected =
            if line.is_closed() { "another point than from" } else { "a point after from along body.points" };
        return Err(Problem::new(&key("to"), format!("{:?}", panel.to), expected));
    }
    let length = line.part(from, to).length();
    if panel.thickness > 0.5 * length {
        let expected = format!("at most half the panel's length of {} m: thicker it is no plate", significant(length));
        return Err(Problem::new(&key("thickness"), panel.thickness, expected));
    }
    check_supports(&key("ends"), panel.ends)?;
    for (end, at) in panel.ends.iter().zip([panel.from, panel.to]) {
        if *end == PanelEnd::Mirror && (symmetry != Symmetry::X || at[0] != 0.0) {
            let expected = "mirror only at x = 0, with symmetry = \"x\"";
            return Err(Problem::new(&key("ends"), format!("\"mirror\" at {at:?}"), expected));
        }
    }
    if let Some(j) = (1..panel.watch.len()).find(|j| panel.watch[..*j].contains(&panel.watch[*j])) {
        return Err(Problem::new(&format!("{}[{j}]", key("watch")), panel.watch[j], "every place once"));
    }
    if panel.yield_stress.is_some() && panel.theory != TheoryName::EulerBernoulli {
        return Err(Problem::new(&key("theory"), "\"timoshenko\"", "\"euler_bernoulli\" with yield_stress"));
    }
    Ok(())
}

fn check_end(line: &Polyline, key: &str, at: [f64; 2], symmetry: Symmetry) -> Result<(), Problem> {
    let (s, distance) = line.nearest(at);
    if distance > 1e-3 * line.length() {
        let [x, y] = line.at(s).map(significant);
        let away = significant(distance);
        let expected = format!("a point on the body's line: the nearest, [{x}, {y}], is {away} m away");
        return Err(Problem::new(key, format!("{at:?}"), expected));
    }
    match symmetry == Symmetry::X && at[0] < 0.0 {
        true => {
            let expected = "x >= 0 with symmetry = \"x\": the other half is its image";
            Err(Problem::new(key, format!("{at:?}"), expected))
        }
        false => Ok(()),
    }
}

/// Refuses a panel that is not held.
fn check_supports(key: &str, ends: [PanelEnd; 2]) -> Result<(), Problem> {
    use PanelEnd::{Free, Mirror, Sliding};
    let mechanism = matches!(ends, [Free, Free | Sliding | Mirror] | [Sliding | Mirror, Free])
        || matches!(ends, [Sliding, Sliding] | [Mirror, Mirror]);
    if mechanism {
        let expected = "at least one end clamped or pinned: with neither the panel is a mechanism that slides away";
        return Err(Problem::new(key, format!("{ends:?}").to_lowercase(), expected));
    }
    Ok(())
}
