//! Checkers that a simulator puts beside its designs, by DPI or by VHPIDIRECT.

use crate::codes::{MRTL_FULL, MRTL_MISMATCH, MRTL_OK};
use crate::failure::Failure;
use crate::lifetime::pairs;
use crate::table::Table;
use motion_rtl::Model;
use motion_rtl::checker::{
    Checker, CheckerError, DPI_VERSION, Options, PortList, VERSION, VHPI_VERSION, Verdict,
};
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_void};
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Words that a call by DPI passes.
pub const CALL: usize = 8;

/// Text in place of that of a checker that cannot go on.
pub const WRONG: &CStr = c"FAIL: the checker cannot go on: a fault inside the library";

static CHECKERS: Table<Beside, { 1 << 29 }> = Table::new();

thread_local! {
    /// Reason why the last checker of this thread was not made.
    static ERROR: RefCell<CString> = RefCell::default();
}

/// Interface by which a simulator calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interface {
    Dpi,
    Vhpi,
}

impl Interface {
    fn name(self) -> &'static str {
        match self {
            Interface::Dpi => "DPI",
            Interface::Vhpi => "VHPI",
        }
    }

    fn version(self) -> u32 {
        match self {
            Interface::Dpi => DPI_VERSION,
            Interface::Vhpi => VHPI_VERSION,
        }
    }

    /// Returns the command that prints a checker.
    fn command(self, circuit: &str) -> String {
        match self {
            Interface::Dpi => format!("motion-rtl verilog {circuit} --dpi"),
            Interface::Vhpi => format!("motion-rtl vhdl {circuit} --vhpi"),
        }
    }
}

/// Checker of an instance of a design.
pub struct Beside {
    pub checker: Checker,
    instance: String,
    /// Words of the tick, with room for whole calls.
    pub words: Vec<u64>,
    /// Number of words.
    pub count: usize,
    /// Text that the simulator prints.
    pub text: CString,
}

impl Beside {
    /// Takes what the checker has to say, if it says something.
    pub fn take_text(&mut self) {
        let said = self.checker.take_text();
        if !said.is_empty() {
            self.text = printed(&format!("{}: {said}", self.instance));
        }
    }
}

/// Comparison that has not ended.
struct Running {
    handle: i32,
    instance: String,
    interface: Interface,
}

/// Comparisons of this process.
struct Comparisons {
    running: Vec<Running>,
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

/// Ends the comparisons in VHDL, which has no final blocks, and prints their verdicts. Says which
/// ones in SystemVerilog have no verdict, because the simulator has not run its final blocks.
extern "C" fn at_exit() {
    let running = std::mem::take(&mut comparisons().running);
    let (vhdl, verilog): (Vec<_>, Vec<_>) = running
        .into_iter()
        .partition(|other| other.interface == Interface::Vhpi);
    for Running { instance, .. } in verilog {
        eprintln!(
            "FAIL: {instance}: the comparison has not ended; a bench in C++ calls final() of the \
             model before it exits"
        );
    }
    if vhdl.is_empty() {
        return;
    }
    // The verdicts come after what the simulator has printed.
    // SAFETY: NULL stands for all streams.
    unsafe { fflush(std::ptr::null_mut()) };
    let mut out = std::io::stdout().lock();
    for Running { handle, .. } in vhdl {
        // SAFETY: the simulator has ended, so that no call overlaps these.
        let text = unsafe {
            end(handle);
            text(handle)
        };
        // Standard output may be closed.
        let _ = writeln!(out, "{}", text.to_string_lossy());
    }
    let _ = out.flush();
    if comparisons().failed {
        let _ = writeln!(std::io::stderr(), "a checker of motion-rtl has not passed");
        // SAFETY: all streams are flushed. A handler at the end of a process cannot call `exit`.
        unsafe { _exit(1) };
    }
}

unsafe extern "C" {
    fn atexit(call: extern "C" fn()) -> i32;
    fn fflush(stream: *mut c_void) -> i32;
    fn _exit(code: i32) -> !;
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
pub fn waves(pattern: &str, instance: &str) -> Option<PathBuf> {
    let plain = |letter: char| match letter {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '_' | '-' => letter,
        _ => '_',
    };
    let name: String = instance.chars().map(plain).collect();
    (!pattern.is_empty()).then(|| pattern.replace("%m", &name).into())
}

/// Facts that a checker passes when it is made.
pub struct Made<'t> {
    pub interface: Interface,
    /// Version of the functions that the checker calls.
    pub abi: i32,
    pub version: &'t str,
    pub circuit: &'t str,
    pub settings: &'t str,
    /// Hash of the ports.
    pub ports: u64,
    pub leave: Vec<String>,
    pub from_power_on: bool,
    pub waves: &'t str,
    pub instance: &'t str,
}

/// Puts a model beside an instance of a design; returns the handle of the checker.
pub fn made(made: Made<'_>) -> Result<i32, Failure> {
    let Made {
        interface,
        abi,
        version,
        circuit,
        settings,
        ports,
        leave,
        from_power_on,
        waves: pattern,
        instance,
    } = made;
    let anew = interface.command(circuit);
    if version != VERSION || u32::try_from(abi) != Ok(interface.version()) {
        let (name, own) = (interface.name(), interface.version());
        let text = format!(
            "the checker is of motion-rtl {version} ({name} {abi}), the library of {VERSION} \
             ({name} {own}); `{anew}` prints the checker anew"
        );
        return Err(Failure::new(MRTL_MISMATCH, text));
    }
    let model = Model::new(circuit, &pairs(settings)?)?;
    let list = PortList::of(&model);
    if list.hash() != ports {
        let text = format!(
            "{circuit} has other ports than the checker is made for; `{anew}` prints the checker \
             anew; the ports are:\n{}",
            list.text()
        );
        return Err(Failure::new(MRTL_MISMATCH, text.trim_end()));
    }
    let options = Options {
        leave,
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
    comparisons.running.push(Running {
        handle,
        instance: instance.to_owned(),
        interface,
    });
    Ok(handle)
}

/// Keeps the reason why the checker of an instance was not made; returns its code.
pub fn refused(instance: &str, failure: &Failure) -> i32 {
    comparisons().failed = true;
    ERROR.set(printed(&format!("{instance}: {}", failure.text)));
    failure.code
}

/// Calls a function with the reason why the last checker of this thread was not made.
pub fn error<T>(call: impl FnOnce(&CStr) -> T) -> T {
    ERROR.with_borrow(|text| call(text))
}

/// Calls a function with a checker; 0 or a negative code if that cannot be.
///
/// # Safety
/// Calls with one handle do not overlap in time.
#[inline]
pub unsafe fn on(handle: i32, call: impl FnOnce(&mut Beside) -> i32) -> i32 {
    // SAFETY: this function's contract is that of the table.
    let result = unsafe { CHECKERS.with(handle, call) };
    result.unwrap_or_else(|refusal| refusal.code())
}

/// Returns the text that there is to print.
///
/// # Safety
/// Calls with one handle do not overlap in time.
pub unsafe fn text(handle: i32) -> CString {
    let mut text = WRONG.to_owned();
    let take = |beside: &mut Beside| {
        beside.take_text();
        text = beside.text.clone();
        MRTL_OK
    };
    // SAFETY: this function's contract is that of `on`.
    unsafe { on(handle, take) };
    text
}

/// Ends a comparison, whose report is the text to print. Returns 0 if it has passed.
///
/// # Safety
/// Calls with one handle do not overlap in time.
pub unsafe fn end(handle: i32) -> i32 {
    let end = |beside: &mut Beside| match beside.checker.end() {
        Verdict::Pass => MRTL_OK,
        Verdict::Fail | Verdict::Vacuous => 1,
    };
    // SAFETY: this function's contract is that of `on`.
    let verdict = unsafe { on(handle, end) };
    let mut comparisons = comparisons();
    comparisons.failed |= verdict != MRTL_OK;
    comparisons.running.retain(|other| other.handle != handle);
    verdict
}

/// True if no comparison by this interface runs and not all have passed.
pub fn have_failed(interface: Interface) -> bool {
    let comparisons = comparisons();
    let mut running = comparisons.running.iter();
    comparisons.failed && !running.any(|other| other.interface == interface)
}

#[cfg(test)]
mod tests {
    use super::waves;

    #[test]
    fn files_are_named_after_the_instance() {
        let path = |pattern| waves(pattern, "TOP.a[1].\\b/c");
        assert_eq!(path("out/%m.vcd"), Some("out/TOP.a_1_._b_c.vcd".into()));
        assert_eq!((path("a.fst"), path("")), (Some("a.fst".into()), None));
    }
}
