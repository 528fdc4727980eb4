//! Stations of a landing: their keys, and the shape of a section in a scene. A kind of section is a variant of [`Form`] and its lines here.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, require, significant};
use water_entry::ditching::{Form, Station};

use super::outlines::is_half_section;

/// An item of `[[stations]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StationKeys {
    /// Distance from the nose along the body axis [m].
    pub x: f64,
    /// Height of the keel over the body axis; an outline gives its own, that of its lowest point [m].
    pub keel: f64,
    /// Breadth between the edges at which the water separates; with an outline by default up to its widest place, or to where its side is steeper than 45 degrees [m].
    pub breadth: f64,
    /// Radius of a section that is an arc [m].
    #[schemars(extend("x-default" = "required unless deadrise_deg or an outline"))]
    pub radius: Option<f64>,
    /// Deadrise of a section that is a wedge [deg].
    #[schemars(extend("x-default" = "required unless radius or an outline"))]
    pub deadrise_deg: Option<f64>,
    /// File with the points of the section, whole or half: from the plane of symmetry, over the body axis.
    #[schemars(extend("x-default" = "none"))]
    pub outline: Option<String>,
    /// Unit of that file: m, cm, mm, in or ft.
    #[schemars(extend("x-default" = "that of the file, or m"))]
    pub outline_unit: Option<String>,
    /// Half of the section from the keel outwards instead: distance from the plane of symmetry, height over the keel [m], shape (n, 2).
    #[schemars(extend("x-default" = "none"))]
    pub points: Option<Vec<[f64; 2]>>,
}

/// A station of its keys.
pub(super) fn station(index: usize, keys: &StationKeys) -> Result<Station, Problem> {
    let key = |name: &str| format!("stations[{index}].{name}");
    let form = match (keys.radius, keys.deadrise_deg, &keys.points) {
        (Some(radius), None, None) => Form::Radius(radius),
        (None, Some(deadrise), None) => Form::DeadriseDeg(deadrise),
        (None, None, Some(points)) if is_half_section(points) => Form::Outline(points.clone()),
        (None, None, Some(points)) => {
            let expected = "two points or more from the keel, [0, 0], outwards and up";
            return Err(Problem::new(&key("points"), format!("{points:?}"), expected));
        }
        (Some(given), _, Some(_)) => return Err(Problem::new(&key("radius"), given, "none beside an outline")),
        (_, Some(given), Some(_)) => return Err(Problem::new(&key("deadrise_deg"), given, "none beside an outline")),
        (Some(_), Some(given), _) => {
            return Err(Problem::new(&key("deadrise_deg"), given, "a radius or a deadrise, not both"));
        }
        (None, None, None) => return Err(Problem::missing(&key("radius"), "a radius, deadrise_deg or an outline")),
    };
    if let Form::Outline(points) = &form {
        let widest = 2.0 * points.iter().map(|p| p[0]).fold(0.0, f64::max);
        let expected = format_args!("up to {} m, the breadth of the outline", significant(widest));
        require(keys.breadth <= widest * (1.0 + 1e-6), &key("breadth"), keys.breadth, expected)?;
    }
    Ok(Station { x: keys.x, keel: keys.keel, breadth: keys.breadth, form })
}

/// The keys of a scene's body with a section of this form and breadth [m].
pub(super) fn shape_keys(form: &Form, breadth: f64) -> String {
    let sides = format!("breadth = {breadth:?}\nside_height = {:?}", 0.5 * breadth);
    match form {
        Form::Radius(radius) => format!("shape = \"arc\"\nradius = {radius:?}\n{sides}"),
        Form::DeadriseDeg(deadrise) => format!("shape = \"wedge\"\ndeadrise_deg = {deadrise:?}\n{sides}"),
        Form::Outline(_) => {
            let mut right = form.bottom(breadth);
            if let Some([x, y]) = right.last().copied() {
                right.push([x, y + 0.5 * breadth]);
            }
            let left = right.iter().skip(1).rev().map(|[x, y]| [-x, *y]);
            let around: Vec<[f64; 2]> = right.iter().copied().chain(left).collect();
            format!("shape = \"polygon\"\npoints = {around:?}")
        }
    }
}
