//! The right half of the body's bottom: straight lines and arcs of circles from the keel to the chine.

use faer::c64;

use super::super::curve::{Piece, arcs, placed};
use super::super::section::Section;
use super::deflection::Deflection;

/// Places at which the angle of the bottom is read for the thickness of the jet.
const PLACES: usize = 16;
/// Length of a face that the rounding of its knuckle takes, over the knuckle's distance from the keel [-].
const ROUNDED: f64 = 0.05;
/// Elements on a rounded knuckle.
const ON_KNUCKLE: f64 = 6.0;
/// A turn that is none [rad].
const SMOOTH: f64 = 1e-6;
/// Turn of a rounded knuckle from which elements on it are smaller [rad].
const SHARP: f64 = 3.0 * std::f64::consts::PI / 180.0;
/// Repetitions of the search for the nearest place of a bent bottom.
const UNBENT: usize = 3;
/// Largest speed of an added keel over that of the bottom: under a flat keel it would begin without bound [-].
const FASTEST: f64 = 1.7;

/// A bottom at rest in its own axes, whose keel is at −i draught.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pieces: Vec<Piece>,
    /// Draught of the keel below still water [m].
    pub draught: f64,
    /// Distance from the keel at which the flow leaves it [m]; infinite where that is the chine.
    left_at: f64,
    /// What the keel adds to a round bottom.
    added: Option<Added>,
    /// How it is bent; `None` for a rigid one.
    bent: Option<Box<Deflection>>,
}

/// A keel that was added to a round bottom.
#[derive(Clone, Debug)]
struct Added {
    to: Rounded,
    /// Half width of the keel [m].
    least: f64,
    /// Half width from which the wetted width grows as without the keel [m].
    from: f64,
}

/// What it was added to.
#[derive(Clone, Debug)]
enum Rounded {
    /// An arc of a circle of a radius [m]; area of the keel on one side [m²].
    Arc { area: f64, radius: f64 },
    /// A curve, without and with the keel.
    Curve(Box<[Section; 2]>),
}

/// A place on the bottom, or on the straight line that goes on from its chine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Distance from the keel along the bottom [m].
    pub along: f64,
    pub z: c64,
    /// Unit vector outwards.
    pub tangent: c64,
}

impl Face {
    /// A straight face at the angle β to the water, `length` [m] long.
    pub fn straight(beta: f64, length: f64) -> Face {
        Face::of(c64::ZERO, c64::new(beta.cos(), beta.sin()), length)
    }

    /// An arc of a circle, `end` [rad] long, whose lowest part is replaced by its tangents at the angle `keel` [rad].
    pub fn arc(radius: f64, end: f64, keel: f64) -> Face {
        let tangent = Face::straight(keel, radius * keel.tan());
        let Place { z: from, tangent: direction, along: at } = tangent.place(tangent.length());
        let arc = Piece {
            at,
            from,
            direction,
            angle: direction.arg(),
            curvature: 1.0 / radius,
            length: radius * (end - keel),
            round: true,
        };
        let to = Rounded::Arc { area: 0.5 * radius * radius * (keel.tan() - keel), radius };
        let least = radius * keel.sin();
        let added = Added { to, least, from: least };
        Face::rigid(vec![tangent.pieces[0], arc], Some(added))
    }

    /// A bottom with curves, whose knuckles are rounded (THEORY EN39), as far as the flow follows it; the lowest part of a blunt one is replaced by
    /// its tangents at the angle `keel` [rad], or by lines at that angle from the knuckle at which it gets steeper.
    pub fn curved(section: &Section, keel: f64) -> Face {
        let mut line: Vec<Piece> = section.followed_line();
        let mut added = None;
        if section.is_blunt() {
            // a straight face is touched where it begins
            let reaches = |p: &Piece| p.last_angle() > if p.curvature == 0.0 { keel - SMOOTH } else { keel };
            let first = line.iter().position(reaches).unwrap_or(line.len() - 1);
            let piece = line[first];
            let turned = if piece.angle < keel - SMOOTH { (keel - piece.angle) / piece.curvature } else { 0.0 };
            line[first] = piece.part(turned, piece.length);
            let touched = line[first].from;
            let lowest = c64::new(0.0, touched.im - touched.re * keel.tan());
            line.splice(..first, [Piece::straight(lowest, touched)]);
            line.iter_mut().for_each(|piece| piece.from -= lowest);
            added = Some(Added::to(section, touched.re, keel));
        }
        Face::rigid(rounded(&placed(line)), added)
    }

    /// Half width of the keel that was added [m]; 0 without one.
    pub fn keel_half_width(&self) -> f64 {
        self.added.as_ref().map_or(0.0, |added| added.least)
    }

    /// A polygon through `corners` from the keel to the chine [m], whose knuckles are rounded (THEORY EN39).
    pub fn polygon(corners: &[[f64; 2]]) -> Face {
        let points: Vec<c64> = corners.iter().map(|[x, y]| c64::new(x - corners[0][0], y - corners[0][1])).collect();
        let line = points.windows(2).map(|ends| Piece::straight(ends[0], ends[1])).collect();
        Face::rigid(rounded(&placed(line)), None)
    }

    fn of(from: c64, direction: c64, length: f64) -> Face {
        let piece = Piece { at: 0.0, from, direction, angle: direction.arg(), curvature: 0.0, length, round: false };
        Face::rigid(vec![piece], None)
    }

    fn rigid(pieces: Vec<Piece>, added: Option<Added>) -> Face {
        Face { pieces, draught: 0.0, left_at: f64::INFINITY, added, bent: None }
    }

    /// The same bottom whose flow leaves it at a distance from the keel [m], at its chine at the latest.
    pub fn left_at(&self, along: f64) -> Face {
        Face { left_at: along.min(self.whole_length()), ..self.clone() }
    }

    /// Is it round at a distance from the keel [m]? A rounded knuckle is not.
    pub fn is_round(&self, along: f64) -> bool {
        let curved = |piece: &Piece| piece.at < along && along <= piece.at + piece.length && piece.curvature > 0.0;
        self.pieces.iter().any(|piece| piece.round && curved(piece))
    }

    /// The same bottom with its keel at another draught [m].
    pub fn at_draught(&self, draught: f64) -> Face {
        Face { draught, ..self.clone() }
    }

    /// The same bottom, bent.
    pub fn bent(&self, deflection: Deflection) -> Face {
        Face { bent: Some(Box::new(deflection)), ..self.clone() }
    }

    /// Velocity of a bent bottom against its rigid line at a distance from the keel [m/s].
    pub fn velocity(&self, along: f64) -> c64 {
        self.bent.as_ref().map_or(c64::ZERO, |bent| bent.velocity.sample(along.min(self.whole_length()))[0])
    }

    /// Is it bent?
    pub fn is_bent(&self) -> bool {
        self.bent.is_some()
    }

    /// Displacement of a bent bottom [m], and its slope.
    fn displaced(&self, along: f64) -> [c64; 2] {
        let sampled = |bent: &Deflection| bent.displacement.sample(along.min(self.whole_length()));
        self.bent.as_ref().map_or([c64::ZERO; 2], |bent| sampled(bent))
    }

    fn last(&self) -> &Piece {
        &self.pieces[self.pieces.len() - 1]
    }

    /// Length from the keel to the chine [m].
    pub fn whole_length(&self) -> f64 {
        self.last().at + self.last().length
    }

    /// Length from the keel to the place where the flow leaves it [m].
    pub fn length(&self) -> f64 {
        self.left_at.min(self.whole_length())
    }

    fn piece(&self, along: f64) -> &Piece {
        let after = self.pieces.partition_point(|piece| piece.at <= along);
        &self.pieces[after.max(1) - 1]
    }

    /// Angle of the bottom at a distance from the keel [rad].
    fn angle(&self, along: f64) -> f64 {
        let piece = self.piece(along);
        let rigid = piece.angle + piece.curvature * (along - piece.at).min(piece.length);
        if self.is_bent() { self.place(along).tangent.arg() } else { rigid }
    }

    /// The place at a distance from the keel [m].
    pub fn place(&self, along: f64) -> Place {
        let rigid = self.rigid_place(along);
        if !self.is_bent() {
            return rigid;
        }
        let ([displaced, slope], beyond) = (self.displaced(along), (along - self.whole_length()).max(0.0));
        let tangent = (rigid.tangent + slope) / (rigid.tangent + slope).norm();
        Place { along, z: rigid.z + displaced + (tangent - rigid.tangent) * beyond, tangent }
    }

    /// The same of the bottom as if it were not bent.
    pub fn rigid_place(&self, along: f64) -> Place {
        let piece = self.piece(along);
        let s = along - piece.at;
        let [z, tangent] = piece.at(s.min(piece.length));
        Place { along, z: self.keel() + z + tangent * (s - piece.length).max(0.0), tangent }
    }

    pub fn keel(&self) -> c64 {
        c64::new(0.0, -self.draught)
    }

    /// Where the flow leaves it.
    pub fn edge(&self) -> c64 {
        self.place(self.length()).z
    }

    /// The place on the bottom that is nearest to `z`; `beyond`: or on the straight line beyond the chine.
    pub fn nearest(&self, z: c64, beyond: bool) -> Place {
        if !self.is_bent() {
            return self.place(self.nearest_of_rigid(z, beyond));
        }
        // the place of the rigid line that is nearest to the point without the displacement there
        let without = |along: f64| z - self.displaced(along)[0];
        let first = self.nearest_of_rigid(z, beyond);
        self.place((0..UNBENT).fold(first, |along, _| self.nearest_of_rigid(without(along), beyond)))
    }

    /// Distance from the keel of the place on the rigid line that is nearest to `z` [m].
    fn nearest_of_rigid(&self, z: c64, beyond: bool) -> f64 {
        let from_keel = z - self.keel();
        let end = self.rigid_place(self.whole_length());
        let over = if beyond { ((z - end.z) * end.tangent.conj()).re.max(0.0) } else { 0.0 };
        let on_piece = |piece: &Piece| {
            let s = piece.nearest(from_keel);
            [(piece.at(s)[0] - from_keel).norm_sqr(), piece.at + s]
        };
        let beyond = [(self.rigid_place(end.along + over).z - z).norm_sqr(), end.along + over];
        let nearer = |best: [f64; 2], here: [f64; 2]| if here[0] < best[0] { here } else { best };
        self.pieces.iter().map(on_piece).chain([beyond]).fold([f64::INFINITY, 0.0], nearer)[1]
    }

    /// Size of the elements at a distance from the keel, by the rounded knuckles, from which they grow [m].
    pub fn size_at(&self, along: f64, growth: f64) -> f64 {
        let rounded = self.pieces.iter().filter(|p| !p.round && (p.curvature * p.length).abs() > SHARP);
        let of = |piece: &Piece| {
            let away = (piece.at - along).max(along - piece.at - piece.length).max(0.0);
            piece.length / ON_KNUCKLE + growth * away
        };
        rounded.map(of).fold(f64::INFINITY, f64::min)
    }

    /// Length of what is straight or of one radius next to the keel [m].
    pub fn first_length(&self) -> f64 {
        self.pieces[0].length
    }

    /// Is there a corner at the keel?
    pub fn is_keeled(&self) -> bool {
        self.pieces[0].direction.im > 1e-6
    }

    /// EN30, EN50: speed of the keel over that of the bottom, so that the wetted half width `c` [m] of Wagner (1932) grows as without the added keel.
    pub fn keel_speed(&self, c: f64) -> f64 {
        self.added.as_ref().map_or(1.0, |added| added.speed(c))
    }

    /// The draught of the bottom at which the wetted half width `c` [m] of Wagner (1932), up to that of the added keel, is wet under its keel. A flat
    /// bottom, wet at once, has not touched the water there: below nothing.
    pub fn draught_of(&self, section: &Section, c: f64) -> f64 {
        match &self.added {
            Some(Added { to: Rounded::Curve(sections), least, from }) if from > least => {
                let [without, with] = sections.each_ref();
                let way = with.wagner_draught(*from) - with.wagner_draught(c);
                without.wagner_draught(*from) - way / self.keel_speed(*from)
            }
            _ => section.wagner_draught(c),
        }
    }

    /// Height of a flat or nearly flat bottom over still water at the distance `x` from the plane of symmetry and a draught [m], without its added
    /// keel; `None` of others.
    pub fn level(&self, x: f64, draught: f64) -> Option<f64> {
        match &self.added {
            Some(Added { to: Rounded::Curve(sections), .. }) if !sections[0].is_round() => {
                Some(sections[0].height(x) - draught)
            }
            _ => None,
        }
    }

    /// Half width from which the wetted width grows as without the added keel [m]; 0 without one.
    pub fn grows_from(&self) -> f64 {
        self.added.as_ref().map_or(0.0, |added| added.from)
    }

    /// Angle to the water of the straight face with the same jet (Wagner 1932), wet to a distance from the keel [m]:
    /// ∫₀^{π/2} β(along sin θ) sin θ dθ.
    pub fn equivalent_angle(&self, along: f64) -> f64 {
        let step = 0.5 * std::f64::consts::PI / PLACES as f64;
        let weights = (0..PLACES).map(|k| ((k as f64 + 0.5) * step).sin());
        let total: f64 = weights.clone().sum();
        weights.map(|w| w * self.angle(along * w)).sum::<f64>() / total
    }
}

impl Added {
    /// A keel of an angle [rad] under a bottom, up to a half width [m].
    fn to(section: &Section, least: f64, keel: f64) -> Added {
        let to = Rounded::Curve(Box::new([section.clone(), section.with_keel(least, keel.tan())]));
        let mut added = Added { to, least, from: least };
        while added.speed(added.from) > FASTEST {
            added.from *= 1.005;
        }
        added
    }

    fn speed(&self, c: f64) -> f64 {
        let c = c.max(self.from);
        match &self.to {
            Rounded::Arc { area, radius } => 1.0 + 4.0 * area * radius / (std::f64::consts::PI * c.powi(3)),
            Rounded::Curve(sections) => {
                let [without, with] = sections.each_ref().map(|section| section.wagner_slope(c));
                with / without
            }
        }
    }
}

/// A line whose knuckles are rounded by arcs.
fn rounded(line: &[Piece]) -> Vec<Piece> {
    let mut pieces = vec![line[0]];
    for pair in line.windows(2) {
        let last = pieces[pieces.len() - 1];
        if (pair[1].angle - last.last_angle()).abs() < SMOOTH {
            pieces.push(pair[1]);
            continue;
        }
        let straight = (ROUNDED * pair[1].at).min(0.5 * pair[0].length.min(pair[1].length));
        let (kept, next) = (last.length - straight, pair[1].part(straight, pair[1].length));
        pieces.pop();
        pieces.push(last.part(0.0, kept));
        let knuckle = arcs(last.at(kept), [next.from, next.direction]);
        pieces.extend(knuckle.into_iter().map(|piece| Piece { round: false, ..piece }));
        pieces.push(next);
    }
    placed(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_an_arc_and_of_the_line_beyond_it() {
        let (radius, end, keel, draught) = (2.0, 1.2_f64, 0.2_f64, 0.3);
        let face = Face::arc(radius, end, keel).at_draught(draught);
        let lowest = radius * (1.0 / keel.cos() - 1.0) - draught;
        for angle in [0.2_f64, 0.3, 0.7, 1.2] {
            let place = face.place(radius * (keel.tan() + angle - keel));
            let exact = c64::new(radius * angle.sin(), radius * (1.0 - angle.cos()) + lowest);
            assert!(
                (place.z - exact).norm() < 1e-14 && (place.tangent.arg() - angle).abs() < 1e-14,
                "{angle}: {place:?}"
            );
            let nearest = face.nearest(place.z + place.tangent * c64::new(0.0, -0.1), true);
            assert!((nearest.along - place.along).abs() < 1e-12, "{angle}: {nearest:?}");
        }
        let beyond = face.edge() + face.place(face.length()).tangent * 0.25;
        assert!((face.nearest(beyond, true).along - face.length() - 0.25).abs() < 1e-12);
        assert!((face.nearest(beyond, false).along - face.length()).abs() < 1e-12);
        assert!(!face.is_round(0.1) && face.is_round(1.0));
    }

    /// The jet of a wedge is its own, that of a flat arc is that of a wedge of π/4 times its angle (Wagner 1932).
    #[test]
    fn the_wedge_with_the_same_jet() {
        assert!((Face::straight(0.5, 1.0).equivalent_angle(0.8) - 0.5).abs() < 1e-12);
        let arc = Face::arc(1.0, 0.5, 0.01).equivalent_angle(0.4);
        assert!((arc / (0.25 * std::f64::consts::PI * 0.4) - 1.0).abs() < 2e-3, "{arc}");
    }
}
