//! What every circuit gets for free: signals that can be walked, the circuit as two pure
//! functions, and the simulator with its observers.

mod beside;
mod circuit;
mod declare;
mod macros;
mod observe;
mod pack;
mod probe;
mod property;
mod reset;
mod running;
mod signals;
mod simulator;
#[cfg(test)]
mod tests;

pub use beside::{Beside, With, WithIn, Without};
pub use circuit::{Circuit, Instance};
pub use declare::{Declaration, Declarations, MemoryDeclaration, Path};
pub use observe::{Observer, RunError, Sample, StopWhen};
pub use pack::{Bits, pack, unpack, width, zero};
pub use probe::{Changed, Probe, Source, Words};
pub(crate) use probe::{STAGE, WORD, part};
pub use property::{Moment, Property};
pub(crate) use running::{Machine, Running, Values, show_power_on};
pub use signals::{Field, Format, Kind, Make, Nothing, Role, Shape, Signals, Visit};
pub use simulator::Simulator;
