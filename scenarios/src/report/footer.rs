//! The strip below a flow picture: time and scale bar on the left, colour bar on the right.

use super::canvas::{Canvas, SAMPLES};
use super::colour::{INK, PAPER, RULE, viridis};
use super::flow::{FlowView, Window};
use super::text::{Anchor, CAP_HEIGHT, text_width, write};
use super::ticks::{nice_length, nice_step, proper_range, tick_label, ticks};

/// Sizes of the strip, all in proportion to the lettering.
pub(super) struct Footer {
    /// Height \[pixels\].
    pub height: usize,
    /// Pixels per unit of the alphabet.
    unit: f64,
}

impl Footer {
    /// The strip that suits a window.
    pub fn new(window: &Window) -> Self {
        let unit = (window.width as f64 / 480.0).max(1.2);
        let height = (39.0 * unit).round() as usize;
        Self { height, unit }
    }

    /// Draws the strip over whatever the flow left there.
    pub fn draw(&self, canvas: &mut Canvas, time: f64, view: &FlowView, window: &Window) {
        let (unit, width, top) = (self.unit, window.width as f64, window.height as f64);
        canvas.fill_rectangle([0.0, top], [width, top + self.height as f64], PAPER);
        canvas.stroke([0.0, top], [width, top], 0.5 * unit, RULE);
        let first_line = top + (5.0 + CAP_HEIGHT) * unit;

        let left = 8.0 * unit;
        let time = format!("t = {time:.4} s");
        write(canvas, &time, [left, first_line], Anchor::Start, unit);
        self.scale_bar(canvas, [left, first_line + 9.0 * unit], window.scale, 0.2 * width);

        let bar = [0.5 * width, width - 18.0 * unit];
        write(canvas, &view.label, [bar[0], first_line], Anchor::Start, unit);
        self.colour_bar(canvas, bar, first_line + 4.5 * unit, proper_range(view.value));
    }

    /// A line of round length, at most `longest` pixels; `at` is its upper left corner.
    fn scale_bar(&self, canvas: &mut Canvas, at: [f64; 2], scale: f64, longest: f64) {
        let unit = self.unit;
        let length = nice_length(longest / scale);
        let (left, right) = (at[0], at[0] + length * scale);
        let [top, middle, bottom] = [0.0, 0.5, 1.0].map(|part| at[1] + part * CAP_HEIGHT * unit);
        let pen = 0.9 * unit;
        canvas.stroke([left, middle], [right, middle], pen, INK);
        canvas.stroke([left, top], [left, bottom], pen, INK);
        canvas.stroke([right, top], [right, bottom], pen, INK);
        let label = format!("{} m", tick_label(length, length));
        write(canvas, &label, [right + 5.0 * unit, bottom], Anchor::Start, unit);
    }

    fn colour_bar(&self, canvas: &mut Canvas, ends: [f64; 2], top: f64, range: [f64; 2]) {
        let (unit, [left, right], [low, high]) = (self.unit, ends, range);
        let bottom = top + 7.0 * unit;
        let strips = ((right - left) * SAMPLES as f64).ceil();
        let edge = |strip: f64| left + strip / strips * (right - left);
        for strip in (0..strips as usize).map(|i| i as f64) {
            let colour = viridis((strip + 0.5) / strips);
            canvas.fill_rectangle([edge(strip), top], [edge(strip + 1.0), bottom], colour);
        }
        let baseline = bottom + (4.5 + CAP_HEIGHT) * unit;
        let room = (right - left) / (10.0 * unit + text_width("0.0000", unit));
        let step = nice_step(high - low, (room as usize).clamp(1, 5));
        for value in ticks(range, step) {
            let x = left + (value - low) / (high - low) * (right - left);
            canvas.stroke([x, bottom], [x, bottom + 2.0 * unit], 0.6 * unit, INK);
            write(canvas, &tick_label(value, step), [x, baseline], Anchor::Middle, unit);
        }
    }
}
