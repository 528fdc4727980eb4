//! Landings on swell (THEORY EN36–EN38): calm water in other frames, balances of momentum and energy, encounter, first contact, refusals.

use std::f64::consts::{PI, TAU};

use evidence::landing::{RHO, landing, prism, tapered_hull};
use scenarios::ditching::{self, Landed};
use water_entry::EntryModel;
use water_entry::ditching::{Attitude, Landing, LandingState, Swell};

const G: f64 = 9.81;

fn mercure(sets: &[&str]) -> Landed {
    let sets: Vec<String> = sets.iter().map(|s| s.to_string()).collect();
    ditching::follow(&ditching::load("mercure", &sets).expect("a landing"))
}

/// The sets of a sea.
fn sea(height: f64, length: f64, heading: f64, touchdown: &str) -> [String; 4] {
    [
        format!("sea.height={height:?}"),
        format!("sea.length={length:?}"),
        format!("sea.heading_deg={heading:?}"),
        format!("sea.touchdown={touchdown}"),
    ]
}

fn mercure_on(sea: &[String; 4], more: &[&str]) -> Landed {
    mercure(&sea.iter().map(String::as_str).chain(more.iter().copied()).collect::<Vec<_>>())
}

/// Waves without height are calm water, in each direction and at each phase, to the bit.
#[test]
fn waves_without_height_are_calm_water_to_the_bit() {
    let calm = mercure(&["landing.end=0.6"]);
    assert!(calm.summary.sea.is_none() && calm.series.column("elevation_m").is_none());
    for (heading, touchdown) in [(0.0, "crest"), (90.0, "down_slope"), (180.0, "217.5")] {
        let flat = mercure_on(&sea(0.0, 80.0, heading, touchdown), &["landing.end=0.6"]);
        for name in &calm.series.columns {
            let [a, b] = [&calm, &flat].map(|landed| landed.series.column(name).expect("a column"));
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&a), bits(&b), "{heading}, {touchdown}: {name}");
        }
    }
}

/// Difference of a landing on very long waves from one on calm water that is at the level of the surface and moves with the water: of speeds
/// over those of the landing, of accelerations over the largest.
fn difference_from_moving_water(length: f64, heading: f64, phase: f64) -> f64 {
    let hull = prism(EntryModel::Mlm, 25.0);
    let mut calm = landing(&hull, G, 5e4);
    (calm.strips, calm.step, calm.sample_every) = (100, 1e-3, 2);
    let frequency = (TAU * G / length).sqrt();
    let mut on_waves = calm.clone();
    on_waves.swell = Swell::new(2.0 * 0.8 / frequency, length, heading, G).with_phase_at(0.0, phase);
    let water = on_waves.swell.water(0.0);
    let [u, w] = [calm.speed * calm.path.cos() - water.velocity[0], calm.speed * calm.path.sin() - water.velocity[1]];
    let shifted = Landing { speed: u.hypot(w), path: w.atan2(u), ..calm.clone() };
    let (a, b) = (on_waves.solve().moments, shifted.solve().moments);
    assert_eq!(a.len(), b.len());
    let largest = b.iter().map(|m| m.acceleration[1].abs()).fold(0.0, f64::max);
    assert!(largest > 0.3 * G, "the water stops it: {largest}");
    let mut worst: f64 = 0.0;
    for (a, b) in a.iter().zip(&b) {
        let drift = [water.velocity[0], water.velocity[1], 0.0];
        let level = [0.0, water.elevation, 0.0];
        for k in 0..3 {
            worst = worst.max((a.attitude.rate[k] - b.attitude.rate[k] - drift[k]).abs() / calm.speed);
            worst = worst.max((a.acceleration[k] - b.acceleration[k]).abs() / largest);
            let way = a.attitude.place[k] - b.attitude.place[k] - level[k] - drift[k] * a.time;
            worst = worst.max(way.abs() / 20.0);
        }
    }
    worst
}

/// On very long waves the water is calm in a frame that moves with it (Galileo): the difference falls with the slope, as the root of the length.
#[test]
fn very_long_waves_are_calm_water_that_moves() {
    for (heading, phase) in [(0.0, 5.0), (PI, 5.0), (PI, 0.0), (0.0, PI), (0.5 * PI, 2.0), (2.0, 1.5)] {
        let [long, longer] = [1e10, 1e12].map(|length| difference_from_moving_water(length, heading, phase));
        println!("{heading}, {phase}: {long:.2e} {longer:.2e}");
        assert!(longer < 1e-4, "{heading}, {phase}: {long}, {longer}");
        assert!(longer < 0.2 * long, "{heading}, {phase}: {long}, {longer}");
    }
    // vertical speed of the water is what is seen: the same landing on calm water that does not move differs
    let hull = prism(EntryModel::Mlm, 25.0);
    let calm = Landing { strips: 100, step: 1e-3, ..landing(&hull, G, 5e4) };
    let mut rising = calm.clone();
    rising.swell = Swell::new(2.0 * 0.8 / (TAU * G / 1e10).sqrt(), 1e10, PI, G).with_phase_at(0.0, 1.5 * PI);
    let most = |landing: &Landing<'_>| landing.solve().moments.iter().map(|m| m.force[1]).fold(0.0, f64::max);
    assert!(most(&rising) > 1.2 * most(&calm), "{} {}", most(&rising), most(&calm));
}

/// A hull that floats at its weight and moves with the water has the acceleration of the water, forward and up: buoyancy acts against gravity less
/// that acceleration.
#[test]
fn a_floating_hull_accelerates_with_the_water() {
    let hull = prism(EntryModel::Wagner, 25.0);
    let mut landing = landing(&hull, G, 5e4);
    (landing.aeroplane.mass, landing.aeroplane.inertia) = (2e4, 2e4 * 25.0);
    let draught = (2e4 / (20.0 * RHO) * 25f64.to_radians().tan()).sqrt();
    for phase in [0.0, 1.0, 2.5, 4.0, 5.5] {
        landing.swell = Swell::new(2e4, 1e6, PI, G).with_phase_at(0.0, phase);
        let water = landing.swell.water(0.0);
        let [u, w] = water.velocity;
        let place = [0.0, water.elevation + 0.5 - draught, landing.swell.slope(0.0).atan()];
        let state = landing.moment(0.0, Attitude { place, rate: [u, w, 0.0], ..Attitude::default() }, &[]);
        for k in 0..2 {
            let (is, exact) = (state.acceleration[k], water.acceleration[k]);
            assert!((is - exact).abs() < 0.03 * PI * 0.02 * G, "{phase}, {k}: {is}, exact {exact}");
        }
    }
}

/// A tapered hull on waves: what it gains in upward momentum the planes of water, the weight and the buoyancy give, and what it loses in
/// energy, with what the waves do on it, is the work Σ f ḣ on the planes: none comes from nowhere.
#[test]
fn momentum_and_energy_balance_on_waves() {
    let hull = tapered_hull();
    for heading in [0.0, 0.5 * PI, 2.5, PI] {
        let mut landing = landing(&hull, G, 5e4);
        (landing.strips, landing.step, landing.sample_every) = (1000, 1e-3, 1);
        landing.swell = Swell::new(2.0, 60.0, heading, G).with_phase_at(0.0, 5.6);
        let run = landing.solve();
        let sums: Vec<Sums> = run.moments.iter().map(|m| Sums::of(&landing, m)).collect();
        let integral = |of: fn(&Sums) -> f64| -> f64 {
            sums.windows(2).map(|w| 0.5 * landing.step * (of(&w[0]) + of(&w[1]))).sum()
        };
        let (first, last) = (&sums[0], &sums[sums.len() - 1]);
        let gained = last.momentum - first.momentum - integral(|s| s.other_force);
        let given = last.held + integral(|s| s.wake) - integral(|s| s.stretching);
        assert!(gained > 0.2 * landing.aeroplane.mass, "{heading}: the water stops it: {gained}");
        assert!((given / gained - 1.0).abs() < 0.01, "{heading}: {given} in the water, {gained} gained");
        println!("momentum {:.5}", given / gained - 1.0);
        let (lost, work) = (first.energy - last.energy, integral(|s| s.work));
        let waves = integral(|s| s.of_waves);
        println!("energy {:.6}", (lost + waves) / work - 1.0);
        assert!(heading == 0.5 * PI || waves.abs() > 0.02 * work, "{heading}: the waves do work: {waves} of {work}");
        assert!(((lost + waves) / work - 1.0).abs() < 1e-3, "{heading}: {work} of work, {lost} lost, {waves} of waves");
    }
}

/// Sums over the planes of water at a moment.
struct Sums {
    momentum: f64,
    energy: f64,
    held: f64,
    wake: f64,
    /// Rate of the momentum of planes that become broader [N].
    stretching: f64,
    /// Weight and buoyancy, upwards [N].
    other_force: f64,
    /// Work per time on the planes, and of the waves on the hull [W].
    work: f64,
    of_waves: f64,
}

impl Sums {
    fn of(landing: &Landing<'_>, m: &LandingState) -> Sums {
        let (mass, inertia, swell) = (landing.aeroplane.mass, landing.aeroplane.inertia, landing.swell.later(m.time));
        let [u, w, q] = m.attitude.rate;
        let energy = 0.5 * mass * (u * u + w * w) + 0.5 * inertia * q * q + mass * G * m.attitude.place[1];
        let entries = || m.strips.iter().filter_map(|(s, f)| Some((s.entry?, *f)));
        let at = |ahead: f64| m.attitude.place[0] + ahead;
        let stretch = |x: f64| (swell.water(x + 0.01).velocity[0] - swell.water(x - 0.01).velocity[0]) / 0.02;
        let last = entries().next_back().filter(|(e, _)| e.at.x > 19.9);
        let buoyancy = m.strips.iter().map(|(s, _)| {
            let water = swell.water(at(s.wet.lever_arm[0])).velocity;
            let power = (0..2).map(|k| s.buoyancy[k] * (s.wet.velocity[k] + water[k])).sum::<f64>();
            [s.buoyancy[1], power]
        });
        let buoyancy = buoyancy.fold([0.0; 2], |sum, b| [sum[0] + b[0], sum[1] + b[1]]);
        let of_waves = entries().map(|(e, f)| {
            let water = swell.water(at(e.at.lever_arm[0])).velocity;
            f * (water[1] - e.at.slope * water[0])
        });
        Sums {
            momentum: mass * w,
            energy,
            held: entries().map(|(e, _)| e.mass * e.at.speed).sum(),
            wake: last.map_or(0.0, |(e, _)| e.mass / e.length * e.at.speed * e.at.velocity[0]),
            stretching: entries().map(|(e, _)| e.mass * e.at.speed * stretch(at(e.at.lever_arm[0]))).sum(),
            other_force: buoyancy[0] - mass * G,
            work: entries().map(|(e, f)| f * e.at.speed).sum(),
            of_waves: of_waves.sum::<f64>() + buoyancy[1],
        }
    }
}

/// The cuts of the fuselage stay in balance on waves, rigid and bending.
#[test]
fn cuts_of_a_mercure_on_waves_are_in_balance() {
    for heading in [0.0, 90.0, 180.0] {
        let on = sea(1.0, 80.0, heading, "crest");
        let rigid = mercure_on(&on, &["landing.end=1.0", "landing.strips=100"]).summary.structure.balance_error;
        let bending =
            mercure_on(&on, &["landing.end=1.0", "landing.strips=100", "beam.stiffness=[1e9, 3e9, 3e9, 1e9]"]);
        let bending = bending.summary.structure.balance_error;
        println!("balance error, heading {heading}: rigid {rigid:.1e}, bending {bending:.1e}");
        assert!(rigid < 1e-9 && bending < 1e-6, "{heading}: {rigid}, {bending}");
    }
}

/// An aeroplane at the speed V meets the waves at ω + k V against them, at ω − k V with them, at ω along the crests; ω² = g k.
#[test]
fn waves_are_met_at_the_frequency_of_encounter() {
    let (length, speed) = (90.0, 55.0);
    let (k, omega) = (TAU / length, (G * TAU / length).sqrt());
    for (heading, exact) in [(180.0, omega + k * speed), (0.0, omega - k * speed), (90.0, omega)] {
        let swell = Swell::new(2.0, length, f64::to_radians(heading), G).with_phase_at(0.0, 0.0);
        assert!((swell.encounter_frequency(speed) / exact - 1.0).abs() < 1e-12, "{heading}");
        for step in 0..200 {
            let t = 0.02 * f64::from(step);
            let elevation = swell.later(t).water(speed * t).elevation;
            assert!((elevation - (exact * t).cos()).abs() < 1e-9, "{heading}, {t}: {elevation}");
        }
    }
    let landed = mercure_on(&sea(1.0, 90.0, 180.0, "crest"), &["landing.end=0.1"]).summary;
    let speed = landed.speed_m_per_s[0];
    let period = landed.sea.expect("a sea").encounter_period_s;
    assert!((period * (omega + k * speed) / TAU - 1.0).abs() < 1e-9, "{period}");
}

/// The first place that gets wet is at the phase that was asked for, to a degree.
#[test]
fn the_first_contact_is_at_the_phase_asked_for() {
    let sampled = ["landing.end=0.05", "landing.sample_every=0.001", "accelerometers=[]"];
    for heading in [0.0, 50.0, 90.0, 130.0, 180.0] {
        for (touchdown, phase) in [("crest", 0.0), ("trough", 180.0), ("up_slope", 270.0), ("305.0", 305.0), ("4", 4.0)]
        {
            let landed = mercure_on(&sea(0.6, 90.0, heading, touchdown), &sampled);
            let sea = landed.summary.sea.expect("a sea");
            let off = |is: f64| (is - phase + 180.0).rem_euclid(360.0) - 180.0;
            assert!(off(sea.touchdown_phase_deg.expect("a phase")).abs() < 1.0, "{heading}, {touchdown}: {sea:?}");
            assert!(sea.closing_speed_m_per_s > 0.0);
            assert!((sea.elevation_m - 0.3 * phase.to_radians().cos()).abs() < 6e-3, "{sea:?}");
            let wet = |m: &&LandingState| !m.strips.is_empty() || m.parts.iter().any(|p| !p.is_empty());
            let first = landed.run.moments.iter().find(wet).expect("it touches");
            let of_parts = first.parts.iter().flatten().map(|p| p.x);
            let places: Vec<f64> = first.strips.iter().map(|(s, _)| s.wet.x).chain(of_parts).collect();
            let swell = landed.swell.later(first.time);
            let of_place = |x: f64| {
                let [ahead, _] = first.attitude.of_point([16.3, -0.3], [x, -1.5]);
                off(swell.phase_at(ahead).to_degrees()).abs()
            };
            let nearest = places.into_iter().map(of_place).fold(f64::INFINITY, f64::min);
            assert!(
                first.time < 0.012 && nearest < 5.0,
                "{heading}, {touchdown}: {nearest} degrees at {} s",
                first.time
            );
        }
    }
}

/// The first 0.6 s, in which the aeroplane meets one slope: the worst accelerometer shows more with higher waves, more on the up slope than on
/// the crest, more against the waves than with them, least along the crests; there the side on which the water rises is the worse one.
#[test]
fn the_first_load_on_waves_follows_the_slope_and_the_heading() {
    const FIRST: [&str; 4] =
        ["landing.end=0.6", "landing.strips=100", "landing.step=0.002", "landing.sample_every=0.004"];
    let worst = |of: &Landed| of.summary.structure.accelerometers.iter().map(|a| a.normal_g.value).fold(0.0, f64::max);
    let load = |height: f64, heading: f64, touchdown: &str| {
        worst(&mercure_on(&sea(height, 200.0, heading, touchdown), &FIRST))
    };
    let calm = worst(&mercure(&FIRST));
    let [low, high] = [1.0, 2.0].map(|height| {
        let [against, with] = [180.0, 0.0].map(|heading| {
            let [crest, trough, up] = ["crest", "trough", "up_slope"].map(|touchdown| load(height, heading, touchdown));
            println!("H = {height} m, heading {heading}: crest {crest:.2}, trough {trough:.2}, up slope {up:.2}; calm {calm:.2} g");
            assert!(crest < 1.05 * calm && trough > 1.1 * calm && up > 1.05 * trough, "{crest} {trough} {up} {calm}");
            up
        });
        let along = ["crest", "trough", "up_slope", "down_slope"].map(|touchdown| load(height, 90.0, touchdown));
        println!("H = {height} m, along the crests {along:.2?}");
        assert!(against > 1.1 * with && along.iter().all(|a| with > 1.1 * a), "{against} {with} {along:?}");
        assert!(along[3] > along[1] && along[1] > 1.02 * along[2], "{along:?}");
        against
    });
    assert!(high > 1.2 * low, "{high} {low}");
}

#[test]
fn seas_that_cannot_be_are_refused_with_their_key() {
    let refused = |sets: &[&str], says: &[&str]| {
        let usual = sea(1.0, 100.0, 180.0, "crest");
        let sets = usual.iter().cloned().chain(sets.iter().map(|s| s.to_string())).collect::<Vec<_>>();
        let text = ditching::load("mercure", &sets).expect_err("refused").to_string();
        says.iter().for_each(|s| assert!(text.contains(s), "{text} does not say {s}"));
    };
    refused(&["sea.height=14.3"], &["sea.height", "below 14.2 m", "breaks"]);
    refused(&["sea.height=-1.0"], &["sea.height", "0"]);
    refused(&["sea.length=10.0"], &["sea.length", "at least 11.0"]);
    refused(&["sea.heading_deg=200"], &["sea.heading_deg", "from 0 to 180"]);
    refused(&["sea.touchdown=crust"], &["sea.touchdown", "0 to 360", "crest", "up_slope"]);
    refused(&["sea.touchdown=400"], &["sea.touchdown", "0 to 360"]);
    refused(&["sea.touchdown=down_slope"], &["sea.touchdown", "outside", "falls at", "landing.flight_path_deg"]);
    refused(&["sea.period=8"], &["unknown key"]);
    let without = ["sea.height=1.0", "sea.heading_deg=0"].map(String::from);
    let missing = ditching::load("mercure", &without).expect_err("refused").to_string();
    assert!(missing.contains("sea.length"), "{missing}");
    let warned = |on: &[String; 4], says: &str| {
        let warnings = mercure_on(on, &["landing.end=0.05"]).summary.warnings;
        assert!(warnings.iter().any(|w| w.contains(says)), "{warnings:?} do not say {says}");
    };
    warned(&sea(6.0, 100.0, 180.0, "crest"), "sea.height is 0.06");
    warned(&sea(0.5, 25.0, 180.0, "up_slope"), "sea.length = 25 m");
    warned(&sea(4.0, 100.0, 90.0, "crest"), "sea.heading_deg = 90");
    warned(&sea(1.0, 100.0, 180.0, "trough"), "sea.touchdown = \"trough\"");
    assert!(mercure_on(&sea(0.3, 100.0, 90.0, "crest"), &["landing.end=0.05"]).summary.warnings.is_empty());
}
