//! Potential flow about bottoms given by points of a curve (THEORY EN30, EN49): against the arc, scaling, and the number of points.

use std::f64::consts::TAU;

use water_entry::Section;

/// Draught, force and added mass, step by step, at 1 m/s without gravity.
fn loads(section: &Section, from: f64, to: f64) -> Vec<[f64; 3]> {
    super::potential_flow_bent::loads(section, from, to, 1.0)
}

/// Mean force between two draughts.
fn mean(rows: &[[f64; 3]], from: f64, to: f64) -> f64 {
    let within = rows.windows(2).filter(|w| w[0][0] >= from && w[1][0] <= to);
    let [sum, length] = within.fold([0.0; 2], |[sum, length], w| {
        let dh = w[1][0] - w[0][0];
        [sum + 0.5 * (w[0][1] + w[1][1]) * dh, length + dh]
    });
    sum / length
}

fn outline(at: impl Fn(f64) -> [f64; 2], points: usize) -> Section {
    let points: Vec<[f64; 2]> = (0..points).map(|k| at(TAU * k as f64 / points as f64)).collect();
    Section::of_polygon(&points).expect("a section")
}

/// Points of an arc give the flow about it, as long as it is attached; with steps of other lengths both scatter by 0.7 %.
#[test]
fn points_of_an_arc_are_the_arc() {
    let exact = loads(&Section::arc(1.0, 1.9).expect("a section"), 0.02, 0.17);
    for points in [6_u32, 12, 40] {
        let at = |k: u32| 1.25 * f64::from(k) / f64::from(points);
        let corners: Vec<[f64; 2]> = (0..=points).map(at).map(|t| [t.sin(), 1.0 - t.cos()]).collect();
        let section = Section::new(&corners).expect("a section");
        let found = loads(&section, 0.02, 0.17);
        for [from, to] in [[0.02, 0.05], [0.05, 0.1], [0.1, 0.16]] {
            let error = mean(&found, from, to) / mean(&exact, from, to) - 1.0;
            assert!(section.is_round() && error.abs() < 0.01, "{points} points, from {from} m: {error:+.4}");
        }
    }
}

/// Flat and sharp ellipses and an ovoid that is widest above its middle do not depend on the number of their points, and all of them are followed to
/// half their height, past the place where the flow leaves them.
#[test]
fn forces_do_not_depend_on_the_number_of_points() {
    let flat = |t: f64| [t.sin(), -0.6 * t.cos()];
    let sharp = |t: f64| [t.sin(), -1.8 * t.cos()];
    let ovoid = |t: f64| [t.sin() * (1.0 - 0.25 * t.cos()), -1.3 * t.cos()];
    let of = |points: usize| [outline(flat, points), outline(sharp, points), outline(ovoid, points)];
    for ((name, coarse), fine) in ["flat", "sharp", "ovoid"].into_iter().zip(of(41)).zip(of(160)) {
        let [coarse, fine] = [coarse, fine].map(|section| loads(&section, 0.03, 0.5));
        for [from, to] in [[0.04, 0.08], [0.08, 0.16], [0.16, 0.3], [0.3, 0.48]] {
            let error = mean(&coarse, from, to) / mean(&fine, from, to) - 1.0;
            assert!(error.abs() < 0.02, "{name}, from {from} m: {error:+.4}");
        }
    }
}

/// A round keel between straight sides of 30 degrees is, deep enough, a wedge whose keel lies where the sides meet.
#[test]
fn a_rounded_keel_is_forgotten() {
    let (radius, slope) = (0.05, 30.0_f64.to_radians());
    let mut corners: Vec<[f64; 2]> =
        (0..=6).map(|k| slope * f64::from(k) / 6.0).map(|t| [radius * t.sin(), radius * (1.0 - t.cos())]).collect();
    let [x, y] = corners[6];
    corners.push([1.0, y + (1.0 - x) * slope.tan()]);
    let rows = loads(&Section::new(&corners).expect("a section"), 0.01, 0.3);
    let exact = water_entry::SimilarityFlow::solve(30.0).expect("a solution").force_coefficient;
    let lowest = radius * (1.0 / slope.cos() - 1.0);
    for h in [0.15, 0.25] {
        let found = mean(&rows, h - 0.02, h + 0.02) / (h + lowest);
        assert!((found / exact - 1.0).abs() < 0.015, "at {h} m: {found} for {exact}");
    }
}
