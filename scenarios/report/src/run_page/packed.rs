//! The animation's frames as text: 16 bits per coordinate, 8 per value and size, differences from the frame before, compressed, base64.

use std::collections::BTreeSet;
use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use scene::Scene;
use serde_json::json;

use super::flow::{Flow, Moment};
use crate::colour::{hex, viridis};
use crate::ticks::{nice_step, tick_label, ticks};

/// Largest coordinate on the grid; the next number stands for a particle that is not there.
const GRID: f64 = 65_534.0;
const ABSENT: u16 = u16::MAX;
/// Colours that the page interpolates between.
const COLOURS: usize = 33;

/// The animation: what the script reads first, as JSON, and the frames.
pub(super) struct Packed {
    pub head: String,
    pub frames: String,
}

/// Pack the frames of a flow.
pub(super) fn pack(scene: &Scene, flow: &Flow) -> Packed {
    let moments = &flow.moments;
    let ids: Vec<u32> =
        moments.iter().flat_map(|m| m.particles.iter().map(|p| p.id)).collect::<BTreeSet<_>>().into_iter().collect();
    let place = |id: u32| ids.binary_search(&id).ok();
    let [low, high] = grid(scene, flow);
    let sizes = || moments.iter().flat_map(|m| &m.particles).map(|p| f64::from(p.size.max(1e-9)));
    let (least, most) = sizes().fold((f64::MAX, 1e-9), |(l, m), s| (s.min(l), s.max(m)));
    let (least, most) = (least.min(most), most * (1.0 + 1e-6));
    let code_of_size =
        |size: f32| (255.0 * (f64::from(size.max(1e-9)) / least).ln() / (most / least).ln()).round() as u8;
    let mut bytes = Vec::new();
    // places x and y; pressure, speed and size
    let mut before = (
        [vec![0_u16; ids.len()], vec![0_u16; ids.len()]],
        [vec![0_u8; ids.len()], vec![0; ids.len()], vec![0; ids.len()]],
    );
    for moment in moments {
        let mut now = before.clone();
        now.0[0].fill(ABSENT);
        for p in &moment.particles {
            let Some(k) = place(p.id) else { continue };
            let at = [0, 1].map(|i| GRID * (f64::from(p.at[i]) - low[i]) / (high[i] - low[i]));
            if at.iter().all(|v| (0.0..=GRID).contains(v)) {
                (now.0[0][k], now.0[1][k]) = (at[0].round() as u16, at[1].round() as u16);
                now.1[0][k] = (255.0 * f64::from(p.pressure) / flow.top[0]).round() as u8;
                now.1[1][k] = (255.0 * f64::from(p.speed) / flow.top[1]).round() as u8;
                now.1[2][k] = code_of_size(p.size);
            }
        }
        for (now, before) in now.0.iter().zip(&before.0) {
            let change = || now.iter().zip(before).map(|(a, b)| a.wrapping_sub(*b));
            bytes.extend(change().map(|d| d as u8));
            bytes.extend(change().map(|d| (d >> 8) as u8));
        }
        for (now, before) in now.1.iter().zip(&before.1) {
            bytes.extend(now.iter().zip(before).map(|(a, b)| a.wrapping_sub(*b)));
        }
        before = now;
    }
    for point in moments.iter().flat_map(|m| m.outlines.iter().flatten()) {
        bytes.extend(point.iter().flat_map(|v| (*v as f32).to_le_bytes()));
    }
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let written = encoder.write_all(&bytes).and_then(|()| encoder.finish());
    Packed {
        head: head(scene, flow, [low, high], [least, most], ids.len()),
        frames: STANDARD.encode(written.unwrap_or_default()), // writing into memory does not fail
    }
}

/// Corners of the box in which particles are shown: the tank up to the highest view [m].
fn grid(scene: &Scene, flow: &Flow) -> [[f64; 2]; 2] {
    let (half, depth) = (0.51 * scene.tank.width, scene.tank.depth);
    let top = flow.moments.iter().map(|m| m.view.window()[1][1]).fold(flow.whole.0.window()[1][1], f64::max);
    [[-half, -1.02 * depth], [half, top]]
}

fn head(scene: &Scene, flow: &Flow, [low, high]: [[f64; 2]; 2], size: [f64; 2], particles: usize) -> String {
    let value = |label: &str, top: f64, most: f64| {
        let step = nice_step(top, 4);
        let ticks: Vec<_> = ticks([0.0, top], step).map(|v| json!([v, tick_label(v, step)])).collect();
        json!({"label": label, "top": top, "ticks": ticks, "beyond": most > top})
    };
    let camera = |m: &Moment| [m.view.middle[0], m.view.middle[1], m.view.width];
    let (tank, whole) = (&scene.tank, flow.whole);
    let duration = flow.moments.last().map_or(0.0, |m| m.time) - flow.moments.first().map_or(0.0, |m| m.time);
    let decimals = (3.0 - (1e3 * duration).max(1e-3).log10()).ceil().clamp(0.0, 5.0);
    let colours: Vec<String> = (0..COLOURS).map(|k| hex(viridis(k as f64 / (COLOURS - 1) as f64))).collect();
    json!({
        "particles": particles,
        "times": flow.moments.iter().map(|m| m.time).collect::<Vec<_>>(),
        "decimals": decimals,
        "still": flow.still,
        "mirror": flow.mirror,
        "aspect": super::camera::ASPECT,
        "box": [low[0], low[1], high[0], high[1]],
        "size": size,
        "cameras": flow.moments.iter().map(camera).collect::<Vec<_>>(),
        "whole": [whole.0.middle[0], whole.0.middle[1], whole.0.width],
        "wholeHeight": whole.1,
        "tank": [-0.5 * tank.width, 0.5 * tank.width, -tank.depth, tank.height - tank.depth],
        "outlines": flow.moments.iter().map(|m| m.outlines.iter().map(Vec::len).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "panels": flow.moments.iter().map(|m| &m.panels).collect::<Vec<_>>(),
        "values": {
            "pressure": value("Pressure [kPa]", 1e-3 * flow.top[0], 1e-3 * flow.most[0]),
            "speed": value("Speed [m/s]", flow.top[1], flow.most[1]),
        },
        "colours": colours,
    })
    .to_string()
}
