//! An image of pixels: filled rectangles and polygons, smooth lines, supersampled, written as PNG.

use std::ops::Range;

use super::colour::{PAPER, Rgb};

/// Samples per pixel along each direction.
pub(super) const SAMPLES: usize = 2;

/// An image under construction; its methods take positions and lengths in pixels, x to the right
/// and y down.
pub(super) struct Canvas {
    /// Samples per row.
    width: usize,
    /// Rows of samples.
    height: usize,
    samples: Vec<Rgb>,
}

impl Canvas {
    /// An image of `width` by `height` \[pixels\], all of one colour.
    pub fn new(width: usize, height: usize, background: Rgb) -> Self {
        let (width, height) = (width * SAMPLES, height * SAMPLES);
        Self { width, height, samples: vec![background; width * height] }
    }

    /// Number of samples per row, of rows of samples, and the samples row by row.
    pub fn samples_mut(&mut self) -> (usize, usize, &mut [Rgb]) {
        (self.width, self.height, &mut self.samples)
    }

    /// Fills the rectangle between two opposite corners, `low` being the smaller in x and y.
    pub fn fill_rectangle(&mut self, low: [f64; 2], high: [f64; 2], colour: Rgb) {
        let [low, high] = [low, high].map(in_samples);
        let columns = centres(low[0], high[0], self.width);
        for row in centres(low[1], high[1], self.height) {
            self.row(row)[columns.clone()].fill(colour);
        }
    }

    /// Fills a closed polygon by the even-odd rule.
    pub fn fill_polygon(&mut self, corners: &[[f64; 2]], colour: Rgb) {
        let corners: Vec<_> = corners.iter().map(|&p| in_samples(p)).collect();
        let (low, high) = corners.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[1]), h.max(p[1])));
        let mut crossings = Vec::new();
        for row in centres(low, high, self.height) {
            let y = row as f64 + 0.5;
            crossings.clear();
            for (a, b) in edges(&corners) {
                if (a[1] <= y) != (b[1] <= y) {
                    crossings.push(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
                }
            }
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let columns = centres(pair[0], pair[1], self.width);
                self.row(row)[columns].fill(colour);
            }
        }
    }

    /// Draws a straight line of the given width with round ends; equal ends make a dot.
    pub fn stroke(&mut self, from: [f64; 2], to: [f64; 2], width: f64, colour: Rgb) {
        let [a, b] = [from, to].map(in_samples);
        let along = [b[0] - a[0], b[1] - a[1]];
        let length2 = (along[0] * along[0] + along[1] * along[1]).max(f64::MIN_POSITIVE);
        let radius = 0.5 * width * SAMPLES as f64;
        let reach = radius + 0.5;
        for row in centres(a[1].min(b[1]) - reach, a[1].max(b[1]) + reach, self.height) {
            let y = row as f64 + 0.5;
            // Only the part of the line within reach of this row colours it.
            let near = match along[1] {
                0.0 => [0.0, 1.0],
                rise => [y - reach, y + reach].map(|y| ((y - a[1]) / rise).clamp(0.0, 1.0)),
            };
            let [start, end] = near.map(|t| a[0] + t * along[0]);
            let (left, right) = (start.min(end) - reach, start.max(end) + reach);
            for column in centres(left, right, self.width) {
                let p = [column as f64 + 0.5 - a[0], y - a[1]];
                let t = ((p[0] * along[0] + p[1] * along[1]) / length2).clamp(0.0, 1.0);
                let distance = (p[0] - t * along[0]).hypot(p[1] - t * along[1]);
                let cover = (reach - distance).clamp(0.0, 1.0);
                let sample = &mut self.row(row)[column];
                *sample = blend(*sample, colour, cover);
            }
        }
    }

    /// The image as PNG: each pixel the mean of its samples, transparent by the share of paper among them.
    pub fn to_png(&self) -> Vec<u8> {
        let (width, height) = (self.width / SAMPLES, self.height / SAMPLES);
        let mut pixels = Vec::with_capacity(4 * width * height);
        for rows in self.samples.chunks_exact(SAMPLES * self.width) {
            for x in 0..width {
                let block = || (0..SAMPLES).flat_map(|j| &rows[j * self.width + x * SAMPLES..][..SAMPLES]);
                let drawn = || block().filter(|sample| **sample != PAPER);
                let count = drawn().count();
                for k in 0..3 {
                    let sum: usize = drawn().map(|sample| usize::from(sample[k])).sum();
                    pixels.push(((sum + count / 2) / count.max(1)) as u8);
                }
                pixels.push((255 * count / (SAMPLES * SAMPLES)) as u8);
            }
        }
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder
            .write_header()
            .and_then(|mut image| {
                image.write_image_data(&pixels)?;
                image.finish()
            })
            .expect("writing a PNG of matching size into memory cannot fail");
        file
    }

    fn row(&mut self, row: usize) -> &mut [Rgb] {
        &mut self.samples[row * self.width..][..self.width]
    }
}

/// The edges of a closed polygon.
pub(super) fn edges(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Indices of the samples whose centres lie between `low` and `high`, both in samples, within
/// `0..count`.
pub(super) fn centres(low: f64, high: f64, count: usize) -> Range<usize> {
    let first = (low - 0.5).ceil().max(0.0) as usize;
    let end = ((high - 0.5).floor() + 1.0).max(0.0) as usize;
    first.min(count)..end.min(count).max(first.min(count))
}

fn blend(below: Rgb, above: Rgb, cover: f64) -> Rgb {
    let mix = |k: usize| f64::from(below[k]) * (1.0 - cover) + f64::from(above[k]) * cover;
    std::array::from_fn(|k| mix(k).round() as u8)
}

fn in_samples(p: [f64; 2]) -> [f64; 2] {
    p.map(|v| v * SAMPLES as f64)
}
