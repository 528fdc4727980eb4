//! A particle as its neighbours read it: one cache line.

use crate::neighbours::lists::Splat;
use crate::simd::SimdReal;

/// A particle as its neighbours see it: one cache line. For a wall particle, velocity and pressure are
/// those that the fluid is to feel (THEORY WA3–WA5) and both volumes are the area it stands for.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct PackedParticle<R = f64> {
    /// Position [m].
    pub x: R,
    /// Position [m].
    pub y: R,
    /// Velocity [m/s].
    pub u: R,
    /// Velocity [m/s].
    pub v: R,
    /// Pressure [Pa].
    pub p: R,
    /// Volume V [m²]: m/ρ, or the volume that the scheme keeps.
    pub volume: R,
    /// m/ρ [m²].
    pub raw_volume: R,
    /// Smoothing length [m].
    pub h: R,
}

/// A wall particle in the continuity equation: where it is, which way it faces, how fast it comes.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, Default)]
pub struct PackedWall<R = f64> {
    /// Position [m].
    pub x: R,
    /// Position [m].
    pub y: R,
    /// Unit normal into the fluid [-].
    pub nx: R,
    /// Unit normal into the fluid [-].
    pub ny: R,
    /// Velocity of the wall along the normal V·n [m/s].
    pub vn: R,
    /// Velocity of the fluid nearby along the tangent t = (−n_y, n_x), ũ·t [m/s].
    pub vt: R,
    /// Area it stands for [m²].
    pub volume: R,
    /// Smoothing length [m].
    pub h: R,
}

impl PackedParticle {
    /// The targets from `first` on, side by side; beyond the last one, the last one again.
    #[inline(always)]
    pub(crate) fn targets<R: SimdReal>(rows: &[PackedParticle], first: usize, zero: R) -> PackedParticle<R> {
        let of = |field: fn(&PackedParticle) -> f64| zero.each(|k| field(&rows[(first + k).min(rows.len() - 1)]));
        PackedParticle {
            x: of(|r| r.x),
            y: of(|r| r.y),
            u: of(|r| r.u),
            v: of(|r| r.v),
            p: of(|r| r.p),
            volume: of(|r| r.volume),
            raw_volume: of(|r| r.raw_volume),
            h: of(|r| r.h),
        }
    }
}

impl Splat for PackedParticle {
    type Over<R: SimdReal> = PackedParticle<R>;
    #[inline(always)]
    fn splat<R: SimdReal>(&self, zero: R) -> PackedParticle<R> {
        PackedParticle {
            x: zero.of(self.x),
            y: zero.of(self.y),
            u: zero.of(self.u),
            v: zero.of(self.v),
            p: zero.of(self.p),
            volume: zero.of(self.volume),
            raw_volume: zero.of(self.raw_volume),
            h: zero.of(self.h),
        }
    }
    #[inline(always)]
    fn mask<R: SimdReal>(over: PackedParticle<R>, bits: u32) -> PackedParticle<R> {
        PackedParticle { volume: over.volume.mask(bits), raw_volume: over.raw_volume.mask(bits), ..over }
    }
}

impl Splat for PackedWall {
    type Over<R: SimdReal> = PackedWall<R>;
    #[inline(always)]
    fn splat<R: SimdReal>(&self, zero: R) -> PackedWall<R> {
        PackedWall {
            x: zero.of(self.x),
            y: zero.of(self.y),
            nx: zero.of(self.nx),
            ny: zero.of(self.ny),
            vn: zero.of(self.vn),
            vt: zero.of(self.vt),
            volume: zero.of(self.volume),
            h: zero.of(self.h),
        }
    }
    #[inline(always)]
    fn mask<R: SimdReal>(over: PackedWall<R>, bits: u32) -> PackedWall<R> {
        PackedWall { volume: over.volume.mask(bits), ..over }
    }
}
