//! The pictures of the flow in `report.html`.

use sph_core::parallel;

use crate::report::{Block, FlowFrame, FlowView, flow_svg};
use crate::scene::{Scene, Symmetry};

pub(super) fn pictures(scene: &Scene, frames: &[FlowFrame]) -> Vec<Block> {
    let mirror_x = scene.symmetry == Symmetry::X;
    let (x, y) = window(scene);
    let inside = |f: &FlowFrame, k: usize| {
        let at = if mirror_x { f.x[k].abs() } else { f.x[k] } as f64;
        at > x[0] && at < x[1] && (f.y[k] as f64) > y[0] && (f.y[k] as f64) < y[1]
    };
    let mut values: Vec<f32> =
        frames.iter().flat_map(|f| (0..f.x.len()).filter(|&k| inside(f, k)).map(|k| f.value[k])).collect();
    values.sort_by(f32::total_cmp);
    let top = values.get(values.len().saturating_sub(1) * 995 / 1000).map_or(1.0, |v| f64::from(*v).max(1e-6));
    let view = FlowView { x, y, value: [0.0, top], width_px: 1100, label: "pressure [kPa]".into(), mirror_x };
    let mut drawn = vec![String::new(); frames.len()];
    parallel::update_pieces(&mut drawn, 1, |k, svg| svg[0] = flow_svg(&frames[k], &view));
    let picture =
        |(f, svg): (&FlowFrame, _)| Block::Drawing { svg, caption: format!("Pressure at t = {:.5} s", f.time) };
    frames.iter().zip(drawn).map(picture).collect()
}

/// The part of the flow worth looking at [m]: the fine zone and as much again, or the whole tank.
fn window(scene: &Scene) -> ([f64; 2], [f64; 2]) {
    let (half, depth) = (0.5 * scene.tank.width, scene.tank.depth);
    let [fine, _] = scene.resolution.fine_zone;
    let graded = scene.resolution.growth > 1.0 && fine < 0.8 * half;
    match &scene.body {
        Some(body) if graded => {
            let (w, middle) = (1.3 * fine, body.middle());
            ([middle - w, middle + w], [-0.55 * w, 0.55 * w])
        }
        _ => {
            let margin = 0.03 * half;
            let top = (scene.tank.height - depth).min(2.0 * half - depth).max(0.1 * half);
            ([-half - margin, half + margin], [-depth - margin, top])
        }
    }
}
