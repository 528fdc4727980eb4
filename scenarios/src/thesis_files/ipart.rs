//! IPART: a line per particle.

use std::fmt::Write;

use super::indat::short;
use super::{ThesisFileError, number, wrong};

/// A particle: position [m], velocity [m/s], pressure [Pa], density [kg/m³], temperature [K], speed of sound [m/s].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Particle {
    /// Position x, y, z [m].
    pub position: [f64; 3],
    /// Velocity x, y, z [m/s].
    pub velocity: [f64; 3],
    /// Pressure [Pa], density [kg/m³], temperature [K], speed of sound [m/s].
    pub state: [f64; 4],
}

/// The particles of IPART.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ipart {
    /// In the order of the file.
    pub particles: Vec<Particle>,
}

impl Ipart {
    /// Reads lines of ten numbers, or of eight without z. Text behind ! or # is a comment.
    ///
    /// # Errors
    /// The first line that cannot be used.
    pub fn parse(file: &str, text: &str) -> Result<Ipart, ThesisFileError> {
        let mut particles = Vec::new();
        for (k, line) in text.lines().enumerate() {
            let bare = line.split(['!', '#']).next().unwrap_or_default();
            let words: Vec<&str> = bare.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty()).collect();
            let mut values = Vec::with_capacity(10);
            for word in &words {
                values.push(number(word).ok_or_else(|| wrong(file, k + 1, short(word), "a finite number"))?);
            }
            particles.push(match values[..] {
                [] => continue,
                [x, y, z, u, v, w, p, rho, t, c] => {
                    Particle { position: [x, y, z], velocity: [u, v, w], state: [p, rho, t, c] }
                }
                [x, y, u, v, p, rho, t, c] => {
                    Particle { position: [x, y, 0.0], velocity: [u, v, 0.0], state: [p, rho, t, c] }
                }
                _ => {
                    let expected =
                        "ten: position x y z, velocity x y z, pressure, density, temperature, sound velocity";
                    return Err(wrong(file, k + 1, format!("{} numbers", values.len()), expected));
                }
            });
        }
        Ok(Ipart { particles })
    }

    /// The text of the file.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for Particle { position, velocity, state } in &self.particles {
            let numbers: Vec<String> =
                position.iter().chain(velocity).chain(state).map(|value| format!("{value:e}")).collect();
            let _ = writeln!(text, "{}", numbers.join(" "));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_written_again_to_the_same_text() {
        let particle =
            Particle { position: [0.1, -0.2, 0.0], velocity: [1e-9, 3.0, 0.0], state: [981.0, 1e3, 0.0, 44.3] };
        let ipart = Ipart { particles: vec![particle; 3] };
        let text = ipart.to_text();
        let again = Ipart::parse("IPART", &text).expect("our own text");
        assert_eq!((&again, again.to_text()), (&ipart, text));
        assert_eq!(Ipart::parse("IPART", "0 1 0 0 5 1000 0 20\n").expect("two dimensions").particles.len(), 1);
        let error = Ipart::parse("IPART", "! one\n0 1 2\n").expect_err("three numbers");
        assert!(error.at.line == 2 && error.given == "3 numbers", "{error}");
        assert!(Ipart::parse("IPART", "0 1 2 x\n").is_err());
    }
}
