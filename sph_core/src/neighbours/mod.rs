//! Neighbour lists for fluid and walls, images included, rebuilt when a particle has gone farther astray than its skin.

pub mod cells;
mod entries;
mod expected;
mod image_search;
mod levels;
pub(crate) mod lists;
mod point;
pub(crate) mod skin;
mod sorting;
pub(crate) mod visibility;

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::neighbours::cells::Cells;
use crate::neighbours::entries::Entry;
pub(crate) use crate::neighbours::expected::SKIN;
use crate::neighbours::expected::{Expectation, Moving};
use crate::neighbours::image_search::Planes;
pub use crate::neighbours::lists::Lists;
use crate::neighbours::skin::Skin;
use crate::neighbours::visibility::{Listed, ThinWalls};
use crate::parallel;
use crate::particles::{Fields, Particles, Spare};
use crate::planes::{Mirror, Periodic};
use crate::state_bytes::{StateError, expect_count};

/// Wall particles at the moment of the search.
#[derive(Clone, Copy)]
pub(crate) struct WallKinematics<'a> {
    /// Position [m].
    pub x: &'a [f64],
    /// Position [m].
    pub y: &'a [f64],
    /// Velocity [m/s].
    pub u: &'a [f64],
    /// Velocity [m/s].
    pub v: &'a [f64],
    /// Smoothing length [m].
    pub h: &'a [f64],
    /// Mirror point in the fluid [m] (LE17); empty where no wall asks.
    pub mirror_x: &'a [f64],
    /// Mirror point in the fluid [m].
    pub mirror_y: &'a [f64],
    /// Thin walls (WA8), where there are any.
    pub thin: Option<ThinWalls<'a>>,
}

impl WallKinematics<'_> {
    fn moving(&self) -> Moving<'_> {
        Moving { at: [self.x, self.y], velocity: [self.u, self.v], h: self.h }
    }

    fn mirror_points(&self) -> Moving<'_> {
        Moving { at: [self.mirror_x, self.mirror_y], ..self.moving() }
    }
}

/// What a search works in; kept from one to the next.
#[derive(Default)]
pub(crate) struct SearchSpace {
    fluid: Cells,
    walls: Cells,
    /// Which particle comes to each place.
    order: Vec<u32>,
    spare: Spare,
}

impl SearchSpace {
    /// What it holds on to [bytes].
    pub(crate) fn bytes(&self) -> usize {
        self.fluid.bytes() + self.walls.bytes() + of_vector(&self.order) + self.spare.bytes()
    }
}

/// Neighbour lists. Indices below the number of particles are the particles themselves; those above are images of
/// [`Neighbours::source`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Neighbours {
    /// Fluid (and images) around each fluid particle.
    pub fluid: Lists,
    /// Walls (and images) around each fluid particle.
    pub walls_of_fluid: Lists,
    /// Fluid (and images) around each wall particle.
    pub(crate) fluid_of_wall: Lists,
    /// Fluid (and images) around each wall particle's mirror point (LE17); empty where no wall asks.
    pub(crate) fluid_of_mirror: Lists,
    /// Sources of the fluid's images.
    pub(crate) fluid_images: Vec<u32>,
    /// Sources of the walls' images.
    pub(crate) wall_images: Vec<u32>,
    /// Translations of the fluid's images [m], where images repeat (OP9); empty where they reflect.
    pub(crate) fluid_shifts: Vec<[f64; 2]>,
    /// Translations of the walls' images [m], likewise.
    pub(crate) wall_shifts: Vec<[f64; 2]>,
    /// How often the lists were made.
    pub rebuilds: u64,
    /// When they were made, and how long they are to last [s].
    made: (f64, f64),
    skin: Skin,
    wall_skin: Skin,
    mirror_skin: Skin,
}

impl Neighbours {
    /// Empty lists that were made `rebuilds` times before.
    pub(crate) fn made(rebuilds: u64) -> Neighbours {
        Neighbours { rebuilds, ..Neighbours::default() }
    }

    /// An error unless these are lists of `n` particles, and of as many walls as in `like`.
    pub(crate) fn check(&self, n: usize, like: &Neighbours) -> Result<(), StateError> {
        let [walls, mirrored] = [&like.fluid_of_wall, &like.fluid_of_mirror].map(Lists::targets);
        for (images, sources) in [(&self.fluid_images, n), (&self.wall_images, walls)] {
            let known = images.iter().filter(|&&source| (source as usize) < sources).count();
            expect_count("images of particles", known, images.len())?;
        }
        for (shifts, images) in [(&self.fluid_shifts, &self.fluid_images), (&self.wall_shifts, &self.wall_images)] {
            expect_count("shifts of images", shifts.len(), if shifts.is_empty() { 0 } else { images.len() })?;
        }
        let [fluid, wall] = [n + self.fluid_images.len(), walls + self.wall_images.len()];
        self.fluid.check(n, fluid)?;
        self.walls_of_fluid.check(n, wall)?;
        self.fluid_of_wall.check(walls, fluid)?;
        self.fluid_of_mirror.check(mirrored, fluid)
    }

    /// True while every pair that can meet at `now` [s] is listed. Only the age of the lists counts, not the time itself.
    pub(crate) fn holds(&self, particles: &Particles, walls: &WallKinematics, now: f64) -> bool {
        let (since, life) = self.made;
        let age = (now - since).max(0.0).min(life);
        self.skin.holds(&particles.x, &particles.y, age)
            && self.wall_skin.holds(walls.x, walls.y, age)
            && self.mirror_skin.holds(walls.mirror_x, walls.mirror_y, age)
    }

    /// Sort the fluid by cell and list all pairs at `now` [s], to last about `life` [s], with a `skin` [h] of particles at rest.
    pub(crate) fn rebuild(
        &mut self,
        space: &mut SearchSpace,
        particles: &mut Particles,
        fields: &mut Fields,
        walls: &WallKinematics,
        (mirror, periodic): (Option<Mirror>, Option<Periodic>),
        [now, life, skin]: [f64; 3],
    ) {
        wrap(particles, periodic);
        let (expectation, planes) = (Expectation::new([life, skin], walls.thin), Planes::new(mirror, periodic));
        let SearchSpace { fluid, walls: wall, order, spare } = space;

        // sort the fluid physically, so that a neighbourhood is a few contiguous runs
        let (n, moving) = (particles.len(), moving(particles));
        fluid.sort(n, |k| expectation.point(&moving, k));
        order.resize(n, 0);
        parallel::gather_into(order, |k| fluid.points()[k].index);
        fluid.name_by_order(0, 0);
        particles.permute(order, spare);
        fields.permute(order, spare);

        let mut wall_points = expectation.points(&walls.moving());
        let mirror_points = expectation.points(&walls.mirror_points());
        let walls_now = wall_points.len();
        wall.sort(walls_now, |k| wall_points[k]);
        self.find_images(&planes, fluid, wall, &Cells::build(&mirror_points));
        wall_points.extend_from_slice(&wall.points()[walls_now..]);

        let h = &particles.h;
        let same = parallel::every(n, |k| h[k] == h[0]);
        let alike = |targets: std::ops::Range<usize>, entries: &[Entry]| {
            let of = |j: usize| h[source(j, n, &self.fluid_images)];
            same || targets.clone().all(|k| h[k] == h[targets.start])
                && entries.iter().all(|e| of(e.index() as usize) == h[targets.start])
        };
        let any = |_: std::ops::Range<usize>, _: &[Entry]| false;
        self.fluid.build(n, fluid, |k| fluid.points()[k], true, alike);
        self.walls_of_fluid.build(n, wall, |k| fluid.points()[k], false, any);
        self.fluid_of_wall.build(walls_now, fluid, |k| wall_points[k], false, any);
        self.fluid_of_mirror.build(mirror_points.len(), fluid, |k| mirror_points[k], false, any);
        if let Some(thin) = walls.thin {
            let (fluid, wall, mirrored, wall_images) =
                (fluid.points(), &wall_points, &mirror_points, &self.wall_images);
            let listed = Listed { fluid, wall, mirrored, wall_images, mirror };
            let Neighbours { fluid, walls_of_fluid, fluid_of_wall, fluid_of_mirror, .. } = self;
            thin.mask(&listed, [fluid, walls_of_fluid, fluid_of_wall, fluid_of_mirror]); // WA8, WA9
        }
        self.made = (now, life);
        let moving = [self::moving(particles), walls.moving(), walls.mirror_points()];
        for (skin, of) in [&mut self.skin, &mut self.wall_skin, &mut self.mirror_skin].into_iter().zip(&moving) {
            let [x, y] = of.at;
            skin.reset(x, y, |k| expectation.velocity(of, k), |k| expectation.allowance(of, k));
        }
        self.rebuilds += 1;
        self.flag_surface(fields);
    }

    /// Find the images that have a neighbour, and sort them into cells of their own.
    fn find_images(&mut self, planes: &Planes, fluid: &mut Cells, wall: &mut Cells, mirror_points: &Cells) {
        let Neighbours { fluid_images, wall_images, fluid_shifts, wall_shifts, .. } = self;
        [&mut *fluid_images, wall_images].into_iter().for_each(Vec::clear);
        [&mut *fluid_shifts, wall_shifts].into_iter().for_each(Vec::clear);
        if !planes.exist() {
            return;
        }
        let farthest = [&*fluid, &*wall, mirror_points].map(Cells::farthest).into_iter().fold(0.0, f64::max);
        let [of_fluid, of_wall] = {
            let [meets_fluid, meets_wall, meets_mirror_point] =
                [&*fluid, &*wall, mirror_points].map(|cells| planes.meets(cells, farthest));
            let of_fluid = planes.images(fluid.points(), farthest, |p| {
                let source = &fluid.points()[p.index as usize];
                source.meets(p) || meets_fluid(p) || meets_wall(p) || meets_mirror_point(p)
            });
            [of_fluid, planes.images(wall.points(), farthest, meets_fluid)]
        };
        planes.append(&of_fluid, fluid, fluid_images, fluid_shifts);
        planes.append(&of_wall, wall, wall_images, wall_shifts);
    }

    /// What lists and skins hold on to [bytes].
    pub(crate) fn bytes(&self) -> [(&'static str, usize); 4] {
        let of_walls = [&self.fluid_of_wall, &self.fluid_of_mirror].map(Lists::bytes).iter().sum::<usize>();
        let skins = [&self.skin, &self.wall_skin, &self.mirror_skin].map(Skin::bytes).iter().sum::<usize>();
        let images = [&self.fluid_images, &self.wall_images].map(of_vector).iter().sum::<usize>();
        let shifts = [&self.fluid_shifts, &self.wall_shifts].map(of_vector).iter().sum::<usize>();
        [
            ("lists of fluid", self.fluid.bytes()),
            ("lists of walls", self.walls_of_fluid.bytes() + of_walls),
            ("skins", skins),
            ("images", images + shifts),
        ]
    }

    /// The particle behind listed index `j` of `n` particles and their images.
    #[inline(always)]
    pub fn source(&self, j: u32, n: usize) -> usize {
        source(j as usize, n, &self.fluid_images)
    }

    /// The wall particle behind listed index `j` of `n` wall particles and their images.
    #[inline(always)]
    pub(crate) fn wall_source(&self, j: usize, n: usize) -> usize {
        source(j, n, &self.wall_images)
    }

    /// Who is, or has within reach, a free-surface particle (by the λ found last).
    pub(crate) fn flag_surface(&self, fields: &mut Fields) {
        let n = fields.moments.len();
        if parallel::every(n, |k| !fields.moments[k].at_surface()) {
            parallel::update(&mut fields.near_surface, |_, near| *near = false);
            return;
        }
        let mut at_surface = vec![false; n + self.fluid_images.len()];
        parallel::gather_into(&mut at_surface[..n], |k| fields.moments[k].at_surface());
        for (k, &source) in self.fluid_images.iter().enumerate() {
            at_surface[n + k] = at_surface[source as usize];
        }
        self.fluid.meet_any(&at_surface, &mut fields.near_surface);
    }
}

/// What listed index `j` stands for: one of `n`, or the source of an image beyond them.
#[inline(always)]
fn source(j: usize, n: usize, images: &[u32]) -> usize {
    if j < n { j } else { images[j - n] as usize }
}

fn moving(p: &Particles) -> Moving<'_> {
    Moving { at: [&p.x, &p.y], velocity: [&p.u, &p.v], h: &p.h }
}

/// OP9: a particle that has left the cell enters it through the opposite plane.
fn wrap(particles: &mut Particles, periodic: Option<Periodic>) {
    let Some(periodic) = periodic else { return };
    parallel::each([&mut particles.x, &mut particles.y], |_, [x, y]| {
        for (x, y) in x.iter_mut().zip(y) {
            [*x, *y] = periodic.wrap([*x, *y]);
        }
    });
}
