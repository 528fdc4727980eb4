//! Outlines in SVG: shapes and paths, with their transforms. Its y points down; ours up.

use std::borrow::Cow;

use roxmltree::{Attribute, Document, Node, ParsingOptions};
use svgtypes::{NumberListParser, PathParser, PathSegment, SimplePathSegment, SimplifyingPathParser, Transform};

use super::drawing::{Drawing, MOST_POINTS, Placed, curve};
use crate::data_file::{Fault, shortened};

/// Elements that are read.
const DRAWN: [&str; 7] = ["circle", "ellipse", "line", "path", "polygon", "polyline", "rect"];
/// Elements that are drawn and are not read; an `svg` inside of another one is such, too.
const REFUSED: [&str; 6] = ["flowRoot", "foreignObject", "image", "svg", "text", "use"];
/// Elements whose content is not drawn where it stands.
const DEFINITIONS: [&str; 8] = ["clipPath", "defs", "marker", "mask", "metadata", "namedview", "pattern", "symbol"];
/// Properties that change what is seen of a line, and are not read.
const REFUSED_PROPERTIES: [&str; 3] = ["clip-path", "mask", "transform-origin"];
const EXPECTED: &str =
    "a path, polygon, polyline, line, rect, circle or ellipse; body.outline_layer chooses the group of the outline";
/// Larger numbers of a path, as of an arc, give too many curves.
const LARGEST: f64 = 1e15;

/// A file: the places where its lines end.
struct Lines(Vec<usize>);

impl Lines {
    /// The line of a place in the text, from 1.
    fn at(&self, place: usize) -> usize {
        1 + self.0.partition_point(|end| *end < place)
    }
}

/// The lines of a group, by its id or label, or of all that are visible.
pub(super) fn parse(text: &str, layer: Option<&str>) -> Result<Drawing, Fault> {
    let lines = Lines(text.match_indices('\n').map(|(at, _)| at).collect());
    let options = ParsingOptions { allow_dtd: true, nodes_limit: u32::MAX, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = match error {
            roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::UnclosedRootNode => text.lines().count(),
            _ => error.pos().row as usize,
        };
        Fault::new(line, format!("XML that cannot be read, {error}"), "an SVG drawing")
    })?;
    let svg = document.root_element();
    if svg.tag_name().name() != "svg" {
        return Err(Fault::new(lines.at(svg.range().start), "no <svg> element", "an SVG drawing"));
    }
    let mut drawing = Drawing { format: "SVG", unit: unit(svg), ..Drawing::default() };
    let mut known: Vec<&str> = Vec::new();
    for node in svg.descendants().filter(|node| *node != svg) {
        let name = node.tag_name().name();
        if !DRAWN.contains(&name) && !REFUSED.contains(&name) {
            continue;
        }
        if node.ancestors().any(|around| DEFINITIONS.contains(&around.tag_name().name())) {
            drawing.defined += 1;
            continue;
        }
        let groups = || node.ancestors().flat_map(names);
        known.extend(groups().filter(|name| !known.contains(name)).collect::<Vec<_>>());
        let other = layer.is_some_and(|layer| !groups().any(|name| name == layer));
        if other || layer.is_none() && node.ancestors().any(is_hidden) {
            drawing.hidden += usize::from(!other);
            continue;
        }
        let element = Element { node, lines: &lines };
        if REFUSED.contains(&name) {
            return Err(Fault::new(element.line(None), format!("<{name}>"), EXPECTED));
        }
        drawing.pieces.extend(element.pieces()?);
        if drawing.pieces.iter().map(Vec::len).sum::<usize>() > MOST_POINTS {
            break; // is refused where the lines are joined
        }
    }
    if let Some(layer) = layer.filter(|_| drawing.pieces.is_empty()) {
        let given = format!("no line in a group `{}`", shortened(layer));
        return Err(Fault::new(1, given, format!("an id or label of those with lines: {}", known.join(", "))));
    }
    drawing.pieces.iter_mut().flatten().for_each(|(_, [_, y])| *y = 0.0 - *y);
    Ok(drawing)
}

/// Ids and labels of an element.
fn names<'a>(node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    let attributes = node.attributes().filter(|attribute| ["id", "label"].contains(&attribute.name()));
    attributes.map(|attribute| attribute.value())
}

/// The value of a property in the attribute `style`.
fn styled<'a>(node: Node<'a, '_>, property: &str) -> Option<&'a str> {
    let style = node.attribute("style")?.split(';').filter_map(|part| part.split_once(':'));
    style.map(|(name, value)| (name.trim(), value.trim())).rfind(|(name, _)| *name == property).map(|(_, value)| value)
}

/// The value of a property.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    styled(node, name).or(node.attribute(name).map(str::trim))
}

/// True for an element that is not displayed.
fn is_hidden(node: Node) -> bool {
    property(node, "display") == Some("none") || matches!(property(node, "visibility"), Some("hidden" | "collapse"))
}

/// Length of a user unit [m]: of the picture's width in mm, cm or in over that of its view box.
fn unit(svg: Node) -> Option<f64> {
    let width = svg.attribute("width")?;
    let length = [("mm", 1e-3), ("cm", 1e-2), ("in", 0.0254)].into_iter();
    let length =
        length.filter_map(|(name, m)| Some(m * width.strip_suffix(name)?.trim().parse::<f64>().ok()?)).next()?;
    let across = NumberListParser::from(svg.attribute("viewBox")?).nth(2)?.ok()?;
    Some(length / across).filter(|unit| unit.is_finite() && *unit > 0.0)
}

/// An element that is drawn.
#[derive(Clone, Copy)]
struct Element<'a> {
    node: Node<'a, 'a>,
    lines: &'a Lines,
}

impl<'a> Element<'a> {
    /// The line of an attribute, or of the element.
    fn line(self, attribute: Option<Attribute>) -> usize {
        self.lines.at(attribute.map_or(self.node.range().start, |attribute| attribute.range().start))
    }

    /// What is wrong with an attribute, at the place that the error names.
    fn fault(self, name: &str, error: &svgtypes::Error, expected: &str) -> Fault {
        use svgtypes::Error::{InvalidChar, InvalidNumber, InvalidString, UnexpectedData};
        let attribute = self.node.attribute_node(name);
        let value = attribute.map_or("", |attribute| attribute.value());
        let place = match error {
            InvalidChar(_, place) | InvalidNumber(place) | InvalidString(_, place) | UnexpectedData(place) => *place,
            _ => 1,
        };
        let rest: String = value.chars().skip(place.saturating_sub(1)).collect();
        Fault::new(self.line(attribute), format!("`{}` in {name}=\"…\": {error}", shortened(&rest)), expected)
    }

    /// A number, in user units; 0 where it is absent.
    fn number(self, name: &str) -> Result<f64, Fault> {
        let Some(attribute) = self.node.attribute_node(name) else { return Ok(0.0) };
        let text = attribute.value().trim();
        let value = text.strip_suffix("px").unwrap_or(text).parse().ok().filter(|value: &f64| value.is_finite());
        let given = || format!("{name} = `{}`", shortened(text));
        value.ok_or_else(|| Fault::new(self.line(Some(attribute)), given(), "a finite number"))
    }

    fn numbers<const N: usize>(self, names: [&str; N]) -> Result<[f64; N], Fault> {
        let mut values = [0.0; N];
        values.iter_mut().zip(names).try_for_each(|(value, name)| self.number(name).map(|number| *value = number))?;
        Ok(values)
    }

    /// Its shape as data of a path, and the attribute that has it.
    fn data(self) -> Result<(&'static str, Cow<'a, str>), Fault> {
        let ellipse =
            |[x, y, a, b]: [f64; 4]| format!("M{} {y}A{a} {b} 0 0 1 {} {y}A{a} {b} 0 0 1 {} {y}Z", x - a, x + a, x - a);
        let data = match self.node.tag_name().name() {
            "path" => return Ok(("d", self.node.attribute("d").unwrap_or_default().into())),
            name @ ("polygon" | "polyline") => return Ok(("points", self.points(name == "polygon")?.into())),
            "line" => {
                let [x1, y1, x2, y2] = self.numbers(["x1", "y1", "x2", "y2"])?;
                format!("M{x1} {y1}L{x2} {y2}")
            }
            "circle" => {
                let [x, y, radius] = self.numbers(["cx", "cy", "r"])?;
                ellipse([x, y, radius, radius])
            }
            "ellipse" => ellipse(self.numbers(["cx", "cy", "rx", "ry"])?),
            _ => {
                let [x, y, w, h] = self.numbers(["x", "y", "width", "height"])?;
                let radius = |own: &str, other: &str, most: f64| {
                    let given = [own, other].into_iter().find(|name| self.node.has_attribute(*name));
                    given.map_or(Ok(0.0), |name| self.number(name)).map(|radius| radius.min(0.5 * most))
                };
                let [a, b] = [radius("rx", "ry", w)?, radius("ry", "rx", h)?];
                let (right, low) = (x + w, y + h);
                match a > 0.0 && b > 0.0 {
                    false => format!("M{x} {y}H{right}V{low}H{x}Z"),
                    true => format!(
                        "M{} {y}H{}a{a} {b} 0 0 1 {a} {b}V{}a{a} {b} 0 0 1 -{a} {b}H{}a{a} {b} 0 0 1 -{a} -{b}V{}a{a} {b} 0 0 1 {a} -{b}Z",
                        x + a,
                        right - a,
                        low - b,
                        x + a,
                        y + b
                    ),
                }
            }
        };
        Ok(("", data.into()))
    }

    /// Pairs of numbers as data of a path.
    fn points(self, closed: bool) -> Result<String, Fault> {
        let text = self.node.attribute("points").unwrap_or_default();
        let numbers: Result<Vec<f64>, _> = NumberListParser::from(text).collect();
        let numbers = numbers.map_err(|error| self.fault("points", &error, "finite numbers, in pairs of x and y"))?;
        if !numbers.len().is_multiple_of(2) {
            let line = self.line(self.node.attribute_node("points"));
            return Err(Fault::new(line, format!("{} numbers", numbers.len()), "pairs of x and y"));
        }
        let start = if numbers.is_empty() { "" } else { "M" };
        let end = if closed && !numbers.is_empty() { "Z" } else { "" };
        Ok(format!("{start}{}{end}", numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")))
    }

    /// The transforms of it and of the groups around it, the innermost first.
    fn transforms(self) -> Result<Vec<Transform>, Fault> {
        let mut found = Vec::new();
        for node in self.node.ancestors() {
            let element = Element { node, ..self };
            for name in REFUSED_PROPERTIES {
                if let Some(value) = property(node, name).filter(|value| *value != "none") {
                    let line = element.line(node.attribute_node(name));
                    return Err(Fault::new(line, format!("{name} = `{}`", shortened(value)), format!("no {name}")));
                }
            }
            if let Some(value) = styled(node, "transform") {
                let line = element.line(node.attribute_node("style"));
                return Err(Fault::new(line, format!("`{}` in style", shortened(value)), "the attribute transform"));
            }
            if let Some(text) = node.attribute("transform") {
                let expected = "translate, scale, rotate, skewX, skewY or matrix with finite numbers";
                found.push(text.parse().map_err(|error| element.fault("transform", &error, expected))?);
            }
        }
        Ok(found)
    }

    /// Its lines. An arc becomes cubic curves, which are within 2.8e-4 of its radius of it.
    fn pieces(self) -> Result<Vec<Vec<Placed>>, Fault> {
        let (transforms, (attribute, data)) = (self.transforms()?, self.data()?);
        let line = self.line(self.node.attribute_node(attribute));
        let refused =
            |error| self.fault(attribute, &error, "path data: M, L, H, V, C, S, Q, T, A, Z and their numbers");
        let beyond = || Fault::new(line, "a number that is too large", format!("finite numbers up to {LARGEST:e}"));
        for segment in PathParser::from(&*data) {
            if let Ok(PathSegment::EllipticalArc { rx, ry, x, y, .. }) = segment
                && [rx, ry, x, y].iter().any(|number| number.abs() > LARGEST)
            {
                return Err(beyond());
            }
        }
        let (mut pieces, mut from): (Vec<Vec<Placed>>, _) = (Vec::new(), [0.0; 2]);
        for segment in SimplifyingPathParser::from(&*data) {
            let segment = segment.map_err(refused)?;
            let (controls, to) = match segment {
                SimplePathSegment::MoveTo { x, y } => {
                    pieces.push(Vec::new());
                    (None, [x, y])
                }
                SimplePathSegment::LineTo { x, y } => (None, [x, y]),
                SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => (Some([[x1, y1], [x2, y2]]), [x, y]),
                SimplePathSegment::Quadratic { x1, y1, x, y } => {
                    let raised = [from, [x, y]].map(|[u, v]: [f64; 2]| [(u + 2.0 * x1) / 3.0, (v + 2.0 * y1) / 3.0]);
                    (Some(raised), [x, y])
                }
                SimplePathSegment::ClosePath => {
                    pieces.last_mut().into_iter().for_each(|piece| piece.extend(piece.first().copied()));
                    continue;
                }
            };
            let placed = |point: [f64; 2]| {
                let point =
                    transforms.iter().fold(point, |[x, y], t| [t.a * x + t.c * y + t.e, t.b * x + t.d * y + t.f]);
                point.iter().all(|x| x.abs() <= LARGEST).then_some(point).ok_or_else(beyond)
            };
            let end = placed(to)?;
            let points = match controls {
                None => vec![(line, end)],
                Some([b, c]) => curve(line, [placed(from)?, placed(b)?, placed(c)?, end]),
            };
            from = to;
            pieces.last_mut().into_iter().for_each(|piece| piece.extend(&points));
            if pieces.iter().map(Vec::len).sum::<usize>() > MOST_POINTS {
                break;
            }
        }
        Ok(pieces)
    }
}

#[cfg(test)]
mod tests;
