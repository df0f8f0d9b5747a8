use super::Circuit;
use super::pack::zero;
use super::probe::{Probe, Source, show, supply};
use super::reset::reset;
use super::signals::{Field, Role, Shape, Signals};
use crate::logic::Sim;

/// A circuit that is run tick by tick, its type forgotten.
///
/// What need not be fast works on this: it is compiled once, and not once for every circuit and
/// width of the catalogue. A new one stands at power-on with every port in at zero.
pub(crate) trait Running {
    /// The scope of the whole circuit.
    fn scope(&self) -> &'static Field;
    /// Applies the inputs of a tick and settles its nets.
    fn settle(&mut self, inputs: &mut dyn Source);
    /// Shows the ports in, the registers or the nets.
    fn part(&self, role: Role, probe: &mut dyn Probe);
    /// The edge that ends the tick; with `rst` high that of a synchronous reset.
    fn clock(&mut self, rst: bool);
}

impl dyn Running + '_ {
    /// The circuit's name.
    pub(crate) fn name(&self) -> &'static str {
        self.scope().name
    }

    /// Shows all signals, in the order of [`Sample::visit`](super::Sample::visit).
    pub(crate) fn show(&self, probe: &mut dyn Probe) {
        probe.enter(self.scope());
        for role in [Role::Input, Role::Register, Role::Net] {
            self.part(role, probe);
        }
        probe.leave();
    }
}

/// The one implementation.
pub(crate) struct Machine<'c, C: Circuit> {
    circuit: &'c C,
    i: C::In<Sim>,
    /// Away only while an edge makes the next ones.
    q: Option<C::Reg<Sim>>,
    w: C::Net<Sim>,
}

impl<'c, C: Circuit> Machine<'c, C> {
    pub(crate) fn new(circuit: &'c C) -> Self {
        let i = zero();
        let q = circuit.power_on();
        let w = circuit.comb(&q, &i);
        Machine {
            circuit,
            i,
            q: Some(q),
            w,
        }
    }
}

impl<C: Circuit> Running for Machine<'_, C> {
    fn scope(&self) -> &'static Field {
        const { &Field::named(C::NAME) }
    }

    fn settle(&mut self, inputs: &mut dyn Source) {
        self.i = supply(Role::Input, inputs);
        if let Some(q) = &self.q {
            self.w = self.circuit.comb(q, &self.i);
        }
    }

    fn part(&self, role: Role, probe: &mut dyn Probe) {
        match (role, &self.q) {
            (Role::Input, _) => show(&self.i, role, probe),
            (Role::Net, _) => show(&self.w, role, probe),
            (Role::Register, Some(q)) => show(q, role, probe),
            (Role::Register, None) => {}
        }
    }

    fn clock(&mut self, rst: bool) {
        if let Some(q) = self.q.take() {
            let q = self.circuit.next(q, &self.w, &self.i);
            self.q = Some(match rst {
                true => reset(self.circuit, &q),
                false => q,
            });
        }
    }
}

/// Shows the registers at power-on.
pub(crate) fn show_power_on<C: Circuit>(circuit: &C, probe: &mut dyn Probe) {
    show(&circuit.power_on(), Role::Register, probe);
}

/// The words of a walk, in its order.
#[derive(Default)]
pub(crate) struct Values(pub(crate) Vec<u64>);

impl Values {
    /// Those of ports in.
    pub(crate) fn of<S: Signals<Sim>>(signals: &S) -> Self {
        let mut values = Values::default();
        show(signals, Role::Input, &mut values);
        values
    }

    /// Gives them to the same ports.
    pub(crate) fn source(&self) -> impl Source {
        Given(self.0.iter())
    }
}

impl Probe for Values {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.0.push(bits);
    }
}

struct Given<'a>(std::slice::Iter<'a, u64>);

impl Source for Given<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        self.0.next().copied().unwrap_or(0)
    }
}
