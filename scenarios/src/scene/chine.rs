//! When the water of a wedge at constant speed leaves the bottom at its chines, and what that costs.

use std::f64::consts::{FRAC_PI_2, PI};

use super::impact::Entry;
use super::settings::{Motion, Scene};
use fsi_coupling::Shape;
use fsi_coupling::settings::significant;

/// Largest deadrise of the solutions that [`jet_reach`] is fitted to [deg].
const LARGEST_DEADRISE_DEG: f64 = 50.0;

/// Reach of the jet's tip along a wedge of deadrise β [deg] at constant speed, x_tip/(V t) [-] (THEORY EN11):
/// (π − 0.98 β^1.78)/tan β with β in radians.
///
/// A fit to the similarity solutions (Dobrovolskaya 1969) at 10, 20, 30, 45 and 50°, within 0.2 %; π/tan β, twice the
/// spray root's, is the limit of small β (Wagner 1932). `None` above 50°.
pub fn jet_reach(deadrise_deg: f64) -> Option<f64> {
    let beta = deadrise_deg.to_radians();
    (deadrise_deg <= LARGEST_DEADRISE_DEG).then(|| (PI - 0.98 * beta.powf(1.78)) / beta.tan())
}

/// The doubt about an upright wedge at constant speed whose jet, or spray root, passes the chine before the end.
pub(super) fn past_the_chine(scene: &Scene, entry: &Entry) -> Option<String> {
    let body = scene.body.as_ref()?;
    let Shape::Wedge { deadrise_deg, breadth, .. } = body.shape else { return None };
    let upright = body.angle_deg == 0.0 && body.angular_velocity_deg_per_s == 0.0 && body.velocity[0] == 0.0;
    if body.motion != Motion::ConstantVelocity || !upright {
        return None;
    }
    let (end, chine, keel) = (scene.time.end, 0.5 * breadth, body.position[1]);
    let root = FRAC_PI_2 / deadrise_deg.to_radians().tan();
    // the keel meets the water at −keel/V before or after the run's start
    let passes = |reach: f64| (chine / reach + keel) / entry.speed;
    let tip = jet_reach(deadrise_deg).unwrap_or(root);
    let needed = significant(2.0 * tip * entry.final_draught);
    let remedy = format!("body.breadth = {needed} m would keep the jet on the face");
    if passes(root) < end {
        return Some(format!(
            "the spray root passes the chine at {} s and would be at {} m at the end, past the chine at {} m, where the \
             similarity solution ends: the face is wetted to its end, and the force no longer grows with it; {remedy}",
            significant(passes(root)),
            significant(root * entry.final_draught),
            significant(chine),
        ));
    }
    (passes(tip) < end).then(|| {
        format!(
            "the jet's tip passes the chine at {} s and leaves the face: the force falls below the similarity solution's a \
             little (20 deg, breadth 12 m: by 2 % at 1.3 times that time); {remedy}",
            significant(passes(tip))
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Table;

    #[test]
    fn the_jet_reaches_as_far_as_in_the_similarity_solutions() {
        let name = "wedge_similarity/summary.csv";
        let table = Table::load(name).expect("a built-in table");
        let [deadrise, tip] = ["beta_deg", "x_tip"].map(|column| table.column(name, column).expect("a column"));
        assert_eq!(deadrise.len(), 5);
        for (beta, exact) in deadrise.into_iter().zip(tip) {
            let ours = jet_reach(beta).expect("within the fit's range");
            assert!((ours / exact - 1.0).abs() < 2e-3, "{beta} deg: {ours}, exact {exact}");
        }
        assert_eq!(jet_reach(60.0), None);
    }

    #[test]
    fn the_jet_of_a_flat_wedge_is_twice_as_far_out_as_its_root() {
        let beta: f64 = 0.5;
        let root = FRAC_PI_2 / beta.to_radians().tan();
        assert!((jet_reach(beta).expect("within the fit's range") / root - 2.0).abs() < 1e-3);
    }
}
