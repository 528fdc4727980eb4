//! Stations with outlines, pressures along the girth, struts (THEORY EN54–EN56): arcs as points, hand integrals, a linear drop.

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_4, PI};

use evidence::landing::{CENTRE, RHO, landing, prism, station};
use water_entry::EntryModel;
use water_entry::ditching::{
    Form, Fuselage, GirthPressure, GirthRange, HalfSection, Hull, Landing, LandingResult, LandingState, Strut,
    StrutSpring, Window,
};

/// Radii and keels of a fuselage of circles, from the nose aft: x, radius, keel.
const CIRCLES: [[f64; 3]; 6] =
    [[0.0, 0.5, 1.2], [3.0, 1.4, 0.3], [6.0, 1.9, 0.0], [14.0, 1.9, 0.0], [17.0, 1.5, 0.5], [20.0, 0.7, 1.3]];

/// Points around a circle; half of it where `turn` is π.
fn circle(radius: f64, count: usize, turn: f64) -> Vec<[f64; 2]> {
    let at = |k: usize| turn * k as f64 / count as f64;
    (0..count).map(|k| [radius * at(k).sin(), -radius * at(k).cos()]).collect()
}

fn hull(form: impl Fn(f64) -> Form) -> Hull {
    let stations = CIRCLES.map(|[x, r, keel]| station(x, keel, 2.0 * r * FRAC_PI_4.sin(), form(r)));
    Hull::new(Fuselage::new(&stations).expect("a fuselage"), EntryModel::Mlm).expect("in range")
}

fn landed(hull: &Hull) -> LandingResult {
    let plain = landing(hull, 9.81, 3e4);
    Landing { strips: 150, step: 1e-3, sample_every: 1, end: 0.8, ..plain }.solve()
}

/// A fuselage of arcs, and the same as outlines of 40 points to the side, whole and half: path and peak of the load agree within 1 %.
#[test]
fn outlines_of_arcs_land_as_the_arcs() {
    let outline = |turn: f64, count: usize| {
        move |r: f64| Form::Outline(HalfSection::of_outline(&circle(r, count, turn)).expect("a section").points)
    };
    let peak = |run: &LandingResult| run.moments.iter().map(|m| m.force[1]).fold(0.0, f64::max);
    let place = |run: &LandingResult| run.moments[run.moments.len() - 1].attitude.place;
    let arcs = landed(&hull(Form::Radius));
    for (turn, count) in [(2.0 * PI, 80), (PI, 60)] {
        let outlines = landed(&hull(outline(turn, count)));
        println!("peaks {:.4}, places {:?} {:?}", peak(&outlines) / peak(&arcs) - 1.0, place(&outlines), place(&arcs));
        assert!((peak(&outlines) / peak(&arcs) - 1.0).abs() < 0.01);
        let [ours, theirs] = [place(&outlines), place(&arcs)];
        assert!(
            (ours[0] / theirs[0] - 1.0).abs() < 0.01
                && (ours[1] - theirs[1]).abs() < 0.01
                && (ours[2] - theirs[2]).abs() < 0.01
        );
    }
    let mixed = Cell::new(false);
    let alternating = hull(|r| match mixed.replace(!mixed.get()) {
        true => Form::Radius(r),
        false => outline(2.0 * PI, 80)(r),
    });
    assert!((peak(&landed(&alternating)) / peak(&arcs) - 1.0).abs() < 0.01);
}

/// Ovoids whose proportions change from station to station, a wedge among them: every section between them is in the range of the theories.
#[test]
fn ovoids_of_changing_proportions_are_lofted() {
    let ovoid = |k: usize| {
        let wide = 1.0 + 0.03 * k as f64;
        let points: Vec<[f64; 2]> = circle(1.4, 72, 2.0 * PI).into_iter().map(|[x, z]| [wide * x, z]).collect();
        HalfSection::of_outline(&points).expect("a section")
    };
    for model in [EntryModel::Wagner, EntryModel::Mlm] {
        let mut stations: Vec<_> =
            (0..5).map(|k| station(3.0 * k as f64, 0.0, ovoid(k).breadth(), Form::Outline(ovoid(k).points))).collect();
        stations.push(station(16.0, 0.1, 1.9, Form::DeadriseDeg(20.0)));
        let hull = Hull::new(Fuselage::new(&stations).expect("a fuselage"), model).expect("in range");
        let force = |x: f64| hull.at(x, 0.08).slam;
        for k in 0..4 {
            let x = 3.0 * f64::from(k);
            let (between, mean) = (force(x + 1.5), 0.5 * (force(x) + force(x + 3.0)));
            assert!((between / mean - 1.0).abs() < 0.03, "{model:?} at {x}: {between}, {mean}");
        }
    }
}

/// A wedge whose chines are dry, at constant speed: over shares of the girth the pressure of EN5 integrates to
/// ρ V² [ċ/V arcsin(y/c) − ½ cos²β c artanh(y/c) …] / cos β, here by a fine sum of the formula itself over the girth of the windows.
#[test]
fn windows_have_the_mean_of_the_pressure_of_a_wedge() {
    let (deadrise, draught, speed) = (20.0_f64, 0.3, 6.0);
    let hull = prism(EntryModel::Mlm, deadrise);
    let plain = landing(&hull, 0.0, 5e4);
    let mut attitude =
        water_entry::ditching::Attitude { place: [0.0, 0.0, 0.0], rate: [0.0, -speed, 0.0], ..Default::default() };
    attitude.place[1] = -draught - attitude.of_point(CENTRE, [10.0, 0.0])[1];
    let mut now = plain.moment(0.0, attitude, &[]);
    // the same water at constant speed
    now.acceleration = [0.0; water_entry::ditching::FREEDOMS];
    now.strips.iter_mut().for_each(|(strip, force)| *force = strip.entry.map_or(0.0, |e| e.force([0.0; 7])));
    let tan = deadrise.to_radians().tan();
    let c = 0.5 * PI * draught / tan;
    let growth = 0.5 * PI / tan;
    let pressure = |y: f64| {
        let q = c / (c * c - y * y).sqrt();
        let across = 1.0 / (1.0 + tan * tan);
        (RHO * speed * speed * (growth * q - 0.5 * (across * q * q + 1.0 - across))).max(0.0)
    };
    let girth = hull.girth(10.0);
    assert!((girth * deadrise.to_radians().cos() - 2.0).abs() < 1e-9);
    for [low, high] in [[0.0, 0.2], [0.1, 0.5], [0.0, 1.0]] {
        let window = Window { name: "exit".into(), ends: [4.0, 12.0], girth: GirthRange::Share([low, high]) };
        let count = 200_000;
        let y = |k: f64| 2.0 * (low + (high - low) * k / f64::from(count));
        let exact: f64 =
            (0..count).map(|k| y(f64::from(k) + 0.5)).filter(|y| *y < c).map(pressure).sum::<f64>() / f64::from(count);
        let ours = window.mean_pressure(&plain, &now, window.area(&hull));
        println!("{low} to {high}: {ours} Pa, by hand {exact} Pa: {:.4}", ours / exact - 1.0);
        assert!((ours / exact - 1.0).abs() < 0.01, "{low} to {high}: {ours}, by hand {exact}");
    }
    // by heights the same; and both sides together carry the load of the strip
    let heights = Window { name: "low".into(), ends: [4.0, 12.0], girth: GirthRange::Height([0.0, 0.2 * 2.0 * tan]) };
    let shares = Window { girth: GirthRange::Share([0.0, 0.2]), ..heights.clone() };
    let of = |window: &Window| window.mean_pressure(&plain, &now, window.area(&hull));
    assert!((of(&heights) / of(&shares) - 1.0).abs() < 1e-9);
    let (strip, force) = now.strips[now.strips.len() / 2];
    let part = strip.entry.expect("it enters");
    let along = GirthPressure::new(&hull, &part, force, &now.acceleration, RHO).expect("a pressure");
    let upwards = 2.0 * along.over([0.0, girth]) * deadrise.to_radians().cos() * part.length;
    assert!((upwards / force - 1.0).abs() < 1e-9, "{upwards} of {force}");
}

/// A drop on a strut with a float of upright sides: two springs in series below a mass, m z̈ = −k z, one half swing; the foot's mass is a
/// hundredth of a thousandth of it.
#[test]
fn a_drop_on_a_linear_strut_is_half_a_swing() {
    let hull = prism(EntryModel::VonKarman, 25.0);
    let (mass, sink, stiffness, waterplane) = (2e4, 1.0, 2e5, 30.0);
    let strut = Strut {
        name: "float".into(),
        number: 2.0,
        foot: [CENTRE[0], -6.0],
        mass: 0.05,
        stroke: 3.0,
        preload: 0.0,
        spring: StrutSpring::Linear(stiffness),
        damping: 100.0,
        orifice: 0.0,
        breaks_at: None,
        face: [1.0, 1.0],
        drag: 0.0,
        waterplane,
    };
    let plain = landing(&hull, 9.81, mass);
    let aeroplane = water_entry::ditching::Aeroplane { struts: vec![strut], ..plain.aeroplane.clone() };
    let of_water = RHO * 9.81 * waterplane;
    let series = 2.0 * stiffness * of_water / (stiffness + of_water);
    let omega = (series / mass).sqrt();
    let run = Landing {
        aeroplane,
        pitch: 0.0,
        path: -0.5 * PI,
        speed: sink,
        step: 1e-4,
        sample_every: 10,
        end: 0.6,
        least_speed: -1.0,
        ..plain
    }
    .solve();
    let (first, count) = (run.moments[0].attitude.place[1], run.moments.len());
    assert!(count > 500, "{:?}", run.ended);
    let swings = |m: &LandingState| {
        let t = m.time;
        // m z̈ = −K (z − z₀) − m g, z(0) = z₀, ż = −V
        let sag = mass * 9.81 / series;
        first - sag + sag * (omega * t).cos() - sink / omega * (omega * t).sin()
    };
    let furthest = run.moments.iter().map(|m| (m.attitude.place[1] - swings(m)).abs()).fold(0.0, f64::max);
    let lowest = run.moments.iter().map(|m| first - m.attitude.place[1]).fold(0.0, f64::max);
    println!("way {lowest} m, furthest {furthest} m from the exact one");
    assert!(lowest > 0.4 && furthest < 2e-3 * lowest, "{furthest} of {lowest}");
}
