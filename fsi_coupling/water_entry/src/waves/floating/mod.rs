//! A section in regular waves of small height: loads of waves, added mass, damping and motions, by linear potential theory (THEORY WA17).

mod contour;
#[cfg(test)]
mod tests;

use faer::c64;

use crate::boundary_element::{Buffer, Factorised};
use crate::waves::linear_wave::LinearWave;
use contour::{Panel, Part, contour, wet_part};

/// Directions x, y and angle, counter-clockwise about the centre of mass.
pub const DIRECTIONS: usize = 3;

/// The linear loads of regular waves on a section: potentials by straight panels of constant strength with Rankine sources and dipoles and
/// their images below the floor, outgoing waves at two ends (Wehausen & Laitone 1960; Yeung 1975).
///
/// ```
/// use water_entry::waves::floating::SectionInWaves;
/// use water_entry::waves::linear_wave::LinearWave;
/// let box_ = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.1], [-0.2, 0.1]];
/// let wave = LinearWave::of_period(1.0, 1.0, 9.81);
/// let section = SectionInWaves::new(&box_, [0.0, 0.0], wave, 1000.0, 9.81).expect("an outline through the surface");
/// assert!((section.reflected.powi(2) + section.transmitted.powi(2) - 1.0).abs() < 0.01);
/// ```
#[derive(Clone, Debug)]
pub struct SectionInWaves {
    /// Loads of waves of amplitude 1 m on the section held still, real and imaginary part of the factor of exp(iωt) [N/m², N/m].
    pub excitation: [[f64; 2]; DIRECTIONS],
    /// Added mass [kg/m, kg, kg m], by load and motion.
    pub added_mass: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Damping by waves [N s/m², N s/m, N s], by load and motion.
    pub damping: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Area below the still surface [m²].
    pub area: f64,
    /// x of the centre of that area less x of the centre of mass [m]: 0 at rest.
    pub lever: f64,
    /// Stiffness by weight and buoyancy of a section afloat [N/m², N/m, N].
    pub stiffness: [[f64; DIRECTIONS]; DIRECTIONS],
    /// Amplitudes of the waves that the section held still sends back, and lets pass, over those that arrive [-].
    pub reflected: f64,
    /// See `reflected`.
    pub transmitted: f64,
    /// Mean force along x on the section held still, over the squared amplitude [N/m³]: ¼ρg (1 + R² − T²)(1 + 2kd/sinh 2kd) (Maruo 1960).
    pub drift: f64,
    wave: LinearWave,
}

impl SectionInWaves {
    /// Of a counter-clockwise `outline` [m] about a `centre` of mass [m], y = 0 on the still surface; waves run to the right. `None` where the outline does
    /// not cross the surface just twice, reaches the floor, or is many wavelengths deep.
    pub fn new(
        outline: &[[f64; 2]],
        centre: [f64; 2],
        wave: LinearWave,
        density: f64,
        gravity: f64,
    ) -> Option<SectionInWaves> {
        let wet = wet_part(outline)?;
        if wet.iter().any(|p| p[1] <= -wave.depth) {
            return None;
        }
        let (panels, depth) = contour(&wet, wave.wave_number, wave.depth)?;
        let potentials = Potentials::solve(&panels, depth, centre, wave, gravity);
        let omega = wave.angular_frequency;
        let load = |phi: &dyn Fn(usize) -> c64, j: usize| {
            let wet = panels.iter().enumerate().filter(|(_, p)| p.part == Part::Section);
            wet.map(|(i, p)| phi(i) * (direction(p, centre)[j] * p.length)).sum::<c64>()
        };
        let phi = &potentials.phi;
        let excitation = [0, 1, 2].map(|j| {
            let all = |i: usize| phi[0][i] + potentials.incident(panels[i].middle)[0];
            let f = c64::new(0.0, -omega * density) * load(&all, j);
            [f.re, f.im]
        });
        let radiated = |j: usize, k: usize| load(&|i| phi[k + 1][i], j) * density;
        let table = |of: &dyn Fn(usize, usize) -> f64| [0, 1, 2].map(|j| [0, 1, 2].map(|k| of(j, k)));
        let [reflected, transmitted] = potentials.scattered(&panels);
        let (area, lever, stiffness) = hydrostatics(&wet, centre, density * gravity);
        Some(SectionInWaves {
            excitation,
            added_mass: table(&|j, k| radiated(j, k).re),
            damping: table(&|j, k| -omega * radiated(j, k).im),
            area,
            lever,
            stiffness,
            reflected,
            transmitted,
            drift: 0.25
                * density
                * gravity
                * (1.0 + reflected * reflected - transmitted * transmitted)
                * (1.0 + wave.shallowness()),
            wave,
        })
    }

    /// Amplitudes of the motion in waves of amplitude 1 m of a section with a mass [kg/m] and a moment of inertia about its centre [kg m], that is `free`
    /// in some directions, with more stiffness and damping than the water's: [−ω²(M + A) + iω(B + B') + C + C'] ξ = X [-, -, rad/m].
    pub fn motion(
        &self,
        [mass, inertia]: [f64; 2],
        free: [bool; DIRECTIONS],
        more_stiffness: [[f64; DIRECTIONS]; DIRECTIONS],
        more_damping: [[f64; DIRECTIONS]; DIRECTIONS],
    ) -> [f64; DIRECTIONS] {
        let omega = self.wave.angular_frequency;
        let masses = [mass, mass, inertia];
        let size = 2 * DIRECTIONS;
        let (mut rows, mut right) = (Buffer::zeros(size * size), [0.0; 2 * DIRECTIONS]);
        for j in 0..DIRECTIONS {
            if !free[j] {
                (0..2).for_each(|part| rows[(2 * j + part) * (size + 1)] = 1.0);
                continue;
            }
            for k in (0..DIRECTIONS).filter(|k| free[*k]) {
                let own = if j == k { masses[j] } else { 0.0 };
                let z = c64::new(
                    self.stiffness[j][k] + more_stiffness[j][k] - omega * omega * (own + self.added_mass[j][k]),
                    omega * (self.damping[j][k] + more_damping[j][k]),
                );
                put(&mut rows, size, [j, k], z);
            }
            [right[2 * j], right[2 * j + 1]] = self.excitation[j];
        }
        Factorised::new(rows, size).solve(&mut right);
        [0, 1, 2].map(|j| right[2 * j].hypot(right[2 * j + 1]))
    }
}

/// Add a complex factor to a matrix of real equations: unknown k, real part then imaginary part, in equation j.
fn put(rows: &mut [f64], size: usize, [j, k]: [usize; 2], z: c64) {
    let at = |row: usize, column: usize| (2 * j + row) * size + 2 * k + column;
    rows[at(0, 0)] += z.re;
    rows[at(0, 1)] -= z.im;
    rows[at(1, 0)] += z.im;
    rows[at(1, 1)] += z.re;
}

/// Normal velocity of a panel for a unit velocity in each direction [-, -, m].
fn direction(panel: &Panel, centre: [f64; 2]) -> [f64; DIRECTIONS] {
    let ([nx, ny], arm) = (panel.normal, [panel.middle[0] - centre[0], panel.middle[1] - centre[1]]);
    [nx, ny, arm[0] * ny - arm[1] * nx]
}

/// The area below the surface [m²], the lever of its centre [m]; ρg times the waterline's breadth, first and second moment, with the moment of buoyancy and weight.
fn hydrostatics(wet: &[[f64; 2]], centre: [f64; 2], weight: f64) -> (f64, f64, [[f64; DIRECTIONS]; DIRECTIONS]) {
    let (right, left) = (wet[0][0] - centre[0], wet[wet.len() - 1][0] - centre[0]);
    // area and moment of the submerged part, about the surface, by trapezoids of the wet line from right to left
    let (mut area, mut moment, mut across) = (0.0, 0.0, 0.0);
    for p in wet.windows(2) {
        let (dx, [y0, y1]) = (p[0][0] - p[1][0], [p[0][1], p[1][1]]);
        area -= 0.5 * dx * (y0 + y1);
        across -= dx * (p[0][0] * (2.0 * y0 + y1) + p[1][0] * (y0 + 2.0 * y1)) / 6.0;
        moment -= dx * (y0 * y0 + y0 * y1 + y1 * y1) / 6.0;
    }
    let righting = (right.powi(3) - left.powi(3)) / 3.0 + moment - area * centre[1];
    let first = 0.5 * (right * right - left * left);
    let of = [[0.0; 3], [0.0, weight * (right - left), weight * first], [0.0, weight * first, weight * righting]];
    (area, across / area - centre[0], of)
}

/// The scattered potential of waves of amplitude 1 m and the potentials of unit velocities, on the panels [m²/s, m, m, m²].
struct Potentials {
    phi: [Vec<c64>; DIRECTIONS + 1],
    depth: f64,
    wave: LinearWave,
    /// g/ω/cosh kd [m/s].
    strength: f64,
}

impl Potentials {
    /// Green's third identity with the outward normal: π φ_i = Σ_j φ_j ∫ ∂ln r/∂n ds − ∂φ_j/∂n ∫ ln r ds, images below the floor; ∂φ/∂n = ω²/g φ on
    /// the surface and −ik φ at the ends.
    fn solve(panels: &[Panel], depth: f64, centre: [f64; 2], wave: LinearWave, gravity: f64) -> Potentials {
        let n = panels.len();
        let strength = gravity / wave.angular_frequency / (wave.wave_number * depth).cosh();
        let mut potentials = Potentials { phi: Default::default(), depth, wave, strength };
        let (rise, k) = (wave.angular_frequency.powi(2) / gravity, wave.wave_number);
        let size = 2 * n;
        let (mut rows, mut right) = (Buffer::zeros(size * size), [0; DIRECTIONS + 1].map(|_| vec![0.0; size]));
        let velocities: Vec<[c64; DIRECTIONS + 1]> = panels
            .iter()
            .map(|p| {
                let [_, u, v] = potentials.incident(p.middle);
                let [x, y, angle] = direction(p, centre).map(|d| c64::new(d, 0.0));
                [-(u * p.normal[0] + v * p.normal[1]), x, y, angle]
            })
            .collect();
        for (i, at) in panels.iter().map(|p| p.middle).enumerate() {
            for (j, panel) in panels.iter().enumerate() {
                let (own, image) = (influence(panel, at), influence(panel, [at[0], -2.0 * depth - at[1]]));
                let (source, dipole) = (own[0] + image[0], if i == j { 0.0 } else { own[1] } + image[1]);
                let factor = match panel.part {
                    Part::Surface => c64::new(dipole - rise * source, 0.0),
                    Part::End => c64::new(dipole, k * source),
                    Part::Section => {
                        for (right, q) in right.iter_mut().zip(velocities[j]) {
                            right[2 * i] += source * q.re;
                            right[2 * i + 1] += source * q.im;
                        }
                        c64::new(dipole, 0.0)
                    }
                };
                let own = if i == j { std::f64::consts::PI } else { 0.0 };
                put(&mut rows, size, [i, j], factor - own);
            }
        }
        let factorised = Factorised::new(rows, size);
        potentials.phi = right.map(|mut right| {
            factorised.solve(&mut right);
            right.chunks(2).map(|part| c64::new(part[0], part[1])).collect()
        });
        potentials
    }

    /// Incident potential [m²/s] and velocity [m/s] of waves of amplitude 1 m: ig/ω cosh k(y + d)/cosh kd exp(−ikx).
    fn incident(&self, [x, y]: [f64; 2]) -> [c64; 3] {
        let (k, z) = (self.wave.wave_number, self.wave.wave_number * (y + self.depth));
        let phase = c64::new((k * x).cos(), -(k * x).sin()) * self.strength;
        let i = c64::new(0.0, 1.0);
        [i * phase * z.cosh(), phase * (k * z.cosh()), i * phase * (k * z.sinh())]
    }

    /// Amplitudes of the waves sent back and let pass, from the scattered wave at the middles of the outer halves of the surface.
    fn scattered(&self, panels: &[Panel]) -> [f64; 2] {
        let k = self.wave.wave_number;
        // η = −iω/g φ; g/ω = strength cosh kd
        let per = c64::new(0.0, -1.0 / (self.strength * (k * self.depth).cosh()));
        let surface = |side: f64| {
            let of_side =
                panels.iter().enumerate().filter(move |(_, p)| p.part == Part::Surface && side * p.middle[0] > 0.0);
            let far = of_side.clone().map(|(_, p)| side * p.middle[0]).fold(0.0, f64::max);
            let mut count = 0.0;
            let outgoing = of_side.filter(|(_, p)| (0.4..0.9).contains(&(side * p.middle[0] / far))).map(|(i, p)| {
                count += 1.0;
                let (sin, cos) = (k * p.middle[0]).sin_cos();
                self.phi[0][i] * c64::new(cos, side * sin)
            });
            let sum: c64 = outgoing.sum();
            per * sum / count
        };
        [surface(-1.0).norm(), (surface(1.0) + 1.0).norm()]
    }
}

/// ∫ ln r ds and ∫ ∂ln r/∂n ds over a panel from a point [m, -].
fn influence(panel: &Panel, at: [f64; 2]) -> [f64; 2] {
    let [dx, dy] = [at[0] - panel.ends[0][0], at[1] - panel.ends[0][1]];
    let along = dx * panel.tangent[0] + dy * panel.tangent[1];
    let off = -(dx * panel.normal[0] + dy * panel.normal[1]);
    let (a, b) = (-along, panel.length - along);
    let log = |s: f64| if s == 0.0 && off == 0.0 { 0.0 } else { s * s.hypot(off).ln() };
    let angle = off.signum() * (b.atan2(off.abs()) - a.atan2(off.abs()));
    let angle = if off == 0.0 { 0.0 } else { angle };
    [log(b) - log(a) - panel.length + off * angle, angle]
}
