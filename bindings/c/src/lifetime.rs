//! Models and snapshots: made, freed, saved.

use crate::abi::MRTL_ABI;
use crate::bench::{Bench, MODELS, SNAPSHOTS, caught, given, mrtl_model, mrtl_snapshot, on};
use crate::codes::{MRTL_OK, MRTL_SETTINGS};
use crate::failure::Failure;
use crate::text;
use motion_rtl::Model;
use motion_rtl::registry::Pair;
use std::ffi::c_char;

/// Returns the ABI version of the library; compare it with MRTL_ABI of the header.
#[unsafe(no_mangle)]
pub extern "C" fn mrtl_abi() -> u32 {
    MRTL_ABI
}

/// Copies the version of the library, such as "0.1.0"; returns its length.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_version(text: *mut c_char, room: usize) -> i32 {
    caught(|| {
        // SAFETY: by the header's rules `text` is NULL or has `room` bytes.
        let written = unsafe { text::write(env!("CARGO_PKG_VERSION"), text, room) };
        written.unwrap_or_else(|failure| failure.code)
    })
}

/// Creates a model at power-on, before tick 0, with all input ports low; returns its handle.
///
/// `circuit` is a name that `motion-rtl list` prints. `settings` has one `key=value` per line, each
/// key once, as `motion-rtl list CIRCUIT` prints them; NULL or "" for none. On an error, the text
/// of it is copied to `error`, which may be NULL if `room` is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_new(
    circuit: *const c_char,
    settings: *const c_char,
    error: *mut c_char,
    room: usize,
) -> mrtl_model {
    caught(|| {
        let made = || {
            // SAFETY: by the header's rules both are NULL or strings that do not change meanwhile.
            let (circuit, settings) = unsafe {
                let settings = match settings.is_null() {
                    true => "",
                    false => text::read("settings", settings)?,
                };
                (text::read("circuit", circuit)?, settings)
            };
            let pairs = pairs(settings)?;
            once(&pairs)?;
            let model = Model::new(circuit, &pairs)?;
            given(MODELS.insert(Bench::new(model)), "models")
        };
        made().unwrap_or_else(|failure| {
            // SAFETY: by the header's rules `error` is NULL or has `room` bytes. The code of the
            // first error counts if the text of it cannot be written.
            let _ = unsafe { text::write(&failure.text, error, room) };
            failure.code
        })
    })
}

/// Returns the settings of `key=value` lines.
pub fn pairs(settings: &str) -> Result<Vec<Pair>, Failure> {
    let mut pairs = Vec::new();
    for (number, line) in (1..).zip(settings.lines()) {
        if !line.trim().is_empty() {
            pairs.push(line.trim().parse::<Pair>().map_err(|error| {
                Failure::new(MRTL_SETTINGS, format!("settings, line {number}: {error}"))
            })?);
        }
    }
    Ok(pairs)
}

/// Refuses keys that are given twice.
fn once(pairs: &[Pair]) -> Result<(), Failure> {
    let twice =
        (1..pairs.len()).find(|&at| pairs[..at].iter().any(|pair| pair.key == pairs[at].key));
    match twice {
        Some(at) => {
            let text = format!("settings: {}: given twice; allowed: once", pairs[at].key);
            Err(Failure::new(MRTL_SETTINGS, text))
        }
        None => Ok(()),
    }
}

/// Frees a model; its handle is wrong from then on. Waves that are not finished are dropped.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_free(model: mrtl_model) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    let removed = unsafe { MODELS.remove(model) };
    removed.map_or_else(|refusal| refusal.code(), |()| MRTL_OK)
}

/// Copies the text of the model's last error; returns its length, 0 if there was none. A wrong
/// handle is an error here too, and its text is copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_error(model: mrtl_model, text: *mut c_char, room: usize) -> i32 {
    caught(|| {
        // SAFETY: by the header's rules calls with one handle do not overlap, and `text` is NULL or
        // has `room` bytes.
        unsafe {
            let copied = MODELS.with(model, |bench| text::write(&bench.error, text, room));
            match copied {
                Ok(written) => written.unwrap_or_else(|failure| failure.code),
                Err(refusal) => {
                    let _ = text::write(&refusal.text("model", model), text, room);
                    refusal.code()
                }
            }
        }
    })
}

/// Saves the state of this tick: input ports, registers, memories; returns its handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_save(model: mrtl_model) -> mrtl_snapshot {
    let saved = |bench: &mut Bench| {
        let snapshot = bench.model.snapshot();
        given(SNAPSHOTS.insert(snapshot), "snapshots")
    };
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { on(model, saved) }
}

/// Continues from a snapshot of this model or of another model of the same circuit and settings.
/// Refused while waves are written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_restore(model: mrtl_model, snapshot: mrtl_snapshot) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap, be it of a model or of a
    // snapshot.
    unsafe {
        on(model, |bench| {
            let mut begun = false;
            let restored = SNAPSHOTS.with(snapshot, |saved| {
                begun = true;
                bench.model.restore(saved)
            });
            match restored {
                Ok(restored) => restored?,
                Err(_) if begun => panic!("the model is restored in part only"),
                Err(refusal) => {
                    let text = refusal.text("snapshot", snapshot);
                    return Err(Failure::new(refusal.code(), text));
                }
            }
            Ok(MRTL_OK)
        })
    }
}

/// Frees a snapshot; its handle is wrong from then on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_free_snapshot(snapshot: mrtl_snapshot) -> i32 {
    // SAFETY: by the header's rules calls with one handle do not overlap.
    let removed = unsafe { SNAPSHOTS.remove(snapshot) };
    removed.map_or_else(|refusal| refusal.code(), |()| MRTL_OK)
}
