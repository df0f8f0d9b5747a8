//! Paths in space for arc generator and trajectory controller: their pieces, the geometry of arcs
//! and splines, the joints of an arm whose hand follows them, and records as a control computer
//! writes them.

pub mod arm;
pub mod circle;
pub mod cubic;
pub mod error;
pub mod helix;
pub mod pieces;
pub mod record;
pub(crate) mod record_writer;
pub mod vector;
