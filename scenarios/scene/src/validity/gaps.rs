//! Water between a body and what stands beside it, too thin for the particles in it.
//!
//! From two spacings on the force on a body at rest is Archimedes' to 0.1 %. Across 0.5 to 1.5 spacings it was 5 to 30 % off, and weakly
//! compressible it had the wrong sign.

use fsi_coupling::Shape;
use fsi_coupling::geometry::polygon;
use settings::significant;

use crate::keys::{Body, Motion, Scene, Symmetry};

/// Spacings across a gap from which its water is resolved [-].
const LEAST: f64 = 2.0;

/// A gap at t = 0.
struct Gap<'a> {
    body: &'a str,
    beside: String,
    width: f64,
}

/// Warnings about gaps, each with a spacing that would do; without that of [`gap_limit`].
pub(crate) fn gap_warnings(scene: &Scene) -> Vec<String> {
    let limit = gap_limit(scene);
    let words = narrow_gaps(scene).into_iter().map(|gap| gap.words(scene.resolution.spacing));
    words.filter(|words| Some(words) != limit.as_ref()).collect()
}

/// Why the force on a body that stays beside such a gap is not resolved.
pub(crate) fn gap_limit(scene: &Scene) -> Option<String> {
    let body = scene.body.as_ref().filter(|body| matches!(body.motion, Motion::Fixed))?;
    narrow_gaps(scene).iter().find(|gap| gap.body == body.name).map(|gap| gap.words(scene.resolution.spacing))
}

impl Gap<'_> {
    fn words(&self, spacing: f64) -> String {
        let Gap { body, beside, width } = self;
        let measured = "where it is less than 2, forces were 5 to 30 % off";
        let across = significant(width / spacing);
        match *width > 0.1 * spacing {
            true => format!(
                "between {body} and {beside} are {across} spacings: {measured}; {} m would do for resolution.spacing",
                significant(width / LEAST)
            ),
            false => format!("{body} and {beside} touch, or nearly: {measured}; no water presses on what touches"),
        }
    }
}

/// Gaps beside the parts of closed bodies that are under water.
fn narrow_gaps(scene: &Scene) -> Vec<Gap<'_>> {
    let closed: Vec<(&Body, Vec<[f64; 2]>)> = scene
        .all_bodies()
        .filter(|body| !matches!(body.shape, Shape::Polyline { .. }))
        .map(|body| (body, body.placed_outline()))
        .filter(|(_, outline)| outline.iter().any(|at| at[1] < 0.0))
        .collect();
    let mut gaps = Vec::new();
    for (k, (body, outline)) in closed.iter().enumerate() {
        let [min, max] = polygon::bounding_box(outline);
        let half = 0.5 * scene.tank.width;
        let left = min[0] + half;
        let sides = [
            ("the floor", min[1] + scene.tank.depth),
            ("the left wall", if scene.symmetry == Symmetry::X { f64::INFINITY } else { left }),
            ("the right wall", half - max[0]),
            ("the surface", if max[1] < 0.0 { -max[1] } else { f64::INFINITY }),
        ];
        let fixed = sides.map(|(beside, width)| (beside.to_string(), width)).into_iter();
        let others = closed[k + 1..].iter().map(|(other, theirs)| (other.name.clone(), distance(outline, theirs)));
        gaps.extend(fixed.chain(others).map(|(beside, width)| Gap { body: &body.name, beside, width }));
    }
    let narrow = LEAST * scene.resolution.spacing * (1.0 - 1e-9);
    gaps.retain(|gap| gap.width < narrow && gap.width > -0.5 * scene.resolution.spacing);
    gaps
}

/// Least distance of two outlines that do not overlap [m]: from a corner of one.
fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let from = |corners: &[[f64; 2]], outline: &[[f64; 2]]| {
        let to = |p: &[f64; 2]| {
            let q = polygon::nearest_point(outline, *p);
            (q[0] - p[0]).hypot(q[1] - p[1])
        };
        corners.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    from(a, b).min(from(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_text;

    fn scene(position: [f64; 2], more: &str) -> Scene {
        let text = format!(
            "name = 'gap'\n[time]\nend = 0.1\n[resolution]\nspacing = 0.01\n[tank]\nwidth = 1.0\ndepth = 0.5\n[body]\nname = 'box'\n\
             shape = 'box'\nbreadth = 0.2\nheight = 0.1\nmotion = 'fixed'\nposition = {position:?}\n{more}"
        );
        load_text("gap", &text, &[]).expect("a scene").scene
    }

    #[test]
    fn a_gap_thinner_than_two_spacings_is_reported_and_a_wider_one_is_not() {
        // the frame's origin is the box's centre
        assert_eq!([[0.0, -0.25], [0.0, -0.43]].map(|at| gap_limit(&scene(at, ""))), [None, None]);
        for (at, beside) in [
            ([0.0, -0.435], "the floor are 1.5 spacings"),
            ([0.0, -0.45], "the floor touch, or nearly"),
            ([-0.39, -0.25], "the left wall are 1 spacings"),
            ([0.385, -0.25], "the right wall are 1.5 spacings"),
            ([0.0, -0.06], "the surface are 1 spacings"),
        ] {
            let near = scene(at, "");
            let warned = gap_limit(&near).expect("a limit");
            assert!(warned.contains(beside) && gap_warnings(&near).is_empty(), "{warned}");
        }
        let other = "[[bodies]]\nname = 'other'\nshape = 'box'\nbreadth = 0.1\nheight = 0.1\nmotion = 'fixed'\nposition = [0.165, -0.25]\n";
        assert!(
            gap_limit(&scene([0.0, -0.25], other))
                .is_some_and(|warned| warned.contains("box and other are 1.5 spacings"))
        );
    }
}
