//! The language: circuits as plain structs, elaborated once to a netlist.
//!
//! A [`Circuit`] declares its signals as records ([`signals!`]), whose widths are expressions over
//! its fields. One function, [`tick`](Circuit::tick), gives the nets and the next values of the
//! registers. That function runs once, when the circuit is [elaborated](fn@elaborate). Its words
//! are handles to nodes of a netlist, so there is no `if` on a [`Bit`], only [`Bit::mux`]. The
//! netlist is the only meaning of a circuit: it is run, proved and printed as Verilog.
//!
//! Words wrap, as registers do. Operands have the same width; a constant takes the width of the
//! word beside it. All mistakes are found at once and reported with file, line and column
//! ([`Wrong`](crate::netlist::Wrong)).

mod build;
mod declare;
mod describe;
mod elaborate;
mod image;
mod keywords;
pub(crate) mod leaves;
mod macros;
#[doc(hidden)]
pub mod made;
mod memory;
pub(crate) mod mutation;
mod names;
pub(crate) mod outline;
pub(crate) mod pack;
pub(crate) mod part;
mod place;
mod property;
pub(crate) mod record;
mod values;
pub(crate) mod view;
mod words;

pub use crate::{hdl_choice as choice, hdl_records as records, hdl_signals as signals};
pub(crate) use declare::Outline;
pub use declare::{Declaration, Declarations, MemoryDeclaration, Path};
pub use elaborate::elaborate;
pub(crate) use elaborate::with_inputs;
pub use memory::{Contents, Image, Ram, Shift, Words, Written, ram, shift};
pub(crate) use memory::{STAGE, WORD};
pub use mutation::Mutation;
pub(crate) use outline::declarations;
pub use pack::inputs;
pub use part::{Opened, Part, Settled, settle_each};
pub use place::{At, MemoryAt, Number, Signals};
pub use property::{After, Moment, Property};
pub use record::{Cells, MemoryShape, Nothing, Pass, Record, Sink, Source, Walk};
pub use values::{Registers, Values};
pub use view::{Driven, Edge, Kept, Open, Place, Seen, Shapes, Value, View, Wire};
pub use words::{Bit, Choice, Cut, I, Operand, U, Word, log2};

use crate::netlist::{Role, Setting};
use std::fmt::Debug;

/// Clocked circuit; its fields are its widths, its variants, the contents of its memories.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no circuit",
    note = "a circuit is a struct with `#[derive(Debug, Clone)]`, records from `signals!`, and \
            `impl Circuit` with `NAME`, `ABOUT`, `records!(In, Reg, Net)` and `fn tick`"
)]
pub trait Circuit: Clone + Debug + Send + Sync + 'static {
    /// Name of the circuit: the outermost scope of its waves, and its Verilog module.
    const NAME: &'static str;
    /// One-line description.
    const ABOUT: &'static str;
    /// Input ports.
    type In<V: View>: Record<Self, V>;
    /// Flip-flops and memories.
    type Reg<V: View>: Record<Self, V>;
    /// Nets; `pub` nets and `pub` registers are the output ports.
    type Net<V: View>: Record<Self, V>;
    /// Circuits inside.
    type Parts<V: View>: Record<Self, V>;

    /// Computes the nets of this tick and the registers of the next.
    fn tick(
        &self,
        i: Self::In<Wire>,
        q: Self::Reg<Wire>,
        p: Self::Parts<Wire>,
    ) -> (Self::Net<Wire>, Self::Reg<Edge>);

    /// Returns the name, if it depends on the fields.
    fn name(&self) -> &'static str {
        Self::NAME
    }

    /// Returns the one-line description, if it depends on the fields.
    fn about(&self) -> &'static str {
        Self::ABOUT
    }

    /// Returns invariants written in words, for `check` and for other proof tools. An invariant
    /// over an edge reads the registers after it in [`Moment::next`].
    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let _ = now;
        Vec::new()
    }

    /// Returns an objection to the fields in one sentence, beyond the checks of word widths.
    fn objection(&self) -> Option<String> {
        None
    }

    // Written by `records!`; see `made`.
    #[doc(hidden)]
    fn make_module(&self, path: String, more: More<'_>) -> (usize, Vec<Setting>);
    #[doc(hidden)]
    fn make_shapes(&self, role: Role, source: &mut dyn Source);
    #[doc(hidden)]
    fn make_places(&self, source: &mut dyn Source) -> Signals<Self>;
    #[doc(hidden)]
    fn make_inputs(&self, source: &mut dyn Source) -> Self::In<Value>;
    #[doc(hidden)]
    fn make_registers(&self, source: &mut dyn Source) -> Self::Reg<Value>;
    #[doc(hidden)]
    fn make_nets(&self, source: &mut dyn Source) -> Self::Net<Value>;
    #[doc(hidden)]
    fn make_parts(&self, source: &mut dyn Source) -> Self::Parts<Value>;
    #[doc(hidden)]
    fn make_kept(&self, source: &mut dyn Source) -> Registers<Self>;
}

/// Shows input ports that the circuit itself does not read.
#[doc(hidden)]
pub type More<'a> = &'a mut dyn FnMut(&mut dyn Source);

/// Returns input ports with all bits low.
pub fn zero<C: Circuit>(circuit: &C) -> C::In<Value> {
    pack::inputs(circuit, |_| 0)
}
