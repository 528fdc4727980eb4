//! The particles of the water, to be drawn or stored by the host.

use crate::border::guarded;
use crate::buffers;
use crate::element::{ELEMENTS, splashdown_element};
use crate::status::splashdown_status;

/// Number of the water's particles now.
///
/// Memory: `count` is NULL or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_particle_count(
    element: *const splashdown_element,
    count: *mut usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            // SAFETY: a number by the contract of the caller.
            unsafe { buffers::write_one("count", element.particle_count(), count) }
        })
    })
}

/// The water's particles now, in the order of their identity, which is the same at every instant: positions x, y [m], velocities
/// u, v [m/s], pressures p [Pa], spacings [m].
///
/// Each array has room for `length` values, at least splashdown_particle_count; one that is not wanted is NULL.
///
/// Memory: Arrays are NULL or of `length` writable values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_particles(
    element: *mut splashdown_element,
    x: *mut f64,
    y: *mut f64,
    u: *mut f64,
    v: *mut f64,
    p: *mut f64,
    spacing: *mut f64,
    length: usize,
) -> splashdown_status {
    guarded(|| {
        ELEMENTS.with(element, |element| {
            let shot = element.snapshot();
            buffers::expect_room("length of arrays of particles", length, shot.position.len())?;
            let arrays = [("x", x), ("y", y), ("u", u), ("v", v), ("p", p), ("spacing", spacing)];
            for (name, array) in arrays.into_iter().filter(|(_, array)| !array.is_null()) {
                buffers::expect(name, array)?;
            }
            let axis = |pairs: &[[f64; 2]], k: usize| pairs.iter().map(|pair| pair[k]).collect::<Vec<f64>>();
            // SAFETY: aligned, and of at least as many values by the contract of the caller.
            unsafe {
                buffers::write(&axis(&shot.position, 0), x);
                buffers::write(&axis(&shot.position, 1), y);
                buffers::write(&axis(&shot.velocity, 0), u);
                buffers::write(&axis(&shot.velocity, 1), v);
                buffers::write(&shot.pressure, p);
                buffers::write(&shot.spacing, spacing);
            }
            Ok(())
        })
    })
}
