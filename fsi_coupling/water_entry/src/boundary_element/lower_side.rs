//! The lower side of the water next to the jet: the face, and past a wet chine the surface that has left it (THEORY EN22, EN24).

use std::f64::consts::PI;

use faer::c64;

use super::elements::Sizes;
use super::face::{Face, Place};

/// Element next to the jet, over Wagner's thickness of the jet c tan²β/(2π).
const FINEST: f64 = 0.35;
/// Largest thickness that counts, over c.
const THICKEST: f64 = 0.08;
/// Least element next to the jet past a wet chine, over the thickness of its cut: the jet grows thicker there than on the face.
const OF_CUT: f64 = 0.4;

/// The face, and the surface that left the chine where it is wet, from the jet's cut to the chine.
#[derive(Clone, Copy)]
pub(super) struct LowerSide<'a> {
    pub face: &'a Face,
    pub underside: Option<&'a [c64]>,
    pub sizes: Sizes,
}

/// The point of the lower side that is nearest to one in the water.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    pub foot: c64,
    /// Unit vector outwards along the lower side.
    pub tangent: c64,
    /// Distance [m].
    pub away: f64,
}

/// The nearest to `z` on a straight piece; `away` is the square of its distance.
fn on_piece(z: c64, from: c64, tangent: c64, longest: f64) -> Nearest {
    let along = ((z - from) * tangent.conj()).re.max(0.0).min(longest);
    let foot = from + tangent * along;
    Nearest { foot, tangent, away: (z - foot).norm_sqr() }
}

impl LowerSide<'_> {
    /// The point nearest to `z`; the lower side goes on straight beyond its end.
    pub fn nearest(&self, z: c64) -> Nearest {
        let Place { z: foot, tangent, .. } = self.face.nearest(z, self.underside.is_none());
        let on_face = Nearest { foot, tangent, away: (z - foot).norm_sqr() };
        let pieces = self.underside.unwrap_or_default().windows(2).enumerate().map(|(k, ends)| {
            let piece = ends[0] - ends[1];
            let length = piece.norm_sqr().sqrt();
            on_piece(z, ends[1], piece / length, if k == 0 { f64::INFINITY } else { length })
        });
        let nearer = |best: Nearest, here: Nearest| if here.away < best.away { here } else { best };
        let nearest = pieces.fold(on_face, nearer);
        Nearest { away: nearest.away.sqrt(), ..nearest }
    }

    /// What is added to the growth of elements far from the jet.
    pub fn growth_far(&self) -> f64 {
        if self.underside.is_some() { 0.0 } else { self.sizes.far }
    }

    /// Size of the elements next to the jet's end [m].
    pub fn finest(&self, end: c64) -> f64 {
        let Nearest { foot, away, .. } = self.nearest(end);
        let along = self.face.nearest(end, true).along;
        let thickness = (self.face.equivalent_angle(along).tan().powi(2) / (2.0 * PI)).min(THICKEST);
        let on_face = FINEST * foot.re * thickness;
        self.sizes.jet * if self.underside.is_some() { on_face.max(OF_CUT * away) } else { on_face }
    }
}
