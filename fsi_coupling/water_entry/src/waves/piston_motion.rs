//! The motion of a piston that makes regular waves (THEORY WA14).

use crate::waves::linear_wave::LinearWave;

/// x(t) = r(t) (½S sin ωt + S₂ sin 2ωt), r = s³(10 − 15 s + 6 s²), s = min(t/t_r, 1); at rest before t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PistonMotion {
    /// Stroke S [m].
    pub stroke: f64,
    /// Amplitude S₂ of the second harmonic [m].
    pub second: f64,
    /// Angular frequency ω [rad/s].
    pub angular_frequency: f64,
    /// Time t_r in which the motion grows to its full amplitude [s].
    pub ramp: f64,
}

impl PistonMotion {
    /// WA14: the piston that makes a wave of a height [m], at full amplitude after `ramp` periods. With `second_order` it does not
    /// send off the free second harmonic that a sinusoidal motion does: S₂ = H²/(32 d) (3 cosh kd/sinh³ kd − 2 S/H) (Madsen 1971),
    /// for H L²/d³ below 8π²/3, beyond which a wave of one harmonic bound to the first is no longer the shape of the wave.
    pub fn of(wave: &LinearWave, height: f64, ramp: f64, second_order: bool) -> PistonMotion {
        let (kd, ratio) = (wave.kd(), wave.height_over_stroke());
        let second = height * height / (32.0 * wave.depth) * (3.0 * kd.cosh() / kd.sinh().powi(3) - 2.0 / ratio);
        PistonMotion {
            stroke: height / ratio,
            second: if second_order && kd < DEEP { second } else { 0.0 },
            angular_frequency: wave.angular_frequency,
            ramp: ramp * wave.period(),
        }
    }

    /// The farthest that it is from where it starts, at most [m].
    pub fn reach(&self) -> f64 {
        0.5 * self.stroke + self.second.abs()
    }

    /// Displacement [m], velocity [m/s] and acceleration [m/s²] at a time [s].
    pub fn at(&self, time: f64) -> [f64; 3] {
        if time <= 0.0 {
            return [0.0; 3];
        }
        let s = (time / self.ramp).min(1.0);
        let (rest, ramp) = (1.0 - s, self.ramp);
        let r = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
        let rate = 30.0 * (s * rest).powi(2) / ramp;
        let bend = 60.0 * s * rest * (rest - s) / (ramp * ramp);
        let mut swing = [0.0; 3];
        for (amplitude, omega) in
            [(0.5 * self.stroke, self.angular_frequency), (self.second, 2.0 * self.angular_frequency)]
        {
            let (sin, cos) = (omega * time).sin_cos();
            swing[0] += amplitude * sin;
            swing[1] += amplitude * omega * cos;
            swing[2] -= amplitude * omega * omega * sin;
        }
        [r * swing[0], rate * swing[0] + r * swing[1], bend * swing[0] + 2.0 * rate * swing[1] + r * swing[2]]
    }
}

/// k d from which the second harmonic is left out: the wave does not feel the floor, and sinh³ kd would overflow.
const DEEP: f64 = 100.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_starts_at_rest_and_its_derivatives_are_its_own() {
        let wave = LinearWave::of_length(3.0, 0.5, 9.81);
        let piston = PistonMotion::of(&wave, 0.075, 2.0, true);
        assert_eq!(piston.at(0.0), [0.0; 3]);
        for t in [0.01, 0.7, 2.0, 3.1, 3.2, 8.0] {
            let (before, now, after) = (piston.at(t - 1e-5), piston.at(t), piston.at(t + 1e-5));
            for k in 0..2 {
                let rate = (after[k] - before[k]) / 2e-5;
                assert!((rate - now[k + 1]).abs() < 1e-7, "t = {t}, derivative {k}: {rate} {now:?}");
            }
        }
        let quarter = piston.ramp + 0.25 * wave.period();
        assert!((piston.at(quarter)[0] - 0.5 * piston.stroke).abs() < 1e-12, "the full stroke after the ramp");
        assert!((piston.stroke * wave.height_over_stroke() - 0.075).abs() < 1e-15);
    }

    /// In long waves the piston is as far as the water that passes it: velocity u = η √(g/d), whose crests are higher than its
    /// troughs are deep. In short ones the second harmonic has the other sign.
    #[test]
    fn the_second_harmonic_follows_the_shape_of_the_crests() {
        let second = |length: f64| PistonMotion::of(&LinearWave::of_length(length, 1.0, 9.81), 0.05, 2.0, true).second;
        assert!(second(8.0) > 0.0 && second(2.0) < 0.0, "{} {}", second(8.0), second(2.0));
        assert_eq!(second(0.01), 0.0);
    }
}
