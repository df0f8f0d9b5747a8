//! Paths in space for arc generator and trajectory controller: their pieces, the geometry of arcs
//! and splines, the joints of an arm whose hand follows them, and the format of their records.

pub mod arm;
pub mod circle;
pub mod cubic;
pub mod error;
pub mod helix;
pub mod pieces;
pub mod record;
pub mod vector;
