//! Where the pictures of the flow look: at the impact and the body, wherever the body goes.

use scene::{Motion, Scene, Symmetry};

/// Width over height of the pictures.
pub(super) const ASPECT: f64 = 1.9;
/// Width of a picture in breadths of the body and in fine zones, at least [-].
const BREADTHS: f64 = 2.2;
const ZONES: f64 = 2.6;
/// A picture is at most this many times as wide, to hold both a body and the surface far from it [-].
const WIDEST: f64 = 3.0;
/// Share of the width by which a body must move sideways for the camera to follow [-].
const STILL: f64 = 0.1;

/// A part of space: its middle x, y and its width [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// Middle [m].
    pub middle: [f64; 2],
    /// Width [m].
    pub width: f64,
}

impl View {
    /// Left and right, bottom and top [m].
    pub fn window(&self) -> [[f64; 2]; 2] {
        let [x, y] = self.middle;
        let (half, rise) = (0.5 * self.width, 0.5 * self.width / ASPECT);
        [[x - half, x + half], [y - rise, y + rise]]
    }
}

/// The view of the whole tank, and its height [m]; `top` is the highest that anything comes.
pub(super) fn whole(scene: &Scene, top: f64) -> (View, f64) {
    let tank = &scene.tank;
    let (margin, low) = (0.03 * tank.width, -tank.depth);
    let high = (tank.height - tank.depth).max(top).min(2.0 * tank.width);
    let height = high - low + 2.0 * margin;
    let view = View { middle: [0.0, 0.5 * (low + high)], width: (tank.width + 2.0 * margin).max(ASPECT * height) };
    (view, height)
}

/// A view for each frame, from the boxes of the body in it: low corner and high corner [m].
pub(super) fn views(scene: &Scene, boxes: &[Option<[[f64; 2]; 2]>], top: f64) -> Vec<View> {
    let whole = whole(scene, top).0;
    let [fine, _] = scene.resolution.fine_zone;
    let graded = scene.resolution.growth > 1.0 && fine < 0.4 * scene.tank.width;
    let moves = scene.body.as_ref().is_some_and(|body| !matches!(body.motion, Motion::Fixed));
    let near = scene.model.is_theory() || graded && moves;
    if !near {
        return vec![whole; boxes.len()];
    }
    let known: Vec<[[f64; 2]; 2]> = boxes.iter().flatten().copied().collect();
    let Some(first) = known.first() else { return vec![whole; boxes.len()] };
    let breadth = known.iter().map(|[low, high]| high[0] - low[0]).fold(0.0, f64::max);
    let zone = if scene.model.is_theory() { 0.0 } else { ZONES * fine };
    let usual = (BREADTHS * breadth).max(zone).min(whole.width);
    let center = |[low, high]: &[[f64; 2]; 2]| 0.5 * (low[0] + high[0]);
    let travels = known.iter().any(|body| (center(body) - center(first)).abs() > STILL * usual);
    let mut last = *first;
    let view = |body: &Option<[[f64; 2]; 2]>| {
        last = body.unwrap_or(last);
        let [low, high] = last;
        let rise = usual / ASPECT;
        let (bottom, ceiling) = (low[1].min(0.0) - 0.3 * rise, high[1].max(0.15 * rise) + 0.06 * rise);
        // a body that is high for its breadth shows its lower part
        let ceiling = ceiling.min(low[1].max(0.0) + 1.2 * rise);
        let width = usual.max(ASPECT * (ceiling - bottom)).min(WIDEST * usual);
        let height = width / ASPECT;
        // where both do not fit, the body does
        let middle = (0.5 * (bottom + ceiling)).clamp(low[1] - 0.3 * height, low[1] + 0.3 * height);
        let x = match (scene.symmetry, travels) {
            (Symmetry::X, _) => 0.0,
            (_, true) => center(&last),
            _ => center(first),
        };
        View { middle: [x, middle], width }
    };
    boxes.iter().map(view).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body at 40 m/s sideways, one that falls from high, one that dives: each is in every picture, with the surface near it.
    #[test]
    fn the_body_is_in_every_picture() {
        let scene = run::load("wedge", &["symmetry=none".to_string()]).expect("a scene").scene;
        let body = |x: f64, y: f64| Some([[x - 0.25, y], [x + 0.25, y + 0.34]]);
        for (u, v) in [(40.0, 0.0), (0.0, -40.0), (0.0, -6.0), (40.0, -5.0)] {
            let boxes: Vec<_> = (0..50).map(|k| f64::from(k) * 0.001).map(|t| body(u * t, v * t)).collect();
            for (view, shown) in views(&scene, &boxes, 0.5).iter().zip(&boxes) {
                let ([x, y], [low, high]) = (view.window(), shown.expect("a box"));
                assert!(x[0] < low[0] && x[1] > high[0], "{u}, {v}: {x:?} {low:?} {high:?}");
                assert!(y[0] < low[1] && y[1] > low[1], "{u}, {v}: {y:?} {low:?} {high:?}");
                assert!(low[1] < -0.5 || (y[0] < 0.0 && y[1] > 0.0), "{u}, {v}: no surface in {y:?}");
            }
        }
    }
}
