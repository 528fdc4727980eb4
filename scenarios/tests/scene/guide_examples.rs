//! Files that the guide shows are accepted as they stand.

use run::load;
use temp_dir::TempDir;

const EXCHANGE: &str = include_str!("../../../docs/src/guide/exchange.md");

/// The block of a page that starts with the comment of its file's name.
fn block<'a>(page: &'a str, name: &str) -> &'a str {
    let from = page.find(&format!("```toml\n# {name}\n")).expect("the example") + "```toml\n".len();
    page[from..].split("```").next().expect("its end")
}

/// The example had a generalised mass below what its nodes carry in the shape, and was refused.
#[test]
fn the_modes_of_the_guide_are_accepted() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.child("belly_modes.toml"), block(EXCHANGE, "belly_modes.toml")).expect("a file");
    let scene = include_str!("../../scene/scenes/wedge_drop_20.toml").split("[[").next().expect("a scene");
    let scene = scene.replace("[body]\n", "[body]\nmodes_file = \"belly_modes.toml\"\n");
    std::fs::write(folder.child("scene.toml"), scene).expect("a file");
    let path = folder.child("scene.toml");
    let loaded = load(&path.to_string_lossy(), &[]).unwrap_or_else(|error| panic!("{error}"));
    let modes = loaded.scene.body.and_then(|body| body.modal).expect("modes");
    assert_eq!((modes.nodes.len(), modes.masses, modes.modes[0].mass), (3, vec![0.8, 1.6, 0.8], 1.6));
}
