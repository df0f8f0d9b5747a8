//! Functions of the checkers that `motion-rtl verilog --dpi` prints: integers and strings only.
//!
//! The simulator copies a string that a function returns before it calls the next one.

use crate::bench::caught;
use crate::beside::{self, Beside, CALL, Interface, Made, WRONG, on};
use crate::codes::{MRTL_MISMATCH, MRTL_OK, MRTL_WRONG_HANDLE};
use crate::text;
use std::ffi::c_char;

/// Index that stands for the reset.
const RESET: i32 = -1;

/// Returns the name of an instance without the scope that some versions of Verilator put around all.
fn without_top(instance: &str) -> &str {
    instance.strip_prefix("TOP.").unwrap_or(instance)
}

/// Puts a model beside an instance of a design. Returns the handle of the checker, or a negative
/// code, whose text mrtl_dpi_error returns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_dpi_new(
    dpi: i32,
    version: *const c_char,
    circuit: *const c_char,
    settings: *const c_char,
    ports: u64,
    left: *const c_char,
    from_power_on: i32,
    waves: *const c_char,
    instance: *const c_char,
) -> i32 {
    caught(|| {
        let mut name = "";
        let mut result = || {
            // SAFETY: the simulator passes strings, which do not change meanwhile.
            let made = unsafe {
                name = without_top(text::read("instance", instance)?);
                Made {
                    interface: Interface::Dpi,
                    abi: dpi,
                    version: text::read("version", version)?,
                    circuit: text::read("circuit", circuit)?,
                    settings: text::read("settings", settings)?,
                    ports,
                    leave: text::read("left", left)?
                        .lines()
                        .map(str::to_owned)
                        .collect(),
                    from_power_on: from_power_on != 0,
                    waves: text::read("waves", waves)?,
                    instance: name,
                }
            };
            beside::made(made)
        };
        let result = result();
        result.unwrap_or_else(|failure| beside::refused(name, &failure))
    })
}

/// Returns the reason why the last checker was not made.
#[unsafe(no_mangle)]
pub extern "C" fn mrtl_dpi_error() -> *const c_char {
    beside::error(|text| text.as_ptr())
}

/// Passes words of the tick that ends with the next edge.
#[unsafe(no_mangle)]
#[rustfmt::skip]
pub unsafe extern "C" fn mrtl_dpi_words(
    handle: i32, first: i32,
    w0: u64, w1: u64, w2: u64, w3: u64, w4: u64, w5: u64, w6: u64, w7: u64,
) {
    // SAFETY: a simulator calls functions with one handle one after the other.
    unsafe {
        on(handle, |beside| {
            beside.put(first, [w0, w1, w2, w3, w4, w5, w6, w7]);
            MRTL_OK
        });
    }
}

/// Passes the last words of a tick, and the edge that ends it. Returns 1 if there is a text, 0 if
/// not, or a negative code.
#[unsafe(no_mangle)]
#[rustfmt::skip]
pub unsafe extern "C" fn mrtl_dpi_edge(
    handle: i32, rst: i32, first: i32,
    w0: u64, w1: u64, w2: u64, w3: u64, w4: u64, w5: u64, w6: u64, w7: u64,
) -> i32 {
    // SAFETY: a simulator calls functions with one handle one after the other.
    unsafe {
        on(handle, |beside| {
            beside.put(first, [w0, w1, w2, w3, w4, w5, w6, w7]);
            match beside.checker.edge(rst != 0, &beside.words[..beside.count]) {
                Ok(says) => says.into(),
                Err(_) => MRTL_MISMATCH,
            }
        })
    }
}

/// Says that a port has bits that are x or z at the edge to come; -1 is the reset.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_dpi_unknown(handle: i32, port: i32, bits: *const c_char) {
    // SAFETY: a simulator calls functions with one handle one after the other, and passes strings,
    // which do not change meanwhile.
    unsafe {
        on(handle, |beside| {
            let port = match port {
                RESET => None,
                port => usize::try_from(port).ok(),
            };
            let bits = text::read("bits", bits).unwrap_or("x");
            beside.checker.unknown(port, bits);
            MRTL_OK
        });
    }
}

/// Returns the text that there is to print.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_dpi_text(handle: i32) -> *const c_char {
    let mut text: *const c_char = WRONG.as_ptr();
    let take = |beside: &mut Beside| {
        beside.take_text();
        text = beside.text.as_ptr();
        MRTL_OK
    };
    // SAFETY: a simulator calls functions with one handle one after the other. The text lives
    // until the next call with this handle that makes another one.
    unsafe { on(handle, take) };
    text
}

/// Ends a comparison, whose report is the text to print. Returns 1 if it is the last comparison
/// and not all have passed, 0 otherwise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_dpi_end(handle: i32) -> i32 {
    // SAFETY: a simulator calls functions with one handle one after the other.
    let verdict = unsafe { beside::end(handle) };
    (verdict == MRTL_WRONG_HANDLE || beside::have_failed(Interface::Dpi)).into()
}

impl Beside {
    #[inline]
    fn put(&mut self, first: i32, words: [u64; CALL]) {
        let first = first as u32 as usize;
        if let Some(room) = self.words.get_mut(first..first.wrapping_add(CALL)) {
            room.copy_from_slice(&words);
        }
    }
}

#[cfg(test)]
mod tests;
