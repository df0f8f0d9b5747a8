use super::probe::{Source, supply};
use super::property::{Moment, Property};
use super::signals::{Field, Make, Role, Shape, Signals, Visit};
use crate::logic::{Logic, Sim};
use std::array::from_fn;
use std::fmt;

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

    /// The nets of this tick.
    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L>;

    /// The registers of the next tick.
    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, i: &Self::In<L>) -> Self::Reg<L>;

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

/// One circuit inside another: what goes into it and its nets, in one scope.
pub struct Instance<C: Circuit, L: Logic> {
    /// What the surrounding circuit applies to its ports in.
    pub i: C::In<L>,
    /// Its nets.
    pub w: C::Net<L>,
}

impl<C: Circuit, L: Logic> Instance<C, L> {
    /// Applies `i` and settles the nets.
    pub fn settle(circuit: &C, q: &C::Reg<L>, i: C::In<L>) -> Self {
        let w = L::settle(circuit, q, &i);
        Instance { i, w }
    }

    /// The registers of the next tick.
    pub fn next(&self, circuit: &C, q: C::Reg<L>) -> C::Reg<L> {
        L::clock(circuit, q, &self.w, &self.i)
    }

    /// Applies `inputs` to an array of circuits and settles their nets.
    pub fn settle_each<const K: usize>(
        circuits: &[C; K],
        q: &[C::Reg<L>; K],
        inputs: [C::In<L>; K],
    ) -> [Self; K] {
        from_fn(|k| Self::settle(&circuits[k], &q[k], inputs[k].clone()))
    }

    /// The registers of the next tick of an array of circuits.
    pub fn next_each<const K: usize>(
        each: &[Self; K],
        circuits: &[C; K],
        q: [C::Reg<L>; K],
    ) -> [C::Reg<L>; K] {
        let mut k = 0;
        q.map(|q| {
            let next = each[k].next(&circuits[k], q);
            k += 1;
            next
        })
    }
}

// Written out because a derive would ask the circuit itself to be `Clone` and `Debug`.
impl<C: Circuit, L: Logic> Clone for Instance<C, L> {
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
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.enter(field);
        self.i.visit(const { &Field::part(Role::Input) }, visitor);
        self.w.visit(const { &Field::part(Role::Net) }, visitor);
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
