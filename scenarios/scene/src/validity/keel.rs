//! What is doubtful beside the keel of a steep wedge.

use fsi_coupling::Shape;
use settings::significant;
use water_entry::keel::KeelLaw;

use crate::keys::{Body, Gauge, GaugeFrame, Scene};

/// Deadrise from which the force is more than 1 % high at 64 spacings of draught [deg].
const STEEP_DEG: f64 = 65.0;

/// Warnings about the keel's pressure, and about the force on a wedge whose tip is thinner than the kernel's support.
pub fn keel_warnings(scene: &Scene) -> Vec<String> {
    scene.all_bodies().flat_map(|body| keel_warnings_of(scene, body)).collect()
}

fn keel_warnings_of(scene: &Scene, body: &Body) -> Vec<String> {
    let Shape::Wedge { deadrise_deg, .. } = body.shape else { return Vec::new() };
    let (about, first) = (scene.about(body), scene.body.as_ref() == Some(body)); // gauges are on the first
    let support = 2.0 * scene.water().smoothing_ratio * scene.resolution.spacing;
    if scene.model.is_theory() || KeelLaw::new(deadrise_deg.to_radians(), support).is_none() {
        return Vec::new();
    }
    let at_keel = |g: &&Gauge| g.on == GaugeFrame::Body && g.length < support && g.at[0].hypot(g.at[1]) < support;
    let smoothed = |g: &Gauge| {
        format!(
            "gauge `{}` is beside the keel, where the pressure at {deadrise_deg} degrees has a cusp: it shows a mean over some {} m, \
             which is too low (THEORY GE21); give it the length of the sensor, or move it away",
            g.name,
            significant(support)
        )
    };
    let thin = (deadrise_deg >= STEEP_DEG).then(|| {
        format!(
            "{about}the tip of a wedge of {deadrise_deg} degrees is thinner than the kernel: the force is too high, at 64 spacings of draught by \
             1 % (65 degrees) to 7 % (80), incompressible 2 to 23 %, at twice as many by half"
        )
    });
    scene.gauges.iter().filter(|gauge| first && at_keel(gauge)).map(smoothed).chain(thin).collect()
}

#[cfg(test)]
mod tests {
    use crate::load;

    #[test]
    fn a_gauge_at_a_steep_keel_and_a_thin_tip_are_reported() {
        let warned = |deadrise: &str, gauge: &str| {
            let sets = [format!("body.deadrise_deg={deadrise}"), format!("gauges=[{{ name = 'g', {gauge} }}]")];
            let warnings = load("wedge_constant", &sets).expect("a scene").warnings;
            ["cusp", "thinner"].map(|word| warnings.iter().any(|w| w.contains(word)))
        };
        assert_eq!(warned("60", "at = [0.0, 0.0]"), [true, false]);
        assert_eq!(warned("60", "at = [0.0, 0.0], length = 0.1"), [false, false]);
        assert_eq!(warned("60", "at = [0.1, 0.17320508]"), [false, false]);
        assert_eq!(warned("30", "at = [0.0, 0.0]"), [false, false]);
        assert_eq!(warned("70", "at = [0.0, 0.0]"), [true, true]);
    }
}
