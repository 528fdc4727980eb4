//! Every key of a landing's file, declared once: for help and for error messages.

use crate::scene::Keyword;

/// All keys, in the order in which a file is usually written.
pub fn keywords() -> &'static [Keyword] {
    KEYWORDS
}

const fn key(path: &'static str, unit: &'static str, default: &'static str, doc: &'static str) -> Keyword {
    Keyword { path, unit, default, doc }
}

const KEYWORDS: &[Keyword] = &[
    key("name", "", "required", "A word that names the landing and its folder."),
    key("description", "", "empty", "What it is, in a line."),
    key("source", "", "empty", "Where its numbers come from."),
    key("model", "", "mlm", "Theory of the sections: von_karman, wagner or mlm."),
    key(
        "landing.angle_of_attack_deg",
        "deg",
        "required",
        "Angle of the body axis over the flight path at the first touch.",
    ),
    key(
        "landing.flight_path_deg",
        "deg",
        "required",
        "Direction of flight at the first touch, upwards; from -15 to below 0.",
    ),
    key("landing.speed", "m/s", "where the wing carries the weight", "Speed along the flight path at the first touch."),
    key("landing.end", "s", "required", "End of time after the first touch."),
    key(
        "landing.least_speed",
        "m/s",
        "sqrt(g L), L the fuselage's length",
        "Forward speed below which the landing ends.",
    ),
    key("landing.step", "s", "0.001", "Step of the integration."),
    key("landing.sample_every", "s", "0.005", "Interval between rows of the series, in whole steps."),
    key("landing.strips", "-", "200", "Strips along the fuselage, from 20 to 5000; stations are at their ends."),
    key("aeroplane.mass", "kg", "required", "Mass."),
    key("aeroplane.radius_of_gyration", "m", "required", "Radius of gyration in pitch."),
    key("aeroplane.center_of_mass", "m", "required", "Centre of mass, from the nose and over the body axis."),
    key("wing.area", "m^2", "required", "Area of the wing."),
    key("wing.chord", "m", "required", "Mean chord of the wing."),
    key("wing.lift_slope", "1/rad", "required", "Slope of the lift coefficient against the angle of attack."),
    key("wing.zero_lift_deg", "deg", "required", "Angle of attack of the body axis at which there is no lift."),
    key(
        "wing.pitch_stiffness",
        "1/rad",
        "-1",
        "Slope of the aeroplane's moment coefficient against the angle of attack.",
    ),
    key("wing.pitch_damping", "1/rad", "-25", "Its slope against q c/(2U), the rate of pitch."),
    key("wing.air_density", "kg/m^3", "1.225", "Density of the air."),
    key("water.density", "kg/m^3", "1000", "Density of the water."),
    key("water.gravity", "m/s^2", "9.81", "Acceleration of gravity."),
    key("water.friction", "-", "0.003", "Friction coefficient of the wetted bottom, from 0 to 0.1."),
    key(
        "water.suction",
        "-",
        "1",
        "Share of the theory's suction where the keel curves up: from 0, none, to 1, all of it.",
    ),
    key("stations", "", "required", "Tables of the fuselage's sections, from the nose aft; two at least."),
    key("stations[].x", "m", "required", "Distance from the nose along the body axis."),
    key("stations[].keel", "m", "required", "Height of the keel over the body axis."),
    key("stations[].breadth", "m", "required", "Breadth between the edges that the water leaves."),
    key("stations[].radius", "m", "required unless deadrise_deg", "Radius of a section that is an arc."),
    key("stations[].deadrise_deg", "deg", "required unless radius", "Deadrise of a section that is a wedge."),
];
