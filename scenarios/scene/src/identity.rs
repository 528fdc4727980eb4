//! What distinguishes one computation from another: of equal identities only the first need be computed.

use std::hash::Hasher;

use siphasher::sip128::{Hasher128, SipHasher13};

use crate::bounded_text::read_text;
use crate::load::Loaded;
use crate::reference::Table;

/// A hash of texts and of the program's version: 16 hexadecimal digits.
pub fn identity<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let mut hasher = SipHasher13::new();
    for part in [env!("CARGO_PKG_VERSION"), "\n"].into_iter().chain(texts) {
        hasher.write(part.as_bytes());
    }
    format!("{:032x}", hasher.finish128().as_u128())[..16].to_string()
}

impl Loaded {
    /// A hash of the resolved scene, which holds what was read from the files that it names, of the tables that it is compared with, and of
    /// the program's version.
    pub fn identity(&self) -> String {
        let given = self.scene.compare.iter().filter(|compare| !Table::is_builtin(&compare.reference));
        // what cannot be read is reported by the run
        let tables: Vec<String> = given.map(|compare| read_text(&compare.reference).unwrap_or_default()).collect();
        let scene = self.scene.to_toml();
        identity([scene.as_str()].into_iter().chain(tables.iter().map(String::as_str)))
    }
}
