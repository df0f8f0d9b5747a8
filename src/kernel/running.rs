use super::circuit::settled;
use super::pack::zero;
use super::probe::{Probe, Source, Words, show, supply};
use super::reset::reset;
use super::signals::{Field, Role, Shape, Signals};
use super::{Circuit, FreeRunning};
use crate::logic::Sim;

/// A circuit that is run tick by tick, its type forgotten.
///
/// What need not be fast works on this: it is compiled once, and not once for every circuit and
/// width of the catalogue. A new one stands at power-on with every port in at zero.
pub(crate) trait Running {
    /// The scope of the whole circuit.
    fn scope(&self) -> &'static Field;
    /// What goes on in it while it coasts.
    fn free_running(&self) -> FreeRunning;
    /// Applies the inputs of a tick and settles its nets.
    fn settle(&mut self, inputs: &mut dyn Source);
    /// Shows the ports in, the registers or the nets.
    fn part(&self, role: Role, probe: &mut dyn Probe);
    /// How the edge has to leave the registers: as they stand where the clock is
    /// [gated](Circuit::gated), coasted where it [coasts](Circuit::coasting); and where it
    /// [coasts for](Circuit::coasts_for) longer, how nothing changes but the leaves that run `free`.
    fn at_rest(&self, free: &[bool]) -> AtRest;
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
        let w = settled(circuit, &q, &i);
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

    fn free_running(&self) -> FreeRunning {
        C::FREE_RUNNING
    }

    fn settle(&mut self, inputs: &mut dyn Source) {
        self.i = supply(Role::Input, inputs);
        if let Some(q) = &self.q {
            self.w = settled(self.circuit, q, &self.i);
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

    // Plain branches: this is compiled for every circuit at every width.
    fn at_rest(&self, free: &[bool]) -> AtRest {
        let mut rest = AtRest::default();
        let (circuit, w, i) = (self.circuit, &self.w, &self.i);
        let Some(q) = &self.q else { return rest };
        if matches!(circuit.gated(q, w, i), Some(gate) if gate.get()) {
            rest.gated = Some(Standing::of(q));
        }
        if matches!(circuit.coasting(q, w, i), Some(gate) if gate.get()) {
            rest.coasting = Some(Standing::of(&circuit.coast(q.clone())));
        }
        if circuit.coasts_for(q, w, i) > 0 {
            let next = circuit.next(q.clone(), w, i);
            let same = |a: &_, b: &_| Standing::of::<C::Reg<Sim>>(a) == Standing::of(b);
            rest.fault = coasting_fault(circuit, q, w, i, &next, same, free);
        }
        rest
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

/// The flip-flops of a circuit, and for each memory how often it was written.
#[derive(PartialEq, Eq)]
struct Standing(Vec<u64>);

impl Standing {
    fn of<S: Signals<Sim>>(registers: &S) -> Self {
        let mut standing = Standing(Vec::new());
        show(registers, Role::Register, &mut standing);
        standing
    }

    fn of_all(running: &dyn Running) -> Self {
        let mut standing = Standing(Vec::new());
        running.part(Role::Register, &mut standing);
        standing
    }
}

/// The leaves that do not change while the circuit coasts, and of each memory how often it was
/// written.
#[derive(PartialEq, Eq)]
struct Fixed<'a> {
    free: &'a [bool],
    cursor: usize,
    values: Vec<u64>,
}

impl<'a> Fixed<'a> {
    fn of<C: Circuit>(free: &'a [bool], i: &C::In<Sim>, q: &C::Reg<Sim>, w: &C::Net<Sim>) -> Self {
        let mut fixed = Fixed {
            free,
            cursor: 0,
            values: Vec::new(),
        };
        show(i, Role::Input, &mut fixed);
        show(q, Role::Register, &mut fixed);
        show(w, Role::Net, &mut fixed);
        fixed
    }

    fn keep(&mut self, leaves: usize, value: u64) {
        if self.free.get(self.cursor) == Some(&false) {
            self.values.push(value);
        }
        self.cursor += leaves;
    }
}

impl Probe for Fixed<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.keep(1, bits);
    }
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let mut mark = 0;
        words.changed(&mut mark);
        self.keep(words.len(), mark);
    }
}

/// What the gates of a clock say of an edge.
#[derive(Default)]
pub(crate) struct AtRest {
    gated: Option<Standing>,
    coasting: Option<Standing>,
    fault: Option<&'static str>,
}

impl AtRest {
    /// What is wrong with them, after the edge.
    pub(crate) fn fault(&self, running: &dyn Running) -> Option<&'static str> {
        let wrong = |rest: &Option<Standing>| {
            let rest = rest.as_ref();
            rest.is_some_and(|rest| *rest != Standing::of_all(running))
        };
        if wrong(&self.gated) {
            Some(GATED)
        } else if wrong(&self.coasting) {
            Some(COASTING)
        } else {
            self.fault
        }
    }
}

/// A [gate](Circuit::gated) is wrong.
pub(crate) const GATED: &str = "a register changes where the clock is gated";
/// The [other gate](Circuit::coasting) is.
pub(crate) const COASTING: &str = "the registers are not as `coast` makes them where it coasts";

/// [`Circuit::FREE_RUNNING`] is.
const RUNS_FREE: &str = "what is not said to run free changes while it coasts";

/// [`Circuit::coasts_for`] or [`Circuit::coasted`] is.
const COASTS_FOR: &str = "it does not coast for as long as it says, or otherwise";

/// Edges of which [`Circuit::coasted`] is held against as many of one.
const MANY: u64 = 64;

/// What is wrong with for how long the circuit says that it coasts, or with what it says to go on
/// meanwhile, if the edge leads to `next`; by the leaf, what runs `free`. That it goes on for as long
/// is left to the next tick, of which it has to say so too.
pub(crate) fn coasting_fault<C: Circuit>(
    circuit: &C,
    q: &C::Reg<Sim>,
    w: &C::Net<Sim>,
    i: &C::In<Sim>,
    next: &C::Reg<Sim>,
    same: impl Fn(&C::Reg<Sim>, &C::Reg<Sim>) -> bool,
    free: &[bool],
) -> Option<&'static str> {
    let ticks = circuit.coasts_for(q, w, i);
    if ticks == 0 {
        return None;
    }
    let many = ticks.min(MANY);
    let coasted = |q: &C::Reg<Sim>, ticks| circuit.coasted(q.clone(), ticks);
    let then = settled(circuit, next, i);
    let still = circuit.coasts_for(next, &then, i);
    let right = still >= ticks - 1
        && same(&coasted(q, 1), next)
        && same(&coasted(q, many), &coasted(next, many - 1));
    if !right {
        return Some(COASTS_FOR);
    }
    let fixed = |q: &_, w: &_| Fixed::of::<C>(free, i, q, w);
    let rests = match C::FREE_RUNNING {
        FreeRunning::Nothing => same(q, next),
        FreeRunning::Parts => still == 0 || fixed(q, w) == fixed(next, &then),
        FreeRunning::All => true,
    };
    (!rests).then_some(RUNS_FREE)
}

impl Probe for Standing {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.0.push(bits);
    }
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let mut mark = 0;
        words.changed(&mut mark);
        self.0.push(mark);
    }
}

struct Given<'a>(std::slice::Iter<'a, u64>);

impl Source for Given<'_> {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        self.0.next().copied().unwrap_or(0)
    }
}
