//! Scenes, runs, observers and reports: what the `splashdown` command is made of.
//!
//! [`scene`] reads a scene, [`build`] makes fluid and bodies of it, [`run`] steps them, [`observers`] watch,
//! [`compare`] judges against [`reference`] data, [`report`] writes the page. [`study`] extrapolates from
//! several runs, [`chart`] sets their error against their cost, [`atlas`] maps where they are stable, [`ditching`] lands
//! aeroplanes by their sections, [`bench`] measures the speed on this machine. [`cli`] is a thin shell.

pub mod atlas;
pub mod bench;
pub mod build;
pub mod chart;
pub mod cli;
pub mod compare;
pub mod ditching;
mod embedded;
pub mod error_bar;
mod filling;
pub mod follow;
pub mod forecast;
pub mod ladder;
mod least_squares;
pub mod log;
pub mod observers;
pub mod reference;
pub mod report;
pub mod run;
pub mod scene;
pub mod study;
pub mod validate;
