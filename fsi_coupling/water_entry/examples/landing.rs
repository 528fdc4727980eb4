//! An aeroplane lands on calm water, by its sections (2D+t): `cargo run --release -p water_entry --example landing`.
//!
//! First the load of the water on a fuselage with a straight keel that planes at the speed U and the pitch tau with its aft end at a draught h. By
//! the added mass of von Karman (1929) it is F = 1/2 rho (pi/tan^2 beta) h^2 U^2 tan tau.
//! Then a landing with weight and lift: the aft end touches first, and the aeroplane pitches down.

use std::error::Error;
use std::f64::consts::PI;
use water_entry::EntryModel;
use water_entry::ditching::{Aeroplane, Attitude, Form, Fuselage, Hull, Landing, Station, Swell, Water, Wing};

fn main() -> Result<(), Box<dyn Error>> {
    let (length, deadrise, mass, pitch, speed) = (20.0, 25.0_f64, 4e4, 6.0_f64.to_radians(), 60.0);
    let station = |x: f64, keel: f64| Station { x, keel, breadth: 4.0, form: Form::DeadriseDeg(deadrise) };
    let stations = [station(0.0, 1.5), station(5.0, 0.2), station(8.0, 0.0), station(length, 0.0)];
    let hull = Hull::new(Fuselage::new(&stations)?, EntryModel::VonKarman)?;
    let (area, chord, lift_slope, zero_lift_deg, drag, air_density) = (110.0, 3.0, 4.6, -10.0, 0.1, 1.225);
    let (pitch_stiffness, pitch_damping, trim_deg) = (-1.0, -25.0, None);
    let wing =
        Wing { area, chord, lift_slope, zero_lift_deg, pitch_stiffness, pitch_damping, trim_deg, drag, air_density };
    let centre = [0.5 * length, 0.5]; // from the nose, and over the body axis
    let (surfaces, nacelles, panels, struts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let inertia = 25.0 * mass;
    let aeroplane = Aeroplane { mass, inertia, centre, wing, surfaces, nacelles, panels, struts, bending: None };
    let landing = Landing {
        hull: &hull,
        aeroplane,
        water: Water::default(),
        swell: Swell::default(),
        pitch,
        path: -0.025, // a sink speed of 1.5 m/s
        speed,
        strips: 200,
        step: 1e-3,
        sample_every: 1,
        end: 3.0,
        least_speed: 1.0,
    };

    // centre of mass at a height at which the aft end of the keel is 0.3 m deep
    let draught = 0.3;
    let mut attitude = Attitude { place: [0.0, 0.0, pitch], rate: [speed, 0.0, 0.0], ..Attitude::default() };
    attitude.place[1] = -draught - attitude.of_point(centre, [length, 0.0])[1];
    let entries = landing.moment(0.0, attitude, &[]).strips;
    let load: f64 = entries.iter().filter_map(|(strip, _)| strip.entry).map(|entry| entry.pressing).sum();
    let exact = 0.5 * 1000.0 * PI / deadrise.to_radians().tan().powi(2) * (draught * speed).powi(2) * pitch.tan();
    println!("planing: {:.1} kN, exact {:.1} kN", 1e-3 * load, 1e-3 * exact);
    assert!((load / exact - 1.0).abs() < 2e-3);

    let result = landing.solve();
    for now in result.moments.iter().step_by(500) {
        let [ahead, up, _] = now.attitude.rate;
        print!("{:4.1} s: {ahead:5.1} and {up:5.2} m/s, ", now.time);
        println!("pitch {:5.2} deg, water {:6.1} kN", now.attitude.place[2].to_degrees(), 1e-3 * now.force[1]);
    }
    let most = result.moments.iter().map(|now| now.acceleration[1] / 9.81).fold(0.0, f64::max);
    println!("{:?}: up to {most:.2} g upwards", result.ended);
    Ok(())
}
