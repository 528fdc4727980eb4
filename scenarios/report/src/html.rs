//! A report: one HTML page that needs nothing else.

use super::bar::{Bar, bar_svg};
use super::chart::Chart;
use super::chart_svg::untitled_svg;
use super::markup::escape;
use super::table::{Table, table_html};

/// A part of a section. All text is plain: it is shown as written.
#[derive(Clone, Debug)]
pub enum Block {
    /// Running text; an empty line starts a new paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A wide table with links in one of its columns.
    LinkedTable {
        /// The table.
        table: Table,
        /// The column.
        column: usize,
        /// Where its cells lead, row by row.
        links: Vec<Option<String>>,
    },
    /// A chart; its title becomes the caption.
    Chart(Chart),
    /// A whole and its parts; its title becomes the caption.
    Bar(Bar),
    /// A drawing that is an SVG element, such as those of [`flow_svg`](super::flow_svg).
    Drawing {
        /// The element, shown as it is.
        svg: String,
        /// What it shows.
        caption: String,
    },
    /// Elements, shown as they are.
    Html(String),
    /// Text in which spaces and line breaks matter, such as a scene file.
    Code {
        /// Caption; empty for none.
        title: String,
        /// The text.
        text: String,
    },
}

/// How the run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// It reached its end time.
    Completed,
    /// It reached its end time; the heading says what is wrong, each text why.
    Doubtful(String, Vec<String>),
    /// It stopped by itself; the text has cause, place and time.
    Failed(String),
    /// It was stopped from outside.
    Interrupted,
}

/// The content of the page.
#[derive(Clone, Debug)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// A line below the heading; empty for none.
    pub subtitle: String,
    /// How the run ended.
    pub status: Status,
    /// Sections: heading and content.
    pub sections: Vec<(String, Vec<Block>)>,
}

/// Sets `report` as one HTML page: styles, charts, pictures and one script inside, nothing loaded from elsewhere.
///
/// Sections, figures and tables are numbered. The page follows the reader's choice of light or
/// dark, and prints; without a script its charts stand still. Same input, same bytes.
pub fn render(report: &Report) -> String {
    page(&report.title, &header(report), &report.sections)
}

/// A page with `lead`, which is HTML, above its sections.
pub fn page(title: &str, lead: &str, sections: &[(String, Vec<Block>)]) -> String {
    let mut numbers = Numbers::default();
    let section = |(number, (heading, blocks)): (usize, &(String, Vec<Block>))| {
        let (heading, content) = (escape(heading), content(blocks, &mut numbers));
        format!(include_str!("section.html"), number = number, heading = heading, content = content)
    };
    let content: String = (1..).zip(sections).map(section).collect();
    let script = match lead.contains("id=\"player\"") {
        true => concat!(include_str!("plot.js"), include_str!("flow.js")),
        false => include_str!("plot.js"),
    };
    format!(
        include_str!("page.html"),
        title = escape(title),
        style = include_str!("report.css"),
        header = lead.to_owned() + &contents(sections),
        sections = content,
        script = script
    )
}

/// Links to the sections; two sections need none.
fn contents(sections: &[(String, Vec<Block>)]) -> String {
    if sections.len() < 3 {
        return String::new();
    }
    let link = |(number, (heading, _)): (usize, &(String, Vec<Block>))| {
        format!("<li><a href=\"#section-{number}\">{}</a></li>\n", escape(heading))
    };
    format!("<nav><ol>\n{}</ol></nav>\n", (1..).zip(sections).map(link).collect::<String>())
}

/// The numbers given out so far.
#[derive(Default)]
struct Numbers {
    figures: usize,
    tables: usize,
}

/// Title, subtitle and status.
fn header(report: &Report) -> String {
    let mut html = format!("<h1>{}</h1>\n", escape(&report.title));
    if !report.subtitle.is_empty() {
        html += &format!("<p class=\"subtitle\">{}</p>\n", escape(&report.subtitle));
    }
    html += &match &report.status {
        Status::Completed => "<p class=\"status completed\">Completed</p>\n".to_owned(),
        Status::Doubtful(heading, doubts) => {
            let items: String = doubts.iter().map(|doubt| format!("<li>{}</li>", escape(doubt))).collect();
            format!("<div class=\"status doubtful\"><strong>{}</strong><ul>{items}</ul></div>\n", escape(heading))
        }
        Status::Interrupted => "<p class=\"status interrupted\">Interrupted</p>\n".to_owned(),
        Status::Failed(why) => {
            let why = escape(why);
            format!("<p class=\"status failed\"><strong>Failed.</strong> {why}</p>\n")
        }
    };
    html
}

/// The blocks of a section; figures that follow each other stand side by side.
fn content(blocks: &[Block], numbers: &mut Numbers) -> String {
    let is_figure = |block: &Block| matches!(block, Block::Chart(_) | Block::Drawing { .. });
    let mut html = String::new();
    for group in blocks.chunk_by(|a, b| is_figure(a) && is_figure(b)) {
        let inner: String = group.iter().map(|b| block(b, numbers)).collect();
        if group.iter().any(is_figure) {
            html += &format!("<div class=\"figures\">\n{inner}</div>\n");
        } else {
            html += &inner;
        }
    }
    html
}

fn block(block: &Block, numbers: &mut Numbers) -> String {
    match block {
        Block::Text(text) => paragraphs(text),
        Block::Table(table) => {
            numbers.tables += usize::from(!table.title.is_empty());
            table_html(table, numbers.tables, None)
        }
        Block::LinkedTable { table, column, links } => {
            numbers.tables += usize::from(!table.title.is_empty());
            table_html(table, numbers.tables, Some((*column, links)))
        }
        Block::Chart(chart) => figure("chart", &untitled_svg(chart), &chart.title, numbers),
        Block::Bar(bar) => figure("bar", &bar_svg(bar), &bar.title, numbers),
        Block::Drawing { svg, caption } => figure("drawing", svg, caption, numbers),
        Block::Html(html) => html.clone(),
        Block::Code { title, text } => code(title, text),
    }
}

fn paragraphs(text: &str) -> String {
    let lines: Vec<_> = text.lines().map(str::trim).collect();
    let paragraphs = lines.split(|line| line.is_empty()).filter(|lines| !lines.is_empty());
    paragraphs.map(|lines| format!("<p>{}</p>\n", escape(&lines.join("\n")))).collect()
}

fn figure(class: &str, image: &str, caption: &str, numbers: &mut Numbers) -> String {
    numbers.figures += 1;
    let (number, caption) = (numbers.figures, escape(caption));
    format!(
        r#"<figure class="{class}" data-save="figure_{number}">
{image}
<figcaption><b>Figure {number}.</b> {caption}</figcaption>
</figure>
"#
    )
}

fn code(title: &str, text: &str) -> String {
    let caption = match escape(title) {
        title if title.is_empty() => title,
        title => format!("<figcaption>{title}</figcaption>\n"),
    };
    let text = escape(text);
    format!("<figure class=\"code\">\n{caption}<pre><code>{text}</code></pre>\n</figure>\n")
}
