//! Degrees of freedom, and fields over the nodes: `[u, w, theta]`, or the conjugate `[F_x, F_y, M]`, per node.

/// A degree of freedom of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dof {
    /// Displacement u along x \[m\].
    U = 0,
    /// Displacement w along y \[m\].
    W = 1,
    /// Rotation theta from x towards y \[rad\].
    Theta = 2,
}

impl Dof {
    /// All three, in the order of a field's components.
    pub(crate) const ALL: [Self; 3] = [Self::U, Self::W, Self::Theta];
}

impl std::fmt::Display for Dof {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        out.write_str(match self {
            Dof::U => "u",
            Dof::W => "w",
            Dof::Theta => "theta",
        })
    }
}

/// A field over the nodes, `[nodes][3]`.
pub(crate) type Field = Vec<[f64; 3]>;

/// The field of the values f(a, b) of two fields.
pub(crate) fn combine(a: &[[f64; 3]], b: &[[f64; 3]], f: impl Fn(f64, f64) -> f64) -> Field {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|dof| f(a[dof], b[dof]))).collect()
}

/// The sum of the products f(a, b) of two fields.
pub(crate) fn sum(a: &[[f64; 3]], b: &[[f64; 3]], f: impl Fn(f64, f64) -> f64) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| f(*a, *b)).sum()
}
