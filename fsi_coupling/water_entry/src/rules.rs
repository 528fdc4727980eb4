//! Water loads that airworthiness rules state (THEORY RU1–RU5): to stand beside computed ones, never instead.
//!
//! Texts: 14 CFR 25.527 to 25.533 and its Appendix B (29 FR 18291, 1964; Amdt. 25-23, 35 FR 5673, 1970), word for word also in 14 CFR 23.527
//! to 23.533 (58 FR 42161, 1993; withdrawn in 2017); 29.521 (Amdt. 29-3, 1968); 29.563. The rules are in pounds, knots and
//! feet; everything here is in SI units, and the constants are converted by the definitions of those units.
//!
//! ```
//! use water_entry::rules::{KNOT, POUND, Hull};
//!
//! // 6000 lb, stalling at 55 kn, deadrise 25 degrees: n = 0.012·55²/(tan^⅔ 25°·6000^⅓) = 3.32
//! let hull = Hull { landing_speed: 55.0 * KNOT, mass: 6000.0 * POUND, step_deadrise_deg: 25.0 };
//! assert!((hull.step_load_factor()? - 3.32).abs() < 0.01);
//! # Ok::<(), water_entry::rules::OutsideRule>(())
//! ```

/// International knot [m/s].
pub const KNOT: f64 = 1852.0 / 3600.0;
/// Avoirdupois pound [kg].
pub const POUND: f64 = 0.453_592_37;
/// Foot [m].
pub const FOOT: f64 = 0.3048;
/// Pound-force per square inch [Pa].
pub const PSI: f64 = POUND * 9.806_65 / (0.0254 * 0.0254);

/// C₁ of 25.527(b)(2), for knots and pounds [-].
const C1: f64 = 0.012;
/// Least load factor of a step landing, 25.527(b)(2) [-].
const LEAST_STEP_FACTOR: f64 = 2.33;
/// C_TO of 25.531(b), for knots and pounds [-].
const C_TO: f64 = 0.004;
/// C₂ of 25.533(b)(1) and C₃ of 25.533(b)(2), for knots [psi].
const C2: f64 = 0.002_13;
const C3: f64 = 0.001_6;
/// C₄ over C₁, 25.533(c)(1) [psi].
const C4: f64 = 0.078;
/// Pressure at the chine of an unflared bottom over that at the keel, 25.533(b)(1) [-].
pub const CHINE: f64 = 0.75;
/// Upward part of an unsymmetrical landing, and its side part over tan β, of the symmetrical resultant, 25.529(b)(1) [-].
const UNSYMMETRICAL: [f64; 2] = [0.75, 0.25];
/// Aft part of a float landing over its vertical load, 29.521(a)(2) [-].
const AFT: f64 = 0.25;
/// Vertical load of the side load condition over that of (a)(1), and side load over that, 29.521(b) [-].
const SIDE: [f64; 2] = [0.75, 0.25];
/// Deadrise [deg] for which formulas in 1/tan β are evaluated here; the rules give no range.
pub const DEADRISES: [f64; 2] = [4.0, 60.0];

/// Forward speeds from 0 to this of 29.563(a) [m/s]: 30 knots.
pub const DITCHING_FORWARD: f64 = 30.0 * KNOT;
/// Least limit vertical speed of 29.563(a) [m/s]: 5 ft/s, relative to the mean water surface.
pub const DITCHING_VERTICAL: f64 = 5.0 * FOOT;

/// A case for which a rule has no number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}, expected {expected}")]
pub struct OutsideRule {
    /// The case.
    pub what: String,
    /// What the formula is for.
    pub expected: String,
}

/// tan β of a hull.
fn tangent(deadrise_deg: f64) -> Result<f64, OutsideRule> {
    let [least, most] = DEADRISES;
    match (least..=most).contains(&deadrise_deg) {
        true => Ok(deadrise_deg.to_radians().tan()),
        false => Err(OutsideRule {
            what: format!("a deadrise of {deadrise_deg:.1} degrees"),
            expected: format!("a hull with a keel, of {least} to {most} degrees: the formulas divide by tan β"),
        }),
    }
}

/// V² over (tan^⅔ β W^⅓), speed in knots, weight in pounds.
fn severity(speed: f64, mass: f64, tangent: f64) -> f64 {
    let knots = speed / KNOT;
    knots * knots / ((tangent * tangent).cbrt() * (mass / POUND).cbrt())
}

/// A seaplane at its design landing weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull {
    /// V_S0: stalling speed with landing flaps, without slipstream [m/s].
    pub landing_speed: f64,
    /// Design landing weight, as a mass [kg].
    pub mass: f64,
    /// β at the main step [deg].
    pub step_deadrise_deg: f64,
}

impl Hull {
    /// C₁ of 25.527(b)(2), for knots and pounds [-]: 0.012, or as much as makes the step landing's load factor 2.33.
    ///
    /// # Errors
    /// The deadrise.
    pub fn operations_factor(&self) -> Result<f64, OutsideRule> {
        let severity = severity(self.landing_speed, self.mass, tangent(self.step_deadrise_deg)?);
        Ok(C1.max(LEAST_STEP_FACTOR / severity))
    }

    /// RU1: water reaction over weight, step landing [-], 25.527(a)(1).
    ///
    /// # Errors
    /// The deadrise.
    pub fn step_load_factor(&self) -> Result<f64, OutsideRule> {
        let severity = severity(self.landing_speed, self.mass, tangent(self.step_deadrise_deg)?);
        Ok(self.operations_factor()? * severity)
    }

    /// RU1: the same of a bow or a stern landing, 25.527(a)(2): deadrise there [deg], [`k1`](station_factors), and r_x, the distance to the
    /// centre of gravity along the hull over the radius of gyration in pitch [-].
    ///
    /// # Errors
    /// The deadrises.
    pub fn end_load_factor(&self, deadrise_deg: f64, k1: f64, arm_ratio: f64) -> Result<f64, OutsideRule> {
        let severity = severity(self.landing_speed, self.mass, tangent(deadrise_deg)?);
        let arm = 1.0 + arm_ratio * arm_ratio;
        Ok(self.operations_factor()? * severity * k1 / (arm * arm).cbrt())
    }

    /// RU3: pressure for frames, keel and chines [Pa], 25.533(c)(1): over the whole bottom at a station of this deadrise [deg] and
    /// [`k2`](station_factors); half of it on one side in (c)(2).
    ///
    /// # Errors
    /// The deadrises.
    pub fn distributed_pressure(&self, deadrise_deg: f64, k2: f64) -> Result<f64, OutsideRule> {
        let knots = self.landing_speed / KNOT;
        Ok(C4 * self.operations_factor()? * k2 * knots * knots / tangent(deadrise_deg)? * PSI)
    }
}

/// RU1: inertia load factor of a take-off [-], 25.531(b): V_S1 with flaps for take-off [m/s], design take-off weight as a mass [kg], deadrise at
/// the main step [deg].
///
/// # Errors
/// The deadrise.
pub fn takeoff_load_factor(takeoff_speed: f64, mass: f64, step_deadrise_deg: f64) -> Result<f64, OutsideRule> {
    Ok(C_TO * severity(takeoff_speed, mass, tangent(step_deadrise_deg)?))
}

/// RU2: local pressure at the keel, for plating and stringers [Pa], 25.533(b)(1): V_S1 at the design take-off weight with flaps for take-off [m/s],
/// deadrise at the keel [deg], [`k2`](station_factors). At the chine of an unflared bottom [`CHINE`] of it, linear between.
///
/// # Errors
/// The deadrise.
pub fn keel_pressure(takeoff_speed: f64, keel_deadrise_deg: f64, k2: f64) -> Result<f64, OutsideRule> {
    local(C2, takeoff_speed, keel_deadrise_deg, k2)
}

/// RU2: local pressure at the chine of a flared bottom [Pa], 25.533(b)(2): β at the station, as [`keel_pressure`].
///
/// # Errors
/// The deadrise.
pub fn flared_chine_pressure(takeoff_speed: f64, deadrise_deg: f64, k2: f64) -> Result<f64, OutsideRule> {
    local(C3, takeoff_speed, deadrise_deg, k2)
}

fn local(constant: f64, speed: f64, deadrise_deg: f64, k2: f64) -> Result<f64, OutsideRule> {
    let knots = speed / KNOT;
    Ok(constant * k2 * knots * knots / tangent(deadrise_deg)? * PSI)
}

/// RU4: an unsymmetrical landing of a hull [upward, sideways], over the resultant of the symmetrical one [-], 25.529(b)(1).
///
/// # Errors
/// The deadrise.
pub fn unsymmetrical(deadrise_deg: f64) -> Result<[f64; 2], OutsideRule> {
    let [up, side] = UNSYMMETRICAL;
    Ok([up, side * tangent(deadrise_deg)?])
}

/// A place along a hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Station {
    /// Share of the way from the bow to the main step, 0 to 1 [-].
    Forebody(f64),
    /// Share of the way from the main step to the stern post, 0 to 1 [-].
    Afterbody(f64),
}

/// Hull station weighing factors [K₁, K₂] of figure 2 of Appendix B to Part 25 [-], linear between the numbers printed there: K₁ 1.5 (bow) to 1
/// (step), 0.375 (behind it) to 1 (stern); K₂ 2 (bow), 0.75 (half way), 1 (step), 0.5 (behind it) to 1 (stern).
///
/// The numbers were read off the figure by one reader; the figure counts.
pub fn station_factors(station: Station) -> [f64; 2] {
    let between = |from: f64, to: f64, share: f64| from + share.clamp(0.0, 1.0) * (to - from);
    match station {
        Station::Forebody(share) if share < 0.5 => [between(1.5, 1.0, share), between(2.0, 0.75, 2.0 * share)],
        Station::Forebody(share) => [between(1.5, 1.0, share), between(0.75, 1.0, 2.0 * share - 1.0)],
        Station::Afterbody(share) => [between(0.375, 1.0, share), between(0.5, 1.0, share)],
    }
}

/// Loads of a rotorcraft's floats [N].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloatLanding {
    /// (a)(1): vertical, through the centre of gravity.
    pub vertical: f64,
    /// (a)(2): aft, together with it.
    pub aft: f64,
    /// (b)(1): vertical on each float, in the side load condition.
    pub vertical_each: f64,
    /// (b)(2): sideways, on one float only.
    pub side: f64,
}

/// RU5: 29.521 for a limit load factor (29.473(b), or that of the wheels) [-], a mass [kg] and a number of floats; lift of the rotor is not
/// subtracted.
///
/// # Errors
/// No float.
pub fn float_landing(load_factor: f64, mass: f64, floats: u32) -> Result<FloatLanding, OutsideRule> {
    if floats == 0 {
        return Err(OutsideRule { what: "no float".into(), expected: "at least one".into() });
    }
    let vertical = load_factor * mass * 9.806_65;
    let [share, side] = SIDE;
    let total = share * vertical;
    Ok(FloatLanding { vertical, aft: AFT * vertical, vertical_each: total / f64::from(floats), side: side * total })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEAPLANE: Hull = Hull { landing_speed: 55.0 * KNOT, mass: 6000.0 * POUND, step_deadrise_deg: 25.0 };

    /// By logarithms in the rule's own units: another path through the arithmetic.
    fn factor_in_pounds(c: f64, knots: f64, pounds: f64, deadrise_deg: f64) -> f64 {
        let ln_tan = deadrise_deg.to_radians().sin().ln() - deadrise_deg.to_radians().cos().ln();
        (c.ln() + 2.0 * knots.ln() - (2.0 * ln_tan + pounds.ln()) / 3.0).exp()
    }

    #[test]
    fn load_factors_are_those_of_pounds_and_knots() -> Result<(), OutsideRule> {
        let by_hand = factor_in_pounds(0.012, 55.0, 6000.0, 25.0);
        assert!((SEAPLANE.step_load_factor()? / by_hand - 1.0).abs() < 1e-12);
        // bow: 40 degrees, K1 = 1.5, r_x = 2: 1.5/5^(2/3)
        let bow = factor_in_pounds(0.012, 55.0, 6000.0, 40.0) * 1.5 / 5.0_f64.powf(2.0 / 3.0);
        assert!((SEAPLANE.end_load_factor(40.0, 1.5, 2.0)? / bow - 1.0).abs() < 1e-12);
        let takeoff = factor_in_pounds(0.004, 60.0, 6500.0, 25.0);
        assert!((takeoff_load_factor(60.0 * KNOT, 6500.0 * POUND, 25.0)? / takeoff - 1.0).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn the_same_factor_in_kilograms_has_the_constant_0_00922() -> Result<(), OutsideRule> {
        // C1 for a weight in kilograms: 0.012 (0.45359)^(1/3)
        let kilograms: f64 = 2_721.554_22;
        let n = 0.009_220 * 55.0 * 55.0 / (25.0_f64.to_radians().tan().powf(2.0 / 3.0) * kilograms.cbrt());
        assert!((SEAPLANE.step_load_factor()? / n - 1.0).abs() < 1e-4, "{n}");
        Ok(())
    }

    #[test]
    fn a_slow_landing_has_the_least_factor_and_its_pressures_follow() -> Result<(), OutsideRule> {
        let slow = Hull { landing_speed: 30.0 * KNOT, ..SEAPLANE };
        assert!((slow.step_load_factor()? - 2.33).abs() < 1e-12 && slow.operations_factor()? > 0.012);
        let of = |hull: &Hull| hull.distributed_pressure(25.0, 1.0);
        let ratio = of(&slow)? / of(&SEAPLANE)?;
        assert!((ratio - (30.0_f64 / 55.0).powi(2) * slow.operations_factor()? / 0.012).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn pressures_are_those_of_psi_and_knots() -> Result<(), OutsideRule> {
        // 0.00213·0.75·60²/tan 25° = 12.333 psi; 0.0016: 9.264 psi; 0.078·0.012·55²/tan 25° = 6.072 psi
        let psi = |pascal: f64| pascal / 6_894.757_293_168;
        assert!((psi(keel_pressure(60.0 * KNOT, 25.0, 0.75)?) - 12.333).abs() < 1e-3);
        assert!((psi(flared_chine_pressure(60.0 * KNOT, 25.0, 0.75)?) - 9.264).abs() < 1e-3);
        assert!((psi(SEAPLANE.distributed_pressure(25.0, 1.0)?) - 6.072).abs() < 1e-3);
        Ok(())
    }

    #[test]
    fn shares_of_unsymmetrical_and_float_landings() -> Result<(), OutsideRule> {
        let [up, side] = unsymmetrical(45.0)?;
        assert!((up - 0.75).abs() < 1e-15 && (side - 0.25).abs() < 1e-15);
        let float = float_landing(3.0, 2000.0, 2)?;
        let weight = 2000.0 * 9.806_65;
        let sum = [float.vertical, float.aft, float.vertical_each, float.side].map(|load| load / weight);
        for (share, expected) in sum.into_iter().zip([3.0, 0.75, 1.125, 0.5625]) {
            assert!((share - expected).abs() < 1e-12, "{share}");
        }
        assert!(float_landing(3.0, 2000.0, 0).is_err());
        Ok(())
    }

    #[test]
    fn figure_2_has_its_printed_numbers_and_jumps_at_the_step() {
        let at = |station| station_factors(station);
        assert_eq!(at(Station::Forebody(0.0)), [1.5, 2.0]);
        assert_eq!(at(Station::Forebody(0.5)), [1.25, 0.75]);
        assert_eq!(at(Station::Forebody(1.0)), [1.0, 1.0]);
        assert_eq!(at(Station::Afterbody(0.0)), [0.375, 0.5]);
        assert_eq!(at(Station::Afterbody(1.0)), [1.0, 1.0]);
    }

    #[test]
    fn flat_and_sharp_bottoms_have_no_number() {
        for deadrise in [0.0, 3.9, 60.1, f64::NAN] {
            assert!(keel_pressure(30.0, deadrise, 1.0).is_err());
            assert!(Hull { step_deadrise_deg: deadrise, ..SEAPLANE }.step_load_factor().is_err());
        }
    }
}
