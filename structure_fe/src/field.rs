//! Fields over the nodes: `[u, w, theta]`, or the conjugate `[F_x, F_y, M]`, per node.

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
