//! A picture of the flow: particles coloured by a value, bodies and walls.

use serde::{Deserialize, Serialize};

use super::canvas::{Canvas, SAMPLES, centres, edges};
use super::colour::{BODY, INK, NOT_A_NUMBER, PAPER, WALL, viridis};
use super::ticks::proper_range;

/// What there is to see at one instant.
///
/// The arrays `x`, `y`, `value` and `size` have one entry per particle; if they differ in length,
/// the surplus is left out, as are particles with a non-finite position or size and non-finite
/// points of `outlines` and `walls`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct FlowFrame {
    /// Time \[s\].
    pub time: f64,
    /// Horizontal particle positions \[m\].
    pub x: Vec<f32>,
    /// Vertical particle positions, upwards \[m\].
    pub y: Vec<f32>,
    /// The value that gives each particle its colour, in the unit of [`FlowView::label`].
    pub value: Vec<f32>,
    /// Particle spacing, which may differ from particle to particle \[m\].
    pub size: Vec<f32>,
    /// Outlines of bodies, closed polygons \[m\].
    pub outlines: Vec<Vec<[f64; 2]>>,
    /// Positions of wall particles \[m\].
    pub walls: Vec<[f64; 2]>,
    /// Spacing of the wall particles \[m\].
    pub wall_size: f64,
}

/// Which part of the flow is drawn, and how.
#[derive(Clone, Debug)]
pub struct FlowView {
    /// Window from left to right \[m\].
    pub x: [f64; 2],
    /// Window from bottom to top \[m\].
    pub y: [f64; 2],
    /// Values at the two ends of the colour map, in the unit of `label`; values beyond take the end
    /// colours.
    pub value: [f64; 2],
    /// Width of the image \[pixels\], 200 to 8000; the height follows from the window, up to twice
    /// the width.
    pub width_px: u32,
    /// Name and unit of the value, such as `pressure [kPa]`.
    pub label: String,
    /// Draw x < 0 as the mirror image of x > 0, for runs of one half of a symmetric flow.
    pub mirror_x: bool,
}

/// Draws `frame` as a PNG image `view.width_px` pixels wide.
///
/// Each point within 0.8 spacings of a particle takes the colour of the particle that is nearest in
/// units of its own spacing (a weighted Voronoi diagram cut to discs), so a full lattice of any
/// grading is covered without gaps, voids stay visible, and the order of the particles does not
/// matter. Lengths are to scale in both directions. The same input gives the same bytes.
pub fn flow_png(frame: &FlowFrame, view: &FlowView) -> Vec<u8> {
    let window = Window::new(view);
    let mut canvas = Canvas::new(window.width, window.height, PAPER);
    draw_particles(&mut canvas, frame, view, &window);
    for side in window.sides {
        draw_walls(&mut canvas, frame, &window, *side);
        for outline in &frame.outlines {
            draw_body(&mut canvas, outline, &window, *side);
        }
    }
    canvas.to_png()
}

/// The map from metres to pixels.
pub(super) struct Window {
    /// Width \[pixels\].
    pub width: usize,
    /// Height \[pixels\].
    pub height: usize,
    /// Pixels per metre.
    pub scale: f64,
    left: f64,
    top: f64,
    /// Factors on x: itself and, where the flow is mirrored, its image.
    sides: &'static [f64],
}

impl Window {
    pub fn new(view: &FlowView) -> Self {
        let ([left, right], [bottom, top]) = (proper_range(view.x), proper_range(view.y));
        let width = view.width_px.clamp(200, 8000) as usize;
        let scale = width as f64 / (right - left);
        let height = ((top - bottom) * scale).round().clamp(1.0, 2.0 * width as f64) as usize;
        let sides: &[f64] = if view.mirror_x { &[1.0, -1.0] } else { &[1.0] };
        Self { width, height, scale, left, top, sides }
    }

    fn pixel(&self, side: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        [(side * x - self.left) * self.scale, (self.top - y) * self.scale]
    }
}

fn draw_particles(canvas: &mut Canvas, frame: &FlowFrame, view: &FlowView, window: &Window) {
    /// Discs of radius 0.71, half the diagonal of a cell, just cover a square lattice; a flow is
    /// less regular.
    const RADIUS: f64 = 0.8;
    /// Coarse particles at the surface lie in a nearly still row: their discs are cut above, for a level surface.
    const COARSE: f64 = 1.3;
    const CUT: f64 = 0.56;
    const TOP_ROW: f64 = -0.7;
    let finest = frame.size.iter().copied().filter(|s| *s > 0.0).fold(f32::INFINITY, f32::min);
    let [low, high] = proper_range(view.value);
    let (width, rows, samples) = canvas.samples_mut();
    let scale = window.scale * SAMPLES as f64;
    let mut nearest = vec![f32::INFINITY; width * rows];
    let particles = frame.x.iter().zip(&frame.y).zip(&frame.value).zip(&frame.size);
    for (((&x, &y), &value), &size) in particles {
        let [x, y, value, size] = [x, y, value, size].map(f64::from);
        let mirrored_away = view.mirror_x && x < 0.0;
        if mirrored_away || !(x.is_finite() && y.is_finite() && size.is_finite()) {
            continue;
        }
        let colour = if value.is_nan() { NOT_A_NUMBER } else { viridis((value - low) / (high - low)) };
        // A particle smaller than a pixel still gets one.
        let spacing = (size * scale).max(SAMPLES as f64);
        let radius = RADIUS * spacing;
        let at_surface = size > COARSE * f64::from(finest) && y > TOP_ROW * size;
        let above = if at_surface { CUT * spacing } else { radius };
        for side in window.sides {
            let [cx, cy] = window.pixel(*side, [x, y]).map(|v| v * SAMPLES as f64);
            for row in centres(cy - above, cy + radius, rows) {
                let dy = row as f64 + 0.5 - cy;
                let half = (radius * radius - dy * dy).max(0.0).sqrt();
                let columns = centres(cx - half, cx + half, width);
                let (start, end) = (row * width + columns.start, row * width + columns.end);
                let mut dx = columns.start as f64 + 0.5 - cx;
                for (near, sample) in nearest[start..end].iter_mut().zip(&mut samples[start..end]) {
                    let distance = ((dx * dx + dy * dy) / (spacing * spacing)) as f32;
                    if distance < *near {
                        (*near, *sample) = (distance, colour);
                    }
                    dx += 1.0;
                }
            }
        }
    }
}

fn draw_walls(canvas: &mut Canvas, frame: &FlowFrame, window: &Window, side: f64) {
    let half = 0.5 * (frame.wall_size * window.scale).max(1.0);
    for &wall in frame.walls.iter().filter(|p| is_finite(p)) {
        let [x, y] = window.pixel(side, wall);
        canvas.fill_rectangle([x - half, y - half], [x + half, y + half], WALL);
    }
}

fn draw_body(canvas: &mut Canvas, outline: &[[f64; 2]], window: &Window, side: f64) {
    let corners: Vec<_> = outline.iter().copied().filter(is_finite).collect();
    let pixels: Vec<_> = corners.iter().map(|&p| window.pixel(side, p)).collect();
    canvas.fill_polygon(&pixels, BODY);
    let line = window.width as f64 / 700.0;
    for ((a, b), (from, to)) in edges(&corners).zip(edges(&pixels)) {
        // Two halves of a body meet in the plane of symmetry without a line between them.
        let seam = window.sides.len() > 1 && (a[0].abs() + b[0].abs()) * window.scale < 0.1;
        if !seam {
            canvas.stroke(from, to, line, INK);
        }
    }
}

fn is_finite(p: &[f64; 2]) -> bool {
    p[0].is_finite() && p[1].is_finite()
}
