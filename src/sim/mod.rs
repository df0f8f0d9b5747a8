//! The simulator: elaborated circuits, run tick by tick, and what observes their runs.
//!
//! A [`Model`] runs a circuit whose type is erased, and finds its signals by name. A
//! [`Simulator`] runs a circuit whose type is known. An [`Elaborated`] circuit has its type erased
//! too: waves, charts, Verilog and random runs work on it.

mod beside;
mod cost;
mod elaborated;
mod model;
mod observe;
mod ports;
mod recorded;
pub(crate) mod sample;
mod simulator;

pub use crate::engine::{InputChange, ReplayTick};
pub use beside::{Beside, Without};
pub use cost::Cost;
pub use elaborated::{Described, Elaborated};
pub(crate) use model::Tap;
pub use model::{Handle, Model, ModelError, PortDirection, SignalInfo, SignalRef, Snapshot};
pub(crate) use observe::at_fault;
pub use observe::{Each, Needs, Observer, RunError, StopWhen};
pub use recorded::{InputRecorder, Playback, RecordedInputs};
pub(crate) use sample::View as LeafView;
pub use sample::{Lazy, Sample, State};
pub use simulator::{Simulator, Watcher};
