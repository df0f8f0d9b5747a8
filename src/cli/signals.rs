//! Signals that end the program: it leaves nothing half-written, and says by its exit code which one
//! it was.

#[cfg(unix)]
use {
    super::{equal, serve},
    motion_rtl::files::abandon,
    signal_hook::consts::{SIGHUP, SIGINT, SIGTERM},
    signal_hook::iterator::Signals,
    std::sync::mpsc::channel,
    std::{fs, process, thread},
};

/// Offset of a signal's number in the exit code of a shell.
#[cfg(unix)]
const ENDED: i32 = 128;

/// Starts to clean up on SIGHUP, SIGINT and SIGTERM. A signal that `nohup` or a shell ignores stays
/// ignored.
///
/// If the handlers cannot be installed, the signals end the program without cleaning up, and the
/// next run removes the leftovers.
#[cfg(unix)]
pub fn watch() {
    let ignored = ignored();
    let wanted = [SIGHUP, SIGINT, SIGTERM];
    let wanted: Vec<i32> = wanted
        .into_iter()
        .filter(|signal| ignored >> (signal - 1) & 1 == 0)
        .collect();
    let (ready, wait) = channel();
    let thread = thread::Builder::new()
        .name("signals".into())
        .spawn(move || {
            // Here, as signals that nobody waits for would be lost.
            let signals = Signals::new(wanted);
            let _ = ready.send(());
            if let Some(signal) = signals.ok().and_then(|mut all| all.forever().next()) {
                abandon(|| {
                    equal::stop();
                    serve::stop();
                    process::exit(ENDED + signal)
                });
            }
        });
    if thread.is_ok() {
        let _ = wait.recv();
    }
}

/// Signals that are ignored, as bits: signal 1 is the lowest. None where the system does not tell.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0)
}

/// Elsewhere the next run clears away what is left.
#[cfg(not(unix))]
pub fn watch() {}
