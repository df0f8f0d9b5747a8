//! Every operation of signed words, without registers.

use motion_rtl::kernel::{Circuit, Nothing};
use motion_rtl::logic::{Bit, Logic, Signed, Unsigned};
use motion_rtl::signals;

signals! {
    /// Ports in.
    pub struct In<L, const N: usize, const K: usize> {
        pub a: L::I<N>,
        pub b: L::I<N>,
        pub c: L::I<K>,
        pub left: L::Bit,
        pub right: L::Bit,
    }
}

signals! {
    /// A net per operation.
    pub struct Net<L, const N: usize, const K: usize, const P: usize> {
        pub sum: L::I<N>,
        pub difference: L::I<N>,
        pub negated: L::I<N>,
        pub a_below_b: L::Bit,
        pub a_equals_b: L::Bit,
        pub a_negative: L::Bit,
        pub sum_negative: L::Bit,
        pub b_zero: L::Bit,
        pub c_resized: L::I<N>,
        pub a_resized: L::I<K>,
        pub sum_resized: L::I<K>,
        pub minus_a_resized: L::I<K>,
        pub choice_resized: L::I<K>,
        pub shift_resized: L::I<K>,
        pub product_resized: L::I<K>,
        pub bits_resized: L::U<K>,
        pub product: L::I<P>,
        pub swapped: L::I<P>,
        pub square: L::I<N>,
        pub times_constant: L::I<P>,
        pub up_one: L::I<N>,
        pub up_last: L::I<N>,
        pub up_over: L::I<N>,
        pub down_none: L::I<N>,
        pub down_one: L::I<N>,
        pub down_last: L::I<N>,
        pub down_over: L::I<N>,
        pub sum_down: L::I<N>,
        pub down_sum: L::I<N>,
        pub size: L::U<N>,
        pub size_of_sum: L::U<N>,
        pub size_of_least: L::U<N>,
        pub raw: L::U<N>,
        pub raw_sum: L::U<N>,
        pub again: L::I<N>,
        pub least: L::I<N>,
        pub greatest: L::I<N>,
        pub minus_one: L::I<N>,
        pub plus_greatest: L::I<N>,
        pub minus_least: L::I<N>,
        pub above_least: L::Bit,
        pub below_minus_one: L::Bit,
        pub least_or: L::I<N>,
        pub nested: L::I<N>,
        pub both_nested: L::I<N>,
        pub chain_left: L::I<N>,
        pub chain_right: L::I<N>,
        pub minus_of_sum: L::I<N>,
        pub twice_negated: L::I<N>,
        pub sums_equal: L::Bit,
        pub sums_below: L::Bit,
        pub raw_below: L::Bit,
    }
}

/// Words of `N` bits against words of `K` bits, products of `P` bits.
#[derive(Debug)]
pub struct SignedWords<const N: usize, const K: usize, const P: usize>;

impl<const N: usize, const K: usize, const P: usize> Circuit for SignedWords<N, K, P> {
    const NAME: &'static str = "signed_words";
    const ABOUT: &'static str = "every operation of signed words";
    type In<L: Logic> = In<L, N, K>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Net<L, N, K, P>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &In<L, N, K>) -> Net<L, N, K, P> {
        let In {
            a,
            b,
            c,
            left,
            right,
        } = i.clone();
        let least: L::I<N> = (i64::MIN >> (64 - N)).into();
        let greatest: L::I<N> = (i64::MAX >> (64 - N)).into();
        let minus_one: L::I<N> = (-1).into();
        let sum = a + b;
        let inner = right.mux(a - b, right.mux(b, least));
        Net {
            sum,
            difference: a - b,
            negated: -a,
            a_below_b: a.below(b),
            a_equals_b: a.equals(b),
            a_negative: a.is_negative(),
            sum_negative: (a + c.resize()).is_negative(),
            b_zero: b.is_zero(),
            c_resized: c.resize(),
            a_resized: a.resize(),
            sum_resized: (a + b + 1).resize(),
            minus_a_resized: (-b).resize(),
            choice_resized: left.mux(a + b, -b).resize(),
            shift_resized: (a - b).shift_right(N / 2).resize(),
            product_resized: a.times::<N, N>(b).resize(),
            bits_resized: (a - b).unsigned().resize(),
            product: a.times::<K, P>(c),
            swapped: c.times::<N, P>(a + b),
            square: a.times::<N, N>(a),
            times_constant: a.times::<K, P>((-3).into()),
            up_one: a.shift_left(1),
            up_last: a.shift_left(N - 1),
            up_over: a.shift_left(N),
            down_none: a.shift_right(0),
            down_one: a.shift_right(1),
            down_last: a.shift_right(N - 1),
            down_over: a.shift_right(N + 7),
            sum_down: (a + b).shift_right(1),
            down_sum: a.shift_right(1) + b.shift_right(1),
            size: a.magnitude(),
            size_of_sum: (b - a + 1).magnitude(),
            size_of_least: least.magnitude(),
            raw: a.unsigned(),
            raw_sum: (a - 1).unsigned() + b.unsigned(),
            again: b.unsigned().signed(),
            least,
            greatest,
            minus_one,
            plus_greatest: a + (i64::MAX >> (64 - N)),
            minus_least: a - least,
            above_least: least.below(a),
            below_minus_one: a.below(minus_one),
            least_or: left.mux(least, greatest),
            nested: left.mux(right.mux(a, b), -a),
            both_nested: left.mux(inner, (left & !right).mux(inner + 1, right.mux(-b, inner))),
            chain_left: (a - b) - (b - a) - 1,
            chain_right: a - (b - (a - (b + 1))),
            minus_of_sum: -(a + b) - -b,
            twice_negated: -(-a),
            sums_equal: (a + 1).equals(b - 1),
            sums_below: (a + 1).below(b - 1),
            raw_below: (a + 1).unsigned().below((b - 1).unsigned()),
        }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L, N, K, P>, _: &In<L, N, K>) -> Nothing<L> {
        q
    }
}
