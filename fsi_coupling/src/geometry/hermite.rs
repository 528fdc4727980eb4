//! Cubic shape functions.

/// GE9: Hermite shape functions of an interval of length L at t ∈ [0, 1]: value and slope at its start, at its end.
pub fn hermite(t: f64, length: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [1.0 - 3.0 * t2 + 2.0 * t3, length * (t - 2.0 * t2 + t3), 3.0 * t2 - 2.0 * t3, length * (t3 - t2)]
}

/// Derivatives of [`hermite`] with respect to length L t.
pub fn hermite_rate(t: f64, length: f64) -> [f64; 4] {
    let rise = 6.0 * t * (1.0 - t) / length;
    [-rise, 1.0 + t * (3.0 * t - 4.0), rise, t * (3.0 * t - 2.0)]
}

/// Second derivatives of [`hermite`] with respect to length L t.
pub fn hermite_second_rate(t: f64, length: f64) -> [f64; 4] {
    let rise = 6.0 * (1.0 - 2.0 * t) / (length * length);
    [-rise, (6.0 * t - 4.0) / length, rise, (6.0 * t - 2.0) / length]
}
