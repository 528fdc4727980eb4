//! Planing (THEORY EN42–EN46): exact limits, and the towing tanks of Savitsky 1964.

use std::f64::consts::PI;

use water_entry::ditching::{
    Aeroplane, Attitude, Form, Fuselage, Hull, Landing, LandingState, Station, Swell, Water, Wing,
};
use water_entry::planing::{CENTRE_BAND, Immersion, LIFT_BAND, LiftingSurface, Planing, PlaningHull, finite_length};
use water_entry::{EntryModel, Loads, Section};

/// No gravity for a hull: C_v is a thousand times that of any test.
const NO_GRAVITY: f64 = 1e-8;

fn hull(deadrise_deg: f64, trim_deg: f64, froude: f64) -> PlaningHull {
    let speed = froude * 9.81_f64.sqrt();
    PlaningHull { breadth: 1.0, deadrise_deg, trim_deg, speed, density: 1000.0, gravity: 9.81 }
}

fn planes(hull: &PlaningHull, wetted_length: f64) -> Planing {
    hull.planes(Immersion::WettedLength(wetted_length)).expect("in range")
}

/// Slope of the lift coefficient of a thin wing, both sides, whose half breadth at a share of its length is given.
fn wing(length: f64, half_breadth: impl Fn(f64) -> f64) -> (f64, f64) {
    let n = 80;
    let at = |k: usize| (k as f64 + 0.75) / n as f64;
    let loads = LiftingSurface::new(length / n as f64, (0..n).map(|k| half_breadth(at(k))).collect()).thin_surface();
    let lift: f64 = loads.iter().sum();
    let area = length * (0..n).map(|k| 2.0 * half_breadth((k as f64 + 0.5) / n as f64)).sum::<f64>() / n as f64;
    let moment: f64 = loads.iter().enumerate().map(|(k, load)| load * (k as f64 + 0.25) / n as f64).sum();
    (4.0 * lift / area, moment / lift)
}

/// The lifting surface: rectangles by Helmbold (1942), which holds the limits ½π A (Jones 1946) and 2π; a long one loads its front, a short
/// one its quarter point; a slender triangle the centre of its area.
#[test]
fn the_lifting_surface_has_the_limits_of_wings() {
    for aspect in [0.05, 0.5, 1.0, 2.0, 4.0] {
        let (slope, centre) = wing(1.0 / aspect, |_| 0.5);
        let helmbold = 2.0 * PI * aspect / (2.0 + (4.0 + aspect * aspect).sqrt());
        assert!((slope / helmbold - 1.0).abs() < 0.05, "{aspect}: {slope}, Helmbold {helmbold}");
        assert!(centre < 0.25, "{aspect}: {centre}");
    }
    let (slope, centre) = wing(1e-2, |_| 0.5);
    assert!((slope / (2.0 * PI) - 1.0).abs() < 0.1 && (centre - 0.25).abs() < 0.01, "{slope}, {centre}");
    let (slope, centre) = wing(40.0, |share| 0.5 * share);
    assert!((slope / (0.5 * PI / 20.0) - 1.0).abs() < 0.03 && (centre - 2.0 / 3.0).abs() < 0.02, "{slope}, {centre}");
}

/// Dry chines, no gravity: the strips are ½ρ (A/h) h² U² tan τ, as in a landing; a long hull keeps them, a short one the share of its length.
#[test]
fn a_long_hull_has_the_lift_of_its_strips() {
    let hull = PlaningHull { gravity: NO_GRAVITY, ..hull(25.0, 1.0, 8.0) };
    let load = hull.planes(Immersion::Draught(0.07)).expect("in range");
    assert!(load.wetted.chine == 0.0 && load.wetted.breadth < 1.0);
    let section = Section::wedge(25.0, 1.0).expect("a section");
    let per_draught = Loads::new(EntryModel::Mlm, &section).expect("in range").at(0.01).slam / 0.01;
    let exact = 0.5 * hull.density * per_draught * 0.07_f64.powi(2) * hull.speed.powi(2) * 1.0_f64.to_radians().tan();
    assert!((load.strip_lift / exact - 1.0).abs() < 2e-3, "{}, exact {exact}", load.strip_lift);
    for length in [1.0, 5.0, 20.0] {
        let load = planes(&hull, length);
        if load.wetted.chine > 0.0 {
            assert!((load.lift / load.strip_lift / finite_length(load.wetted.mean) - 1.0).abs() < 1e-6);
        }
    }
    let [half, long] = [1.0, 1e6].map(finite_length);
    assert!((half - 0.5_f64.sqrt()).abs() < 1e-12 && (long - 1.0).abs() < 1e-9 && finite_length(0.0) == 0.0);
}

/// The distribution has the lift and its place; no load at the step; a hull twice as large at the same C_v has the same coefficients; the
/// pressure stands across the keel; draught and wetted length are one immersion.
#[test]
fn the_load_is_the_sum_of_its_slices() {
    let small = hull(20.0, 6.0, 6.0);
    let load = planes(&small, 2.0);
    let ahead: Vec<f64> = load.slices.iter().map(|s| s.ahead).collect();
    let length = ahead[0] - ahead[1];
    let sum: f64 = load.slices.iter().map(|s| s.lift_per_m * length).sum();
    let moment: f64 = load.slices.iter().map(|s| s.lift_per_m * s.ahead * length).sum();
    assert!((sum / load.lift - 1.0).abs() < 1e-9 && (moment / sum / load.centre - 1.0).abs() < 1e-9);
    let most = load.slices.iter().map(|s| s.lift_per_m).fold(0.0, f64::max);
    let last = load.slices[load.slices.len() - 1].lift_per_m;
    assert!(last > 0.0 && last < 0.2 * most, "{last}, {most}");
    assert!((load.pressure_drag / load.lift - 6.0_f64.to_radians().tan()).abs() < 1e-12);
    assert!((load.wetted.keel - load.wetted.chine - small.spray_root()).abs() < 1e-12 && load.wetted.mean == 2.0);

    let large = PlaningHull { breadth: 4.0, speed: 2.0 * small.speed, ..small };
    let scaled = planes(&large, 2.0);
    assert!((scaled.lift_coefficient / load.lift_coefficient - 1.0).abs() < 1e-9);
    assert!((scaled.centre / load.centre - 4.0).abs() < 1e-6);
    let again = small.planes(Immersion::Draught(load.wetted.draught)).expect("in range");
    assert!((again.lift / load.lift - 1.0).abs() < 1e-9);
}

#[test]
fn what_the_method_does_not_hold_for_is_refused() {
    let good = hull(20.0, 6.0, 6.0);
    for (wrong, immersion, what) in [
        (PlaningHull { deadrise_deg: 2.0, ..good }, Immersion::WettedLength(2.0), "deadrise_deg"),
        (PlaningHull { trim_deg: 0.0, ..good }, Immersion::WettedLength(2.0), "trim_deg"),
        (PlaningHull { speed: 1.0, ..good }, Immersion::WettedLength(2.0), "speed"),
        (PlaningHull { breadth: -1.0, ..good }, Immersion::WettedLength(2.0), "breadth"),
        (good, Immersion::WettedLength(0.0), "wetted_length"),
        (good, Immersion::Draught(f64::NAN), "draught"),
    ] {
        assert_eq!(wrong.planes(immersion).expect_err("out of range").what, what);
    }
    let why = |hull: PlaningHull, length: f64| hull.not_judged(&planes(&hull, length).wetted).unwrap_or_default();
    assert_eq!(why(good, 2.0), "");
    assert!(why(hull(35.0, 6.0, 6.0), 2.0).contains("deadrise of 35"));
    assert!(
        why(hull(20.0, 6.0, 2.0), 4.0).contains("length of 4") && why(hull(20.0, 6.0, 2.0), 4.0).contains("C_v of 2")
    );
    assert!(why(hull(30.0, 4.0, 6.0), 1.0).contains("chines are dry"));
    assert!(why(hull(30.0, 4.0, 6.0), 2.0).contains("dry chines on 2.63 breadths"));
}

/// Rows of the table: deadrise, trim, length, C_v, C_L, C_L without gravity, place.
fn towing_tanks() -> Vec<[f64; 7]> {
    let file =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/scene/reference/external/planing_vhull_savitsky1964.csv");
    let text = std::fs::read_to_string(file).expect("a table");
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let numbers = |line: &str| line.split(',').map(|cell| cell.parse().expect("a number")).collect::<Vec<f64>>();
    rows.map(numbers).map(|r| [0, 1, 2, 3, 5, 7, 8].map(|k| r[k])).collect()
}

/// Largest errors of lift [-] and place, over the wetted length [-].
const LARGEST: [f64; 2] = [0.11, 0.055];

/// Both bands hold for nine hulls of ten at least.
fn assert_share(held: &[bool]) {
    let count = held.iter().filter(|holds| **holds).count();
    assert!(10 * count >= 9 * held.len(), "{count} of {}", held.len());
}

/// Lift with and without gravity and its place, of all hulls of the table in the range.
#[test]
fn lift_and_its_place_are_those_of_towing_tanks() {
    let (mut lifts, mut places, mut held) = (Vec::new(), Vec::new(), Vec::new());
    for [deadrise, trim, length, froude, with, without, place] in towing_tanks() {
        if deadrise < 10.0 {
            continue; // a flat bottom has no section
        }
        let hull = hull(deadrise, trim, froude);
        let load = planes(&hull, length);
        let dynamic = planes(&PlaningHull { gravity: NO_GRAVITY, ..hull }, length);
        let errors = [load.lift_coefficient / with - 1.0, dynamic.lift_coefficient / without - 1.0];
        let off = load.centre / length - place;
        let case = format!("{deadrise}, {trim}, {length}, {froude}: {errors:.3?}, {off:.3}");
        if hull.not_judged(&load.wetted).is_some() {
            assert!(deadrise == 30.0 && trim == 4.0 && errors.iter().all(|e| e.abs() < 0.15), "{case}");
            continue;
        }
        assert!(errors[0].abs() < LARGEST[0] && errors[1].abs() < 0.115 && off.abs() < LARGEST[1], "{case}");
        held.push(errors[0].abs() < LIFT_BAND && off.abs() < CENTRE_BAND);
        lifts.extend(errors);
        places.push(off);
    }
    let rms = |of: &[f64]| (of.iter().map(|e| e * e).sum::<f64>() / of.len() as f64).sqrt();
    assert!(lifts.len() == 198 && rms(&lifts) < 0.052 && rms(&places) < 0.027, "{}, {}", rms(&lifts), rms(&places));
    assert_share(&held);
    let without_ends: Vec<f64> = towing_tanks()
        .iter()
        .filter(|r| r[0] >= 10.0 && r[2] == 1.0 && r[0] + 2.0 * r[1] > 38.5)
        .map(|r| planes(&hull(r[0], r[1], r[3]), 1.0).strip_lift / (0.5 * 1000.0 * 9.81 * r[3] * r[3]) / r[4] - 1.0)
        .collect();
    assert!(without_ends.iter().all(|e| *e > 0.3), "{without_ends:.2?}");
}

/// Savitsky's formula: C_L, and the centre of pressure over the wetted length.
fn savitsky(deadrise: f64, trim: f64, length: f64, froude: f64) -> [f64; 2] {
    let flat = trim.powf(1.1) * (0.0120 * length.sqrt() + 0.0055 * length.powf(2.5) / froude.powi(2));
    let centre = 0.75 - 1.0 / (5.21 * (froude / length).powi(2) + 2.39);
    [flat - 0.0065 * deadrise * flat.powf(0.6), centre]
}

/// Between the rows of the table, all that has a band is within it.
#[test]
fn bands_hold_between_the_rows_of_the_table() {
    let (mut judged, mut worst, mut held) = (0, [0.0_f64; 2], Vec::new());
    for deadrise in [10.0, 12.5, 15.0, 17.5, 22.5, 25.0, 27.5, 30.0] {
        for trim in [4.0, 5.0, 7.0, 8.0, 10.0, 11.0, 12.0] {
            for length in [1.0, 1.25, 1.5, 1.75, 2.25, 2.5, 2.75, 3.0] {
                for froude in [4.0, 5.0, 7.0, 10.0, 12.0] {
                    let hull = hull(deadrise, trim, froude);
                    let load = planes(&hull, length);
                    if hull.not_judged(&load.wetted).is_some() {
                        continue;
                    }
                    let [coefficient, centre] = savitsky(deadrise, trim, length, froude);
                    let errors = [load.lift_coefficient / coefficient - 1.0, load.centre / length - centre];
                    judged += 1;
                    worst = [0, 1].map(|k| worst[k].max(errors[k].abs()));
                    held.push(errors[0].abs() < LIFT_BAND && errors[1].abs() < CENTRE_BAND);
                    let within = errors[0].abs() < LARGEST[0] && errors[1].abs() < LARGEST[1];
                    assert!(within, "{deadrise}, {trim}, {length}, {froude}: {errors:.3?}");
                }
            }
        }
    }
    println!("{judged} hulls, worst {worst:.4?}");
    assert!(judged > 1500, "{judged}");
    assert_share(&held);
}

/// The water's force on a long prismatic fuselage of the breadth 1 that planes on its end.
fn prism_lift(deadrise: f64, trim: f64, length: f64, finite_length: bool) -> f64 {
    let ends = [0.0, 12.0].map(|x| Station { x, keel: 0.0, breadth: 1.0, form: Form::DeadriseDeg(deadrise) });
    let hull = Hull::new(Fuselage::new(&ends).expect("a fuselage"), EntryModel::Mlm).expect("in range");
    let wing = Wing {
        area: 0.0,
        chord: 1.0,
        lift_slope: 0.0,
        zero_lift_deg: 0.0,
        pitch_stiffness: 0.0,
        pitch_damping: 0.0,
        trim_deg: None,
        drag: 0.0,
        air_density: 0.0,
    };
    let centre = [6.0, 0.0];
    let aeroplane = Aeroplane {
        struts: Vec::new(),
        mass: 1e12,
        inertia: 1e14,
        centre,
        wing,
        surfaces: Vec::new(),
        nacelles: Vec::new(),
        panels: Vec::new(),
        bending: None,
    };
    let water = Water { gravity: NO_GRAVITY, friction: 0.0, finite_length, ..Water::default() };
    let pitch = trim.to_radians();
    let landing = Landing {
        hull: &hull,
        aeroplane,
        water,
        swell: Swell::default(),
        pitch,
        path: 0.0,
        speed: 40.0,
        strips: 1200,
        step: 1e-3,
        sample_every: 1,
        end: 1.0,
        least_speed: 1.0,
    };
    let wetted =
        PlaningHull { breadth: 1.0, deadrise_deg: deadrise, trim_deg: trim, speed: 40.0, density: 1.0, gravity: 9.81 }
            .wetted(Immersion::WettedLength(length))
            .expect("in range");
    let height = 6.0 * pitch.sin() - wetted.draught;
    let attitude = Attitude { place: [0.0, height, pitch], rate: [40.0, 0.0, 0.0], ..Attitude::default() };
    let now: LandingState = landing.moment(0.0, attitude, &[]);
    now.force[1] / (0.5 * 1000.0 * 1600.0)
}

/// A landing that planes on its end at constant trim (the towing tank of a landing): with the share of the finite length within 11 % of tanks
/// for all lengths; without it 30 to 40 % high for the short one.
#[test]
fn a_fuselage_that_planes_on_its_end_has_the_lift_of_towing_tanks() {
    for (deadrise, trim) in [(10.0, 4.0), (10.0, 6.0), (15.0, 6.0), (20.0, 6.0), (20.0, 12.0), (30.0, 9.0)] {
        for length in [1.0, 2.0, 3.0] {
            let [reference, _] = savitsky(deadrise, trim, length, 1e6);
            let [with, without] = [true, false].map(|f| prism_lift(deadrise, trim, length, f) / reference - 1.0);
            assert!(with.abs() < 0.12, "{deadrise}, {trim}, {length}: {with}, {without}");
            assert!(length > 1.0 || without > 0.3, "{deadrise}, {trim}: {without}");
        }
    }
}
