//! C ABI of `motion-rtl`: running circuits behind handles, integers and strings.
//!
//! Each function keeps four rules. Pointers are only those of the caller, and are not used after
//! the call. A wrong handle, index or string is an error code. Text is copied into the caller's
//! buffer. No panic leaves the library.
//!
//! Callers keep the rules at the head of the header. On them stands every `unsafe` block:
//!
//! - Calls with one handle do not overlap in time.
//! - A string is NULL or ends with NUL. A buffer has the room that is given with it.

// The rules above are those of each function.
#![allow(clippy::missing_safety_doc)]

mod abi;
mod bench;
mod beside;
mod check;
mod codes;
mod dpi;
mod failure;
mod lifetime;
mod run;
mod signals;
mod table;
mod text;
mod vhpi;
mod waves;
