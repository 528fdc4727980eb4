//! Names in the file.

/// The frame of reference of the simulation: x right, y up, z towards the viewer [m].
pub(super) const WORLD_FRAME: &str = "world";

/// The name of the program, in the metadata and as the source of its notes.
pub(super) const PROGRAM: &str = "splashdown";

/// The name under which the log keeps the resolved scene.
pub(super) const RESOLVED_SCENE: &str = "scene.resolved.toml";

pub(super) const FLUID: &str = "/fluid";
pub(super) const WALLS: &str = "/walls";
pub(super) const SCENE: &str = "/scene";
pub(super) const TF: &str = "/tf";
pub(super) const LOG: &str = "/log";

/// The topics of fixed meaning, which samples may not use.
pub(super) const FIXED_TOPICS: [&str; 5] = [FLUID, WALLS, SCENE, TF, LOG];
