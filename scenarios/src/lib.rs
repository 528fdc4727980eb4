//! Scenes, runs, observers and reports: what the `splashdown` command is made of.
//!
//! [`scene`] reads a scene, [`build`] makes fluid and bodies of it, [`run`] steps them, [`observe`] watches,
//! [`compare`] judges against [`reference`] data, [`present`] writes the report. [`study`] extrapolates from
//! several runs, [`chart`] sets their error against their cost, [`atlas`] maps where they are stable, [`ditching`] lands
//! aeroplanes by their sections, [`bench`] measures the speed on this machine. [`cli`] is a thin shell.

pub mod atlas;
pub mod balance;
pub mod bench;
pub mod build;
pub mod chart;
pub mod cli;
pub mod compare;
pub mod ditching;
mod embedded;
pub mod error_bar;
pub mod follow;
pub mod forecast;
mod initial_fluid;
pub mod ladder;
mod least_squares;
pub mod log;
pub mod observe;
mod order;
pub mod panel_result;
pub mod present;
mod recorder;
pub mod reference;
pub mod report;
pub mod run;
pub mod scene;
pub mod study;
pub mod summary;
pub mod validate;
