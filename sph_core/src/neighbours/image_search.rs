//! The images of particles that have a neighbour in front of a plane of symmetry, or in the periodic cell (THEORY OP8, OP9).

use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::levels::Extent;
use crate::parallel;
use crate::planes::{Mirror, Periodic};

/// An image and where it came from: a point with the index of its source, and its translation where images repeat [m].
#[derive(Clone, Copy)]
pub(super) struct Image {
    point: Point,
    shift: [f64; 2],
}

/// The planes that make images.
pub(super) struct Planes {
    mirror: Option<Mirror>,
    periodic: Option<Periodic>,
    shifts: Vec<[f64; 2]>,
}

impl Planes {
    pub fn new(mirror: Option<Mirror>, periodic: Option<Periodic>) -> Planes {
        let shifts = periodic.map_or(Vec::new(), |periodic| periodic.shifts().collect());
        Planes { mirror, periodic, shifts }
    }

    /// True if there are any.
    pub fn exist(&self) -> bool {
        self.mirror.is_some() || self.periodic.is_some()
    }

    /// Whether an image, which reaches `farthest` [m] at most, meets a point of `cells`.
    pub fn meets<'a>(&self, cells: &'a Cells, farthest: f64) -> impl Fn(&Point) -> bool + Sync + use<'a> {
        let beside = self.mirror.map(|mirror| cells.beside(mirror.at, farthest));
        move |image| {
            let is_near = |(reach, points): &(f64, Extent)| points.is_near(image, image.farthest() + reach);
            beside.as_ref().is_none_or(|levels| levels.iter().any(is_near)) && cells.any_meets(image)
        }
    }

    /// The images of `points` that are `needed`, in order; no point reaches farther than `farthest` [m].
    pub fn images(&self, points: &[Point], farthest: f64, needed: impl Fn(&Point) -> bool + Sync) -> Vec<Image> {
        let of_chunk = |targets: std::ops::Range<usize>| {
            let mut found = Vec::new();
            for p in &points[targets] {
                let mut keep =
                    |point: Point, shift: [f64; 2]| found.extend(needed(&point).then_some(Image { point, shift }));
                if let Some(mirror) = self.mirror.filter(|mirror| p.x - mirror.at < 2.0 * p.farthest() + farthest) {
                    keep(Point { x: mirror.reflect(p.x), travel: [-p.travel[0], p.travel[1]], ..*p }, [0.0; 2]);
                }
                if self.periodic.is_some_and(|periodic| periodic.is_beside([p.x, p.y], 2.0 * farthest)) {
                    for &shift in &self.shifts {
                        keep(Point { x: p.x + shift[0], y: p.y + shift[1], ..*p }, shift);
                    }
                }
            }
            found
        };
        parallel::by_chunk(points.len(), of_chunk).concat()
    }

    /// Sort images behind the points of `cells`: sources and translations in the order in which they are named from there on.
    pub fn append(&self, images: &[Image], cells: &mut Cells, sources: &mut Vec<u32>, shifts: &mut Vec<[f64; 2]>) {
        let own = cells.points().len();
        cells.add(images.len(), |k| Point { index: k as u32, ..images[k].point });
        let sorted = cells.points()[own..].iter().map(|p| &images[p.index as usize]);
        sources.extend(sorted.clone().map(|image| image.point.index));
        if self.periodic.is_some() {
            shifts.extend(sorted.map(|image| image.shift));
        }
        cells.name_by_order(own, own as u32);
    }
}
