use crate::kernel::{Circuit, Field, Make, Signals, Visit};
use crate::logic::{Logic, Sim};
use std::fmt;
use std::marker::PhantomData;

/// A circuit with the ports in of another.
///
/// Every circuit has its own. For two circuits whose `In` is one struct the function gives back
/// what it is given:
///
/// ```
/// # use motion_rtl::{check::{Lockstep, Pair, SamePorts}, kernel::{Circuit, Nothing}};
/// # use motion_rtl::{logic::Logic, signals};
/// signals! { pub struct In<L> { pub a: L::Bit, pub b: L::Bit } }
/// signals! { pub struct Net<L> { pub both: L::Bit } }
/// # struct And;
/// # struct Nor;
/// # impl Circuit for And {
/// #     const NAME: &'static str = "and";
/// #     const ABOUT: &'static str = "a and b";
/// #     type In<L: Logic> = In<L>;
/// #     type Reg<L: Logic> = Nothing<L>;
/// #     type Net<L: Logic> = Net<L>;
/// #     fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L>) -> Net<L> {
/// #         Net { both: i.a & i.b }
/// #     }
/// #     fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L>, _: &In<L>) -> Nothing<L> { q }
/// # }
/// # impl Circuit for Nor {
/// #     const NAME: &'static str = "nor";
/// #     const ABOUT: &'static str = "not (not a or not b)";
/// #     type In<L: Logic> = In<L>;
/// #     type Reg<L: Logic> = Nothing<L>;
/// #     type Net<L: Logic> = Net<L>;
/// #     fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L>) -> Net<L> {
/// #         Net { both: !(!i.a | !i.b) }
/// #     }
/// #     fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L>, _: &In<L>) -> Nothing<L> { q }
/// # }
///
/// impl SamePorts<And> for Nor {
///     fn ports<L: Logic>(i: &In<L>) -> &In<L> {
///         i
///     }
/// }
///
/// let lockstep = Lockstep::by_name(&Pair { left: And, right: Nor })?;
/// assert_eq!(lockstep.to_string(), "and.both = nor.both");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Circuits with other ports are no [`Circuit`] side by side:
///
/// ```compile_fail,E0277
/// # use motion_rtl::check::Pair;
/// # use motion_rtl::kernel::Circuit;
/// # use motion_rtl::pulse_interpolator::{SyncStage, UnitTimeCounter};
/// fn simulate<C: Circuit>(_: &C) {}
/// simulate(&Pair { left: UnitTimeCounter::<4>, right: SyncStage });
/// ```
// A bound would say so only for one meaning of the words: it cannot quantify over types.
pub trait SamePorts<A: Circuit>: Circuit {
    /// The ports in of `A` as the circuit's own.
    fn ports<L: Logic>(i: &A::In<L>) -> &Self::In<L>;
}

impl<A: Circuit> SamePorts<A> for A {
    fn ports<L: Logic>(i: &A::In<L>) -> &A::In<L> {
        i
    }
}

/// Two circuits side by side on the same inputs.
///
/// Each stands in a scope of its own name or, where both have the same name, in `left` and
/// `right`.
#[derive(Debug, Clone, Copy)]
pub struct Pair<A, B> {
    /// The one.
    pub left: A,
    /// The other.
    pub right: B,
}

impl<A: Circuit, B: Circuit> Pair<A, B> {
    /// The scope of the left circuit.
    pub const LEFT: &'static str = if same(A::NAME, B::NAME) {
        "left"
    } else {
        A::NAME
    };
    /// The scope of the right circuit.
    pub const RIGHT: &'static str = if same(A::NAME, B::NAME) {
        "right"
    } else {
        B::NAME
    };
}

/// `==` on strings is not yet `const`.
const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut index = 0;
    while index < a.len() {
        if a[index] != b[index] {
            return false;
        }
        index += 1;
    }
    true
}

/// The registers or the nets of the two circuits of a [`Pair`].
pub struct Sides<A, B, T, U> {
    /// Those of the left circuit.
    pub left: T,
    /// Those of the right circuit.
    pub right: U,
    pair: PhantomData<fn() -> Pair<A, B>>,
}

impl<A, B, T, U> Sides<A, B, T, U> {
    fn new(left: T, right: U) -> Self {
        Sides {
            left,
            right,
            pair: PhantomData,
        }
    }
}

impl<A, B, T: Clone, U: Clone> Clone for Sides<A, B, T, U> {
    fn clone(&self) -> Self {
        Sides::new(self.left.clone(), self.right.clone())
    }
}

impl<A, B, T: fmt::Debug, U: fmt::Debug> fmt::Debug for Sides<A, B, T, U> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sides")
            .field("left", &self.left)
            .field("right", &self.right)
            .finish()
    }
}

impl<A, B, L, T, U> Signals<L> for Sides<A, B, T, U>
where
    A: Circuit,
    B: Circuit,
    L: Logic,
    T: Signals<L>,
    U: Signals<L>,
{
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.enter(field);
        self.left
            .visit(const { &Field::named(Pair::<A, B>::LEFT) }, visitor);
        self.right
            .visit(const { &Field::named(Pair::<A, B>::RIGHT) }, visitor);
        visitor.leave();
    }

    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        maker.enter(field);
        let left = T::make(const { &Field::named(Pair::<A, B>::LEFT) }, maker);
        let right = U::make(const { &Field::named(Pair::<A, B>::RIGHT) }, maker);
        maker.leave();
        Sides::new(left, right)
    }
}

impl<A: Circuit, B: SamePorts<A>> Circuit for Pair<A, B> {
    const NAME: &'static str = "pair";
    const ABOUT: &'static str = "two circuits side by side on the same inputs";
    type In<L: Logic> = A::In<L>;
    type Reg<L: Logic> = Sides<A, B, A::Reg<L>, B::Reg<L>>;
    type Net<L: Logic> = Sides<A, B, A::Net<L>, B::Net<L>>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let left = self.left.comb(&q.left, i);
        let right = self.right.comb(&q.right, B::ports(i));
        Sides::new(left, right)
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, i: &Self::In<L>) -> Self::Reg<L> {
        let left = self.left.next(q.left, &w.left, i);
        let right = self.right.next(q.right, &w.right, B::ports(i));
        Sides::new(left, right)
    }

    fn power_on(&self) -> Self::Reg<Sim> {
        Sides::new(self.left.power_on(), self.right.power_on())
    }
}
