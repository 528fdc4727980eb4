//! One picture of a run: particles as packed points, bodies as outlines in frames of their own.

use foxglove::Encode;
use foxglove::messages::line_primitive::Type;
use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{
    Color, FrameTransform, FrameTransforms, LinePrimitive, PackedElementField, Point3, PointCloud, Pose, Quaternion,
    SceneEntity, SceneUpdate, Timestamp, Vector3,
};
use sph_core::parallel;

use super::error::LogError;

/// The frame of reference of the simulation: x right, y up, z towards the viewer [m].
const WORLD_FRAME: &str = "world";

/// The fields of a packed point, in order; each takes [`FIELD_SIZE`] bytes, little-endian; `id` is an integer.
const FIELDS: [&str; 10] = ["x", "y", "z", "pressure", "speed", "density", "spacing", "id", "vx", "vy"];
const FIELD_SIZE: usize = 4;
pub(super) const POINT_SIZE: usize = FIELDS.len() * FIELD_SIZE;

/// Points per task.
const PIECE: usize = 1024;

/// The width of an outline as viewers draw it [pixels].
const OUTLINE_THICKNESS: f64 = 2.0;

/// Orange, which stands out from water and walls on a light and on a dark ground.
const OUTLINE_COLOR: Color = Color { r: 1.0, g: 0.5, b: 0.0, a: 1.0 };

/// The first time [s] past the clock, whose seconds are a `u32`.
const CLOCK_END: f64 = 4_294_967_296.0;

/// Simulated time [s], rounded to whole nanoseconds, in [0, 2³²) s. Foxglove's own conversion truncates.
pub fn stamp(time: f64) -> Result<Timestamp, LogError> {
    if !(0.0..CLOCK_END).contains(&time) {
        return Err(LogError::Time(time));
    }
    let nanoseconds = (time * 1e9).round() as u64;
    Ok(Timestamp::new((nanoseconds / 1_000_000_000) as u32, (nanoseconds % 1_000_000_000) as u32))
}

/// A particle of a frame. The log keeps single precision (relative rounding 6·10⁻⁸); values that are not finite are written as
/// they are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Point {
    /// Position [m].
    pub at: [f64; 2],
    /// Pressure [Pa].
    pub pressure: f64,
    /// Velocity [m/s].
    pub velocity: [f64; 2],
    /// Density [kg/m³].
    pub density: f64,
    /// Spacing [m]: the square root of the particle's volume per metre of span [m²].
    pub spacing: f64,
    /// Identity, which stays with a particle when its place among the others changes; with the bit [`IMAGE`] of its image.
    pub id: u32,
}

/// Bit of the identity of a particle's image in the plane of symmetry.
pub const IMAGE: u32 = 1 << 31;

impl Point {
    /// Its image in the plane of symmetry at `plane` [m].
    pub fn image(&self, plane: f64) -> Point {
        let ([x, y], [u, v]) = (self.at, self.velocity);
        Point { at: [2.0 * plane - x, y], velocity: [-u, v], id: self.id | IMAGE, ..*self }
    }

    /// True of an image.
    pub fn is_image(&self) -> bool {
        self.id & IMAGE != 0
    }
}

/// A body of one frame.
#[derive(Clone, Copy, Debug)]
pub struct BodyView<'a> {
    /// The name, unique among the bodies; the frame of the body is `body/NAME`.
    pub name: &'a str,
    /// The origin of the frame of the body, in the world [m].
    pub position: [f64; 2],
    /// The angle from the world to the frame of the body, counter-clockwise [rad].
    pub angle: f64,
    /// The corners of the outline in the frame of the body [m], a closed polygon: the last
    /// corner joins the first.
    pub outline: &'a [[f64; 2]],
}

/// One picture of a run: what [`LogWriter::frame`](super::LogWriter::frame) writes as one message on each of `/fluid`,
/// `/walls`, `/scene` and `/tf`. It owns what it shows: the run may go on.
pub struct Frame {
    /// Time as a stamp of the log.
    pub stamp: Timestamp,
    pub(super) time: f64,
    /// The water.
    pub fluid: PointCloud,
    /// The boundary particles.
    pub walls: PointCloud,
    /// Outlines of the bodies.
    pub scene: SceneUpdate,
    /// Frames of the bodies.
    pub tf: FrameTransforms,
}

impl Frame {
    /// The picture at `time` [s].
    ///
    /// # Errors
    /// [`LogError::Time`].
    pub fn new(time: f64, fluid: &[Point], walls: &[Point], bodies: &[BodyView<'_>]) -> Result<Frame, LogError> {
        let stamp = stamp(time)?;
        Ok(Frame {
            stamp,
            time,
            fluid: point_cloud(stamp, fluid),
            walls: point_cloud(stamp, walls),
            scene: SceneUpdate {
                deletions: Vec::new(),
                entities: bodies.iter().map(|body| outline(stamp, body)).collect(),
            },
            tf: FrameTransforms { transforms: bodies.iter().map(|body| transform(stamp, body)).collect() },
        })
    }

    /// Bytes of its messages before compression.
    pub(super) fn raw_bytes(&self) -> u64 {
        let messages =
            [self.fluid.encoded_len(), self.walls.encoded_len(), self.scene.encoded_len(), self.tf.encoded_len()];
        messages.into_iter().flatten().sum::<usize>() as u64
    }
}

/// Particles in the frame `world`.
fn point_cloud(stamp: Timestamp, particles: &[Point]) -> PointCloud {
    let mut data = vec![0; particles.len() * POINT_SIZE];
    parallel::update_pieces(&mut data, PIECE * POINT_SIZE, |piece, bytes| {
        for (bytes, point) in bytes.chunks_exact_mut(POINT_SIZE).zip(&particles[piece * PIECE..]) {
            pack(bytes, point);
        }
    });
    let field = |(i, name): (usize, &&str)| PackedElementField {
        name: name.to_string(),
        offset: (i * FIELD_SIZE) as u32,
        r#type: if *name == "id" { NumericType::Uint32 } else { NumericType::Float32 }.into(),
    };
    PointCloud {
        timestamp: Some(stamp),
        frame_id: WORLD_FRAME.to_owned(),
        pose: Some(identity_pose()),
        point_stride: POINT_SIZE as u32,
        fields: FIELDS.iter().enumerate().map(field).collect(),
        data: data.into(),
    }
}

fn pack(bytes: &mut [u8], point: &Point) {
    let Point { at: [x, y], pressure, velocity: [u, v], density, spacing, id } = *point;
    let speed = (u * u + v * v).sqrt();
    let number = |value: f64| (value as f32).to_le_bytes();
    let [x, y, z, pressure, speed, density, spacing, u, v] =
        [x, y, 0.0, pressure, speed, density, spacing, u, v].map(number);
    let fields = [x, y, z, pressure, speed, density, spacing, id.to_le_bytes(), u, v];
    bytes.copy_from_slice(fields.as_flattened());
}

/// The point that [`pack`] wrote into the first [`POINT_SIZE`] bytes.
pub(super) fn unpack(bytes: &[u8]) -> Point {
    let field = |k: usize| std::array::from_fn(|i| bytes[k * FIELD_SIZE + i]);
    let value = |k: usize| f64::from(f32::from_le_bytes(field(k)));
    Point {
        at: [value(0), value(1)],
        pressure: value(3),
        velocity: [value(8), value(9)],
        density: value(5),
        spacing: value(6),
        id: u32::from_le_bytes(field(7)),
    }
}

/// The outline, locked to the frame of its body; it replaces that of the last frame.
fn outline(stamp: Timestamp, body: &BodyView<'_>) -> SceneEntity {
    let line = LinePrimitive {
        r#type: Type::LineLoop.into(),
        pose: Some(identity_pose()),
        thickness: OUTLINE_THICKNESS,
        scale_invariant: true,
        points: body.outline.iter().map(|&[x, y]| Point3 { x, y, z: 0.0 }).collect(),
        color: Some(OUTLINE_COLOR),
        ..LinePrimitive::default()
    };
    SceneEntity {
        timestamp: Some(stamp),
        frame_id: body_frame(body),
        id: body_frame(body),
        frame_locked: true,
        lines: vec![line],
        ..SceneEntity::default()
    }
}

/// The frame of a body in the world.
fn transform(stamp: Timestamp, body: &BodyView<'_>) -> FrameTransform {
    FrameTransform {
        timestamp: Some(stamp),
        parent_frame_id: WORLD_FRAME.to_owned(),
        child_frame_id: body_frame(body),
        translation: Some(Vector3 { x: body.position[0], y: body.position[1], z: 0.0 }),
        rotation: Some(rotation_about_z(body.angle)),
    }
}

fn body_frame(body: &BodyView<'_>) -> String {
    format!("body/{}", body.name)
}

/// The pose of what sits at the origin of its frame.
fn identity_pose() -> Pose {
    Pose { position: Some(Vector3::default()), orientation: Some(rotation_about_z(0.0)) }
}

/// The unit quaternion of a rotation by `angle` [rad] about z: (0, 0, sin(angle/2), cos(angle/2)).
fn rotation_about_z(angle: f64) -> Quaternion {
    let (sin, cos) = (0.5 * angle).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_round_to_the_nearest_nanosecond() {
        // In f64, 1.001e9 comes out as 1000999999.9999999: truncation would lose 1 ns.
        assert_eq!(stamp(1.001).expect("a time within the clock"), Timestamp::new(1, 1_000_000));
    }

    #[test]
    fn both_ends_of_the_clock_hold() {
        assert_eq!(stamp(-0.0).unwrap().total_nanos(), 0);
        assert_eq!(stamp(CLOCK_END.next_down()).expect("the last time").sec(), u32::MAX);
        for time in [-1e-12, CLOCK_END, f64::NAN, f64::INFINITY] {
            let Err(LogError::Time(reported)) = stamp(time) else {
                panic!("{time} s was accepted");
            };
            assert_eq!(reported.to_bits(), time.to_bits());
        }
    }
}
