//! Fast backend: compiles a plan to machine code by [Cranelift](https://cranelift.dev).
//!
//! The code has the same effect on the slab as the [interpreter](super::interpreter). The caller
//! chooses which blocks are inlined and always run: see [`Code::compile`].

mod block;
mod choices;
mod emit;
mod flow;
mod shown;
#[cfg(test)]
mod tests;

use super::input::InputChange;
use super::plan::Plan;
use super::replay::Replay;
use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::ir::{AbiParam, Signature, types};
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_codegen::settings::{self, Configurable, Flags};
use memmap2::{Mmap, MmapMut};
use shown::{ENDED, NEVER, Tables};
use std::ffi::c_void;
use std::fmt;
use wasmtime_internal_jit_icache_coherence as coherence;

/// Machine code of a plan.
pub struct Code {
    memory: Mmap,
    /// Number of words of a slab.
    words: usize,
    /// Number of change marks of a slab.
    marks: usize,
    size: usize,
}

/// Reason why a plan cannot be compiled.
#[derive(Debug, thiserror::Error)]
pub enum CompileError {
    /// Cranelift does not support this machine.
    #[error("no compiler for this machine: {0}")]
    Machine(String),
    /// The system gives no executable memory.
    #[error("no memory for code")]
    Memory(#[from] std::io::Error),
    /// Cranelift failed.
    #[error("compiler: {0}")]
    Cranelift(String),
    /// The code would need this number of bytes of the stack.
    #[error("the circuit is so large that its code takes {0} bytes of the stack, allowed: {FRAME}")]
    Frame(u32),
    /// The plan was not made by [`Plan::of`].
    #[error("a plan of which something stands outside of its slab")]
    Plan,
}

/// Compiled function: takes `slab`, phase, ticks and the tables of a replay, if there is one;
/// returns the number of ticks left.
type Entry = unsafe extern "C" fn(*mut u64, u64, u64, *mut Tables) -> u64;

/// Number of words computed in a part of a block. All may be live at once, and the compile time
/// grows with the square of that number.
const PART: usize = 128;
/// Number of steps above which machine registers are allocated in a single pass. The time of the
/// other allocator grows faster than the number of steps.
const MANY: usize = 8_000;
/// Stack bytes that code may use: a quarter of a thread's stack.
const FRAME: u32 = 512 * 1024;

/// Phase that settles once.
const SETTLE: u64 = 0;
/// Phase that makes an edge, then alternates settlings and edges while ticks are left.
const EDGE: u64 = 1;
/// Phase that begins a tick of a replay: input changes, then settlings and edges.
const ARRIVE: u64 = 2;
/// Phase that continues from a settled tick of a replay, with the number of ticks between it and
/// the next arrival.
const GO_ON: u64 = 3;
/// Number of phases.
const PHASES: usize = 4;

impl Code {
    /// Compiles a plan.
    ///
    /// Blocks that are `hot` run in every tick and are not woken. After a run of such code, all
    /// blocks must be [woken](super::layout::Layout::wake) before another backend continues.
    /// Everything else in the slab is as the interpreter leaves it, except words that only the
    /// steps of a block use.
    ///
    /// # Errors
    /// Returns an error if there is no compiler for this machine, no memory, too much stack use,
    /// or an index out of range in the plan.
    pub fn compile(plan: &Plan, hot: &[bool]) -> Result<Code, CompileError> {
        let steps: usize = plan.blocks.iter().map(|block| block.steps.len()).sum();
        Self::in_parts(plan, hot, PART, steps > MANY)
    }

    /// Compiles blocks in parts of `part` words; allocates machine registers in a single pass or
    /// with more effort.
    fn in_parts(
        plan: &Plan,
        hot: &[bool],
        part: usize,
        single_pass: bool,
    ) -> Result<Code, CompileError> {
        let isa = machine(single_pass)?;
        let mut context = Context::new();
        let call = isa.default_call_conv();
        let word = || AbiParam::new(types::I64);
        context.func.signature = Signature {
            params: vec![word(), word(), word(), word()],
            returns: vec![word()],
            call_conv: call,
        };
        flow::emit(plan, hot, part, &mut context.func)?;
        let compiled = context
            .compile(&*isa, &mut ControlPlane::default())
            .map_err(|error| CompileError::Cranelift(error.inner.to_string()))?;
        if !compiled.buffer.relocs().is_empty() {
            return Err(CompileError::Cranelift("code that calls out".to_owned()));
        }
        let frame = compiled.buffer.frame_layout();
        let frame = frame.map_or(0, |layout| layout.frame_to_fp_offset);
        if frame > FRAME {
            return Err(CompileError::Frame(frame));
        }
        let bytes = compiled.code_buffer();
        Ok(Code {
            memory: executable(bytes)?,
            words: plan.layout.words as usize,
            marks: plan.layout.marks(),
            size: bytes.len(),
        })
    }

    /// Settles the nets of a tick, as [`interpreter::settle`](super::interpreter::settle) does.
    ///
    /// Does nothing if the length of the slab is not that of the plan.
    pub fn settle(&self, slab: &mut [u64]) {
        self.run(slab, SETTLE, 1);
    }

    /// Makes the edge, as [`interpreter::edge`](super::interpreter::edge) does.
    pub fn edge(&self, slab: &mut [u64]) {
        self.run(slab, EDGE, 0);
    }

    /// Advances by up to `ticks` ticks, each an edge and a settling with constant input ports.
    /// Stops after the settling in which something watched changes. Returns the number of ticks.
    pub fn advance(&self, slab: &mut [u64], ticks: u64) -> u64 {
        match ticks {
            0 => 0,
            _ => ticks - self.run(slab, EDGE, ticks),
        }
    }

    /// Continues a replay up to its stop or its end, or until its rows are full.
    ///
    /// Does nothing if the slab or the replay is not of the plan.
    pub fn replay(&self, slab: &mut [u64], replay: &mut Replay<'_>) {
        let Some(shown) = replay.shown.table(self.words, self.marks) else {
            return;
        };
        if slab.len() != self.words || replay.is_at_stop() || replay.is_full() {
            return;
        }
        let changes = replay.changes.as_ptr_range();
        let (end, stop) = match replay.stop < replay.end {
            true => (replay.stop + 1, replay.stop + 1),
            false => (replay.end, NEVER),
        };
        let (phase, left, arrival) = match replay.settled {
            true => {
                let arrival = replay.held_until().min(end);
                (GO_ON, arrival - replay.tick - 1, arrival)
            }
            false => (ARRIVE, 0, replay.tick),
        };
        let room = replay.rows.len() - replay.row;
        let rows = replay.rows.as_mut_ptr();
        let mut tables = Tables {
            next: changes.start,
            last: changes.end,
            row: rows.wrapping_add(replay.used),
            last_row: rows.wrapping_add(room),
            shown: shown.as_ptr(),
            arrival,
            end,
            stop,
        };
        // SAFETY: see `call` for the slab. The tables belong to this call alone. The code reads
        // changes from `next` up to `last`, and bounds their ports. It reads `shown` at the numbers
        // of change marks, at the places found there, and the slab at the slots found there:
        // `Shown::table` says that all of them are within bounds, whatever stands in the slab. It
        // writes a row only if there is room for one with all entries: `is_full` was checked above
        // for the first row, and the code compares with `last_row` after each. An entry of `shown`
        // is in the list of one mark, and each mark is read once for a row, so that no entry is
        // written twice in it.
        let left = unsafe { self.call(slab, phase, left, &mut tables) };
        let words = (tables.row as usize).wrapping_sub(rows as usize) / size_of::<u64>();
        let made = (tables.next as usize).wrapping_sub(changes.start as usize);
        replay.used = words;
        replay.changes = replay
            .changes
            .get(made / size_of::<InputChange>()..)
            .unwrap_or_default();
        (replay.tick, replay.settled) = match left {
            ENDED => (tables.arrival, false),
            left => (tables.arrival - 1 - left, true),
        };
    }

    /// Returns the number of ticks left.
    fn run(&self, slab: &mut [u64], phase: u64, ticks: u64) -> u64 {
        if slab.len() != self.words {
            return ticks;
        }
        // SAFETY: the slab has the length of the plan, and there is no replay.
        unsafe { self.call(slab, phase, ticks, std::ptr::null_mut()) }
    }

    /// Calls the code.
    ///
    /// # Safety
    /// The slab has `words` words. `tables` is null in the phases `SETTLE` and `EDGE`; in the other
    /// phases, it and what it points to are valid.
    unsafe fn call(&self, slab: &mut [u64], phase: u64, ticks: u64, tables: *mut Tables) -> u64 {
        // SAFETY: the memory begins with a function that Cranelift made for this machine, with the
        // signature and the convention of `Entry`; it is executable and stays as it is as long as
        // `self` lives.
        let entry: Entry = unsafe { std::mem::transmute(self.memory.as_ptr()) };
        // SAFETY: without tables, the code reads and writes nothing but the slab, which is borrowed
        // for it alone: `Emitter` takes offsets below `layout.words` only, which the slab has, and
        // bounds every address of a memory, whatever stands in the slab. It keeps no state
        // elsewhere, so threads can run it at the same time. It calls nothing and cannot unwind. Its
        // frame is of `FRAME` bytes at most, and it touches each page of it in turn: a stack that is
        // too small ends at its guard page, as under any other function.
        unsafe { entry(slab.as_mut_ptr(), phase, ticks, tables) }
    }
}

impl fmt::Debug for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Code({} bytes for {} words)", self.size, self.words)
    }
}

/// Returns Cranelift's settings for this machine.
fn machine(single_pass: bool) -> Result<OwnedTargetIsa, CompileError> {
    let unknown = |error: &dyn fmt::Display| CompileError::Machine(error.to_string());
    let mut flags = settings::builder();
    for (name, value) in [
        ("opt_level", "speed"),
        ("enable_verifier", "false"),
        ("unwind_info", "false"),
        (
            "regalloc_algorithm",
            match single_pass {
                true => "single_pass",
                false => "backtracking",
            },
        ),
        // Probes inline; the other strategy makes calls.
        ("enable_probestack", "true"),
        ("probestack_strategy", "inline"),
    ] {
        flags.set(name, value).map_err(|error| unknown(&error))?;
    }
    cranelift_native::builder()
        .map_err(|error| unknown(&error))?
        .finish(Flags::new(flags))
        .map_err(|error| unknown(&error))
}

/// Copies bytes into executable memory.
fn executable(bytes: &[u8]) -> Result<Mmap, CompileError> {
    let mut memory = MmapMut::map_anon(bytes.len())?;
    memory.copy_from_slice(bytes);
    let memory = memory.make_exec()?;
    // SAFETY: the range is that of the mapping, which is alive.
    unsafe { coherence::clear_cache(memory.as_ptr().cast::<c_void>(), memory.len()) }
        .and_then(|()| coherence::pipeline_flush_mt())
        .map_err(|error| CompileError::Cranelift(error.to_string()))?;
    Ok(memory)
}
