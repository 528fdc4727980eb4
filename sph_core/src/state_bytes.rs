//! State as bytes, to continue a run in another process to the same bits.
//!
//! Numbers keep their bits, those that are not finite too. The bytes hold what a step changes; everything else is rebuilt from the
//! same input. They carry no names: a reader of other types finds other numbers, so a file of them needs a version and a checksum.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Why bytes are not the state of this system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// The bytes end early, are too many, or hold what no such state has.
    #[error("the state of {0} cannot be read: {1}")]
    Unreadable(&'static str, String),
    /// A number of items that does not fit.
    #[error("the state has {found} {what}, expected {expected}")]
    Count {
        /// The items.
        what: &'static str,
        /// How many the bytes hold.
        found: usize,
        /// How many the system has.
        expected: usize,
    },
}

/// A state as bytes.
pub fn encode<T: Serialize>(state: &T) -> Vec<u8> {
    postcard::to_allocvec(state).expect("a state of numbers, vectors and options has bytes")
}

/// The state that bytes hold, all of them; `of` names its owner in errors.
pub fn decode<T: DeserializeOwned>(of: &'static str, bytes: &[u8]) -> Result<T, StateError> {
    let wrong = |cause: postcard::Error| StateError::Unreadable(of, cause.to_string());
    let (state, rest) = postcard::take_from_bytes(bytes).map_err(wrong)?;
    if rest.is_empty() {
        return Ok(state);
    }
    Err(StateError::Unreadable(of, format!("{} bytes are left over", rest.len())))
}

/// An error unless `found` of `what` are the `expected` ones.
pub fn expect_count(what: &'static str, found: usize, expected: usize) -> Result<(), StateError> {
    if found == expected { Ok(()) } else { Err(StateError::Count { what, found, expected }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planes::Periodic;
    use crate::{Domain, Fluid, SchemeSettings, Seed, Walls, projection, wcsph};

    #[test]
    fn numbers_keep_their_bits() {
        let signal = f64::from_bits(0x7ff8_0000_dead_beef);
        let state = (vec![-0.0, f64::INFINITY, signal, 1e-310], vec![[1.5f32; 2]; 2], Some(u64::MAX), [true, false]);
        type State = (Vec<f64>, Vec<[f32; 2]>, Option<u64>, [bool; 2]);
        let back: State = decode("a test", &encode(&state)).expect("its own bytes");
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
        assert_eq!(bits(&back.0), bits(&state.0));
        assert_eq!((back.1, back.2, back.3), (state.1, state.2, state.3));
    }

    /// Water between periodic planes, stored when its lists are some steps old, goes on as it did; by each scheme.
    #[test]
    fn a_fluid_continues_from_bytes_to_the_same_bits() {
        let seed = |k: usize| {
            let (x, y) = (0.05 + 0.1 * (k % 20) as f64, 0.05 + 0.1 * (k / 20) as f64);
            let (a, b) = (std::f64::consts::PI * x, std::f64::consts::PI * y);
            Seed { at: [x, y], velocity: [a.sin() * b.cos(), -a.cos() * b.sin()], area: 0.01, pressure: 0.0 }
        };
        let seeds: Vec<Seed> = (0..400).map(seed).collect();
        let periodic = Some(Periodic { x: Some([0.0, 2.0]), y: Some([0.0, 2.0]) });
        let schemes: [&dyn SchemeSettings; 2] = [&wcsph::Settings::default(), &projection::Settings::default()];
        for settings in schemes {
            let mut walls = Walls::default();
            let mut begun = || {
                let mut fluid = Fluid::new(Domain { periodic, ..Domain::default() }, settings, &seeds);
                fluid.initialise(&mut walls).expect("water");
                fluid
            };
            let (mut one, mut other) = (begun(), begun());
            let step = |fluid: &mut Fluid| {
                let dt = fluid.stable_dt(&Walls::default()).expect("a stable step");
                fluid.step(&mut Walls::default(), dt).expect("a step");
            };
            (0..30).for_each(|_| step(&mut one));
            other.restore_bytes(&one.to_bytes()).expect("its own bytes");
            for fluid in [&mut one, &mut other] {
                (0..30).for_each(|_| step(fluid));
            }
            assert_eq!(one.particles(), other.particles());
            assert_eq!((one.steps(), one.time(), one.updates()), (60, other.time(), other.updates()));
            assert!(one.neighbours().rebuilds > 2, "{}", one.neighbours().rebuilds);
            let fewer = Fluid::new(Domain::default(), settings, &seeds[..4]).to_bytes();
            assert!(other.restore_bytes(&fewer[..fewer.len() - 1]).is_err());
        }
    }

    /// A length that no memory holds is refused, as is what is cut short or too long.
    #[test]
    fn foreign_bytes_are_refused() {
        let bytes = encode(&vec![1.0, 2.0]);
        for cut in 0..bytes.len() {
            assert!(decode::<Vec<f64>>("a test", &bytes[..cut]).is_err(), "{cut}");
        }
        let longer = [&bytes[..], &[0]].concat();
        let said = decode::<Vec<f64>>("a test", &longer).expect_err("a byte too many").to_string();
        assert_eq!(said, "the state of a test cannot be read: 1 bytes are left over");
        assert!(decode::<Vec<f64>>("a test", &[255, 255, 255, 255, 255, 255, 255, 255, 127, 0]).is_err());
    }
}
