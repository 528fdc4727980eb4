//! A line of straight pieces and arcs of circles through the points of an outline.
//!
//! Points that stand for a curve are joined by pairs of arcs with one tangent (Bolton 1975); at a knuckle the tangent jumps.

use faer::c64;

/// Largest turn at a point of a curve [rad].
const LARGEST_TURN: f64 = 22.0 * std::f64::consts::PI / 180.0;
/// A turn that is none [rad].
const LEAST_TURN: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Largest curvature at a point of a curve over that at a point beside it, and of a side over the other that is no straight face [-].
const LARGEST_RATIO: f64 = 3.0;
/// Points of a curve, at least; of one across the keel both sides count.
const LEAST_POINTS: usize = 5;
/// Distance of points from the arcs that replace them, over the length of the line [-].
const OFF_ARCS: f64 = 1e-4;
/// Largest turn between two points of a refined outline [rad].
const FINE_TURN: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// Where a bottom ends [rad].
const UPRIGHT: f64 = 89.9 * std::f64::consts::PI / 180.0;
/// Largest ratio of the angles of a side with the tangents at its ends: with 3 and more one of the two arcs turns the other way [-].
const ONE_WAY: f64 = 2.5;
/// Tangents that differ by less are one [rad].
const SAME: f64 = 1e-9;

/// A line of constant curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Distance of its first point from the keel, along the bottom [m].
    pub at: f64,
    /// Its first point, from the keel [m].
    pub from: c64,
    /// Unit vector outwards at its first point.
    pub direction: c64,
    /// Its angle [rad].
    pub angle: f64,
    /// Curvature, positive where the bottom gets steeper [1/m].
    pub curvature: f64,
    pub length: f64,
    /// Is it a piece of a curve? A rounded knuckle and a straight face are not.
    pub round: bool,
}

impl Piece {
    /// A straight piece.
    pub fn straight(from: c64, to: c64) -> Piece {
        let (length, direction) = ((to - from).norm(), (to - from) / (to - from).norm());
        Piece { at: 0.0, from, direction, angle: direction.arg(), curvature: 0.0, length, round: false }
    }

    /// The arc that leaves a point in a direction and comes to another.
    fn arc(from: c64, direction: c64, to: c64) -> Piece {
        let chord = to - from;
        let half = (chord * direction.conj()).arg();
        let length = if half.abs() < SAME { chord.norm() } else { chord.norm() * half / half.sin() };
        let curvature = if half.abs() < SAME { 0.0 } else { 2.0 * half / length };
        Piece { at: 0.0, from, direction, angle: direction.arg(), curvature, length, round: true }
    }

    /// The point at a distance `s` [m] from its first, and the unit vector outwards there.
    pub fn at(&self, s: f64) -> [c64; 2] {
        if self.curvature == 0.0 {
            return [self.from + self.direction * s, self.direction];
        }
        let (half, turn) = (0.5 * self.curvature * s, |angle: f64| c64::new(angle.cos(), angle.sin()));
        let chord = if half.abs() < 1e-9 { s } else { s * half.sin() / half };
        [self.from + self.direction * turn(half) * chord, self.direction * turn(2.0 * half)]
    }

    /// Distance from its first point to the place nearest to `z`, which is given from the keel [m].
    pub fn nearest(&self, z: c64) -> f64 {
        let along = (z - self.from) * self.direction.conj();
        let s = match self.curvature {
            0.0 => along.re,
            k => (k * along.re).atan2(1.0 - k * along.im) / k,
        };
        s.clamp(0.0, self.length)
    }

    /// Its part from `first` to `last` [m].
    pub fn part(&self, first: f64, last: f64) -> Piece {
        let [from, direction] = self.at(first);
        Piece { from, direction, angle: self.angle + self.curvature * first, length: last - first, ..*self }
    }

    /// Angle at its last point [rad].
    pub fn last_angle(&self) -> f64 {
        self.angle + self.curvature * self.length
    }

    #[cfg(test)]
    fn end(&self) -> c64 {
        self.at(self.length)[0]
    }
}

/// A point of the line with the directions before and after it.
#[derive(Clone, Copy, Debug)]
struct Node {
    z: c64,
    before: c64,
    after: c64,
}

/// Two arcs with one tangent from a point and direction to another (Bolton 1975); one straight piece where there is no turn.
pub(crate) fn arcs([a, before]: [c64; 2], [b, after]: [c64; 2]) -> Vec<Piece> {
    let (chord, dot) = (b - a, |p: c64, q: c64| (p * q.conj()).re);
    let is_along = |t: c64| (chord * t.conj()).arg().abs() < SAME;
    if is_along(before) && is_along(after) {
        return vec![Piece::straight(a, b)];
    }
    // 2(1 − t₁·t₂) d² + 2 v·(t₁ + t₂) d − v² = 0
    let (p, q, r) = (2.0 * (1.0 - dot(before, after)), dot(chord, before + after), dot(chord, chord));
    let d = r / (q + (q * q + p * r).sqrt());
    let middle = 0.5 * (a + b + d * (before - after));
    let first = Piece::arc(a, before, middle);
    let second = Piece::arc(middle, first.at(first.length)[1], b);
    vec![first, second]
}

/// Points of a line: from the keel of a symmetric bottom outwards, or around a body.
struct Line<'a> {
    points: &'a [c64],
    closed: bool,
}

impl Line<'_> {
    /// The point before or after one; that before a keel is its mirror image. `None` beyond the end of an open line.
    fn beside(&self, k: usize, after: bool) -> Option<usize> {
        let n = self.points.len();
        match (k, after) {
            (k, true) if k + 1 < n => Some(k + 1),
            (_, true) => self.closed.then_some(0),
            (0, false) if self.closed => Some(n - 1),
            (0, false) => Some(1),
            (k, false) => Some(k - 1),
        }
    }

    /// Turn at a point [rad] and the mean length of the sides beside it [m].
    fn bend(&self, k: usize) -> Option<[f64; 2]> {
        let (before, after) = (self.beside(k, false)?, self.beside(k, true)?);
        let after = self.points[after] - self.points[k];
        let before = match k == 0 && !self.closed {
            true => after.conj(),
            false => self.points[k] - self.points[before],
        };
        Some([(after / before).arg(), 0.5 * (before.norm() + after.norm())])
    }

    /// Which points stand for a curve.
    fn smooth(&self) -> Vec<bool> {
        let n = self.points.len();
        let bends: Vec<Option<[f64; 2]>> = (0..n).map(|k| self.bend(k)).collect();
        let gentle = |k: usize| bends[k].filter(|[turn, _]| turn.abs() < LARGEST_TURN);
        let curvature = |k: usize| gentle(k).map_or(0.0, |[turn, length]| turn.abs() / length);
        let turns = |k: usize| bends[k].is_some_and(|[turn, _]| turn.abs() >= LEAST_TURN);
        let is_smooth = |k: usize| {
            let beside = [false, true].map(|after| self.beside(k, after).map_or(0.0, curvature));
            gentle(k).is_some() && (!turns(k) || curvature(k) <= LARGEST_RATIO * beside[0].max(beside[1]))
        };
        let mut found: Vec<bool> = (0..n).map(is_smooth).collect();
        // a few points are knuckles; of a closed line the runs begin after one that is
        let start = if self.closed { found.iter().position(|smooth| !smooth).unwrap_or(0) } else { 0 };
        let mut k = 0;
        while k < n {
            let run: Vec<usize> = (k..n).map(|k| (k + start) % n).take_while(|k| found[*k]).collect();
            let turning = run.iter().filter(|k| turns(**k)).count();
            let across_keel = run.first() == Some(&0) && !self.closed;
            if (if across_keel { (2 * turning).saturating_sub(1) } else { turning }) < LEAST_POINTS {
                run.iter().for_each(|k| found[*k] = false);
            }
            k += run.len() + 1;
        }
        found
    }

    /// The points with their tangents: at a point of a curve that of the circle through it and its neighbours, at a knuckle the sides, or the
    /// tangent of the curve that ends there.
    fn nodes(&self, smooth: &[bool]) -> Vec<Node> {
        let (n, points) = (self.points.len(), self.points);
        let unit = |z: c64| z / z.norm();
        let side = |k: usize, after: bool| {
            let other = self.beside(k, after).map(|other| points[other])?;
            Some(if after { other - points[k] } else { points[k] - other })
        };
        let circle = |k: usize| {
            let (a, b) = (side(k, false)?, side(k, true)?);
            // a level first side has its other half beyond the keel
            let of_a = if k == 1 && !self.closed && a.im.abs() < SAME * a.re { 2.0 * a.norm() } else { a.norm() };
            let share = match of_a / b.norm() {
                longer if longer > LARGEST_RATIO => 0.0, // a curve begins at a straight face
                shorter if shorter * LARGEST_RATIO < 1.0 => 1.0,
                _ => of_a / (of_a + b.norm()),
            };
            let turn = (b / a).arg() * share;
            Some(unit(a) * c64::new(turn.cos(), turn.sin()))
        };
        // that of the circle through a point in the direction there, at the point beside it
        let mirrored = |direction: c64, chord: c64| chord * chord / (chord * chord.conj()) * direction.conj();
        let tangents = |k: usize| match k {
            0 if !self.closed && smooth[0] => [c64::ONE; 2],
            0 if !self.closed => [unit(side(0, true).unwrap_or(c64::ONE)); 2],
            k if smooth[k] => [circle(k).unwrap_or(c64::ONE); 2],
            k => {
                let [before, after] = [side(k, false), side(k, true)];
                [before.or(after), after.or(before)].map(|side| unit(side.unwrap_or(c64::ONE)))
            }
        };
        let of = |k: usize| (tangents(k), points[k]);
        let mut nodes: Vec<Node> = (0..n).map(of).map(|([before, after], z)| Node { z, before, after }).collect();
        for k in 0..n {
            let Some(next) = self.beside(k, true) else { continue };
            let chord = points[next] - points[k];
            if smooth[k] && !smooth[next] {
                nodes[next].before = mirrored(nodes[k].after, chord);
            } else if !smooth[k] && smooth[next] {
                nodes[k].after = mirrored(nodes[next].before, chord);
            }
        }
        self.without_waves(nodes, smooth)
    }

    /// The nodes with tangents that make no curve between two of them turn much more at one end than at the other. All are judged as they are
    /// given, so that the image of a line has the image's tangents; a straight side keeps its own.
    fn without_waves(&self, given: Vec<Node>, smooth: &[bool]) -> Vec<Node> {
        let n = given.len();
        let chord = |k: usize| self.beside(k, true).map(|next| self.points[next] - self.points[k]);
        let mut turned: Vec<c64> = vec![c64::ZERO; n];
        for k in 0..n {
            let (Some(next), Some(chord)) = (self.beside(k, true), chord(k)) else { continue };
            let by = |angle: f64| chord / chord.norm() * c64::new(angle.cos(), angle.sin());
            let [first, last] = [(chord / given[k].after).arg(), (given[next].before / chord).arg()];
            if first * last <= 0.0 {
                continue;
            }
            if last.abs() > ONE_WAY * first.abs() && smooth[next] {
                turned[next] += by(ONE_WAY * first);
            } else if first.abs() > ONE_WAY * last.abs() && smooth[k] && (k > 0 || self.closed) {
                turned[k] += by(-ONE_WAY * last);
            }
        }
        let bends =
            |chord: Option<c64>, direction: c64| chord.is_none_or(|chord| (chord / direction).arg().abs() > SAME);
        let of = |k: usize| {
            let node = given[k];
            if turned[k] == c64::ZERO {
                return node;
            }
            let to = turned[k] / turned[k].norm();
            let from =
                self.beside(k, false).filter(|_| k > 0 || self.closed).map(|other| self.points[k] - self.points[other]);
            Node {
                before: if bends(from, node.before) { to } else { node.before },
                after: if bends(chord(k), node.after) { to } else { node.after },
                ..node
            }
        };
        (0..n).map(of).collect()
    }
}

/// The outline of a body with more points where its points stand for a curve, on the arcs through them (THEORY EN49), its lowest point as high as
/// before; `None` without a curve, or where its points are dense. Points [m] around the body, shape (n, 2).
pub fn refined(outline: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let points: Vec<c64> = outline.iter().map(|[x, y]| c64::new(*x, *y)).collect();
    let line = Line { points: &points, closed: true };
    let smooth = line.smooth();
    let nodes = line.nodes(&smooth);
    let mut fine: Vec<[f64; 2]> = Vec::new();
    for (k, node) in nodes.iter().enumerate() {
        let next = &nodes[(k + 1) % nodes.len()];
        for piece in arcs([node.z, node.after], [next.z, next.before]) {
            let count = ((piece.curvature * piece.length).abs() / FINE_TURN).ceil().max(1.0);
            let places = (0..count as usize).map(|k| piece.at(piece.length * k as f64 / count)[0]);
            fine.extend(places.map(|z| [z.re, z.im]));
        }
    }
    let lowest = |points: &[[f64; 2]]| points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let lower = lowest(outline) - lowest(&fine);
    fine.iter_mut().for_each(|point| point[1] += lower);
    (fine.len() > outline.len()).then_some(fine)
}

/// The line through points from the keel outwards [m]; knuckles are not rounded. `None` without a curve.
pub(crate) fn through(corners: &[[f64; 2]]) -> Option<Vec<Piece>> {
    let points: Vec<c64> = corners.iter().map(|[x, y]| c64::new(*x, *y)).collect();
    let line = Line { points: &points, closed: false };
    let smooth = line.smooth();
    if !smooth.contains(&true) {
        return None;
    }
    let nodes = line.nodes(&smooth);
    let length: f64 = points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
    let between = |i: usize, j: usize| arcs([nodes[i].z, nodes[i].after], [nodes[j].z, nodes[j].before]);
    let off = |pieces: &[Piece], z: c64| {
        pieces.iter().map(|piece| (piece.at(piece.nearest(z))[0] - z).norm()).fold(f64::INFINITY, f64::min)
    };
    let fits = |i: usize, j: usize| {
        let pieces = between(i, j);
        let one_way = pieces.iter().all(|p| p.curvature >= 0.0) || pieces.iter().all(|p| p.curvature <= 0.0);
        one_way && (i + 1..j).all(|k| off(&pieces, nodes[k].z) < OFF_ARCS * length)
    };
    let (mut i, mut line) = (0, Vec::new());
    while i + 1 < nodes.len() {
        let mut j = i + 1;
        while j + 1 < nodes.len() && smooth[j] && fits(i, j + 1) {
            j += 1;
        }
        line.extend(between(i, j));
        i = j;
    }
    Some(placed(until_upright(line)))
}

/// The line up to where it stands upright.
fn until_upright(mut line: Vec<Piece>) -> Vec<Piece> {
    if let Some(k) = line.iter().position(|piece| piece.last_angle() > UPRIGHT) {
        let piece = line[k];
        line.truncate(k);
        if piece.angle < UPRIGHT {
            line.push(piece.part(0.0, (UPRIGHT - piece.angle) / piece.curvature));
        }
    }
    line
}

/// The same pieces with their distances from the first.
pub(crate) fn placed(mut pieces: Vec<Piece>) -> Vec<Piece> {
    let mut at = 0.0;
    for piece in &mut pieces {
        piece.at = at;
        at += piece.length;
    }
    pieces
}

#[cfg(test)]
mod tests;
