//! Modules without registers, made of what circuits do in some ticks.

use super::Netlist;
use super::build::{builder, constant, elaboration};
use super::elaborate::{Whole, begin, end};
use super::leaves::Leaves;
use super::memory::State;
use super::module::{Design, NetlistError};
use super::nets::Nets;
use super::node::Id;
use super::walk::{Give, look, make};
use crate::kernel::{Field, Probe, Role, Shape, Signals, Words, show};
use crate::logic::Sim;

/// One module from the leaves of `I` to those of what `work` makes of them, with everything that
/// circuits do there in place of instances; nothing where `work` gives up.
pub(crate) fn combinational<I: Signals<Netlist>, O: Signals<Netlist>>(
    name: &'static str,
    work: impl FnOnce(&I) -> Option<O>,
) -> Option<Result<Design, Vec<NetlistError>>> {
    let whole = Whole::begin();
    elaboration(|elaboration| elaboration.in_place = true);
    begin(name, Vec::new());
    let made = work(&make(Role::Input, &mut Leaves::default()));
    let mut nets = Nets::default();
    if let Some(made) = &made {
        look(made, Role::Net, &mut nets);
    }
    let (_, settings) = end("", nets, Vec::new());
    let design = whole.end(settings);
    made.map(|_| design)
}

/// How many nodes the module being made has.
pub(crate) fn nodes() -> usize {
    builder(|builder| builder.nodes.len())
}

/// Makes a bundle of constants of one of numbers.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    words: Vec<u64>,
    memories: usize,
}

impl Constants {
    /// The numbers of a bundle; nothing where a memory is in it.
    pub(crate) fn of<S: Signals<Sim>>(signals: &S) -> Option<Self> {
        let mut constants = Constants::default();
        show(signals, Role::Register, &mut constants);
        (constants.memories == 0).then_some(constants)
    }

    /// The same bundle in the module being made.
    pub(crate) fn make<S: Signals<Netlist>>(self) -> S {
        make(Role::Register, &mut Given(self.words.into_iter()))
    }
}

impl Probe for Constants {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.words.push(bits);
    }
    fn memory(&mut self, _: &'static Field, _: &dyn Words) {
        self.memories += 1;
    }
}

struct Given(std::vec::IntoIter<u64>);

impl Give for Given {
    fn word(&mut self, _: &'static Field, shape: Shape) -> Id {
        constant(self.0.next().unwrap_or(0), shape)
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        _: usize,
        _: usize,
    ) -> (usize, State) {
        // `Constants::of` lets no memory through.
        (usize::MAX, State::Before)
    }
}
