//! Where an aeroplane is and how it moves.

/// Bending modes of the fuselage that a landing has room for.
pub const MODES: usize = 4;
/// Struts of an aeroplane, at most: kinds of struts, each of several side by side.
pub const STRUTS: usize = 4;
/// Degrees of freedom: forward, up, pitch, bending modes.
pub const FREEDOMS: usize = 3 + MODES;

/// Where the aeroplane is and how it moves: centre of mass, pitch nose up, bending, and their rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attitude {
    /// Forward and up from a point of the still surface [m], pitch [rad].
    pub place: [f64; 3],
    /// Their rates [m/s, m/s, rad/s].
    pub rate: [f64; 3],
    /// Amplitudes of the bending modes [m].
    pub bend: [f64; MODES],
    /// Their rates [m/s].
    pub bend_rate: [f64; MODES],
    /// Strokes of the struts [m].
    pub stroke: [f64; STRUTS],
    /// Their rates [m/s].
    pub stroke_rate: [f64; STRUTS],
}

impl Attitude {
    /// Forward and up of a place [m], at x from the nose and z over the body axis; `centre` is that of mass, likewise.
    pub fn of_point(&self, centre: [f64; 2], [x, z]: [f64; 2]) -> [f64; 2] {
        let ((sin, cos), ahead, above) = (self.place[2].sin_cos(), centre[0] - x, z - centre[1]);
        [self.place[0] + ahead * cos - above * sin, self.place[1] + ahead * sin + above * cos]
    }

    /// Velocity of such a place forward and up [m/s], without bending.
    pub fn velocity_of(&self, centre: [f64; 2], at: [f64; 2]) -> [f64; 2] {
        let ([px, pz], [u, w, q]) = (self.of_point(centre, at), self.rate);
        [u - q * (pz - self.place[1]), w + q * (px - self.place[0])]
    }
}
