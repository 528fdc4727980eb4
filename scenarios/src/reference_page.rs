//! The reference page of all keys, written from the schemas.

use crate::{ditching, planing, sweep};

/// The page of Markdown.
pub fn reference_page() -> String {
    let tables = [
        ("Scenes", "`splashdown run`, `check`", scene::schema()),
        ("Landings", "`splashdown ditch`", ditching::schema()),
        ("Planing hulls", "`splashdown plane`", planing::schema()),
        ("Sweeps", "`splashdown sweep`", sweep::schema()),
    ];
    let head = "# Keys\n\nWritten by `splashdown keywords --markdown`. A value of `auto` means the same as an absent key. A key that has \
                no effect beside the other keys is refused unless it has its default.\n";
    tables.iter().fold(head.to_string(), |page, (title, reader, schema)| {
        format!("{page}\n## {title}\n\nRead by {reader}.\n\n{}", schema.markdown())
    })
}
