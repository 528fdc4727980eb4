//! Bodies as outlines in frames of their own.

use foxglove::messages::line_primitive::Type;
use foxglove::messages::{
    Color, FrameTransform, FrameTransforms, LinePrimitive, Point3, SceneEntity, SceneUpdate, Vector3,
};

use super::pose::{identity_pose, rotation_about_z};
use super::stamp::Stamp;
use super::topics::WORLD_FRAME;

/// The width of an outline as viewers draw it [pixels].
const OUTLINE_THICKNESS: f64 = 2.0;

/// Orange, which stands out from water and walls on a light and on a dark ground.
const OUTLINE_COLOR: Color = Color { r: 1.0, g: 0.5, b: 0.0, a: 1.0 };

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

impl BodyView<'_> {
    /// The frame of the body, which also identifies its outline.
    fn frame(&self) -> String {
        format!("body/{}", self.name)
    }
}

/// The outlines, each locked to the frame of its body; one frame replaces those of the last.
pub(super) fn scene_update(stamp: Stamp, bodies: &[BodyView<'_>]) -> SceneUpdate {
    let entities = bodies.iter().map(|body| SceneEntity {
        timestamp: Some(stamp.timestamp()),
        frame_id: body.frame(),
        id: body.frame(),
        frame_locked: true,
        lines: vec![outline(body.outline)],
        ..SceneEntity::default()
    });
    SceneUpdate { deletions: Vec::new(), entities: entities.collect() }
}

/// The frames of the bodies in the world.
pub(super) fn frame_transforms(stamp: Stamp, bodies: &[BodyView<'_>]) -> FrameTransforms {
    let transforms = bodies.iter().map(|body| FrameTransform {
        timestamp: Some(stamp.timestamp()),
        parent_frame_id: WORLD_FRAME.to_owned(),
        child_frame_id: body.frame(),
        translation: Some(Vector3 { x: body.position[0], y: body.position[1], z: 0.0 }),
        rotation: Some(rotation_about_z(body.angle)),
    });
    FrameTransforms { transforms: transforms.collect() }
}

/// The outline through `corners`, in the frame of its body.
fn outline(corners: &[[f64; 2]]) -> LinePrimitive {
    LinePrimitive {
        r#type: Type::LineLoop.into(),
        pose: Some(identity_pose()),
        thickness: OUTLINE_THICKNESS,
        scale_invariant: true,
        points: corners.iter().map(|&[x, y]| Point3 { x, y, z: 0.0 }).collect(),
        color: Some(OUTLINE_COLOR),
        ..LinePrimitive::default()
    }
}
