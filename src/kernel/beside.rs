use super::{
    Circuit, Field, Make, Moment, Observer, Property, Role, RunError, Sample, Signals, Visit,
};
use crate::logic::{Logic, Sim};
use std::fmt;
use std::marker::PhantomData;
use std::ops::ControlFlow;

/// Signals that stand in the waves beside a circuit without being part of it: what a motor does,
/// say.
pub trait Beside: 'static {
    /// The scope they stand in.
    const SCOPE: &'static str;
    /// They.
    type Signals<L: Logic>: Signals<L>;
}

/// A circuit with signals beside it. They are inputs that it does not look at: whoever runs it
/// gives them with the inputs of a tick.
pub struct With<C, B> {
    /// The circuit.
    pub circuit: C,
    beside: PhantomData<fn() -> B>,
}

impl<C, B> With<C, B> {
    /// `circuit` with `B` beside it.
    pub fn new(circuit: C) -> Self {
        With {
            circuit,
            beside: PhantomData,
        }
    }
}

// Written out because a derive would ask the bundle itself to be `Clone` and `Debug`.
impl<C: Clone, B> Clone for With<C, B> {
    fn clone(&self) -> Self {
        With::new(self.circuit.clone())
    }
}

impl<C: fmt::Debug, B> fmt::Debug for With<C, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("With")
            .field("circuit", &self.circuit)
            .finish_non_exhaustive()
    }
}

/// The inputs of a circuit and the signals beside it.
pub struct WithIn<L: Logic, C: Circuit, B: Beside> {
    /// The circuit's inputs.
    pub i: C::In<L>,
    /// The signals beside it.
    pub beside: B::Signals<L>,
}

// Written out because a derive would ask circuit and bundle themselves to be `Clone` and `Debug`.
impl<L: Logic, C: Circuit, B: Beside> Clone for WithIn<L, C, B> {
    fn clone(&self) -> Self {
        WithIn {
            i: self.i.clone(),
            beside: self.beside.clone(),
        }
    }
}

impl<L: Logic, C: Circuit, B: Beside> fmt::Debug for WithIn<L, C, B> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME)
            .field("i", &self.i)
            .field(B::SCOPE, &self.beside)
            .finish()
    }
}

/// What holds of the scope of the signals beside a circuit.
const fn scope<B: Beside>() -> Field {
    Field {
        role: Some(Role::Input),
        ..Field::named(B::SCOPE)
    }
}

impl<L: Logic, C: Circuit, B: Beside> Signals<L> for WithIn<L, C, B> {
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        self.i.visit(field, visitor);
        self.beside.visit(const { &scope::<B>() }, visitor);
    }

    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        let i = C::In::make(field, maker);
        let beside = B::Signals::make(const { &scope::<B>() }, maker);
        WithIn { i, beside }
    }
}

impl<C: Circuit, B: Beside> Circuit for With<C, B> {
    const NAME: &'static str = C::NAME;
    const ABOUT: &'static str = C::ABOUT;
    type In<L: Logic> = WithIn<L, C, B>;
    type Reg<L: Logic> = C::Reg<L>;
    type Net<L: Logic> = C::Net<L>;

    fn comb<L: Logic>(&self, q: &C::Reg<L>, i: &WithIn<L, C, B>) -> C::Net<L> {
        self.circuit.comb(q, &i.i)
    }

    fn next<L: Logic>(&self, q: C::Reg<L>, w: &C::Net<L>, i: &WithIn<L, C, B>) -> C::Reg<L> {
        self.circuit.next(q, w, &i.i)
    }

    fn properties<L: Logic>(
        &self,
        now: &Moment<'_, Self, L>,
        next: &C::Reg<L>,
    ) -> Vec<Property<L>> {
        let Moment { i, q, w } = *now;
        self.circuit.properties(&Moment { i: &i.i, q, w }, next)
    }

    fn power_on(&self) -> C::Reg<Sim> {
        self.circuit.power_on()
    }
}

/// An observer of a circuit that sees it without what stands beside it.
#[derive(Debug)]
pub struct Without<O>(pub O);

impl<C: Circuit, B: Beside, O: Observer<C>> Observer<With<C, B>> for Without<O> {
    fn next_look(&self, tick: u64) -> u64 {
        self.0.next_look(tick)
    }

    fn needs_all(&self) -> bool {
        self.0.needs_all()
    }

    fn sample(&mut self, now: &Sample<'_, With<C, B>>) -> Result<ControlFlow<()>, RunError> {
        // Its ports in come first, and what stands beside it is among the ports in.
        Sample::show_without(now.tick, now.engine(), |now| self.0.sample(now))
    }
}
