//! Forces on an aeroplane on the water, and its accelerations under them (THEORY EN18, EN19, EN27).

use super::aeroplane::{Aeroplane, Water};
use super::attitude::{Attitude, FREEDOMS, STRUTS};
use super::bending::Bending;
use super::landing::Landing;
use super::parts::PointForce;
use super::strip::{Bottom, ImpactingPart, KeelPoint, Strip, along};
use super::struts::StrutLoad;
use super::swell::Swell;
use crate::planing::finite_length;

/// Rounds in which it is found which strips press and which pull.
const MOST_ROUNDS: usize = 40;

/// Accelerations and what made them.
pub(super) struct Balance {
    pub acceleration: [f64; FREEDOMS],
    /// Accelerations of the strokes [m/s²].
    pub of_strokes: [f64; STRUTS],
    pub force: [f64; 3],
    pub lift: f64,
    pub strips: Vec<(Strip, f64)>,
    pub parts: Vec<Vec<PointForce>>,
}

/// Sign and limit of a strip's load.
#[derive(Clone, Copy, PartialEq)]
enum StripLoad {
    /// It presses.
    Presses,
    /// It pulls, by a share of the theory's force.
    Pulls(f64),
    /// It pulls with the largest suction [N].
    Tears(f64),
}

impl StripLoad {
    /// EN27: of a strip whose force by the theory is `force` [N].
    fn of(part: &ImpactingPart, force: f64, suction: f64, largest: f64) -> StripLoad {
        let (share, most) = (suction * part.pulling, largest * part.still_area);
        match force {
            f if f >= 0.0 => StripLoad::Presses,
            f if -share * f <= most => StripLoad::Pulls(share),
            _ => StripLoad::Tears(most),
        }
    }

    /// Force at no acceleration of the aeroplane [N], and what it loses per acceleration along the lever [kg].
    fn parts(self, part: &ImpactingPart) -> (f64, f64) {
        match self {
            StripLoad::Presses => (part.pressing, part.mass),
            StripLoad::Pulls(share) => (share * part.pressing, share * part.mass),
            StripLoad::Tears(most) => (-most, 0.0),
        }
    }
}

/// Generalised forces on the freedoms of an aeroplane.
struct Forces<'a> {
    on: [f64; FREEDOMS],
    bending: Option<&'a Bending>,
    up: [f64; 2],
}

impl Forces<'_> {
    /// Of forces forward, up and nose up at a place [m from the nose].
    fn add(&mut self, x: f64, force: [f64; 3]) {
        (0..3).for_each(|k| self.on[k] += force[k]);
        if let Some(bending) = self.bending {
            let across = self.up[0] * force[0] + self.up[1] * force[1];
            bending.at(x).iter().enumerate().for_each(|(k, mode)| self.on[3 + k] += mode[0] * across);
        }
    }
}

impl Landing<'_> {
    /// EN18: (diag(m, m, I, 1 …) + Σ M g gᵀ) a = Σ f₀ g + weight, lift, buoyancy, friction, other parts, stiffness of the modes.
    ///
    /// The load of each strip is found with the accelerations: f = f₀ − M g·a.
    pub(super) fn balance(&self, time: f64, now: &Attitude, lost: &[bool]) -> Balance {
        let Landing { aeroplane: craft, water, .. } = self;
        let bending = craft.bending.as_ref();
        let swell = self.swell.later(time);
        let (sin, cos) = now.place[2].sin_cos();
        let (of_air, lift, trimming) = craft.wing.air(now, self.pitch - self.path);
        let air = [of_air[0], of_air[1] - craft.mass * water.gravity, trimming];
        let mut given = Forces { on: [0.0; FREEDOMS], bending, up: [-sin, cos] };
        given.on[..3].copy_from_slice(&air);
        if let Some(bending) = bending {
            given.on[3..].copy_from_slice(&bending.restoring(now));
        }
        // the fuselage, then what is left of the nacelles
        let bottom = |hull| Bottom { hull, centre: craft.centre, bending, swell };
        let mut bodies = vec![self.strips(&bottom(self.hull), &self.edges(), 1.0, now)];
        bodies[0].retain(|strip| !craft.is_open(strip.wet.x, lost));
        if water.finite_length && self.planes_on_its_end(&bottom(self.hull), now) {
            let share = length_share(&bodies[0]);
            bodies[0] = bodies[0].iter().map(|strip| strip.with_share(share)).collect();
        }
        bodies.extend(craft.nacelles.iter().zip(&lost[craft.surfaces.len()..]).map(|(nacelle, lost)| match lost {
            true => Vec::new(),
            false => self.strips(&bottom(&nacelle.hull), &nacelle.edges(), nacelle.number, now),
        }));
        let rubs = 0.5 * water.density * water.friction;
        for strip in bodies.iter().flatten() {
            given.add(strip.wet.x, strip.rubbing(rubs));
            given.add(strip.wet.x, strip.floating());
        }
        let mut parts = craft.immersed(self.hull, now, &swell, lost, water.density);
        parts.iter().flatten().for_each(|p| given.add(p.x, p.force));

        let struts = self.struts(now, &swell, &lost[lost.len().min(craft.first_strut())..]);
        let sprung: Vec<(f64, [f64; FREEDOMS])> = struts
            .iter()
            .zip(&craft.struts)
            .filter_map(|(s, strut)| Some((strut.number * strut.mass, s.as_ref()?.lever)))
            .collect();
        for (load, strut) in struts.iter().zip(&craft.struts) {
            // EN56: the foot's mass does not go with the aeroplane along the stroke; across it, it does
            let along = load.map_or(0.0, |s| s.along + strut.number * strut.mass * water.gravity * cos - s.water_along);
            let force = load.map_or([0.0; 3], |s| [0, 1, 2].map(|k| s.water[k] + along * s.lever[k]));
            given.add(strut.foot[0], force);
        }

        let entering: Vec<ImpactingPart> = bodies.iter().flatten().filter_map(|s| s.entry).collect();
        let (acceleration, loads) = self.accelerations(&entering, &sprung, given.on);
        let mut loads = loads.into_iter();
        let mut loaded = bodies.into_iter().map(|strips| {
            let load = |s: Strip| (s, s.entry.and_then(|_| loads.next()).unwrap_or(0.0));
            strips.into_iter().map(load).collect::<Vec<_>>()
        });
        let strips = loaded.next().unwrap_or_default();
        for (part, strips) in parts[craft.surfaces.len()..].iter_mut().zip(loaded) {
            part.extend(strips.iter().map(|(s, load)| {
                let (floating, lever) = (s.floating(), s.entry.map_or([0.0; FREEDOMS], |e| e.lever));
                let rub = s.rubbing(rubs);
                PointForce { x: s.wet.x, force: [0, 1, 2].map(|k| load * lever[k] + floating[k] + rub[k]) }
            }));
        }
        let inertia = [craft.mass, craft.mass, craft.inertia];
        let mut force = [0, 1, 2].map(|k| inertia[k] * acceleration[k] - air[k]);
        let mut of_strokes = [0.0; STRUTS];
        for (k, (load, strut)) in struts.iter().zip(&craft.struts).enumerate() {
            parts.push(Vec::new());
            let Some(s) = load else { continue };
            let mass = strut.number * strut.mass;
            of_strokes[k] = (s.water_along - s.along) / mass - water.gravity * cos - along(&s.lever, &acceleration);
            // of the water's force a part moves the foot only
            let of_foot = [0, 1, 2].map(|i| mass * of_strokes[k] * s.lever[i]);
            (0..3).for_each(|i| force[i] += of_foot[i]);
            let on_fuselage = PointForce { x: strut.foot[0], force: [0, 1, 2].map(|i| s.water[i] - of_foot[i]) };
            parts[craft.first_strut() + k].push(on_fuselage);
        }
        Balance { acceleration, of_strokes, force, lift, strips, parts }
    }

    /// EN56: the struts that are not lost.
    fn struts(&self, now: &Attitude, swell: &Swell, lost: &[bool]) -> Vec<Option<StrutLoad>> {
        let (craft, water) = (&self.aeroplane, &self.water);
        let load = |k: usize| craft.struts[k].at(k, craft.centre, now, swell, water.density, water.gravity);
        (0..craft.struts.len()).map(|k| (!lost.get(k).copied().unwrap_or(false)).then(|| load(k))).collect()
    }

    /// The wet strips of `number` equal bottoms side by side.
    fn strips(&self, bottom: &Bottom<'_>, edges: &[f64], number: f64, now: &Attitude) -> Vec<Strip> {
        let Water { density, gravity, .. } = self.water;
        let ends: Vec<KeelPoint> = edges.iter().map(|x| KeelPoint::new(bottom, now, *x)).collect();
        let cut = |w: &[KeelPoint]| Strip::new(bottom, now, [&w[0], &w[1]], density, gravity);
        ends.windows(2).filter_map(cut).map(|strip| strip.times(number)).collect()
    }

    /// Does the end of the fuselage go down through the water, which leaves it there?
    fn planes_on_its_end(&self, bottom: &Bottom<'_>, now: &Attitude) -> bool {
        let stations = self.hull.fuselage().stations();
        let end = KeelPoint::new(bottom, now, stations[stations.len() - 1].x);
        end.draught > 0.0 && end.speed > 0.0
    }

    /// Accelerations under the `given` forces and those of the entering strips, and these [N].
    fn accelerations(
        &self,
        entering: &[ImpactingPart],
        sprung: &[(f64, [f64; FREEDOMS])],
        given: [f64; FREEDOMS],
    ) -> ([f64; FREEDOMS], Vec<f64>) {
        let Water { suction, largest_suction, .. } = self.water;
        let Aeroplane { mass, inertia, .. } = self.aeroplane;
        let strip_load = |e: &ImpactingPart, a| StripLoad::of(e, e.force(a), suction, largest_suction);
        let mut acceleration = [0.0; FREEDOMS];
        let mut strip_loads: Vec<StripLoad> = entering.iter().map(|e| strip_load(e, acceleration)).collect();
        for _ in 0..MOST_ROUNDS {
            let diagonal = |k: usize| [mass, mass, inertia].get(k).copied().unwrap_or(1.0);
            let mut matrix: Matrix =
                std::array::from_fn(|i| std::array::from_fn(|j| if i == j { diagonal(i) } else { 0.0 }));
            let mut right = given;
            for (mass, lever) in sprung {
                (0..FREEDOMS).for_each(|i| (0..FREEDOMS).for_each(|j| matrix[i][j] -= mass * lever[i] * lever[j]));
            }
            for (e, strip_load) in entering.iter().zip(&strip_loads) {
                let (still, per_acceleration) = strip_load.parts(e);
                for i in 0..FREEDOMS {
                    right[i] += still * e.lever[i];
                    (0..FREEDOMS).for_each(|j| matrix[i][j] += per_acceleration * e.lever[i] * e.lever[j]);
                }
            }
            acceleration = solved(matrix, right);
            let next: Vec<StripLoad> = entering.iter().map(|e| strip_load(e, acceleration)).collect();
            if next == strip_loads {
                break;
            }
            strip_loads = next;
        }
        let forces = entering.iter().zip(&strip_loads).map(|(e, strip_load)| {
            let (still, per_acceleration) = strip_load.parts(e);
            still - per_acceleration * along(&e.lever, &acceleration)
        });
        (acceleration, forces.collect())
    }
}

/// EN46: share of the load that a finite wetted length leaves, of the wetted area over the square of the largest wetted breadth.
fn length_share(strips: &[Strip]) -> f64 {
    let entering = || strips.iter().filter_map(|strip| strip.entry);
    let breadth = entering().map(|e| e.breadth()).fold(0.0, f64::max);
    finite_length(entering().map(|e| e.area).sum::<f64>() / (breadth * breadth))
}

type Matrix = [[f64; FREEDOMS]; FREEDOMS];

/// Gauss's elimination, for a positive definite matrix.
fn solved(mut m: Matrix, mut b: [f64; FREEDOMS]) -> [f64; FREEDOMS] {
    for k in 0..FREEDOMS {
        for i in k + 1..FREEDOMS {
            let factor = m[i][k] / m[k][k];
            let row = m[k];
            (k..FREEDOMS).for_each(|j| m[i][j] -= factor * row[j]);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..FREEDOMS).rev() {
        let rest: f64 = (k + 1..FREEDOMS).map(|j| m[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / m[k][k];
    }
    b
}
