//! What all requests share.

use crate::flow::Flows;
use crate::grid::Grids;
use crate::guard::Guard;
use crate::options::Options;
use crate::runs::Runs;

/// What all requests share.
pub struct Shared {
    pub guard: Guard,
    pub options: Options,
    pub runs: Runs,
    pub flows: Flows,
    pub grids: Grids,
}
