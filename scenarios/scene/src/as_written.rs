//! Problems in the keys that a scene's text has, where the program has replaced these by others.

use serde_json::Value;
use settings::Problem;

use super::outline::OutlineReport;
use super::source::{Segment, segments};

/// A problem of `body.points` or `body.displacements` in a scene that names a file, and of a panel's end in one that numbers points, in its own words.
pub(super) fn as_written(problem: Problem, written: &Value, outline: Option<&OutlineReport>) -> Problem {
    let given = problem.given.as_deref().unwrap_or_default();
    if let (Some(file), "body.points") = (outline, problem.key.as_str()) {
        return Problem::new("body.outline", format!("{:?}: {given}", file.file), &problem.expected);
    }
    let file = written.pointer("/body/motion_file").filter(|_| problem.key == "body.displacements");
    if let Some(file) = file {
        return Problem::new("body.motion_file", format!("{file}: {given}"), &problem.expected);
    }
    let steps: Vec<Segment> = segments(&problem.key).collect();
    let [Segment::Key("body"), Segment::Key("panels"), Segment::Index(index), Segment::Key(end @ ("from" | "to"))] =
        steps[..]
    else {
        return problem;
    };
    // a file that goes clockwise is turned, and its panels with it
    let turned = outline.is_some_and(|outline| outline.orientation_changed);
    let name = if (end == "from") == turned { "to_point" } else { "from_point" };
    let Some(number) = written.pointer(&format!("/body/panels/{index}/{name}")) else { return problem };
    let expected = problem
        .expected
        .replace("from and to", "from_point and to_point")
        .replace("another point than from", "another point than that of the other end")
        .replace("a point after from", "a point after that of from_point");
    Problem::new(&format!("body.panels[{index}].{name}"), format!("{number}, the point {given}"), expected)
}
