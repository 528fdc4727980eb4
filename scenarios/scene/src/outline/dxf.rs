//! Outlines in DXF: LINE, LWPOLYLINE, POLYLINE, ARC and CIRCLE.

use super::drawing::{Drawing, Placed, arc, bulged};
use crate::data_file::{Fault, shortened};

/// Curves that are not read; other entities, such as text, say nothing of the outline.
const REFUSED: [&str; 5] = ["SPLINE", "ELLIPSE", "INSERT", "MLINE", "HELIX"];
/// Largest component of a normal beside that along z [-].
const TILTED: f64 = 1e-6;
/// Larger radii have points that are no numbers.
const LARGEST_RADIUS: f64 = 1e9;
/// Entities that are read.
const DRAWN: [&str; 5] = ["LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE"];
const EXPECTED: &str = "LINE, LWPOLYLINE, POLYLINE, ARC or CIRCLE";

/// A code and its value, with the line of the value.
struct Group<'a> {
    line: usize,
    code: i32,
    value: &'a str,
}

/// An entity: its name and the groups behind it.
struct Entity<'a> {
    line: usize,
    name: &'a str,
    groups: Vec<Group<'a>>,
}

/// The lines of a layer, or of all that are visible.
pub(super) fn parse(text: &str, layer: Option<&str>) -> Result<Drawing, Fault> {
    let mut drawing = Drawing { format: "DXF", ..Drawing::default() };
    let (mut open, mut section) = (None, "");
    let (entities, mut off, mut known, mut skips) = (entities(text)?, Vec::new(), Vec::new(), false);
    for entity in entities {
        match (entity.name, section) {
            ("SECTION", _) => {
                section = entity.groups.iter().find(|group| group.code == 2).map_or("", |group| group.value);
                drawing.unit = drawing.unit.or(unit(&entity)?);
            }
            ("ENDSEC", _) => section = "",
            ("LAYER", "TABLES") if entity.is_off()? => off.extend(entity.text(2)),
            // vertices and the end of a polyline are read or left out with it
            ("VERTEX" | "SEQEND", "ENTITIES") if skips => {}
            (_, "ENTITIES") => {
                let of = entity.text(8).unwrap_or("0");
                let draws = DRAWN.contains(&entity.name) || REFUSED.contains(&entity.name);
                if draws && !known.contains(&of) {
                    known.push(of);
                }
                let hidden = entity.number(60, Some(0.0))? != 0.0 || off.contains(&of) && layer.is_none();
                let other = layer.is_some_and(|layer| !layer.eq_ignore_ascii_case(of));
                let part = matches!(entity.name, "VERTEX" | "SEQEND");
                if !part {
                    skips = draws && (hidden || other);
                    drawing.hidden += usize::from(draws && hidden && !other);
                }
                if !skips {
                    if draws {
                        drawing.add_layer(of);
                    }
                    read(&entity, &mut open, &mut drawing.pieces)?;
                }
            }
            _ => {}
        }
    }
    match layer.filter(|_| drawing.pieces.is_empty()) {
        Some(layer) => {
            let given = format!("no line on the layer `{}`", shortened(layer));
            Err(Fault::new(1, given, format!("one of the layers with lines: {}", known.join(", "))))
        }
        None => Ok(drawing),
    }
}

/// The file's pairs of lines, by entity.
fn entities(text: &str) -> Result<Vec<Entity<'_>>, Fault> {
    let mut lines = text.lines().enumerate();
    let mut entities: Vec<Entity> = Vec::new();
    while let Some((k, code)) = lines.next() {
        let wrong = |_| {
            Fault::new(k + 1, format!("`{}`", shortened(code.trim())), "a group code of a text DXF, a whole number")
        };
        let code: i32 = code.trim().parse().map_err(wrong)?;
        let Some((k, value)) = lines.next() else {
            return Err(Fault::new(k + 1, format!("the group code {code}"), "its value on the next line"));
        };
        let value = value.trim();
        match (code, entities.last_mut()) {
            (0, _) => entities.push(Entity { line: k + 1, name: value, groups: Vec::new() }),
            (_, Some(entity)) => entity.groups.push(Group { line: k + 1, code, value }),
            (_, None) => {} // comments before the first entity
        }
    }
    Ok(entities)
}

/// Group code of a comment.
const COMMENT: i32 = 999;

/// Units of $INSUNITS by their number, 1 to 16 and 21 to 24 [m]: inch, foot, mile, mm, cm, m, km, microinch, mil, yard, angstrom, nm, micrometre,
/// dm, dam, hm; foot, inch, yard and mile of US surveys.
const UNITS: [(u32, f64); 20] = [
    (1, 0.0254),
    (2, 0.3048),
    (3, 1609.344),
    (4, 1e-3),
    (5, 1e-2),
    (6, 1.0),
    (7, 1e3),
    (8, 2.54e-8),
    (9, 2.54e-5),
    (10, 0.9144),
    (11, 1e-10),
    (12, 1e-9),
    (13, 1e-6),
    (14, 0.1),
    (15, 10.0),
    (16, 100.0),
    (21, 1200.0 / 3937.0),
    (22, 100.0 / 3937.0),
    (23, 3600.0 / 3937.0),
    (24, 6_336_000.0 / 3937.0),
];

/// The unit of the header's $INSUNITS [m]; none where it is absent, or 0.
fn unit(section: &Entity) -> Result<Option<f64>, Fault> {
    let at = section.groups.iter().position(|group| group.code == 9 && group.value == "$INSUNITS");
    let value = at.and_then(|at| section.groups[at + 1..].iter().find(|group| group.code != COMMENT));
    let Some(group) = value else { return Ok(None) };
    let number = group.value.parse::<u32>().ok().filter(|_| group.code == 70);
    if number == Some(0) {
        return Ok(None);
    }
    let known = UNITS.iter().find(|(own, _)| number == Some(*own)).map(|(_, unit)| *unit);
    let expected = "0, 1 to 16 or 21 to 24: a unit of length; body.outline_unit sets one";
    known.map(Some).ok_or_else(|| Fault::new(group.line, format!("$INSUNITS = {}", shortened(group.value)), expected))
}

impl<'a> Entity<'a> {
    /// The number of a group; `usual` where it is absent.
    fn number(&self, code: i32, usual: Option<f64>) -> Result<f64, Fault> {
        match self.groups.iter().find(|group| group.code == code) {
            Some(group) => finite(group),
            None => usual.ok_or_else(|| Fault::new(self.line, shortened(self.name), format!("its group code {code}"))),
        }
    }

    fn point(&self, x: i32) -> Result<[f64; 2], Fault> {
        Ok([self.number(x, None)?, self.number(x + 10, None)?])
    }

    /// The text of a group.
    fn text(&self, code: i32) -> Option<&'a str> {
        self.groups.iter().find(|group| group.code == code).map(|group| group.value)
    }

    /// True for a layer that is switched off or frozen.
    fn is_off(&self) -> Result<bool, Fault> {
        Ok(self.number(62, Some(0.0))? < 0.0 || self.number(70, Some(0.0))? as i64 & 1 == 1)
    }

    /// Direction of x of the entity's own axes in the drawing, 1 or -1: its normal is z or, seen from behind, -z, with x turned round.
    fn direction(&self) -> Result<f64, Fault> {
        let normal = [self.number(210, Some(0.0))?, self.number(220, Some(0.0))?, self.number(230, Some(1.0))?];
        let flat = normal[0].abs() < TILTED && normal[1].abs() < TILTED;
        match normal[2] {
            z if flat && z > 0.0 => Ok(1.0),
            z if flat && z < 0.0 => Ok(-1.0),
            _ => Err(Fault::new(
                self.line,
                format!("the normal {normal:?} of {}", shortened(self.name)),
                "a drawing in the plane of x and y",
            )),
        }
    }

    fn is_closed(&self) -> Result<bool, Fault> {
        Ok(self.number(70, Some(0.0))? as i64 & 1 == 1)
    }
}

fn finite(group: &Group) -> Result<f64, Fault> {
    let value = group.value.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| Fault::new(group.line, format!("`{}`", shortened(group.value)), "a finite number"))
}

/// A polyline on its way: its vertices with their bulges.
struct Open {
    closed: bool,
    /// Direction of x of its own axes.
    direction: f64,
    vertices: Vec<(Placed, f64)>,
}

impl Open {
    fn piece(self) -> Vec<Placed> {
        let Open { closed, direction, vertices } = self;
        let mut piece: Vec<Placed> = vertices.first().map(|(first, _)| *first).into_iter().collect();
        for pair in vertices.windows(2) {
            piece.extend(bulged(pair[1].0.0, pair[0].0.1, pair[1].0.1, pair[0].1));
        }
        if let (true, [first, .., last]) = (closed, vertices.as_slice()) {
            piece.extend(bulged(last.0.0, last.0.1, first.0.1, last.1));
        }
        turned(piece, direction)
    }
}

/// A piece in the drawing's axes.
fn turned(mut piece: Vec<Placed>, direction: f64) -> Vec<Placed> {
    if direction < 0.0 {
        piece.iter_mut().for_each(|(_, [x, _])| *x = 0.0 - *x);
    }
    piece
}

/// The piece of an entity; of a POLYLINE once its end is reached.
fn read(entity: &Entity, open: &mut Option<Open>, pieces: &mut Vec<Vec<Placed>>) -> Result<(), Fault> {
    let line = entity.line;
    match entity.name {
        "LINE" => pieces.push(vec![(line, entity.point(10)?), (line, entity.point(11)?)]),
        "ARC" | "CIRCLE" => {
            let (centre, radius) = (entity.point(10)?, entity.number(40, None)?);
            if !(radius > 0.0 && radius <= LARGEST_RADIUS) {
                return Err(Fault::new(line, format!("a radius of {radius:e}"), "a radius above 0 and up to 1e9"));
            }
            let circle = entity.name == "CIRCLE";
            let [from, to] = [entity.number(50, circle.then_some(0.0))?, entity.number(51, circle.then_some(360.0))?];
            let to = from + (to - from).rem_euclid(360.0);
            let arc = arc(line, centre, radius, from, if to > from { to } else { from + 360.0 });
            pieces.push(turned(arc, entity.direction()?));
        }
        "LWPOLYLINE" => {
            let (closed, direction) = (entity.is_closed()?, entity.direction()?);
            pieces.push(Open { closed, direction, vertices: vertices(entity)? }.piece());
        }
        "POLYLINE" => {
            let (closed, direction) = (entity.is_closed()?, entity.direction()?);
            *open = Some(Open { closed, direction, vertices: Vec::new() });
        }
        "VERTEX" => {
            let vertex = ((line, entity.point(10)?), entity.number(42, Some(0.0))?);
            if let Some(open) = open {
                open.vertices.push(vertex);
            }
        }
        "SEQEND" => pieces.extend(open.take().map(Open::piece)),
        name if REFUSED.contains(&name) => return Err(Fault::new(line, name, EXPECTED)),
        _ => {}
    }
    Ok(())
}

/// The vertices of a LWPOLYLINE: each starts with its x.
fn vertices(entity: &Entity) -> Result<Vec<(Placed, f64)>, Fault> {
    let mut vertices: Vec<(Placed, f64)> = Vec::new();
    for group in &entity.groups {
        match (group.code, vertices.last_mut()) {
            (10, _) => vertices.push(((group.line, [finite(group)?, f64::NAN]), 0.0)),
            (20, Some(vertex)) => vertex.0.1[1] = finite(group)?,
            (42, Some(vertex)) => vertex.1 = finite(group)?,
            _ => {}
        }
    }
    match vertices.iter().find(|((_, [_, y]), _)| y.is_nan()) {
        Some(((line, _), _)) => Err(Fault::new(*line, "a vertex without y", "its group code 20")),
        None => Ok(vertices),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(entities: &str) -> Result<Drawing, Fault> {
        parse(&format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"), None)
    }

    /// Seen from behind, its own x runs against that of the drawing; a circle at x = 2 stands at -2.
    #[test]
    fn an_entity_whose_normal_points_down_is_not_mirrored() {
        let behind = "210\n0\n220\n0\n230\n-1\n";
        let polyline = format!("0\nLWPOLYLINE\n90\n3\n70\n1\n{behind}10\n0\n20\n0\n10\n3\n20\n0\n10\n3\n20\n1\n");
        let points: Vec<_> = of(&polyline).expect("a polyline").pieces[0].iter().map(|(_, at)| *at).collect();
        assert_eq!(points[..3], [[0.0, 0.0], [-3.0, 0.0], [-3.0, 1.0]]);
        let circle = of(&format!("0\nCIRCLE\n10\n2\n20\n0\n40\n1\n{behind}")).expect("a circle");
        assert!(circle.pieces[0].iter().all(|(_, [x, _])| (-3.0..=-1.0).contains(x)));
        let tilted = of("0\nCIRCLE\n10\n2\n20\n0\n40\n1\n210\n1\n220\n0\n230\n0\n").expect_err("a tilted circle");
        assert!(tilted.expected.contains("plane of x and y"), "{tilted:?}");
    }

    /// A hull on one layer, aids on another one that is off; and one of both by its name.
    #[test]
    fn hidden_layers_are_left_out_and_a_layer_can_be_chosen() {
        let line = |layer: &str, y: i32| format!("0\nLINE\n8\n{layer}\n10\n0\n20\n{y}\n11\n1\n21\n{y}\n");
        let file = |colour: i32| {
            format!(
                "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\naids\n70\n0\n62\n{colour}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}{}0\nENDSEC\n0\nEOF\n",
                line("hull", 0),
                line("aids", 5)
            )
        };
        let of = |text: &str, layer| parse(text, layer).expect("a drawing");
        let hidden = of(&file(-7), None);
        assert_eq!((hidden.pieces.len(), hidden.hidden, hidden.notes().len()), (1, 1, 1));
        assert!(hidden.notes()[0].contains("1 hidden"), "{:?}", hidden.notes());
        let both = of(&file(7), None);
        assert!(both.pieces.len() == 2 && both.notes()[0].contains("hull, aids"), "{:?}", both.notes());
        let one = of(&file(-7), Some("AIDS"));
        assert_eq!((one.pieces.len(), one.pieces[0][0].1, one.notes().len()), (1, [0.0, 5.0], 0));
        let none = parse(&file(7), Some("deck")).expect_err("no such layer");
        assert!(none.expected.contains("hull, aids"), "{none:?}");
    }

    #[test]
    fn lines_and_polylines_are_read() {
        let lines = of("0\nLINE\n10\n0\n20\n0\n11\n1\n21\n0\n0\nLINE\n10\n1\n20\n0\n11\n1\n21\n1\n").expect("lines");
        assert_eq!(lines.joined().expect("one line").len(), 3);
        let closed = of("0\nLWPOLYLINE\n90\n3\n70\n1\n10\n0\n20\n0\n10\n1\n20\n0\n10\n1\n20\n1\n").expect("a polyline");
        assert_eq!(closed.pieces[0].len(), 4);
        let old = "0\nPOLYLINE\n70\n0\n0\nVERTEX\n10\n0\n20\n0\n42\n1\n0\nVERTEX\n10\n2\n20\n0\n0\nSEQEND\n";
        let half_circle = of(old).expect("a polyline");
        assert!(half_circle.pieces[0].len() > 50);
    }

    #[test]
    fn the_header_names_the_unit() {
        let text = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n0\n0\nENDSEC\n";
        let of = |number: &str| parse(&text.replace("70\n4\n", &format!("70\n{number}\n")), None);
        for (number, unit) in [("4", 1e-3), ("10", 0.9144), ("14", 0.1), ("21", 1200.0 / 3937.0)] {
            assert_eq!(of(number).expect("a drawing").unit, Some(unit), "{number}");
        }
        assert_eq!(of("0").expect("a drawing").unit, None);
        assert_eq!(of("17").expect_err("gigametres").line, 8);
        let notes = text.replace("70\n4\n", "999\n4\n70\n6\n");
        assert_eq!(parse(&notes, None).expect("a drawing with a comment").unit, Some(1.0));
    }

    #[test]
    fn curves_and_broken_pairs_are_refused_with_their_line() {
        assert_eq!(of("0\nSPLINE\n10\n0\n").expect_err("a curve").line, 6);
        assert_eq!(of("0\nLINE\n10\nabc\n").expect_err("no number").line, 8);
        assert_eq!(parse("AutoCAD Binary DXF\n\n", None).expect_err("binary").line, 1);
        assert!(of("0\nLINE\n10\n0\n").is_err());
    }
}
