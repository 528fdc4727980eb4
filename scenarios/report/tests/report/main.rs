//! The report: pictures decode to what was drawn, charts are well-formed whatever the data, the page
//! needs nothing else.

mod charts;
mod page;
mod pictures;
mod xml;

/// Text that would break a page which does not escape it.
const HOSTILE: &str = "</svg><script>alert('1')</script> & \"q\" $x^2$ \u{0}\u{1b}\u{1f30a}";
