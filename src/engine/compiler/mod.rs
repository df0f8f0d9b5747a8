//! The fast backend: a plan becomes machine code, by [Cranelift](https://cranelift.dev).
//!
//! The code does what the [interpreter](super::interpreter) does, to the same slab. What is in line
//! of it, and whether a block has a bit, is up to who compiles: see [`Code::compile`].

mod block;
mod emit;
mod flow;
mod runs;
#[cfg(test)]
mod tests;

use super::plan::Plan;
use cranelift_codegen::Context;
use cranelift_codegen::control::ControlPlane;
use cranelift_codegen::ir::{AbiParam, Signature, types};
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_codegen::settings::{self, Configurable, Flags};
use memmap2::{Mmap, MmapMut};
use std::ffi::c_void;
use std::fmt;
use wasmtime_internal_jit_icache_coherence as coherence;

/// The code of a plan.
pub struct Code {
    memory: Mmap,
    /// How many words a slab has.
    words: usize,
    size: usize,
}

/// Why there is no code.
#[derive(Debug, thiserror::Error)]
pub enum CompileError {
    /// Cranelift makes no code for this machine.
    #[error("no compiler for this machine: {0}")]
    Machine(String),
    /// The system gives no memory in which code can run.
    #[error("no memory for code")]
    Memory(#[from] std::io::Error),
    /// Cranelift did not get through it.
    #[error("compiler: {0}")]
    Cranelift(String),
    /// The code would ask for so many bytes of the stack.
    #[error("the circuit is so large that its code takes {0} bytes of the stack, allowed: {FRAME}")]
    Frame(u32),
    /// It is not what [`Plan::of`] makes.
    #[error("a plan of which something stands outside of its slab")]
    Plan,
}

/// What is to be done: `slab`, phase, ticks; gives how many ticks are left.
type Entry = unsafe extern "C" fn(*mut u64, u64, u64) -> u64;

/// How many words a part of a block makes: as many may be alive at once, and the compiler's time goes
/// by their square.
const PART: usize = 128;
/// With more steps the registers of the machine are allocated in a single pass: the time of the other
/// way grows faster than their number.
const MANY: usize = 8_000;
/// Bytes of the stack that code may take: a quarter of what a thread has.
const FRAME: u32 = 512 * 1024;

/// Settles once.
const SETTLE: u64 = 0;
/// An edge, and while ticks are left a settling and the next.
const EDGE: u64 = 1;

impl Code {
    /// Compiles a plan.
    ///
    /// Blocks that are `hot` run in every tick, whether woken or not, and are not woken: behind a run
    /// of such code all blocks are to be [woken](super::layout::Layout::wake) before another backend
    /// goes on. Everything else in the slab is as the interpreter leaves it, but for the words that
    /// only the steps of a block use.
    ///
    /// # Errors
    /// There is no compiler for this machine, or no memory, or the code takes too much of the stack, or
    /// the plan is not whole.
    pub fn compile(plan: &Plan, hot: &[bool]) -> Result<Code, CompileError> {
        let steps: usize = plan.blocks.iter().map(|block| block.steps.len()).sum();
        Self::in_parts(plan, hot, PART, steps > MANY)
    }

    /// Blocks are compiled in parts of so many words, the registers of the machine allocated in a
    /// single pass or with more care.
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
            params: vec![word(), word(), word()],
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
            size: bytes.len(),
        })
    }

    /// Settles the nets of a tick, as [`interpreter::settle`](super::interpreter::settle) does.
    ///
    /// Nothing is done to a slab of another plan's length.
    pub fn settle(&self, slab: &mut [u64]) {
        self.run(slab, SETTLE, 1);
    }

    /// Makes the edge, as [`interpreter::edge`](super::interpreter::edge) does.
    pub fn edge(&self, slab: &mut [u64]) {
        self.run(slab, EDGE, 0);
    }

    /// Goes on by `ticks`, each an edge and a settling with the ports in as they are; fewer if
    /// something watched changes: then it ends behind that settling. Gives how many ticks it went.
    pub fn advance(&self, slab: &mut [u64], ticks: u64) -> u64 {
        match ticks {
            0 => 0,
            _ => ticks - self.run(slab, EDGE, ticks),
        }
    }

    /// Gives how many of the ticks are left.
    fn run(&self, slab: &mut [u64], phase: u64, ticks: u64) -> u64 {
        if slab.len() != self.words {
            return ticks;
        }
        // SAFETY: the memory begins with a function that Cranelift made for this machine, with the
        // signature and the convention of `Entry`; it is executable and stays as it is as long as
        // `self` lives.
        let entry: Entry = unsafe { std::mem::transmute(self.memory.as_ptr()) };
        // SAFETY: the code reads and writes nothing but the slab, which is borrowed for it alone:
        // `Emitter` takes offsets below `layout.words` only, which the slab has as checked above,
        // and bounds every address of a memory, whatever stands in the slab. It keeps no state
        // elsewhere, so threads can run it at the same time. It calls nothing and cannot unwind. Its
        // frame is of `FRAME` bytes at most, and it touches each page of it in turn: a stack that is
        // too small ends at its guard page, as under any other function.
        unsafe { entry(slab.as_mut_ptr(), phase, ticks) }
    }
}

impl fmt::Debug for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Code({} bytes for {} words)", self.size, self.words)
    }
}

/// What Cranelift knows of this machine.
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
        // Without the calls of the other strategy.
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

/// The same bytes where they can run.
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
