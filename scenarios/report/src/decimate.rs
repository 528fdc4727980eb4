//! Fewer points for the same curve on paper.

/// At most `limit` points of a curve, in order, that look like the whole curve.
///
/// The curve is cut into runs of equally many points; of each run the points of least and greatest
/// x and y stay. For curves sorted in x those are each run's first, last, lowest and highest point:
/// the M4 aggregation of U. Jugel et al., *Proc. VLDB Endowment* 7 (2014), so peaks of a single
/// sample survive. Limits below 4 count as 4.
pub(super) fn decimate(points: &[[f64; 2]], limit: usize) -> Vec<[f64; 2]> {
    if points.len() <= limit {
        return points.to_vec();
    }
    let run = points.len().div_ceil((limit / 4).max(1));
    points.chunks(run).flat_map(extremes).collect()
}

fn extremes(run: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut keep = [0; 4];
    for (i, p) in run.iter().enumerate() {
        for k in 0..2 {
            if p[k] < run[keep[2 * k]][k] {
                keep[2 * k] = i;
            }
            // The last of equals, so that a flat run keeps both ends.
            if p[k] >= run[keep[2 * k + 1]][k] {
                keep[2 * k + 1] = i;
            }
        }
    }
    keep.sort_unstable();
    let mut kept: Vec<_> = keep.iter().map(|&i| run[i]).collect();
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_and_ends_stay() {
        let mut points: Vec<_> = (0..100_003).map(|i| [f64::from(i), (f64::from(i) * 1e-3).sin()]).collect();
        points[54_321][1] = 7.0;
        points[99_998][1] = -9.0;
        let kept = decimate(&points, 1000);
        assert!(kept.len() <= 1000 && kept.len() > 500, "{} points", kept.len());
        for must in [points[0], points[54_321], points[99_998], points[100_002]] {
            assert!(kept.contains(&must), "{must:?} is gone");
        }
        assert!(kept.is_sorted_by(|a, b| a[0] < b[0]));
    }

    #[test]
    fn a_loop_keeps_its_width() {
        let turn = |i: i32| (f64::from(i) * 1e-4 * std::f64::consts::TAU).sin_cos();
        let points: Vec<_> = (0..10_000).map(|i| [turn(i).1, turn(i).0]).collect();
        let kept = decimate(&points, 100);
        let left = kept.iter().fold(f64::MAX, |least, p| least.min(p[0]));
        assert_eq!(left, points[5000][0]);
    }

    #[test]
    fn short_curves_are_left_alone() {
        let points = [[0.0, 1.0], [1.0, 1.0], [0.5, 3.0]];
        assert_eq!(decimate(&points, 1000), points);
    }
}
