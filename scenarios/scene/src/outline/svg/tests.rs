//! Shapes, transforms and curves; what is left out and what is refused.

use std::f64::consts::PI;

use fsi_coupling::geometry::polygon::signed_area;

use super::*;

/// Names of Inkscape, as it writes them.
const INKSCAPE: &str = "xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' \
                        xmlns:sodipodi='http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd'";

fn read(content: &str) -> Drawing {
    parse(&format!("<svg {INKSCAPE}>{content}</svg>"), None).expect(content)
}

/// The points of the only line.
fn points(content: &str) -> Vec<[f64; 2]> {
    let drawing = read(content);
    assert_eq!(drawing.pieces.len(), 1, "{content}");
    drawing.pieces[0].iter().map(|(_, point)| *point).collect()
}

fn area(content: &str) -> f64 {
    let mut points = points(content);
    assert_eq!(points.pop(), points.first().copied(), "{content}: closed");
    signed_area(&points).abs()
}

fn near(content: &str, expected: &[[f64; 2]]) {
    let found = points(content);
    let same = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(same), "{content}: {found:?}");
}

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

/// Each kind of transform on the rectangle from [1, 2] to [4, 4]; the corners by hand.
#[test]
fn a_transformed_rectangle_has_its_corners_and_area() {
    let rect = |transform: &str| format!("<rect x='1' y='2' width='3' height='2' transform='{transform}'/>");
    for (transform, corner, size) in [
        ("translate(10)", [11.0, 2.0], 6.0),
        ("translate(10 -1)", [11.0, 1.0], 6.0),
        ("scale(2)", [2.0, 4.0], 24.0),
        ("scale(2,-3)", [2.0, -6.0], 36.0),
        ("rotate(90)", [-2.0, 1.0], 6.0),
        ("rotate(90 1 2)", [1.0, 2.0], 6.0),
        ("skewX(45)", [3.0, 2.0], 6.0),
        ("skewY(45)", [1.0, 3.0], 6.0),
        ("matrix(0 1 -2 0 5 6)", [1.0, 7.0], 12.0),
        ("translate(10) scale(2)", [12.0, 4.0], 24.0),
        ("scale(2), translate(10)", [22.0, 4.0], 24.0),
    ] {
        let text = rect(transform);
        let [x, y] = points(&text)[0];
        assert!((x - corner[0]).hypot(-y - corner[1]) < 1e-12, "{transform}: [{x}, {y}]");
        assert!((area(&text) - size).abs() < 1e-11, "{transform}: {}", area(&text));
    }
    let groups = format!("<g transform='translate(10)'><g transform='scale(2)'>{}</g></g>", rect("rotate(90)"));
    near(&groups, &[[6.0, -2.0], [6.0, -8.0], [2.0, -8.0], [2.0, -2.0], [6.0, -2.0]]);
}

/// A circle of radius 2 in every way that it is written; the area to 0.1 %.
#[test]
fn circles_have_their_area() {
    let k = 2.0 * 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
    let cubic = format!("M2,0C2,{k} {k},2 0,2S-2,{k} -2,0s{},-2 2,-2 2,{} 2,2z", 2.0 - k, 2.0 - k);
    for content in [
        "<circle cx='5' r='2'/>".to_string(),
        "<ellipse cy='5' rx='2' ry='2'/>".into(),
        "<path d='M2 0A2 2 0 0 1-2 0A2 2 0 1 1 2 0z'/>".into(),
        "<path d='m2 0a2 2 0 11-4 0 2 2 0 014 0z'/>".into(),
        format!("<path d='{cubic}'/>"),
        "<g transform='scale(.02 1)'><ellipse rx='100' ry='2' transform='rotate(180)'/></g>".into(),
        "<rect width='4' height='4' rx='2'/>".into(),
        // radii that are too small grow
        "<path d='M2 0A1 1 0 0 1-2 0A1 1 0 0 1 2 0z'/>".into(),
    ] {
        let found = area(&content);
        assert!((found / (4.0 * PI) - 1.0).abs() < 1e-3, "{content}: {found}");
        assert!((90..600).contains(&points(&content).len()), "{content}: {}", points(&content).len());
    }
    let rounded = area("<rect width='4' height='6' rx='1' ry='2'/>");
    assert!((rounded - (24.0 - (4.0 - PI) * 2.0)).abs() < 2e-3, "{rounded}");
}

/// Quadratic curves: under y = x² from -1 to 1 the area is 2/3; T goes on with the mirrored control point.
#[test]
fn quadratic_curves_are_parabolas() {
    assert!((area("<path d='M-1 1Q0-1 1 1z'/>") - 4.0 / 3.0).abs() < 1e-3);
    let wave = points("<path d='M0 0q1 2 2 0t2 0'/>");
    let highest = wave.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    assert!((highest - 1.0).abs() < 1e-9 && wave.last() == Some(&[4.0, -0.0]), "{highest}");
}

/// As Inkscape 1.x writes a drawing in mm: a layer that is shifted, a path with relative curves, a guide, a named view.
#[test]
fn a_drawing_of_inkscape_is_read() {
    let text = format!(
        r##"<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape (http://www.inkscape.org/) -->
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg
   width="210mm"
   height="297mm"
   viewBox="0 0 210 297"
   version="1.1"
   id="svg1"
   {INKSCAPE}>
  <sodipodi:namedview
     id="namedview1"
     inkscape:document-units="mm"><inkscape:grid id="grid1" /></sodipodi:namedview>
  <defs
     id="defs1"><clipPath id="c"><rect width="1" height="1" /></clipPath></defs>
  <metadata><title>hull &amp; deck</title></metadata>
  <g
     inkscape:label="Layer 1"
     inkscape:groupmode="layer"
     id="layer1"
     transform="translate(-10,-20)">
    <path
       style="fill:none;stroke:#000000;stroke-width:0.264583"
       d="m 20,30 h 40 v 10 c 0,5.522847 -4.477153,10 -10,10 H 30 c -5.522847,0 -10,-4.477153 -10,-10 z"
       id="path1"
       inkscape:label="hull"
       sodipodi:nodetypes="ccccccc" />
  </g>
</svg>
"##
    );
    let drawing = parse(&text, Some("hull")).expect("a drawing");
    let line: Vec<[f64; 2]> = drawing.pieces[0].iter().map(|(_, point)| *point).collect();
    assert_eq!((drawing.unit, drawing.pieces.len(), line[0], line[1]), (Some(1e-3), 1, [10.0, -10.0], [50.0, -10.0]));
    let size = signed_area(&line[..line.len() - 1]).abs();
    let exact = 800.0 - (2.0 - PI / 2.0) * 100.0;
    assert!((size / exact - 1.0).abs() < 1e-3, "{size}");
    assert_eq!(drawing.pieces[0][0].0, text.lines().position(|line| line.contains("d=\"m 20")).expect("a path") + 1);
    let notes = drawing.notes();
    assert!(notes.len() == 1 && notes[0].starts_with("1 lines in definitions"), "{notes:?}");
}

/// Flags of an arc without separators: https://github.com/svg/svgo/issues/822
#[test]
fn flags_of_arcs_need_no_separators() {
    let apart = points("<path d='M0 0a1 1 0 0 0 1 1'/>");
    assert_eq!(points("<path d='M0 0a1 1 0 001 1'/>"), apart);
    assert_eq!(apart.last(), Some(&[1.0, -1.0]));
}

/// An arc in a group that is turned keeps its shape: https://github.com/mathandy/svgpathtools/issues/126
#[test]
fn an_arc_in_a_turned_group_keeps_its_shape() {
    let arc = "<path d='M12 -12 A12 12 0 0 1 -12 -12'/>";
    let turned = format!("<g transform='translate(80,80)'><g transform='rotate(36)'>{arc}</g></g>");
    let (sin, cos) = 36.0_f64.to_radians().sin_cos();
    let expected: Vec<[f64; 2]> =
        points(arc).iter().map(|[x, y]| [80.0 + x * cos + y * sin, -80.0 - x * sin + y * cos]).collect();
    near(&turned, &expected);
}

/// skewX by the tangent of its angle: https://github.com/nfroidure/svg-pathdata/issues/78
#[test]
fn a_skew_goes_by_the_tangent() {
    let skewed = "<path transform=\"skewX(30)\" d=\"M0,0H10V10H0Z\"/>";
    let shift = 10.0 / 3.0_f64.sqrt();
    near(skewed, &[[0.0, 0.0], [10.0, 0.0], [10.0 + shift, -10.0], [shift, -10.0], [0.0, 0.0]]);
}

/// A relative start behind the end of a closed line: https://github.com/thorvg/thorvg/pull/74
#[test]
fn a_relative_start_counts_from_the_start_of_the_closed_line() {
    let drawing = read("<path d='M 52 20 H 12 V 43 H 52 Z m -1.5 21.5 H 13 v -20 Z h 1'/>");
    let starts: Vec<_> = drawing.pieces.iter().map(|piece| piece[0].1).collect();
    assert_eq!(starts, [[52.0, -20.0], [50.5, -41.5], [50.5, -41.5]]);
}

/// A layer that is not displayed, an aid that is not visible; and the layer by its label.
#[test]
fn hidden_groups_are_left_out_and_a_group_can_be_chosen() {
    let text = format!(
        "<svg {INKSCAPE}>\n<g id='g1' inkscape:label='hull'><polygon points='0,0 1,0 1,-1'/></g>\n\
         <g inkscape:label='old' style='display: none; fill:red'><g><line x2='5' y2='5'/></g></g>\n\
         <line x2='7' y2='7' visibility='hidden'/></svg>"
    );
    let all = parse(&text, None).expect("a drawing");
    assert_eq!((all.pieces.len(), all.hidden), (1, 2));
    assert!(all.notes()[0].contains("2 hidden"), "{:?}", all.notes());
    for name in ["hull", "g1"] {
        assert_eq!(parse(&text, Some(name)).expect("a group").pieces, all.pieces);
    }
    let old = parse(&text, Some("old")).expect("a hidden group that is asked for");
    assert_eq!(old.pieces[0][1].1, [5.0, -5.0]);
    let none = parse(&text, Some("deck")).expect_err("no such group");
    assert!(none.expected.contains("hull") && none.expected.contains("old"), "{none:?}");
}

#[test]
fn what_is_no_outline_is_refused_with_its_line() {
    for (text, line, part) in [
        ("<svg>\n<g\n transform='turn(2)'><path/></g></svg>", 3, "`turn(2)` in transform"),
        ("<svg>\n\n<text>hull</text></svg>", 3, "<text>"),
        ("<svg>\n<use href='#a'/></svg>", 2, "<use>"),
        ("<svg>\n<svg><path/></svg></svg>", 2, "<svg>"),
        ("<svg>\n<image width='1'/></svg>", 2, "<image>"),
        ("<svg><g\n clip-path='url(#c)'><path/></g></svg>", 2, "clip-path = `url(#c)`"),
        ("<svg><g>\n<path style='transform:rotate(3deg)'/></g></svg>", 2, "`rotate(3deg)` in style"),
        ("<svg>\n<path id='a'\n d='M0 0 1 2 X3'/></svg>", 3, "`X3` in d"),
        ("<svg>\n<path d='M0 0A1e300 1 0 0 1 5 5'/></svg>", 2, "too large"),
        ("<svg>\n<path d='L1 2'/></svg>", 2, "`L1 2` in d"),
        ("<svg>\n<circle r='1%'/></svg>", 2, "r = `1%`"),
        ("<svg>\n<polygon points='1 2 3'/></svg>", 2, "3 numbers"),
        ("<svg>\n<polygon points='1 b'/></svg>", 2, "`b` in points"),
        ("<svg>\n<polygon", 2, "never closed"),
        ("<svg>\n<g><path></g></svg>", 2, "path"),
        ("<html></html>", 1, "no <svg>"),
    ] {
        let fault = parse(text, None).expect_err(text);
        assert!(fault.line == line && fault.given.contains(part), "{text}: {fault:?}");
    }
    let deep = format!("<svg>{}<path d='M0 0h1v1z'/>{}</svg>", "<g>".repeat(50_000), "</g>".repeat(50_000));
    assert_eq!(parse(&deep, None).expect("a drawing").pieces.len(), 1);
    let many = format!("<svg><path d='M0 0{}'/></svg>", "q1 1 0 2".repeat(1000));
    let fault = parse(&many, None).expect("a drawing").joined().expect_err("too many points");
    assert!(fault.expected.contains("at most"), "{fault:?}");
}
