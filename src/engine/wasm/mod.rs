//! Backend for hosts of WebAssembly: encodes a plan as a module, which the host instantiates on the
//! memory of the program.
//!
//! The code has the same effect on the slab as the [interpreter](super::interpreter), except for
//! words that only the steps of a block use, and for the bits of hot blocks.

mod block;
mod emit;
mod flow;
#[cfg(all(feature = "wasm", target_family = "wasm"))]
#[allow(
    unsafe_code,
    reason = "a compiled module is called here; each block says why that is sound"
)]
mod host;
#[cfg(test)]
mod tests;

use super::plan::Plan;
#[cfg(all(feature = "wasm", target_family = "wasm"))]
pub use host::Code;
use wasm_encoder::{
    CodeSection, ConstExpr, EntityType, ExportKind, ExportSection, FunctionSection, GlobalSection,
    GlobalType, ImportSection, MemoryType, Module, TypeSection, ValType,
};

/// Reason why a plan cannot be compiled.
#[derive(Debug, thiserror::Error)]
pub enum CompileError {
    /// The host does not take the module.
    #[cfg(all(feature = "wasm", target_family = "wasm"))]
    #[error("the host compiles no circuits")]
    Host,
    /// The plan was not made by [`Plan::of`].
    #[error("a plan of which something stands outside of its slab")]
    Plan,
}

/// Number of words computed by a function of a long block.
const PART: usize = 1024;
/// Number of bytes from which on a function is ended. Hosts optimise one function at a time, in a
/// time that grows faster than its length.
const LONG: usize = 32 * 1024;

/// Phase that settles once.
const SETTLE: u32 = 0;
/// Phase that makes an edge, then alternates settlings and edges while ticks are left and nothing
/// watched has changed.
const EDGE: u32 = 1;

/// Name of the exported function, which takes the address of the slab, a phase and the number of
/// ticks, and returns the number of ticks left.
const RUN: &str = "run";

/// Type of the functions of blocks: they take the address of the slab.
const BLOCKS: u32 = 0;
/// Type of [`RUN`].
const ENTRY: u32 = 1;

/// Encodes a plan. Blocks that are `hot` run in every tick and are not woken; after a run of such
/// code, all blocks must be [woken](super::layout::Layout::wake) before another backend continues.
///
/// # Errors
/// Returns an error if an index in the plan is out of range.
fn encode(plan: &Plan, hot: &[bool], part: usize, long: usize) -> Result<Vec<u8>, CompileError> {
    let functions = flow::emit(plan, hot, part, long)?;
    let mut types = TypeSection::new();
    types.ty().function([ValType::I32], []);
    let entry = [ValType::I32, ValType::I32, ValType::I64];
    types.ty().function(entry, [ValType::I64]);
    let mut imports = ImportSection::new();
    let memory = MemoryType {
        minimum: 0,
        maximum: None,
        memory64: false,
        shared: false,
        page_size_log2: None,
    };
    imports.import("env", "memory", EntityType::Memory(memory));
    let (mut declared, mut code) = (FunctionSection::new(), CodeSection::new());
    for (kind, function) in &functions {
        declared.function(*kind);
        code.function(function);
    }
    let mut globals = GlobalSection::new();
    let due = GlobalType {
        val_type: ValType::I64,
        mutable: true,
        shared: false,
    };
    for _ in 0..plan.layout.block_words {
        globals.global(due, &ConstExpr::i64_const(0));
    }
    let mut exports = ExportSection::new();
    exports.export(RUN, ExportKind::Func, functions.len() as u32 - 1);
    let mut module = Module::new();
    module.section(&types).section(&imports).section(&declared);
    module.section(&globals).section(&exports).section(&code);
    Ok(module.finish())
}
