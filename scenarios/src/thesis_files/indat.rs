//! INDAT: 38 parameters in the order of the thesis's appendix 2.

use std::fmt::Write;

use super::{ThesisFileError, number, wrong};

/// Names in their order; true for whole numbers.
const PARAMETERS: [(&str, bool); 38] = [
    ("i_kernel", true),
    ("i_algorithm", true),
    ("i_densityFilter", true),
    ("i_viscos", true),
    ("iBC", true),
    ("lattice", true),
    ("i_EoS", true),
    ("h_SWL", false),
    ("B", false),
    ("gamma", false),
    ("coef", false),
    ("eps", false),
    ("rho0", false),
    ("viscos_val", false),
    ("visc_wall", false),
    ("vlx", false),
    ("vly", false),
    ("vlz", false),
    ("dx", false),
    ("dy", false),
    ("dz", false),
    ("h", false),
    ("NP", true),
    ("NB", true),
    ("NBF", true),
    ("ivar_dt", true),
    ("dt", false),
    ("i_correct_pb", true),
    ("XMIN", false),
    ("XMAX", false),
    ("YMIN", false),
    ("YMAX", false),
    ("ZMIN", false),
    ("ZMAX", false),
    ("ZZMAX", false),
    ("CFL_number", false),
    ("TE0", false),
    ("fex", true),
];

/// The parameters of INDAT.
#[derive(Debug, Clone, PartialEq)]
pub struct Indat {
    values: [f64; PARAMETERS.len()],
}

impl Default for Indat {
    fn default() -> Indat {
        Indat { values: [0.0; PARAMETERS.len()] }
    }
}

fn index(name: &str) -> Option<usize> {
    PARAMETERS.iter().position(|(known, _)| known.eq_ignore_ascii_case(name))
}

impl Indat {
    /// A parameter by its name in the thesis; 0 for another name.
    pub fn get(&self, name: &str) -> f64 {
        index(name).map_or(0.0, |k| self.values[k])
    }

    /// Writes a parameter.
    pub fn set(&mut self, name: &str, value: f64) {
        if let Some(k) = index(name) {
            self.values[k] = value;
        }
    }

    /// Reads the parameters: a value per line, or several, in their order; a line that holds a name sets that parameter. Text behind !
    /// or # is a comment.
    ///
    /// # Errors
    /// The first line that cannot be used.
    pub fn parse(file: &str, text: &str) -> Result<Indat, ThesisFileError> {
        let mut values = [None; PARAMETERS.len()];
        let mut next = 0;
        let mut last = 1;
        for (k, line) in text.lines().enumerate() {
            let bare = line.split(['!', '#']).next().unwrap_or_default();
            let words: Vec<&str> = bare.split([' ', '\t', ',', '=', ';']).filter(|word| !word.is_empty()).collect();
            if words.is_empty() {
                continue;
            }
            last = k + 1;
            let named = words.iter().find_map(|word| index(word));
            if named.is_none() && words.iter().all(|word| number(word).is_none()) {
                return Err(wrong(file, k + 1, short(bare), "a number, or the name of a parameter and its number"));
            }
            let numbers: Vec<&str> = match named {
                Some(_) => words.iter().rev().copied().filter(|word| number(word).is_some()).take(1).collect(),
                None => words.clone(),
            };
            for word in &numbers {
                let value = number(word).ok_or_else(|| wrong(file, k + 1, short(word), "a finite number"))?;
                let place = named.unwrap_or(next);
                let Some((name, whole)) = PARAMETERS.get(place) else {
                    return Err(wrong(file, k + 1, short(word), "no more than the 38 parameters of appendix 2"));
                };
                if *whole && value.fract() != 0.0 {
                    return Err(wrong(file, k + 1, format!("{name} = {value}"), "a whole number"));
                }
                values[place] = Some(value);
                next = place + 1;
            }
            if numbers.is_empty() {
                return Err(wrong(file, k + 1, short(bare), "a number behind the name"));
            }
        }
        if let Some(k) = values.iter().position(Option::is_none) {
            let (given, name) = (values.iter().flatten().count(), PARAMETERS[k].0);
            let given = format!("{given} parameters, without {name}");
            return Err(wrong(file, last, given, "the 38 parameters of appendix 2"));
        }
        Ok(Indat { values: values.map(Option::unwrap_or_default) })
    }

    /// The text of the file.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for (k, ((name, _), value)) in PARAMETERS.iter().zip(self.values).enumerate() {
            let _ = writeln!(text, "{:<24} ! {} {name}", value.to_string(), k + 1);
        }
        text
    }
}

/// The start of a line, for a message.
pub(super) fn short(text: &str) -> String {
    let start: String = text.trim().chars().filter(|c| !c.is_control()).take(40).collect();
    format!("`{start}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_written_again_to_the_same_text() {
        let mut indat = Indat::default();
        for (k, (name, whole)) in PARAMETERS.iter().enumerate() {
            indat.set(name, if *whole { k as f64 } else { 0.1 + k as f64 / 3.0 });
        }
        let text = indat.to_text();
        let again = Indat::parse("INDAT", &text).expect("our own text");
        assert_eq!((&again, again.to_text()), (&indat, text));
    }

    #[test]
    fn names_and_fortran_numbers_are_read_and_gaps_refused_with_their_line() {
        let bare: Vec<String> = (0..38).map(|k| k.to_string()).collect();
        let mut lines = bare.clone();
        lines[18] = "dx = 2.5D-2".into();
        assert_eq!(Indat::parse("INDAT", &lines.join("\n")).expect("a file").get("DX"), 0.025);
        assert!(Indat::parse("INDAT", &bare.join(" ")).is_ok());
        for (k, line, part) in [(18, "abc", "abc"), (22, "1.5", "NP = 1.5"), (18, "dx", "`dx`")] {
            let mut lines = bare.clone();
            lines[k] = line.into();
            let error = Indat::parse("INDAT", &lines.join("\n")).expect_err(line);
            assert!(error.at.line == k + 1 && error.given.contains(part), "{error}");
        }
        assert!(Indat::parse("INDAT", &bare[..37].join("\n")).is_err());
        assert!(Indat::parse("INDAT", &format!("{}\n9", bare.join("\n"))).is_err());
    }
}
