//! The bottom of a symmetric body for entry theories, and the bottoms that each model holds for.

mod corners;

use corners::{area_between, areas_of, corners_of, hull_of, lowest_beyond, slopes_of, straightened, without_dents};

use super::curve::{self, Piece};
use super::model::{EntryModel, OutOfRange};

/// Least slope that a bottom may have, of a deadrise of 4°: below it trapped air, absent here, takes over.
const LEAST_DEADRISE_DEG: f64 = 4.0;
/// Deadrise of the plates by which a bottom goes on past its chines (Tassin, Korobkin & Cooker 2014) [deg].
const CONTINUATION_DEG: f64 = 60.0;
/// Corners on one side of the keel from which they may stand for a circle.
const LEAST_ON_CIRCLE: usize = 6;
/// Largest difference of the radii through them [-].
const OFF_CIRCLE: f64 = 0.005;
/// Corners of half an arc.
const ARC_CORNERS: usize = 96;
/// Slope of a face that is level [-].
const LEVEL: f64 = 1e-6;
/// Height over the keel, over the breadth, from which what reaches farther out than the bottom stays dry [-]: no flow is followed to such a draught.
const DRY: f64 = 1.0;
/// Share of the half breadth by which sides may reach farther out than the place where the outline first turns back: those of curves bulge [-].
const FLARE: f64 = 0.02;
/// Turn of a knuckle, from which a curve does not pass it [rad].
pub(super) const KNUCKLE: f64 = 3.0 * std::f64::consts::PI / 180.0;

/// Half of a symmetric bottom: height f(x) over the keel, rising from the keel at x = 0 to the chine, and past it the plates by
/// which theories let it go on where the flow has left it (THEORY EN2).
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    corners: Vec<[f64; 2]>,
    slopes: Vec<f64>,
    /// Area below the level of each corner, both halves [m²].
    areas: Vec<f64>,
    /// Radius of the circle for which the corners stand [m].
    radius: Option<f64>,
    /// The curve for which corners stand, with its straight faces and knuckles.
    curve: Option<Vec<Piece>>,
    /// The deepest place below the convex hull, [distance from the keel's plane, depth] [m].
    hollow: Option<[f64; 2]>,
    /// Do the corners next to the keel stand for a round one?
    round_keel: bool,
    /// The outline, from the keel, of a body that reaches farther out than the bottom [m], shape (n, 2); empty of another.
    outline: Vec<[f64; 2]>,
}

impl Section {
    /// Corners [m] from the keel to the chine, shape (n, 2); the first is the origin of the section.
    pub fn new(corners: &[[f64; 2]]) -> Result<Section, OutOfRange> {
        let [x0, y0] = *corners.first().ok_or_else(|| OutOfRange::not_a_section("one without corners"))?;
        let corners: Vec<[f64; 2]> = corners.iter().map(|[x, y]| [x - x0, y - y0]).collect();
        if corners.len() < 2 || corners.windows(2).any(|w| w[1][0] <= w[0][0]) {
            return Err(OutOfRange::not_a_section("a bottom whose half breadth does not grow from keel to chine"));
        }
        let (corners, hollow) = without_dents(straightened(corners));
        let curve = curve::through(&corners);
        let corners = curve.as_ref().map_or(corners, |curve| corners_of(curve));
        Ok(Section { curve, hollow, ..Section::faces(corners)? })
    }

    /// Straight faces between corners.
    fn faces(corners: Vec<[f64; 2]>) -> Result<Section, OutOfRange> {
        let slopes = slopes_of(&corners);
        if slopes[0] < 0.0 {
            return Err(OutOfRange::not_a_section("a bottom that falls next to its keel"));
        }
        Ok(Section {
            areas: areas_of(&corners),
            corners,
            slopes,
            radius: None,
            curve: None,
            hollow: None,
            round_keel: false,
            outline: Vec::new(),
        })
    }

    /// A wedge of the given deadrise [deg] and breadth [m].
    pub fn wedge(deadrise_deg: f64, breadth: f64) -> Result<Section, OutOfRange> {
        let half = 0.5 * breadth;
        Section::new(&[[0.0, 0.0], [half, half * deadrise_deg.to_radians().tan()]])?.steep_enough()
    }

    /// The arc of a circle of the given radius and chord [m].
    pub fn arc(radius: f64, breadth: f64) -> Result<Section, OutOfRange> {
        let end = (0.5 * breadth / radius).min(1.0).asin();
        let at = |k: usize| end * (k as f64 / ARC_CORNERS as f64).powf(1.5);
        let corner = |k: usize| [radius * at(k).sin(), 2.0 * radius * (0.5 * at(k)).sin().powi(2)];
        let corners: Vec<[f64; 2]> = (0..=ARC_CORNERS).map(corner).collect();
        Ok(Section { radius: Some(radius), ..Section::faces(corners)? })
    }

    /// The bottom of an upright body whose outline has these corners [m], in order around it.
    ///
    /// # Errors
    /// A flat bottom, one that is lopsided about its keel, one that is less steep than 4 degrees.
    pub fn of_polygon(points: &[[f64; 2]]) -> Result<Section, OutOfRange> {
        let n = points.len();
        let lowest = points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        let is_low = |k: usize| (points[k % n][1] - lowest).abs() < 1e-9;
        // the last of a level bottom's points to the right, and to the left
        let Some(right_end) = (0..n).find(|k| is_low(*k) && !is_low(k + 1)) else {
            return Err(OutOfRange::not_a_section("a flat bottom"));
        };
        let left_end = (0..n).map(|k| (right_end + n - k) % n).find(|k| !is_low(k + n - 1)).unwrap_or(right_end);
        let x0 = 0.5 * (points[right_end][0] + points[left_end][0]);
        let half = |from: usize, step: usize| {
            let mut corners = vec![[x0, lowest]];
            for k in 0..n {
                let (next, last) = (points[(from + k * step) % n], corners[corners.len() - 1]);
                let outwards = (next[0] - last[0]) * if step == 1 { 1.0 } else { -1.0 };
                if k == 0 && outwards.abs() <= 1e-9 {
                    continue;
                }
                if outwards <= 1e-9 {
                    break;
                }
                corners.push(next);
            }
            straightened(corners)
        };
        let (right, left) = (half(right_end, 1), half(left_end, n - 1));
        let alike = |a: &[f64; 2], b: &[f64; 2]| (a[0] + b[0] - 2.0 * x0).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6;
        if right.len() != left.len() || !right.iter().zip(&left).all(|(a, b)| alike(a, b)) {
            return Err(OutOfRange::not_a_section("a section that is lopsided about its keel"));
        }
        let section = Section::new(&right)?;
        let half_breadth = section.half_breadth();
        let height = lowest_beyond(points, x0, half_breadth * (1.0 + FLARE)) - lowest;
        let outline = match height < DRY * 2.0 * half_breadth {
            true => points.iter().map(|[x, y]| [x - x0, y - lowest]).collect(),
            false => Vec::new(),
        };
        let section = match section.circle() {
            Some(radius) => Section::arc(radius, 2.0 * section.half_breadth()),
            None if section.flat_keel().is_some() && section.slopes.len() == 1 => {
                Err(OutOfRange::not_a_section("a flat bottom"))
            }
            None => section.steep_enough(),
        };
        Ok(Section { outline, ..section? })
    }

    /// What a theory without a free surface cannot follow: an outline that reaches farther out than the bottom, as with steps or side hulls.
    pub(super) fn beyond(&self) -> Option<String> {
        let half_breadth = self.half_breadth();
        let height = lowest_beyond(&self.outline, 0.0, half_breadth * (1.0 + FLARE));
        height.is_finite().then(|| {
            format!("an outline that turns back or up {half_breadth} m from its keel, and reaches farther out from {height:.4} m above it on")
        })
    }

    /// Is a place, outwards and upwards from the keel [m], inside the part of the outline beyond the bottom?
    pub(super) fn is_beyond(&self, [x, y]: [f64; 2]) -> bool {
        if x <= self.half_breadth() * (1.0 + FLARE) {
            return false;
        }
        let next = self.outline.iter().cycle().skip(1);
        let crossed = self
            .outline
            .iter()
            .zip(next)
            .filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
        crossed.count() % 2 == 1
    }

    /// Radius [m] of the circle with a level keel on which all corners lie.
    fn circle(&self) -> Option<f64> {
        let radii = || self.corners[1..].iter().map(|[x, y]| (x * x + y * y) / (2.0 * y));
        let (least, most) = radii().fold((f64::INFINITY, 0.0_f64), |(low, high), r| (low.min(r), high.max(r)));
        (self.corners.len() > LEAST_ON_CIRCLE && most - least < OFF_CIRCLE * most).then_some(0.5 * (least + most))
    }

    /// The deepest place below the convex hull, [distance from the keel's plane, depth] [m]; `None` for a convex bottom.
    pub fn hollow(&self) -> Option<[f64; 2]> {
        self.hollow
    }

    /// The section of its convex hull.
    pub fn convex(&self) -> Section {
        let corners = hull_of(&self.corners);
        let (slopes, areas) = (slopes_of(&corners), areas_of(&corners));
        let (radius, round_keel, outline) = (self.radius, self.is_round(), self.outline.clone());
        Section { slopes, areas, corners, radius, curve: None, hollow: None, round_keel, outline }
    }

    /// The same with corners next to the keel that stand for a round one: a section between two, one of them with such a keel.
    pub(super) fn with_round_keel(self) -> Section {
        Section { round_keel: true, ..self }
    }

    /// Corners from the keel to the chine [m], shape (n, 2).
    pub(super) fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// Slopes of the faces between them [-].
    pub(super) fn slopes(&self) -> &[f64] {
        &self.slopes
    }

    /// Angle at the end of a round bottom [deg].
    pub(super) fn last_angle_deg(&self) -> f64 {
        if self.curve.is_some() {
            let faces = self.followed().len() - 1;
            return self.slopes[faces - 1].atan().to_degrees();
        }
        (self.half_breadth() / self.radius.unwrap_or(f64::INFINITY)).min(1.0).asin().to_degrees()
    }

    /// Radius of a round bottom [m]; `None` for other bottoms.
    pub fn radius(&self) -> Option<f64> {
        self.radius
    }

    /// Is the bottom round at its keel?
    pub fn is_round(&self) -> bool {
        let is_level = |curve: &Vec<Piece>| curve[0].round && curve[0].angle.abs() < LEVEL;
        self.round_keel || self.radius.is_some() || self.curve.as_ref().is_some_and(is_level)
    }

    /// Do its points stand for a curve?
    pub fn is_curved(&self) -> bool {
        self.curve.is_some()
    }

    /// Half width of a flat keel [m]; `None` of a keeled or a round bottom.
    pub fn flat_keel(&self) -> Option<f64> {
        (!self.is_round() && self.slopes[0] < LEVEL).then(|| self.corners[1][0])
    }

    /// Is the bottom next to its keel so flat that it meets water nearly at once, with a peak of sound or of trapped air?
    pub fn meets_at_once(&self) -> bool {
        !self.is_round() && self.slopes[0] < 0.999 * LEAST_DEADRISE_DEG.to_radians().tan()
    }

    /// Added mass over the density at contact, M = ½πf² of a flat keel, half as wide as f (von Karman 1929); 0 of other bottoms [m²].
    pub fn mass_at_contact(&self) -> f64 {
        self.flat_keel().map_or(0.0, |f| std::f64::consts::FRAC_PI_2 * f * f)
    }

    /// The same bottom whose part up to a half width [m] is replaced by a face of a slope.
    pub(super) fn with_keel(&self, half_width: f64, slope: f64) -> Section {
        let beyond = self.corners.iter().filter(|c| c[0] > half_width * (1.0 + 1e-9));
        let touched = [half_width, self.height(half_width)];
        let lowest = touched[1] - half_width * slope;
        let corners = std::iter::once(touched).chain(beyond.copied()).map(|[x, y]| [x, y - lowest]);
        let corners: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(corners).collect();
        let (slopes, areas) = (slopes_of(&corners), areas_of(&corners));
        Section {
            corners,
            slopes,
            areas,
            radius: None,
            curve: None,
            hollow: None,
            round_keel: false,
            outline: Vec::new(),
        }
    }

    /// The curve for which corners stand, with its straight faces and knuckles; `None` of a bottom of straight faces, and of an arc.
    pub(super) fn curve(&self) -> Option<&[Piece]> {
        self.curve.as_deref()
    }

    fn steep_enough(self) -> Result<Section, OutOfRange> {
        let is_wedge = self.deadrise_deg().is_some() && self.flat_keel().is_none();
        match is_wedge && self.meets_at_once() {
            true => Err(OutOfRange::not_a_section("a deadrise below 4 degrees")),
            false => Ok(self),
        }
    }

    /// Half breadth at the chines [m].
    pub fn half_breadth(&self) -> f64 {
        self.corners[self.corners.len() - 1][0]
    }

    /// Height of the chines over the keel [m].
    pub fn chine_height(&self) -> f64 {
        self.corners[self.corners.len() - 1][1]
    }

    /// Deadrise of a wedge [deg]; `None` for other bottoms.
    pub fn deadrise_deg(&self) -> Option<f64> {
        (self.slopes.len() == 1).then(|| self.slopes[0].atan().to_degrees())
    }

    /// Steepest deadrise of the faces within the half width `reach` [m], in degrees.
    pub fn steepest_within(&self, reach: f64) -> f64 {
        let wet = self.corners.iter().zip(&self.slopes).filter(|(c, _)| c[0] < reach);
        wet.fold(self.slopes[0], |most, (_, s)| most.max(*s)).atan().to_degrees()
    }

    /// Straight pieces as [x from, x to, f at the first, slope] [m, m, m, -]: the faces, then the plate that goes on.
    pub fn pieces(&self) -> impl Iterator<Item = [f64; 4]> + '_ {
        let faces = self.corners.windows(2).zip(&self.slopes).map(|(w, s)| [w[0][0], w[1][0], w[0][1], *s]);
        let plate = CONTINUATION_DEG.to_radians().tan().max(self.slopes[self.slopes.len() - 1]);
        faces.chain([[self.half_breadth(), f64::INFINITY, self.chine_height(), plate]])
    }

    /// Height f over the keel at distance x from the plane of symmetry [m].
    pub fn height(&self, x: f64) -> f64 {
        let piece = self.pieces().find(|[_, to, ..]| x.abs() <= *to);
        piece.map_or(f64::INFINITY, |[from, _, f, slope]| f + slope * (x.abs() - from))
    }

    /// Slope df/dx there [-].
    pub fn slope(&self, x: f64) -> f64 {
        let (x, last) = (x.abs(), self.slopes.len() - 1);
        let k = self.corners.partition_point(|c| c[0] < x).saturating_sub(1);
        if k > last {
            return self.pieces().last().map_or(f64::INFINITY, |[.., slope]| slope);
        }
        if self.radius.is_none() && self.curve.is_none() {
            return self.slopes[k];
        }
        // at a corner the curve has the mean slope of the chords next to it, at its ends that of the parabola
        let at = |corner: usize| match corner {
            0 if self.is_round() => 0.0,
            0 => self.slopes[0],
            corner if corner > last => match self.turn(last) {
                turn if turn > KNUCKLE => self.slopes[last],
                _ => 2.0 * self.slopes[last] - 0.5 * (self.slopes[last - 1] + self.slopes[last]),
            },
            corner if self.turn(corner) > KNUCKLE => self.slopes[k],
            corner => 0.5 * (self.slopes[corner - 1] + self.slopes[corner]),
        };
        let ([x0, _], [x1, _]) = (self.corners[k], self.corners[k + 1]);
        at(k) + (at(k + 1) - at(k)) * (x - x0) / (x1 - x0)
    }

    /// Turn at a corner between two faces [rad].
    pub(super) fn turn(&self, corner: usize) -> f64 {
        (self.slopes[corner].atan() - self.slopes[corner - 1].atan()).abs()
    }

    /// Half width of the body's cut with the still water at draught h [m].
    pub fn still_half_width(&self, draught: f64) -> f64 {
        let at = self.corners.partition_point(|c| c[1] < draught);
        match at {
            0 => 0.0,
            n if n == self.corners.len() => self.half_breadth(),
            n => self.corners[n - 1][0] + (draught - self.corners[n - 1][1]) / self.slopes[n - 1],
        }
    }

    /// Area of the body below still water at draught h [m²], both halves; sides rise upright from the chines.
    pub fn still_area(&self, draught: f64) -> f64 {
        // a convex bottom rises: the faces before the one that the surface cuts are whole, and those after it are dry
        let (whole, faces) = match self.hollow {
            None => (self.corners.partition_point(|c| c[1] < draught).saturating_sub(1), 1),
            Some(_) => (0, self.slopes.len()),
        };
        let wet = self.corners[whole..].windows(2).take(faces).filter(|w| draught > w[0][1]);
        let area = wet.fold(self.areas[whole], |area, w| area + area_between(w[0], w[1], draught));
        area + 2.0 * self.half_breadth() * (draught - self.chine_height()).max(0.0)
    }

    /// EN3 (Wagner 1932): draught [m] at which the pile-up wets the half width c, h(c) = (2/π) ∫₀^{π/2} f(c sin θ) dθ.
    pub fn wagner_draught(&self, c: f64) -> f64 {
        self.kinks(c).map(|(x, bend)| bend * ((c * c - x * x).sqrt() - x * (x / c).acos())).sum::<f64>()
            * std::f64::consts::FRAC_2_PI
    }

    /// Its slope dh/dc [-].
    pub fn wagner_slope(&self, c: f64) -> f64 {
        self.kinks(c).map(|(x, bend)| bend * (1.0 - (x / c).powi(2)).sqrt()).sum::<f64>() * std::f64::consts::FRAC_2_PI
    }

    /// Places below c where the slope changes [m], and by how much [-].
    fn kinks(&self, c: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let mut before = 0.0;
        let bends = self.pieces().map(move |[from, _, _, slope]| (from, slope - std::mem::replace(&mut before, slope)));
        bends.take_while(move |(x, _)| *x < c)
    }
}

impl OutOfRange {
    /// What has no bottom that a theory could take.
    pub fn not_a_section(what: &str) -> OutOfRange {
        OutOfRange {
            what: what.into(),
            range: "upright, symmetric bottoms of a deadrise of 4° and more".into(),
            next: EntryModel::Wcsph,
        }
    }
}

#[cfg(test)]
mod tests;
