//! Struts of a landing, of their keys (THEORY EN56).

use settings::{Problem, require, significant};
use water_entry::ditching::{STRUTS, Strut, StrutSpring};

use super::afloat_keys::StrutKeys;
use super::model::Scene;

/// Largest product of a foot's frequency on its stiffest support and the step, and of its rate of damping and the step.
const FASTEST: [f64; 2] = [1.0, 2.0];

/// The struts of a landing.
pub(super) fn struts(scene: &Scene) -> Result<Vec<Strut>, Problem> {
    if let Some(over) = scene.struts.get(STRUTS) {
        let expected = format!("at most {STRUTS} items of struts: equal ones side by side are one with a number");
        return Err(Problem::new(&format!("struts[{STRUTS}].name"), &over.name, expected));
    }
    scene.struts.iter().enumerate().map(|(k, keys)| strut(scene, k, keys)).collect()
}

fn strut(scene: &Scene, index: usize, keys: &StrutKeys) -> Result<Strut, Problem> {
    let key = |name: &str| format!("struts[{index}].{name}");
    let spring = match (keys.stiffness, keys.gas_length) {
        (Some(stiffness), None) => StrutSpring::Linear(stiffness),
        (None, Some(length)) => {
            let expected = format_args!("more than {}, {} m", key("stroke"), keys.stroke);
            require(length > keys.stroke, &key("gas_length"), length, expected)?;
            require(keys.preload > 0.0, &key("preload"), keys.preload, "more than 0: the load of the gas, extended")?;
            StrutSpring::Gas { length, exponent: keys.gas_exponent }
        }
        (Some(_), Some(given)) => {
            return Err(Problem::new(&key("gas_length"), given, "a stiffness or a gas_length, not both"));
        }
        (None, None) => return Err(Problem::missing(&key("stiffness"), "a stiffness, or the gas_length of an oleo")),
    };
    let face = keys.face;
    require(face.iter().all(|v| *v > 0.0), &key("face"), format!("{face:?}"), "a breadth and a height above 0")?;
    let [first, last] = [0, scene.stations.len() - 1].map(|k| scene.stations[k].x);
    let on_fuselage = (first..=last).contains(&keys.foot[0]);
    let expected = format_args!("a place on the fuselage, from {first} to {last} m");
    require(on_fuselage, &key("foot"), format!("{:?}", keys.foot), expected)?;
    let all: f64 = scene.struts.iter().map(|s| s.mass * f64::from(s.number)).sum();
    let expected = format_args!("masses of all struts below aeroplane.mass, {} kg", scene.aeroplane.mass);
    require(all < scene.aeroplane.mass, &key("mass"), keys.mass, expected)?;
    let strut = Strut {
        name: keys.name.clone(),
        number: f64::from(keys.number),
        foot: keys.foot,
        mass: keys.mass,
        stroke: keys.stroke,
        preload: keys.preload,
        spring,
        damping: keys.damping,
        orifice: keys.orifice,
        breaks_at: keys.breaks_at,
        face,
        drag: keys.drag,
        waterplane: keys.waterplane,
    };
    let stiffness = strut.largest_stiffness(scene.water.density * scene.water.gravity);
    let longest =
        (FASTEST[0] / (stiffness / keys.mass).sqrt()).min(FASTEST[1] * keys.mass / keys.damping.max(f64::MIN_POSITIVE));
    if scene.landing.step > longest {
        let expected = format!(
            "at most {} s, or more of {}: the foot of {} kg on its stop or damper is to be followed",
            significant(longest),
            key("mass"),
            keys.mass
        );
        return Err(Problem::new("landing.step", scene.landing.step, expected));
    }
    Ok(strut)
}
