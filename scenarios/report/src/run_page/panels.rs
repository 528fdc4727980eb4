//! Where the panels are on the outline of their body.

use run::log::LoggedBody;
use scene::{Body, Panel};

/// Pieces of the outlines of all bodies, one loop after another, that are panels of `body`: the loop, and its first and last corner,
/// counted on beyond the end of the loop.
pub(super) fn pieces(body: &Body, logged: &[LoggedBody]) -> Vec<[usize; 3]> {
    let Some(index) = logged.iter().position(|own| own.name == body.name) else { return Vec::new() };
    let (own, before) = (&logged[index], logged[..index].iter().map(|other| other.loops.len()).sum::<usize>());
    let nearest = |points: &[[f64; 2]], to: [f64; 2]| {
        let distance = |p: &[f64; 2]| (p[0] - to[0]).hypot(p[1] - to[1]);
        let k = (0..points.len()).min_by(|a, b| distance(&points[*a]).total_cmp(&distance(&points[*b])))?;
        Some((k, distance(&points[k])))
    };
    let piece = |panel: &Panel| {
        let ends = [panel.from, panel.to].map(|end| own.point(end));
        let found = |(k, points): (usize, &Vec<[f64; 2]>)| {
            let ((from, a), (to, b)) = (nearest(points, ends[0])?, nearest(points, ends[1])?);
            Some((a + b, [before + k, from, if to < from { to + points.len() } else { to }]))
        };
        let best = own.loops.iter().enumerate().filter_map(found).min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(best.1)
    };
    body.panels.iter().filter_map(piece).collect()
}

#[cfg(test)]
mod tests {
    use run::load;

    use super::*;

    #[test]
    fn a_panel_is_the_side_of_its_body_that_it_stands_on() {
        let scene = load("flexible_wedge", &[]).expect("a scene").scene;
        let body = scene.body.expect("a body");
        let moved = |[x, y]: [f64; 2]| [x + 1.0, y - 2.0];
        let corners = [[0.3, 0.3], [-0.3, 0.3], [-0.3, 0.109191], [0.0, 0.0], [0.15, 0.05], [0.3, 0.109191]];
        let logged = LoggedBody {
            name: body.name.clone(),
            position: [1.0, -2.0],
            angle: 0.0,
            loops: vec![corners.map(moved).to_vec()],
        };
        assert_eq!(pieces(&body, &[logged]), [[0, 3, 5]]);
    }
}
