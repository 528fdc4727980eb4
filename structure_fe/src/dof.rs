//! The degrees of freedom of a node.

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
