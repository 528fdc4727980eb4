//! Curves in one coordinate system.

use super::colour::Rgb;

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// A full line.
    #[default]
    Line,
    /// A dashed line.
    Dashed,
    /// A marker at each point, no line.
    Points,
    /// The outline of a marker at each point, no line.
    Hollow,
}

/// How a curve is painted where its place in the chart does not decide it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Paint {
    /// Its colour.
    pub colour: Option<Rgb>,
    /// Its dashes, 0 for a full line, or the shape of its markers, 0 for a circle.
    pub form: Option<usize>,
    /// Thin and pale, behind what matters.
    pub pale: bool,
}

/// A thin straight line in the colour of a curve, such as a law fitted to it; it has no entry in the legend.
#[derive(Clone, Copy, Debug)]
pub struct TrendLine {
    /// Index of the curve.
    pub curve: usize,
    /// Both ends (x, y).
    pub ends: [[f64; 2]; 2],
}

/// A sequence of points (x, y). If the two arrays differ in length, the longer one's surplus is
/// left out; points with a non-finite coordinate are left out too.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Name in the legend; unnamed curves have no entry there.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// How it is painted.
    pub paint: Paint,
    /// Abscissae, in the unit that [`Chart::x_label`] states.
    pub x: Vec<f64>,
    /// Ordinates, in the unit that [`Chart::y_label`] states.
    pub y: Vec<f64>,
}

impl Curve {
    /// A named curve through points (x, y).
    pub fn new(label: impl Into<String>, mark: Mark, points: impl IntoIterator<Item = [f64; 2]>) -> Curve {
        let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
        Curve { label: label.into(), mark, paint: Paint::default(), x, y }
    }

    /// The same curve, painted otherwise.
    pub fn painted(self, paint: Paint) -> Curve {
        Curve { paint, ..self }
    }
}

/// Curves that share two axes.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Title; empty for none.
    pub title: String,
    /// What is plotted along x, with its unit in brackets.
    pub x_label: String,
    /// What is plotted along y, with its unit in brackets.
    pub y_label: String,
    /// The curves, first at the bottom.
    pub curves: Vec<Curve>,
    /// Entries of the legend, which are curves without points; empty, the curves have an entry each.
    pub legend: Vec<Curve>,
    /// Straight lines that belong to curves, drawn where the axes that follow from the curves show them.
    pub trends: Vec<TrendLine>,
    /// Ends of the x axis; absent, they follow from the curves.
    pub x_range: Option<[f64; 2]>,
    /// Ends of the y axis; absent, they follow from what the x axis shows of the curves.
    pub y_range: Option<[f64; 2]>,
    /// Both axes in powers of ten; ranges are not used, and values ≤ 0 are left out.
    pub logarithmic: bool,
}

impl Chart {
    /// Curves on linear axes whose ends follow from them.
    pub fn new(
        title: impl Into<String>,
        x_label: impl Into<String>,
        y_label: impl Into<String>,
        curves: Vec<Curve>,
    ) -> Chart {
        let (title, x_label, y_label) = (title.into(), x_label.into(), y_label.into());
        Chart { title, x_label, y_label, curves, ..Chart::default() }
    }
}
