//! A check of markup that needs no parser crate.

/// Checks that `text` is well-formed XML as far as we write it: one root, elements nested and
/// closed, attributes quoted and distinct, known entities, no forbidden characters.
pub fn assert_well_formed(text: &str) {
    assert!(text.chars().all(|c| !c.is_control() || matches!(c, '\n' | '\t')), "control character");
    let mut open: Vec<&str> = Vec::new();
    let mut roots = 0;
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        assert_references(&rest[..start]);
        assert!(!open.is_empty() || rest[..start].trim().is_empty(), "text outside the root: {}", &rest[..start]);
        rest = &rest[start..];
        if let Some(comment) = rest.strip_prefix("<!--") {
            rest = &comment[comment.find("-->").expect("an end of the comment") + 3..];
            continue;
        }
        let end = rest.find('>').expect("an end of the tag");
        let tag = &rest[1..end];
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "closing tag");
            continue;
        }
        let (body, empty) = tag.strip_suffix('/').map_or((tag, false), |body| (body, true));
        let name = body.split_whitespace().next().expect("an element name");
        assert!(name.chars().all(|c| c.is_ascii_alphanumeric()), "element {name:?}");
        assert_attributes(&body[name.len()..]);
        roots += usize::from(open.is_empty());
        if !empty {
            open.push(name);
        }
    }
    assert!(rest.trim().is_empty() && open.is_empty() && roots == 1, "{open:?} open, {roots} roots, then {rest:?}");
}

fn assert_attributes(mut text: &str) {
    let mut names = Vec::new();
    while !text.trim().is_empty() {
        assert!(text.starts_with(char::is_whitespace), "no space before {text:?}");
        let (name, value) = text.split_once("=\"").unwrap_or_else(|| panic!("attribute without value: {text:?}"));
        let (value, after) = value.split_once('"').unwrap_or_else(|| panic!("value without end: {value:?}"));
        assert_references(value);
        assert!(!names.contains(&name.trim()), "{name} twice");
        names.push(name.trim());
        text = after;
    }
}

fn assert_references(text: &str) {
    for reference in text.split('&').skip(1) {
        let name = reference.split_once(';').map(|(name, _)| name);
        assert!(matches!(name, Some("amp" | "lt" | "gt" | "quot" | "apos" | "#39")), "bare & before {reference:?}");
    }
}
