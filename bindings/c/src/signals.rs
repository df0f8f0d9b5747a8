//! Signals: found, described, set, read.

use crate::bench::{Bench, mrtl_model, on};
use crate::codes::*;
use crate::failure::Failure;
use crate::text;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::ffi::c_char;

/// Returns the number of signals: ports, registers, words of memories, nets. Their indices begin
/// at 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_count(model: mrtl_model) -> i32 {
    let count = |bench: &mut Bench| Ok(i32::try_from(bench.signals().len()).unwrap_or(i32::MAX));
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { on(model, count) }
}

/// Returns the index of a signal by its name: a path as in the waves (`rates.scan_period`), a name
/// in the printed Verilog (`rates_scan_period`), or a word of a memory (`memory[3]`).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_find(model: mrtl_model, name: *const c_char) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `name` is NULL or a
    // string that does not change meanwhile.
    unsafe {
        on(model, |bench| {
            let name = text::read("name", name)?;
            Ok(bench.model.find(name)?.index() as i32)
        })
    }
}

/// Copies a text of a signal; returns its length.
///
/// # Safety
/// Calls with one handle do not overlap in time, and `text` is NULL or has `room` bytes.
unsafe fn copy(
    model: mrtl_model,
    index: i32,
    text: *mut c_char,
    room: usize,
    of: impl FnOnce(&SignalInfo) -> &str,
) -> i32 {
    // SAFETY: this function's contract is the same.
    unsafe {
        on(model, |bench| {
            text::write(of(bench.signal(index)?), text, room)
        })
    }
}

/// Copies the path of a signal below its circuit; returns its length.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_name(
    model: mrtl_model,
    index: i32,
    text: *mut c_char,
    room: usize,
) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `text` is NULL or has
    // `room` bytes.
    unsafe { copy(model, index, text, room, |signal| &signal.path) }
}

/// Copies the name of a signal below the circuit's Verilog module; returns its length.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_verilog_name(
    model: mrtl_model,
    index: i32,
    text: *mut c_char,
    room: usize,
) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `text` is NULL or has
    // `room` bytes.
    unsafe { copy(model, index, text, room, |signal| &signal.verilog) }
}

/// Copies the documentation of a signal, one line that may be empty; returns its length.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_doc(
    model: mrtl_model,
    index: i32,
    text: *mut c_char,
    room: usize,
) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `text` is NULL or has
    // `room` bytes.
    unsafe { copy(model, index, text, room, |signal| &signal.doc) }
}

/// Returns a property of a signal.
///
/// # Safety
/// Calls with one handle do not overlap in time.
unsafe fn property(model: mrtl_model, index: i32, of: impl FnOnce(&SignalInfo) -> i32) -> i32 {
    // SAFETY: this function's contract is the same.
    unsafe { on(model, |bench| bench.signal(index).map(of)) }
}

/// Returns the width of a signal in bits, 1 to 64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_width(model: mrtl_model, index: i32) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { property(model, index, |signal| signal.width() as i32) }
}

/// Returns 1 if a signal is a two's complement number, 0 otherwise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_is_signed(model: mrtl_model, index: i32) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { property(model, index, |signal| signal.is_signed().into()) }
}

/// Returns MRTL_IN or MRTL_OUT for a port of the circuit, MRTL_INNER for other signals.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_direction(model: mrtl_model, index: i32) -> i32 {
    let direction = |signal: &SignalInfo| match signal.port {
        None => MRTL_INNER,
        Some(PortDirection::In) => MRTL_IN,
        Some(PortDirection::Out) => MRTL_OUT,
    };
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { property(model, index, direction) }
}

/// Returns MRTL_INPUT, MRTL_REGISTER or MRTL_NET: the role of a signal in its own circuit, which
/// may be a part of the model's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_role(model: mrtl_model, index: i32) -> i32 {
    let role = |signal: &SignalInfo| match signal.role {
        Role::Input => MRTL_INPUT,
        Role::Register => MRTL_REGISTER,
        Role::Net => MRTL_NET,
    };
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { property(model, index, role) }
}

/// Sets an input port to the bits of a word, from this tick on. A word that is wider than the port
/// is an error, and nothing is set then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_set(model: mrtl_model, port: i32, bits: u64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            let port = bench.handle(port)?;
            bench.model.set_bits(port, bits)?;
            Ok(MRTL_OK)
        })
    }
}

/// Sets an input port to a number, from this tick on. A number that does not fit the port is an
/// error, and nothing is set then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_set_signed(model: mrtl_model, port: i32, number: i64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe {
        on(model, |bench| {
            let port = bench.handle(port)?;
            bench.model.set(port, number)?;
            Ok(MRTL_OK)
        })
    }
}

/// Reads the bits of any signal in this tick, settled, with zeros above its width.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_get(model: mrtl_model, index: i32, bits: *mut u64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `bits` is NULL or can
    // be written.
    unsafe {
        on(model, |bench| {
            let signal = bench.handle(index)?;
            put("bits", bits, bench.model.get(signal)?)
        })
    }
}

/// Reads any signal in this tick, settled, as a two's complement number of its width.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_get_signed(model: mrtl_model, index: i32, number: *mut i64) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, and `number` is NULL or
    // can be written.
    unsafe {
        on(model, |bench| {
            let signal = bench.handle(index)?;
            put("number", number, bench.model.get_signed(signal)?)
        })
    }
}

/// Writes a number for the caller.
///
/// # Errors
/// Returns an error if the pointer is NULL.
///
/// # Safety
/// The pointer is NULL, or one number can be written there.
pub unsafe fn put<T>(what: &str, to: *mut T, number: T) -> Result<i32, Failure> {
    if to.is_null() {
        return Err(Failure::null(what));
    }
    // SAFETY: the pointer is not NULL, and the rest is this function's own contract.
    unsafe { to.write(number) };
    Ok(MRTL_OK)
}
