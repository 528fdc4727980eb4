//! A scene solved by an entry theory.

use fsi_coupling::Motion as BodyMotion;
use fsi_coupling::geometry::polygon;
use scene::{Body, Gauge, Motion, Scene};
use settings::significant;
use water_entry::{
    Entry, EntryModel, FlowEntry, FlowHistory, Instant, Loads, OutOfRange, RolledInstant, Section, SectionMotion,
};

use super::bending_flow::{BendingFlow, times_every};
use super::elastic_wedge::Faces;
use super::rolled;
use super::upright::{at_start, refuse, upright_entry};
use crate::observers::body_values;

/// Width of the window that means are taken over, the last fifth of the run.
const LATE: f64 = 0.8;
/// Points along the face in which the largest pressure is looked for.
const POINTS: usize = 4000;

/// The solution of a scene by a theory.
#[derive(Clone, Debug)]
pub struct Theory {
    /// The theory.
    pub model: EntryModel,
    /// The body's bottom.
    pub section: Section,
    /// The section at every sample of the scene.
    pub instants: Vec<Instant>,
    density: f64,
    /// Acceleration of gravity whose pressure at rest is to be added to the source's [m/s²].
    gravity: f64,
    source: Source,
}

/// Where loads come from.
#[derive(Clone, Debug)]
enum Source {
    /// A formula.
    Loads(Loads),
    /// A formula, and faces that bend.
    Faces(Loads, Box<Faces>),
    /// A flow that was followed.
    Flow(FlowHistory),
    /// A flow that was followed about a bottom that bends.
    Bending(Box<BendingFlow>),
    /// The flow about a rolled wedge, at every sample.
    Rolled(Vec<RolledInstant>),
}

impl Theory {
    /// Follow the body of a scene into the water.
    ///
    /// # Errors
    /// The feature of the scene outside the theory's range, the range, and the next model that covers it.
    pub fn of(scene: &Scene, model: EntryModel) -> Result<Theory, OutOfRange> {
        let (theory, end) = Theory::while_in_range(scene, model)?;
        end.map_or(Ok(theory), Err)
    }

    /// The same up to the end of the theory's range, with the reason.
    ///
    /// # Errors
    /// The feature of the scene outside the theory's range from the start.
    pub fn while_in_range(scene: &Scene, model: EntryModel) -> Result<(Theory, Option<OutOfRange>), OutOfRange> {
        Theory::solved(scene, model, false)
    }

    /// `steep`: a formula is followed where the bottom gets steeper than its range, and about a rigid bottom in place of one that bends.
    fn solved(scene: &Scene, model: EntryModel, steep: bool) -> Result<(Theory, Option<OutOfRange>), OutOfRange> {
        let (body, section, motion) = upright_entry(scene, model)?;
        if body.bends() && !steep {
            return bending(scene, model, body, section, motion);
        }
        let (draught, speed) = at_start(body, &motion);
        let (gravity, density) = (-scene.gravity[1], scene.water().density);
        let times = sample_times(scene);
        let at_rest = if model.is_formula() { gravity } else { 0.0 };
        let (instants, source, end) = if model.is_formula() {
            let loads = if steep { Loads::before_flow(&section) } else { Loads::new(model, &section)? };
            let entry = Entry { loads: &loads, motion, draught, speed, gravity, density, buoyancy: true, steep };
            let (instants, end) = entry.solve_while_in_range(&times);
            (instants, Source::Loads(loads), end)
        } else if rolled::rolls(scene, model) {
            let (steps, end) = rolled::solve(scene, body, motion, &times)?;
            let deadrise = section.deadrise_deg().unwrap_or_default();
            (steps.iter().map(|now| rolled::as_symmetric(now, deadrise)).collect(), Source::Rolled(steps), end)
        } else {
            model.covers(&section, 0.0)?;
            let entry = FlowEntry { section: &section, motion, draught, speed, gravity, density };
            let (instants, history, end) = entry.solve(&times)?;
            (instants, Source::Flow(history), end)
        };
        let open = instants.iter().take_while(|now| confined(scene, body, now).is_none()).count();
        let closed = instants.get(open).and_then(|now| {
            let what = confined(scene, body, now)?;
            Some(refuse(&format!("from t = {} s on {what}", significant(now.time))))
        });
        let instants = instants[..open].to_vec();
        Ok((Theory { model, section, instants, density, gravity: at_rest, source }, closed.or(end)))
    }

    /// The same without following a flow: where the model is no formula, by the motion of the modified Logvinovich model, which is near.
    ///
    /// # Errors
    /// As [`Theory::while_in_range`]; that a flow breaks up is not known before it is followed.
    pub fn outlined(scene: &Scene, model: EntryModel) -> Result<(Theory, Option<OutOfRange>), OutOfRange> {
        if model.is_formula() {
            return Theory::while_in_range(scene, model);
        }
        let (body, section, motion) = upright_entry(scene, model)?;
        if body.bends() {
            BendingFlow::check(scene, &section)?;
        }
        if rolled::rolls(scene, model) {
            rolled::check(scene, body, motion)?;
            let (instants, source) = (Vec::new(), Source::Rolled(Vec::new()));
            return Ok((
                Theory { model, section, instants, density: scene.water().density, gravity: 0.0, source },
                None,
            ));
        }
        model.covers(&section, 0.0)?;
        let (theory, end) = Theory::solved(scene, EntryModel::Mlm, true)?;
        let breadth = 2.0 * section.half_breadth();
        let chines = section.followed_half_breadth();
        let wet_at_first = body.draught() > 0.0 && theory.instants.first().is_some_and(|now| now.wetted >= chines);
        if wet_at_first {
            return Err(refuse("one whose chines are wet at the start"));
        }
        let too_deep =
            theory.instants.iter().find(|now| now.draught > FlowEntry::DEEPEST * breadth).map(|now| {
                refuse(&format!("from t = {} s on one that is deeper than its breadth", significant(now.time)))
            });
        // deep under a round bottom the formula is not near
        let of_formula = end.filter(|_| !section.is_round());
        let too_steep = theory.instants.iter().find_map(|now| {
            let OutOfRange { what, range, next } = model.covers(&section, now.wetted).err()?;
            Some(OutOfRange { what: format!("{what}, wet from t = {} s on", significant(now.time)), range, next })
        });
        let end = too_deep.or(too_steep).or(of_formula.map(|end| OutOfRange { next: EntryModel::Wcsph, ..end }));
        Ok((Theory { model, section, ..theory }, end))
    }

    /// The same at instants `every` [s] of the same flow; `None` for a theory that is solved for its instants.
    pub(super) fn resampled(&self, end: f64, every: f64) -> Option<Theory> {
        let Source::Bending(flow) = &self.source else { return None };
        Some(Theory { instants: flow.instants(&times_every(every, end)), ..self.clone() })
    }

    /// Why a flow about a round bottom, of which only the first part is outlined, may not be followed to the end: as fast as at the last
    /// instant, and faster by its fall, the body would be under water.
    pub fn may_go_under(&self, scene: &Scene) -> Option<OutOfRange> {
        let body = scene.body.as_ref().filter(|_| !self.model.is_formula() && self.section.is_round())?;
        let last = self.instants.last()?;
        let left = scene.time.end - last.time;
        let g = if matches!(body.motion, Motion::Free(_)) { -scene.gravity[1] } else { 0.0 };
        let reached = last.draught + last.speed * left + 0.5 * g * left * left;
        let [min, max] = polygon::bounding_box(&body.placed_outline());
        let deepest = (max[1] - min[1]).min(FlowEntry::DEEPEST * 2.0 * self.section.half_breadth());
        (reached > deepest)
            .then(|| refuse(&format!("one that may be under water at the end, {} m deep", significant(reached))))
    }

    /// The moment at which a section at unit speed, in water of unit density, without gravity, has come a metre deep.
    ///
    /// # Errors
    /// As [`Loads::new`].
    pub fn at_constant_speed(model: EntryModel, section: Section) -> Result<Theory, OutOfRange> {
        let loads = Loads::new(model, &section)?;
        let (slam, wetted) = (loads.at(1.0).slam, loads.at(1.0).wetted);
        let now = Instant { time: 1.0, draught: 1.0, speed: 1.0, rate: 0.0, force: slam, wetted };
        Ok(Theory { model, section, instants: vec![now], density: 1.0, gravity: 0.0, source: Source::Loads(loads) })
    }

    /// Pressure at distance x from the keel's plane at sample k [Pa]; `None` where the theory has none.
    pub fn pressure(&self, k: usize, x: f64) -> Option<f64> {
        let Instant { time, draught, speed, rate, .. } = self.instants[k];
        match &self.source {
            Source::Flow(history) => Some(history.pressure(time, x)),
            Source::Bending(flow) => Some(flow.pressure(time, x)),
            Source::Rolled(steps) => {
                let along = x.abs() * (1.0 + self.section.slope(0.0).powi(2)).sqrt();
                Some(steps[k].pressure_at(usize::from(x > 0.0), along))
            }
            Source::Loads(loads) | Source::Faces(loads, _) => {
                let at_rest = self.gravity * (draught - self.section.height(x)).max(0.0);
                let of_entry = loads.pressure(x, draught, speed, rate, self.density)?;
                Some(of_entry + self.density * at_rest)
            }
        }
    }

    /// Impulse that a flat keel gives the water at contact [N s/m], which the forces do not contain.
    pub fn impulse_at_contact(&self) -> f64 {
        match &self.source {
            Source::Flow(history) => history.impulse_at_contact(),
            _ => 0.0,
        }
    }

    /// True if the water comes to the chines: by Wagner's wetted width, also where the theory's own is narrower.
    pub fn wets_chines(&self) -> bool {
        let (b, deepest) = (self.section.half_breadth(), self.section.wagner_draught(self.section.half_breadth()));
        self.instants.iter().any(|now| now.wetted >= b || now.draught >= deepest)
    }

    /// True for a wedge that is rolled or moves sideways.
    pub fn rolls(&self) -> bool {
        matches!(self.source, Source::Rolled(..))
    }

    /// True if its faces are elastic.
    pub fn bends(&self) -> bool {
        matches!(self.source, Source::Faces(..) | Source::Bending(..))
    }

    /// The flow about a bottom that bends.
    pub(super) fn bending_flow(&self) -> Option<&BendingFlow> {
        if let Source::Bending(flow) = &self.source { Some(flow) } else { None }
    }

    /// Motion of the body and the force on it, at every sample.
    pub fn motions(&self, body: &Body) -> Vec<BodyMotion> {
        let ([x, y], start) = (body.position, body.draught());
        let at = |(k, now): (usize, &Instant)| {
            let (sideways, moment) = match &self.source {
                Source::Rolled(steps) => (steps[k].force[0], steps[k].moment),
                _ => (0.0, 0.0),
            };
            BodyMotion {
                position: [x + body.velocity[0] * now.time, y - (now.draught - start)],
                angle: body.angle_deg.to_radians(),
                velocity: [body.velocity[0], -now.speed],
                acceleration: [0.0, -now.rate],
                force: [sideways, now.force],
                moment,
                ..BodyMotion::default()
            }
        };
        self.instants.iter().enumerate().map(at).collect()
    }

    /// Rows of the series: time, then the body's columns and the gauges; NaN for a quantity that the theory does not have.
    pub fn rows(&self, scene: &Scene) -> Vec<Vec<f64>> {
        let Some(body) = &scene.body else { return Vec::new() };
        let middle = body.middle() - body.position[0];
        let row = |(k, (now, motion)): (usize, (&Instant, &BodyMotion))| {
            let gauge = |g: &Gauge| match self.is_on_bottom(body, g) {
                true => self.pressure(k, g.at[0] - middle).unwrap_or(f64::NAN),
                false => f64::NAN, // theories of entry have no pressure on sides and deck
            };
            let rest = match &self.source {
                Source::Faces(_, faces) => faces.values(now.time),
                Source::Bending(flow) => {
                    flow.columns(now.time).into_iter().chain(scene.gauges.iter().map(gauge)).collect()
                }
                Source::Loads(_) | Source::Flow(_) | Source::Rolled(_) => scene.gauges.iter().map(gauge).collect(),
            };
            std::iter::once(now.time).chain(body_values(motion).map(|(_, value)| value)).chain(rest).collect()
        };
        self.instants.iter().zip(&self.motions(body)).enumerate().map(row).collect()
    }

    /// Is a gauge on the bottom, not on a side or the deck?
    fn is_on_bottom(&self, body: &Body, gauge: &Gauge) -> bool {
        let [low, high] = polygon::bounding_box(&body.shape.outline());
        let section = &self.section;
        let x = gauge.at[0] - 0.5 * (low[0] + high[0]);
        let off = (gauge.at[1] - low[1] - section.height(x)).abs();
        x.abs() <= section.half_breadth() && off < 1e-2 * section.half_breadth()
    }

    /// Pressure coefficient p/(½ρV²) along the face at sample k, at `points` places x/(V t), h for V t [-], shape (n, 2); empty
    /// where the theory has no pressures.
    pub fn profile(&self, k: usize, points: usize) -> Vec<[f64; 2]> {
        let Instant { draught, speed, wetted, .. } = self.instants[k];
        let at = |i: usize| {
            let x = 1.3 * wetted * (i as f64 + 0.5) / points as f64;
            self.pressure(k, x).map(|p| [x / draught, 2.0 * p / (self.density * speed * speed)])
        };
        (0..points).map(at).collect::<Option<_>>().unwrap_or_default()
    }

    /// Largest pressure along the face at sample k [Pa], and its x [m]; `None` where the theory has none, or it is infinite.
    pub fn peak_pressure(&self, k: usize) -> Option<[f64; 2]> {
        if self.model == EntryModel::Wagner {
            return None; // infinite at the spray root
        }
        if let Source::Rolled(steps) = &self.source {
            return Some(rolled::peak_pressure(&steps[k], self.section.deadrise_deg()?));
        }
        let reach = self.instants[k].wetted.min(self.section.half_breadth());
        let at = |i: usize| {
            let x = reach * i as f64 / POINTS as f64;
            Some([self.pressure(k, x)?, x])
        };
        (0..=POINTS)
            .map(at)
            .try_fold([0.0, 0.0], |top: [f64; 2], here| here.map(|p| if p[0] > top[0] { p } else { top }))
    }

    /// Samples of the last fifth of the run.
    pub fn late(&self) -> impl Iterator<Item = usize> + '_ {
        let end = self.instants.last().map_or(0.0, |i| i.time);
        (0..self.instants.len()).filter(move |k| self.instants[*k].time >= LATE * end)
    }
}

/// The same scene with a bottom that bends: by boundary elements, or by Wagner's load on a modal beam.
fn bending(
    scene: &Scene,
    model: EntryModel,
    body: &Body,
    section: Section,
    motion: SectionMotion,
) -> Result<(Theory, Option<OutOfRange>), OutOfRange> {
    model.covers(&section, 0.0)?;
    let times = sample_times(scene);
    if model == EntryModel::BoundaryElement {
        let (flow, end) = BendingFlow::of(scene, body, &section, motion)?;
        let instants = flow.instants(&times);
        let source = Source::Bending(Box::new(flow));
        return Ok((Theory { model, section, instants, density: scene.water().density, gravity: 0.0, source }, end));
    }
    if model != EntryModel::Wagner {
        return Err(OutOfRange {
            what: "panels that bend".into(),
            range: "rigid bodies".into(),
            next: if model < EntryModel::Wagner { EntryModel::Wagner } else { EntryModel::BoundaryElement },
        });
    }
    let (loads, faces) = (Loads::new(model, &section)?, Faces::of(scene, body)?);
    let instants = faces.instants(&times);
    let end = times.get(instants.len()).map(|time| refuse(&format!("from t = {} s on wet chines", significant(*time))));
    let source = Source::Faces(loads, Box::new(faces));
    Ok((Theory { model, section, instants, density: scene.water().density, gravity: 0.0, source }, end))
}

/// Least depth and half width of water that counts as unbounded, in wetted half widths.
const UNBOUNDED: f64 = 4.0;
/// Why theories without deck and walls are not valid at this moment.
fn confined(scene: &Scene, body: &Body, now: &Instant) -> Option<&'static str> {
    let [min, max] = polygon::bounding_box(&body.placed_outline());
    let room = scene.tank.depth.min(0.5 * scene.tank.width - body.middle().abs());
    let near = "water less than four wetted half widths wide or deep (a larger tank.width or tank.depth would do)";
    (now.draught > max[1] - min[1])
        .then_some("a body that is under water")
        .or((UNBOUNDED * now.wetted > room).then_some(near))
}

/// Times of the rows of the series [s].
fn sample_times(scene: &Scene) -> Vec<f64> {
    times_every(scene.time.sample_every, scene.time.end)
}
