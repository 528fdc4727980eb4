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
pub(crate) mod run_page;
mod section_picture;
mod table;
mod ticks;

pub(crate) use axis::Axis;
pub use bar::{Bar, Part};
pub use chart::{Chart, Curve, Mark, Paint, TrendLine};
pub use chart_svg::chart_svg;
pub(crate) use colour::CATEGORIES;
pub use colour::{Rgb, viridis};
pub use flow::{FlowFrame, FlowView, flow_png};
pub use flow_figure::flow_svg;
pub(crate) use html::page;
pub use html::{Block, Report, Status, render};
pub(crate) use landing_view::{LandingScales, LandingView, landing_view_svg};
pub(crate) use lead::{COARSE, Card, Lead, Tone, hint_html, lead_html};
pub(crate) use markup::escape;
pub use section_picture::section_picture;
pub use table::{Column, Table};
pub(crate) use table::{known, row};
