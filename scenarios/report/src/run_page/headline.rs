//! The head of the page: how the run ended, in its colour, and its results.

use scene::vocabulary::{Doubt, Named, Quantity, ResultId, ResultName, Results, Status, Verdict};

use super::folder::RunFolder;
use super::quantity::{Unit, digits, percent, with_unit};
use super::record::Comparison;
use super::theories::model_in_words;
use super::{doubts, references};
use crate::COARSE;
use crate::markup::escape;

/// How a page is coloured by the way that the run ended.
struct Head {
    class: &'static str,
    heading: String,
    reasons: Vec<String>,
}

/// Title, status and results.
pub(super) fn lead(run: &RunFolder) -> String {
    let (scene, record) = (&run.scene, &run.record);
    let title = if scene.description.is_empty() { &scene.name } else { &scene.description };
    let Head { class, heading, reasons } = head(run);
    let items: String = reasons.iter().map(|why| format!("<li>{}</li>", doubts::html(why))).collect();
    let list = if items.is_empty() { String::new() } else { format!("<ul>{items}</ul>") };
    let version = if record.version.is_empty() { String::new() } else { format!(" · splashdown {}", record.version) };
    let host = record.host.as_ref().map_or("", |_| " · moved by a host program");
    let warned = match run.warnings.len() {
        0 => String::new(),
        count => format!(" <a href=\"#warnings\">{} about the scene</a>.", counted(count, "warning")),
    };
    format!(
        "<p class=\"eyebrow\">{} · {}{host}{}</p>\n<h1>{}</h1>\n<div class=\"status {class}\"><strong>{}</strong>{warned}{list}</div>\n{}",
        escape(&scene.name),
        escape(model_in_words(run.model())),
        escape(&version),
        escape(title),
        escape(&heading),
        cards(run)
    )
}

/// A count of something.
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// A number with its band in its unit.
pub(super) fn with_band(quantity: &Quantity, si: &str) -> String {
    let Some(value) = quantity.shown() else { return "–".into() };
    let unit = Unit::of(si, value);
    let band = quantity.band.map_or(String::new(), |band| format!(" ± {}", two_digits(unit.scale * band)));
    let name = if unit.name == "-" { String::new() } else { format!(" {}", unit.name) };
    format!("{}{band}{name}", digits(unit.scale * value))
}

/// A number with its band, also in percent.
pub(super) fn with_share(quantity: &Quantity, si: &str) -> String {
    let share = quantity.share().map_or(String::new(), |share| format!(" ({})", percent(share)));
    with_band(quantity, si) + &share
}

/// The share of a resolved result's band, where it is so wide that the result is coarse.
fn coarse(quantity: &Quantity) -> Option<f64> {
    quantity.share().filter(|share| *share > COARSE && quantity.verdict == Verdict::Resolved)
}

/// What may be said of a result, in words.
pub(super) fn verdict_of(run: &RunFolder, id: &ResultId, quantity: &Quantity) -> String {
    let words = match coarse(quantity) {
        Some(share) => format!("coarse, ± {}", percent(share)),
        None if quantity.is_withheld() => format!("{}: its band is as large as itself", quantity.verdict.words()),
        None => quantity.verdict.words().to_string(),
    };
    let doubted = |panel: &String| run.record.doubts.iter().any(|doubt| doubt.about == [panel.clone()]);
    match &id.panel {
        Some(panel) if !quantity.verdict.is_sound() && !doubted(panel) => {
            format!("{words}, as the force")
        }
        _ if run.is_interrupted() && quantity.time_s.is_none() => "not complete".to_string(),
        _ if run.is_interrupted() => format!("{words}, so far"),
        _ if quantity.allowed == Some(false) => format!("{words}; not allowed"),
        _ => words,
    }
}

/// When a run ended.
fn end(run: &RunFolder) -> String {
    run.record.time_end_s.map_or("–".into(), |time| with_unit(time, "s"))
}

/// A result's name in words, with its gauge.
pub(super) fn title(run: &RunFolder, id: &ResultId) -> String {
    match run.gauge_of_peak().filter(|_| id.name == ResultName::PeakPressure) {
        Some(gauge) => format!("{} at {gauge}", id.title()),
        None => id.title(),
    }
}

/// A number with two significant digits.
pub fn two_digits(value: f64) -> String {
    let places = (1.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.places$}")
}

/// The allowable stress of a panel [Pa].
pub(super) fn allowable(run: &RunFolder, panel: &str) -> Option<f64> {
    let panels = run.scene.body.iter().flat_map(|body| &body.panels);
    panels.filter(|own| own.name == panel).find_map(|own| own.allowable_stress)
}

/// The strain at which an end of a panel breaks off [-].
fn rupture_strain(run: &RunFolder, panel: &str) -> Option<f64> {
    let panels = run.scene.body.iter().flat_map(|body| &body.panels);
    panels.filter(|own| own.name == panel).find_map(|own| own.rupture_strain)
}

/// Panels that are beyond their limits, each with a sentence.
fn overstressed(run: &RunFolder) -> Vec<(String, String)> {
    let at =
        |quantity: &Quantity| quantity.time_s.map_or(String::new(), |time| format!(" at {}", with_unit(time, "s")));
    let of = |(name, panel): (&String, &Named)| {
        let stress = panel.get(&ResultName::PeakStress).filter(|stress| stress.allowed == Some(false))?;
        let factor = panel.get(&ResultName::ReserveFactor).and_then(Quantity::shown);
        let factor = factor.map_or(String::new(), |factor| format!(" (reserve factor {})", digits(factor)));
        let known = if stress.verdict.is_sound() { String::new() } else { format!(", {}", stress.verdict.words()) };
        if let Some(strain) = panel.get(&ResultName::PeakStrain) {
            let limit = rupture_strain(run, name);
            let limit =
                limit.map_or("no rupture_strain is given".into(), |v| format!("{} is allowed", with_unit(v, "-")));
            let value = with_unit(strain.value, "-");
            return Some(format!("{name} yields, to a strain of {value}{}{known}; {limit}{factor}", at(strain)));
        }
        let of_allowed = allowable(run, name).map_or(String::new(), |v| format!("; {} is allowed", with_unit(v, "Pa")));
        let value = if stress.is_withheld() { "a stress".into() } else { with_unit(stress.value, "Pa") };
        Some(format!("{name} reaches {value}{}{known}{of_allowed}{factor}", at(stress)))
    };
    let beyond = run.record.results.panels.iter();
    beyond.filter_map(|panel| Some((panel.0.clone(), of(panel)?))).collect()
}

fn head(run: &RunFolder) -> Head {
    let record = &run.record;
    let overstressed = overstressed(run);
    let other = |doubt: &&Doubt| overstressed.is_empty() || !doubt.why.beyond_limit;
    // what a run computed before it broke down is no result to be doubted
    let mut reasons = if run.has_failed() { Vec::new() } else { doubts::merged(record.doubts.iter().filter(other)) };
    let (class, heading) = match record.status() {
        Status::BeyondAllowable => {
            reasons.extend(overstressed.iter().filter_map(|(panel, _)| doubts::of_material(run, panel)));
            let yields =
                |(panel, _): &(String, String)| record.results.of_panel(panel, ResultName::PeakStrain).is_some();
            let what = if overstressed.iter().any(yields) { "Panel" } else { "Stress" };
            let sentences: Vec<String> = overstressed.iter().map(|(_, sentence)| sentence.clone()).collect();
            ("failed", format!("{what} beyond the allowable: {}.", sentences.join("; ")))
        }
        Status::Ruptured => {
            reasons.push("The surface stays closed to the water: what comes after a rupture is not computed.".into());
            ("failed", format!("Rupture: {}.", record.message.as_deref().unwrap_or_default()))
        }
        Status::Completed => completed(run, &mut reasons),
        Status::CompletedWithDoubts => ("doubtful", "Completed with doubts.".to_string()),
        Status::Failed => {
            reasons.push(
                "The run has no results: its curves and pictures end with the failure, and show how it came.".into(),
            );
            let message = times_in_words(record.message.as_deref().unwrap_or_default());
            ("failed", format!("Failed. {}.", message.trim_end_matches('.')))
        }
        Status::Interrupted => {
            if run.path.join("checkpoint.bin").is_file() {
                reasons.push(format!("To go on: `splashdown resume {}`", run.path.display()));
            }
            ("doubtful", format!("Interrupted at {}. The results are those so far.", end(run)))
        }
        Status::NotFinished => ("doubtful", "Not finished.".to_string()),
    };
    if !run.has_failed() && record.status() != Status::BeyondAllowable {
        let yielded = record.panels.iter().filter(|(_, panel)| panel.yielded);
        reasons.extend(yielded.filter_map(|(name, _)| doubts::of_material(run, name)));
    }
    reasons.extend(study(run));
    reasons.extend(run.gaps.iter().cloned());
    Head { class, heading, reasons }
}

/// Of a run that completed without doubts: what a reader should know nevertheless.
fn completed(run: &RunFolder, reasons: &mut Vec<String>) -> (&'static str, String) {
    let results = &run.record.results;
    let mut parts = vec!["No doubts".to_string()];
    let titles = |is: &dyn Fn(&Quantity) -> bool| -> Vec<String> {
        results.named().filter(|(_, q)| is(q)).map(|(id, _)| doubts::lower(&title(run, &id))).collect()
    };
    let (wide, unknown) = (titles(&|q| coarse(q).is_some()), titles(&|q| q.verdict == Verdict::NoBand));
    if !wide.is_empty() {
        parts.push(format!("coarse, with bands above {}: {}", percent(COARSE), wide.join(", ")));
    }
    if !unknown.is_empty() {
        parts.push(format!("no band is known for {}", unknown.join(", ")));
    }
    let outside = |c: &&Comparison| c.tolerance.zip(c.error).is_some_and(|(t, error)| error.abs() > t);
    let outside = run.record.comparison.iter().filter(outside).count();
    if outside > 0 {
        reasons.push(format!(
            "{} with references outside the tolerance: see Against references",
            counted(outside, "comparison")
        ));
    }
    let class = match () {
        _ if parts.len() > 1 || outside > 0 || study(run).is_some() => "doubtful",
        _ if !run.warnings.is_empty() => "noted",
        _ => "completed",
    };
    (class, format!("Completed. {}.", parts.join("; ")))
}

/// That a convergence study did not converge.
fn study(run: &RunFolder) -> Option<String> {
    let bars = run.record.error_bars.iter();
    let open =
        bars.filter(|(_, bar)| bar.method.starts_with("convergence study") && bar.verdict.starts_with("not converged"));
    let open: Vec<String> = open.map(|(path, _)| doubts::lower(&references::in_words(path))).collect();
    (!open.is_empty()).then(|| {
        format!(
            "The convergence study did not converge for: {}. The bands of the results below follow from laws fitted to other runs, not \
             from this study: see Error bars",
            open.join(", ")
        )
    })
}

/// A message with its time as the page writes times.
fn times_in_words(message: &str) -> String {
    let time = |from: usize| {
        let rest = message.get(from + 4..)?;
        let (number, _) = rest.split_once(" s").filter(|(number, _)| !number.contains(' '))?;
        Some((number.len() + 2, number.parse::<f64>().ok()?))
    };
    match message.find("t = ").and_then(|from| Some((from, time(from)?))) {
        Some((from, (length, seconds))) => {
            format!("{}t = {}{}", &message[..from], with_unit(seconds, "s"), &message[from + 4 + length..])
        }
        None => message.to_string(),
    }
}

/// A card for each result; none where the run failed.
fn cards(run: &RunFolder) -> String {
    let none = Results::default();
    let results = if run.has_failed() { &none } else { &run.record.results };
    let mut html = String::new();
    for (id, quantity) in results.named().filter(|(id, _)| id.name != ResultName::ReserveFactor) {
        if !quantity.value.is_finite() {
            continue;
        }
        let unit = Unit::of(id.name.si(), quantity.value);
        let band = match quantity.band {
            Some(_) if quantity.is_withheld() => "the band is as large as the value".into(),
            Some(band) => {
                let share = quantity.share().map_or(String::new(), |share| format!(" ({})", percent(share)));
                format!("± {} {}{share}", two_digits(unit.scale * band), unit.name)
            }
            None => "no band".into(),
        };
        let time = match quantity.time_s {
            Some(time) => format!("at {}", with_unit(time, "s")),
            None if run.is_interrupted() => format!("up to {}", end(run)),
            None => "over the run".into(),
        };
        let mut lines = vec![format!("{band}, {time}")];
        let yielded = |panel: &&str| run.record.panels.get(*panel).is_some_and(|own| own.yielded);
        let of_stress = id.of_panel(ResultName::PeakStress).filter(|panel| !yielded(panel));
        let panel = of_stress.or(id.of_panel(ResultName::PeakStrain)).unwrap_or_default();
        let factor = results.of_panel(panel, ResultName::ReserveFactor);
        if let Some(factor) = factor.filter(|_| !quantity.is_withheld()) {
            let limit = if yielded(&panel) {
                rupture_strain(run, panel).zip(Some("-"))
            } else {
                allowable(run, panel).zip(Some("Pa"))
            };
            let allowed = limit.map_or(String::new(), |(v, si)| format!(", {} allowed", with_unit(v, si)));
            lines.push(format!("reserve factor {}{allowed}", digits(factor.value)));
        }
        let class = match quantity.verdict {
            Verdict::Resolved if coarse(quantity).is_none() && !run.is_interrupted() => "completed",
            _ => "doubtful",
        };
        let class = if quantity.allowed == Some(false) { "failed" } else { class };
        let details: String = lines.iter().map(|line| format!("<p>{}</p>", escape(line))).collect();
        html += &format!(
            "<li class=\"{class}\"><h3>{}</h3><p class=\"value\">{} <small>{}</small></p>{details}<p class=\"chip\">{}</p></li>\n",
            escape(&title(run, &id)),
            if quantity.is_withheld() { "–".into() } else { digits(unit.scale * quantity.value) },
            escape(unit.name.trim_matches('-')),
            escape(&verdict_of(run, &id, quantity))
        );
    }
    if html.is_empty() { html } else { format!("<ul class=\"cards\">\n{html}</ul>\n") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_a_failure_is_written_as_other_times() {
        let message = "particle 0 has density 1312.9 kg/m^3 at t = 8.359392e-4 s: too much";
        assert_eq!(times_in_words(message), "particle 0 has density 1312.9 kg/m^3 at t = 0.836\u{a0}ms: too much");
        assert_eq!(times_in_words("nothing at t = once"), "nothing at t = once");
    }

    #[test]
    fn a_wide_band_is_coarse() {
        let (time_s, cutoff_hz, allowed, raw, verdict) = (None, None, None, -100.0, Verdict::Resolved);
        let with = |band: f64| Quantity { value: -100.0, band: Some(band), time_s, cutoff_hz, raw, verdict, allowed };
        assert_eq!((coarse(&with(29.0)), coarse(&with(61.0))), (None, Some(0.61)));
        assert_eq!(with_share(&with(61.0), "Pa"), "−100 ± 61 Pa (61 %)");
    }
}
