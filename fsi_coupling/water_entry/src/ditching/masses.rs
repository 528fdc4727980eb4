//! Masses along a fuselage (THEORY EN28): section forces and bending depend on them.

/// Nodes that the masses stand at.
const NODES: usize = 61;

/// Point masses along the body axis that have an aeroplane's mass, centre and moment of inertia.
#[derive(Clone, Debug, PartialEq)]
pub struct Masses {
    /// Places from the nose, equal distances apart [m].
    pub x: Vec<f64>,
    /// Masses there [kg].
    pub mass: Vec<f64>,
}

impl Masses {
    /// Masses on the length from `ends[0]` to `ends[1]` [m from the nose] with a total `mass` [kg], a `centre` [m from the nose] and an `inertia`
    /// about it [kg m²]. `known` ones [m, kg] stand where they are; the rest is a uniform line, symmetric about its centre and as long as
    /// the ends allow, and a point at that centre.
    ///
    /// # Errors
    /// In words: what was expected.
    pub fn new(ends: [f64; 2], mass: f64, centre: f64, inertia: f64, known: &[[f64; 2]]) -> Result<Masses, String> {
        let [from, to] = ends;
        let step = (to - from) / (NODES - 1) as f64;
        let x: Vec<f64> = (0..NODES).map(|k| from + step * k as f64).collect();
        let mut masses = Masses { mass: vec![0.0; NODES], x };
        if let Some([at, _]) = known.iter().find(|[at, _]| !(from..=to).contains(at)) {
            return Err(format!("masses between {from} and {to} m, not one at {at} m"));
        }
        known.iter().for_each(|[at, mass]| masses.put(*at, *mass));
        let [known_mass, known_moment] = [masses.sum(|_| 1.0), masses.sum(|x| x - centre)];
        let rest = mass - known_mass;
        if rest <= 0.0 {
            return Err(format!("masses below that of the whole, {mass} kg, not {known_mass} kg"));
        }
        let middle = centre - known_moment / rest;
        let half = (middle - from).min(to - middle);
        let line = {
            let mut line = Masses { mass: vec![0.0; NODES], ..masses.clone() };
            (0..NODES).for_each(|k| {
                line.put(middle + half * (2.0 * k as f64 / (NODES - 1) as f64 - 1.0), 1.0 / NODES as f64)
            });
            line
        };
        let point = {
            let mut point = Masses { mass: vec![0.0; NODES], ..masses.clone() };
            point.put(middle.clamp(from, to), 1.0);
            point
        };
        let about_centre = |x: f64| (x - centre).powi(2);
        let [of_line, of_point] = [line.sum(about_centre), point.sum(about_centre)];
        let share = ((inertia - masses.sum(about_centre)) / rest - of_point) / (of_line - of_point);
        if !(half > 0.0 && (0.0..=1.0).contains(&share)) {
            let [least, most] = [of_point, of_line].map(|i| ((masses.sum(about_centre) + rest * i) / mass).sqrt());
            return Err(format!(
                "a radius of gyration of {least:.3} to {most:.3} m, as masses along the fuselage have"
            ));
        }
        for (k, mass) in masses.mass.iter_mut().enumerate() {
            *mass += rest * (share * line.mass[k] + (1.0 - share) * point.mass[k]);
        }
        Ok(masses)
    }

    /// A mass at a place, on the two nodes next to it.
    fn put(&mut self, at: f64, mass: f64) {
        let step = self.x[1] - self.x[0];
        let k = (((at - self.x[0]) / step) as usize).min(NODES - 2);
        let share = ((at - self.x[k]) / step).clamp(0.0, 1.0);
        self.mass[k] += mass * (1.0 - share);
        self.mass[k + 1] += mass * share;
    }

    fn sum(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.x.iter().zip(&self.mass).map(|(x, mass)| mass * of(*x)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_have_the_mass_the_centre_and_the_inertia_of_the_aeroplane() {
        let known = [[12.0, 4000.0], [30.0, 1500.0]];
        for known in [&known[..], &[]] {
            let masses = Masses::new([0.0, 34.8], 44.7e3, 16.3, 44.7e3 * 6.6 * 6.6, known).expect("masses");
            let sums = [masses.sum(|_| 1.0) / 44.7e3, masses.sum(|x| x) / 44.7e3 / 16.3];
            let inertia = masses.sum(|x| (x - 16.3) * (x - 16.3)) / (44.7e3 * 6.6 * 6.6);
            [sums[0], sums[1], inertia].iter().for_each(|s| assert!((s - 1.0).abs() < 1e-12, "{sums:?} {inertia}"));
            assert!(masses.mass.iter().all(|m| *m >= 0.0));
        }
        let refused = Masses::new([0.0, 34.8], 44.7e3, 16.3, 44.7e3 * 400.0, &[]).expect_err("too large");
        assert!(refused.contains("radius of gyration of 0."), "{refused}");
    }
}
