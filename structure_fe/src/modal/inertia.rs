//! Inertia of a modal structure: integrals of its shapes over its mass (THEORY BE28; Shabana 2020, ch. 5).

use faer::Mat;

use super::mode::{Frame, ModalMode, ModalState, turned};

/// Sums over the masses of frame and nodes, in the frame's axes; p × r is p_x r_y − p_y r_x.
#[derive(Clone, Debug)]
pub(super) struct ShapeIntegrals {
    /// Σ m \[kg/m\].
    pub mass: f64,
    /// Σ m x.
    first_moment: [f64; 2],
    /// Σ m x·x, and the frame's inertia.
    second_moment: f64,
    /// Of each mode Σ m φ.
    momentum: Vec<[f64; 2]>,
    /// Of each mode Σ m x·φ and Σ m x × φ.
    with_place: Vec<[f64; 2]>,
    /// Of two modes Σ m φ_i·φ_j and Σ m φ_i × φ_j.
    with_shape: Vec<Vec<[f64; 2]>>,
}

fn products(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]]
}

fn added(a: [f64; 2], factor: f64, b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| a[k] + factor * b[k])
}

impl ShapeIntegrals {
    pub fn new(frame: &Frame, nodes: &[[f64; 2]], masses: &[f64], modes: &[ModalMode]) -> ShapeIntegrals {
        let over_nodes = |of: &dyn Fn(usize) -> [f64; 2]| {
            masses.iter().enumerate().fold([0.0; 2], |sum, (k, mass)| added(sum, *mass, of(k)))
        };
        let moves = |mode: &ModalMode, k: usize| [mode.shape[k][0], mode.shape[k][1]];
        let com = frame.center_of_mass;
        ShapeIntegrals {
            mass: frame.mass + masses.iter().sum::<f64>(),
            first_moment: added(over_nodes(&|k| nodes[k]), frame.mass, com),
            second_moment: over_nodes(&|k| products(nodes[k], nodes[k]))[0]
                + frame.mass * products(com, com)[0]
                + frame.inertia,
            momentum: modes.iter().map(|mode| over_nodes(&|k| moves(mode, k))).collect(),
            with_place: modes.iter().map(|mode| over_nodes(&|k| products(nodes[k], moves(mode, k)))).collect(),
            with_shape: modes
                .iter()
                .map(|a| modes.iter().map(|b| over_nodes(&|k| products(moves(a, k), moves(b, k)))).collect())
                .collect(),
        }
    }

    /// Σ m (x + u).
    pub fn first_moment(&self, amplitude: &[f64]) -> [f64; 2] {
        self.momentum.iter().zip(amplitude).fold(self.first_moment, |sum, (p, q)| added(sum, *q, *p))
    }

    /// Σ m (x + u)·φ_j and Σ m (x + u) × φ_j.
    fn with_place(&self, j: usize, amplitude: &[f64]) -> [f64; 2] {
        let shapes = self.with_shape.iter().zip(amplitude);
        shapes.fold(self.with_place[j], |sum, (of, q)| added(sum, *q, of[j]))
    }

    /// Σ m (x + u)·(x + u), and the frame's inertia.
    fn second_moment(&self, amplitude: &[f64]) -> f64 {
        let of_modes = (0..amplitude.len())
            .map(|j| amplitude[j] * (self.with_place[j][0] + self.with_place(j, amplitude)[0]))
            .sum::<f64>();
        self.second_moment + of_modes
    }

    /// BE28: mass matrix of x, y, rotation and amplitudes.
    pub fn mass_matrix(&self, modes: &[ModalMode], state: &ModalState) -> Mat<f64> {
        let (n, angle) = (3 + modes.len(), state.frame[2]);
        let mut matrix = Mat::zeros(n, n);
        let mut set = |i: usize, j: usize, value: f64| (matrix[(i, j)], matrix[(j, i)]) = (value, value);
        let [sx, sy] = turned(self.first_moment(&state.amplitude), angle);
        set(0, 0, self.mass);
        set(1, 1, self.mass);
        set(0, 2, -sy);
        set(1, 2, sx);
        set(2, 2, self.second_moment(&state.amplitude));
        for (j, mode) in modes.iter().enumerate() {
            let [px, py] = turned(self.momentum[j], angle);
            set(0, 3 + j, px);
            set(1, 3 + j, py);
            set(2, 3 + j, self.with_place(j, &state.amplitude)[1]);
            set(3 + j, 3 + j, mode.mass);
        }
        matrix
    }

    /// BE28: the generalised weight.
    pub fn weight(&self, state: &ModalState, [gx, gy]: [f64; 2]) -> Vec<f64> {
        let angle = state.frame[2];
        let [sx, sy] = turned(self.first_moment(&state.amplitude), angle);
        let of_modes = self.momentum.iter().map(|p| {
            let [px, py] = turned(*p, angle);
            px * gx + py * gy
        });
        [self.mass * gx, self.mass * gy, sx * gy - sy * gx].into_iter().chain(of_modes).collect()
    }

    /// BE28: centripetal and Coriolis forces of a frame that turns.
    pub fn convective_forces(&self, state: &ModalState) -> Vec<f64> {
        let (spin, rates) = (state.velocity[2], &state.velocity[3..]);
        let from_frame = |v: [f64; 2]| turned(v, state.frame[2]);
        let [sx, sy] = from_frame(self.first_moment(&state.amplitude));
        let moving = self.momentum.iter().zip(rates).fold([0.0; 2], |sum, (p, rate)| added(sum, *rate, *p));
        let [px, py] = from_frame(moving);
        let outwards: Vec<f64> = (0..rates.len()).map(|j| self.with_place(j, &state.amplitude)[0]).collect();
        let turning: f64 = outwards.iter().zip(rates).map(|(out, rate)| out * rate).sum();
        let of_mode = |j: usize| {
            let coriolis: f64 = self.with_shape.iter().zip(rates).map(|(of, rate)| of[j][1] * rate).sum();
            spin * spin * outwards[j] - 2.0 * spin * coriolis
        };
        let rigid = [spin * spin * sx + 2.0 * spin * py, spin * spin * sy - 2.0 * spin * px, -2.0 * spin * turning];
        rigid.into_iter().chain((0..rates.len()).map(of_mode)).collect()
    }
}
