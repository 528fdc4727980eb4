//! Columns of joints (THEORY CO38).

use scene::Scene;

use crate::observers::source::{Reader, Source};

pub(in crate::observers) const SOURCE: Source = Source { names, reader };

fn names(scene: &Scene) -> Vec<String> {
    scene.joints.iter().flat_map(|joint| joint.columns()).collect()
}

/// A joint that broke carries nothing.
fn reader(_scene: &Scene) -> Reader {
    Box::new(|frame| {
        let joints = frame.system.joints().into_iter();
        joints
            .flat_map(|joint| {
                let [x, y] = if joint.broken.is_some() { [0.0; 2] } else { joint.force };
                [joint.value, x, y]
            })
            .collect()
    })
}
