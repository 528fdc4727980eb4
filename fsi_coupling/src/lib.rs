//! fsi_coupling
