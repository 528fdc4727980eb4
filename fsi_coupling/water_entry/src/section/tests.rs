//! Corners, hollows, outlines that are more than a bottom.

use super::*;

/// A straight face of 0.5 m, its points rounded to a digit of `unit` [m].
fn rounded(unit: f64) -> Vec<[f64; 2]> {
    let round = |value: f64| (value / unit).round() * unit;
    (0..=37).map(|k| 0.5 * f64::from(k) / 37.0).map(|x| [round(x), round(0.364 * x)]).collect()
}

#[test]
fn a_face_with_rounded_points_is_convex() {
    let corners = rounded(1e-5);
    assert!(slopes_of(&corners).windows(2).any(|w| w[1] < w[0] - 1e-4));
    let section = Section::new(&corners).expect("a convex bottom");
    assert!(section.slopes.windows(2).all(|w| w[1] > w[0]));
    for [x, y] in corners {
        assert!((section.height(x) - y).abs() < 2e-5);
    }
    assert!((section.wagner_draught(0.3) - 0.3 * 0.364 * std::f64::consts::FRAC_2_PI).abs() < 1e-5);
}

/// Points on a straight face add nothing to it, whether it is the only one or not.
#[test]
fn corners_on_straight_lines_are_none() {
    assert_eq!(Section::new(&[[0.0, 0.0], [0.15, 0.07], [0.3, 0.14]]), Section::new(&[[0.0, 0.0], [0.3, 0.14]]));
    let bent = [[0.0, 0.0], [0.1, 0.02], [0.2, 0.04], [0.25, 0.08], [0.3, 0.12]];
    assert_eq!(Section::new(&bent), Section::new(&[bent[0], bent[2], bent[4]]));
}

/// What lies beyond the place where an outline first turns back is no part of the bottom: side hulls, the outer part beyond a step. Formulas refuse it.
#[test]
fn an_outline_that_reaches_farther_out_than_its_bottom_is_for_flows_that_are_followed() {
    let whole = |half: &[[f64; 2]]| -> Vec<[f64; 2]> {
        half.iter().copied().chain(half.iter().rev().filter(|p| p[0] > 0.0).map(|[x, y]| [-x, *y])).collect()
    };
    let side_hull = whole(&[[0.0, 0.0], [0.6, 0.4], [0.6, 0.1], [1.0, 0.52]]);
    let step = whole(&[[0.0, 0.0], [0.5, 0.15], [0.5, 0.25], [1.0, 0.4], [1.0, 0.8]]);
    let flared = whole(&[[0.0, 0.0], [0.6, 0.4], [0.6, 0.1], [1.0, 2.0]]);
    for (points, y) in [(side_hull, 0.5), (step, 0.5), (flared, 1.9)] {
        let section = Section::of_polygon(&points).expect("a section");
        assert!(section.is_beyond([0.95, y]) && !section.is_beyond([1.05, y]) && !section.is_beyond([0.45, 0.45]));
        let error = EntryModel::Mlm.covers(&section, 0.0).expect_err("more than a bottom").to_string();
        assert!(error.contains("reaches farther out"), "{error}");
    }
    let high_deck = whole(&[[0.0, 0.0], [0.5, 0.15], [0.5, 1.2], [0.8, 1.2]]);
    assert!(Section::of_polygon(&high_deck).is_ok());
}

/// Half an ellipse in 25 points: a bottom that bends begins on its convex hull.
#[test]
fn the_convex_hull_of_a_round_bottom_is_round() {
    let at = |k: i32| f64::from(k) * std::f64::consts::FRAC_PI_2 / 24.0;
    let section = Section::new(&(0..=24).map(|k| [1.3 * at(k).sin(), 1.1 * (1.0 - at(k).cos())]).collect::<Vec<_>>());
    let section = section.expect("a section");
    assert!(section.is_round() && section.radius().is_none() && section.convex().is_round());
}

#[test]
fn the_error_of_a_hollow_gives_its_depth_and_place() {
    let section = Section::new(&[[0.0, 0.0], [0.2, 0.1], [0.4, 0.15]]).expect("a section");
    let error = EntryModel::Mlm.covers(&section, 0.0).expect_err("a hollow").to_string();
    assert!(error.contains("0.025 m deep at 0.2 m") && error.contains("\"boundary_element\""), "{error}");
    assert!(section.convex().hollow().is_none() && section.convex().corners.len() == 2);
    assert!(Section::new(&rounded(2e-3)).expect("a section").hollow().is_some());
}
