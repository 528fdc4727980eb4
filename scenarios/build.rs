//! The program embeds its scenes, cases and ditching models: rebuild when they change.

fn main() {
    for folder in ["cases", "scenes", "ditching"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
