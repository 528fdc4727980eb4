//! The share of a closed outline that each boundary particle of the first layer stands for (THEORY PR19).

use sph_core::WallPoint;
use sph_core::walls::OutlineShare;

use crate::geometry::outline::Outline;
use crate::geometry::polygon::normal;

/// Pieces of the outline in a spacing.
const PIECES: f64 = 4.0;
/// Distance [spacings] that a normal at right angles to a piece counts as.
const AWAY: f64 = 2.0;

/// Cut the sides of an outline into pieces and give each to the nearest particle of the first layer that faces its way.
/// The shares add up to ∮n ds, which is zero: a uniform pressure has no force. With `half`, of the part x > 0 only.
pub(crate) fn share_outline(outline: &Outline, spacing: f64, half: bool, points: &mut [WallPoint]) {
    let first: Vec<usize> = (0..points.len()).filter(|&k| points[k].depth < 0.75 * spacing).collect();
    if first.is_empty() {
        return;
    }
    let surface = |k: usize| [0, 1].map(|i| points[k].at[i] + points[k].depth * points[k].normal[i]);
    let places: Vec<([f64; 2], [f64; 2])> = first.iter().map(|&k| (surface(k), points[k].normal)).collect();
    let mut shares = vec![OutlineShare::default(); first.len()];
    for part in outline.loops() {
        for (k, &from) in part.iter().enumerate() {
            let Some([from, to]) = right_part(from, part[(k + 1) % part.len()], half) else { continue };
            let (n, along) = (normal(from, to), [to[0] - from[0], to[1] - from[1]]);
            let length = along[0].hypot(along[1]);
            let count = (PIECES * length / spacing).ceil().max(1.0);
            for piece in 0..count as usize {
                let t = (piece as f64 + 0.5) / count;
                let at = [from[0] + t * along[0], from[1] + t * along[1]];
                let distance = |(place, facing): &([f64; 2], [f64; 2])| {
                    let (dx, dy) = (place[0] - at[0], place[1] - at[1]);
                    let turned = 1.0 - (facing[0] * n[0] + facing[1] * n[1]);
                    dx * dx + dy * dy + turned * (AWAY * spacing).powi(2)
                };
                let nearest = (0..places.len()).min_by(|&a, &b| distance(&places[a]).total_cmp(&distance(&places[b])));
                let nearest = nearest.unwrap_or(0);
                let (place, facing) = places[nearest];
                let in_frame = |[x, y]: [f64; 2]| [x * facing[0] + y * facing[1], y * facing[0] - x * facing[1]];
                let (ds, arm) =
                    (in_frame(n.map(|n| n * length / count)), in_frame([at[0] - place[0], at[1] - place[1]]));
                let OutlineShare { area, moment } = &mut shares[nearest];
                for b in 0..2 {
                    area[b] += ds[b];
                    (0..2).for_each(|a| moment[a][b] += arm[a] * ds[b]);
                }
            }
        }
    }
    for (&k, share) in first.iter().zip(shares) {
        points[k].outline = share;
    }
}

/// A side, or with `half` what of it lies at x > 0.
fn right_part(from: [f64; 2], to: [f64; 2], half: bool) -> Option<[[f64; 2]; 2]> {
    if !half || (from[0] >= 0.0 && to[0] >= 0.0) {
        return Some([from, to]);
    }
    if from[0] <= 0.0 && to[0] <= 0.0 {
        return None;
    }
    let t = from[0] / (from[0] - to[0]);
    let crossing = [0.0, from[1] + t * (to[1] - from[1])];
    Some(if from[0] > 0.0 { [from, crossing] } else { [crossing, to] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::rows::WallRows;
    use crate::geometry::sampling::sample;
    use crate::geometry::shape::Shape;

    /// ∫n ds and ∫y n_y ds over the shares.
    fn sums(points: &[WallPoint]) -> [f64; 3] {
        points.iter().fold([0.0; 3], |sum, p| {
            let (OutlineShare { area: [along, across], moment: m }, [nx, ny]) = (p.outline, p.normal);
            let (x, y) = (along * nx - across * ny, along * ny + across * nx);
            // y of the arm is ny ρ₀ + nx ρ₁, and so of the normal
            let about = ny * (ny * m[0][0] + nx * m[0][1]) + nx * (ny * m[1][0] + nx * m[1][1]);
            [sum[0] + x, sum[1] + y, sum[2] + (p.at[1] + p.depth * ny) * y + about]
        })
    }

    #[test]
    fn the_shares_of_a_closed_outline_have_no_resultant_and_hold_its_area() {
        for shape in [
            Shape::Wedge { deadrise_deg: 30.0, breadth: 1.0, side_height: 0.3 },
            Shape::Arc { radius: 1.0, breadth: 1.2, side_height: 0.3 },
            Shape::Box { breadth: 0.93, height: 0.4 },
        ] {
            let outline = Outline::of(&shape).unwrap();
            for half in [false, true] {
                let [x, y, moment] = sums(&sample(&outline, &WallRows::filled(0.02, 3), half));
                let area = if half { 0.5 * outline.area() } else { outline.area() };
                assert!(y.abs() < 1e-14 && (half || x.abs() < 1e-14), "{shape:?}: {x:e}, {y:e}");
                assert!((moment / area - 1.0).abs() < 1e-12, "{shape:?}: {moment} of {area}");
            }
        }
    }
}
