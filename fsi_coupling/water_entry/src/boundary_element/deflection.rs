//! A bottom that bends: displacement and velocity against its rigid line (THEORY EN51).

use faer::c64;

/// Values x + iy along a bottom, cubic between places, with the slope of the parabola through three places.
#[derive(Clone, Debug)]
pub struct AlongBottom {
    /// Distances from the keel along the rigid bottom [m], increasing.
    along: Vec<f64>,
    value: Vec<c64>,
    slope: Vec<c64>,
}

impl AlongBottom {
    /// Through values at increasing distances from the keel [m], three or more.
    pub fn new(along: &[f64], value: Vec<c64>) -> AlongBottom {
        let last = along.len() - 1;
        let secant = |k: usize| (value[k + 1] - value[k]) / (along[k + 1] - along[k]);
        let slope = |k: usize| match k {
            0 => secant(0),
            k if k == last => secant(last - 1),
            k => {
                let [before, after] = [along[k] - along[k - 1], along[k + 1] - along[k]];
                (secant(k - 1) * after + secant(k) * before) / (before + after)
            }
        };
        AlongBottom { along: along.to_vec(), slope: (0..=last).map(slope).collect(), value }
    }

    /// Value and slope at a distance from the keel [m]; straight on beyond the first and the last place.
    pub fn sample(&self, along: f64) -> [c64; 2] {
        let last = self.along.len() - 1;
        let straight = |k: usize| [self.value[k] + self.slope[k] * (along - self.along[k]), self.slope[k]];
        if along <= self.along[0] {
            return straight(0);
        }
        if along >= self.along[last] {
            return straight(last);
        }
        let k = self.along.partition_point(|at| *at <= along) - 1;
        let h = self.along[k + 1] - self.along[k];
        let t = (along - self.along[k]) / h;
        let ([a, b], [ma, mb]) = ([self.value[k], self.value[k + 1]], [self.slope[k] * h, self.slope[k + 1] * h]);
        let bend = (a - b) * 2.0 + ma + mb;
        let turn = (b - a) * 3.0 - ma * 2.0 - mb;
        [a + (ma + (turn + bend * t) * t) * t, (ma + (turn * 2.0 + bend * 3.0 * t) * t) / h]
    }
}

/// How a bottom is bent: against its rigid line, which moves with the body's frame.
#[derive(Clone, Debug)]
pub struct Deflection {
    /// Displacement [m].
    pub displacement: AlongBottom,
    /// Velocity [m/s].
    pub velocity: AlongBottom,
}

/// Motion of a bottom that bends.
#[derive(Clone, Debug)]
pub struct BottomMotion {
    /// Draught of the undeformed keel [m].
    pub draught: f64,
    /// Downward speed of the frame [m/s].
    pub speed: f64,
    /// Against the frame.
    pub deflection: Deflection,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola is met between inner places, with its slope; a straight line everywhere.
    #[test]
    fn values_along_a_bottom() {
        let along = [0.1, 0.3, 0.4, 0.8, 1.0];
        let parabola = |s: f64| c64::new(1.0 + s - 3.0 * s * s, 2.0 * s * s);
        let field = AlongBottom::new(&along, along.map(parabola).to_vec());
        for s in [0.3, 0.35, 0.5, 0.79] {
            let [value, slope] = field.sample(s);
            assert!((value - parabola(s)).norm() < 1e-13, "{s}: {value}");
            assert!((slope - c64::new(1.0 - 6.0 * s, 4.0 * s)).norm() < 1e-12, "{s}: {slope}");
        }
        let line = AlongBottom::new(&along, along.map(|s| c64::new(2.0 - s, 3.0 * s)).to_vec());
        for s in [0.0, 0.2, 0.95, 1.4] {
            assert!((line.sample(s)[0] - c64::new(2.0 - s, 3.0 * s)).norm() < 1e-13, "{s}");
        }
    }
}
