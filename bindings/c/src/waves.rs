//! Waves.

use crate::bench::{mrtl_model, on};
use crate::codes::{MRTL_OK, MRTL_WAVES};
use crate::failure::Failure;
use crate::text;
use std::ffi::c_char;

/// Begins waves of all signals from this tick on: a VCD or an FST, by the extension of `path`.
/// The directory is created if necessary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_waves(model: mrtl_model, path: *const c_char) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `path` is NULL or a
    // string that does not change meanwhile.
    unsafe {
        on(model, |bench| {
            let path = text::read("path", path)?;
            bench.model.waves_to(path)?;
            Ok(MRTL_OK)
        })
    }
}

/// Ends the waves with the tick before this one. The waveform and a GTKWave save file beside it
/// appear complete; without this call there are none. An error if no waves were begun.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_finish_waves(model: mrtl_model) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            match bench.model.finish_waves()?.is_empty() {
                true => Err(Failure::new(MRTL_WAVES, "no waves were begun")),
                false => Ok(MRTL_OK),
            }
        })
    }
}
