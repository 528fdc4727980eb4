//! The reference page of the book is the one that the schemas give.

use scenarios::reference_page::reference_page;

#[test]
fn the_reference_page_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/src/reference/keys.md");
    let page = std::fs::read_to_string(path).unwrap_or_default();
    assert!(page == reference_page(), "write it again: splashdown keywords --markdown > docs/src/reference/keys.md");
}
