//! Ticks.

use crate::bench::{mrtl_model, on};
use crate::codes::MRTL_OK;
use crate::signals::put;

/// Advances by `ticks` ticks with constant input ports.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_step(model: mrtl_model, ticks: u64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            match ticks {
                1 => bench.model.step(),
                _ => bench.model.run(ticks),
            }
            Ok(MRTL_OK)
        })
    }
}

/// Advances by `ticks` ticks as mrtl_step does, but jumps over ticks in which registers do nothing
/// but count. The state afterwards is the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_fast_forward(model: mrtl_model, ticks: u64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            bench.model.fast_forward(ticks);
            Ok(MRTL_OK)
        })
    }
}

/// Advances to the next tick by a synchronous reset. Flip-flops have their power-on values then;
/// memories and shift registers take the edge as usual.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_reset(model: mrtl_model) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            bench.model.reset();
            Ok(MRTL_OK)
        })
    }
}

/// Reads the number of this tick, from 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_tick(model: mrtl_model, tick: *mut u64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `tick` is NULL or can
    // be written.
    unsafe { on(model, |bench| put("tick", tick, bench.model.tick())) }
}
