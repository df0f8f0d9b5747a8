//! Version of the ABI.

/// Version of this header. It changes whenever a function or a constant changes its meaning.
pub const MRTL_ABI: u32 = 1;
