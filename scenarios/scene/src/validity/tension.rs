//! What tension of the water takes off a force (THEORY GE24).

use settings::significant;

use crate::vocabulary::{Finding, Verdict};

/// Factor in the band on the share that tension takes off [-].
const TENSION_BAND: f64 = 2.5;
/// Largest share that it may take [-].
const MOST_TENSION: f64 = 0.05;

/// GE24: a finding on a force, or on an impulse, off which tension takes a part, both in the same unit.
pub fn with_tension((verdict, band, why): Finding, tension: [f64; 2], force: [f64; 2]) -> Finding {
    let along = -(tension[0] * force[0] + tension[1] * force[1]) / (force[0] * force[0] + force[1] * force[1]);
    let share = if along.is_finite() { along.max(0.0) } else { 0.0 };
    if verdict != Verdict::Resolved || share <= MOST_TENSION {
        return (verdict, band.map(|band| band + TENSION_BAND * share), why);
    }
    let takes = if share > 1.0 { "more than all".into() } else { format!("{} %", significant(100.0 * share)) };
    let why = format!(
        "tension of the water takes {takes} off it: where air comes in, as beside a keel that water crosses, the force is larger; \
         fluid.cavitation_pressure = 0 lets it in (solver = weakly_compressible)"
    );
    (Verdict::NotResolved, None, Some(why.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tension_widens_a_band_and_beyond_a_twentieth_refuses_the_force() {
        let found = |tension: f64| with_tension((Verdict::Resolved, Some(0.05), None), [0.3, -tension], [0.0, 2.0]);
        assert_eq!(found(0.04), (Verdict::Resolved, Some(0.05 + TENSION_BAND * 0.02), None));
        assert_eq!((found(-1.0), found(0.101).0), ((Verdict::Resolved, Some(0.05), None), Verdict::NotResolved));
        assert!(
            found(0.16).2.is_some_and(|why| why.text.contains("8 %") && why.text.contains("fluid.cavitation_pressure"))
        );
        let still = with_tension((Verdict::Resolved, None, None), [0.0; 2], [0.0; 2]);
        assert_eq!(still, (Verdict::Resolved, None, None));
    }
}
