//! The program carries its scenes, reference data, validation cases, charts, bands and maps: rebuild when they change.

fn main() {
    let data = ["reference", "validation", "charts", "bands", "maps"].map(|folder| format!("../tests/{folder}"));
    for folder in data.iter().map(String::as_str).chain(["scenes", "ditching"]) {
        println!("cargo:rerun-if-changed={folder}");
    }
}
