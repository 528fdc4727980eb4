//! Values that can be run, but are hardly what a scene means: most often a unit.

use fsi_coupling::Shape;
use fsi_coupling::geometry::polygon;
use settings::significant;
use water_entry::curve::refined;

use crate::keys::{Body, Freedom, Motion, Scene, Symmetry, panel_length};
use crate::outline::OutlineReport;
use crate::symmetric::is_half;

/// Mean densities of bodies [kg/m³].
const POSSIBLE: [f64; 2] = [1.0, 20_000.0];
/// Those of most [kg/m³].
const USUAL: [f64; 2] = [10.0, 8000.0];
/// Channel frequency classes (SAE J211-1) [Hz].
const CLASSES: [f64; 4] = [60.0, 180.0, 600.0, 1000.0];

/// Warnings about such values, each with its numbers and its likely cause.
pub(crate) fn implausible(scene: &Scene, outline: Option<&OutlineReport>) -> Vec<String> {
    let mut warnings = Vec::new();
    for body in scene.all_bodies() {
        let outline = outline.filter(|_| scene.body.as_ref() == Some(body)); // only the first has a file
        let mut of_body = Vec::new();
        if let Motion::Free(Freedom { mass, .. }) = body.motion {
            // one of both: they have the same causes
            let doubtful = mean_density(scene, body, mass, outline);
            of_body.extend(doubtful.or_else(|| lighter_than_panels(scene, body, mass)));
        }
        of_body.extend(coarse_curve(body));
        of_body.extend(outline.and_then(|file| half_section(scene, body, file)));
        warnings.extend(of_body.into_iter().map(|warning| scene.about(body) + &warning));
    }
    warnings.extend(scene.report.acceleration_cfc.filter(|class| !CLASSES.contains(class)).map(|class| {
        format!(
            "report.acceleration_cfc = {class} Hz is no channel frequency class of SAE J211-1, which are {}: the filter is made for it all \
             the same",
            CLASSES.map(|class| class.to_string()).join(", ")
        )
    }));
    warnings
}

/// Mass of the panels, with their images [kg/m].
fn panels_mass(scene: &Scene, body: &Body) -> f64 {
    let sides = if scene.symmetry == Symmetry::X { 2.0 } else { 1.0 };
    let mass = |panel: &crate::Panel| sides * panel.density * panel.thickness * panel_length(body, panel);
    body.panels.iter().map(mass).sum()
}

fn mean_density(scene: &Scene, body: &Body, mass: f64, file: Option<&OutlineReport>) -> Option<String> {
    let outline = body.shape.outline();
    let ([low, high], area) = (polygon::bounding_box(&outline), polygon::signed_area(&outline).abs());
    let density = (mass + panels_mass(scene, body)) / area;
    if (POSSIBLE[0]..=POSSIBLE[1]).contains(&density) {
        return None;
    }
    let fits = |factor: f64| (USUAL[0]..=USUAL[1]).contains(&(factor * mass / area));
    let tonnes = format!("the mass may be meant in t/m: body.mass = \"{mass} t/m\"");
    let millimetres = match file {
        Some(_) => "the points may be in mm: body.outline_unit = \"mm\"",
        None => "its lengths may be meant in mm: \"4 mm\" states a unit",
    };
    let cause = match density < POSSIBLE[0] {
        true if fits(1e6) && !fits(1e3) => millimetres.to_string(),
        true if fits(1e3) && !fits(1e6) => tonnes,
        true => format!("{millimetres}; or {tonnes}"),
        false if fits(1e-6) => "its lengths may be meant in m, not mm".to_string(),
        false => "check the units of the mass (kg per metre of span) and of the points".to_string(),
    };
    Some(format!(
        "the mean density of the body is {} kg/m³: body.mass = {mass} kg/m on {} m², {} m wide and {} m high; expected {} to {} kg/m³; {cause}",
        significant(density),
        significant(area),
        significant(high[0] - low[0]),
        significant(high[1] - low[1]),
        POSSIBLE[0],
        POSSIBLE[1]
    ))
}

/// `body.mass` is that of the rest of the body: one much below that of its panels was hardly meant.
fn lighter_than_panels(scene: &Scene, body: &Body, mass: f64) -> Option<String> {
    let panels = panels_mass(scene, body);
    (mass < panels).then(|| {
        format!(
            "body.mass = {mass} kg/m is that of the body without its panels, and less than their {} kg/m; the mass may be meant in t/m: \
             body.mass = \"{mass} t/m\"",
            significant(panels)
        )
    })
}

/// Points that stand for a curve and stay corners, because panels lie on the sides between them.
fn coarse_curve(body: &Body) -> Option<String> {
    let Shape::Polygon { points } = &body.shape else { return None };
    let fine = refined(points).filter(|fine| body.bends() && fine.len() >= 2 * points.len())?;
    Some(format!(
        "{} points of body.points stand for a curve, and the water meets them as corners, because panels lie on the sides between them: \
         forces under a few corners are above those under the curve; {} points would do",
        points.len(),
        fine.len()
    ))
}

/// A section of which the file has one half, with a side on the axis, in a scene without symmetry.
fn half_section(scene: &Scene, body: &Body, file: &OutlineReport) -> Option<String> {
    let Shape::Polygon { points } = &body.shape else { return None };
    let close = 1e-6 * polygon::perimeter(points);
    let on_axis = points.iter().filter(|[x, _]| x.abs() <= close).count();
    (scene.symmetry == Symmetry::None && is_half(points) && on_axis > 1).then(|| {
        format!(
            "{} may be half a section: its points are on one side of x = 0, and a side is on x = 0; write both halves, with symmetry = \"x\"",
            file.file
        )
    })
}
