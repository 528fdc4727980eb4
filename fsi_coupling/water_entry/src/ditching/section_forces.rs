//! Section forces of a fuselage (THEORY EN29).

use super::attitude::MODES;
use super::landing::{Landing, LandingState};
use super::masses::Masses;

/// Shear force and bending moment in the cut at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionForce {
    /// Place from the nose [m].
    pub x: f64,
    /// Force of the part aft on the part ahead, upwards from the body axis [N].
    pub shear: f64,
    /// Moment in the cut; it is positive where it bends the ends upwards [N m].
    pub bending: f64,
}

/// Loads on the body axis, less the inertia of the masses.
struct Load {
    x: f64,
    /// Across the axis, upwards [N].
    across: f64,
    /// About the place, nose up [N m].
    couple: f64,
}

impl Landing<'_> {
    /// EN29: in the cuts at `places` [m from the nose], by the balance of the part ahead of each. A cut aft of the tail has only the
    /// error of the balance.
    pub fn section_forces(&self, now: &LandingState, masses: &Masses, places: &[f64]) -> Vec<SectionForce> {
        let loads = self.axis_loads(now, masses);
        let of_cut = |cut: f64| {
            let ahead = || loads.iter().filter(|load| load.x < cut);
            SectionForce {
                x: cut,
                shear: -ahead().map(|load| load.across).sum::<f64>(),
                bending: ahead().map(|load| load.across * (cut - load.x) + load.couple).sum(),
            }
        };
        places.iter().map(|x| of_cut(*x)).collect()
    }

    fn axis_loads(&self, now: &LandingState, masses: &Masses) -> Vec<Load> {
        let (craft, water) = (&self.aeroplane, &self.water);
        let (sin, cos) = now.attitude.place[2].sin_cos();
        let across = |[forward, up]: [f64; 2]| cos * up - sin * forward;
        let load = |x: f64, [forward, up, moment]: [f64; 3]| {
            let across = across([forward, up]);
            Load { x, across, couple: moment - across * (craft.centre[0] - x) }
        };
        let of_strips = now.strips.iter().flat_map(|(strip, force)| {
            let lever = strip.entry.map_or([0.0; 3], |e| [0, 1, 2].map(|k| force * e.lever[k]));
            [lever, strip.rubbing(0.5 * water.density * water.friction), strip.floating()]
                .map(|force| load(strip.wet.x, force))
        });
        let of_parts = now.parts.iter().flatten().map(|p| load(p.x, p.force));
        let (of_air, _, trimming) = craft.wing.air(&now.attitude, self.pitch - self.path);
        let of_air = load(craft.centre[0], [of_air[0], of_air[1], trimming]);
        let [ax, az, turning] = [0, 1, 2].map(|k| now.acceleration[k]);
        let rigid = across([ax, az + water.gravity]);
        let of_masses = masses.x.iter().zip(&masses.mass).map(|(x, mass)| {
            let bending = craft.bending.as_ref().map_or([[0.0; 3]; MODES], |bending| bending.at(*x));
            let modes: f64 = (0..MODES).map(|k| bending[k][0] * now.acceleration[3 + k]).sum();
            Load { x: *x, across: -mass * (rigid + turning * (craft.centre[0] - x) + modes), couple: 0.0 }
        });
        of_strips.chain(of_parts).chain([of_air]).chain(of_masses).collect()
    }
}
