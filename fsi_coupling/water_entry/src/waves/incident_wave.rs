//! The velocity of the water below a regular wave in a closed flume (THEORY WA16).

use crate::waves::linear_wave::LinearWave;

/// A regular wave that runs to the right, to second order in its height (Stokes 1847; Dean & Dalrymple 1991):
/// u = aω cosh k(y + d)/sinh kd cos θ + ¾ a²ωk cosh 2k(y + d)/sinh⁴ kd cos 2θ − U, θ = ωt − k(x − x₀), and v with sinh and −sin.
///
/// U = a²ω/(2 d tanh kd) is the current against the waves by which no water is carried through a closed flume in the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IncidentWave {
    wave: LinearWave,
    amplitude: f64,
    origin: f64,
    /// The current U [m/s].
    current: f64,
    /// Whether it has its second harmonic.
    second_order: bool,
}

impl IncidentWave {
    /// WA16: the wave of a height [m] whose crest is at x = `origin` [m] at t = 0, with or without its second harmonic.
    pub fn of(wave: LinearWave, height: f64, origin: f64, second_order: bool) -> IncidentWave {
        let a = 0.5 * height;
        let current = 0.5 * a * a * wave.angular_frequency / (wave.depth * wave.kd().tanh());
        IncidentWave { wave, amplitude: a, origin, current, second_order }
    }

    /// Velocity [m/s] at a point [m], y from the still water upwards, at a time [s].
    pub fn velocity(&self, [x, y]: [f64; 2], time: f64) -> [f64; 2] {
        let LinearWave { depth, angular_frequency: omega, wave_number: k } = self.wave;
        let (a, phase) = (self.amplitude, omega * time - k * (x - self.origin));
        // cosh nk(y + d) and sinh over ½ exp(nkd), and sinh kd over ½ exp(kd): none overflows
        let floor = 1.0 - (-2.0 * k * depth).exp();
        let harmonic = |amplitude: f64, n: f64| {
            let ((sin, cos), up, down) = ((n * phase).sin_cos(), (n * k * y).exp(), (-n * k * (y + 2.0 * depth)).exp());
            [amplitude * (up + down) * cos, -amplitude * (up - down) * sin]
        };
        let one = harmonic(a * omega / floor, 1.0);
        let bound = if self.second_order { 6.0 } else { 0.0 };
        let two = harmonic(bound * a * a * omega * k * (-2.0 * k * depth).exp() / floor.powi(4), 2.0);
        [one[0] + two[0] - self.current, one[1] + two[1]]
    }

    /// Height of the surface above the still water [m] at x [m] and a time [s]: a cos θ + ¼ a²k cosh kd (2 + cosh 2kd)/sinh³ kd cos 2θ.
    pub fn elevation(&self, x: f64, time: f64) -> f64 {
        let (a, k, kd) = (self.amplitude, self.wave.wave_number, self.wave.kd());
        let phase = self.wave.angular_frequency * time - k * (x - self.origin);
        let t = kd.tanh();
        // cosh kd (2 + cosh 2kd)/sinh³ kd = (3 − t²)/t³
        a * phase.cos() + 0.25 * a * a * k * (3.0 - t * t) / (t * t * t) * (2.0 * phase).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(length: f64) -> IncidentWave {
        IncidentWave::of(LinearWave::of_length(length, 0.5, 9.81), 0.02, -3.0, true)
    }

    /// The printed formula at kd = 1.57, and no overflow on deep water.
    #[test]
    fn the_velocity_is_that_of_the_printed_formula() {
        let (wave, linear) = (wave(2.0), LinearWave::of_length(2.0, 0.5, 9.81));
        let (k, omega, kd, phase) =
            (linear.wave_number, linear.angular_frequency, linear.kd(), linear.wave_number * 3.2);
        let first = 0.01 * omega * (k * 0.4).cosh() / kd.sinh() * phase.cos();
        let second = 0.75e-4 * omega * k * (2.0 * k * 0.4).cosh() / kd.sinh().powi(4) * (2.0 * phase).cos();
        let current = 0.5e-4 * omega / (0.5 * kd.tanh());
        assert!((wave.velocity([0.2, -0.1], 0.0)[0] - (first + second - current)).abs() < 1e-15);
        let deep = IncidentWave::of(LinearWave::of_length(0.1, 100.0, 9.81), 0.001, 0.0, true);
        assert!(deep.velocity([0.3, -0.01], 0.2).iter().all(|v| v.is_finite() && *v != 0.0));
    }

    /// Free of divergence and of vorticity, no flow through the floor.
    #[test]
    fn the_flow_is_a_potential_flow_above_a_floor() {
        let e = 1e-5;
        for length in [6.0, 2.0, 0.5] {
            let wave = wave(length);
            for (x, y, t) in [(0.3, -0.1, 0.2), (1.0, -0.4, 3.0), (-2.0, 0.005, 1.1)] {
                let rate = |k: usize, way: [f64; 2]| {
                    let at = |s: f64| wave.velocity([x + s * way[0], y + s * way[1]], t)[k];
                    (at(e) - at(-e)) / (2.0 * e)
                };
                let scale = rate(0, [1.0, 0.0]).abs() + rate(0, [0.0, 1.0]).abs() + 1e-9;
                assert!(
                    (rate(0, [1.0, 0.0]) + rate(1, [0.0, 1.0])).abs() < 1e-6 * scale.max(1e-3),
                    "{length}: divergence"
                );
                assert!(
                    (rate(1, [1.0, 0.0]) - rate(0, [0.0, 1.0])).abs() < 1e-6 * scale.max(1e-3),
                    "{length}: vorticity"
                );
            }
            assert!(wave.velocity([0.7, -0.5], 0.4)[1].abs() < 1e-15);
        }
    }

    /// The surface moves with the water to second order: what ∂η/∂t + u ∂η/∂x − v leaves falls with the cube of the height; and the flow
    /// through a plane, from the floor to the surface, is 0 in the mean.
    #[test]
    fn the_surface_moves_with_the_water_and_no_water_is_carried() {
        let rest = |height: f64| {
            let wave = IncidentWave::of(LinearWave::of_length(2.0, 0.5, 9.81), height, 0.0, true);
            let period = wave.wave.period();
            let (mut worst, mut carried, e, n) = (0.0_f64, 0.0, 1e-5, 200);
            for k in 0..n {
                let t = period * f64::from(k) / f64::from(n);
                let eta = wave.elevation(0.1, t);
                let [u, v] = wave.velocity([0.1, eta], t);
                let by_time = (wave.elevation(0.1, t + e) - wave.elevation(0.1, t - e)) / (2.0 * e);
                let by_place = (wave.elevation(0.1 + e, t) - wave.elevation(0.1 - e, t)) / (2.0 * e);
                worst = worst.max((by_time + u * by_place - v).abs());
                let layers = 400;
                let dy = (0.5 + eta) / f64::from(layers);
                let flow: f64 =
                    (0..layers).map(|j| dy * wave.velocity([0.1, -0.5 + dy * (f64::from(j) + 0.5)], t)[0]).sum();
                carried += flow / f64::from(n);
            }
            (worst, carried.abs())
        };
        let ((coarse, carried), (fine, less)) = (rest(0.04), rest(0.02));
        assert!(coarse / fine > 7.0, "{coarse} {fine}");
        assert!(carried / less > 12.0, "the fourth power of the height: {carried} {less}");
    }
}
