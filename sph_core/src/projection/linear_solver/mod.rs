//! Conjugate gradients with a multigrid preconditioner (THEORY LS2–LS10).

mod aggregates;
pub(crate) mod cg;
pub(crate) mod cluster_matrix;
mod coarse;
mod hierarchy;
pub(crate) mod matrix;
mod multigrid;
mod null_space;
#[cfg(test)]
pub(crate) mod test_systems;
#[cfg(test)]
mod tests;
mod woodbury;
