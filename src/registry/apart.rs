use crate::kernel::Circuit;
use crate::logic::{Logic, Sim};

/// A circuit whose functions are compiled once, apart from whatever runs them.
///
/// Simulations inline a circuit for the sake of speed. What the catalogue runs need not be fast,
/// and there is much of it: inlined everywhere, the catalogue takes most of the time of a build.
pub struct Apart<'a, C>(pub &'a C);

impl<C: Circuit> Circuit for Apart<'_, C> {
    const NAME: &'static str = C::NAME;
    const ABOUT: &'static str = C::ABOUT;
    type In<L: Logic> = C::In<L>;
    type Reg<L: Logic> = C::Reg<L>;
    type Net<L: Logic> = C::Net<L>;

    #[inline(never)]
    fn comb<L: Logic>(&self, q: &C::Reg<L>, i: &C::In<L>) -> C::Net<L> {
        self.0.comb(q, i)
    }

    #[inline(never)]
    fn next<L: Logic>(&self, q: C::Reg<L>, w: &C::Net<L>, i: &C::In<L>) -> C::Reg<L> {
        self.0.next(q, w, i)
    }

    fn power_on(&self) -> C::Reg<Sim> {
        self.0.power_on()
    }
}
