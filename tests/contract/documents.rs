//! The book: labels of equations, citations of them in code and pages, relative links, table of contents.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Chapters of the theory and the letters of their labels.
const CHAPTERS: [(&str, &str); 11] = [
    ("operators", "OP"),
    ("weakly-compressible", "WC"),
    ("walls", "WA"),
    ("projection", "PR"),
    ("linear-solver", "LS"),
    ("beams", "BE"),
    ("coupling", "CO"),
    ("entry-models", "EN"),
    ("rules-and-length", "RU"),
    ("gauges-and-errors", "GE"),
    ("appendix-2010", "LE"),
];

/// Folders at the root that hold sources or pages.
const ROOMS: [&str; 6] = ["docs/src", "fsi_coupling", "scenarios", "sph_core", "structure_fe", "tests"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("a workspace").to_path_buf()
}

/// Files of these endings below `folder`, and the text of each.
fn texts(folder: &Path, endings: &[&str], found: &mut BTreeMap<PathBuf, String>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let ending = path.extension().map(|e| e.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() && !path.ends_with("target") {
            texts(&path, endings, found);
        } else if endings.contains(&ending.as_str()) {
            let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            found.insert(path, text);
        }
    }
}

/// Sources and pages of the repository.
fn repository(endings: &[&str]) -> BTreeMap<PathBuf, String> {
    let (root, mut found) = (root(), BTreeMap::new());
    ROOMS.iter().for_each(|room| texts(&root.join(room), endings, &mut found));
    for entry in std::fs::read_dir(&root).expect("the root") {
        let path = entry.expect("an entry").path();
        if endings.contains(&"md") && path.extension().is_some_and(|e| e == "md") {
            let text = std::fs::read_to_string(&path).expect("a page");
            found.insert(path, text);
        }
    }
    found
}

/// The labels of a line, each with its place in it: two letters of a chapter and a number, as a word of its own.
fn labels(line: &str) -> Vec<(usize, &str)> {
    let bytes = line.as_bytes();
    let word = |k: usize| bytes.get(k).is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
    let mut found = Vec::new();
    for (_, code) in CHAPTERS {
        for (at, _) in line.match_indices(code) {
            let digits = bytes[at + 2..].iter().take_while(|b| b.is_ascii_digit()).count();
            let end = at + 2 + digits;
            if digits > 0 && !word(end) && !(at > 0 && word(at - 1)) {
                found.push((at, &line[at..end]));
            }
        }
    }
    found.sort();
    found
}

/// Every label that has an anchor, `### WC4 Title {#WC4}`: numbered from 1 in the order of its chapter.
fn anchors() -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    for (chapter, code) in CHAPTERS {
        let page = format!("docs/src/theory/{chapter}.md");
        let text = std::fs::read_to_string(root().join(&page)).unwrap_or_else(|e| panic!("{page}: {e}"));
        for (k, heading) in text.lines().filter(|line| line.starts_with("### ")).enumerate() {
            let label = format!("{code}{}", k + 1);
            let (start, end) = (format!("### {label} "), format!(" {{#{label}}}"));
            assert!(
                heading.starts_with(&start) && heading.ends_with(&end),
                "{page}: {label} is expected at \"{heading}\""
            );
            all.insert(label);
        }
    }
    all
}

#[test]
fn every_cited_equation_has_an_anchor() {
    let (anchors, mut wrong) = (anchors(), Vec::new());
    for (path, text) in repository(&["rs", "toml", "md", "py"]) {
        let source = path.extension().is_some_and(|e| e == "rs" || e == "toml") && !path.ends_with(file!());
        for (k, line) in text.lines().enumerate() {
            let cited = labels(line);
            let mut say = |what: &str| wrong.push(format!("{}:{}: {what}: {}", path.display(), k + 1, line.trim()));
            cited.iter().filter(|(_, label)| !anchors.contains(*label)).for_each(|(_, label)| say(label));
            for pair in cited.windows(2) {
                let [(at, from), (next, to)] = [pair[0], pair[1]];
                let number = |label: &str| label[2..].parse::<u32>().expect("digits");
                let range = line[at + from.len()..next] == *"–";
                if range && (from[..2] != to[..2] || number(from) >= number(to)) {
                    say("a range runs upwards within a chapter");
                }
            }
            for (at, _) in line.match_indices("THEORY").filter(|_| source) {
                let after = at + "THEORY ".len();
                let at_end = line[at..].trim_end() == "THEORY";
                if !at_end && !cited.iter().any(|(place, _)| *place == after) {
                    say("THEORY is followed by a label");
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} citations:\n{}", wrong.len(), wrong.join("\n"));
}

/// The numbers of a cited label or range of labels.
fn all_cited(line: &str) -> Vec<String> {
    let cited = labels(line);
    let mut all: Vec<String> = cited.iter().map(|(_, label)| label.to_string()).collect();
    for pair in cited.windows(2) {
        let [(at, from), (next, to)] = [pair[0], pair[1]];
        if line[at + from.len()..next] == *"–" && from[..2] == to[..2] {
            let number = |label: &str| label[2..].parse::<u32>().expect("digits");
            all.extend((number(from)..number(to)).map(|n| format!("{}{n}", &from[..2])));
        }
    }
    all
}

#[test]
fn every_equation_is_cited_by_the_module_that_evaluates_it() {
    let mut cited = BTreeSet::new();
    for (path, text) in repository(&["rs"]) {
        if !path.starts_with(root().join("tests")) {
            text.lines().for_each(|line| cited.extend(all_cited(line)));
        }
    }
    // the first entry of a chapter is its range of validity
    let first = |label: &String| label[2..] == *"1";
    let missing: Vec<String> = anchors().into_iter().filter(|label| !first(label) && !cited.contains(label)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The text of a page without its code: fenced blocks and spans.
fn prose(text: &str) -> String {
    let mut fenced = false;
    let outside = text.lines().filter(|line| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    });
    let lines: Vec<&str> = outside.collect();
    lines.join("\n").split('`').step_by(2).collect()
}

/// The anchors of a page: those given, and those that headings have by their words.
fn places(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let heading = heading.trim_start_matches('#').trim();
        if let Some((_, given)) = heading.rsplit_once("{#") {
            return given.trim_end_matches('}').to_string();
        }
        let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
    };
    headings.map(anchor).collect()
}

/// Targets of the links of a page.
fn links(text: &str) -> Vec<String> {
    let prose = prose(text);
    let target = |rest: &str| rest.split(')').next().unwrap_or_default().to_string();
    prose.split("](").skip(1).map(target).collect()
}

#[test]
fn every_relative_link_leads_somewhere() {
    let mut wrong = Vec::new();
    for (path, text) in repository(&["md"]) {
        for link in links(&text).iter().filter(|link| !link.contains("://") && !link.starts_with("mailto:")) {
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => path.clone(),
                _ => path.parent().expect("a folder").join(file),
            };
            let found = target.exists()
                && (place.is_empty()
                    || std::fs::read_to_string(&target).is_ok_and(|page| places(&page).contains(place)));
            if !found {
                wrong.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{} links:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_page_of_the_book_is_in_its_contents() {
    let book = root().join("docs/src");
    let summary = std::fs::read_to_string(book.join("SUMMARY.md")).expect("SUMMARY.md");
    let listed: BTreeSet<PathBuf> = links(&summary).iter().map(|link| book.join(link)).collect();
    let mut pages = BTreeMap::new();
    texts(&book, &["md"], &mut pages);
    let missing: Vec<&PathBuf> =
        pages.keys().filter(|page| !listed.contains(*page) && !page.ends_with("SUMMARY.md")).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn labels_are_words_of_their_own() {
    let found = |line| labels(line).into_iter().map(|(_, label)| label.to_string()).collect::<Vec<_>>();
    assert_eq!(found("THEORY WC4–WC6 (CO12), `GE1`"), ["WC4", "WC6", "CO12", "GE1"]);
    assert!(found("AWC4 WC4b WC LE_3 0xBE1F SPHLE3").is_empty());
}
