//! Settings of earlier versions that are no more, and the reasons.

use fsi_coupling::settings::Problem;
use serde_json::Value;

/// Refuses a dropped setting that is in use, and removes one that is off.
pub(super) fn refuse_dropped(given: &mut Value) -> Result<(), Problem> {
    if given.pointer("/coupling/scheme").and_then(Value::as_str) == Some("aitken") {
        let expected = "another scheme: aitken was dropped: \"iqn_ils\" needs no more iterations";
        return Err(Problem::new("coupling.scheme", "\"aitken\"", expected));
    }
    let Some(fluid) = given.get_mut("fluid").and_then(Value::as_object_mut) else { return Ok(()) };
    match fluid.remove("volume_correction") {
        None | Some(Value::Bool(false)) => Ok(()),
        Some(value) => {
            let expected = "false, or no such key: the correction was dropped, fluid.shifting keeps volumes as well";
            Err(Problem::new("fluid.volume_correction", value, expected))
        }
    }
}
