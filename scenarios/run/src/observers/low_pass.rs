//! The bandwidth of a gauge: a Butterworth low-pass of second order (THEORY GE4).

use std::f64::consts::{SQRT_2, TAU};

use serde::{Deserialize, Serialize};

/// y'' + √2 ω y' + ω² y = ω² x with ω = 2π f (Butterworth 1930): |y/x| is 1 far below the bandwidth f [Hz], 1/√2 at it,
/// and falls by 40 dB a decade above.
///
/// Integrated exactly for an input that is linear between the times it is given, so that steps may be of any length.
#[derive(Serialize, Deserialize)]
pub struct LowPass {
    omega: f64,
    state: Option<State>,
}

#[derive(Serialize, Deserialize)]
struct State {
    time: f64,
    input: f64,
    value: f64,
    rate: f64,
}

impl LowPass {
    /// A filter of bandwidth `hertz` [Hz]; it starts at rest at its first input.
    pub fn new(hertz: f64) -> LowPass {
        LowPass { omega: TAU * hertz, state: None }
    }

    /// Take the input at `time` [s]; times must not decrease, and at equal times the input jumps.
    pub fn take(&mut self, time: f64, input: f64) {
        let omega = self.omega;
        let Some(s) = &mut self.state else {
            self.state = Some(State { time, input, value: input, rate: 0.0 });
            return;
        };
        let dt = time - s.time;
        if dt > 0.0 {
            let slope = (input - s.input) / dt;
            let lag = SQRT_2 * slope / omega;
            // The ramp's answer trails it by `lag`; the rest rings down from its value and rate at the start.
            let (rest, rest_rate) = (s.value - s.input + lag, s.rate - slope);
            let a = omega / SQRT_2;
            let ((sin, cos), decay) = ((a * dt).sin_cos(), (-a * dt).exp());
            s.value = input - lag + decay * (rest * cos + (rest_rate / a + rest) * sin);
            s.rate = slope + decay * (rest_rate * cos - (rest_rate + 2.0 * a * rest) * sin);
        }
        (s.time, s.input) = (time, input);
    }

    /// The filtered value now; 0 before the first input.
    pub fn value(&self) -> f64 {
        self.state.as_ref().map_or(0.0, |s| s.value)
    }
}

/// A curve through a low-pass of bandwidth `hertz` [Hz] forwards in time and then back, shape (n, 2) of times [s] and values: no
/// delay, and −6 dB at the bandwidth (SAE J211-1, with 2.0775 times the channel frequency class). Times must not decrease. Either pass
/// starts at rest at the mean of its first 1/hertz seconds: a spike in the first row is filtered as any other.
pub fn phaseless(curve: &[[f64; 2]], hertz: f64) -> Vec<[f64; 2]> {
    let pass = |points: &mut Vec<[f64; 2]>, sign: f64| {
        let mut filter = LowPass::new(hertz);
        if let Some([start, _]) = points.first() {
            filter.take(sign * start, mean_of_start(points, 1.0 / hertz));
        }
        for [time, value] in points.iter_mut() {
            filter.take(sign * *time, *value);
            *value = filter.value();
        }
    };
    let mut points = curve.to_vec();
    pass(&mut points, 1.0);
    points.reverse();
    pass(&mut points, -1.0);
    points.reverse();
    points
}

/// Mean of a curve over its first rows, up to a time after the first [s].
fn mean_of_start(points: &[[f64; 2]], duration: f64) -> f64 {
    let start = points.first().map_or(0.0, |row| row[0]);
    let rows = points.windows(2).take_while(|pair| (pair[1][0] - start).abs() <= duration);
    let integral = |(time, sum): (f64, f64), pair: &[[f64; 2]]| {
        let step = (pair[1][0] - pair[0][0]).abs();
        (time + step, sum + 0.5 * step * (pair[0][1] + pair[1][1]))
    };
    match rows.fold((0.0, 0.0), integral) {
        (time, sum) if time > 0.0 => sum / time,
        _ => points.first().map_or(0.0, |row| row[1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 − e^(−at)(cos at + sin at), a = ω/√2, at steps of any length.
    #[test]
    fn the_step_response_is_the_formula() {
        let (hertz, mut time) = (150.0, 0.0);
        let mut filter = LowPass::new(hertz);
        filter.take(0.0, 0.0);
        filter.take(0.0, 1.0);
        for dt in [1e-5, 3e-3, 1e-4, 7e-4, 2e-3, 1e-6, 5e-3] {
            time += dt;
            filter.take(time, 1.0);
            let at = TAU * hertz * time / SQRT_2;
            let exact = 1.0 - (-at).exp() * (at.cos() + at.sin());
            assert!((filter.value() - exact).abs() < 1e-12, "t = {time}: {} {exact}", filter.value());
        }
    }

    /// There and back, a sine of the bandwidth is half as high and not late.
    #[test]
    fn there_and_back_there_is_no_delay() {
        let curve: Vec<[f64; 2]> =
            (0..20_000).map(|k| f64::from(k) * 1e-5).map(|t| [t, (TAU * 50.0 * t).sin()]).collect();
        let smooth = phaseless(&curve, 50.0);
        for ([_, raw], [time, value]) in curve.iter().zip(&smooth).skip(8_000).take(4_000) {
            assert!((value - 0.5 * raw).abs() < 5e-3, "t = {time}: {value}, not half of {raw}");
        }
    }

    /// A sine of the bandwidth comes out 1/√2 as high, ten times above it a hundredth, ten times below it whole.
    #[test]
    fn the_bandwidth_is_where_the_power_is_halved() {
        for (ratio, gain) in [(0.1, 1.0 / 1.0001_f64.sqrt()), (1.0, 1.0 / SQRT_2), (10.0, 1.0 / 10001.0_f64.sqrt())] {
            let (mut filter, hertz, mut largest) = (LowPass::new(50.0), 50.0 * ratio, 0.0_f64);
            for k in 0..40_000 {
                let time = f64::from(k) / (1000.0 * hertz);
                filter.take(time, (TAU * hertz * time).sin());
                if k > 39_000 - 1 {
                    largest = largest.max(filter.value().abs());
                }
            }
            let settled = largest / gain - 1.0;
            assert!(settled.abs() < 2e-3, "{ratio}: {largest}, not {gain}");
        }
    }
}
