//! Panels of a body, from as written to as run.

use super::file::PanelFile;
use super::model::{Body, Symmetry};
use super::model_panel::{Panel, TheoryName};
use super::problem::{Problem, not_negative, positive, required, significant, within, word};
use fsi_coupling::PanelEnd;
use fsi_coupling::Shape;
use fsi_coupling::geometry::polyline::Polyline;

/// Elements, where the scene does not say: so many, or fewer that none is shorter than two spacings, but some in any case.
const ELEMENTS: [f64; 2] = [8.0, 24.0];
/// Places of a panel that are tried for another panel there.
const PROBES: u32 = 64;
/// Most elements that make sense: a step of as many costs as much as one of thousands of particles.
const MOST_ELEMENTS: usize = 2000;

/// The line that a body's panels lie along [m, body's frame].
pub(super) fn line(shape: &Shape) -> Polyline {
    match shape {
        Shape::Polyline { points, .. } => Polyline::open(points.clone()),
        _ => Polyline::closed(&shape.outline()),
    }
}

/// Ranges, defaults, and that no two panels take the same part of the line. `spacing` is that of the scene, if it says one.
pub(super) fn resolve_panels(
    files: Vec<PanelFile>,
    body: &Body,
    symmetry: Symmetry,
    spacing: Option<f64>,
) -> Result<Vec<Panel>, Problem> {
    let each = files.into_iter().enumerate();
    let panels: Vec<Panel> =
        each.map(|(i, file)| resolve_panel(i, file, body, symmetry, spacing)).collect::<Result<_, _>>()?;
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
    Ok(panels)
}

fn resolve_panel(
    i: usize,
    file: PanelFile,
    body: &Body,
    symmetry: Symmetry,
    spacing: Option<f64>,
) -> Result<Panel, Problem> {
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
    let enough = spacing
        .filter(|spacing| *spacing > 0.0)
        .map_or(ELEMENTS[1], |spacing| (0.5 * length / spacing).floor().clamp(ELEMENTS[0], ELEMENTS[1]));
    let elements = file.elements.unwrap_or(enough as usize);
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
        if *end == PanelEnd::Mirror && (symmetry != Symmetry::X || at[0] != 0.0) {
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
        if watch[..j].contains(share) {
            return Err(Problem::new(&format!("{}[{j}]", key("watch")), share, "every place once"));
        }
    }
    let optional = |name: &str, value: Option<f64>| value.map(|value| positive(&key(name), value)).transpose();
    let yield_stress = optional("yield_stress", file.yield_stress)?;
    let theory = file.theory.unwrap_or_default();
    if yield_stress.is_some() && theory != TheoryName::EulerBernoulli {
        return Err(Problem::new(&key("theory"), "\"timoshenko\"", "\"euler_bernoulli\" with yield_stress"));
    }
    if let (None, Some(modulus)) = (yield_stress, file.hardening_modulus) {
        return Err(Problem::new(&key("hardening_modulus"), modulus, "only with yield_stress"));
    }
    Ok(Panel {
        yield_stress,
        hardening_modulus: not_negative(&key("hardening_modulus"), file.hardening_modulus.unwrap_or(0.0))?,
        rupture_strain: optional("rupture_strain", file.rupture_strain)?,
        allowable_stress: optional("allowable_stress", file.allowable_stress)?.or(yield_stress),
        name: word(&key("name"), name)?,
        from,
        to,
        elements,
        thickness,
        youngs_modulus: number("youngs_modulus", file.youngs_modulus, "Young's modulus [Pa]")?,
        poissons_ratio,
        density: number("density", file.density, "the panel's density [kg/m^3]")?,
        ends,
        theory,
        watch,
    })
}

/// A panel that is not held flies off: nothing says where to.
fn check_ends(key: &str, ends: [PanelEnd; 2]) -> Result<(), Problem> {
    use PanelEnd::{Free, Mirror, Sliding};
    let mechanism = matches!(ends, [Free, Free | Sliding | Mirror] | [Sliding | Mirror, Free])
        || matches!(ends, [Sliding, Sliding] | [Mirror, Mirror]);
    if mechanism {
        let expected = "at least one end clamped or pinned: with neither the panel is a mechanism that slides away";
        return Err(Problem::new(key, format!("{ends:?}").to_lowercase(), expected));
    }
    Ok(())
}
