//! Operations on unsigned words and bits.

use super::{List, Numbers, Words, wrap};
use motion_rtl::hdl::{Bit, Cut, I, U};

/// Every operation on a word of `n` bits and one of `m` bits.
pub fn of_two(n: usize, m: usize) -> List<U> {
    let mut list = List(Vec::new());
    two(&mut list, n, m);
    if n == m {
        of_one_width(&mut list, n);
    }
    list
}

/// Distances of shifts, and bits: all of a word, and some past its end.
pub fn distances(n: usize) -> impl Iterator<Item = usize> {
    (0..=n + 2).chain([2 * n - 1, 63, 64, 65, 127])
}

/// Small constants, those around the ends of the range, and far ones, cut to the word.
fn constants(n: usize) -> Vec<u64> {
    let (half, end) = (1 << (n - 1), u64::MAX >> (64 - n));
    let ends = [
        half - 1,
        half,
        half + 1,
        end,
        end.wrapping_add(1),
        end.wrapping_add(2),
    ];
    let far = [u64::MAX, 1 << 63, (1 << 62) + 1];
    let all = (0..9).chain(ends).chain(far);
    let mut constants: Vec<u64> = all.map(|constant| constant.cut(n)).collect();
    constants.sort_unstable();
    constants.dedup();
    constants
}

/// Every operation on a word of `n` bits, and on bits.
pub fn of_one(n: usize) -> List<U> {
    let mut list = List(Vec::new());
    bits(&mut list);
    list.add("a", n, |i| i.a, |v| v.a);
    list.add("!a", n, |i| !i.a, |v| -1 - v.a);
    list.add("the bits of s", n, |i| i.s.unsigned(), |v| v.a);
    list.add(
        "there and back",
        n,
        |i| i.s.unsigned().signed().unsigned(),
        |v| v.a,
    );
    list.add("the magnitude of s", n, |i| i.s.magnitude(), |v| v.s.abs());
    list.bit("a is zero", |i| i.a.is_zero(), |v| v.a == 0);
    list.bit("s is zero", |i| i.s.is_zero(), |v| v.s == 0);
    list.bit("s is negative", |i| i.s.is_negative(), |v| v.s < 0);
    for width in [1, 3, n, n + 1, 64] {
        if width <= 64 {
            list.add("a resized", width, move |i| i.a.resize(width), |v| v.a);
        }
    }
    for by in distances(n) {
        if by < n {
            list.bit(
                format!("bit {by}"),
                move |i| i.a.bit(by),
                move |v| v.a >> by & 1 == 1,
            );
        }
        list.add(
            format!("a << {by}"),
            n,
            move |i| i.a.shift_left(by),
            move |v| v.a << by,
        );
        list.add(
            format!("a >> {by}"),
            n,
            move |i| i.a.shift_right(by),
            move |v| v.a >> by,
        );
    }
    list.add("a << far", n, |i| i.a.shift_left(usize::MAX), |_| 0);
    list.add("a >> far", n, |i| i.a.shift_right(usize::MAX), |_| 0);
    for low in 0..n {
        for width in 1..=n - low {
            // In wide words, slices at the ends only.
            if n <= 6 || low < 2 || width < 2 || low + width == n {
                let name = format!("{width} bits from {low} up");
                list.add(
                    name,
                    width,
                    move |i| i.a.slice(low, width),
                    move |v| v.a >> low,
                );
            }
        }
    }
    for constant in constants(n) {
        let number = i128::from(constant);
        let cut: i128 = wrap(number, n).into();
        list.add(
            format!("a + {constant}"),
            n,
            move |i| i.a + constant,
            move |v| v.a + number,
        );
        list.add(
            format!("a - {constant}"),
            n,
            move |i| i.a - constant,
            move |v| v.a - number,
        );
        list.add(
            format!("a & {constant}"),
            n,
            move |i| i.a & constant,
            move |v| v.a & number,
        );
        list.add(
            format!("a | {constant}"),
            n,
            move |i| i.a | constant,
            move |v| v.a | number,
        );
        list.add(
            format!("a ^ {constant}"),
            n,
            move |i| i.a ^ constant,
            move |v| v.a ^ number,
        );
        list.bit(
            format!("a = {constant}"),
            move |i| i.a.equals(constant),
            move |v| v.a == cut,
        );
        list.bit(
            format!("a < {constant}"),
            move |i| i.a.below(constant),
            move |v| v.a < cut,
        );
        list.add(
            format!("a or {constant}"),
            n,
            move |i| i.choose.mux(i.a, constant),
            move |v| if v.choose { v.a } else { number },
        );
        list.add(
            format!("{constant} or a"),
            n,
            move |i| i.choose.mux(constant, i.a),
            move |v| if v.choose { number } else { v.a },
        );
        list.add(
            format!("{constant}"),
            n,
            move |_| U::new(constant, n),
            move |_| number,
        );
        let parameter = move |_: &Words| U::parameter("parameter", constant, n);
        if constant == u64::MAX.cut(n) {
            list.add("a parameter", n, parameter, move |_| number);
        }
    }
    list
}

fn two(list: &mut List<U>, n: usize, m: usize) {
    let wider = n.max(m) + 1;
    for width in [1, 3, n, m, n + m, 12, 64] {
        if width <= 64 {
            let make = move |i: &Words| i.a.times(i.b, width);
            list.add("a · b", width, make, |v| v.a.wrapping_mul(v.b));
        }
    }
    if wider <= 64 {
        list.add("a + b, exact", wider, |i| i.a.plus(i.b), |v| v.a + v.b);
    }
    if n + m <= 64 {
        list.add(
            "a above b",
            n + m,
            |i| i.a.join(i.b),
            move |v| v.a << m | v.b,
        );
    }
    if n > 1 && m > 1 {
        let make = move |i: &Words| i.a.slice(n - 1, 1).join(i.b.slice(0, m - 1));
        let number = move |v: &Numbers| v.a >> (n - 1) << (m - 1) | wrap(v.b, m - 1) as i128;
        list.add("a bit above b", m, make, number);
        let make = move |i: &Words| i.a.slice(0, n - 1).join(i.b.slice(m - 1, 1));
        list.add("a above a bit", n, make, move |v| v.a << 1 | v.b >> (m - 1));
    }
    list.bit("a < b, any widths", |i| i.a.below_any(i.b), |v| v.a < v.b);
    list.bit("a = b, any widths", |i| i.a.equals_any(i.b), |v| v.a == v.b);
    list.bit("s < t, any widths", |i| i.s.below_any(i.t), |v| v.s < v.t);
    list.bit("s = t, any widths", |i| i.s.equals_any(i.t), |v| v.s == v.t);
}

fn of_one_width(list: &mut List<U>, n: usize) {
    list.add("a + b", n, |i| i.a + i.b, |v| v.a + v.b);
    list.add("a - b", n, |i| i.a - i.b, |v| v.a - v.b);
    list.add("a & b", n, |i| i.a & i.b, |v| v.a & v.b);
    list.add("a | b", n, |i| i.a | i.b, |v| v.a | v.b);
    list.add("a ^ b", n, |i| i.a ^ i.b, |v| v.a ^ v.b);
    list.add(
        "a or b",
        n,
        |i| i.choose.mux(i.a, i.b),
        |v| if v.choose { v.a } else { v.b },
    );
    list.bit("a = b", |i| i.a.equals(i.b), |v| v.a == v.b);
    list.bit("a < b", |i| i.a.below(i.b), |v| v.a < v.b);
    list.bit("s = t", |i| i.s.equals(i.t), |v| v.s == v.t);
    list.bit("s < t", |i| i.s.below(i.t), |v| v.s < v.t);
    // An operation of what others gave.
    let chain = |i: &Words| i.a - (i.b - (i.a - i.b)) - (i.b + 1);
    list.add("a chain", n, chain, |v| 2 * v.a - 3 * v.b - 1);
}

fn bits(list: &mut List<U>) {
    let odd = |v: &Numbers| (v.a & 1 == 1, v.b & 1 == 1);
    let two = |i: &Words| (i.a.bit(0), i.b.bit(0));
    let gate = |make: fn(Bit, Bit) -> Bit| move |i: &Words| make(two(i).0, two(i).1);
    let holds = |holds: fn(bool, bool) -> bool| move |v: &Numbers| holds(odd(v).0, odd(v).1);
    list.bit("and", gate(|x, y| x & y), holds(|x, y| x & y));
    list.bit("or", gate(|x, y| x | y), holds(|x, y| x | y));
    list.bit("exclusive or", gate(|x, y| x ^ y), holds(|x, y| x ^ y));
    list.bit("not", gate(|x, _| !x), holds(|x, _| !x));
    list.bit("low", gate(|_, _| Bit::low()), holds(|_, _| false));
    list.bit("high", gate(|_, _| Bit::high()), holds(|_, _| true));
    list.bit("from a bool", gate(|_, _| true.into()), holds(|_, _| true));
    list.bit("and high", gate(|x, _| x & true), holds(|x, _| x));
    list.bit("or low", gate(|_, y| y | false), holds(|_, y| y));
    list.bit("other than high", gate(|x, _| x ^ true), holds(|x, _| !x));
    list.bit("either", gate(|x, y| x.mux(y, !y)), holds(|x, y| x == y));
    list.bit(
        "high or a bit",
        gate(|x, y| x.mux(true, y)),
        holds(|x, y| x | y),
    );
    list.bit(
        "a bit or low",
        gate(|x, y| x.mux(y, false)),
        holds(|x, y| x & y),
    );
    list.bit("chosen", |i| i.choose, |v| v.choose);
    let word = |i: &Words| i.choose.word() + i.a.bit(0).word() + 1;
    list.add("bits as words", 1, word, |v| i128::from(v.choose) + v.a + 1);
    list.add(
        "a constant of 64 bits",
        64,
        |_| U::new(u64::MAX, 64),
        |_| -1,
    );
    list.add(
        "its bits",
        64,
        |_| I::new(i64::MIN, 64).unsigned(),
        |_| 1 << 63,
    );
}
