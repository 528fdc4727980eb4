//! Panels of a body, from as written to as run.

use super::file::PanelFile;
use super::model::{Body, Symmetry};
use super::model_panel::{EndName, Panel};
use super::problem::{Problem, positive, required, significant, within, word};
use fsi_coupling::Shape;
use fsi_coupling::course::Course;

/// Elements, where the scene does not say.
const ELEMENTS: usize = 24;
/// Most elements that make sense: a step of as many costs as much as one of thousands of particles.
const MOST_ELEMENTS: usize = 2000;

/// The line that a body's panels lie along [m, body's frame].
pub(super) fn line(shape: &Shape) -> Course {
    match shape {
        Shape::Polyline { points, .. } => Course::open(points.clone()),
        _ => Course::closed(&shape.outline()),
    }
}

pub(super) fn resolve_panels(files: Vec<PanelFile>, body: &Body, symmetry: Symmetry) -> Result<Vec<Panel>, Problem> {
    let panels: Vec<Panel> = files
        .into_iter()
        .enumerate()
        .map(|(i, file)| resolve_panel(i, file, body, symmetry))
        .collect::<Result<_, _>>()?;
    let line = line(&body.shape);
    let reach = |panel: &Panel| [panel.from, panel.to].map(|end| line.nearest(end).0);
    for (i, panel) in panels.iter().enumerate() {
        let middle = line
            .nearest(
                line.part(reach(panel)[0], reach(panel)[1])
                    .at(0.5 * line.part(reach(panel)[0], reach(panel)[1]).length()),
            )
            .0;
        if let Some(other) = panels.iter().enumerate().find(|(j, other)| *j != i && line.between(middle, reach(other)))
        {
            let expected = format!("a part of the line that body.panels[{}] does not take", other.0);
            return Err(Problem::new(&format!("body.panels[{i}].from"), format!("{:?}", panel.from), expected));
        }
    }
    Ok(panels)
}

fn resolve_panel(i: usize, file: PanelFile, body: &Body, symmetry: Symmetry) -> Result<Panel, Problem> {
    let key = |name: &str| format!("body.panels[{i}].{name}");
    let number = |name: &str, value: Option<f64>, what: &str| positive(&key(name), required(&key(name), value, what)?);
    let line = line(&body.shape);
    let name = file.name.unwrap_or_else(|| format!("panel{}", i + 1));
    let end = |name: &str, at: Option<[f64; 2]>| {
        let at = required(&key(name), at, "[x, y] on the body's line [m, body's frame]")?;
        let (s, distance) = line.nearest(at);
        if distance > 1e-3 * line.length() {
            let place = line.at(s).map(significant);
            let expected = format!(
                "a point on the body's line: the nearest, [{}, {}], is {} m away",
                place[0],
                place[1],
                significant(distance)
            );
            return Err(Problem::new(&key(name), format!("{at:?}"), expected));
        }
        if symmetry == Symmetry::X && at[0] < 0.0 {
            return Err(Problem::new(
                &key(name),
                format!("{at:?}"),
                "x >= 0 with symmetry = \"x\": the other half is its image",
            ));
        }
        Ok(at)
    };
    let (from, to) = (end("from", file.from)?, end("to", file.to)?);
    let reach = [from, to].map(|at| line.nearest(at).0);
    if reach[0] == reach[1] || (!line.is_closed() && reach[1] < reach[0]) {
        let expected =
            if line.is_closed() { "another point than from" } else { "a point after from along body.points" };
        return Err(Problem::new(&key("to"), format!("{to:?}"), expected));
    }
    let length = line.part(reach[0], reach[1]).length();
    let elements = file.elements.unwrap_or(ELEMENTS);
    if !(2..=MOST_ELEMENTS).contains(&elements) {
        return Err(Problem::new(&key("elements"), elements, format!("2 to {MOST_ELEMENTS} elements")));
    }
    let thickness = number("thickness", file.thickness, "the thickness [m]")?;
    if thickness > 0.5 * length {
        let expected = format!("at most half the panel's length of {} m: thicker it is no plate", significant(length));
        return Err(Problem::new(&key("thickness"), thickness, expected));
    }
    let ends = file.ends.unwrap_or_default();
    check_ends(&key("ends"), ends)?;
    for (end, at) in ends.iter().zip([from, to]) {
        if *end == EndName::Mirror && (symmetry != Symmetry::X || at[0] != 0.0) {
            let expected = "mirror only at x = 0, with symmetry = \"x\"";
            return Err(Problem::new(&key("ends"), format!("\"mirror\" at {at:?}"), expected));
        }
    }
    let poissons_ratio = file.poissons_ratio.unwrap_or(0.3);
    if !(0.0..0.5).contains(&poissons_ratio) {
        return Err(Problem::new(&key("poissons_ratio"), poissons_ratio, "at least 0 and below 0.5"));
    }
    let watch = file.watch.unwrap_or_else(|| vec![0.5]);
    for (j, share) in watch.iter().enumerate() {
        within(&format!("{}[{j}]", key("watch")), *share, 0.0..=1.0)?;
    }
    Ok(Panel {
        name: word(&key("name"), name)?,
        from,
        to,
        elements,
        thickness,
        youngs_modulus: number("youngs_modulus", file.youngs_modulus, "Young's modulus [Pa]")?,
        poissons_ratio,
        density: number("density", file.density, "the panel's density [kg/m^3]")?,
        ends,
        theory: file.theory.unwrap_or_default(),
        watch,
    })
}

/// A panel that is not held flies off: nothing says where to.
fn check_ends(key: &str, ends: [EndName; 2]) -> Result<(), Problem> {
    use EndName::{Free, Mirror, Sliding};
    let mechanism = matches!(ends, [Free, Free | Sliding | Mirror] | [Sliding | Mirror, Free])
        || matches!(ends, [Sliding, Sliding] | [Mirror, Mirror]);
    if mechanism {
        let expected = "at least one end clamped or pinned: with neither the panel is a mechanism that slides away";
        return Err(Problem::new(key, format!("{ends:?}").to_lowercase(), expected));
    }
    Ok(())
}
