//! Every operation of unsigned words and bits.

use motion_rtl::prelude::*;

/// Words of `n` bits against words of `k` bits, products of `p` bits.
#[derive(Debug, Clone)]
pub struct UnsignedWords {
    pub n: usize,
    pub k: usize,
    pub p: usize,
}

signals! { for UnsignedWords as c;
    /// Ports in.
    pub struct In {
        pub a: U(c.n) as Hex,
        pub b: U(c.n),
        pub c: U(c.k),
        pub left: Bit,
        pub right: Bit,
    }
    /// A net per operation.
    pub struct Net {
        pub sum: U(c.n),
        pub difference: U(c.n),
        pub inverted: U(c.n),
        pub both: U(c.n),
        pub either: U(c.n),
        pub one_of: U(c.n),
        pub mixed: U(c.n),
        pub not_mixed: U(c.n),
        pub below: Bit,
        pub at_least: Bit,
        pub equals: Bit,
        pub differs: Bit,
        pub zero: Bit,
        pub lowest: Bit,
        pub highest: Bit,
        pub sum_highest: Bit,
        pub shift_lowest: Bit,
        pub a_resized: U(c.k),
        pub c_resized: U(c.n),
        pub sum_resized: U(c.k),
        pub choice_resized: U(c.k),
        pub inverted_resized: U(c.k),
        pub shift_resized: U(c.k),
        pub joined_resized: U(c.k),
        pub wide_sum: U(c.p),
        pub wide_inverted: U(c.p),
        pub product: U(c.p),
        pub product_of_sums: U(c.p),
        pub low_product: U(c.n),
        pub joined: U(c.p),
        pub joined_cut: U(c.n),
        pub joined_sums: U(c.p),
        pub joined_bits: U(2),
        pub up_last: U(c.n),
        pub up_over: U(c.n),
        pub down_last: U(c.n),
        pub down_over: U(c.n),
        pub sum_up: U(c.n),
        pub sum_of_ups: U(c.n),
        pub as_signed: I(c.n),
        pub sum_signed: I(c.p),
        pub greatest: U(c.n),
        pub plus_greatest: U(c.n),
        pub minus_one: U(c.n),
        pub chain: U(c.n),
        pub left_word: U(1),
        pub word_sum: U(1),
        pub word_wide: U(c.n),
        pub gate: Bit,
        pub gates: Bit,
        pub parity: Bit,
        pub constant_bit: Bit,
        pub chosen_bit: Bit,
        pub chosen_gate: Bit,
        pub nested: U(c.n),
        pub shared_choice: U(c.n),
        pub same_as_a: U(c.n),
        pub alias_of_net: U(c.n),
    }
}

/// `high` above `low`, cut or extended to `width` bits.
fn join(high: U, low: U, width: usize) -> U {
    match width.saturating_sub(low.width()) {
        0 => low.resize(width),
        room => high.resize(room.min(high.width())).join(low).resize(width),
    }
}

impl Circuit for UnsignedWords {
    const NAME: &'static str = "unsigned_words";
    const ABOUT: &'static str = "every operation of unsigned words and bits";
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
        let sum = a + b;
        let choice = left.mux(a + 1, right.mux(b, !a));
        let net = Net {
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
            highest: a.bit(n - 1),
            sum_highest: (a + b + 1).bit(n - 1),
            shift_lowest: (a - b).shift_right(n / 2).bit(0),
            a_resized: a.resize(k),
            c_resized: c.resize(n),
            sum_resized: (a - 1).resize(k),
            choice_resized: left.mux(a - b, a & b).resize(k),
            inverted_resized: (!b).resize(k),
            shift_resized: (a ^ b).shift_right(n / 3).resize(k),
            joined_resized: join(a, c + 1, p).resize(k),
            wide_sum: a.resize(p) + c.resize(p),
            wide_inverted: !(a + 3u64.cut(n)).resize(p),
            product: a.times(c, p),
            product_of_sums: (a + 1).times(c - 1, p),
            low_product: a.times(b, n),
            joined: join(a, c, p),
            joined_cut: join(a, c, n),
            joined_sums: join(a + 1, c - 1, p),
            joined_bits: left.word().join((left ^ right).word()),
            up_last: a.shift_left(n - 1),
            up_over: a.shift_left(n + 1),
            down_last: a.shift_right(n - 1),
            down_over: a.shift_right(n),
            sum_up: (a + b).shift_left(1) + 1,
            sum_of_ups: a.shift_left(1) + (b + 1).shift_right(1),
            as_signed: a.signed(),
            sum_signed: (a + 1).signed().resize(p),
            greatest: U::new(u64::MAX.cut(n), n),
            plus_greatest: a + u64::MAX.cut(n),
            minus_one: a - 1,
            chain: a - (b - (a - b)) - (b + 1),
            left_word: left.word(),
            word_sum: left.word() + right.word() + 1,
            word_wide: (!left).word().resize(n) + a,
            gate: left & !right,
            gates: left & (right | !left) ^ (left ^ right) | a.is_zero() & !b.is_zero(),
            parity: left ^ right ^ a.bit(0) ^ !b.bit(0),
            constant_bit: Bit::high(),
            chosen_bit: left.mux(right, a.below(b)),
            chosen_gate: !(left & right).mux(a.is_zero() | right, !right.mux(left, b.bit(0))),
            nested: left.mux(right.mux(a, b), right.mux(b - 1, left.mux(a, sum))),
            shared_choice: choice + choice.shift_left(1),
            same_as_a: a,
            alias_of_net: sum,
        };
        (net, Nothing)
    }
}
