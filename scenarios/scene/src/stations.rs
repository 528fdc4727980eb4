//! Panels between numbered points of an outline: `from_point` and `to_point`.

use serde_json::{Map, Value, json};
use settings::{Problem, require};

use super::outline::Stations;

/// The points that a scene gives in its own text; none where these are wrong, which the schema says.
pub(super) fn written(given: &Value) -> Option<Stations> {
    let body = given.get("body")?;
    let points = serde_json::from_value(body.get("points")?.clone()).unwrap_or_default();
    let plate = body.get("shape").is_some_and(|shape| shape == "polyline");
    Some(Stations { points, reversed: false, closed: !plate })
}

/// Replaces the numbered points of panels by their places.
pub(super) fn settle(given: &mut Value, stations: Option<&Stations>) -> Result<(), Problem> {
    let panels = given.get_mut("body").and_then(|body| body.get_mut("panels")).and_then(Value::as_array_mut);
    for (i, panel) in panels.into_iter().flatten().enumerate() {
        if let Some(panel) = panel.as_object_mut() {
            settle_panel(panel, stations, |name| format!("body.panels[{i}].{name}"))?;
        }
    }
    Ok(())
}

fn settle_panel(
    panel: &mut Map<String, Value>,
    stations: Option<&Stations>,
    key: impl Fn(&str) -> String,
) -> Result<(), Problem> {
    let number = |name: &str| panel.get(name).and_then(Value::as_f64);
    let (from, to) = match (number("from_point"), number("to_point")) {
        (Some(from), Some(to)) => (from, to),
        (Some(from), None) if !panel.contains_key("to_point") => {
            return Err(Problem::new(&key("from_point"), from, "to_point beside it"));
        }
        (None, Some(to)) if !panel.contains_key("from_point") => {
            return Err(Problem::new(&key("to_point"), to, "from_point beside it"));
        }
        _ => return Ok(()), // none, or what the schema refuses
    };
    for name in ["from", "to"] {
        let expected = format_args!("none beside {name}_point");
        require(!panel.contains_key(name), &key(name), panel.get(name).unwrap_or(&Value::Null), expected)?;
    }
    let Some(stations) = stations else {
        return Err(Problem::new(
            &key("from_point"),
            from,
            "from and to here: only body.outline and body.points have numbered points",
        ));
    };
    if stations.points.is_empty() {
        return Ok(());
    }
    let place = |name: &str, number: f64| {
        let count = stations.points.len();
        let inside = number >= 1.0 && number <= count as f64;
        let expected = format_args!("a number from 1 to {count}, the points of the outline");
        require(inside, &key(name), number, expected).map(|()| at(&stations.points, number))
    };
    let mut ends = [place("from_point", from)?, place("to_point", to)?];
    let ahead = from < to || stations.closed && from != to;
    require(ahead, &key("to_point"), to, "another point than from_point, behind it on a plate")?;
    panel.remove("from_point");
    panel.remove("to_point");
    if stations.reversed {
        ends.reverse();
        turn_round(panel);
    }
    panel.insert("from".into(), json!(ends[0]));
    panel.insert("to".into(), json!(ends[1]));
    Ok(())
}

/// The place of a point number, counted from 1; between two points on the straight line.
fn at(points: &[[f64; 2]], number: f64) -> [f64; 2] {
    let k = (number.floor() as usize).clamp(1, points.len()) - 1;
    let next = points[(k + 1).min(points.len() - 1)];
    let share = number - number.floor();
    [0, 1].map(|i| points[k][i] + share * (next[i] - points[k][i]))
}

/// What a panel says of its two ends and along its length, from the other end.
fn turn_round(panel: &mut Map<String, Value>) {
    for name in ["ends", "end_springs", "end_dampers"] {
        panel.get_mut(name).and_then(Value::as_array_mut).into_iter().for_each(|ends| ends.reverse());
    }
    for share in panel.get_mut("watch").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(value) = share.as_f64() {
            *share = json!(1.0 - value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(reversed: bool, panel: Value) -> Result<Value, String> {
        let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mut scene = json!({"body": {"panels": [panel]}});
        settle(&mut scene, Some(&Stations { points, reversed, closed: true })).map_err(|problem| problem.sentence)?;
        Ok(scene["body"]["panels"][0].clone())
    }

    #[test]
    fn numbers_become_places_also_between_points() {
        let panel = settled(false, json!({"from_point": 1, "to_point": 2.5})).expect("a panel");
        assert_eq!(panel, json!({"from": [0.0, 0.0], "to": [1.0, 0.5]}));
    }

    #[test]
    fn a_reversed_outline_turns_the_panel_round() {
        let given = json!({"from_point": 1, "to_point": 3, "ends": ["clamped", "free"], "watch": [0.25]});
        let panel = settled(true, given).expect("a panel");
        assert_eq!(panel, json!({"from": [1.0, 1.0], "to": [0.0, 0.0], "ends": ["free", "clamped"], "watch": [0.75]}));
    }

    #[test]
    fn points_that_are_not_there_are_refused() {
        for (panel, part) in [
            (json!({"from_point": 0, "to_point": 2}), "`body.panels[0].from_point` = 0: expected a number from 1 to 4"),
            (json!({"from_point": 1, "to_point": 9}), "to_point` = 9"),
            (json!({"from_point": 1}), "to_point beside it"),
            (json!({"from_point": 2, "to_point": 2}), "another point"),
            (json!({"from_point": 1, "to_point": 2, "to": [0, 0]}), "none beside to_point"),
        ] {
            let sentence = settled(false, panel).expect_err(part);
            assert!(sentence.contains(part), "{sentence}");
        }
    }
}
