//! Outlines in DXF: LINE, LWPOLYLINE, POLYLINE, ARC and CIRCLE.

use super::drawing::{Drawing, Placed, arc, bulged};
use crate::scene::data_file::{Fault, shortened};

/// Curves that are not read; other entities, such as text, say nothing of the outline.
const REFUSED: [&str; 5] = ["SPLINE", "ELLIPSE", "INSERT", "MLINE", "HELIX"];
/// Larger radii have points that are no numbers.
const LARGEST_RADIUS: f64 = 1e9;
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

pub(super) fn parse(text: &str) -> Result<Drawing, Fault> {
    let mut drawing = Drawing { format: "DXF", ..Drawing::default() };
    let (mut open, mut section) = (None, "");
    for entity in entities(text)? {
        match (entity.name, section) {
            ("SECTION", _) => {
                section = entity.groups.iter().find(|group| group.code == 2).map_or("", |group| group.value);
                drawing.unit = drawing.unit.or(unit(&entity));
            }
            ("ENDSEC", _) => section = "",
            (_, "ENTITIES") => read(&entity, &mut open, &mut drawing.pieces)?,
            _ => {}
        }
    }
    Ok(drawing)
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

/// The unit of the header's $INSUNITS [m].
fn unit(section: &Entity) -> Option<f64> {
    let at = section.groups.iter().position(|group| group.code == 9 && group.value == "$INSUNITS")?;
    match section.groups.get(at + 1)?.value {
        "1" => Some(0.0254),
        "2" => Some(0.3048),
        "4" => Some(1e-3),
        "5" => Some(1e-2),
        "6" => Some(1.0),
        _ => None,
    }
}

impl Entity<'_> {
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

    fn is_closed(&self) -> Result<bool, Fault> {
        Ok(self.number(70, Some(0.0))? as i64 & 1 == 1)
    }
}

fn finite(group: &Group) -> Result<f64, Fault> {
    let value = group.value.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| Fault::new(group.line, format!("`{}`", shortened(group.value)), "a finite number"))
}

/// A polyline on its way: its vertices with their bulges.
#[derive(Default)]
struct Open {
    closed: bool,
    vertices: Vec<(Placed, f64)>,
}

impl Open {
    fn piece(self) -> Vec<Placed> {
        let Open { closed, vertices } = self;
        let mut piece: Vec<Placed> = vertices.first().map(|(first, _)| *first).into_iter().collect();
        for pair in vertices.windows(2) {
            piece.extend(bulged(pair[1].0.0, pair[0].0.1, pair[1].0.1, pair[0].1));
        }
        if let (true, [first, .., last]) = (closed, vertices.as_slice()) {
            piece.extend(bulged(last.0.0, last.0.1, first.0.1, last.1));
        }
        piece
    }
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
            pieces.push(arc(line, centre, radius, from, if to > from { to } else { from + 360.0 }));
        }
        "LWPOLYLINE" => pieces.push(Open { closed: entity.is_closed()?, vertices: vertices(entity)? }.piece()),
        "POLYLINE" => *open = Some(Open { closed: entity.is_closed()?, ..Open::default() }),
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
        parse(&format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"))
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
        assert_eq!(parse(text).expect("a drawing").unit, Some(1e-3));
    }

    #[test]
    fn curves_and_broken_pairs_are_refused_with_their_line() {
        assert_eq!(of("0\nSPLINE\n10\n0\n").expect_err("a curve").line, 6);
        assert_eq!(of("0\nLINE\n10\nabc\n").expect_err("no number").line, 8);
        assert_eq!(parse("AutoCAD Binary DXF\n\n").expect_err("binary").line, 1);
        assert!(of("0\nLINE\n10\n0\n").is_err());
    }
}
