//! Functions of the checkers that `motion-rtl vhdl --vhpi` prints, as GHDL calls foreign
//! subprograms: an integer by value, an unconstrained array by a pointer to its values and bounds.

use crate::bench::caught;
use crate::beside::{self, Interface, Made, WRONG};
use crate::codes::{MRTL_MISMATCH, MRTL_OK};
use std::ffi::CStr;
use std::slice;

/// Unconstrained array of bytes in GHDL: a string, or values of `std_ulogic`.
#[repr(C)]
pub struct GhdlArray {
    values: *mut u8,
    bounds: *const GhdlBounds,
}

/// Range of an array in GHDL.
#[repr(C)]
pub struct GhdlBounds {
    left: i32,
    right: i32,
    direction: u8,
    length: u32,
}

/// Returns the values of an array.
///
/// # Safety
/// The pointer is that of an argument of GHDL, and the array does not change for `'t`.
unsafe fn values<'t>(array: *const GhdlArray) -> &'t [u8] {
    // SAFETY: GHDL passes the array and its bounds, which live as long as the call.
    let (values, length) = unsafe { ((*array).values, (*(*array).bounds).length) };
    match length {
        0 => &[],
        // SAFETY: `length` bytes are the values of the array.
        _ => unsafe { slice::from_raw_parts(values, length as usize) },
    }
}

/// Returns a string: UTF-8 as GHDL reads it from a source, or Latin-1.
fn string(bytes: &[u8]) -> String {
    match str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// Returns the name of an instance from its attribute `path_name`.
fn instance(path: &str) -> String {
    path.trim_matches(':').replace(':', ".")
}

/// Returns the names in a list.
fn names(list: &str) -> Vec<String> {
    let names = list.split([',', ' ']).filter(|name| !name.is_empty());
    names.map(str::to_owned).collect()
}

fn length(text: &CStr) -> i32 {
    i32::try_from(text.count_bytes()).unwrap_or(i32::MAX)
}

/// Puts a model beside an instance of a design. Returns the handle of the checker, or 0 less the
/// length of the text that says why there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_vhpi_new(
    vhpi: i32,
    from_power_on: i32,
    version: *const GhdlArray,
    circuit: *const GhdlArray,
    settings: *const GhdlArray,
    ports: *const GhdlArray,
    leave: *const GhdlArray,
    waves: *const GhdlArray,
    path: *const GhdlArray,
) -> i32 {
    let code = caught(|| {
        let strings = [version, circuit, settings, ports, leave, waves, path];
        // SAFETY: these are arguments of GHDL.
        let strings = strings.map(|array| string(unsafe { values(array) }));
        let [version, circuit, settings, ports, leave, waves, path] = &strings;
        let instance = instance(path);
        let made = beside::made(Made {
            interface: Interface::Vhpi,
            abi: vhpi,
            version,
            circuit,
            settings,
            ports: u64::from_str_radix(ports, 16).unwrap_or_default(),
            leave: names(leave),
            from_power_on: from_power_on != 0,
            waves,
            instance: &instance,
        });
        made.unwrap_or_else(|failure| beside::refused(&instance, &failure))
    });
    match code {
        1.. => code,
        _ => beside::error(|text| -length(text)),
    }
}

/// Passes the reset and all ports at a rising edge. Returns the length of the text that there is to
/// print.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_vhpi_edge(handle: i32, ports: *const GhdlArray) -> i32 {
    // SAFETY: GHDL calls functions with one handle one after the other, and the array is its
    // argument.
    let result = unsafe {
        beside::on(handle, |beside| {
            match beside.checker.logic_edge(values(ports)) {
                Ok(false) => MRTL_OK,
                Ok(true) => {
                    beside.take_text();
                    length(&beside.text)
                }
                Err(_) => MRTL_MISMATCH,
            }
        })
    };
    match result {
        0.. => result,
        _ => length(WRONG),
    }
}

/// Copies the text that there is to print; for a handle below 1, the reason why the last checker was
/// not made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_vhpi_text(handle: i32, text: *const GhdlArray) {
    let said = match handle {
        // SAFETY: GHDL calls functions with one handle one after the other.
        1.. => unsafe { beside::text(handle) },
        _ => beside::error(CStr::to_owned),
    };
    // SAFETY: the array is a variable of GHDL, and its bounds give its room.
    unsafe {
        let room = (*(*text).bounds).length as usize;
        let length = room.min(said.count_bytes());
        (*text)
            .values
            .copy_from_nonoverlapping(said.as_ptr().cast(), length);
    }
}

#[cfg(test)]
mod tests;
