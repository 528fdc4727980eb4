//! Pictures of the flow, charts, and the page that presents a run.
//!
//! Three pure functions from data to bytes, usable on their own: [`flow_png`] draws particles,
//! [`chart_svg`] draws curves, [`render`] puts pictures, charts, tables and text on one
//! self-contained HTML page. Same input, same bytes.

mod bar;
mod canvas;
mod chart;
mod colour;
mod decimate;
mod flow;
mod footer;
mod html;
mod markup;
pub(crate) mod run_page;
mod table;
mod text;
mod ticks;

pub use bar::{Bar, Part};
pub use chart::{Chart, Curve, Mark, TrendLine, chart_svg};
pub use colour::{Rgb, viridis};
pub use flow::{FlowFrame, FlowView, flow_png};
pub use html::{Block, Report, Status, render};
pub(crate) use markup::escape;
pub use table::Table;
