//! The head of a page that is not a run's: what it shows, how it ended, its main numbers.

use super::markup::escape;

/// How curves are read, where there is no animation.
pub(crate) const READ_CURVES: &str = "Point at a curve to read it, drag to zoom, double-click to reset.";

/// The same as an element.
pub fn hint_html() -> String {
    format!("<p class=\"hint\">{READ_CURVES}</p>\n")
}

/// A value with a band above this share of it is coarse [-].
pub const COARSE: f64 = 0.3;

/// What a colour says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Nothing is wrong: green.
    Good,
    /// To be read with care: amber.
    Doubtful,
    /// Failed: red.
    Failed,
}

impl Tone {
    fn class(self) -> &'static str {
        match self {
            Tone::Good => "completed",
            Tone::Doubtful => "doubtful",
            Tone::Failed => "failed",
        }
    }
}

/// A number that stands out.
#[derive(Clone, Debug, Default)]
pub struct Card {
    /// What it is.
    pub title: String,
    /// The number.
    pub value: String,
    /// Its unit.
    pub unit: String,
    /// What belongs to it, a line each; a line with an address is a link.
    pub lines: Vec<(String, Option<String>)>,
    /// What may be said of it.
    pub chip: Option<(Tone, String)>,
}

/// The head of a page.
#[derive(Clone, Debug)]
pub struct Lead {
    /// Small print above the title.
    pub eyebrow: String,
    /// The title.
    pub title: String,
    /// How it ended.
    pub tone: Tone,
    /// The same in a sentence.
    pub heading: String,
    /// More about it, an item each.
    pub reasons: Vec<String>,
    /// The numbers.
    pub cards: Vec<Card>,
}

/// The head as HTML.
pub fn lead_html(lead: &Lead) -> String {
    let items: String = lead.reasons.iter().map(|why| format!("<li>{}</li>", escape(why))).collect();
    let list = if items.is_empty() { String::new() } else { format!("<ul>{items}</ul>") };
    let cards: String = lead.cards.iter().map(card).collect();
    let cards = if cards.is_empty() { cards } else { format!("<ul class=\"cards\">\n{cards}</ul>\n") };
    format!(
        "<p class=\"eyebrow\">{}</p>\n<h1>{}</h1>\n<div class=\"status {}\"><strong>{}</strong>{list}</div>\n{cards}",
        escape(&lead.eyebrow),
        escape(&lead.title),
        lead.tone.class(),
        escape(&lead.heading)
    )
}

fn card(card: &Card) -> String {
    let line = |(text, address): &(String, Option<String>)| match address {
        Some(address) => format!("<p><a href=\"{}\">{}</a></p>", escape(address), escape(text)),
        None => format!("<p>{}</p>", escape(text)),
    };
    let lines: String = card.lines.iter().map(line).collect();
    let class = card.chip.as_ref().map_or("", |(tone, _)| tone.class());
    let chip = card.chip.as_ref().map_or(String::new(), |(_, text)| format!("<p class=\"chip\">{}</p>", escape(text)));
    format!(
        "<li class=\"{class}\"><h3>{}</h3><p class=\"value\">{} <small>{}</small></p>{lines}{chip}</li>\n",
        escape(&card.title),
        escape(&card.value),
        escape(&card.unit)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_escapes_texts_and_has_a_card_for_each_number() {
        let lines = vec![("point 3".to_string(), Some("points/a/report.html".to_string()))];
        let chip = Some((Tone::Doubtful, "no band".to_string()));
        let card = Card { title: "a < b".into(), value: "1.08".into(), unit: "g".into(), lines, chip };
        let (eyebrow, title, heading) = ("e".to_string(), "t".to_string(), "Done & over.".to_string());
        let html = lead_html(&Lead { eyebrow, title, tone: Tone::Good, heading, reasons: vec![], cards: vec![card] });
        for part in ["status completed", "Done &amp; over.", "a &lt; b", "<li class=\"doubtful\">", "href=\"points/a/"]
        {
            assert!(html.contains(part), "{part}: {html}");
        }
    }
}
