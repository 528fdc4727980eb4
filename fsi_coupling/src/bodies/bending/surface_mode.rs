//! A mode of a surface.

use structure_fe::modal::ModalMode;

/// A mode, and the stress that it causes.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceMode {
    /// Frequency, generalised mass, damping, shape.
    pub mode: ModalMode,
    /// Stress at the nodes at unit amplitude [Pa/m]; empty where it is not known.
    pub stress: Vec<f64>,
}
