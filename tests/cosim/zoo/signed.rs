//! Every operation of signed words, without registers.

use motion_rtl::prelude::*;

/// Words of `n` bits against words of `k` bits, products of `p` bits.
#[derive(Debug, Clone)]
pub struct SignedWords {
    pub n: usize,
    pub k: usize,
    pub p: usize,
}

signals! { for SignedWords as c;
    /// Ports in.
    pub struct In {
        pub a: I(c.n),
        pub b: I(c.n),
        pub c: I(c.k),
        pub left: Bit,
        pub right: Bit,
    }
    /// A net per operation.
    pub struct Net {
        pub sum: I(c.n),
        pub difference: I(c.n),
        pub negated: I(c.n),
        pub a_below_b: Bit,
        pub a_equals_b: Bit,
        pub a_negative: Bit,
        pub sum_negative: Bit,
        pub b_zero: Bit,
        pub c_resized: I(c.n),
        pub a_resized: I(c.k),
        pub sum_resized: I(c.k),
        pub minus_a_resized: I(c.k),
        pub choice_resized: I(c.k),
        pub shift_resized: I(c.k),
        pub product_resized: I(c.k),
        pub bits_resized: U(c.k),
        pub product: I(c.p),
        pub swapped: I(c.p),
        pub square: I(c.n),
        pub times_constant: I(c.p),
        pub up_one: I(c.n),
        pub up_last: I(c.n),
        pub up_over: I(c.n),
        pub down_none: I(c.n),
        pub down_one: I(c.n),
        pub down_last: I(c.n),
        pub down_over: I(c.n),
        pub sum_down: I(c.n),
        pub down_sum: I(c.n),
        pub size: U(c.n),
        pub size_of_sum: U(c.n),
        pub size_of_least: U(c.n),
        pub raw: U(c.n),
        pub raw_sum: U(c.n),
        pub again: I(c.n),
        pub least: I(c.n),
        pub greatest: I(c.n),
        pub minus_one: I(c.n),
        pub plus_greatest: I(c.n),
        pub minus_least: I(c.n),
        pub above_least: Bit,
        pub below_minus_one: Bit,
        pub least_or: I(c.n),
        pub nested: I(c.n),
        pub both_nested: I(c.n),
        pub chain_left: I(c.n),
        pub chain_right: I(c.n),
        pub minus_of_sum: I(c.n),
        pub twice_negated: I(c.n),
        pub sums_equal: Bit,
        pub sums_below: Bit,
        pub raw_below: Bit,
    }
}

impl Circuit for SignedWords {
    const NAME: &'static str = "signed_words";
    const ABOUT: &'static str = "every operation of signed words";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let Self { n, k, p } = *self;
        let In {
            a,
            b,
            c,
            left,
            right,
        } = i;
        let least = I::new(i64::MIN >> (64 - n), n);
        let greatest = I::new(i64::MAX >> (64 - n), n);
        let one = 1i64.cut(n);
        let minus_one = I::new(-1, n);
        let sum = a + b;
        let inner = right.mux(a - b, right.mux(b, least));
        let net = Net {
            sum,
            difference: a - b,
            negated: -a,
            a_below_b: a.below(b),
            a_equals_b: a.equals(b),
            a_negative: a.is_negative(),
            sum_negative: (a + c.resize(n)).is_negative(),
            b_zero: b.is_zero(),
            c_resized: c.resize(n),
            a_resized: a.resize(k),
            sum_resized: (a + b + one).resize(k),
            minus_a_resized: (-b).resize(k),
            choice_resized: left.mux(a + b, -b).resize(k),
            shift_resized: (a - b).shift_right(n / 2).resize(k),
            product_resized: a.times(b, n).resize(k),
            bits_resized: (a - b).unsigned().resize(k),
            product: a.times(c, p),
            swapped: c.times(a + b, p),
            square: a.times(a, n),
            times_constant: a.times(I::new((-3i64).cut(k), k), p),
            up_one: a.shift_left(1),
            up_last: a.shift_left(n - 1),
            up_over: a.shift_left(n),
            down_none: a.shift_right(0),
            down_one: a.shift_right(1),
            down_last: a.shift_right(n - 1),
            down_over: a.shift_right(n + 7),
            sum_down: (a + b).shift_right(1),
            down_sum: a.shift_right(1) + b.shift_right(1),
            size: a.magnitude(),
            size_of_sum: (b - a + one).magnitude(),
            size_of_least: least.magnitude(),
            raw: a.unsigned(),
            raw_sum: (a - one).unsigned() + b.unsigned(),
            again: b.unsigned().signed(),
            least,
            greatest,
            minus_one,
            plus_greatest: a + (i64::MAX >> (64 - n)),
            minus_least: a - least,
            above_least: least.below(a),
            below_minus_one: a.below(minus_one),
            least_or: left.mux(least, greatest),
            nested: left.mux(right.mux(a, b), -a),
            both_nested: left.mux(
                inner,
                (left & !right).mux(inner + one, right.mux(-b, inner)),
            ),
            chain_left: (a - b) - (b - a) - one,
            chain_right: a - (b - (a - (b + one))),
            minus_of_sum: -(a + b) - -b,
            twice_negated: -(-a),
            sums_equal: (a + one).equals(b - one),
            sums_below: (a + one).below(b - one),
            raw_below: (a + one).unsigned().below((b - one).unsigned()),
        };
        (net, Nothing)
    }
}
