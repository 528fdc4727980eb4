//! Landings without air and friction, of plain hulls.

use water_entry::EntryModel;
use water_entry::ditching::{Aeroplane, Form, Fuselage, Hull, Landing, Station, Swell, Water, Wing};

/// Density of the water [kg/m³].
pub const RHO: f64 = 1000.0;

/// Centre of mass, from the nose and over the body axis [m].
pub const CENTRE: [f64; 2] = [10.0, 0.5];

/// A station of a fuselage.
pub fn station(x: f64, keel: f64, breadth: f64, form: Form) -> Station {
    Station { x, keel, breadth, form }
}

/// A prismatic wedge of 20 m, 4 m broad.
pub fn prism(model: EntryModel, deadrise: f64) -> Hull {
    let ends = [0.0, 20.0].map(|x| station(x, 0.0, 4.0, Form::DeadriseDeg(deadrise)));
    Hull::new(Fuselage::new(&ends).expect("a fuselage"), model).expect("in range")
}

/// A landing without air and friction.
pub fn landing(hull: &Hull, gravity: f64, mass: f64) -> Landing<'_> {
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
    Landing {
        hull,
        aeroplane: Aeroplane {
            mass,
            inertia: 25.0 * mass,
            centre: CENTRE,
            wing,
            surfaces: Vec::new(),
            nacelles: Vec::new(),
            panels: Vec::new(),
            struts: Vec::new(),
            bending: None,
        },
        water: Water {
            density: RHO,
            gravity,
            friction: 0.0,
            suction: 1.0,
            largest_suction: f64::INFINITY,
            finite_length: false,
        },
        swell: Swell::default(),
        pitch: 0.1,
        path: -0.05,
        speed: 40.0,
        strips: 400,
        step: 2e-4,
        sample_every: 10,
        end: 0.3,
        least_speed: 1.0,
    }
}

/// A hull of 20 m that tapers and whose keel rises aft.
pub fn tapered_hull() -> Hull {
    let wedge = || Form::DeadriseDeg(25.0);
    let stations = [
        station(0.0, 0.0, 6.0, wedge()),
        station(8.0, 0.0, 6.0, wedge()),
        station(14.0, 0.02, 5.0, wedge()),
        station(20.0, 0.08, 4.0, wedge()),
    ];
    Hull::new(Fuselage::new(&stations).expect("a fuselage"), EntryModel::VonKarman).expect("in range")
}
