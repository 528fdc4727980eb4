//! The page: files of the folder `page`, in the program itself.

/// Stands for the token in the page's addresses.
pub const TOKEN: &str = "{{token}}";
/// The page.
pub const PAGE: &str = include_str!("../page/index.html");
/// Styles of the page.
pub const STYLE: &str = include_str!("../page/studio.css");
/// Scripts of the page, one after the other.
pub const SCRIPT: &str = concat!(
    "\"use strict\";\n",
    include_str!("../page/talk.js"),
    include_str!("../page/section.js"),
    include_str!("../page/fields.js"),
    include_str!("../page/curves.js"),
    include_str!("../page/runs.js"),
    include_str!("../page/grid.js"),
    include_str!("../page/main.js"),
);
