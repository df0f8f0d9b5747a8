//! What every circuit gets for free: signals that can be walked, the circuit as two pure
//! functions, and the simulator with its observers.

mod beside;
mod circuit;
mod declare;
mod macros;
mod model;
mod observe;
mod pack;
mod probe;
mod property;
mod sample;
mod signals;
mod simulator;
#[cfg(test)]
mod tests;

pub use beside::{Beside, With, WithIn, Without};
pub use circuit::{Circuit, Instance};
pub(crate) use declare::Outline;
pub use declare::{Declaration, Declarations, MemoryDeclaration, Path};
pub use model::Model;
pub use observe::{Observer, RunError, StopWhen};
pub use pack::{Bits, pack, unpack, width, widths, words, zero};
pub use probe::{Probe, Source, Words};
pub(crate) use probe::{STAGE, WORD, part, show};
pub use property::{Moment, Property};
pub use sample::{At, Part, Place, Sample, Word};
pub(crate) use sample::{View, record};
pub use signals::{Field, Format, Kind, Make, Nothing, Role, Shape, Signals, Visit};
pub use simulator::{Registers, Simulator, Watcher};
