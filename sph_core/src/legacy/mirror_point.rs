//! Pressure at a wall particle from its mirror point in the fluid (THEORY LE17; English et al. 2022).

use crate::forces::wall_state::set_wall_state;
use crate::interactions::geometry::kernel_and_gradient;
use crate::interactions::packed_particle::PackedParticle;
use crate::interactions::pair::Extrapolated;
use crate::kernel::{Shape, TargetSum};
use crate::system::ParticleSystem;
use crate::timers::Phase;
use crate::walls::Walls;

/// Below this determinant the first-order system is not trusted (English et al. 2022): Shepard's mean instead.
const LEAST_DETERMINANT: f64 = 1e-3;

/// LE17: what every wall particle finds at its mirror point.
struct MirrorState<'a>(&'a ParticleSystem);

impl TargetSum for MirrorState<'_> {
    type Sum = Extrapolated;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> Extrapolated {
        let (packed, (x, y)) = (&self.0.packed, &self.0.packed.mirror_points);
        let near = self.0.neighbours.fluid_of_mirror.of(k).map(|j| &packed.fluid[j as usize]);
        at_mirror_point::<K>(&packed.walls[k], [x[k], y[k]], near)
    }
}

/// LE17: pressures of the walls from their mirror points.
pub(crate) fn read_mirror_points(system: &mut ParticleSystem, walls: &mut Walls) {
    system.timers.begin(Phase::Walls);
    let mut found = vec![Extrapolated::default(); walls.len()];
    system.domain.fluid.kernel.gather(&MirrorState(system), &mut found);
    system.wall_state = found;
    set_wall_state(system, walls);
}

/// Pressure and its gradient at `point` by Liu & Liu's (2006) corrected interpolation, carried on to the wall
/// particle; Shepard's mean, not carried on, where too little fluid is near; the fluid's mean velocity beside it.
#[inline(always)]
fn at_mirror_point<'r, K: Shape>(
    wall: &PackedParticle,
    point: [f64; 2],
    fluid: impl Iterator<Item = &'r PackedParticle>,
) -> Extrapolated {
    let (mut matrix, mut moments, mut velocity) = ([[0.0; 3]; 3], [0.0; 3], [0.0; 2]);
    for b in fluid {
        let (dx, dy) = (b.x - point[0], b.y - point[1]);
        let Some((w, slope)) = kernel_and_gradient::<K>(dx, dy, 0.5 * (wall.h + b.h)) else {
            continue;
        };
        // V W and V ∇W, the gradient with respect to the point
        let tests = [b.volume * w, -b.volume * slope * dx, -b.volume * slope * dy];
        for (row, test) in tests.into_iter().enumerate() {
            matrix[row][0] += test;
            matrix[row][1] += test * dx;
            matrix[row][2] += test * dy;
            moments[row] += test * b.p;
        }
        velocity[0] += tests[0] * b.u;
        velocity[1] += tests[0] * b.v;
    }
    let filling = matrix[0][0];
    if filling < 1e-9 {
        return Extrapolated { pressure: 0.0, velocity: [wall.u, wall.v] };
    }
    let velocity = [velocity[0] / filling, velocity[1] / filling];
    let all = determinant(matrix);
    if all.abs() < LEAST_DETERMINANT {
        return Extrapolated { pressure: moments[0] / filling, velocity };
    }
    let [p, px, py] = [0, 1, 2].map(|column| {
        let mut replaced = matrix;
        for row in 0..3 {
            replaced[row][column] = moments[row];
        }
        determinant(replaced) / all
    });
    Extrapolated { pressure: p + (wall.x - point[0]) * px + (wall.y - point[1]) * py, velocity }
}

fn determinant(m: [[f64; 3]; 3]) -> f64 {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::WendlandC2;

    #[test]
    fn a_linear_field_reaches_the_wall_exactly() {
        let p = |x: f64, y: f64| 500.0 + 30.0 * x - 900.0 * y;
        let mut fluid = Vec::new();
        for (i, j) in (0..7).flat_map(|i| (0..7).map(move |j| (i, j))) {
            let (x, y) = (0.1 * i as f64 - 0.31 + 0.01 * (j % 2) as f64, 0.1 * j as f64 + 0.05);
            fluid.push(PackedParticle {
                x,
                y,
                p: p(x, y),
                volume: 0.01,
                raw_volume: 0.01,
                h: 0.15,
                ..PackedParticle::default()
            });
        }
        let wall = PackedParticle { x: 0.02, y: -0.15, h: 0.15, ..PackedParticle::default() };
        let found = at_mirror_point::<WendlandC2>(&wall, [0.02, 0.15], fluid.iter()).pressure;
        assert!((found - p(0.02, -0.15)).abs() < 1e-9, "{found}");
        let lone = at_mirror_point::<WendlandC2>(&wall, [0.02, 0.15], fluid[10..11].iter()).pressure;
        assert!((lone - fluid[10].p).abs() < 1e-9, "{lone}");
    }
}
