//! The scenes that come with the program.

/// Name and text of each built-in scene.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    &[
        ("wedge", include_str!("../../scenes/wedge.toml")),
        ("wedge25", include_str!("../../scenes/wedge25.toml")),
        ("wedge_constant", include_str!("../../scenes/wedge_constant.toml")),
        ("fuselage_section", include_str!("../../scenes/fuselage_section.toml")),
        ("hydrostatic_tank", include_str!("../../scenes/hydrostatic_tank.toml")),
        ("dam_break", include_str!("../../scenes/dam_break.toml")),
        ("floating_box", include_str!("../../scenes/floating_box.toml")),
    ]
}
