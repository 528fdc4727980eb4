//! A map as a page and as a table.

use report::{Block, Column, Report, Status, Table, known, render};

use super::{Bound, Map, Measured, Point, Verdict, svg};

/// The map, what its verdicts mean, and every point with its reason and its command.
pub fn page(measured: &Measured) -> String {
    let map = &measured.map;
    let columns: &[Column<(&Map, &Point)>] = &[
        ("x", |(_, p)| p.x.clone()),
        ("y", |(_, p)| p.y.clone()),
        ("verdict", |(_, p)| p.verdict.name().into()),
        ("why", |(_, p)| p.why.clone()),
        ("over theory's limit [-]", |(_, p)| known(p.theory, 3)),
        ("steps", |(_, p)| p.steps.to_string()),
        ("command", |(map, p)| map.command(&p.x, &p.y)),
    ];
    let points = Table::of("A point a row", measured.points.iter().map(|p| (map, p)), columns);
    let meaning = std::iter::once(map.note.clone()).chain(criteria(measured)).chain(fits(measured));
    render(&Report {
        title: format!("splashdown stability: {}", map.name),
        subtitle: format!("{}; scene {}, version {}", map.about, map.scene, measured.version),
        status: Status::Completed,
        sections: vec![
            ("Map".into(), vec![Block::Drawing { svg: svg(measured), caption: map.about.clone() }]),
            ("What it means".into(), vec![Block::Text(meaning.collect::<Vec<_>>().join("\n\n"))]),
            ("Points".into(), vec![Block::Table(points)]),
        ],
    })
}

/// The map as Markdown: rows from the top as drawn, columns as x.
pub fn table(measured: &Measured) -> String {
    let map = &measured.map;
    let mut text = format!("{}.\n\n", map.about);
    if !map.note.is_empty() {
        text += &format!("{}\n\n", map.note);
    }
    let corner = format!("{} \\ {}", map.y.label, map.x.label);
    let head: Vec<String> = std::iter::once(corner).chain(map.x.names()).chain(["cells off theory".into()]).collect();
    let row = |(j, name): (usize, String)| {
        let off = measured.misfit(j).map_or("–".into(), |cells| cells.to_string());
        let marks = measured.row(j).iter().map(|p| mark(p).to_string());
        std::iter::once(name).chain(marks).chain([off]).collect()
    };
    let rows: Vec<Vec<String>> = map.y.names().into_iter().enumerate().rev().map(row).collect();
    text += &Table { title: String::new(), head, rows }.markdown();
    for line in criteria(measured) {
        text += &format!("\n- {line}");
    }
    if let Some(p) = measured.points.iter().find(|p| p.verdict == Verdict::Failed).or(measured.points.first()) {
        text += &format!("\n- `{}`: {}, {}", map.command(&p.x, &p.y), p.verdict.name(), p.why);
    }
    text + "\n"
}

/// Bold where a run failed; in brackets where run and theory differ.
fn mark(p: &Point) -> &'static str {
    let expected = p.theory.is_none_or(|ratio| (ratio >= 1.0) == (p.verdict == Verdict::Failed));
    match (p.verdict, expected) {
        (Verdict::Stable, true) => "·",
        (Verdict::Stable, false) => "(·)",
        (Verdict::Inaccurate, true) => "~",
        (Verdict::Inaccurate, false) => "(~)",
        (Verdict::Failed, true) => "**×**",
        (Verdict::Failed, false) => "(**×**)",
    }
}

/// What counts as failed and as inaccurate, in words, and the theory.
fn criteria(measured: &Measured) -> Vec<String> {
    let map = &measured.map;
    let words = |b: &Bound| {
        let side = |limit: Option<f64>, word: &str| limit.map(|limit| format!("{word} {limit}"));
        let sides: Vec<String> = side(b.least, "below").into_iter().chain(side(b.most, "above")).collect();
        format!("{} {} ({})", b.quantity, sides.join(" or "), b.meaning)
    };
    let list = |bounds: &[Bound]| bounds.iter().map(words).collect::<Vec<_>>();
    let usual = format!(
        "an error, {} steps without an end, energy grown by more than {} of what was exchanged, water beyond a wall, momentum \
         open by more than {:e}",
        map.most_steps, map.most_energy_gain, map.most_momentum_gap
    );
    let failed: Vec<String> = std::iter::once(usual).chain(list(&map.failed)).collect();
    let mut lines = vec![format!("Scene: {} with {}.", map.scene, map.set.join(", "))];
    lines.push(format!("Failed (×): {}.", failed.join("; ")));
    if !map.inaccurate.is_empty() {
        lines.push(format!("Inaccurate (~): {}.", list(&map.inaccurate).join("; ")));
    }
    lines.extend(map.theory.map(|theory| format!("Boundary: {}.", theory.name())));
    lines
}

/// How far each row's boundary is from the theory's.
fn fits(measured: &Measured) -> Option<String> {
    let rows = measured.map.y.names().into_iter().enumerate();
    let rows: Vec<String> = rows.filter_map(|(j, y)| Some(format!("{y}: {}", measured.misfit(j)?))).collect();
    (!rows.is_empty()).then(|| format!("Cells between the boundary found and the theory's: {}.", rows.join("; ")))
}
