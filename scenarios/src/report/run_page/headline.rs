//! The head of the page: how the run ended, in its colour, and its results.

use super::folder::RunFolder;
use super::quantity::{Unit, digits, result, with_unit};
use super::record::Quantity;
use crate::report::markup::escape;

/// How a page is coloured by the way that the run ended.
struct Verdict {
    class: &'static str,
    heading: String,
    reasons: Vec<String>,
}

/// Title, status and results.
pub(super) fn lead(run: &RunFolder) -> String {
    let (scene, record) = (&run.scene, &run.record);
    let title = if scene.description.is_empty() { &scene.name } else { &scene.description };
    let Verdict { class, heading, reasons } = verdict(run);
    let items: String = reasons.iter().map(|why| format!("<li>{}</li>", escape(why))).collect();
    let list = if items.is_empty() { String::new() } else { format!("<ul>{items}</ul>") };
    let version = if record.version.is_empty() { String::new() } else { format!(" · splashdown {}", record.version) };
    format!(
        "<p class=\"eyebrow\">{} · model {}{}</p>\n<h1>{}</h1>\n<div class=\"status {class}\"><strong>{}</strong>{list}</div>\n{}",
        escape(&scene.name),
        escape(run.model()),
        escape(&version),
        escape(title),
        escape(&heading),
        cards(run)
    )
}

/// What a verdict of `summary.json` means, in words.
pub(crate) fn in_words(verdict: &str) -> &str {
    match verdict {
        "resolved" => "resolved",
        "acoustic" => "depends on the speed of sound",
        "not_resolved" => "not resolved",
        "no_band" => "no band known",
        "beyond_allowable" => "beyond the allowable",
        other => other,
    }
}

/// A doubt with the names of its results in words.
pub(super) fn doubt_in_words(doubt: &str) -> String {
    let Some((names, why)) = doubt.split_once(": ") else { return doubt.to_string() };
    let words: Vec<String> = names.split(", ").map(|name| result(name).0).collect();
    format!("{}: {why}", words.join(", "))
}

/// A number with its band in its unit.
pub(super) fn with_band(quantity: &Quantity, si: &str) -> String {
    let Some(value) = quantity.value else { return "–".into() };
    let unit = Unit::of(si, value);
    let band = quantity.band.map_or(String::new(), |band| format!(" ± {}", two_digits(unit.scale * band)));
    let name = if unit.name == "-" { String::new() } else { format!(" {}", unit.name) };
    format!("{}{band}{name}", digits(unit.scale * value))
}

pub(crate) fn two_digits(value: f64) -> String {
    let places = (1.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.places$}")
}

/// Results with their names in the summary.
pub(crate) fn named(run: &RunFolder) -> Vec<(String, &Quantity)> {
    let results = &run.record.results;
    let own = [
        ("peak_force_N_per_m", &results.peak_force_N_per_m),
        ("peak_acceleration_g", &results.peak_acceleration_g),
        ("peak_pressure_Pa", &results.peak_pressure_Pa),
        ("impulse_N_s_per_m", &results.impulse_N_s_per_m),
    ];
    let own = own.into_iter().filter_map(|(name, quantity)| Some((name.to_string(), quantity.as_ref()?)));
    let of_panels = results.panels.iter().flat_map(|(name, panel)| {
        let stress = panel.peak_stress_Pa.as_ref().map(|stress| (format!("{name}.peak_stress_Pa"), stress));
        let factor = panel.reserve_factor.as_ref().map(|factor| (format!("{name}.reserve_factor"), factor));
        stress.into_iter().chain(factor)
    });
    own.chain(of_panels).collect()
}

/// The allowable stress of a panel [Pa].
pub(super) fn allowable(run: &RunFolder, panel: &str) -> Option<f64> {
    let panels = run.scene.body.iter().flat_map(|body| &body.panels);
    panels.filter(|own| own.name == panel).find_map(|own| own.allowable_stress)
}

/// Panels whose stress is above the allowable one, in sentences.
fn overstressed(run: &RunFolder) -> Vec<String> {
    let of = |(name, panel): (&String, &super::record::PanelResults)| {
        let stress = panel.peak_stress_Pa.as_ref().filter(|stress| stress.verdict == "beyond_allowable")?;
        let (value, allowed) = (stress.value?, allowable(run, name));
        let of_allowed = allowed.map_or(String::new(), |allowed| format!("; {} is allowed", with_unit(allowed, "Pa")));
        let reserve = panel.reserve_factor.as_ref().and_then(|factor| factor.value);
        let factor = reserve.map_or(String::new(), |factor| format!(" (reserve factor {})", digits(factor)));
        let time = stress.time_s.map_or(String::new(), |time| format!(" at {}", with_unit(time, "s")));
        Some(format!("{name} reaches {}{time}{of_allowed}{factor}", with_unit(value, "Pa")))
    };
    run.record.results.panels.iter().filter_map(of).collect()
}

fn verdict(run: &RunFolder) -> Verdict {
    let record = &run.record;
    let overstressed = overstressed(run);
    let others = |doubts: &[String]| -> Vec<String> {
        let other = |doubt: &&String| overstressed.is_empty() || !doubt.contains("times the allowable");
        doubts.iter().filter(other).map(|doubt| doubt_in_words(doubt)).collect()
    };
    let mut reasons = others(&record.doubts);
    reasons.extend(run.gaps.iter().cloned());
    let (class, heading) = match record.status.as_str() {
        "beyond_allowable" => ("failed", format!("Stress beyond the allowable: {}.", overstressed.join("; "))),
        "completed" => ("completed", "Completed. Nothing speaks against the results.".to_string()),
        "completed_with_doubts" => ("doubtful", "Completed with doubts.".to_string()),
        "failed" => ("failed", format!("Failed. {}", record.message.as_deref().unwrap_or_default())),
        "interrupted" => {
            let time = record.time_end_s.map_or(String::new(), |time| format!(" at {}", with_unit(time, "s")));
            ("doubtful", format!("Interrupted{time}. The results are those so far."))
        }
        _ => ("doubtful", "Not finished.".to_string()),
    };
    Verdict { class, heading, reasons }
}

/// A card for each result.
fn cards(run: &RunFolder) -> String {
    let named = named(run);
    let reserve = |panel: &str| named.iter().find(|(name, _)| name == &format!("{panel}.reserve_factor"));
    let mut html = String::new();
    for (name, quantity) in named.iter().filter(|(name, _)| !name.ends_with(".reserve_factor")) {
        let Some(value) = quantity.value else { continue };
        let (title, si) = result(name);
        let unit = Unit::of(si, value);
        let band = match quantity.band {
            Some(band) => format!("± {} {}", two_digits(unit.scale * band), unit.name),
            None => "no band".into(),
        };
        let time = quantity.time_s.map_or("over the run".into(), |time| format!("at {}", with_unit(time, "s")));
        let mut lines = vec![format!("{band}, {time}")];
        let panel = name.strip_suffix(".peak_stress_Pa").unwrap_or_default();
        if let Some((_, factor)) = reserve(panel) {
            let allowed = allowable(run, panel).map_or(String::new(), |v| format!(", {} allowed", with_unit(v, "Pa")));
            lines.push(format!("reserve factor {}{allowed}", digits(factor.value.unwrap_or(f64::NAN))));
        }
        let class = match quantity.verdict.as_str() {
            "resolved" => "completed",
            "beyond_allowable" => "failed",
            _ => "doubtful",
        };
        let details: String = lines.iter().map(|line| format!("<p>{}</p>", escape(line))).collect();
        html += &format!(
            "<li class=\"{class}\"><h3>{}</h3><p class=\"value\">{} <small>{}</small></p>{details}<p class=\"chip\">{}</p></li>\n",
            escape(&title),
            digits(unit.scale * value),
            escape(&unit.name),
            escape(in_words(&quantity.verdict))
        );
    }
    if html.is_empty() { html } else { format!("<ul class=\"cards\">\n{html}</ul>\n") }
}
