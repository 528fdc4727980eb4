//! A body in a scene with `symmetry = "x"` is its own image; what is wrong with one that is not.

use fsi_coupling::geometry::polygon;
use settings::{Problem, require, significant};

use super::keys::Body;

/// A coordinate over the size of an outline that counts as 0 [-].
const ON_AXIS: f64 = 1e-6;

/// A pair of numbers as a scene has it, of which the first is not 0.
pub(super) fn on_axis(holds: bool, key: &str, [x, y]: [f64; 2]) -> Result<(), Problem> {
    require(holds, key, format_args!("[{x}, {y}]"), "[0, ...] with symmetry = \"x\"")
}

/// The body is upright, goes straight down, and is symmetric.
pub(super) fn check_symmetric(body: &Body) -> Result<(), Problem> {
    for (key, value) in
        [("body.angle_deg", body.angle_deg), ("body.angular_velocity_deg_per_s", body.angular_velocity_deg_per_s)]
    {
        require(value == 0.0, key, value, "0 with symmetry = \"x\"")?;
    }
    on_axis(body.velocity[0] == 0.0, "body.velocity", body.velocity)?;
    let [x, y] = body.position;
    let expected = "[0, ...] with symmetry = \"x\"; bodies side by side are given both, without symmetry";
    require(x == 0.0, "body.position", format_args!("[{x}, {y}]"), expected)?;
    let (outline, centre) = (body.shape.outline(), body.center_of_mass);
    if !polygon::is_mirror_symmetric(&outline) {
        let [given, expected] = lopsided(&outline);
        return Err(Problem::new("body.points", given, expected));
    }
    on_axis(centre[0].abs() <= 1e-9 * polygon::perimeter(&outline), "body.center_of_mass", centre)
}

/// True where all points are on one side of x = 0.
pub(super) fn is_half(outline: &[[f64; 2]]) -> bool {
    let [min, max] = polygon::bounding_box(outline);
    let close = ON_AXIS * (max[0] - min[0]).hypot(max[1] - min[1]);
    min[0] >= -close || max[0] <= close
}

/// What an outline is that is not its own image in x = 0, and what is expected.
fn lopsided(outline: &[[f64; 2]]) -> [String; 2] {
    let [min, max] = polygon::bounding_box(outline);
    let size = (max[0] - min[0]).hypot(max[1] - min[1]);
    let even = |of: &dyn Fn(&[f64; 2]) -> [f64; 2]| {
        polygon::is_mirror_symmetric(&outline.iter().map(of).collect::<Vec<[f64; 2]>>())
    };
    let middle = 0.5 * (min[0] + max[0]);
    let wanted = "a body symmetric about x = 0 with symmetry = \"x\"";
    if even(&|[x, y]| [*y, *x]) {
        let given = "a section that is symmetric about y = 0".into();
        return [given, format!("{wanted}: x and y may be swapped")];
    }
    if is_half(outline) {
        let side = if max[0] > ON_AXIS * size { ">=" } else { "<=" };
        let given = format!("half a section: all points have x {side} 0");
        return [
            given,
            format!("{wanted}: write the points of both halves; the program itself computes half of the water"),
        ];
    }
    if even(&|[x, y]| [x - middle, *y]) {
        let middle = significant(middle);
        return [format!("a section that is symmetric about x = {middle} m"), format!("{wanted}: move its points")];
    }
    let image = |p: &[f64; 2]| {
        let gap = |q: &[f64; 2]| (p[0] + q[0]).hypot(p[1] - q[1]);
        outline.iter().map(gap).fold(f64::INFINITY, f64::min)
    };
    let worst = outline.iter().copied().max_by(|a, b| image(a).total_cmp(&image(b))).unwrap_or_default();
    let [x, y, opposite] = [worst[0], worst[1], -worst[0]].map(significant);
    let given = format!("a lopsided body: [{x}, {y}] has no counterpart at [{opposite}, {y}]");
    [given, format!("{wanted}, or no symmetry")]
}

#[cfg(test)]
mod tests {
    use super::*;

    const HULL: [[f64; 2]; 5] = [[0.0, 0.0], [0.5, 0.2], [0.5, 0.4], [-0.5, 0.4], [-0.5, 0.2]];

    #[test]
    fn each_kind_of_lopsided_outline_is_reported_for_what_it_is() {
        for (points, part) in [
            (HULL.map(|[x, y]| [y, x]).to_vec(), "x and y may be swapped"),
            (HULL[..3].iter().copied().chain([[0.0, 0.4]]).collect(), "half a section: all points have x >= 0"),
            (HULL[3..].iter().copied().chain([[0.0, 0.0], [0.0, 0.4]]).collect(), "all points have x <= 0"),
            (HULL.map(|[x, y]| [x + 0.25, y]).to_vec(), "symmetric about x = 0.25 m"),
            ([&HULL[..4], &[[-0.5, 0.3]]].concat(), "[-0.5, 0.3] has no counterpart at [0.5, 0.3]"),
        ] {
            let notes = lopsided(&points).concat();
            assert!(notes.contains(part), "{part}: {notes}");
        }
    }
}
