//! An outline from a file that the page hands over.

use std::path::Path;

use serde_json::{Value, json};

use crate::scratch::Scratch;

/// Endings of files with points.
const ENDINGS: [&str; 5] = ["csv", "txt", "dat", "dxf", "svg"];
/// Name of the file beside a scene that is not there.
const NAME: &str = "outline";

/// The points of a file, or what is wrong with it.
pub fn read(name: &str, unit: Option<&str>, content: &[u8]) -> Value {
    match points(name, unit, content) {
        Ok(points) => json!({"points": points, "error": null}),
        Err(why) => json!({"points": null, "error": why}),
    }
}

fn points(name: &str, unit: Option<&str>, content: &[u8]) -> Result<Vec<[f64; 2]>, String> {
    let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !ENDINGS.contains(&ending.as_str()) {
        return Err(format!("{name}: expected a file that ends in .{}", ENDINGS.join(", .")));
    }
    let (scratch, file) = (Scratch::new()?, format!("{NAME}.{ending}"));
    std::fs::write(scratch.0.join(&file), content).map_err(|cause| cause.to_string())?;
    let unit = unit.filter(|unit| !unit.is_empty()).map(Value::from);
    let asked = unit.as_ref().map(|unit| ("body.outline_unit", unit));
    let found =
        scene::outline_of_section(&scratch.0.join("scene.toml").to_string_lossy(), "body.outline", &file, asked);
    // a reader knows the name that the file had
    found.map_err(|problem| problem.to_string().replace(&file, name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_file_are_those_of_an_outline_and_its_mistakes_have_a_line() {
        let square = b"x,y\n-1,0\n1,0\n1,1\n-1,1\n";
        let points = points("hull.csv", Some("mm"), square).expect("an outline");
        assert_eq!(points, [[-1e-3, 0.0], [1e-3, 0.0], [1e-3, 1e-3], [-1e-3, 1e-3]]);
        let wrong = read("hull.csv", None, b"x,y\n-1,0\n1,zero\n1,1\n")["error"].to_string();
        assert!(wrong.contains("hull.csv") && wrong.contains('3'), "{wrong}");
        assert!(read("../hull.exe", None, b"")["error"].to_string().contains("expected a file that ends in"));
    }
}
