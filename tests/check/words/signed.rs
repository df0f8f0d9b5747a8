//! Operations on signed words.

use super::{List, Words, unsigned::distances, wrap_signed};
use motion_rtl::hdl::{Cut, I};

/// Every operation on a word of `n` bits and one of `m` bits.
pub fn of_two(n: usize, m: usize) -> List<I> {
    let mut list = List(Vec::new());
    two(&mut list, n, m);
    if n == m {
        of_one_width(&mut list, n);
    }
    list
}

/// Small constants, those around the ends of the range, and far ones, cut to the word.
fn constants(n: usize) -> Vec<i64> {
    let (most, least) = (i64::MAX >> (64 - n), i64::MIN >> (64 - n));
    let ends = [
        most - 1,
        most,
        most.wrapping_add(1),
        least.wrapping_sub(1),
        least,
        least + 1,
    ];
    let far = [i64::MIN, i64::MAX, i64::MIN / 2, i64::MAX / 2];
    let all = (-4..5).chain(ends).chain(far);
    let mut constants: Vec<i64> = all.map(|constant: i64| constant.cut(n)).collect();
    constants.sort_unstable();
    constants.dedup();
    constants
}

/// Every operation on a word of `n` bits.
pub fn of_one(n: usize) -> List<I> {
    let mut list = List(Vec::new());
    list.add("s", n, |i| i.s, |v| v.s);
    list.add("-s", n, |i| -i.s, |v| -v.s);
    list.add("a with its sign", n, |i| i.a.signed(), |v| v.a);
    let negated = |i: &Words| i.s.negated_by(i.choose);
    list.add("s or -s", n, negated, |v| if v.choose { -v.s } else { v.s });
    for width in [1, 3, n, n + 1, 64] {
        if width <= 64 {
            list.add("s resized", width, move |i| i.s.resize(width), |v| v.s);
        }
    }
    for by in distances(n) {
        list.add(
            format!("s << {by}"),
            n,
            move |i| i.s.shift_left(by),
            move |v| v.s << by,
        );
        list.add(
            format!("s >> {by}"),
            n,
            move |i| i.s.shift_right(by),
            move |v| v.s >> by,
        );
    }
    list.add("s << far", n, |i| i.s.shift_left(usize::MAX), |_| 0);
    list.add(
        "s >> far",
        n,
        |i| i.s.shift_right(usize::MAX),
        |v| v.s >> 127,
    );
    for constant in constants(n) {
        let number = i128::from(constant);
        let cut: i128 = wrap_signed(number, n).into();
        list.add(
            format!("s + {constant}"),
            n,
            move |i| i.s + constant,
            move |v| v.s + number,
        );
        list.add(
            format!("s - {constant}"),
            n,
            move |i| i.s - constant,
            move |v| v.s - number,
        );
        list.add(
            format!("{constant}"),
            n,
            move |_| I::new(constant, n),
            move |_| number,
        );
        list.add(
            format!("s or {constant}"),
            n,
            move |i| i.choose.mux(i.s, constant),
            move |v| if v.choose { v.s } else { number },
        );
        list.add(
            format!("{constant} or s"),
            n,
            move |i| i.choose.mux(constant, i.s),
            move |v| if v.choose { number } else { v.s },
        );
        let equals = move |i: &Words| i.s.equals(constant).word().signed();
        list.add(format!("s = {constant}"), 1, equals, move |v| {
            (v.s == cut).into()
        });
        let below = move |i: &Words| i.s.below(constant).word().signed();
        list.add(format!("s < {constant}"), 1, below, move |v| {
            (v.s < cut).into()
        });
    }
    list
}

fn two(list: &mut List<I>, n: usize, m: usize) {
    for width in [1, 3, n, m, n + m, 12, 64] {
        if width <= 64 {
            list.add(
                "s · t",
                width,
                move |i| i.s.times(i.t, width),
                |v| v.s.wrapping_mul(v.t),
            );
        }
    }
    let wider = n.max(m) + 1;
    if wider <= 64 {
        list.add("s + t, exact", wider, |i| i.s.plus(i.t), |v| v.s + v.t);
        list.add("s - t, exact", wider, |i| i.s.minus(i.t), |v| v.s - v.t);
    }
}

fn of_one_width(list: &mut List<I>, n: usize) {
    list.add("s + t", n, |i| i.s + i.t, |v| v.s + v.t);
    list.add("s - t", n, |i| i.s - i.t, |v| v.s - v.t);
    list.add(
        "s or t",
        n,
        |i| i.choose.mux(i.s, i.t),
        |v| if v.choose { v.s } else { v.t },
    );
    let one = 1i64.cut(n);
    let chain = move |i: &Words| -(i.s + i.t) - -i.t - one;
    list.add("a chain", n, chain, |v| -v.s - 1);
}
