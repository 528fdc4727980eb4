//! The colours of the flow pictures.

/// An sRGB colour, one byte per channel.
pub type Rgb = [u8; 3];

/// Colours that tell categories apart, on white and on black (M. Okabe and K. Ito, *Color Universal Design*, 2008; one more).
pub const CATEGORIES: [Rgb; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [138, 99, 210]];

pub(super) const PAPER: Rgb = [255, 255, 255];
pub(super) const INK: Rgb = [38, 42, 48];
pub(super) const BODY: Rgb = [196, 200, 206];
pub(super) const WALL: Rgb = [128, 134, 142];
/// For a particle whose value is not a number: absent from the colour map, so that it is seen.
pub(super) const NOT_A_NUMBER: Rgb = [230, 30, 120];

/// A colour as `#rrggbb`.
pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Colour of the perceptually uniform map *viridis* at `t` in [0, 1]; values outside are clamped,
/// NaN reads as 0.
///
/// Equal steps of `t` look equally large, also in greyscale and to colour-blind readers. Every
/// fifth of the 256 published colours is stored; in between the map is linear, within one part in
/// 255 of the published table. Source: S. van der Walt and N. Smith, matplotlib colour maps (2015),
/// released under CC0.
pub fn viridis(t: f64) -> Rgb {
    let position = t.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let index = (position as usize).min(VIRIDIS.len() - 2);
    let fraction = (position - index as f64).max(0.0);
    let (low, high) = (channels(VIRIDIS[index]), channels(VIRIDIS[index + 1]));
    std::array::from_fn(|k| (low[k] + fraction * (high[k] - low[k])).round() as u8)
}

fn channels(hex: u32) -> [f64; 3] {
    [hex >> 16, hex >> 8, hex].map(|c| f64::from(c & 0xff))
}

#[rustfmt::skip]
const VIRIDIS: [u32; 52] = [
    0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781,
    0x433d84, 0x414287, 0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e,
    0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e, 0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c,
    0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80, 0x2eb37c, 0x35b779, 0x3dbc74,
    0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840, 0xa2da37,
    0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725,
];
