//! Neighbour lists for fluid and walls, images included, made anew when a particle has gone farther astray than its skin.

pub mod cells;
mod entries;
pub mod images;
pub mod lists;
pub(crate) mod skin;

use serde::{Deserialize, Serialize};

use crate::memory::of_vector;
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::images::{Mirror, Periodic};
use crate::neighbours::lists::Lists;
use crate::neighbours::skin::Skin;
use crate::parallel;
use crate::particles::{Fields, Particles};
use crate::state_bytes::{StateError, expect_count};
use crate::walls::visibility::{Listed, ThinWalls};

/// Skin that even a particle at rest gets, in smoothing lengths.
const SKIN: f64 = 0.06;
/// Share of its way, at its velocity while the lists last, that a particle may go astray.
const ASTRAY: f64 = 0.1;

/// Wall particles at the moment of the search.
#[derive(Clone, Copy)]
pub struct WallKinematics<'a> {
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

/// Neighbour lists. Indices below the number of particles are the particles themselves; those above are
/// images, in the order of [`Neighbours::fluid_images`] and [`Neighbours::wall_images`].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Neighbours {
    /// Fluid (and images) around each fluid particle.
    pub fluid: Lists,
    /// Walls (and images) around each fluid particle.
    pub walls_of_fluid: Lists,
    /// Fluid (and images) around each wall particle.
    pub fluid_of_wall: Lists,
    /// Fluid (and images) around each wall particle's mirror point (LE17); empty where no wall asks.
    pub fluid_of_mirror: Lists,
    /// Sources of the fluid's images.
    pub fluid_images: Vec<u32>,
    /// Sources of the walls' images.
    pub wall_images: Vec<u32>,
    /// Translations of the fluid's images [m], where images repeat (OP9); empty where they reflect.
    pub fluid_shifts: Vec<[f64; 2]>,
    /// Translations of the walls' images [m], likewise.
    pub wall_shifts: Vec<[f64; 2]>,
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

    /// True while every pair that can meet at `now` [s] is listed: one age for all is all that this takes, whatever the clock.
    pub fn holds(&self, particles: &Particles, walls: &WallKinematics, now: f64) -> bool {
        let (since, life) = self.made;
        let age = (now - since).max(0.0).min(life);
        self.skin.holds(&particles.x, &particles.y, age)
            && self.wall_skin.holds(walls.x, walls.y, age)
            && self.mirror_skin.holds(walls.mirror_x, walls.mirror_y, age)
    }

    /// Sort the fluid by cell and list all pairs at `now` [s], to last about `life` [s]. Points stand where velocities take them
    /// in half of that. Beside thin walls particles are expected anywhere around where they are, since masks are made for there.
    pub fn rebuild(
        &mut self,
        particles: &mut Particles,
        fields: &mut Fields,
        walls: &WallKinematics,
        mirror: Option<Mirror>,
        periodic: Option<Periodic>,
        [now, life]: [f64; 2],
    ) {
        wrap(particles, periodic);
        let (half, astray) = (0.5 * life, if walls.thin.is_some() { 1.0 } else { ASTRAY });
        let allow = |h: f64, u: f64, v: f64| SKIN * h + astray * (u * u + v * v).sqrt() * life;
        let expected = |u: &[f64], v: &[f64]| -> Vec<[f32; 2]> {
            let mut velocity = vec![[0.0; 2]; u.len()];
            if walls.thin.is_none() {
                parallel::gather_into(&mut velocity, |k| [u[k] as f32, v[k] as f32]);
            }
            velocity
        };
        let n = particles.len();
        let mut allowance = vec![0.0; n];
        parallel::gather_into(&mut allowance, |k| allow(particles.h[k], particles.u[k], particles.v[k]));
        if let Some(thin) = walls.thin {
            thin.hold_ends(&particles.x, &particles.y, &particles.h, &mut allowance); // WA8
        }
        let mut reach: Vec<f64> = (0..n).map(|k| particles.h[k] + allowance[k]).collect();
        let own = |x: &[f64], y: &[f64], velocity: &[[f32; 2]], reach: &[f64]| -> Vec<Point> {
            let mut points = vec![Point::at_rest([0.0; 2], 0.0, 0); x.len()];
            parallel::gather_into(&mut points, |k| {
                let travel = velocity[k].map(|v| half * f64::from(v));
                Point { x: x[k] + travel[0], y: y[k] + travel[1], reach: reach[k], travel, index: k as u32 }
            });
            points
        };

        // sort the fluid physically, so that a neighbourhood is a few contiguous runs
        let mut fluid_cells =
            Cells::build(&own(&particles.x, &particles.y, &expected(&particles.u, &particles.v), &reach));
        let order: Vec<u32> = fluid_cells.points().iter().map(|p| p.index).collect();
        particles.permute(&order);
        fields.permute(&order);
        allowance = order.iter().map(|&k| allowance[k as usize]).collect();
        reach = order.iter().map(|&k| reach[k as usize]).collect();
        fluid_cells.name_by_order();

        let mut wall_allowance: Vec<f64> =
            (0..walls.x.len()).map(|k| allow(walls.h[k], walls.u[k], walls.v[k])).collect();
        if let Some(thin) = walls.thin {
            thin.hold_ends(walls.x, walls.y, walls.h, &mut wall_allowance);
        }
        let wall_reach: Vec<f64> = (0..walls.x.len()).map(|k| walls.h[k] + wall_allowance[k]).collect();
        let velocity = expected(&particles.u, &particles.v);
        let wall_velocity = expected(walls.u, walls.v);
        let mut fluid = own(&particles.x, &particles.y, &velocity, &reach);
        let mut wall = own(walls.x, walls.y, &wall_velocity, &wall_reach);
        let mirrored = own(walls.mirror_x, walls.mirror_y, &wall_velocity, &wall_reach);
        let mut wall_cells = Cells::build(&wall);
        self.fluid_images.clear();
        self.wall_images.clear();
        if let Some(mirror) = mirror {
            // an image is needed where it has a neighbour in front of the plane
            let meets = |cells: &Cells, p: &Point| cells.any_meets(&reflected(*p, mirror));
            let mirrored_cells = Cells::build(&mirrored);
            let needed = |p: &Point| meets(&fluid_cells, p) || meets(&wall_cells, p) || meets(&mirrored_cells, p);
            self.fluid_images = those(&fluid, needed);
            self.wall_images = those(&wall, |p| meets(&fluid_cells, p));
            append_images(&mut fluid, &self.fluid_images, mirror);
            append_images(&mut wall, &self.wall_images, mirror);
            (fluid_cells, wall_cells) = (Cells::build(&fluid), Cells::build(&wall));
        }
        if let Some(periodic) = periodic {
            self.repeat(periodic, &mut fluid, &mut wall, [&fluid_cells, &wall_cells]);
            (fluid_cells, wall_cells) = (Cells::build(&fluid), Cells::build(&wall));
        }
        let (h, walls_now) = (&particles.h, walls.x.len());
        let (images, wall_images) = (&self.fluid_images, &self.wall_images);
        let fluid_size = |j: u32| h[source(j as usize, n, images)];
        let wall_size = |j: u32| walls.h[source(j as usize, walls_now, wall_images)];
        let (own, wall_own) = (|k: usize| h[k], |k: usize| walls.h[k]);
        self.fluid.build(n, &fluid_cells, |k| fluid[k], true, (own, fluid_size));
        self.walls_of_fluid.build(n, &wall_cells, |k| fluid[k], false, (own, wall_size));
        self.fluid_of_wall.build(walls_now, &fluid_cells, |k| wall[k], false, (wall_own, fluid_size));
        self.fluid_of_mirror.build(mirrored.len(), &fluid_cells, |k| mirrored[k], false, (wall_own, fluid_size));
        if let Some(thin) = walls.thin {
            let listed =
                Listed { fluid: &fluid, wall: &wall, mirrored: &mirrored, wall_images: &self.wall_images, mirror };
            let Neighbours { fluid, walls_of_fluid, fluid_of_wall, fluid_of_mirror, .. } = self;
            thin.mask(&listed, [fluid, walls_of_fluid, fluid_of_wall, fluid_of_mirror]); // WA8, WA9
        }
        self.made = (now, life);
        self.skin.reset(&particles.x, &particles.y, velocity, &allowance);
        self.mirror_skin.reset(walls.mirror_x, walls.mirror_y, wall_velocity.clone(), &wall_allowance);
        self.wall_skin.reset(walls.x, walls.y, wall_velocity, &wall_allowance);
        self.rebuilds += 1;
        self.flag_surface(fields);
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
    pub fn wall_source(&self, j: usize, n: usize) -> usize {
        source(j, n, &self.wall_images)
    }

    /// OP9: append every translation of fluid and wall that has a neighbour in the cell itself.
    fn repeat(&mut self, periodic: Periodic, fluid: &mut Vec<Point>, wall: &mut Vec<Point>, own: [&Cells; 2]) {
        self.fluid_shifts.clear();
        self.wall_shifts.clear();
        let [own_fluid, own_wall] = own;
        let farthest = own_fluid.farthest().max(own_wall.farthest());
        let beside = |points: &[Point]| those(points, |p| periodic.is_beside([p.x, p.y], 2.0 * farthest));
        let (fluids, walls) = (beside(fluid), beside(wall));
        for shift in periodic.shifts() {
            let moved = |p: Point| Point { x: p.x + shift[0], y: p.y + shift[1], ..p };
            let meets = |cells: &Cells, p: &Point| cells.any_meets(p);
            let needed = |p: &Point| meets(own_fluid, &moved(*p)) || meets(own_wall, &moved(*p));
            for k in fluids.iter().copied().filter(|&k| needed(&fluid[k as usize])).collect::<Vec<u32>>() {
                fluid.push(Point { index: fluid.len() as u32, ..moved(fluid[k as usize]) });
                self.fluid_images.push(k);
                self.fluid_shifts.push(shift);
            }
            for &k in walls.iter().filter(|&&k| meets(own_fluid, &moved(wall[k as usize]))).collect::<Vec<_>>() {
                wall.push(Point { index: wall.len() as u32, ..moved(wall[k as usize]) });
                self.wall_images.push(k);
                self.wall_shifts.push(shift);
            }
        }
    }

    /// Who is, or has within reach, a free-surface particle (by the λ found last).
    pub fn flag_surface(&self, fields: &mut Fields) {
        let n = fields.moments.len();
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

/// Indices of the `points` that are wanted, in order.
fn those(points: &[Point], wanted: impl Fn(&Point) -> bool + Sync) -> Vec<u32> {
    let of_chunk = |targets: std::ops::Range<usize>| -> Vec<u32> {
        points[targets].iter().filter(|p| wanted(p)).map(|p| p.index).collect()
    };
    parallel::by_chunk(points.len(), of_chunk).concat()
}

/// OP9: a particle that has left the cell enters it through the opposite plane.
fn wrap(particles: &mut Particles, periodic: Option<Periodic>) {
    let Some(periodic) = periodic else { return };
    for k in 0..particles.len() {
        [particles.x[k], particles.y[k]] = periodic.wrap([particles.x[k], particles.y[k]]);
    }
}

fn append_images(points: &mut Vec<Point>, sources: &[u32], mirror: Mirror) {
    let n = points.len() as u32;
    for (k, &source) in sources.iter().enumerate() {
        let p = points[source as usize];
        points.push(Point { index: n + k as u32, ..reflected(p, mirror) });
    }
}

/// The image of a point.
fn reflected(p: Point, mirror: Mirror) -> Point {
    Point { x: mirror.reflect(p.x), travel: [-p.travel[0], p.travel[1]], ..p }
}
