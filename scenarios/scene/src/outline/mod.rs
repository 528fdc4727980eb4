//! `body.outline`: the points of a body from a file.

mod drawing;
mod dxf;
mod svg;
mod table;

use fsi_coupling::geometry::polygon;
use serde::Serialize;
use serde_json::{Value, json};
use settings::{Problem, convert, significant};

use self::drawing::{Drawing, MOST_POINTS, Placed};
use super::data_file::{DataFile, Fault, shortened};

/// Points closer than this share of the outline's size are one [-].
const SAME_POINT: f64 = 1e-7;
const KEY: &str = "body.outline";
const UNIT_KEY: &str = "body.outline_unit";
const LAYER_KEY: &str = "body.outline_layer";
const KIND: &str = "a file of points (.csv, .txt, .dat, .dxf or .svg)";

/// What was understood of a file of points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutlineReport {
    /// The file, as the scene names it.
    pub file: String,
    /// Its format.
    pub format: &'static str,
    /// Length of its unit [m].
    pub unit_m: f64,
    /// Points in the file.
    pub points_in_file: usize,
    /// Points of the body.
    pub points: usize,
    /// Points that repeat the one before them; the last that repeats the first is not counted.
    pub duplicates_merged: usize,
    /// Length of the straight side that closes an open outline [m]; absent where the file closes it, and of a plate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closed_by_side_m: Option<f64>,
    /// True where the file goes clockwise.
    pub orientation_changed: bool,
    /// Lower left and upper right corner of the smallest upright rectangle around the points [m].
    pub bounding_box_m: [[f64; 2]; 2],
    /// Enclosed area [m²]; absent of a plate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area_m2: Option<f64>,
}

/// Points in the order in which a scene or a file has them: what panels refer to.
#[derive(Debug)]
pub(super) struct Stations {
    pub points: Vec<[f64; 2]>,
    /// True where the body has them in reverse order.
    pub reversed: bool,
    pub closed: bool,
}

/// An outline, read: what was understood, and its points.
#[derive(Debug)]
pub(super) struct Settled {
    pub report: OutlineReport,
    pub stations: Stations,
    /// What was left out of the file, in sentences.
    pub notes: Vec<String>,
}

/// Replaces `body.outline` by the points of the file that it names.
pub(super) fn settle(given: &mut Value, scene_file: &str) -> Result<Option<Settled>, Problem> {
    let Some(body) = given.get_mut("body").and_then(Value::as_object_mut) else { return Ok(None) };
    let Some(name) = body.get("outline").and_then(Value::as_str).map(str::to_string) else {
        let alone = body.get("outline_layer");
        return alone
            .map_or(Ok(None), |layer| Err(Problem::new(LAYER_KEY, layer, "body.outline, a DXF or an SVG, beside it")));
    };
    let refuse = |expected: &str| Err(Problem::new(KEY, format!("{name:?}"), expected));
    if body.contains_key("points") {
        return refuse("no body.points beside it: the file has the points");
    }
    let shape = body.get("shape").cloned().unwrap_or_else(|| json!("polygon"));
    let closed = match shape.as_str() {
        Some("polygon") => true,
        Some("polyline") => false,
        _ => return refuse("shape = \"polygon\", or \"polyline\" for a plate, beside it"),
    };
    let unit = match body.get("outline_unit") {
        None => None,
        Some(unit) => Some(unit_of(unit)?),
    };
    let layer = body.get("outline_layer").and_then(Value::as_str).map(str::to_string);
    let file = DataFile::read(scene_file, KEY, &name, KIND)?;
    let asked = Asked { unit, layer: layer.as_deref() };
    let settled = understood(&file, &asked, closed).map_err(|fault| file.problem(fault))?;
    let (points, settled) = settled;
    body.remove("outline");
    body.remove("outline_unit");
    body.remove("outline_layer");
    body.insert("shape".into(), shape);
    body.insert("points".into(), json!(points));
    Ok(Some(settled))
}

/// Points around a section from a file that a key names, counter-clockwise [m]; `unit` is the key and value of its unit.
///
/// # Errors
/// A file that cannot be read, or whose points are no outline: key, file, line.
pub fn outline_of_section(
    scene_file: &str,
    key: &str,
    name: &str,
    unit: Option<(&str, &Value)>,
) -> Result<Vec<[f64; 2]>, Problem> {
    let unit = unit.map(|(key, given)| unit_of(given).map_err(|p| Problem::new(key, given, p.expected))).transpose()?;
    let file = DataFile::read(scene_file, key, name, KIND)?;
    let asked = Asked { unit, layer: None };
    understood(&file, &asked, true).map(|(points, _)| points).map_err(|fault| file.problem(fault))
}

/// A unit of length [m].
fn unit_of(given: &Value) -> Result<f64, Problem> {
    let expected = "a unit of length: \"m\", \"cm\", \"mm\", \"in\" or \"ft\"";
    let length = given.as_str().map(|unit| convert(&format!("1 {unit}"), "m"));
    length.and_then(Result::ok).ok_or_else(|| Problem::new(UNIT_KEY, given, expected))
}

/// What the scene says of a file of points.
#[derive(Clone, Copy, Default)]
struct Asked<'a> {
    /// Its unit [m].
    unit: Option<f64>,
    /// A layer of a drawing.
    layer: Option<&'a str>,
}

fn read(file: &DataFile, layer: Option<&str>) -> Result<Drawing, Fault> {
    let ending = file.name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_lowercase());
    if let (Some(_), "csv" | "txt" | "tsv" | "dat") = (layer, ending.as_str()) {
        return Err(Fault::new(
            1,
            "a table of points",
            format!("a DXF or an SVG beside {LAYER_KEY}, or no {LAYER_KEY}"),
        ));
    }
    match ending.as_str() {
        "csv" | "txt" | "tsv" => table::parse(&file.text, false),
        "dat" => table::parse(&file.text, true),
        "dxf" => dxf::parse(&file.text, layer),
        "svg" => svg::parse(&file.text, layer),
        _ => Err(Fault::new(1, format!("the ending `.{}`", shortened(&ending)), ".csv, .txt, .dat, .dxf or .svg")),
    }
}

/// The points of a body, and what was understood of a file.
fn understood(file: &DataFile, asked: &Asked, closed: bool) -> Result<(Vec<[f64; 2]>, Settled), Fault> {
    let Asked { unit, layer } = *asked;
    let drawing = read(file, layer)?;
    let notes = drawing.notes().into_iter().map(|what| format!("{KEY} {:?}: {what}", file.name)).collect();
    if let (Some(wanted), Some(stated), Some(line)) = (unit, drawing.unit, drawing.unit_line)
        && (wanted - stated).abs() > 1e-9 * wanted
    {
        let [wanted, stated] = [wanted, stated].map(significant);
        let expected = format!("that of {UNIT_KEY}, {wanted} m, or no {UNIT_KEY} beside such a header");
        return Err(Fault::new(line, format!("a unit of {stated} m in the header"), expected));
    }
    let (format, unit) = (drawing.format, unit.or(drawing.unit).unwrap_or(1.0));
    let line: Vec<Placed> = drawing.joined()?.into_iter().map(|(k, point)| (k, point.map(|x| x * unit))).collect();
    let in_file: Vec<[f64; 2]> = line.iter().map(|(_, point)| *point).collect();
    let last = line.last().map_or(1, |(k, _)| *k);
    let [low, high] = polygon::bounding_box(&in_file);
    let same = SAME_POINT * (high[0] - low[0]).hypot(high[1] - low[1]);
    let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut kept: Vec<Placed> = Vec::new();
    for (k, point) in &line {
        if kept.last().is_none_or(|(_, before)| apart(*before, *point) > same) {
            kept.push((*k, *point));
        }
    }
    let duplicates_merged = line.len() - kept.len();
    let ends_meet = kept.len() > 1 && apart(kept[0].1, kept[kept.len() - 1].1) <= same;
    let mut stations = in_file.clone();
    if closed && ends_meet {
        kept.pop();
        stations.pop();
    }
    let least = if closed { 3 } else { 2 };
    if kept.len() < least {
        return Err(Fault::new(last, format!("{} different points", kept.len()), format!("at least {least} points")));
    }
    if kept.len() > MOST_POINTS {
        return Err(Fault::new(last, format!("{} points", kept.len()), format!("at most {MOST_POINTS} points")));
    }
    let mut points: Vec<[f64; 2]> = kept.iter().map(|(_, point)| *point).collect();
    let closed_by_side_m = (closed && !ends_meet).then(|| apart(points[0], points[points.len() - 1]));
    let mut reversed = false;
    if closed {
        refuse_crossing(&kept, &points)?;
        reversed = polygon::signed_area(&points) < 0.0;
        if reversed {
            points.reverse();
        }
        if polygon::signed_area(&points) <= 0.0 {
            return Err(Fault::new(last, "points on one line", "an outline around an area"));
        }
    }
    let report = OutlineReport {
        file: file.name.to_string(),
        format,
        unit_m: unit,
        points_in_file: in_file.len(),
        points: points.len(),
        duplicates_merged,
        closed_by_side_m,
        orientation_changed: reversed,
        bounding_box_m: [low, high],
        area_m2: closed.then(|| polygon::signed_area(&points)),
    };
    Ok((points, Settled { report, stations: Stations { points: stations, reversed, closed }, notes }))
}

/// Refuses an outline that crosses or touches itself, with the place and the lines of both sides.
fn refuse_crossing(kept: &[Placed], points: &[[f64; 2]]) -> Result<(), Fault> {
    let Some((i, j)) = polygon::first_crossing(points) else { return Ok(()) };
    let next = |k: usize| (k + 1) % points.len();
    let [x, y] = meeting([points[i], points[next(i)]], [points[j], points[next(j)]]).map(significant);
    let (one, other) = (kept[i].0, kept[j].0);
    let given = format!("the side from line {one} meets the side from line {other} at [{x}, {y}] m");
    Err(Fault::new(other, given, "an outline that does not cross itself"))
}

/// The place where two sides meet; of parallel ones the start of the second.
fn meeting([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> [f64; 2] {
    let (u, v, w) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]], [c[0] - a[0], c[1] - a[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    if cross == 0.0 {
        return c;
    }
    let share = (w[0] * v[1] - w[1] * v[0]) / cross;
    [a[0] + share * u[0], a[1] + share * u[1]]
}

impl OutlineReport {
    /// As lines of text.
    pub fn to_text(&self) -> String {
        let [low, high] = self.bounding_box_m.map(|corner| corner.map(significant));
        let area = self.area_m2.map_or(String::new(), |area| format!(", area {} m²", significant(area)));
        let mut notes = vec![match self.duplicates_merged {
            0 => "no point twice".to_string(),
            count => format!("{count} repeated points merged"),
        }];
        notes.push(if self.orientation_changed { "turned counter-clockwise".into() } else { "order kept".into() });
        notes.extend(self.closed_by_side_m.map(|side| format!("closed by a straight side of {} m", significant(side))));
        format!(
            "outline      {} ({}, unit {} m): {} points in the file, {} used; {}\n             x from {} to {} m, y from {} to {} m{area}",
            self.file,
            self.format,
            significant(self.unit_m),
            self.points_in_file,
            self.points,
            notes.join(", "),
            low[0],
            high[0],
            low[1],
            high[1]
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(name: &str, text: &str) -> Result<(Vec<[f64; 2]>, Settled), Fault> {
        let file = DataFile { key: KEY, name, text: text.to_string() };
        understood(&file, &Asked::default(), true)
    }

    #[test]
    fn a_clockwise_outline_with_repeated_points_is_cleaned() {
        let (points, settled) =
            outline("a.csv", "x_mm,y_mm\n0,0\n0,0\n0,500\n1000,500\n1000,0\n0,0\n").expect("points");
        assert_eq!(points, [[1.0, 0.0], [1.0, 0.5], [0.0, 0.5], [0.0, 0.0]]);
        let report = settled.report;
        assert!(report.orientation_changed && report.duplicates_merged == 1 && report.closed_by_side_m.is_none());
        assert_eq!((report.area_m2, report.points_in_file, settled.stations.points.len()), (Some(0.5), 6, 5));
    }

    #[test]
    fn an_open_outline_is_closed_and_one_that_crosses_is_refused_with_the_place() {
        let (_, settled) = outline("a.csv", "0,0\n1,0\n1,1\n").expect("points");
        assert!((settled.report.closed_by_side_m.expect("a side") - 2.0_f64.sqrt()).abs() < 1e-15);
        let fault = outline("a.csv", "0,0\n1,1\n1,0\n0,1\n").expect_err("a bow tie");
        assert!(
            fault.line == 3 && fault.given.contains("from line 1 meets") && fault.given.contains("[0.5, 0.5]"),
            "{fault:?}"
        );
        assert!(outline("a.csv", "0,0\n1,1\n2,2\n").is_err());
        assert!(outline("a.csv", "0,0\n1,1\n").is_err());
        assert!(outline("a.stp", "0,0\n1,1\n").is_err());
    }
}
