//! `certify.html`: the dossier of a list of landings, for a browser and for paper.

use report::run_page::quantity::{Unit, digits, with_unit};
use report::{Block, Card, Chart, Curve, Lead, Mark, Table, Tone, escape, lead_html, page, row};

use super::dossier_tables as tables;
use super::findings::{Counts, Findings, STATEMENT};
use super::{Case, Plan};

/// Each section of paper begins a page; rows and short tables stay whole.
const PRINT: &str = "<style>@media print { @page { size: A4; margin: 16mm 14mm; } main > section { break-before: page; } tr { break-inside: avoid; } \
    thead { display: table-header-group; } td { overflow-wrap: break-word; } }</style>\n";

/// Numbers that the head shows, where they are there.
const CARDS: [&str; 6] =
    ["upward_acceleration", "deceleration", "load_factor", "water_force", "cell_pressure", "flotation.sinks"];
/// Commands that repeat cases, at most.
const COMMANDS: usize = 12;

/// The page.
pub fn dossier(plan: &Plan, found: &Findings) -> String {
    let sections = [
        ("Statement of use", vec![Block::Text(STATEMENT.into()), Block::Text(how_to_read().into())]),
        ("What the rule asks, and what answers it", tables::paragraphs(found)),
        ("Inputs", tables::inputs(found)),
        ("Cases", tables::cases(found)),
        ("Worst cases", tables::worst(found)),
        ("Envelope of the structure", [charts(found), tables::stations(plan, found)].concat()),
        ("Envelope of pressures", [pressure_chart(found), tables::pressures(found)].concat()),
        ("The model and its range", vec![Block::Html(list(&model(plan)))]),
        ("Evidence", evidence(found)),
        ("Commands that repeat it", commands(plan, found)),
    ];
    let sections: Vec<(String, Vec<Block>)> = sections.into_iter().map(|(h, blocks)| (h.to_string(), blocks)).collect();
    page(
        &format!("splashdown certify: {}", found.scene),
        &(PRINT.to_string() + &lead_html(&lead(plan, found))),
        &sections,
    )
}

fn how_to_read() -> &'static str {
    "Each number names the case that gives it; cases.csv has all cases, certify.json the same as this page for programs, pressure_envelope.csv the cells \
     of the bottom. A case is a landing on the water by strips (2D+t) that the last section repeats by one command.\n\n\
     Numbers of cases that failed on their way stand apart: they are those up to the failure. A case with a doubt is marked; the table of reasons says which doubt."
}

fn lead(plan: &Plan, found: &Findings) -> Lead {
    let Counts { completed, doubtful, failed, outside } = found.counts;
    let of = |name: &&str| found.worst.iter().find(|worst| worst.name == **name);
    let card = |worst: &super::findings::Worst| {
        let unit = Unit::of(worst.unit, worst.extreme.value);
        Card {
            title: format!("Worst: {}", worst.title),
            value: digits(unit.scale * worst.extreme.value),
            unit: if unit.name == "-" { String::new() } else { unit.name },
            lines: vec![(format!("case {}", found.case(worst.extreme.case)), None)],
            chip: Some((Tone::Doubtful, "no band known".into())),
        }
    };
    let open = found.paragraphs.iter().filter(|answer| answer.answer == super::rule::NOT_ANSWERED);
    let open: Vec<&str> = open.map(|answer| answer.paragraph.as_str()).collect();
    let of_paragraphs = match open.is_empty() {
        true => "Each paragraph is answered in part; none is answered wholly.".to_string(),
        false => format!("Not answered: {}. The others are answered in part.", open.join(", ")),
    };
    let description = &plan.scene.description;
    Lead {
        eyebrow: format!("{} · {} · splashdown {}", found.scene, found.rule, found.version),
        title: format!("Ditching dossier: {}", if description.is_empty() { &found.scene } else { description }),
        tone: Tone::Doubtful,
        heading: "In support of a showing of compliance: no load has a known band.".into(),
        reasons: vec![
            format!(
                "{} cases of {} combinations: {completed} completed, {doubtful} completed with a doubt, {failed} failed, {outside} not run.",
                found.cases, found.combinations
            ),
            of_paragraphs,
        ],
        cards: CARDS.iter().filter_map(of).map(card).collect(),
    }
}

/// Items of plain text as a list.
fn list(items: &[String]) -> String {
    let items: String = items.iter().map(|item| format!("<li>{}</li>\n", escape(item))).collect();
    format!("<ul class=\"reasons\">\n{items}</ul>\n")
}

/// Envelopes of the stations as curves: shear and bending of either sign.
fn charts(found: &Findings) -> Vec<Block> {
    let curve = |of: &str, si: &str, title: &str| {
        let at = |worst: &super::findings::Worst| {
            let x = worst.name.strip_prefix("station.")?.strip_suffix(of)?.strip_suffix('.')?;
            Some([x.parse::<f64>().ok()?, worst.extreme.value.abs()])
        };
        let mut points: Vec<[f64; 2]> = found.worst.iter().filter_map(at).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let unit = Unit::of(si, points.iter().fold(0.0, |most, point| f64::max(most, point[1])));
        let points = points.into_iter().map(|[x, y]| [x, unit.scale * y]);
        let label = format!("{title} [{}]", unit.name);
        Block::Chart(Chart::new(title, "place from the nose [m]", label, vec![Curve::new("", Mark::Line, points)]))
    };
    vec![
        curve("line_load", "N/m", "Largest load of a metre of the keel"),
        curve("bending", "N m", "Largest size of the bending moment in the cut"),
    ]
}

/// The largest pressure along the fuselage, at the keel, half way and at the edge.
fn pressure_chart(found: &Findings) -> Vec<Block> {
    let cells = &found.envelope.pressure;
    let Some(shares) = cells.first().map(Vec::len).filter(|shares| *shares > 1) else { return Vec::new() };
    let most = cells.iter().flatten().fold(0.0, |most, cell| f64::max(most, cell.value));
    let unit = Unit::of("Pa", most);
    let curve = |k: usize, label: &str, mark: Mark| {
        let at =
            |(place, row): (&[f64], &Vec<super::Extreme>)| [0.5 * (place[0] + place[1]), unit.scale * row[k].value];
        Curve::new(label, mark, found.places_m.windows(2).zip(cells).map(at))
    };
    let curves = vec![
        curve(0, "at the keel", Mark::Line),
        curve(shares / 2, "half way", Mark::Dashed),
        curve(shares - 1, "at the edge", Mark::Points),
    ];
    let title = "Largest mean pressure on cells of the bottom, over all cases";
    vec![Block::Chart(Chart::new(title, "place from the nose [m]", format!("pressure [{}]", unit.name), curves))]
}

/// The model, and what it does not have.
fn model(plan: &Plan) -> Vec<String> {
    let scene = &plan.scene;
    let landing = &scene.landing;
    let suction = format!(
        "Suction where the keel curves up acts by the share {} (water.suction). Ventilation limits it; the result depends on it strongly: certify 0 and 1 too.",
        digits(scene.water.suction)
    );
    let steps = format!(
        "{} strips, steps of {}, {} after the first touch or down to {}.",
        landing.strips,
        with_unit(landing.step, "s"),
        with_unit(landing.end, "s"),
        with_unit(landing.least_speed.unwrap_or_default(), "m/s")
    );
    let items = [
        "The fuselage passes through fixed vertical planes of water; in each plane a theory of water entry gives the load (2D+t, THEORY EN14 to EN19). \
         The aeroplane moves in surge, heave and pitch.",
        "Range: flight paths of 15 degrees down to level, attitudes of 0 to 30 degrees, forward speeds above landing.least_speed. A case outside is in the \
         list with its reason.",
        "Waves are long-crested, of linear theory, and not changed by the aeroplane; no wind, no roll, no yaw, no slope of the water across the flight. \
         Waves of the list keep to H/L below breaking and to four breadths of the fuselage.",
        "Wing, flaps, tailplane and engines are plates and bodies in a steady stream: no slam of a flat wing, no spray.",
        "A part of certify.failures goes with its first touch of the water. The lift of [wing] does not change with it.",
        "The pressure on a cell or a window is a mean over it; pressures at a point are higher. Shear and bending of a case are those of largest size in \
         each cut: values of the other sign are not in the envelope.",
        "Flotation: still water, one space inside, no buoyancy of the wing.",
    ];
    let model = format!("Model of the sections: {}.", scene.model.name());
    [model, steps, suction].into_iter().chain(items.map(String::from)).collect()
}

fn evidence(found: &Findings) -> Vec<Block> {
    let rows = found
        .evidence
        .iter()
        .map(|of| row(&[&of.quantity, &of.points, &of.cases, &of.bias, &of.scatter, &of.worst, &of.factor]));
    let head = ["quantity", "points", "cases", "bias", "σ model", "worst", "95 % factor"];
    let table =
        Table::new("Computed over measured, all landings and planing hulls that there are", &head, rows.collect());
    let text = "Bias is the mean of computed over measured; a true value is below a computed one times the 95 % factor with a probability of 95 % \
        (docs/src/validation/quantities.md, THEORY GE27 and GE28). The landings are aeroplanes on calm water, with geometry that is partly assumed. \
        No pressure on a bottom, no landing on waves and no flotation is compared with measured values of others: docs/src/validation/ditching.md.";
    vec![Block::Table(table), Block::Text(text.into())]
}

fn commands(plan: &Plan, found: &Findings) -> Vec<Block> {
    let sets: String = plan.given.iter().map(|set| format!(" --set '{set}'")).collect();
    let whole = format!("splashdown certify {}{sets} --out DIR", plan.file);
    let mut numbers: Vec<usize> =
        CARDS.iter().filter_map(|name| found.envelope.numbers.get(*name)).map(|e| e.case).collect();
    let windows = found.worst.iter().filter(|worst| worst.name.starts_with("window."));
    numbers.extend(windows.map(|worst| worst.extreme.case));
    numbers.extend(found.worst.iter().map(|worst| worst.extreme.case));
    let mut known = Vec::new();
    for number in numbers {
        if !known.contains(&number) && known.len() < COMMANDS {
            known.push(number);
        }
    }
    let case = |number: &usize| plan.cases.iter().find(|case: &&Case| case.number == *number);
    let lines: String = known.iter().filter_map(case).map(|case| plan.command(case) + "\n").collect();
    vec![
        Block::Code { title: format!("All cases, by splashdown {}", found.version), text: whole },
        Block::Code { title: "Cases that give worst values".into(), text: lines },
        Block::Text("Any other case: splashdown certify FILE --case NUMBER prints its command.".into()),
    ]
}
