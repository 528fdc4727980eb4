//! Tangential correction at the free surface: rows must not slide along it under a uniform pressure (THEORY PR12).

use crate::parallel;
use crate::projection::operators::Operators;
use crate::system::ParticleSystem;

/// PR12: unit normals of the surface where the indicator is above 0, into the water; elsewhere zero.
pub(crate) fn find_normals(
    normals: &mut Vec<[f64; 2]>,
    system: &ParticleSystem,
    operators: &Operators,
    indicator: &[f64],
) {
    let (neighbours, packed, kernel) = (&system.neighbours, &system.packed.fluid, system.domain.fluid.kernel);
    let around = &operators.around;
    let mirrored = system.domain.mirror.is_some();
    let n = system.particles.len();
    normals.resize(n, [0.0; 2]);
    parallel::gather_into(normals, |k| {
        if indicator[k] == 0.0 {
            return [0.0; 2];
        }
        let a = &packed[k];
        let mut sum = around[k].concentration_gradient().map(|c| a.raw_volume * kernel.value(0.0, a.h) * c);
        for &j in operators.row(k).0 {
            let b = &packed[j as usize];
            let (dx, dy) = (a.x - b.x, a.y - b.y);
            let weight = b.raw_volume * kernel.value((dx * dx + dy * dy).sqrt(), 0.5 * (a.h + b.h));
            let [x, y] = around[neighbours.source(j, n)].concentration_gradient();
            let side = if mirrored && j as usize >= n { -1.0 } else { 1.0 };
            sum[0] += weight * side * x;
            sum[1] += weight * y;
        }
        let length = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        if length > 0.0 { sum.map(|s| s / length) } else { [0.0; 2] }
    });
}

/// PR12: κ times the acceleration along the surface of unit normal `n` [m/s²] that takes the effect of a pressure out of the sums
/// over pairs: `pressure` [Pa] that is uniform, and `bearing` times the weight of still water under gravity `g`.
pub(crate) fn tangential_correction(
    (operators, k): (&Operators, usize),
    n: [f64; 2],
    (rho, g): (f64, [f64; 2]),
    pressure: f64,
    bearing: f64,
) -> [f64; 2] {
    let t = [-n[1], n[0]];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let [xx, xy, yy] = operators.second_moment[k];
    let moment = [xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]];
    let along = dot(t, operators.around[k].concentration_gradient());
    t.map(|t_i| t_i * (pressure / rho * along + bearing * dot(n, g) * dot(t, moment)))
}
