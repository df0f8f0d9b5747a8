//! Functions that Rust's library calls and that the C library of WASI of 2022, which Debian has,
//! lacks. There are no threads, and paths have no links.

use std::ffi::{c_char, c_int};
use std::ptr::null_mut;

macro_rules! missing {
    ($($name:ident($($argument:ty),*) = $result:expr;)*) => {$(
        // SAFETY: nothing else has the name in this program, and callers pass arguments of the
        // sizes that POSIX says.
        #[unsafe(no_mangle)]
        extern "C" fn $name($(_: $argument),*) -> c_int {
            $result
        }
    )*};
}

/// Error number of WASI for a function that there is not.
const ENOSYS: c_int = 52;

missing! {
    pthread_attr_init(usize) = 0;
    pthread_attr_setstacksize(usize, usize) = 0;
    pthread_attr_destroy(usize) = 0;
    pthread_create(usize, usize, usize, usize) = ENOSYS;
    pthread_detach(usize) = 0;
    pthread_join(usize, usize) = ENOSYS;
}

/// Resolves nothing: a caller takes the path as there is none.
// SAFETY: as above.
#[unsafe(no_mangle)]
extern "C" fn realpath(_: *const c_char, _: *mut c_char) -> *mut c_char {
    null_mut()
}

/// Error number of calls that go around Rust's library.
static mut ERROR: c_int = ENOSYS;

// SAFETY: as above. There is one thread, and the place lives as long as the program.
#[unsafe(no_mangle)]
extern "C" fn __errno_location() -> *mut c_int {
    &raw mut ERROR
}
