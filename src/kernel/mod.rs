//! What every circuit gets for free: signals that can be walked, the circuit as two pure
//! functions, and the simulator with its observers.

mod beside;
mod circuit;
mod declare;
mod fast_forward;
mod macros;
mod observe;
mod pack;
mod ports;
mod probe;
mod property;
mod reset;
mod running;
mod signals;
mod simulator;
#[cfg(test)]
mod tests;

pub use beside::{Beside, With, WithIn, Without};
pub(crate) use circuit::clocked;
pub use circuit::{Circuit, Instance};
pub use declare::{Declaration, Declarations, InstanceDeclaration, MemoryDeclaration, Path};
pub use fast_forward::{FastForward, FreeRunning, least, ticks_below};
pub use observe::{Observer, RunError, Sample, StopWhen};
pub use pack::{Bits, pack, unpack, width, zero};
pub use probe::{Changed, Probe, Source, Words};
pub(crate) use probe::{STAGE, WORD, part};
pub use property::{Moment, Property};
pub(crate) use running::{
    COASTING, GATED, Machine, Running, Values, coasting_fault, show_power_on,
};
pub use signals::{
    Extent, Field, Format, Inside, Kind, Make, Nothing, Role, Shape, Signals, Visit,
};
pub use simulator::Simulator;
