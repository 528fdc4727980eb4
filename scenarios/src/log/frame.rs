//! One picture of a run, ready to be written.

use foxglove::Encode;
use foxglove::messages::{FrameTransforms, PointCloud, SceneUpdate};

use super::bodies::{self, BodyView};
use super::error::LogError;
use super::particles::{self, ParticleView};
use super::stamp::Stamp;
use super::topics::{FLUID, WALLS};

/// One picture of a run: what [`LogWriter::write`](super::LogWriter::write) writes as one message on each of `/fluid`,
/// `/walls`, `/scene` and `/tf`. It owns what it shows: the run may go on.
pub struct Frame {
    pub(super) stamp: Stamp,
    pub(super) time: f64,
    pub(super) fluid: PointCloud,
    pub(super) walls: PointCloud,
    pub(super) scene: SceneUpdate,
    pub(super) tf: FrameTransforms,
}

impl Frame {
    /// The picture at `time` [s].
    ///
    /// # Errors
    /// [`LogError::Time`], [`LogError::Length`].
    pub fn new(
        time: f64,
        fluid: &ParticleView<'_>,
        walls: &ParticleView<'_>,
        bodies: &[BodyView<'_>],
    ) -> Result<Frame, LogError> {
        let stamp = Stamp::from_seconds(time)?;
        Ok(Frame {
            stamp,
            time,
            fluid: particles::point_cloud(FLUID, stamp, fluid)?,
            walls: particles::point_cloud(WALLS, stamp, walls)?,
            scene: bodies::scene_update(stamp, bodies),
            tf: bodies::frame_transforms(stamp, bodies),
        })
    }

    /// Bytes of its messages before compression.
    pub(super) fn raw_bytes(&self) -> u64 {
        let messages =
            [self.fluid.encoded_len(), self.walls.encoded_len(), self.scene.encoded_len(), self.tf.encoded_len()];
        messages.into_iter().flatten().sum::<usize>() as u64
    }
}
