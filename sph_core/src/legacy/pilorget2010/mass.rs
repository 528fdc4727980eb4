//! Masses, and the deficit of a density sum (THEORY LE18, LE19, LE28).

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

use crate::error::Breakdown;
use crate::interactions::kernel::Kernel;
use crate::neighbours::cells::{Cells, Point};

use crate::legacy::pilorget2010::cast::{Cast, Player};
use crate::legacy::pilorget2010::pairs::Pairs;

/// LE18: m = ρ₀/Σ W_ij at row `interior`; elsewhere in proportion to h², the area that a particle stands for.
pub(crate) fn of_interior(cast: &mut Cast, pairs: &Pairs, interior: usize, rho0: f64) {
    let sum = pairs.own[interior] + pairs.of(interior).iter().map(|pair| pair.w).sum::<f64>();
    let h = cast.players[interior].h;
    for player in &mut cast.players {
        player.mass = rho0 / sum * (player.h / h).powi(2);
    }
}

/// LE28: all masses from W m = ρ₀, over fluid, limit particles and dummies.
pub(crate) fn of_inverse(cast: &mut Cast, kernel: Kernel, rho0: f64) -> Result<(), Breakdown> {
    let own = &mut cast.players[..cast.own];
    let point = |(k, p): (usize, &Player)| Point { x: p.x, y: p.y, reach: p.h, index: k as u32 };
    let points: Vec<Point> = own.iter().enumerate().map(point).collect();
    let cells = Cells::build(&points);
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
