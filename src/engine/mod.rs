//! Execution of circuits: a netlist is optimised, planned, and interpreted or compiled.

#[cfg(test)]
mod alike;
#[cfg(any(feature = "jit", test, all(feature = "wasm", target_family = "wasm")))]
mod codegen;
#[cfg(feature = "jit")]
#[allow(
    unsafe_code,
    reason = "machine code is made here and called; each block says why that is sound"
)]
mod compiler;
mod flat;
mod flatten;
mod input;
mod interpreter;
mod layout;
pub(crate) mod passes;
mod plan;
mod played;
mod prediction;
mod program;
#[cfg(test)]
pub(crate) mod random;
mod replay;
mod report;
mod run;
mod saved;
pub(crate) mod sliced;
#[cfg(test)]
mod tests;
mod tier;
#[cfg(not(any(feature = "jit", all(feature = "wasm", target_family = "wasm"))))]
mod uncompiled;
mod unroll;
mod value;
#[cfg(any(test, all(feature = "wasm", target_family = "wasm")))]
mod wasm;

pub use flat::EngineError;
pub(crate) use flat::{Flat, Id, Op, Place, Port};
pub(crate) use flatten::Statement;
pub use input::{InputChange, InputError};
pub(crate) use layout::{Spot, Watched};
pub use played::Inputs;
pub use program::Watch;
pub(crate) use program::{Program, ports_out};
pub(crate) use replay::Replay;
pub use replay::ReplayTick;
pub use report::report;
pub use run::Engine;
pub(crate) use saved::Saved;
