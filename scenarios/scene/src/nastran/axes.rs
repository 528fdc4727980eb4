//! The plane of a model.

/// The plane of a model: the axes of its coordinates that are x and y of the body's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axes(pub [usize; 2]);

impl Axes {
    /// The axis across the plane.
    pub(super) fn normal(self) -> usize {
        3 - self.0[0] - self.0[1]
    }

    /// Direction of first axis × second axis along the third: ±1.
    pub(super) fn sign(self) -> f64 {
        if (self.0[1] + 3 - self.0[0]) % 3 == 1 { 1.0 } else { -1.0 }
    }

    pub(super) fn of<T: Copy>(self, triple: [T; 3]) -> [T; 2] {
        self.0.map(|axis| triple[axis])
    }

    /// Their names.
    pub fn name(self) -> String {
        self.0.map(|axis| ["x", "y", "z"][axis]).concat()
    }
}
