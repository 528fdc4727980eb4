//! What stands above one run: the library of the `splashdown` command.
//!
//! [`experiments`] makes and judges many runs, [`explain`] says what a scene is, [`sweep`] runs a scene at many points in processes of their own, [`ditching`] lands aeroplanes
//! by their sections, [`certify`] runs the landings that a rule asks for, [`planing`] tows hulls, [`export`] writes files for other programs, [`bench`] measures the speed on this machine. [`cli`] parses arguments and
//! prints. Scenes are read by the crate `scene`, run by `run`, and shown by `report`.

mod axis;
pub mod bench;
pub mod certify;
pub mod cli;
mod data_table;
pub mod ditching;
pub mod experiments;
pub mod explain;
pub mod export;
pub mod live;
pub mod planing;
pub mod preflight;
pub mod reference_page;
pub mod sweep;
pub mod templates;
pub mod thesis_files;
