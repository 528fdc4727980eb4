use super::HOSTILE;
use base64::Engine;
use report::{Bar, Block, Mark, Part, Report, Status, Table, chart_svg, flow_png, flow_svg, render};

use super::charts::{chart, curve};
use super::pictures::{particles, view};
use super::xml::assert_well_formed;

fn report(blocks: Vec<Block>) -> Report {
    Report {
        title: "Wedge".into(),
        subtitle: "a test".into(),
        status: Status::Completed,
        sections: vec![("One".into(), blocks), (HOSTILE.into(), vec![]), ("Three".into(), vec![])],
    }
}

fn part(label: &str, size: f64) -> Part {
    Part { label: label.into(), size }
}

fn every_block() -> Report {
    let (frame, view) = (particles(&[(0.0, 0.0, 5.0)]), view());
    let lines = |mark| curve(mark, vec![0.0, 1.0, 2.0], vec![1.0, f64::NAN, 3.0]);
    let mut hostile = chart(vec![lines(Mark::Line), lines(Mark::Points)]);
    hostile.title = HOSTILE.into();
    hostile.curves[0].label = HOSTILE.into();
    let table = Table { title: HOSTILE.into(), head: vec![HOSTILE.into()], rows: vec![vec![HOSTILE.into(); 2]] };
    report(vec![
        Block::Text(format!("First.\nStill first.\n\n{HOSTILE}")),
        Block::Table(table),
        Block::Chart(hostile),
        Block::Chart(chart(vec![])),
        Block::Bar(Bar {
            title: HOSTILE.into(),
            unit: HOSTILE.into(),
            parts: vec![part(HOSTILE, 1.0), part("b", f64::NAN)],
        }),
        Block::Bar(Bar::default()),
        Block::Drawing { svg: flow_svg(&frame, &view), caption: HOSTILE.into() },
        Block::Code { title: HOSTILE.into(), text: format!("a = 1\n  {HOSTILE}") },
    ])
}

#[test]
fn the_page_is_self_contained_and_escapes_every_text() {
    for status in [Status::Completed, Status::Interrupted, Status::Failed(HOSTILE.into())] {
        let report = Report { title: HOSTILE.into(), subtitle: HOSTILE.into(), status, ..every_block() };
        let page = render(&report);
        let elements = page.strip_prefix("<!doctype html>\n").expect("a document type");
        let (before, script) = elements.split_once("<script>").expect("the page's own script");
        let (script, after) = script.split_once("</script>").expect("its end");
        assert_well_formed(&(before.to_owned() + after));
        assert!(!(before.to_owned() + script + after).contains("<script"), "one script, which is the page's own");
        assert!(page.contains("&lt;script&gt;"));
        let page = page.replace("http://www.w3.org/2000/svg", "");
        for link in ["http://", "https://", "@import", "<link", "<iframe"] {
            assert!(!page.contains(link), "the page reaches out: {link}");
        }
        assert_eq!(page.matches("url(").count(), page.matches("url(#").count());
        assert!(!page.contains("src="), "pictures are SVG images with their data inside");
    }
}

#[test]
fn the_page_holds_the_picture_itself() {
    let drop = particles(&[(0.1, 0.0, 5.0)]);
    let png = flow_png(&drop, &view());
    let page = render(&report(vec![Block::Drawing { svg: flow_svg(&drop, &view()), caption: "A drop".into() }]));
    let (_, data) = page.split_once("base64,").expect("a picture");
    let data = data.split('"').next().expect("an end of the picture");
    assert_eq!(base64::engine::general_purpose::STANDARD.decode(data).expect("base64"), png);
}

#[test]
fn figures_tables_and_sections_are_numbered_and_numbers_align() {
    let page = render(&every_block());
    for expected in
        ["<b>Figure 1.</b>", "<b>Figure 5.</b>", "<b>Table 1.</b>", "href=\"#section-2\"", "id=\"section-2\""]
    {
        assert!(page.contains(expected), "{expected} is missing");
    }
    assert!(!page.contains("Figure 6."));
    assert!(page.contains("<p>First.\nStill first.</p>\n<p>"));

    let cells = |rows: &[&[&str]]| rows.iter().map(|row| row.iter().map(|c| c.to_string()).collect()).collect();
    let table = Table {
        title: "Errors".into(),
        head: ["case", "error [%]", "note"].map(String::from).to_vec(),
        rows: cells(&[&["wedge", "−3.4 %", "1"], &["plate", "2e-3", "one"], &["dam", "–"]]),
    };
    let page = render(&report(vec![Block::Table(table)]));
    assert!(page.contains("<th>case</th><th class=\"number\">error [%]</th><th>note</th>"));
    assert!(page.contains("<td>wedge</td><td class=\"number\">−3.4 %</td><td>1</td>"));
    assert!(page.contains("<td>dam</td><td class=\"number\">–</td><td></td>"), "short rows are filled up");
}

#[test]
fn the_page_says_how_the_run_ended() {
    let page = |status| render(&Report { status, ..report(vec![]) });
    assert!(page(Status::Completed).contains("class=\"status completed\""));
    assert!(page(Status::Interrupted).contains("class=\"status interrupted\""));
    let failed = page(Status::Failed("412 m/s at t = 0.0118 s".into()));
    assert!(failed.contains("class=\"status failed\"") && failed.contains("412 m/s at t = 0.0118 s"));
}

#[test]
fn the_same_report_gives_the_same_bytes() {
    let first = render(&every_block());
    chart_svg(&chart(vec![]));
    assert!(render(&every_block()) == first);
}
