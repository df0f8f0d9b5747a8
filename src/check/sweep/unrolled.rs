//! Many cases side by side, in a circuit that is unrolled: its ticks one behind the other, without
//! registers.

use super::{Law, from_word, to_word};
use crate::engine::sliced::{LANES, Run, Sliced};
use crate::engine::{Flat, passes};
use crate::kernel::{Circuit, Moment, zero};
use crate::logic::Netlist;
use crate::logic::netlist::{Constants, combinational, nodes};
use std::ops::Range;

/// The nodes with which unrolling is given up.
const MOST: usize = 1 << 19;

/// A law from the bits of a case to those of what is seen; nothing where the circuit has memories or
/// runs for too long.
pub fn unrolled<W: Law>(law: &W) -> Option<Sliced> {
    let circuit = law.circuit();
    let power_on = Constants::of(&circuit.power_on())?;
    let nothing = Constants::of(&zero::<W::Seen<_>>())?;
    Constants::of(&zero::<W::Case<_>>())?;
    let run = |case: &W::Case<Netlist>| {
        let mut q = power_on.make();
        let mut seen = nothing.make();
        for tick in 0..law.ticks() {
            if nodes() > MOST {
                return None;
            }
            let i = law.input(case, tick);
            let w = circuit.comb(&q, &i);
            let now = Moment {
                i: &i,
                q: &q,
                w: &w,
            };
            seen = law.see(seen, tick, &now);
            q = circuit.next(q, &w, &i);
        }
        Some(seen)
    };
    let design = combinational(W::Circuit::NAME, run)?.ok()?;
    let flat = Flat::of(&design).ok()?;
    // What does not depend on the case is no more than constants from here on.
    let flat = passes::all(&flat, &vec![true; flat.leaves.len()]);
    Sliced::of(&flat).ok()
}

/// How many cases are meant, and the first that is wrong.
pub fn check<W: Law>(law: &W, sliced: &Sliced, chunk: Range<u64>) -> (u64, Option<u64>) {
    let mut run = Run::new(sliced);
    let mut meant = 0;
    let lanes = LANES as u64;
    let whole = chunk.start / lanes * lanes;
    for first in (whole..chunk.end).step_by(LANES) {
        run.run(first);
        for word in 0..LANES / 64 {
            let first = first + 64 * word as u64;
            if first + 64 <= chunk.start || first >= chunk.end {
                continue;
            }
            for (index, seen) in (first..).zip(run.seen(word)) {
                if !chunk.contains(&index) {
                    continue;
                }
                if let Some(expected) = law.expected(&from_word(index)) {
                    meant += 1;
                    if to_word(&expected) != seen {
                        return (meant, Some(index));
                    }
                }
            }
        }
    }
    (meant, None)
}
