//! sph_core
