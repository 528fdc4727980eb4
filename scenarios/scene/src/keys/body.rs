//! The body of a scene.

use fsi_coupling::bodies::prescribed::Law;
use fsi_coupling::geometry::polyline::Polyline;
use fsi_coupling::geometry::{polygon, vector::sub};
use fsi_coupling::{PrescribedBody, RigidMotion, Shape};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::OrTouching;

use super::displacements::Displacements;
use super::modes::Modes;
use super::panel::Panel;
use super::sprung_mass::SprungMass;

/// A body: rigid but for its panels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Body {
    /// A word that starts its columns in the series.
    #[serde(default = "usual_name")]
    pub name: String,
    /// Outline, in the body's frame.
    #[serde(flatten)]
    pub shape: Shape,
    /// File of the points of a polygon or polyline, below the folder of the scene's file: CSV or text (x, y), DAT of airfoils, DXF (LINE,
    /// LWPOLYLINE, POLYLINE, ARC, CIRCLE) or SVG (paths and shapes). A polygon is turned counter-clockwise and closed; points that repeat
    /// are merged.
    #[serde(default, skip_serializing)]
    pub outline: Option<String>,
    /// Unit of the outline's file: m, cm, mm, in or ft. A table whose header states another one is refused. absent:
    /// that which the file states, else m.
    #[serde(default, skip_serializing)]
    pub outline_unit: Option<String>,
    /// Layer of a DXF, or id or label of a group of an SVG, that has the outline. absent: all lines that are visible.
    #[serde(default, skip_serializing)]
    pub outline_layer: Option<String>,
    /// Whether points of a polygon that stand for a curve are joined by arcs of circles (THEORY EN49): at least five in a row with like curvature
    /// and turns below 22 degrees. absent: true without body.panels and body.modal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smooth: Option<bool>,
    /// Table of the motion, motion = "tabulated", below the folder of the scene's file: a header of t and x, y, angle, or the velocities
    /// vx, vy, omega, each with its unit in brackets, such as mm. Displacements count from the first row; velocities are linear between rows.
    #[serde(default, skip_serializing)]
    pub motion_file: Option<String>,
    /// Centre of mass x, y in the body's frame, without the panels [m]. The frame's origin is a wedge's keel, an arc's lowest
    /// point, a box's centre.
    #[schemars(extend("x-default" = "centroid of the outline"))]
    pub center_of_mass: [f64; 2],
    /// How it moves.
    #[serde(flatten)]
    pub motion: Motion,
    /// Velocity x, y of body.center_of_mass at t = 0 [m/s].
    #[serde(default)]
    pub velocity: [f64; 2],
    /// Angular velocity at t = 0, counter-clockwise [deg/s].
    #[serde(default)]
    pub angular_velocity_deg_per_s: f64,
    /// Position x, y of the body frame's origin at t = 0 [m]. touching: x = 0 and the lowest point on the still water.
    #[schemars(with = "OrTouching<[f64; 2]>", extend("x-default" = "touching"))]
    pub position: [f64; 2],
    /// Rotation of the body's frame about its origin at t = 0, counter-clockwise [deg].
    #[serde(default)]
    pub angle_deg: f64,
    /// Rayleigh damping of the panels' motion against the body, by mass and by stiffness; it does not brake the body [1/s, s].
    #[serde(default)]
    #[schemars(extend("x-when" = ".panels"), inner(range(min = 0.0)))]
    pub damping: [f64; 2],
    /// The flexible parts of its surface.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub panels: Vec<Panel>,
    /// Masses on springs that stand on it, where it is free in y alone: seats, equipment. absent: none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sprung_masses: Vec<SprungMass>,
    /// File of the natural modes of its structure (.toml), below the folder of the scene's file: width, nodes, masses, [[modes]] as in
    /// body.modal; frequencies, masses and shapes of any finite-element program.
    #[serde(default, skip_serializing)]
    pub modes_file: Option<String>,
    /// Its structure by natural modes, in place of panels. absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modal: Option<Modes>,
}

/// How a body moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "motion", rename_all = "snake_case")]
#[schemars(extend(
    "x-motion-default" = "free",
    "x-motion-doc" = "Motion of the body; oscillating is a wave generator (thesis, chapter 4)"
))]
pub enum Motion {
    /// By its weight and the water's load.
    Free(Freedom),
    /// At its initial velocity, whatever the load.
    ConstantVelocity,
    /// At rest.
    Fixed,
    /// A prescribed oscillation (CO3).
    Oscillating(Oscillation),
    /// Displacements that were measured, or computed elsewhere.
    Tabulated(Displacements),
}

/// A prescribed oscillation: x(t) = x₀ + A r(t) sin(2π t/T), eased in by r over the first period (CO3).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Oscillation {
    /// Amplitude x, y of the prescribed motion A sin(2 pi t/T), eased in over its first period [m].
    pub amplitude: [f64; 2],
    /// Period T of the prescribed motion [s].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub period: f64,
}

/// Inertia and free directions of a free body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Freedom {
    /// Mass of the whole body, also with symmetry; without its panels and body.modal.masses, which add theirs [kg/m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-ignored-elsewhere" = true))]
    pub mass: f64,
    /// Directions in which a free body can move.
    #[schemars(extend("x-default" = "all; [\"y\"] with symmetry", "x-ignored-elsewhere" = true))]
    pub free: Vec<Axis>,
    /// Moment of inertia of the whole body about its centre of mass; without its panels [kg m²/m].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required if free to rotate", "x-ignored-elsewhere" = true))]
    pub inertia: Option<f64>,
}

/// What moves a body.
pub enum Moved<'a> {
    /// Its weight and the water's load.
    ByLoads(&'a Freedom),
    /// A function of time.
    ByLaw(Law),
}

impl Motion {
    /// Directions x, y and angle in which the velocity at t = 0 may be chosen.
    pub fn has_initial_velocity(&self) -> [bool; 3] {
        match self {
            Motion::Free(freedom) => [freedom.x(), freedom.y(), freedom.inertia.is_some()],
            Motion::ConstantVelocity => [true; 3],
            Motion::Fixed | Motion::Oscillating(_) | Motion::Tabulated(_) => [false; 3],
        }
    }

    /// What moves a body that starts so.
    pub fn moved(&self, start: &RigidMotion) -> Moved<'_> {
        let at_rest = RigidMotion { velocity: [0.0; 2], angular_velocity: 0.0, ..*start };
        let steady = |m: &RigidMotion| PrescribedBody::steady(m.position, m.angle, m.velocity, m.angular_velocity);
        match self {
            Motion::Free(freedom) => Moved::ByLoads(freedom),
            Motion::ConstantVelocity => Moved::ByLaw(steady(start)),
            Motion::Fixed => Moved::ByLaw(steady(&at_rest)),
            Motion::Oscillating(Oscillation { amplitude, period }) => {
                Moved::ByLaw(PrescribedBody::oscillating(start.position, start.angle, *amplitude, *period))
            }
            Motion::Tabulated(table) => {
                let law = PrescribedBody::tabulated(table.motions(start));
                Moved::ByLaw(law.unwrap_or_else(|| steady(&at_rest)))
            }
        }
    }

    /// Largest speed of a motion that is given, beside that of the velocity at t = 0, of points up to `arm` [m] from the origin
    /// [m/s]: 2π A/T of an oscillation.
    fn fastest(&self, arm: f64) -> f64 {
        match self {
            Motion::Oscillating(Oscillation { amplitude: [x, y], period }) => {
                std::f64::consts::TAU * x.hypot(*y) / period
            }
            Motion::Tabulated(table) => table.fastest(arm),
            Motion::Free(_) | Motion::ConstantVelocity | Motion::Fixed => 0.0,
        }
    }
}

/// A direction of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Rotation.
    Angle,
}

impl Freedom {
    /// Free to move along x.
    pub fn x(&self) -> bool {
        self.free.contains(&Axis::X)
    }

    /// Free to move along y.
    pub fn y(&self) -> bool {
        self.free.contains(&Axis::Y)
    }
}

fn usual_name() -> String {
    "body".into()
}

/// Points of a body's frame at `origin` [m], turned by `angle_deg` [deg], in the tank's frame [m].
pub(crate) fn placed(outline: Vec<[f64; 2]>, origin: [f64; 2], angle_deg: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let [x0, y0] = origin;
    outline.into_iter().map(|[x, y]| [x0 + x * cos - y * sin, y0 + x * sin + y * cos]).collect()
}

/// The line that a body's panels lie along [m, body's frame].
pub fn line(shape: &Shape) -> Polyline {
    match shape {
        Shape::Polyline { points, .. } => Polyline::open(points.clone()),
        _ => Polyline::closed(&shape.outline()),
    }
}

/// Length of a panel along the body's line [m].
pub fn panel_length(body: &Body, panel: &Panel) -> f64 {
    let line = line(&body.shape);
    let [from, to] = [panel.from, panel.to].map(|end| line.nearest(end).0);
    line.part(from, to).length()
}

/// The part of the body's line that a panel takes [m, body's frame].
pub fn panel_line(body: &Body, panel: &Panel) -> Vec<[f64; 2]> {
    let line = line(&body.shape);
    let [from, to] = [panel.from, panel.to].map(|end| line.nearest(end).0);
    line.part(from, to).points().to_vec()
}

/// Height of a wedge that is wet, over its draught: the water piles up beside it (Wagner 1932).
pub(crate) const WET_HEIGHT: f64 = std::f64::consts::FRAC_PI_2;
/// Share of a panel over which the water has come when its stress is largest, at least [-].
const MOST: f64 = 0.6;

impl Body {
    /// Names of the panels over most of which the water has not come.
    pub(crate) fn panels_not_passed(&self, now: &fsi_coupling::Motion) -> Vec<String> {
        let ends = |line: Vec<[f64; 2]>| {
            let placed = placed(line, now.position, now.angle.to_degrees());
            let [low, high] = polygon::bounding_box(&placed);
            [low[1], high[1]]
        };
        let draught = -ends(self.shape.outline())[0];
        let is_passed = |panel: &Panel| {
            let [low, high] = ends(panel_line(self, panel));
            low + MOST * (high - low) <= (WET_HEIGHT - 1.0) * draught
        };
        let beyond = self.panels.iter().filter(|panel| draught > 0.0 && !is_passed(panel));
        beyond.map(|panel| panel.name.clone()).collect()
    }

    /// Whether loads move it.
    pub fn is_free(&self) -> bool {
        matches!(self.motion, Motion::Free(_))
    }

    /// Whether a part of its surface bends.
    pub fn bends(&self) -> bool {
        !self.panels.is_empty() || self.modal.is_some()
    }

    /// Outline at t = 0 in the tank's frame [m], shape (n, 2), counter-clockwise.
    pub fn placed_outline(&self) -> Vec<[f64; 2]> {
        placed(self.shape.outline(), self.position, self.angle_deg)
    }

    /// What becomes of it after a table of its motion that ends before `end` [s].
    pub(crate) fn short_table(&self, end: f64) -> Option<String> {
        let Motion::Tabulated(table) = &self.motion else { return None };
        table.short(&self.name, end)
    }

    /// Where a table of its places has a velocity that jumps.
    pub(crate) fn kinks(&self) -> Option<String> {
        let Motion::Tabulated(table) = &self.motion else { return None };
        table.kinks(&self.name).or_else(|| table.jitter(&self.name))
    }

    /// Whether all of it is under the still water at t = 0.
    pub(crate) fn starts_under_water(&self) -> bool {
        self.placed_outline().iter().all(|at| at[1] <= 0.0)
    }

    /// A point of the body's frame in the tank's frame, at t = 0 [m].
    pub fn to_tank(&self, point: [f64; 2]) -> [f64; 2] {
        placed(vec![point], self.position, self.angle_deg)[0]
    }

    /// Velocity at t = 0 of a point of the tank's frame that moves with the body [m/s].
    pub(crate) fn velocity_at(&self, point: [f64; 2]) -> [f64; 2] {
        let turned = |[u, v]: [f64; 2], spin: f64, [x, y]: [f64; 2]| [u - spin * y, v + spin * x];
        let at_rest = RigidMotion { position: self.position, ..RigidMotion::default() };
        match (&self.motion, self.motion.moved(&at_rest)) {
            (Motion::Oscillating(_) | Motion::Tabulated(_), Moved::ByLaw(law)) => {
                let now = law(0.0);
                turned(now.velocity, now.angular_velocity, sub(point, now.position))
            }
            (Motion::Fixed, _) => [0.0; 2],
            _ => {
                let spin = self.angular_velocity_deg_per_s.to_radians();
                turned(self.velocity, spin, sub(point, self.to_tank(self.center_of_mass)))
            }
        }
    }

    /// Bound of the speed of its points at t = 0 [m/s]: |v| + |ω| r, with the farthest vertex at r from the centre of mass;
    /// and that of a motion that is given.
    pub fn fastest_point(&self) -> f64 {
        let [cx, cy] = self.center_of_mass;
        let outline = self.shape.outline();
        let arms = outline.iter().map(|p| (p[0] - cx).hypot(p[1] - cy));
        let angular = self.angular_velocity_deg_per_s.to_radians().abs();
        self.velocity[0].hypot(self.velocity[1])
            + angular * arms.fold(0.0, f64::max)
            + self.motion.fastest(outline.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max))
    }

    /// Depth of its lowest point below the still surface at t = 0 [m]; negative above it.
    pub fn draught(&self) -> f64 {
        let [min, _] = polygon::bounding_box(&self.placed_outline());
        -min[1]
    }

    /// x midway between the body's left and right ends at t = 0 [m].
    pub fn middle(&self) -> f64 {
        let [min, max] = polygon::bounding_box(&self.placed_outline());
        0.5 * (min[0] + max[0])
    }
}
