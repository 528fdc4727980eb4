//! Poses in the plane, as Foxglove's three-dimensional messages take them.

use foxglove::messages::{Pose, Quaternion, Vector3};

/// The pose of what sits at the origin of its frame.
pub(super) fn identity_pose() -> Pose {
    Pose { position: Some(Vector3::default()), orientation: Some(rotation_about_z(0.0)) }
}

/// The unit quaternion of a rotation by `angle` [rad] about z: (0, 0, sin(angle/2), cos(angle/2)).
pub(super) fn rotation_about_z(angle: f64) -> Quaternion {
    let (sin, cos) = (0.5 * angle).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}
