//! Tables of the page.

use super::markup::escape;

/// A table. Columns of numbers are set right-aligned; short rows are filled up with empty cells.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Caption; empty for none.
    pub title: String,
    /// Column headings, with units in brackets.
    pub head: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

/// A table of at most this number of rows is printed on one page.
const SHORT: usize = 16;

/// The heading of a column and the text of an item's cell.
pub type Column<T> = (&'static str, fn(&T) -> String);

impl Table {
    /// A table of the given cells.
    pub fn new(title: impl Into<String>, head: &[&str], rows: Vec<Vec<String>>) -> Table {
        Table { title: title.into(), head: row(head), rows }
    }

    /// A table with a row for each item.
    pub fn of<T>(title: impl Into<String>, items: impl IntoIterator<Item = T>, columns: &[Column<T>]) -> Table {
        let cells = |item: T| columns.iter().map(|(_, cell)| cell(&item)).collect();
        let head: Vec<&str> = columns.iter().map(|(heading, _)| *heading).collect();
        Table::new(title, &head, items.into_iter().map(cells).collect())
    }

    /// The cells as Markdown, without the title.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let rule = format!("|{}\n", "---|".repeat(self.head.len()));
        line(&self.head) + &rule + &self.rows.iter().map(|row| line(row)).collect::<String>()
    }
}

/// A row of cells.
pub fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|c| c.to_string()).collect()
}

/// A number with this number of decimals; a dash where it is unknown.
pub fn known(value: Option<f64>, digits: usize) -> String {
    value.map_or("–".into(), |v| format!("{v:.digits$}"))
}

/// The table in HTML; a table with a title is given `number` in its caption. With links, of a column and row by row, it is a wide one.
pub(super) fn table_html(table: &Table, number: usize, links: Option<(usize, &Vec<Option<String>>)>) -> String {
    let columns = table.rows.iter().map(Vec::len).fold(table.head.len(), usize::max);
    let classes: Vec<_> =
        (0..columns).map(|column| if is_numeric(table, column) { " class=\"number\"" } else { "" }).collect();
    let row = |tag: &str, row: &Vec<String>, link: Option<&String>| {
        let cells = classes.iter().enumerate().map(|(column, class)| {
            let text = match link.filter(|_| links.is_some_and(|(linked, _)| linked == column)) {
                Some(address) => format!("<a href=\"{}\">{}</a>", escape(address), escape(cell(row, column))),
                None => escape(cell(row, column)),
            };
            format!("<{tag}{class}>{text}</{tag}>")
        });
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let caption = match escape(&table.title) {
        title if title.is_empty() => String::new(),
        title => format!("<caption><b>Table {number}.</b> {title}</caption>\n"),
    };
    let head = match table.head.as_slice() {
        [] => String::new(),
        _ => format!("<thead>\n{}</thead>\n", row("th", &table.head, None)),
    };
    let link = |k: usize| links.and_then(|(_, links)| links.get(k)?.as_ref());
    let body: String = table.rows.iter().enumerate().map(|(k, cells)| row("td", cells, link(k))).collect();
    let class = match table.rows.len() <= SHORT {
        _ if links.is_some() => "table wide",
        true => "table short",
        false => "table",
    };
    format!("<div class=\"{class}\"><table>\n{caption}{head}<tbody>\n{body}</tbody>\n</table></div>\n")
}

fn cell(row: &[String], column: usize) -> &str {
    row.get(column).map_or("", |cell| cell.trim())
}

/// Whether a column holds numbers, apart from cells left blank.
fn is_numeric(table: &Table, column: usize) -> bool {
    let mut cells = table.rows.iter().map(|row| cell(row, column)).filter(|cell| !is_blank(cell));
    cells.next().is_some_and(is_number) && cells.all(is_number)
}

fn is_blank(cell: &str) -> bool {
    matches!(cell, "" | "-" | "–" | "—")
}

/// A number as people write it: sign, digits, exponent, perhaps a band, a percent sign or a mark.
fn is_number(cell: &str) -> bool {
    let is_plain = |part: &str| {
        let digits = part.trim().replace('−', "-").replace('\u{202f}', "");
        let mantissa = digits.split_once("·10").map_or(digits.as_str(), |(mantissa, _)| mantissa);
        mantissa.parse::<f64>().is_ok()
    };
    let number = cell.trim_end_matches(['%', ' ', '*', '~', '?', '!']).trim_start_matches("± ");
    number.split_once('±').map_or(is_plain(number), |(value, band)| is_plain(value) && is_plain(band))
}
