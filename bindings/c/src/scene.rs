//! Phases one to three: a scene is specified, sized, and built into an element.

use std::ffi::c_char;
use std::path::PathBuf;

use run::host::{HostedScene, Interface};

use crate::border::guarded;
use crate::buffers;
use crate::element::{ELEMENTS, Element, splashdown_element};
use crate::handles::Handles;
use crate::status::splashdown_status::{SPLASHDOWN_INPUT, SPLASHDOWN_NO_HANDLE};
use crate::status::{Failure, splashdown_status};

/// What of the body the host moves. A function takes it as int32_t.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(clippy::enum_variant_names)]
pub enum splashdown_interface {
    /// One node at the reference point of a rigid body: x, y, angle; forces F_x, F_y, M about it.
    SPLASHDOWN_BODY = 0,
    /// The corners of the body's polygon, or the points of its polyline; straight between them.
    SPLASHDOWN_NODES = 1,
    /// The same with rotations: cubic between them, with moments.
    SPLASHDOWN_TURNING_NODES = 2,
}
use splashdown_interface::*;

/// A scene that is specified and sized.
pub struct splashdown_scene {
    _opaque: [u8; 0],
}

/// Sizes of a scene, before anything that grows with the water is allocated.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct splashdown_scene_sizes {
    /// Nodes that the host moves.
    pub nodes: usize,
    /// 1 if nodes have rotations, 0 if rotations and spins are NULL in every call.
    pub rotations: usize,
    /// Particles of the water at the start.
    pub fluid_particles: usize,
    /// Particles of the walls.
    pub wall_particles: usize,
    /// Memory of the element [bytes].
    pub bytes: u64,
    /// Step of the water at the start [s].
    pub fluid_dt: f64,
    /// Warnings about the scene, to be read by splashdown_warning.
    pub warnings: usize,
    /// Time at the start [s]: below zero where a body starts above the water.
    pub start_time: f64,
}

static SCENES: Handles<HostedScene> = Handles::new("scene");

/// Open a scene: specify the water and the body.
///
/// `scene` is the name of a built-in scene or the path of a TOML file; `settings` are `count` texts "key=value" as of
/// `splashdown run --set`, NULL for none. `interface_kind` is one of splashdown_interface. Every option of a scene file may be used. The
/// motion of the body in the scene only gives what is expected (speed of sound, fine zone): the host moves the body.
///
/// Memory: `scene` and `settings[0..count]` are NULL or texts ended by a zero; `opened` is NULL or points to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_open(
    scene: *const c_char,
    settings: *const *const c_char,
    count: usize,
    interface_kind: i32,
    opened: *mut *mut splashdown_scene,
) -> splashdown_status {
    guarded(|| {
        buffers::expect("opened", opened)?;
        // SAFETY: a text by the contract of the caller.
        let scene = unsafe { buffers::text("scene", scene)? };
        let mut given = Vec::new();
        if count > 0 {
            buffers::expect("settings", settings)?;
            given.resize(count, std::ptr::null());
            // SAFETY: `count` pointers by the contract of the caller.
            unsafe { buffers::read("settings", settings, &mut given)? };
        }
        // SAFETY: texts by the contract of the caller.
        let text = |(k, text): (usize, *const c_char)| unsafe { buffers::text(&format!("settings[{k}]"), text) };
        let settings = given.into_iter().enumerate().map(text).collect::<Result<Vec<_>, _>>()?;
        let hosted = HostedScene::open(&scene, &settings, interface_of(interface_kind)?)?;
        // SAFETY: checked above.
        unsafe { buffers::write_one("opened", SCENES.add(hosted), opened) }
    })
}

fn interface_of(number: i32) -> Result<Interface, Failure> {
    let known = [
        (SPLASHDOWN_BODY, Interface::Body),
        (SPLASHDOWN_NODES, Interface::Nodes),
        (SPLASHDOWN_TURNING_NODES, Interface::TurningNodes),
    ];
    let found = known.into_iter().find(|(of_c, _)| *of_c as i32 == number);
    found.map(|(_, interface)| interface).ok_or_else(|| {
        let expected = "SPLASHDOWN_BODY (0), SPLASHDOWN_NODES (1) or SPLASHDOWN_TURNING_NODES (2)";
        Failure::new(SPLASHDOWN_INPUT, format!("interface: given {number}, expected {expected}"))
    })
}

/// Sizes of the scene: nodes, particles, bytes, step.
///
/// Memory: `sizes` is NULL or points to a structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_sizes(
    scene: *const splashdown_scene,
    sizes: *mut splashdown_scene_sizes,
) -> splashdown_status {
    guarded(|| {
        SCENES.with(scene, |scene| {
            let found = splashdown_scene_sizes {
                nodes: scene.nodes().len(),
                rotations: usize::from(!scene.nodes().rotation.is_empty()),
                fluid_particles: scene.fluid_particles(),
                wall_particles: scene.wall_particles(),
                bytes: scene.bytes(),
                fluid_dt: scene.fluid_dt(),
                warnings: scene.warnings().len(),
                start_time: scene.time(),
            };
            // SAFETY: a structure by the contract of the caller.
            unsafe { buffers::write_one("sizes", found, sizes) }
        })
    })
}

/// Warning `index` of the scene, UTF-8, ended by a zero.
///
/// `needed`, unless NULL, gets the bytes that the text needs with its zero, also where `buffer` is NULL or too short and gets
/// nothing (SPLASHDOWN_LENGTH).
///
/// Memory: `buffer` is NULL or points to `length` writable bytes; `needed` is NULL or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_warning(
    scene: *const splashdown_scene,
    index: usize,
    buffer: *mut c_char,
    length: usize,
    needed: *mut usize,
) -> splashdown_status {
    guarded(|| {
        SCENES.with(scene, |scene| {
            let warnings = scene.warnings();
            let warning = warnings.get(index).ok_or_else(|| {
                let message =
                    format!("index: given {index}, expected below the number of warnings, {}", warnings.len());
                Failure::new(SPLASHDOWN_INPUT, message)
            })?;
            if !needed.is_null() {
                // SAFETY: a number by the contract of the caller.
                unsafe { buffers::write_one("needed", warning.len() + 1, needed)? };
            }
            let room = if buffer.is_null() { 0 } else { length };
            buffers::expect_room("buffer, bytes", room, warning.len() + 1)?;
            // SAFETY: `length` bytes by the contract of the caller.
            unsafe { buffers::write_cut(warning, buffer, length) };
            Ok(())
        })
    })
}

/// The nodes at the start, with the motion that the scene gives them: `n` nodes into arrays of the caller.
///
/// An array that is not wanted is NULL. Rotations [rad] and spins [rad/s] are NULL where nodes have none.
///
/// Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_scene_nodes(
    scene: *const splashdown_scene,
    positions: *mut f64,
    velocities: *mut f64,
    rotations: *mut f64,
    spins: *mut f64,
    n: usize,
) -> splashdown_status {
    guarded(|| {
        SCENES.with(scene, |scene| {
            // SAFETY: of the lengths by the contract of the caller.
            unsafe { buffers::write_nodes(scene.nodes(), [positions, velocities, rotations, spins], n) }
        })
    })
}

/// Record the run in `folder`: log.mcap, series.csv, summary.json and report.html as of `splashdown run`.
///
/// `replace` is 1 to replace a run that is there, 0 to refuse the folder. What was recorded after
/// splashdown_save is discarded by splashdown_restore; the report is written by splashdown_finish.
///
/// Memory: `folder` is NULL or a text ended by a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_record(
    scene: *mut splashdown_scene,
    folder: *const c_char,
    replace: i32,
) -> splashdown_status {
    guarded(|| {
        // SAFETY: a text by the contract of the caller.
        let folder = PathBuf::from(unsafe { buffers::text("folder", folder)? });
        SCENES.with_slot(scene, |slot| {
            *slot = slot.take().map(|scene| scene.recording(folder, replace != 0).with_page(report::page_of_run));
            Ok(())
        })
    })
}

/// Build the water at the start; the only phase that allocates what grows with the water.
///
/// The nodes stand where splashdown_scene_nodes has them; their velocities are what they start with.
///
/// On SPLASHDOWN_OK the scene is consumed: its handle is gone. After an error it is as before.
///
/// Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values; `element` is NULL or points
/// to a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn splashdown_build(
    scene: *mut splashdown_scene,
    positions: *const f64,
    velocities: *const f64,
    rotations: *const f64,
    spins: *const f64,
    n: usize,
    element: *mut *mut splashdown_element,
) -> splashdown_status {
    guarded(|| {
        buffers::expect("element", element)?;
        let built = SCENES.with_slot(scene, |slot| {
            let gone = || Failure::new(SPLASHDOWN_NO_HANDLE, "scene: given a handle that was consumed");
            let scene = slot.as_ref().ok_or_else(gone)?;
            let mut nodes = scene.nodes().clone();
            // SAFETY: of the lengths by the contract of the caller.
            unsafe { buffers::read_nodes([positions, velocities, rotations, spins], n, &mut nodes)? };
            let run = scene.clone().build(&nodes)?;
            *slot = None;
            Ok(Element::new(run, nodes))
        })?;
        // SAFETY: checked above.
        unsafe { buffers::write_one("element", ELEMENTS.add(built), element) }
    })
}

/// Free a scene that was not built. NULL is allowed.
#[unsafe(no_mangle)]
pub extern "C" fn splashdown_free_scene(scene: *mut splashdown_scene) -> splashdown_status {
    guarded(|| SCENES.free(scene))
}
