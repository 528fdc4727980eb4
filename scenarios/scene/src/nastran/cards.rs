//! Cards: a name and fields, in free format or in fields of 8 or 16 columns, with continuation lines.

use super::CardError;
use super::field::{LARGE, large, real, whole};

/// Columns of a field of the small format, and of the name.
const SMALL: usize = 8;
/// Column from which a line of a fixed format has its tenth field.
const COMMENTS: usize = 72;
/// Fields of a line after the name: of the small format, and of the large one.
const PER_LINE: [usize; 2] = [8, 4];

/// A card.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Its name in capitals.
    pub name: String,
    /// Its first line, from 1.
    pub line: usize,
    /// The fields after the name, with the line of each.
    fields: Vec<(String, usize)>,
}

impl Card {
    /// Number of fields.
    pub fn count(&self) -> usize {
        self.fields.len()
    }

    /// The text of a field, counted from 0 after the name; empty where there is none.
    pub fn text(&self, k: usize) -> &str {
        self.fields.get(k).map_or("", |(text, _)| text)
    }

    /// The line of a field.
    pub fn line_of(&self, k: usize) -> usize {
        self.fields.get(k).map_or(self.line, |(_, line)| *line)
    }

    /// An error in a field.
    pub(super) fn wrong(&self, k: usize, name: &str, expected: &str) -> CardError {
        let text = self.text(k);
        let given = if text.is_empty() { "nothing".to_string() } else { format!("`{text}`") };
        CardError::new(self.line_of(k), format!("{given} as {name} of {}", self.name), expected)
    }

    /// A whole number; `None` in an empty field.
    pub(super) fn whole(&self, k: usize, name: &str) -> Result<Option<i64>, CardError> {
        match self.text(k) {
            "" => Ok(None),
            text => whole(text).map(Some).ok_or_else(|| self.wrong(k, name, "a whole number")),
        }
    }

    /// A number that cards are called by: a whole one above 0.
    pub(super) fn id(&self, k: usize, name: &str) -> Result<i64, CardError> {
        let found = self.whole(k, name)?.filter(|id| *id > 0);
        found.ok_or_else(|| self.wrong(k, name, "a whole number above 0"))
    }

    /// A real number; `None` in an empty field.
    pub(super) fn real(&self, k: usize, name: &str) -> Result<Option<f64>, CardError> {
        match self.text(k) {
            "" => Ok(None),
            text => {
                let expected = "a real number with a decimal point, in fields of 8 or 16 columns or between commas";
                real(text).map(Some).ok_or_else(|| self.wrong(k, name, expected))
            }
        }
    }

    /// A real number above 0.
    pub(super) fn positive(&self, k: usize, name: &str) -> Result<f64, CardError> {
        let found = self.real(k, name)?.filter(|value| *value > 0.0);
        found.ok_or_else(|| self.wrong(k, name, "a real number above 0"))
    }

    /// Ok if the fields from one to another are empty or zero.
    pub(super) fn unused(&self, fields: std::ops::Range<usize>, name: &str, why: &str) -> Result<(), CardError> {
        let used = |k: &usize| {
            !self.text(*k).is_empty() && whole(self.text(*k)) != Some(0) && real(self.text(*k)) != Some(0.0)
        };
        fields.into_iter().find(used).map_or(Ok(()), |k| Err(self.wrong(k, name, why)))
    }
}

/// A line of the bulk data, split.
struct Line {
    name: String,
    fields: Vec<String>,
    large: bool,
    /// What the next line must start with, in its last field.
    mark: String,
}

/// The cards of a text, up to ENDDATA; of a whole deck those after BEGIN BULK.
///
/// # Errors
/// A line that is no card, or continues none.
pub fn cards(text: &str) -> Result<Vec<Card>, CardError> {
    let begins = |line: &str| {
        let mut words = line.split_whitespace().map(str::to_ascii_uppercase);
        words.next().is_some_and(|word| word == "BEGIN") && words.next().is_some_and(|word| word.starts_with("BULK"))
    };
    let first = text.lines().position(begins).map_or(0, |k| k + 1);
    let mut cards: Vec<Card> = Vec::new();
    // the mark of a line that is to be continued, and its line
    let mut open: Option<(String, usize)> = None;
    // fields of the lines of the card so far, empty ones included
    let mut due_fields = 0;
    let unclosed = |open: &Option<(String, usize)>| match open {
        Some((mark, line)) => {
            let expected = format!("a next line that starts with {mark}, or nothing in the last field");
            Err(CardError::new(*line, format!("the continuation mark `{mark}`"), expected))
        }
        None => Ok(()),
    };
    for (k, whole_line) in text.lines().enumerate().skip(first) {
        let number = k + 1;
        let line = whole_line.split('$').next().unwrap_or_default().trim_end();
        if line.trim().is_empty() {
            continue;
        }
        if line.trim().eq_ignore_ascii_case("ENDDATA") {
            break;
        }
        let Line { name, fields, large, mark } = split(line, number)?;
        let continues = name.is_empty() || name.starts_with(['+', '*']);
        if continues {
            let (own, due) = (name.trim_start_matches(['+', '*']), open.take());
            if let Some((wanted, _)) = &due
                && !own.is_empty()
                && own != wanted.trim_start_matches(['+', '*'])
            {
                let expected = format!("a line that starts with {wanted}, the mark of the line before");
                return Err(CardError::new(number, format!("`{name}`"), expected));
            }
            let Some(card) = cards.last_mut() else {
                return Err(CardError::new(number, format!("`{name}`, a continuation"), "a card before it"));
            };
            card.fields.resize(due_fields, (String::new(), number));
            due_fields += PER_LINE[usize::from(large)];
            card.fields.extend(fields.into_iter().map(|field| (field, number)));
        } else {
            unclosed(&open)?;
            let name = name.trim_end_matches('*').to_ascii_uppercase();
            let named = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric());
            if !named || !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                let given = format!("`{}`", shown(line));
                return Err(CardError::new(number, given, "a card of bulk data, such as GRID or CBAR"));
            }
            let fields = fields.into_iter().map(|field| (field, number)).collect();
            due_fields = PER_LINE[usize::from(large)];
            cards.push(Card { name, line: number, fields });
        }
        open = (!mark.is_empty()).then_some((mark, number));
    }
    unclosed(&open)?;
    Ok(cards)
}

/// Text that fits into a message.
fn shown(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(40).collect()
}

/// A line as name, fields and mark.
fn split(line: &str, number: usize) -> Result<Line, CardError> {
    let clean = |text: &str| text.trim().to_string();
    // the tenth field of a fixed format may be a comment, with commas too
    if line.chars().take(COMMENTS).any(|c| c == ',') {
        let mut parts: Vec<String> = line.split(',').map(clean).collect();
        let name = parts.remove(0);
        let large = name.contains('*');
        let per_line = PER_LINE[usize::from(large)];
        let mark = if parts.len() > per_line { parts.remove(per_line) } else { String::new() };
        let mark = if mark.starts_with(['+', '*']) { mark } else { String::new() };
        if let Some(more) = parts.iter().skip(per_line).find(|part| !part.is_empty()) {
            let expected = format!("at most {per_line} fields after the name, and a continuation mark");
            return Err(CardError::new(number, format!("a further field `{more}`"), expected));
        }
        parts.truncate(per_line);
        return Ok(Line { name, fields: parts, large, mark });
    }
    let columns = spread(line);
    let part =
        |from: usize, width: usize| -> String { clean(&columns.iter().skip(from).take(width).collect::<String>()) };
    let name = part(0, SMALL);
    let large = name.contains('*');
    let (width, per_line) = if large { (LARGE, PER_LINE[1]) } else { (SMALL, PER_LINE[0]) };
    let mut fields: Vec<String> = (0..per_line).map(|k| part(SMALL + width * k, width)).collect();
    while fields.last().is_some_and(String::is_empty) {
        fields.pop();
    }
    if let Some(crowded) = fields.iter().chain([&name]).find(|field| field.contains(char::is_whitespace)) {
        let expected = format!("one value in each field of {width} columns, or commas between the fields");
        return Err(CardError::new(number, format!("`{crowded}` in one field"), expected));
    }
    let tenth = part(SMALL + width * per_line, SMALL);
    let mark = if tenth.starts_with(['+', '*']) { tenth } else { String::new() };
    Ok(Line { name, fields, large, mark })
}

/// The characters of a line, each tab as spaces up to the next field.
fn spread(line: &str) -> Vec<char> {
    let mut columns = Vec::new();
    for c in line.chars() {
        match c {
            '\t' => columns.resize((columns.len() / SMALL + 1) * SMALL, ' '),
            c => columns.push(c),
        }
    }
    columns
}

/// A value of a field to write.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Nothing.
    Blank,
    /// A whole number.
    Whole(i64),
    /// A real number.
    Real(f64),
    /// A word.
    Word(String),
}

impl Value {
    fn text(&self) -> String {
        match self {
            Value::Blank => String::new(),
            Value::Whole(value) => value.to_string(),
            Value::Real(value) => large(*value),
            Value::Word(word) => word.clone(),
        }
    }
}

/// A line of comment.
pub fn comment(line: &str) -> String {
    format!("$ {line}").trim_end().to_string() + "\n"
}

/// A card in fields of 16 columns.
pub fn written(name: &str, fields: &[Value]) -> String {
    let last = fields.iter().rposition(|field| *field != Value::Blank).map_or(0, |k| k + 1);
    let mut text = String::new();
    for (k, chunk) in fields[..last].chunks(PER_LINE[1]).enumerate() {
        let head = if k == 0 { format!("{name}*") } else { "*".to_string() };
        let line = chunk.iter().fold(format!("{head:<8}"), |line, field| line + &format!("{:>16}", field.text()));
        text += line.trim_end();
        text.push('\n');
    }
    // the large format has lines in pairs
    if last.div_ceil(PER_LINE[1]) % 2 == 1 {
        text += "*\n";
    }
    text
}

/// A card that was read, as this program writes it.
pub fn rewritten(card: &Card) -> String {
    let value = |(text, _): &(String, usize)| match (whole(text), real(text)) {
        (Some(value), _) => Value::Whole(value),
        (None, Some(value)) => Value::Real(value),
        (None, None) if text.is_empty() => Value::Blank,
        (None, None) => Value::Word(text.clone()),
    };
    written(&card.name, &card.fields.iter().map(value).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_formats_say_the_same() {
        let free = cards("GRID,7,,0.5,-1.25,2.,,,\n").expect("cards");
        let small = cards("GRID           7              .5   -1.25      2.\n").expect("cards");
        let large = cards(
            "GRID*                  7                              .5           -1.25\n*                     2.\n",
        )
        .expect("cards");
        for found in [&free, &small, &large] {
            assert_eq!(found.len(), 1);
            let card = &found[0];
            assert_eq!((card.name.as_str(), card.id(0, "ID")), ("GRID", Ok(7)));
            assert_eq!([2, 3, 4].map(|k| card.real(k, "X").expect("a number").expect("given")), [0.5, -1.25, 2.0]);
        }
    }

    #[test]
    fn continuations_and_decks_are_read() {
        let text = "SOL 103\nCEND\nBEGIN BULK\n$ a comment\nPBAR,1,1,.1,2.\n,.5,.6\n+,,,.7\nENDDATA\nnonsense";
        let found = cards(text).expect("cards");
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].text(8), found[0].text(9), found[0].text(18)), (".5", ".6", ".7"));
        assert_eq!((found[0].line, found[0].line_of(8), found[0].line_of(18)), (5, 6, 7));
        let marked = "CBAR           1       1       1       2      0.      1.      0.        +A\n+A             1\n";
        assert_eq!(cards(marked).expect("cards")[0].text(8), "1");
    }

    #[test]
    fn what_is_no_card_is_refused_with_its_line() {
        for (text, line, part) in [
            (",1,2\n", 1, "a card before it"),
            ("GRID,1\n=\n", 2, "a card of bulk data"),
            ("GRID,1,2,3,4,5,6,7,8,+A\n", 1, "starts with +A"),
            ("PBAR,1,2,3,4,5,6,7,8,+A\nGRID,1\n", 1, "starts with +A"),
            ("PBAR,1,2,3,4,5,6,7,8,+A\n+B,1\n", 2, "starts with +A"),
            ("GRID 1 0 0.5 0.5\n", 1, "commas between"),
            ("GRID,1,2,3,4,5,6,7,8,9,10\n", 1, "at most 8 fields"),
        ] {
            let error = cards(text).expect_err(text);
            assert!(error.line == line && error.expected.contains(part), "{text}: {error:?}");
        }
    }
}
