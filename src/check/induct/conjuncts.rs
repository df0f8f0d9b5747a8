//! Division of a property into parts that are easier to prove.

use crate::engine::sliced::gates::{Gate, Gates, HIGH, LOW, Wire};

/// Number of parts from which on no part is divided further.
const MOST: usize = 4096;

/// Returns wires that are all high if, and only if, `wire` is high.
///
/// The parts of a comparison of words come from the lowest bit up, so the proof of a bit can use
/// those below it.
pub(super) fn conjuncts(gates: &mut Gates, wire: Wire) -> Vec<Wire> {
    let mut parts = Vec::new();
    // The second wire has to be high unless the first is.
    let mut open = vec![(LOW, wire)];
    while let Some((unless, whole)) = open.pop() {
        let has_room = parts.len() + open.len() < MOST;
        match divided(gates, whole).filter(|_| has_room) {
            Some(all) => {
                for (also, part) in all.into_iter().flatten().rev() {
                    open.push((gates.or(unless, also), part));
                }
            }
            None => {
                let part = gates.or(unless, whole);
                if part != HIGH {
                    parts.push(part);
                }
            }
        }
    }
    parts
}

/// Divides a wire once: the second wire of each pair has to be high unless the first is.
fn divided(gates: &Gates, whole: Wire) -> Option<[Option<(Wire, Wire)>; 2]> {
    let is_and = |wire: Wire| {
        let gate = gates.gates[wire.gate()];
        matches!(gate, Gate::And(..)) && !wire.is_inverse()
    };
    match gates.gates[whole.gate()] {
        Gate::And(a, b) if !whole.is_inverse() => Some([Some((LOW, a)), Some((LOW, b))]),
        Gate::And(a, b) if is_and(!b) => Some([Some((!a, !b)), None]),
        Gate::And(a, b) if is_and(!a) => Some([Some((!b, !a)), None]),
        Gate::Mux(choose, then, other) => {
            let [then, other] = match whole.is_inverse() {
                true => [!then, !other],
                false => [then, other],
            };
            let pays = is_and(then) || is_and(other);
            pays.then_some([Some((!choose, then)), Some((choose, other))])
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns gates of some inputs, made from numbers, and the last of their wires.
    fn random(picks: &[(u8, u16, u16, u16)]) -> (Gates, Vec<Wire>) {
        let mut gates = Gates::new();
        let mut wires: Vec<Wire> = (0..5).map(|bit| gates.input(bit)).collect();
        for &(kind, a, b, c) in picks {
            let wire = |pick: u16| {
                let wire = wires[wires.len() - 1 - usize::from(pick >> 1) % wires.len().min(7)];
                if pick & 1 == 1 { !wire } else { wire }
            };
            let [a, b, c] = [a, b, c].map(wire);
            wires.push(match kind % 4 {
                0 | 1 => gates.and(a, b),
                2 => gates.mux(a, b, c),
                _ => gates.xor(a, b),
            });
        }
        (gates, wires)
    }

    /// Returns the level of each gate for a case.
    fn levels(gates: &Gates, case: u32) -> Vec<bool> {
        let mut levels: Vec<bool> = Vec::new();
        for gate in &gates.gates {
            let of = |wire: Wire| levels[wire.gate()] != wire.is_inverse();
            levels.push(match *gate {
                Gate::Low => false,
                Gate::Input(bit) => case >> bit & 1 == 1,
                Gate::And(a, b) => of(a) && of(b),
                Gate::Xor(a, b) => of(a) != of(b),
                Gate::Mux(a, b, c) => of(if of(a) { b } else { c }),
            });
        }
        levels
    }

    proptest! {
        #[test]
        fn all_parts_are_high_where_the_whole_is(
            picks in prop::collection::vec(any::<(u8, u16, u16, u16)>(), 1..30),
        ) {
            let (mut gates, wires) = random(&picks);
            for whole in wires.into_iter().flat_map(|wire| [wire, !wire]) {
                let parts = conjuncts(&mut gates, whole);
                for case in 0..32 {
                    let levels = levels(&gates, case);
                    let of = |wire: Wire| levels[wire.gate()] != wire.is_inverse();
                    prop_assert_eq!(parts.iter().all(|&part| of(part)), of(whole));
                }
            }
        }
    }

    #[test]
    fn cases_of_equal_words_are_divided_into_bits() {
        let mut gates = Gates::new();
        let mut word = |first| (first..first + 4).map(|bit| gates.input(bit)).collect();
        let [a, b, c]: [Vec<Wire>; 3] = [word(0), word(4), word(8)];
        let choose = gates.input(12);
        let [ab, ac] = [gates.equal(&a, &b), gates.equal(&a, &c)];
        let either = gates.mux(choose, ab, ac);
        assert_eq!(conjuncts(&mut gates, either).len(), 8);
        let both = gates.and(ab, ac);
        let case = gates.or(!choose, both);
        let parts = conjuncts(&mut gates, case);
        assert_eq!(parts.len(), 8);
        let lowest = gates.xor(a[0], b[0]);
        assert_eq!(parts[0], gates.or(!choose, !lowest));
        // There are not too many.
        let wide: Vec<Wire> = (0..5000).map(|bit| gates.input(bit)).collect();
        let zero = gates.is(&wide, 0);
        assert_eq!(conjuncts(&mut gates, zero).len(), MOST + 1);
        assert_eq!(conjuncts(&mut gates, HIGH), []);
        assert_eq!(conjuncts(&mut gates, LOW), [LOW]);
    }
}
