//! Every operation of unsigned words and bits.

use motion_rtl::kernel::{Circuit, Nothing};
use motion_rtl::logic::{Bit, Logic, Signed, Unsigned};
use motion_rtl::signals;

signals! {
    /// Ports in.
    pub struct In<L, const N: usize, const K: usize> {
        pub a: L::U<N> as Hex,
        pub b: L::U<N>,
        pub c: L::U<K>,
        pub left: L::Bit,
        pub right: L::Bit,
    }
}

signals! {
    /// A net per operation.
    pub struct Net<L, const N: usize, const K: usize, const P: usize> {
        pub sum: L::U<N>,
        pub difference: L::U<N>,
        pub inverted: L::U<N>,
        pub both: L::U<N>,
        pub either: L::U<N>,
        pub one_of: L::U<N>,
        pub mixed: L::U<N>,
        pub not_mixed: L::U<N>,
        pub below: L::Bit,
        pub at_least: L::Bit,
        pub equals: L::Bit,
        pub differs: L::Bit,
        pub zero: L::Bit,
        pub lowest: L::Bit,
        pub highest: L::Bit,
        pub above: L::Bit,
        pub far_above: L::Bit,
        pub sum_highest: L::Bit,
        pub shift_lowest: L::Bit,
        pub a_resized: L::U<K>,
        pub c_resized: L::U<N>,
        pub sum_resized: L::U<K>,
        pub choice_resized: L::U<K>,
        pub inverted_resized: L::U<K>,
        pub shift_resized: L::U<K>,
        pub joined_resized: L::U<K>,
        pub wide_sum: L::U<P>,
        pub wide_inverted: L::U<P>,
        pub product: L::U<P>,
        pub product_of_sums: L::U<P>,
        pub low_product: L::U<N>,
        pub joined: L::U<P>,
        pub joined_cut: L::U<N>,
        pub joined_sums: L::U<P>,
        pub joined_bits: L::U<2>,
        pub up_last: L::U<N>,
        pub up_over: L::U<N>,
        pub down_last: L::U<N>,
        pub down_over: L::U<N>,
        pub sum_up: L::U<N>,
        pub sum_of_ups: L::U<N>,
        pub as_signed: L::I<N>,
        pub sum_signed: L::I<P>,
        pub greatest: L::U<N>,
        pub plus_greatest: L::U<N>,
        pub minus_one: L::U<N>,
        pub chain: L::U<N>,
        pub left_word: L::U<1>,
        pub word_sum: L::U<1>,
        pub word_wide: L::U<N>,
        pub gate: L::Bit,
        pub gates: L::Bit,
        pub parity: L::Bit,
        pub constant_bit: L::Bit,
        pub chosen_bit: L::Bit,
        pub chosen_gate: L::Bit,
        pub nested: L::U<N>,
        pub shared_choice: L::U<N>,
        pub same_as_a: L::U<N>,
        pub alias_of_net: L::U<N>,
    }
}

/// Words of `N` bits against words of `K` bits, products of `P` bits.
#[derive(Debug)]
pub struct UnsignedWords<const N: usize, const K: usize, const P: usize>;

impl<const N: usize, const K: usize, const P: usize> Circuit for UnsignedWords<N, K, P> {
    const NAME: &'static str = "unsigned_words";
    const ABOUT: &'static str = "every operation of unsigned words and bits";
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
        let sum = a + b;
        let choice = left.mux(a + 1, right.mux(b, !a));
        Net {
            sum,
            difference: a - b,
            inverted: !a,
            both: a & b,
            either: a | b,
            one_of: a ^ b,
            mixed: (a & !b) | (!a & b) ^ (a | b & a),
            not_mixed: !((a ^ b) & (a | b)) - 1,
            below: a.below(b),
            at_least: !a.below(b),
            equals: a.equals(b),
            differs: !(a + 1).equals(b),
            zero: (a & b).is_zero(),
            lowest: a.bit(0),
            highest: a.bit(N - 1),
            above: a.bit(N),
            far_above: a.bit(100),
            sum_highest: (a + b + 1).bit(N - 1),
            shift_lowest: (a - b).shift_right(N / 2).bit(0),
            a_resized: a.resize(),
            c_resized: c.resize(),
            sum_resized: (a - 1).resize(),
            choice_resized: left.mux(a - b, a & b).resize(),
            inverted_resized: (!b).resize(),
            shift_resized: (a ^ b).shift_right(N / 3).resize(),
            joined_resized: a.join::<K, P>(c + 1).resize(),
            wide_sum: a.resize::<P>() + c.resize::<P>(),
            wide_inverted: !(a + 3).resize::<P>(),
            product: a.times::<K, P>(c),
            product_of_sums: (a + 1).times::<K, P>(c - 1),
            low_product: a.times::<N, N>(b),
            joined: a.join::<K, P>(c),
            joined_cut: a.join::<K, N>(c),
            joined_sums: (a + 1).join::<K, P>(c - 1),
            joined_bits: left.word().join::<1, 2>((left ^ right).word()),
            up_last: a.shift_left(N - 1),
            up_over: a.shift_left(N + 1),
            down_last: a.shift_right(N - 1),
            down_over: a.shift_right(N),
            sum_up: (a + b).shift_left(1) + 1,
            sum_of_ups: a.shift_left(1) + (b + 1).shift_right(1),
            as_signed: a.signed(),
            sum_signed: (a + 1).signed().resize::<P>(),
            greatest: u64::MAX.into(),
            plus_greatest: a + u64::MAX,
            minus_one: a - 1,
            chain: a - (b - (a - b)) - (b + 1),
            left_word: left.word(),
            word_sum: left.word() + right.word() + 1,
            word_wide: (!left).word().resize::<N>() + a,
            gate: left & !right,
            gates: left & (right | !left) ^ (left ^ right) | a.is_zero() & !b.is_zero(),
            parity: left ^ right ^ a.bit(0) ^ !b.bit(0),
            constant_bit: true.into(),
            chosen_bit: left.mux(right, a.below(b)),
            chosen_gate: !(left & right).mux(a.is_zero() | right, !right.mux(left, b.bit(0))),
            nested: left.mux(right.mux(a, b), right.mux(b - 1, left.mux(a, sum))),
            shared_choice: choice + choice.shift_left(1),
            same_as_a: a,
            alias_of_net: sum,
        }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &Net<L, N, K, P>, _: &In<L, N, K>) -> Nothing<L> {
        q
    }
}
