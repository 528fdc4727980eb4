//! Particles as packed points.

use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{PackedElementField, PointCloud};
use sph_core::parallel;

use super::pose::identity_pose;
use super::{LogError, Stamp, WORLD_FRAME};

/// The fields of a packed point, in order; each takes [`FIELD_SIZE`] bytes, little-endian.
const FIELDS: [(&str, NumericType); 8] = [
    ("x", NumericType::Float32),
    ("y", NumericType::Float32),
    ("z", NumericType::Float32),
    ("pressure", NumericType::Float32),
    ("speed", NumericType::Float32),
    ("density", NumericType::Float32),
    ("spacing", NumericType::Float32),
    ("id", NumericType::Uint32),
];

const FIELD_SIZE: usize = 4;
const POINT_SIZE: usize = FIELDS.len() * FIELD_SIZE;

/// Points that are packed in one go.
const PIECE: usize = 1024;

/// The particles of one frame; every slice has shape (number of particles).
///
/// The log keeps single precision (relative rounding 6·10⁻⁸) and the speed √(vx² + vy²) [m/s]
/// in place of the velocity. Values that are not finite are written as they are.
#[derive(Clone, Copy, Debug, Default)]
pub struct ParticleView<'a> {
    /// Horizontal positions [m].
    pub x: &'a [f64],
    /// Vertical positions [m].
    pub y: &'a [f64],
    /// Horizontal velocities [m/s].
    pub vx: &'a [f64],
    /// Vertical velocities [m/s].
    pub vy: &'a [f64],
    /// Pressures [Pa].
    pub pressure: &'a [f64],
    /// Densities [kg/m³].
    pub density: &'a [f64],
    /// Spacings [m]: the square root of the volume of a particle per metre of span [m²].
    pub spacing: &'a [f64],
    /// Identities, which stay with a particle when its place in the slices changes.
    pub id: &'a [u32],
}

impl ParticleView<'_> {
    /// The number of particles, if the slices agree on it.
    fn len(&self, topic: &'static str) -> Result<usize, LogError> {
        let expected = self.x.len();
        let others = [
            ("y", self.y.len()),
            ("vx", self.vx.len()),
            ("vy", self.vy.len()),
            ("pressure", self.pressure.len()),
            ("density", self.density.len()),
            ("spacing", self.spacing.len()),
            ("id", self.id.len()),
        ];
        match others.into_iter().find(|&(_, found)| found != expected) {
            None => Ok(expected),
            Some((field, found)) => Err(LogError::Length { topic, field, expected, found }),
        }
    }
}

/// The particles as the point cloud of `topic`, in the frame `world`.
pub(super) fn point_cloud(
    topic: &'static str,
    stamp: Stamp,
    particles: &ParticleView<'_>,
) -> Result<PointCloud, LogError> {
    let count = particles.len(topic)?;
    let mut data = vec![0; count * POINT_SIZE];
    parallel::update_pieces(&mut data, PIECE * POINT_SIZE, |piece, bytes| {
        for (k, point) in bytes.chunks_exact_mut(POINT_SIZE).enumerate() {
            pack(point, particles, piece * PIECE + k);
        }
    });
    Ok(PointCloud {
        timestamp: Some(stamp.timestamp()),
        frame_id: WORLD_FRAME.to_owned(),
        pose: Some(identity_pose()),
        point_stride: POINT_SIZE as u32,
        fields: packed_fields(),
        data: data.into(),
    })
}

/// Packs particle `i` into the bytes of a point.
fn pack(point: &mut [u8], particles: &ParticleView<'_>, i: usize) {
    let (vx, vy) = (particles.vx[i], particles.vy[i]);
    let values = [
        particles.x[i],
        particles.y[i],
        0.0,
        particles.pressure[i],
        (vx * vx + vy * vy).sqrt(),
        particles.density[i],
        particles.spacing[i],
    ];
    let (numbers, id) = point.split_at_mut(values.len() * FIELD_SIZE);
    for (field, value) in numbers.chunks_exact_mut(FIELD_SIZE).zip(values) {
        field.copy_from_slice(&(value as f32).to_le_bytes());
    }
    id.copy_from_slice(&particles.id[i].to_le_bytes());
}

/// The description of a packed point that goes with every cloud.
fn packed_fields() -> Vec<PackedElementField> {
    FIELDS
        .iter()
        .enumerate()
        .map(|(i, &(name, numeric_type))| PackedElementField {
            name: name.to_owned(),
            offset: (i * FIELD_SIZE) as u32,
            r#type: numeric_type.into(),
        })
        .collect()
}
