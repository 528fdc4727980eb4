//! Where the panels are on the outline of their body.

use super::flow::Flow;
use crate::scene::Scene;

/// Pieces of the outline that are panels: the loop, and its first and last corner, counted on beyond the end of the loop.
pub(super) fn pieces(scene: &Scene, flow: &Flow) -> Vec<[usize; 3]> {
    let Some((body, first)) = scene.body.as_ref().zip(flow.moments.first()) else { return Vec::new() };
    // the first frame is the body at its start, undeformed but for its weight
    let start = scene.motion_at_start(body);
    let piece = |panel: &crate::scene::Panel| {
        let ends = [panel.from, panel.to].map(|end| start.point(end));
        let nearest = |points: &[[f64; 2]], to: [f64; 2]| {
            let distance = |p: &[f64; 2]| (p[0] - to[0]).hypot(p[1] - to[1]);
            let k = (0..points.len()).min_by(|a, b| distance(&points[*a]).total_cmp(&distance(&points[*b])))?;
            Some((k, distance(&points[k])))
        };
        let found = |(index, points): (usize, &Vec<[f64; 2]>)| {
            let ((from, a), (to, b)) = (nearest(points, ends[0])?, nearest(points, ends[1])?);
            Some((a + b, [index, from, if to < from { to + points.len() } else { to }]))
        };
        let best = first.outlines.iter().enumerate().filter_map(found).min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(best.1)
    };
    body.panels.iter().filter_map(piece).collect()
}
