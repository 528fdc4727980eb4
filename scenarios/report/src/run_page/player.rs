//! The animation with its controls, the picture that stands for it without a script, and a few moments side by side.

use super::camera::ASPECT;
use super::flow::{Flow, picture};
use super::folder::RunFolder;
use super::packed::{Packed, pack};
use super::quantity::{digits, with_unit};
use crate::flow_figure::flow_svg;
use crate::markup::escape;
use crate::{Block, colour};

/// Width of the picture that stands for the animation, and of one of the moments [pixels].
const STILL: u32 = 1100;
const MOMENT: u32 = 600;
/// Moments shown side by side.
const MOMENTS: usize = 4;
/// Stops of the colour bar.
const STOPS: usize = 16;

/// The animation; it begins, and stands without a script, at the moment of the largest force.
pub(super) fn player(run: &mut RunFolder, flow: &Flow) -> String {
    let Packed { head, frames } = pack(&run.scene, flow);
    let time = flow.moments.get(flow.still).map_or(0.0, |m| m.time);
    let still = run.log.as_mut().and_then(|log| picture(&run.scene, log, flow, flow.still, STILL));
    let still = still.map_or(String::new(), |(frame, view)| flow_svg(&frame, &view));
    let thinned = match flow.share < 1.0 {
        true => format!(" Of the particles {} % are shown, larger.", digits(100.0 * flow.share)),
        false => String::new(),
    };
    let shown = flow.moments.iter().any(|m| !m.particles.is_empty());
    let mirrored =
        if flow.mirror && shown { " Only x ≥ 0 was computed; the other half is its mirror image." } else { "" };
    let here = with_unit(time, "s");
    let which = match flow.peak {
        Some((what, at)) => format!("At first the frame at {here}, nearest to the {what} ({}).", with_unit(at, "s")),
        None => format!("At first the last frame, at {here}."),
    };
    let beyond = match shown && flow.most[0] > flow.top[0] {
        true => format!(
            " The colours of pressure end at {}; the largest pressure of a particle in these frames is {}.",
            with_unit(flow.top[0], "Pa"),
            with_unit(flow.most[0], "Pa")
        ),
        false => String::new(),
    };
    let caption = format!("{which}{beyond}{mirrored}{thinned}");
    let stops: Vec<String> = (0..=STOPS).map(|k| colour::hex(colour::viridis(k as f64 / STOPS as f64))).collect();
    format!(
        include_str!("player.html"),
        still = still,
        aspect = ASPECT,
        stops = stops.join(", "),
        caption = escape(&caption),
        head = head,
        frames = frames
    )
}

/// Pictures at equal intervals.
pub(super) fn moments(run: &mut RunFolder, flow: &Flow) -> Vec<Block> {
    let last = flow.moments.len() - 1;
    let mut chosen: Vec<usize> = (1..=MOMENTS).map(|k| k * last / MOMENTS).collect();
    chosen.dedup();
    let mut blocks = Vec::new();
    for k in chosen {
        let drawn = run.log.as_mut().and_then(|log| picture(&run.scene, log, flow, k, MOMENT));
        let Some((frame, view)) = drawn.filter(|(frame, _)| !frame.x.is_empty()) else { continue };
        let caption = format!("Pressure at {}", with_unit(frame.time, "s"));
        blocks.push(Block::Drawing { svg: flow_svg(&frame, &view), caption });
    }
    blocks
}
