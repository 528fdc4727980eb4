use super::*;

fn ellipse(a: f64, b: f64, points: usize) -> Vec<[f64; 2]> {
    let at = |k: usize| 0.5 * std::f64::consts::PI * k as f64 / points as f64;
    (0..=points).map(|k| [a * at(k).sin(), b * (1.0 - at(k).cos())]).collect()
}

#[test]
fn a_circle_is_one_and_an_ellipse_few_pieces() {
    let circle = through(&ellipse(2.0, 2.0, 40)).expect("a curve");
    assert!(circle.len() <= 2 && circle.iter().all(|piece| (piece.curvature - 0.5).abs() < 1e-3), "{circle:?}");
    for points in [10, 20, 40, 160] {
        let line = through(&ellipse(1.0, 0.6, points)).expect("a curve");
        assert!(line.len() <= 4 * points.min(12), "{points}: {}", line.len());
        for pair in line.windows(2) {
            assert!((pair[0].end() - pair[1].from).norm() < 1e-12);
            assert!((pair[0].last_angle() - pair[1].angle).abs() < 1e-6);
        }
        for k in 0..400 {
            let t = 0.5 * std::f64::consts::PI * f64::from(k) / 400.0;
            let z = c64::new(t.sin(), 0.6 * (1.0 - t.cos()));
            let off = line.iter().map(|p| (p.at(p.nearest(z))[0] - z).norm()).fold(f64::INFINITY, f64::min);
            assert!(off < 2e-3 / (points as f64 / 10.0).powi(2) + 2e-4, "{points}: {off}");
        }
    }
}

/// Forty points of an ellipse become two hundred on it; a box with few faces stays as it is.
#[test]
fn the_outline_of_a_body_is_refined_where_it_is_curved() {
    let ellipse = |points: usize| -> Vec<[f64; 2]> {
        let at = |k: usize| 2.0 * std::f64::consts::PI * k as f64 / points as f64;
        (0..points).map(|k| [at(k).sin(), -1.5 * at(k).cos()]).collect()
    };
    for points in [40, 41] {
        let fine = refined(&ellipse(points)).expect("a curve");
        assert!((170..300).contains(&fine.len()), "{}", fine.len());
        let off = fine.iter().map(|[x, y]| (x.hypot(y / 1.5) - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 3e-3, "{off}");
    }
    // a flat keel between corners of a curve does not bulge
    let squarish = |t: f64| [t.sin().signum() * t.sin().abs().powf(0.62), -t.cos().signum() * t.cos().abs().powf(0.62)];
    let points: Vec<[f64; 2]> = (0..40).map(|k| squarish(2.0 * std::f64::consts::PI * f64::from(k) / 40.0)).collect();
    let lowest = refined(&points).expect("a curve").iter().map(|p| p[1]).fold(0.0, f64::min);
    assert!((lowest + 1.0).abs() < 1e-12, "{lowest}");
    assert_eq!(refined(&ellipse(8)), None);
    assert_eq!(refined(&[[0.0, 0.0], [0.5, 0.1], [1.0, 0.3], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.3], [-0.5, 0.1]]), None);
    // a half ellipse under a deck keeps its corners
    let mut half: Vec<[f64; 2]> = ellipse(40).into_iter().filter(|[_, y]| *y < 1e-9).collect();
    half.sort_by(|a, b| a[0].total_cmp(&b[0]));
    half.extend([[1.0, 0.5], [-1.0, 0.5]]);
    let fine = refined(&half).expect("a curve");
    assert!(half.iter().all(|corner| fine.iter().any(|p| (p[0] - corner[0]).hypot(p[1] - corner[1]) < 1e-9)));
}

/// The curves of a symmetric body are symmetric, and its straight sides stay straight.
#[test]
fn the_image_of_a_line_has_the_image_of_its_curves() {
    let right = [
        [0.0, 0.0],
        [0.05671, 0.01922],
        [0.11097, 0.04202],
        [0.16242, 0.06808],
        [0.21075, 0.09704],
        [0.25576, 0.12855],
        [0.29725, 0.16224],
        [0.33512, 0.19773],
        [0.36932, 0.23467],
        [0.39986, 0.27276],
        [0.42677, 0.31169],
        [0.45013, 0.35122],
        [0.47004, 0.39114],
        [0.48663, 0.43129],
        [0.5, 0.47155],
        [0.5, 0.72155],
    ];
    let image = right[1..].iter().rev().map(|[x, y]| [-x, *y]);
    let fine = refined(&right.into_iter().chain(image).collect::<Vec<_>>()).expect("a curve");
    for [x, y] in &fine {
        let near = fine.iter().map(|p| (p[0] + x).hypot(p[1] - y)).fold(f64::INFINITY, f64::min);
        assert!(near < 1e-12 && x.abs() < 0.5 + 1e-12, "[{x}, {y}]: {near}");
    }
}

#[test]
fn few_faces_are_knuckles_and_a_curve_may_end_at_one() {
    let faces = |angles: &[f64]| {
        let mut corners = vec![[0.0, 0.0]];
        for angle in angles {
            let [x, y] = corners[corners.len() - 1];
            corners.push([x + angle.to_radians().cos(), y + angle.to_radians().sin()]);
        }
        corners
    };
    assert!(through(&faces(&[20.0, 26.0, 32.0, 38.0])).is_none());
    assert!(through(&faces(&[0.0, 30.0])).is_none());
    let line = through(&faces(&[3.0, 9.0, 15.0, 21.0, 27.0, 33.0, 70.0])).expect("a curve");
    let jumps: Vec<f64> = line.windows(2).map(|w| w[1].angle - w[0].last_angle()).filter(|j| j.abs() > 0.1).collect();
    assert!(jumps.len() == 1 && (jumps[0].to_degrees() - 34.0).abs() < 2.0, "{jumps:?}");
}
