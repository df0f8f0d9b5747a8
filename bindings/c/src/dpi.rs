//! Functions of the checkers that `motion-rtl verilog --dpi` prints: integers and strings only.
//!
//! The simulator copies a string that a function returns before it calls the next one.

use crate::bench::caught;
use crate::codes::{MRTL_FULL, MRTL_MISMATCH, MRTL_OK, MRTL_WRONG_HANDLE};
use crate::failure::Failure;
use crate::lifetime::pairs;
use crate::table::Table;
use crate::text;
use motion_rtl::Model;
use motion_rtl::checker::{
    Checker, CheckerError, DPI_VERSION, Options, PortList, VERSION, Verdict,
};
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Words that a call passes.
const CALL: usize = 8;

/// Index that stands for the reset.
const RESET: i32 = -1;

static CHECKERS: Table<Beside, { 1 << 29 }> = Table::new();

thread_local! {
    /// Reason why the last checker of this thread was not made.
    static ERROR: RefCell<CString> = RefCell::default();
}

/// Checker of an instance of a design.
struct Beside {
    checker: Checker,
    instance: String,
    /// Words of the tick, with room for whole calls.
    words: Vec<u64>,
    /// Number of words.
    count: usize,
    /// Text that the simulator prints.
    text: CString,
}

/// Comparisons of this process.
struct Comparisons {
    /// Instances whose comparison has not ended.
    running: Vec<(i32, String)>,
    /// True if a comparison has not passed.
    failed: bool,
    /// True if the end of the process is watched.
    watched: bool,
}

static COMPARISONS: Mutex<Comparisons> = Mutex::new(Comparisons {
    running: Vec::new(),
    failed: false,
    watched: false,
});

fn comparisons() -> MutexGuard<'static, Comparisons> {
    COMPARISONS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Says which comparisons have no verdict, because the simulator has not run its final blocks.
extern "C" fn at_exit() {
    for (_, instance) in &comparisons().running {
        eprintln!(
            "FAIL: {instance}: the comparison has not ended; a bench in C++ calls final() of the \
             model before it exits"
        );
    }
}

unsafe extern "C" {
    fn atexit(call: extern "C" fn()) -> i32;
}

/// Returns a text for the simulator: without the last newline, and without NUL.
fn printed(text: &str) -> CString {
    let end = text.find('\0').unwrap_or(text.len());
    CString::new(text[..end].trim_end()).unwrap_or_default()
}

fn of_checker(error: CheckerError) -> Failure {
    match error {
        CheckerError::Model(error) => error.into(),
        other => Failure::new(MRTL_MISMATCH, other.to_string()),
    }
}

/// Files that a parameter of a checker names.
fn waves(pattern: &str, instance: &str) -> Option<PathBuf> {
    let plain = |letter: char| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '_' | '-' => letter,
        _ => '_',
    };
    let name: String = instance.chars().map(plain).collect();
    (!pattern.is_empty()).then(|| pattern.replace("%m", &name).into())
}

/// Returns the name of an instance without the scope that some versions of Verilator put around all.
fn without_top(instance: &str) -> &str {
    instance.strip_prefix("TOP.").unwrap_or(instance)
}

/// Strings that a checker passes.
struct Strings<'t> {
    version: &'t str,
    circuit: &'t str,
    settings: &'t str,
    left: &'t str,
    waves: &'t str,
    instance: &'t str,
}

fn made(dpi: i32, ports: u64, from_power_on: bool, strings: Strings<'_>) -> Result<i32, Failure> {
    let Strings {
        version,
        circuit,
        settings,
        left,
        waves: pattern,
        instance,
    } = strings;
    if version != VERSION || u32::try_from(dpi) != Ok(DPI_VERSION) {
        let text = format!(
            "the checker is of motion-rtl {version} (DPI {dpi}), the library of {VERSION} (DPI \
             {DPI_VERSION}); `motion-rtl verilog {circuit} --dpi` prints the checker anew"
        );
        return Err(Failure::new(MRTL_MISMATCH, text));
    }
    let model = Model::new(circuit, &pairs(settings)?)?;
    let list = PortList::of(&model);
    if list.hash() != ports {
        let text = format!(
            "{circuit} has other ports than the checker is made for; `motion-rtl verilog {circuit} \
             --dpi` prints the checker anew; the ports are:\n{}",
            list.text()
        );
        return Err(Failure::new(MRTL_MISMATCH, text.trim_end()));
    }
    let options = Options {
        leave: left.lines().map(str::to_owned).collect(),
        from_power_on,
        waves: waves(pattern, instance),
    };
    let checker = Checker::new(model, &options).map_err(of_checker)?;
    let count = checker.words().words;
    let beside = Beside {
        checker,
        instance: instance.to_owned(),
        words: vec![0; count.next_multiple_of(CALL).max(CALL)],
        count,
        text: CString::default(),
    };
    let full = || Failure::new(MRTL_FULL, "there are too many checkers at once");
    let handle = CHECKERS.insert(beside).ok_or_else(full)?;
    let mut comparisons = comparisons();
    if !comparisons.watched {
        // SAFETY: a handler without arguments that does not unwind.
        comparisons.watched = unsafe { atexit(at_exit) } == 0;
    }
    comparisons.running.push((handle, instance.to_owned()));
    Ok(handle)
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
        let result = || {
            // SAFETY: the simulator passes strings, which do not change meanwhile.
            let strings = unsafe {
                Strings {
                    version: text::read("version", version)?,
                    circuit: text::read("circuit", circuit)?,
                    settings: text::read("settings", settings)?,
                    left: text::read("left", left)?,
                    waves: text::read("waves", waves)?,
                    instance: text::read("instance", instance)?,
                }
            };
            let strings = Strings {
                instance: without_top(strings.instance),
                ..strings
            };
            let name = strings.instance;
            made(dpi, ports, from_power_on != 0, strings).map_err(|failure| Failure {
                text: format!("{name}: {}", failure.text),
                ..failure
            })
        };
        result().unwrap_or_else(|failure| {
            comparisons().failed = true;
            ERROR.set(printed(&failure.text));
            failure.code
        })
    })
}

/// Returns the reason why the last checker was not made.
#[unsafe(no_mangle)]
pub extern "C" fn mrtl_dpi_error() -> *const c_char {
    ERROR.with_borrow(|text| text.as_ptr())
}

/// Calls a function with a checker; 0 or a negative code if that cannot be.
///
/// # Safety
/// Calls with one handle do not overlap in time.
#[inline]
unsafe fn on(handle: i32, call: impl FnOnce(&mut Beside) -> i32) -> i32 {
    // SAFETY: this function's contract is that of the table.
    let result = unsafe { CHECKERS.with(handle, call) };
    result.unwrap_or_else(|refusal| refusal.code())
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
        let said = beside.checker.take_text();
        if !said.is_empty() {
            beside.text = printed(&format!("{}: {said}", beside.instance));
        }
        text = beside.text.as_ptr();
        MRTL_OK
    };
    // SAFETY: a simulator calls functions with one handle one after the other. The text lives
    // until the next call with this handle that makes another one.
    unsafe { on(handle, take) };
    text
}

const WRONG: &CStr = c"FAIL: the checker cannot go on: a fault inside the library";

/// Ends a comparison, whose report is the text to print. Returns 1 if it is the last comparison
/// and not all have passed, 0 otherwise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_dpi_end(handle: i32) -> i32 {
    let end = |beside: &mut Beside| match beside.checker.end() {
        Verdict::Pass => MRTL_OK,
        Verdict::Fail | Verdict::Vacuous => 1,
    };
    // SAFETY: a simulator calls functions with one handle one after the other.
    let verdict = unsafe { on(handle, end) };
    let mut comparisons = comparisons();
    comparisons.failed |= verdict != MRTL_OK;
    comparisons.running.retain(|(other, _)| *other != handle);
    (verdict == MRTL_WRONG_HANDLE || comparisons.running.is_empty() && comparisons.failed).into()
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
