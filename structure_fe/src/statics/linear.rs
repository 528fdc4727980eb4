//! Statics: K u = f (THEORY BE7).

use super::mechanism::require_no_free_motion;
use crate::assembly::{Equations, SymmetricMatrix, linear_section_forces, reactions};
use crate::element::SectionForces;
use crate::error::Error;
use crate::field::{Field, combine};
use crate::model::{Beam, Loads, Supports};
use faer::linalg::solvers::Solve;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::{Col, Side};

/// Change of the solution, in the energy norm, at which refinement stops \[-\]. The remaining error is smaller; rounding
/// of the displacements limits it to some 1e-9 with thousands of elements.
const CONVERGED: f64 = 1e-8;

/// Maximum number of solves for one load case; coarse meshes need two.
const REFINEMENTS: usize = 12;

/// A supported model with its stiffness matrix factorised, ready for any number of load cases.
///
/// The symbolic analysis (pattern, elimination order) is kept too, for models that differ in their
/// values only: see [`Statics::refactorise`].
#[derive(Debug, Clone)]
pub struct Statics {
    beam: Beam,
    supports: Supports,
    equations: Equations,
    analysis: SymbolicLlt<usize>,
    factor: Llt<usize, f64>,
}

/// The solution of one load case.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticSolution {
    /// Displacement `[nodes][u, w, theta]` \[m, m, rad\].
    pub displacement: Vec<[f64; 3]>,
    /// Force of the supports on the model, `[nodes][F_x, F_y, M]` \[N, N, N m\]: K u - f where a degree
    /// of freedom is fixed, minus the springs' force where it is on a spring, zero elsewhere.
    pub reactions: Vec<[f64; 3]>,
    /// Section forces at the first and the second node of every element, `[elements][2]`.
    pub section_forces: Vec<[SectionForces; 2]>,
    /// Plastic curvatures at two places of each element \[1/m\]; empty for an elastic model, and in linear statics.
    pub plastic_curvature: Vec<[f64; 2]>,
}

impl Statics {
    /// Analyses and factorises the stiffness matrix of a supported model.
    pub fn new(beam: Beam, supports: Supports) -> Result<Self, Error> {
        supports.check(&beam)?;
        require_no_free_motion(&beam, &supports)?;
        let equations = Equations::new(&beam, &supports);
        let matrix = compressed(equations.count(), &equations.stiffness(&beam, &supports))?;
        let analysis = SymbolicLlt::try_new(matrix.symbolic(), Side::Lower).map_err(|e| failed(matrix.ncols(), e))?;
        let factor = factorise(&analysis, &matrix)?;
        Ok(Self { beam, supports, equations, analysis, factor })
    }

    /// Replaces the model by another of the same connectivity, on the same supports: other coordinates,
    /// materials or sections. The symbolic analysis is reused; an error leaves everything unchanged.
    pub fn refactorise(&mut self, beam: Beam) -> Result<(), Error> {
        let (old, new) = (self.beam.elements(), beam.elements());
        let shared = old.len().min(new.len());
        let differs = (0..shared).find(|&element| old[element].nodes != new[element].nodes);
        if let Some(element) = differs.or((old.len() != new.len()).then_some(shared)) {
            return Err(Error::OtherConnectivity { element });
        }
        require_no_free_motion(&beam, &self.supports)?;
        let matrix = compressed(self.equations.count(), &self.equations.stiffness(&beam, &self.supports))?;
        self.factor = factorise(&self.analysis, &matrix)?;
        self.beam = beam;
        Ok(())
    }

    /// The model.
    pub fn beam(&self) -> &Beam {
        &self.beam
    }

    /// Solves one load case.
    ///
    /// The solution is refined until its last change is below 1e-8 in the energy norm. Residuals come from
    /// the elements' deformations, so refinement recovers the digits that the factorisation loses on a fine
    /// mesh (the condition number grows with the fourth power of the elements along a beam): some 10^4 elements
    /// in a row still converge, more return [`Error::IllConditioned`].
    pub fn solve(&self, loads: &Loads) -> Result<StaticSolution, Error> {
        loads.check(&self.beam)?;
        let element_forces = loads.element_forces(&self.beam);
        let load = loads.nodal_forces(&self.beam, &element_forces);
        let displacement = self.displacement(&load)?;
        let links = &self.equations.links;
        let residual = combine(&self.internal_forces(&displacement), &load, |internal, load| internal - load);
        Ok(StaticSolution {
            reactions: reactions(&self.supports, (links, &links.arms()), &displacement, residual),
            section_forces: linear_section_forces(&self.beam, &displacement, &element_forces),
            displacement,
            plastic_curvature: Vec::new(),
        })
    }

    /// K^-1 f by iterative refinement (Wilkinson 1963): u += K^-1 (f - K u).
    fn displacement(&self, load: &[[f64; 3]]) -> Result<Field, Error> {
        let arms = self.equations.links.arms();
        let load = self.equations.reduce(load, &arms);
        let mut u = Col::<f64>::zeros(load.len());
        let mut change = f64::NAN;
        for _ in 0..REFINEMENTS {
            let displacement = self.displaced(&u);
            let internal = self.equations.reduce(&self.internal_forces(&displacement), &arms);
            let residual = Col::from_fn(load.len(), |i| load[i] - internal[i]);
            let correction = self.factor.solve(&residual);
            u += &correction;
            // Twice the elastic energies of the correction and of the solution.
            let energy =
                |force: &dyn Fn(usize) -> f64, u: &Col<f64>| (0..load.len()).map(|i| force(i) * u[i]).sum::<f64>();
            let of_correction = energy(&|i| residual[i], &correction);
            let of_solution = energy(&|i| load[i], &u);
            if of_correction <= CONVERGED.powi(2) * of_solution {
                return Ok(self.displaced(&u));
            }
            change = (of_correction / of_solution).sqrt();
        }
        Err(Error::IllConditioned { unknowns: load.len(), refinements: REFINEMENTS, change })
    }

    /// Elastic forces of beams and springs.
    fn internal_forces(&self, displacement: &[[f64; 3]]) -> Field {
        let mut internal = self.beam.elastic_forces(displacement);
        self.supports.add_spring_forces(displacement, &mut internal);
        internal
    }

    /// The displacement of all nodes; linked nodes follow the small rotations of their bodies.
    fn displaced(&self, u: &Col<f64>) -> Field {
        let mut displacement = self.equations.extend(|equation| u[equation]);
        self.equations.links.set_velocity(&self.equations.links.arms(), &mut displacement);
        displacement
    }
}

fn failed(unknowns: usize, error: impl std::fmt::Debug) -> Error {
    Error::LinearAlgebra { unknowns, reason: format!("{error:?}") }
}

/// The lower triangle of a symmetric matrix in compressed columns.
fn compressed(unknowns: usize, entries: &SymmetricMatrix) -> Result<SparseColMat<usize, f64>, Error> {
    SparseColMat::try_new_from_triplets(unknowns, unknowns, entries).map_err(|error| failed(unknowns, error))
}

fn factorise(analysis: &SymbolicLlt<usize>, matrix: &SparseColMat<usize, f64>) -> Result<Llt<usize, f64>, Error> {
    let unknowns = matrix.ncols();
    Llt::try_new_with_symbolic(analysis.clone(), matrix.as_ref(), Side::Lower).map_err(|error| match error {
        LltError::Numeric(faer::linalg::cholesky::llt::factor::LltError::NonPositivePivot { index }) => {
            Error::NotPositiveDefinite { pivot: index, unknowns }
        }
        LltError::Generic(error) => failed(unknowns, error),
    })
}
