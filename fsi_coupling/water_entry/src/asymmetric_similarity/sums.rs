//! Integrals over the water's boundary (THEORY EN33): mass, momentum and energy of the solution.

/// A place on the boundary in units of V t and V, x outwards.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub at: [f64; 2],
    pub velocity: [f64; 2],
    /// Normal out of the water.
    pub normal: [f64; 2],
    /// p/(ρV²).
    pub pressure: f64,
}

/// ∫ over the boundary of ∂φ/∂n, φ ∂φ/∂n, φ n and φ r × n, in units of V t and V.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    pub flux: f64,
    pub energy: f64,
    pub momentum: [f64; 2],
    pub angular: f64,
}

impl Place {
    /// The integrands; φ = ζ·v − ½v² − p, and ∂φ/∂n is ζ·n on the free surface and v·n everywhere.
    fn integrands(&self) -> Sums {
        let Place { at: [x, y], velocity: [u, v], normal: [nx, ny], pressure } = *self;
        let potential = x * u + y * v - 0.5 * (u * u + v * v) - pressure;
        let flux = u * nx + v * ny;
        Sums {
            flux,
            energy: potential * flux,
            momentum: [potential * nx, potential * ny],
            angular: potential * (x * ny - y * nx),
        }
    }

    /// ∫ from the tip, of which `self` is the end of a straight line at the distance `length`: Simpson's rule, on which the water moves as the
    /// tip does.
    pub fn jet(&self, tip: [f64; 2], length: f64) -> Sums {
        let still = |share: f64| Place {
            at: [0, 1].map(|i| tip[i] + share * (self.at[i] - tip[i])),
            velocity: tip,
            pressure: 0.0,
            normal: self.normal,
        };
        let rule = [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)];
        rule.iter()
            .fold(Sums::default(), |sum, (share, weight)| sum.plus(&still(*share).integrands(), weight * length / 6.0))
    }
}

impl Sums {
    /// With `weight` times others.
    pub fn plus(self, other: &Sums, weight: f64) -> Sums {
        Sums {
            flux: self.flux + weight * other.flux,
            energy: self.energy + weight * other.energy,
            momentum: [0, 1].map(|i| self.momentum[i] + weight * other.momentum[i]),
            angular: self.angular + weight * other.angular,
        }
    }

    /// ∫ over `places` with the distances `weights` from point to point, the first of which is half behind the tip.
    pub fn over(places: &[Place], weights: &[f64]) -> Sums {
        let whole =
            places.iter().zip(weights).fold(Sums::default(), |sum, (place, w)| sum.plus(&place.integrands(), *w));
        whole.plus(&places[0].integrands(), -0.5 * weights[0])
    }

    /// Those of the mirror image.
    pub fn mirrored(self) -> Sums {
        Sums { momentum: [-self.momentum[0], self.momentum[1]], angular: -self.angular, ..self }
    }
}
