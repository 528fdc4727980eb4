//! The half section of a fuselage from the points around it (THEORY EN54).

/// Points nearer to the plane of symmetry than this share of the breadth lie on it [-].
const ON_PLANE: f64 = 1e-3;
/// Largest difference of the areas on both sides of a whole section over its area [-].
const LOPSIDED: f64 = 0.01;
/// Angle of a bottom's face to the horizontal at which the water leaves a smooth side where no breadth is given [deg].
const EDGE_DEG: f64 = 45.0;

/// Half of a symmetric section.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfSection {
    /// From the keel outwards and up: distance from the plane of symmetry, height over the keel [m], shape (n, 2).
    pub points: Vec<[f64; 2]>,
    /// Height of the keel in the coordinates of the points that it was made of [m].
    pub keel: f64,
}

impl HalfSection {
    /// Of points around a section, counter-clockwise [m]: of all of it, or of one half with the keel at its side.
    ///
    /// # Errors
    /// What is wrong with the points, and what was expected.
    pub fn of_outline(points: &[[f64; 2]]) -> Result<HalfSection, String> {
        let extent = |k: usize| {
            let values = || points.iter().map(|p| p[k]);
            [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([left, right], [lowest, highest]) = (extent(0), extent(1));
        let (breadth, height) = (right - left, highest - lowest);
        if !(breadth > 0.0 && height > 0.0) {
            return Err("points around a section with a breadth and a height".into());
        }
        let near = ON_PLANE * breadth;
        let low = || points.iter().filter(|p| p[1] - lowest < 1e-9 * height);
        let (low_left, low_right) =
            low().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p[0]), b.max(p[0])));
        let (from_left, to_right) = (low_left - left < near, right - low_right < near);
        let plane = match (from_left, to_right) {
            (true, false) => left,
            (false, true) => right,
            _ => 0.5 * (left + right),
        };
        let is_mirrored = !from_left && to_right;
        let mut around: Vec<[f64; 2]> = points.iter().map(|[x, z]| [x - plane, z - lowest]).collect();
        if is_mirrored {
            around = around.into_iter().rev().map(|[x, z]| [-x, z]).collect();
        }
        let line = from_keel(&around, near).ok_or("a keel in the plane of symmetry")?;
        let is_whole = plane != left && plane != right;
        if is_whole {
            let [all, half] = [area(&around), area(&line)];
            if (2.0 * half - all).abs() > LOPSIDED * all {
                let share = 100.0 * (2.0 * half - all).abs() / all;
                return Err(format!(
                    "half a section, or a whole one that is symmetric: its sides differ by {share:.1} % of its area"
                ));
            }
        }
        let keel = line[0][1];
        let points = line.into_iter().map(|[x, z]| [x, z - keel]).collect();
        Ok(HalfSection { points, keel: lowest + keel })
    }

    /// Breadth at which the water leaves the bottom where none is given [m]: at the widest place, or before it where a face gets steeper than 45°.
    pub fn breadth(&self) -> f64 {
        let refined = bottom(&self.points);
        let steep = EDGE_DEG.to_radians().tan() * (1.0 + 1e-6);
        let end = refined.windows(2).find(|w| w[1][1] - w[0][1] > steep * (w[1][0] - w[0][0]));
        2.0 * end.map_or(refined[refined.len() - 1], |w| w[0])[0]
    }
}

/// The part of a half section from the keel to its widest place [m].
pub(super) fn rising(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let grows = points.windows(2).take_while(|w| w[1][0] > w[0][0] + 1e-12).count();
    points[..=grows].to_vec()
}

/// The same with the arcs for which its points stand.
fn bottom(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let bottom = rising(points);
    crate::Section::new(&bottom).map(|section| section.corners().to_vec()).unwrap_or(bottom)
}

/// The part of a half section up to a half breadth [m], on the arcs for which its points stand; `None` where it is narrower.
pub(super) fn up_to(points: &[[f64; 2]], half_breadth: f64) -> Option<Vec<[f64; 2]>> {
    let bottom = bottom(points);
    let widest = bottom[bottom.len() - 1][0];
    if half_breadth > widest * (1.0 + 1e-6) {
        return None;
    }
    let end = half_breadth.min(widest);
    let mut part: Vec<[f64; 2]> = bottom.iter().take_while(|p| p[0] < end * (1.0 - 1e-9)).copied().collect();
    let next = bottom.get(part.len()).copied().unwrap_or([end, bottom[bottom.len() - 1][1]]);
    let before = *part.last().unwrap_or(&[0.0, 0.0]);
    let share = if next[0] > before[0] { (end - before[0]) / (next[0] - before[0]) } else { 1.0 };
    part.push([end, before[1] + share * (next[1] - before[1])]);
    Some(part)
}

/// The line from the lowest point on the plane x = 0 along the side x > 0, up to the plane or to the end of the points.
fn from_keel(around: &[[f64; 2]], near: f64) -> Option<Vec<[f64; 2]>> {
    let n = around.len();
    let mut all: Vec<[f64; 2]> = Vec::with_capacity(n + 2);
    for k in 0..n {
        let (a, b) = (around[k], around[(k + 1) % n]);
        all.push(if a[0].abs() < near { [0.0, a[1]] } else { a });
        if a[0].abs() >= near && b[0].abs() >= near && a[0] * b[0] < 0.0 {
            let share = a[0] / (a[0] - b[0]);
            all.push([0.0, a[1] + share * (b[1] - a[1])]);
        }
    }
    let on_plane = (0..all.len()).filter(|k| all[*k][0] == 0.0);
    let start = on_plane.min_by(|a, b| all[*a][1].total_cmp(&all[*b][1]))?;
    let mut line = vec![all[start]];
    for k in 1..all.len() {
        let point = all[(start + k) % all.len()];
        if point[0] < 0.0 {
            break;
        }
        if point[0] == 0.0 && line.len() == 1 {
            line[0] = if point[1] <= line[0][1] { point } else { line[0] };
            continue;
        }
        line.push(point);
        if point[0] == 0.0 {
            break;
        }
    }
    (line.len() > 2 || line.len() == 2 && line[1][0] > 0.0).then_some(line)
}

/// Area inside points around it, counter-clockwise [m²].
fn area(points: &[[f64; 2]]) -> f64 {
    let next = |k: usize| points[(k + 1) % points.len()];
    0.5 * points.iter().enumerate().map(|(k, p)| p[0] * next(k)[1] - next(k)[0] * p[1]).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, SQRT_2};

    fn circle(radius: f64, height: f64, count: usize, from: f64) -> Vec<[f64; 2]> {
        let at = |k: usize| from + 2.0 * PI * k as f64 / count as f64;
        (0..count).map(|k| [3.0 + radius * at(k).sin(), height - radius * at(k).cos()]).collect()
    }

    /// Whole circles, with and without a point at the keel, and halves of either side give one half section.
    #[test]
    fn whole_and_half_circles_are_the_same_half_section() {
        let quarter = |k: usize| PI * k as f64 / 36.0;
        let right: Vec<[f64; 2]> = (0..=36).map(|k| [2.0 * quarter(k).sin(), 1.0 - 2.0 * quarter(k).cos()]).collect();
        let left: Vec<[f64; 2]> = right.iter().rev().map(|[x, z]| [-x, *z]).collect();
        for outline in [circle(2.0, 1.0, 72, 0.0), circle(2.0, 1.0, 72, 0.02), right, left] {
            let half = HalfSection::of_outline(&outline).expect("a section");
            assert!((half.keel + 1.0).abs() < 2e-3, "{}", half.keel);
            assert!((half.breadth() / (2.0 * SQRT_2) - 1.0).abs() < 0.02, "{}", half.breadth());
            assert!(half.points.iter().all(|p| p[0] >= 0.0) && half.points[0] == [0.0, 0.0]);
            assert!((half.points[half.points.len() - 1][1] - 4.0).abs() < 0.01);
        }
    }

    #[test]
    fn a_chine_is_the_edge_and_a_lopsided_section_is_refused() {
        let boat = [[-1.0, 0.4], [0.0, 0.0], [1.0, 0.4], [1.0, 2.0], [-1.0, 2.0]];
        let half = HalfSection::of_outline(&boat).expect("a section");
        assert_eq!(half.breadth(), 2.0);
        assert_eq!(half.points, [[0.0, 0.0], [1.0, 0.4], [1.0, 2.0], [0.0, 2.0]]);
        assert_eq!(up_to(&half.points, 0.5), Some(vec![[0.0, 0.0], [0.5, 0.2]]));
        assert_eq!(up_to(&half.points, 1.5), None);
        let bent = [[-1.0, 0.9], [0.1, 0.0], [1.0, 0.4], [1.0, 2.0], [-1.0, 2.0]];
        assert!(HalfSection::of_outline(&bent).expect_err("lopsided").contains("symmetric"));
    }
}
