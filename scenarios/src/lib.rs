//! Scenes, runs, observers and reports: what the `splashdown` command is made of.
//!
//! [`scene`] reads a scene, [`build`] makes fluid and bodies of it, [`run`] steps them, [`observe`] watches,
//! [`compare`] judges against [`reference`] data, [`present`] writes the report. [`model_hierarchy`] runs a scene by a
//! theory, [`experiments`] makes and judges many runs, [`ditching`] lands aeroplanes by their sections, [`bench`] measures the
//! speed on this machine. [`cli`] is a thin shell.

pub mod balance;
pub mod bench;
pub mod build;
pub mod charted;
pub mod cli;
pub mod compare;
pub mod ditching;
mod embedded;
pub mod error_bar;
pub mod experiments;
pub mod follow;
mod initial_fluid;
mod least_squares;
pub mod log;
pub mod model_hierarchy;
pub mod numbers;
pub mod observe;
mod order;
pub mod panel_result;
mod power_law;
pub mod preflight;
pub mod present;
mod recorder;
pub mod reference;
pub mod reference_page;
pub mod report;
pub mod run;
pub mod scene;
pub mod summary;
