//! Sums over the pairs of a row: masses and densities (THEORY LE18, LE19, LE28), the free surface and the dummies that it mirrors
//! (LE23, LE25), and the corrector's gradient (LE26).

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

use crate::error::Breakdown;
use crate::kernel::Kernel;
use crate::legacy::pilorget2010::cast::{Cast, Pairs, Reflection, points};
use crate::neighbours::cells::Cells;

/// A player lower below the surface than this share of h has a mirror image.
const LOWER: f64 = 0.1;

/// LE18: m = ρ₀/Σ W_ij at row `interior`; elsewhere in proportion to h², the area that a particle stands for.
pub(crate) fn masses_of_interior(cast: &mut Cast, pairs: &Pairs, interior: usize, rho0: f64) {
    let sum = pairs.own[interior] + pairs.of(interior).iter().map(|pair| pair.w).sum::<f64>();
    let h = cast.players[interior].h;
    for player in &mut cast.players {
        player.mass = rho0 / sum * (player.h / h).powi(2);
    }
}

/// LE28: all masses from W m = ρ₀, over fluid, limit particles and dummies.
pub(crate) fn masses_of_inverse(cast: &mut Cast, kernel: Kernel, rho0: f64) -> Result<(), Breakdown> {
    let own = &mut cast.players[..cast.own];
    let cells = Cells::build(&points(own));
    let mut entries = Vec::new();
    for (i, a) in own.iter().enumerate() {
        cells.for_each_within(a.x, a.y, a.h, |q| {
            let h = 0.5 * (a.h + own[q.index as usize].h);
            let w = kernel.value((a.x - q.x).hypot(a.y - q.y), h);
            entries.push(Triplet::new(i, q.index as usize, w));
        });
    }
    let n = own.len();
    let singular = Breakdown::Masses { unknowns: n };
    let w = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &entries).map_err(|_| singular)?;
    let mut m = faer::Col::from_fn(n, |_| rho0);
    w.sp_lu().map_err(|_| singular)?.solve_in_place(m.as_mut());
    for (player, k) in own.iter_mut().zip(0..) {
        player.mass = m[k];
    }
    Ok(())
}

/// Σ m_j W_ij [kg/m³] of row `i`, without what is stored for it (LE19).
pub(crate) fn density_sum(cast: &Cast, pairs: &Pairs, i: usize) -> f64 {
    let own = cast.players[i].mass * pairs.own[i];
    let counted = pairs.of(i).iter().filter(|pair| cast.players[pair.j as usize].counts);
    own + counted.map(|pair| cast.players[pair.j as usize].mass * pair.w).sum::<f64>()
}

/// −∇·r_i = −(1/ρ₀) Σ m_j r_ij·∇W_ij [-] (LE23): 2 inside.
pub(crate) fn divergence_of_place(cast: &Cast, pairs: &Pairs, i: usize, rho0: f64) -> f64 {
    let sum = pairs.of(i).iter().filter(|pair| cast.players[pair.j as usize].counts).map(|pair| {
        let r2 = pair.r[0] * pair.r[0] + pair.r[1] * pair.r[1];
        -cast.players[pair.j as usize].mass * pair.grad_factor * r2
    });
    sum.sum::<f64>() / rho0
}

/// Unit normal out of the fluid, against Σ m ∇W.
pub(crate) fn surface_normal(cast: &Cast, pairs: &Pairs, i: usize) -> Option<[f64; 2]> {
    let mut sum = [0.0; 2];
    for pair in pairs.of(i).iter().filter(|pair| cast.players[pair.j as usize].counts) {
        for axis in 0..2 {
            sum[axis] -= cast.players[pair.j as usize].mass * pair.grad_factor * pair.r[axis];
        }
    }
    let length = sum[0].hypot(sum[1]);
    (length > 0.0).then(|| sum.map(|c| c / length))
}

/// LE25: all particles below the surface, as mirrored by the nearest surface particle that touches water; `fluid` rows are water.
pub(crate) fn reflections(cast: &Cast, pairs: &Pairs, at_surface: &[bool], fluid: usize) -> Vec<Reflection> {
    let mut nearest: Vec<Option<(f64, Reflection)>> = vec![None; cast.own];
    for s in (0..cast.rows).filter(|&s| at_surface[s]) {
        let wet = s < fluid || pairs.of(s).iter().any(|pair| (pair.j as usize) < fluid);
        let (true, Some(n)) = (wet, surface_normal(cast, pairs, s)) else { continue };
        for pair in pairs.of(s) {
            let j = pair.j as usize;
            let below = pair.r[0] * n[0] + pair.r[1] * n[1] > LOWER * cast.players[s].h;
            if j >= cast.own || !below || (j < cast.rows && at_surface[j]) {
                continue;
            }
            let away = pair.r[0] * pair.r[0] + pair.r[1] * pair.r[1];
            if nearest[j].is_none_or(|(least, _)| away < least * (1.0 - 1e-9)) {
                nearest[j] = Some((away, Reflection { player: pair.j, surface: s as u32, n }));
            }
        }
    }
    nearest.into_iter().flatten().map(|(_, reflection)| reflection).collect()
}

/// ∇P_i/ρ_i [m/s²] of row `i`: (1/ρ_i²) Σ m_j (P_j − P_i) ∇W_ij.
pub(crate) fn gradient_inside(cast: &Cast, pairs: &Pairs, pressure: &[f64], density: f64, i: usize) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for pair in pairs.of(i) {
        let other = &cast.players[pair.j as usize];
        let difference = other.mass * (other.sign * pressure[other.row as usize] - pressure[i]) * pair.grad_factor;
        sum = [0, 1].map(|axis| sum[axis] + difference * pair.r[axis]);
    }
    sum.map(|s| s / (density * density))
}

/// LE25: the same of a particle at the surface, whose own neighbours are mirrored at the plane through it with normal `n`:
/// 2 n n·∇P/ρ.
pub(crate) fn gradient_at_surface(
    cast: &Cast,
    pairs: &Pairs,
    pressure: &[f64],
    density: f64,
    i: usize,
    n: [f64; 2],
) -> [f64; 2] {
    let mut sum = 0.0;
    for pair in pairs.of(i) {
        let other = &cast.players[pair.j as usize];
        if other.counts {
            let along = pair.r[0] * n[0] + pair.r[1] * n[1];
            sum += 2.0 * other.mass * other.sign * pressure[other.row as usize] * pair.grad_factor * along;
        }
    }
    n.map(|c| c * sum / (density * density))
}

/// LE26: Σ W_ij/|Σ (y_i − y_j) ∂W_ij/∂y| [-], y along `up`.
pub(crate) fn gradient_correction(pairs: &Pairs, i: usize, up: [f64; 2]) -> f64 {
    let (mut filling, mut grad_factor) = (pairs.own[i], 0.0);
    for pair in pairs.of(i) {
        let height = pair.r[0] * up[0] + pair.r[1] * up[1];
        filling += pair.w;
        grad_factor += pair.grad_factor * height * height;
    }
    if grad_factor == 0.0 { 1.0 } else { filling / grad_factor.abs() }
}
