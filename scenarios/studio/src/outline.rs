//! An outline from a file that the page hands over.

use std::path::Path;

use serde_json::{Value, json};

use crate::scratch::Scratch;

/// Endings of files with points.
const ENDINGS: [&str; 5] = ["csv", "txt", "dat", "dxf", "svg"];

/// The points of a file, or what is wrong with it.
pub fn read(name: &str, unit: Option<&str>, content: &[u8]) -> Value {
    match points(name, unit, content) {
        Ok(points) => {
            let whole = mirrored(&points);
            json!({"points": whole.as_ref().unwrap_or(&points), "mirrored": whole.is_some(), "error": null})
        }
        Err(why) => json!({"points": null, "mirrored": false, "error": why}),
    }
}

/// The whole of a section of which `half` has the points on one side of x = 0, its first there; `None` for others.
fn mirrored(half: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let size = half.iter().map(|[x, _]| x.abs()).fold(0.0, f64::max);
    let is_at_keel = |x: f64| x.abs() <= 1e-9 * size;
    let side = half.iter().map(|[x, _]| *x).find(|x| !is_at_keel(*x))?.signum();
    let is_half = half.iter().any(|[x, _]| is_at_keel(*x)) && half.iter().all(|[x, _]| side * x >= -1e-9 * size);
    is_half.then(|| {
        let images = half.iter().rev().filter(|[x, _]| !is_at_keel(*x)).map(|[x, y]| [-x, *y]);
        half.iter().copied().chain(images).collect()
    })
}

fn points(name: &str, unit: Option<&str>, content: &[u8]) -> Result<Vec<[f64; 2]>, String> {
    let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    if !ENDINGS.contains(&ending.as_str()) {
        return Err(format!("{name}: expected a file that ends in .{}", ENDINGS.join(", .")));
    }
    let (scratch, file) = (Scratch::new()?, format!("outline.{ending}"));
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
    fn half_a_section_is_mirrored() {
        let read = |text: &[u8]| read("hull.csv", None, text);
        let half = read(b"x,y\n0,0\n1,0.5\n1,1\n");
        assert_eq!(half["mirrored"], true);
        assert_eq!(half["points"].as_array().map(Vec::len), Some(5));
        assert_eq!(half["points"][4], json!([-1.0, 0.5]));
        assert_eq!(read(b"x,y\n-1,0\n1,0\n1,1\n-1,1\n")["mirrored"], false);
    }

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
