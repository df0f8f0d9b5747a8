use super::FreeRunning;
use super::probe::{Source, supply};
use super::property::{Moment, Property};
use super::signals::{Extent, Field, Inside, Make, Role, Shape, Signals, Visit};
use crate::logic::{Logic, Sim};
use std::any::Any;
use std::fmt;
use std::hint::cold_path;
use std::mem::ManuallyDrop;
use std::process::abort;

/// A clocked circuit as two pure functions.
///
/// [`comb`](Circuit::comb) settles the nets from registers and inputs and cannot touch state;
/// [`next`](Circuit::next) makes all registers of the next tick at once. `&self` holds what is
/// fixed at elaboration: contents of memories, gains, the chosen variant. Widths are const
/// generics of the implementing type.
///
/// A circuit made of circuits keeps an [`Instance`] of each in its `Net` and the `Reg` of each in
/// its `Reg`, and only wires them.
pub trait Circuit: 'static {
    /// The circuit's name: the outermost scope of its waves, the module of its HDL.
    const NAME: &'static str;
    /// What it does, in one line.
    const ABOUT: &'static str;
    /// Ports in.
    type In<L: Logic>: Signals<L>;
    /// Flip-flops and memories.
    type Reg<L: Logic>: Signals<L>;
    /// Combinational nets.
    type Net<L: Logic>: Signals<L>;
    /// What goes on in it while it, or the circuit around it, coasts.
    ///
    /// Whoever overrides [`coasted`](Circuit::coasted) overrides it: waves do not look at the rest
    /// then, and its nets are not even computed. Checked as the gates are.
    const FREE_RUNNING: FreeRunning = FreeRunning::Nothing;

    /// The nets of this tick.
    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L>;

    /// The registers of the next tick.
    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, i: &Self::In<L>) -> Self::Reg<L>;

    /// A clock gate, if it has one: high where the edge would leave every register as it is, in
    /// every state that the circuit can reach. In the meanings [`Sim`] and
    /// [`Lanes`](crate::logic::Lanes) it is not clocked then; the HDL has no gate.
    ///
    /// Only speed depends on it, so a condition may leave ticks out, but none in which a register
    /// changes: [`reach`](crate::check::reach) and [`drive`](crate::check::drive()) find it.
    #[inline(always)]
    fn gated<L: Logic>(
        &self,
        q: &Self::Reg<L>,
        w: &Self::Net<L>,
        i: &Self::In<L>,
    ) -> Option<L::Bit> {
        let _ = (q, w, i);
        None
    }

    /// A gate for all but what goes on by itself, if it has one: high where the edge would do what
    /// [`coast`](Circuit::coast) does and no more, in every state that the circuit can reach. In the
    /// meanings [`Sim`] and [`Lanes`](crate::logic::Lanes) it coasts then.
    ///
    /// It is there for speed only, as [`gated`](Circuit::gated) is, and checked in the same way.
    #[inline(always)]
    fn coasting<L: Logic>(
        &self,
        q: &Self::Reg<L>,
        w: &Self::Net<L>,
        i: &Self::In<L>,
    ) -> Option<L::Bit> {
        let _ = (q, w, i);
        None
    }

    /// The registers after an edge in which the circuit is [`coasting`](Circuit::coasting): as they
    /// were, but for free-running counters and for serial units between two bits.
    #[inline(always)]
    fn coast<L: Logic>(&self, q: Self::Reg<L>) -> Self::Reg<L> {
        q
    }

    /// For how many ticks, this one included, it does no more than what goes on by itself, if the
    /// inputs stay as they are. It may be fewer than there are, never more: 0 where this edge does
    /// more, `u64::MAX` where nothing but an input ends it.
    ///
    /// Unless overridden it rests for ever where the clock is gated. A circuit made of circuits takes
    /// the [`least`](super::least) of theirs. [`fast_forward`](super::Simulator::fast_forward)
    /// depends on it; checked as the gates are.
    #[inline(always)]
    fn coasts_for(&self, q: &Self::Reg<Sim>, w: &Self::Net<Sim>, i: &Self::In<Sim>) -> u64 {
        match self.gated(q, w, i) {
            Some(gate) if gate.get() => u64::MAX,
            _ => 0,
        }
    }

    /// The registers after so many of these edges: as they are, unless overridden with
    /// [`coasts_for`](Circuit::coasts_for).
    #[inline(always)]
    fn coasted(&self, q: Self::Reg<Sim>, ticks: u64) -> Self::Reg<Sim> {
        let _ = ticks;
        q
    }

    /// Invariants in words, for proofs by other tools beside `check`; see
    /// [`Invariants::of`](crate::check::Invariants::of). What looks at the registers after the
    /// edge looks at `next`.
    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &Self::Reg<L>,
    ) -> Vec<Property<L>>
    where
        Self: Sized,
    {
        let _ = (now, next);
        Vec::new()
    }

    /// The registers at power-on: unless overridden, what `signals!` says, memories zero.
    ///
    /// A circuit with contents in a memory overrides it, and so does one that contains such a
    /// circuit.
    fn power_on(&self) -> Self::Reg<Sim> {
        struct PowerOn;
        impl Source for PowerOn {
            fn leaf(&mut self, field: &'static Field, _: Shape) -> u64 {
                field.power_on as u64
            }
        }
        supply(Role::Register, &mut PowerOn)
    }
}

/// The registers after an edge, where a value can be looked at: by its gates a circuit rests or
/// coasts.
#[inline(always)]
pub(crate) fn clocked<L: Logic, C: Circuit>(
    circuit: &C,
    q: C::Reg<L>,
    w: &C::Net<L>,
    i: &C::In<L>,
    high: impl Fn(L::Bit) -> bool,
) -> C::Reg<L> {
    match (circuit.coasting(&q, w, i), circuit.gated(&q, w, i)) {
        (None, None) => circuit.next(q, w, i),
        (Some(coasting), _) if high(coasting) => circuit.coast(q),
        (_, Some(gate)) if high(gate) => q,
        _ => {
            cold_path();
            // The nets once more: those that are read here only are computed here only.
            let w = circuit.comb(&q, i);
            circuit.next(q, &w, i)
        }
    }
}

/// The nets of a circuit, for whom a call more makes no difference: of a large circuit this is
/// the most code, so it is there once.
#[inline(never)]
pub(super) fn settled<C: Circuit>(circuit: &C, q: &C::Reg<Sim>, i: &C::In<Sim>) -> C::Net<Sim> {
    circuit.comb(q, i)
}

/// What cannot be. A panic would have to drop the registers, and for that they would stand in memory
/// all the time; of a function for C the compiler knows that it does not unwind.
#[cold]
extern "C" fn never() -> ! {
    abort()
}

/// A value as what it is, where a constant condition says so and the compiler does not see it.
#[inline(always)]
fn same<A: 'static, B: 'static>(value: A) -> B {
    // What is left is nothing: without a look whether it has to be dropped.
    let mut value = ManuallyDrop::new(Some(value));
    let it: &mut dyn Any = &mut *value;
    match it.downcast_mut::<Option<B>>().and_then(Option::take) {
        Some(value) => value,
        None => never(),
    }
}

/// Does something for arrays of each length. Written out: a loop or a closure would be handed the
/// registers through memory.
macro_rules! each {
    ($len:ident, $do:ident, $of:ty) => {{
        const { assert!($len <= 8, "an array has at most 8 circuits") };
        each!(@ $len, $do, $of, 0);
        each!(@ $len, $do, $of, 1 a 0);
        each!(@ $len, $do, $of, 2 a 0 b 1);
        each!(@ $len, $do, $of, 3 a 0 b 1 c 2);
        each!(@ $len, $do, $of, 4 a 0 b 1 c 2 d 3);
        each!(@ $len, $do, $of, 5 a 0 b 1 c 2 d 3 e 4);
        each!(@ $len, $do, $of, 6 a 0 b 1 c 2 d 3 e 4 f 5);
        each!(@ $len, $do, $of, 7 a 0 b 1 c 2 d 3 e 4 f 5 g 6);
        each!(@ $len, $do, $of, 8 a 0 b 1 c 2 d 3 e 4 f 5 g 6 h 7);
        never()
    }};
    (@ $len:ident, $do:ident, $of:ty, $count:literal $($name:ident $index:literal)*) => {
        if const { $len == $count } {
            return same::<[$of; $count], [$of; $len]>($do!($count $($name $index)*));
        }
    };
}

/// One circuit inside another: what goes into it and its nets, in one scope.
pub struct Instance<C: Circuit, L: Logic> {
    /// What the surrounding circuit applies to its ports in.
    pub i: C::In<L>,
    /// Its nets.
    pub w: C::Net<L>,
}

impl<C: Circuit, L: Logic> Instance<C, L> {
    /// Applies `i` and settles the nets.
    #[inline(always)]
    pub fn settle(circuit: &C, q: &C::Reg<L>, i: C::In<L>) -> Self {
        let w = L::settle(circuit, q, &i);
        Instance { i, w }
    }

    /// The registers of the next tick.
    #[inline(always)]
    pub fn next(&self, circuit: &C, q: C::Reg<L>) -> C::Reg<L> {
        L::clock(circuit, q, &self.w, &self.i)
    }

    /// High where its clock may be gated, low without a gate; see [`Circuit::gated`].
    #[inline(always)]
    pub fn gated(&self, circuit: &C, q: &C::Reg<L>) -> L::Bit {
        circuit.gated(q, &self.w, &self.i).unwrap_or(false.into())
    }

    /// High where it coasts, low without such a gate; see [`Circuit::coasting`].
    #[inline(always)]
    pub fn coasting(&self, circuit: &C, q: &C::Reg<L>) -> L::Bit {
        circuit
            .coasting(q, &self.w, &self.i)
            .unwrap_or(false.into())
    }

    /// The same for an array of circuits: applies `inputs` and settles the nets.
    #[inline(always)]
    pub fn settle_each<const K: usize>(
        circuits: &[C; K],
        q: &[C::Reg<L>; K],
        inputs: [C::In<L>; K],
    ) -> [Self; K] {
        macro_rules! settle {
            ($count:literal $($name:ident $index:literal)*) => {
                [$(Self::settle(&circuits[$index], &q[$index], inputs[$index].clone())),*]
            };
        }
        each!(K, settle, Self)
    }

    /// The registers of the next tick of an array of circuits.
    #[inline(always)]
    pub fn next_each<const K: usize>(
        each: &[Self; K],
        circuits: &[C; K],
        q: [C::Reg<L>; K],
    ) -> [C::Reg<L>; K] {
        macro_rules! clock {
            ($count:literal $($name:ident $index:literal)*) => {{
                let [$($name),*] = same::<[C::Reg<L>; K], [C::Reg<L>; $count]>(q);
                [$(each[$index].next(&circuits[$index], $name)),*]
            }};
        }
        each!(K, clock, C::Reg<L>)
    }
}

impl<C: Circuit> Instance<C, Sim> {
    /// For how many ticks it coasts; see [`Circuit::coasts_for`].
    #[inline(always)]
    pub fn coasts_for(&self, circuit: &C, q: &C::Reg<Sim>) -> u64 {
        circuit.coasts_for(q, &self.w, &self.i)
    }
}

// Written out because a derive would ask the circuit itself to be `Clone` and `Debug`.
impl<C: Circuit, L: Logic> Clone for Instance<C, L> {
    #[inline]
    fn clone(&self) -> Self {
        Instance {
            i: self.i.clone(),
            w: self.w.clone(),
        }
    }
}

impl<C: Circuit, L: Logic> fmt::Debug for Instance<C, L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME)
            .field("i", &self.i)
            .field("w", &self.w)
            .finish()
    }
}

impl<C: Circuit, L: Logic> Signals<L> for Instance<C, L> {
    const EXTENT: Extent = Extent {
        leaves: 0,
        instances: 1,
    }
    .and(C::In::<L>::EXTENT)
    .and(C::Net::<L>::EXTENT);

    #[inline(always)]
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.enter(field);
        let inside = const {
            Inside {
                ports: C::In::<L>::EXTENT,
                registers: C::Reg::<L>::EXTENT,
                nets: C::Net::<L>::EXTENT,
                free_running: C::FREE_RUNNING,
            }
        };
        if !visitor.passes_over(inside) {
            self.i.visit(const { &Field::part(Role::Input) }, visitor);
            if !visitor.rests(inside) {
                self.w.visit(const { &Field::part(Role::Net) }, visitor);
            }
        }
        visitor.leave();
    }

    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        maker.enter(field);
        let i = C::In::make(const { &Field::part(Role::Input) }, maker);
        let w = C::Net::make(const { &Field::part(Role::Net) }, maker);
        maker.leave();
        Instance { i, w }
    }
}
