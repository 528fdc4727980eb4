//! Pictures of the flow, charts, and the page that presents a run.
//!
//! Pure functions from data to bytes, usable on their own: [`flow_png`] draws particles, [`flow_svg`] adds time and
//! scales, [`chart_svg`] draws curves, [`render`] puts drawings, charts, tables and text on one self-contained HTML
//! page. Same input, same bytes.

mod axis;
mod bar;
mod canvas;
mod chart;
mod chart_svg;
mod colour;
mod decimate;
mod flow;
mod flow_figure;
mod html;
mod landing_view;
mod lead;
mod markup;
pub mod run_page;
mod section_picture;
mod table;
mod ticks;

use std::error::Error;
use std::path::Path;

pub use axis::Axis;
pub use bar::{Bar, Part};
pub use chart::{Chart, Curve, Mark, Paint, TrendLine};
pub use chart_svg::chart_svg;
pub use colour::CATEGORIES;
pub use colour::{Rgb, viridis};
pub use flow::{FlowFrame, FlowView, flow_png};
pub use flow_figure::flow_svg;
pub use html::page;
pub use html::{Block, Report, Status, render};
pub use landing_view::{LandingScales, LandingView, landing_view_svg};
pub use lead::{COARSE, Card, Lead, Tone, hint_html, lead_html};
pub use markup::escape;
pub use section_picture::section_picture;
pub use table::{Column, Table};
pub use table::{known, row};

/// The page of the run in a folder, `report.html`, as [`run::RunOptions::page`] takes it.
///
/// # Errors
/// The folder holds no run.
pub fn page_of_run(dir: &Path) -> Result<String, Box<dyn Error + Send + Sync>> {
    Ok(run_page::report(dir)?)
}
