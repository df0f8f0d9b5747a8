//! Strings of the caller.

use crate::codes::MRTL_NOT_UTF8;
use crate::failure::Failure;
use std::ffi::{CStr, c_char};

/// Returns a string of the caller.
///
/// # Errors
/// Returns an error if the pointer is NULL or the string is not UTF-8.
///
/// # Safety
/// The pointer is NULL, or leads to bytes that end with NUL and do not change for `'t`.
pub unsafe fn read<'t>(what: &str, text: *const c_char) -> Result<&'t str, Failure> {
    if text.is_null() {
        return Err(Failure::null(what));
    }
    // SAFETY: the pointer is not NULL, and the rest is this function's own contract.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|error| {
        let byte = error.valid_up_to();
        Failure::new(
            MRTL_NOT_UTF8,
            format!("{what} is not UTF-8 from byte {byte} on"),
        )
    })
}

/// Writes as much of a text as fits into a buffer, whole characters and a NUL behind them; returns
/// the length of the whole text in bytes.
///
/// # Errors
/// Returns an error if the pointer is NULL and `room` is not 0.
///
/// # Safety
/// The pointer is NULL, or `room` bytes at it can be written and nothing else uses them.
pub unsafe fn write(text: &str, to: *mut c_char, room: usize) -> Result<i32, Failure> {
    if to.is_null() && room > 0 {
        return Err(Failure::null("text"));
    }
    if room > 0 {
        // A NUL would end the string for C.
        let end = text.find('\0').unwrap_or(text.len());
        let length = text.floor_char_boundary(end.min(room - 1));
        // SAFETY: the pointer is not NULL, and `length + 1 <= room` bytes can be written there by
        // this function's contract; the text is Rust's own memory and does not overlap them.
        unsafe {
            to.copy_from_nonoverlapping(text.as_ptr().cast(), length);
            to.add(length).write(0);
        }
    }
    Ok(i32::try_from(text.len()).unwrap_or(i32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What C finds in a buffer of `room` bytes, and the bytes behind it.
    fn written(text: &str, room: usize) -> (String, i32, bool) {
        let mut buffer = [b'#' as c_char; 16];
        // SAFETY: the buffer has 16 bytes, of which `room` are given.
        let length = unsafe { write(text, buffer.as_mut_ptr(), room) }.unwrap();
        // SAFETY: a NUL was written into the buffer.
        let read = unsafe { CStr::from_ptr(buffer.as_ptr()) };
        let untouched = buffer[room..].iter().all(|&byte| byte == b'#' as c_char);
        (read.to_str().unwrap().to_owned(), length, untouched)
    }

    #[test]
    fn texts_are_cut_between_characters_and_end_with_nul() {
        assert_eq!(written("count", 6), ("count".into(), 5, true));
        assert_eq!(written("count", 5), ("coun".into(), 5, true));
        assert_eq!(written("count", 1), ("".into(), 5, true));
        assert_eq!(written("aµb", 3), ("a".into(), 4, true));
        assert_eq!(written("aµb", 4), ("aµ".into(), 4, true));
        assert_eq!(written("a\0b", 10), ("a".into(), 3, true));
    }

    #[test]
    fn no_buffer_takes_nothing() {
        let null = std::ptr::null_mut();
        // SAFETY: NULL is allowed.
        let [whole, wrong] = unsafe { [write("count", null, 0), write("count", null, 1)] };
        assert_eq!(whole.unwrap(), 5);
        assert_eq!(wrong.unwrap_err().text, "text is NULL");
    }

    #[test]
    fn strings_are_read_if_they_are_utf8() {
        // SAFETY: each literal ends with NUL.
        let [good, bad, null] = unsafe {
            [
                read("name", c"aµ".as_ptr()),
                read("name", c"a\xff".as_ptr()),
                read("name", std::ptr::null()),
            ]
        };
        assert_eq!(good.unwrap(), "aµ");
        assert_eq!(bad.unwrap_err().text, "name is not UTF-8 from byte 1 on");
        assert_eq!(null.unwrap_err().text, "name is NULL");
    }
}
