//! Scenes to start from: `splashdown new`.

/// Name and text of each template. `ditching` is a landing; the others are scenes.
pub const TEMPLATES: [(&str, &str); 4] = [
    ("wedge", include_str!("../templates/wedge.toml")),
    ("section", include_str!("../templates/section.toml")),
    ("panel", include_str!("../templates/panel.toml")),
    ("ditching", include_str!("../templates/ditching.toml")),
];

#[cfg(test)]
mod tests {
    use super::TEMPLATES;

    #[test]
    fn every_template_runs_as_it_is() {
        for (name, text) in TEMPLATES {
            let refused = match name {
                "ditching" => crate::ditching::load_text("new.toml", text, &[]).err(),
                _ => run::load_text("new.toml", text, &[]).err(),
            };
            assert!(refused.is_none(), "{name}: {refused:?}");
        }
    }
}
