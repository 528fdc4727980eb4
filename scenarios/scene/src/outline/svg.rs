//! Outlines in SVG: a polygon, a polyline, lines, a rectangle, or a path of straight segments. Its y points down; ours up.

use super::drawing::{Drawing, Placed};
use crate::data_file::{Fault, shortened};

/// Elements that are drawn and are not read.
const REFUSED: [&str; 3] = ["circle", "ellipse", "use"];
/// Elements that are read.
const DRAWN: [&str; 5] = ["polygon", "polyline", "line", "rect", "path"];
const EXPECTED: &str = "a polygon, a polyline, a rect, lines or a path";

/// An element's start tag.
struct Tag<'a> {
    line: usize,
    name: &'a str,
    attributes: Vec<(&'a str, &'a str)>,
    /// Names of the groups that it is in, and its own: ids and labels.
    groups: Vec<&'a str>,
    /// It, or a group that it is in, is not displayed.
    hidden: bool,
}

/// An element that is open.
struct Container<'a> {
    name: &'a str,
    groups: Vec<&'a str>,
    hidden: bool,
}

/// Ids and labels of an element.
fn names<'a>(attributes: &[(&'a str, &'a str)]) -> Vec<&'a str> {
    attributes.iter().filter(|(name, _)| ["id", "inkscape:label"].contains(name)).map(|(_, value)| *value).collect()
}

/// True for an element that is not displayed.
fn is_hidden(attributes: &[(&str, &str)]) -> bool {
    let get = |name: &str| attributes.iter().find(|(known, _)| *known == name).map_or("", |(_, value)| value.trim());
    let style: String = get("style").chars().filter(|c| !c.is_whitespace()).collect();
    get("display") == "none"
        || ["hidden", "collapse"].contains(&get("visibility"))
        || ["display:none", "visibility:hidden"].iter().any(|part| style.split(';').any(|own| own == *part))
}

impl<'a> Tag<'a> {
    fn get(&self, name: &str) -> Option<&'a str> {
        self.attributes.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
    }

    fn number(&self, name: &str) -> Result<f64, Fault> {
        let text = self.get(name).unwrap_or("0");
        finite(text, self.line)
    }
}

fn finite(text: &str, line: usize) -> Result<f64, Fault> {
    let bare = text.trim().strip_suffix("px").unwrap_or(text.trim());
    let value = bare.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| Fault::new(line, format!("`{}`", shortened(text)), "a finite number"))
}

/// The lines of a group, by its id or label, or of all that are visible.
pub(super) fn parse(text: &str, layer: Option<&str>) -> Result<Drawing, Fault> {
    let mut drawing = Drawing { format: "SVG", ..Drawing::default() };
    let (mut is_svg, mut known) = (false, Vec::new());
    for tag in tags(text)? {
        let line = tag.line;
        let draws = DRAWN.contains(&tag.name) || REFUSED.contains(&tag.name);
        if draws {
            known.extend(tag.groups.iter().copied().filter(|name| !known.contains(name)).collect::<Vec<_>>());
        }
        let other = layer.is_some_and(|layer| !tag.groups.contains(&layer));
        if draws && (other || tag.hidden && layer.is_none()) {
            drawing.hidden += usize::from(!other);
            continue;
        }
        if let Some(transform) = tag.get("transform") {
            return Err(Fault::new(
                line,
                format!("transform=\"{}\"", shortened(transform)),
                "a drawing without transforms",
            ));
        }
        let piece = match tag.name {
            "svg" => {
                is_svg = true;
                drawing.unit = unit(&tag);
                continue;
            }
            "polygon" | "polyline" => {
                let mut piece = points(tag.get("points").unwrap_or_default(), line)?;
                if tag.name == "polygon" {
                    piece.extend(piece.first().copied());
                }
                piece
            }
            "line" => {
                vec![(line, [tag.number("x1")?, tag.number("y1")?]), (line, [tag.number("x2")?, tag.number("y2")?])]
            }
            "rect" => {
                let [x, y, w, h] = [tag.number("x")?, tag.number("y")?, tag.number("width")?, tag.number("height")?];
                [[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]].map(|point| (line, point)).to_vec()
            }
            "path" => {
                drawing.pieces.extend(path(tag.get("d").unwrap_or_default(), line)?);
                continue;
            }
            name if REFUSED.contains(&name) => return Err(Fault::new(line, format!("<{name}>"), EXPECTED)),
            _ => continue,
        };
        drawing.pieces.push(piece);
    }
    if !is_svg {
        return Err(Fault::new(1, "no <svg> element", "an SVG drawing"));
    }
    if let Some(layer) = layer.filter(|_| drawing.pieces.is_empty()) {
        let given = format!("no line in a group `{}`", shortened(layer));
        return Err(Fault::new(1, given, format!("an id or label of those with lines: {}", known.join(", "))));
    }
    drawing.pieces.iter_mut().flatten().for_each(|(_, [_, y])| *y = 0.0 - *y);
    Ok(drawing)
}

/// The start tags in their order, without comments, definitions and text.
fn tags(text: &str) -> Result<Vec<Tag<'_>>, Fault> {
    let line_of = |at: usize| 1 + text.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count();
    let mut tags = Vec::new();
    let (mut at, mut line, mut counted, mut definitions) = (0, 1, 0, 0_usize);
    let mut open: Vec<Container> = Vec::new();
    while let Some(start) = text[at..].find('<').map(|start| at + start) {
        line += text.as_bytes()[counted..start].iter().filter(|byte| **byte == b'\n').count();
        counted = start;
        let inner = &text[start + 1..];
        let (closing, whole) = match () {
            _ if inner.starts_with("!--") => ("-->", false),
            _ if inner.starts_with("![CDATA[") => ("]]>", false),
            _ if inner.starts_with(['!', '?']) => (">", false),
            _ => (">", true),
        };
        let Some(length) = inner.find(closing) else {
            return Err(Fault::new(line_of(start), format!("`<{}`", shortened(inner)), format!("its end, {closing}")));
        };
        at = start + 1 + length + closing.len();
        let content = &inner[..length];
        let name = content.trim_start_matches('/').split([' ', '\n', '\t', '\r', '/']).next().unwrap_or_default();
        let name = name.rsplit(':').next().unwrap_or(name);
        if !whole {
            continue;
        }
        if ["defs", "clipPath", "symbol", "marker", "pattern"].contains(&name) {
            match (content.starts_with('/'), content.ends_with('/')) {
                (true, _) => definitions = definitions.saturating_sub(1),
                (false, false) => definitions += 1,
                (false, true) => {}
            }
        } else if definitions == 0 && content.starts_with('/') {
            let from = open.iter().rposition(|container| container.name == name);
            open.truncate(from.unwrap_or(open.len()));
        } else if definitions == 0 {
            let attributes = attributes(content);
            let (mut groups, mut hidden) = (names(&attributes), is_hidden(&attributes));
            if let Some(around) = open.last() {
                groups.extend(&around.groups);
                hidden |= around.hidden;
            }
            if !content.ends_with('/') {
                open.push(Container { name, groups: groups.clone(), hidden });
            }
            tags.push(Tag { line, name, attributes, groups, hidden });
        }
    }
    Ok(tags)
}

/// `name="value"` pairs of a start tag.
fn attributes(content: &str) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    let mut rest = content;
    while let Some((before, behind)) = rest.split_once('=') {
        let name = before.split_whitespace().last().unwrap_or_default();
        let behind = behind.trim_start();
        let Some(quote) = behind.chars().next().filter(|c| ['"', '\''].contains(c)) else { break };
        let Some((value, next)) = behind[1..].split_once(quote) else { break };
        found.push((name, value));
        rest = next;
    }
    found
}

/// Length of a user unit [m]: of the picture's width in mm, cm or in over that of its view box.
fn unit(svg: &Tag) -> Option<f64> {
    let width = svg.get("width")?;
    let length = [("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254)].into_iter();
    let length =
        length.filter_map(|(name, m)| Some(m * width.strip_suffix(name)?.trim().parse::<f64>().ok()?)).next()?;
    let across: f64 = svg.get("viewBox")?.split([' ', ',']).filter(|part| !part.is_empty()).nth(2)?.parse().ok()?;
    Some(length / across).filter(|unit| unit.is_finite() && *unit > 0.0)
}

/// Pairs of numbers.
fn points(text: &str, line: usize) -> Result<Vec<Placed>, Fault> {
    let numbers = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|part| !part.is_empty());
    let numbers: Vec<f64> = numbers.map(|part| finite(part, line)).collect::<Result<_, _>>()?;
    if !numbers.len().is_multiple_of(2) {
        return Err(Fault::new(line, format!("{} numbers", numbers.len()), "pairs of x and y"));
    }
    Ok(numbers.chunks(2).map(|pair| (line, [pair[0], pair[1]])).collect())
}

/// The parts of a path's data: letters and numbers.
fn parts(data: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut start, mut previous) = (0, ' ');
    for (at, c) in data.char_indices() {
        let exponent = ['e', 'E'].contains(&c) && (previous.is_ascii_digit() || previous == '.');
        let sign = ['+', '-'].contains(&c) && !['e', 'E'].contains(&previous);
        let second_dot = c == '.' && data[start..at].contains('.');
        let letter = c.is_alphabetic() && !exponent;
        if c == ','
            || c.is_whitespace()
            || sign
            || letter
            || second_dot
            || previous.is_alphabetic() && start + 1 == at && !exponent
        {
            found.push(&data[start..at]);
            start = if c == ',' || c.is_whitespace() { at + c.len_utf8() } else { at };
        }
        previous = c;
    }
    found.push(&data[start..]);
    found.retain(|part| !part.trim().is_empty());
    found
}

/// The pieces of a path's data, of straight segments.
fn path(data: &str, line: usize) -> Result<Vec<Vec<Placed>>, Fault> {
    let parts = parts(data);
    let mut pieces: Vec<Vec<Placed>> = Vec::new();
    let (mut at, mut start, mut command) = ([0.0; 2], [0.0; 2], ' ');
    let mut k = 0;
    while k < parts.len() {
        if let Some(letter) = parts[k].chars().next().filter(|c| c.is_alphabetic()) {
            (command, k) = (letter, k + 1);
            if !"MmLlHhVvZz".contains(letter) {
                return Err(Fault::new(line, format!("a path with {letter}"), "straight segments: M, L, H, V and Z"));
            }
            if letter.eq_ignore_ascii_case(&'z') {
                pieces.last_mut().into_iter().for_each(|piece| piece.push((line, start)));
                at = start;
                continue;
            }
        }
        let take = |k: usize| match parts.get(k) {
            Some(part) => finite(part, line),
            None => Err(Fault::new(line, format!("a path that ends behind {command}"), "a number")),
        };
        let from = if command.is_lowercase() { at } else { [0.0; 2] };
        (at, k) = match command.to_ascii_lowercase() {
            'h' => ([from[0] + take(k)?, at[1]], k + 1),
            'v' => ([at[0], from[1] + take(k)?], k + 1),
            'm' | 'l' => ([from[0] + take(k)?, from[1] + take(k + 1)?], k + 2),
            _ => return Err(Fault::new(line, format!("`{}`", shortened(parts[k])), "a path that starts with M")),
        };
        if command.eq_ignore_ascii_case(&'m') {
            pieces.push(Vec::new());
            (start, command) = (at, if command == 'm' { 'l' } else { 'L' });
        }
        match pieces.last_mut() {
            Some(piece) => piece.push((line, at)),
            None => return Err(Fault::new(line, "a path without a start", "a path that starts with M")),
        }
    }
    Ok(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_and_paths_are_read_with_y_up() {
        let polygon = parse("<svg>\n<!-- <polygon points='9'/> -->\n<polygon points=\"0,0 1,0 1,-1\"/></svg>", None)
            .expect("a drawing");
        assert_eq!(polygon.pieces[0], [(3, [0.0, 0.0]), (3, [1.0, 0.0]), (3, [1.0, 1.0]), (3, [0.0, 0.0])]);
        let path = parse("<svg width=\"100mm\" viewBox=\"0 0 200 50\"><path d=\"M0,0h1e1v-5.5L0-5.5z\"/></svg>", None)
            .expect("a path");
        let points: Vec<_> = path.pieces[0].iter().map(|(_, p)| *p).collect();
        assert_eq!(points, [[0.0, 0.0], [10.0, 0.0], [10.0, 5.5], [0.0, 5.5], [0.0, 0.0]]);
        assert_eq!(path.unit, Some(5e-4));
    }

    /// A layer that is not displayed, an aid that is not visible; and the layer by its label.
    #[test]
    fn hidden_groups_are_left_out_and_a_group_can_be_chosen() {
        let text = "<svg>\n<g id='g1' inkscape:label='hull'><polygon points='0,0 1,0 1,-1'/></g>\n\
                    <g inkscape:label='old' style='display: none; fill:red'><g><line x2='5' y2='5'/></g></g>\n\
                    <line x2='7' y2='7' visibility='hidden'/></svg>";
        let all = parse(text, None).expect("a drawing");
        assert_eq!((all.pieces.len(), all.hidden), (1, 2));
        assert!(all.told()[0].contains("2 hidden"), "{:?}", all.told());
        for name in ["hull", "g1"] {
            assert_eq!(parse(text, Some(name)).expect("a group").pieces, all.pieces);
        }
        let old = parse(text, Some("old")).expect("a hidden group that is asked for");
        assert_eq!(old.pieces[0][1].1, [5.0, -5.0]);
        let none = parse(text, Some("deck")).expect_err("no such group");
        assert!(none.expected.contains("hull") && none.expected.contains("old"), "{none:?}");
    }

    #[test]
    fn curves_transforms_and_open_tags_are_refused_with_their_line() {
        for (text, line, part) in [
            ("<svg>\n<path d='M0 0C1 1 2 2 3 3'/></svg>", 2, "a path with C"),
            ("<svg>\n<g transform='scale(2)'><path/></g></svg>", 2, "transform"),
            ("<svg>\n\n<circle r='1'/></svg>", 3, "<circle>"),
            ("<svg>\n<polygon points='1 2 3'/></svg>", 2, "3 numbers"),
            ("<svg>\n<polygon points='1 b'/></svg>", 2, "`b`"),
            ("<svg>\n<polygon", 2, "<polygon"),
            ("<html></html>", 1, "no <svg>"),
        ] {
            let fault = parse(text, None).expect_err(text);
            assert!(fault.line == line && fault.given.contains(part), "{text}: {fault:?}");
        }
    }
}
