//! Stations whose section is an outline in a file: their keys before the landing is read.

use scene::outline_of_section;
use serde_json::{Value, json};
use settings::Problem;
use water_entry::ditching::HalfSection;

/// Replaces `outline` of each station by its points, and fills in `keel` and `breadth` where the outline gives them.
pub(super) fn settle(given: &mut Value, scene_file: &str) -> Result<(), Problem> {
    let stations = given.get_mut("stations").and_then(Value::as_array_mut);
    for (k, station) in stations.into_iter().flatten().enumerate() {
        let key = |name: &str| format!("stations[{k}].{name}");
        let Some(station) = station.as_object_mut() else { continue };
        let name = station.get("outline").cloned();
        if let Some(beside) = name.as_ref().and(station.get("points")) {
            return Err(Problem::new(&key("points"), beside, "no points beside an outline: the file has them"));
        }
        let unit = station.get("outline_unit").cloned();
        let half = match (name.as_ref().map(Value::as_str), &unit) {
            (Some(Some(name)), unit) => {
                let unit_key = key("outline_unit");
                let unit = unit.as_ref().map(|unit| (unit_key.as_str(), unit));
                let around = outline_of_section(scene_file, &key("outline"), name, unit)?;
                let half = HalfSection::of_outline(&around);
                Some(half.map_err(|expected| Problem::new(&key("outline"), format!("{name:?}"), expected))?)
            }
            (None, Some(unit)) => return Err(Problem::new(&key("outline_unit"), unit, "stations[].outline beside it")),
            // points in the file itself; what the schema refuses is left to it
            (None, None) => points(station.get("points")).map(|points| HalfSection { points, keel: f64::NAN }),
            (Some(None), _) => None,
        };
        let Some(half) = half else { continue };
        if !half.keel.is_nan() {
            station.entry("keel").or_insert(json!(half.keel));
        }
        station.entry("breadth").or_insert_with(|| json!(half.breadth()));
        station.insert("points".into(), json!(half.points));
        station.remove("outline");
        station.remove("outline_unit");
    }
    Ok(())
}

/// Points that may be a half section.
fn points(given: Option<&Value>) -> Option<Vec<[f64; 2]>> {
    let points: Vec<[f64; 2]> = serde_json::from_value(given?.clone()).ok()?;
    is_half_section(&points).then_some(points)
}

/// From the keel at the origin outwards.
pub(super) fn is_half_section(points: &[[f64; 2]]) -> bool {
    let finite = points.iter().flatten().all(|v| v.is_finite());
    finite
        && points.len() > 1
        && points[0] == [0.0, 0.0]
        && points[1][0] > 0.0
        && points.iter().all(|p| p[0] >= 0.0 && p[1] >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_station_give_its_breadth() {
        let mut given = json!({"stations": [{"x": 0.0, "keel": 1.0, "points": [[0.0, 0.0], [1.0, 0.4], [1.0, 2.0]]}]});
        settle(&mut given, "landing.toml").expect("points");
        assert_eq!(given["stations"][0]["breadth"], 2.0);
        assert!(!is_half_section(&[[0.0, 0.1], [1.0, 0.4]]));
    }
}
