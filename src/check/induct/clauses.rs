//! Gates as clauses of a solver, made when a question needs them.

use super::thread_time::ThreadTime;
use crate::engine::sliced::gates::{Gate, Gates, Wire};
use batsat::{Callbacks, Lit, Solver, SolverInterface, lbool};
use std::cell::Cell;

/// Number of questions of the solver for each look at the time, which is a call of the system.
const QUESTIONS: u32 = 32;

/// Ends a search of the solver at a moment.
#[derive(Debug)]
struct Until {
    time: ThreadTime,
    /// Questions whether to stop.
    asked: Cell<u32>,
    is_over: Cell<bool>,
}

impl Until {
    fn new(time: ThreadTime) -> Self {
        Until {
            time,
            asked: Cell::new(0),
            is_over: Cell::new(false),
        }
    }
}

impl Callbacks for Until {
    fn stop(&self) -> bool {
        if self.asked.get().is_multiple_of(QUESTIONS) {
            self.is_over.set(ThreadTime::now() >= self.time);
        }
        self.asked.set(self.asked.get().wrapping_add(1));
        self.is_over.get()
    }
}

/// Answer of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Answer {
    /// An assignment exists.
    Possible,
    /// No assignment exists.
    Impossible,
    /// The time is over.
    Unknown,
}

/// Clauses of the gates that were asked about.
pub(super) struct Clauses {
    solver: Solver<Until>,
    /// Literal of each gate.
    lits: Vec<Option<Lit>>,
}

impl Clauses {
    pub fn new() -> Self {
        Clauses {
            solver: Solver::new(Default::default(), Until::new(ThreadTime::now())),
            lits: Vec::new(),
        }
    }

    /// Returns a literal that stands for nothing yet.
    pub fn free(&mut self) -> Lit {
        Lit::new(self.solver.new_var_default(), true)
    }

    /// Returns the literal of a wire, with the clauses of all gates that drive it.
    pub fn lit(&mut self, gates: &Gates, wire: Wire) -> Lit {
        let asked = wire.gate();
        if self.lits.len() < gates.gates.len() {
            self.lits.resize(gates.gates.len(), None);
        }
        let mut open = vec![asked];
        while let Some(&index) = open.last() {
            if self.lits[index].is_some() {
                open.pop();
                continue;
            }
            let gate = gates.gates[index];
            let before = open.len();
            let missing = gate.operands().map(Wire::gate);
            open.extend(missing.filter(|&gate| self.lits[gate].is_none()));
            if open.len() == before {
                let lit = self.free();
                self.define(lit, gate);
                self.lits[index] = Some(lit);
                open.pop();
            }
        }
        match self.known(wire) {
            Some(lit) => lit,
            // The loop has made it.
            None => self.free(),
        }
    }

    /// Returns the literal of a wire if a question needed it.
    pub fn known(&self, wire: Wire) -> Option<Lit> {
        let lit = self.lits.get(wire.gate()).copied().flatten()?;
        Some(if wire.is_inverse() { !lit } else { lit })
    }

    /// Adds the clauses of a gate whose operands have literals.
    fn define(&mut self, out: Lit, gate: Gate) {
        let mut operands = [out; 3];
        for (slot, wire) in operands.iter_mut().zip(gate.operands()) {
            *slot = self.known(wire).unwrap_or(out);
        }
        let [a, b, c] = operands;
        match gate {
            Gate::Low => self.assert(&[!out]),
            Gate::Input(_) => {}
            Gate::And(..) => {
                self.assert(&[!out, a]);
                self.assert(&[!out, b]);
                self.assert(&[out, !a, !b]);
            }
            Gate::Xor(..) => {
                self.assert(&[!out, a, b]);
                self.assert(&[!out, !a, !b]);
                self.assert(&[out, !a, b]);
                self.assert(&[out, a, !b]);
            }
            Gate::Mux(..) => {
                self.assert(&[!a, !b, out]);
                self.assert(&[!a, b, !out]);
                self.assert(&[a, !c, out]);
                self.assert(&[a, c, !out]);
                // These follow from the others, and let the solver see that equal words make the
                // choice irrelevant.
                self.assert(&[!b, !c, out]);
                self.assert(&[b, c, !out]);
            }
        }
    }

    /// Adds a clause.
    pub fn assert(&mut self, clause: &[Lit]) {
        // A contradiction shows in every later answer.
        self.solver.add_clause_reuse(&mut clause.to_vec());
    }

    /// Searches for an assignment in which these literals are high.
    pub fn solve(&mut self, assumed: &[Lit], until: ThreadTime) -> Answer {
        *self.solver.cb_mut() = Until::new(until);
        let answer = self.solver.solve_limited(assumed);
        if answer == lbool::TRUE {
            Answer::Possible
        } else if answer == lbool::FALSE {
            Answer::Impossible
        } else {
            Answer::Unknown
        }
    }

    /// True if a wire is high in the assignment found last; low if it does not matter there.
    pub fn is_high(&self, wire: Wire) -> bool {
        let lit = self.known(wire);
        lit.is_some_and(|lit| self.solver.value_lit(lit) == lbool::TRUE)
    }

    /// True if an assumed literal was needed to show that there is no assignment.
    pub fn is_needed(&self, assumed: Lit) -> bool {
        // The solver keeps the clause that it learned: of the inverses.
        self.solver.unsat_core_contains_lit(!assumed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::sliced::gates::HIGH;
    use std::time::Duration;

    fn soon() -> ThreadTime {
        ThreadTime::now() + Duration::from_secs(10)
    }

    #[test]
    fn a_gate_has_the_clauses_of_its_function() {
        let mut gates = Gates::new();
        let [a, b, c] = [0, 1, 2].map(|bit| gates.input(bit));
        type Function = fn([bool; 3]) -> bool;
        let functions: [(Wire, Function); 5] = [
            (gates.and(a, !b), |[a, b, _]| a && !b),
            (gates.or(a, b), |[a, b, _]| a || b),
            (gates.xor(a, b), |[a, b, _]| a != b),
            (gates.mux(a, b, c), |[a, b, c]| if a { b } else { c }),
            (HIGH, |_| true),
        ];
        for (out, function) in functions {
            let mut clauses = Clauses::new();
            let out = clauses.lit(&gates, out);
            for case in 0..8 {
                let bits = [0, 1, 2].map(|bit| case >> bit & 1 == 1);
                let mut assumed = Vec::new();
                for (wire, high) in [a, b, c].into_iter().zip(bits) {
                    let lit = clauses.lit(&gates, wire);
                    assumed.push(if high { lit } else { !lit });
                }
                let right = if function(bits) { out } else { !out };
                assumed.push(right);
                assert_eq!(clauses.solve(&assumed, soon()), Answer::Possible);
                assumed.pop();
                assumed.push(!right);
                assert_eq!(clauses.solve(&assumed, soon()), Answer::Impossible);
            }
        }
    }

    #[test]
    fn only_what_a_contradiction_needs_is_in_it() {
        let mut gates = Gates::new();
        let [a, b, c] = [0, 1, 2].map(|bit| gates.input(bit));
        let both = gates.and(a, !b);
        let mut clauses = Clauses::new();
        let assumed = [a, !b, c, !both].map(|wire| clauses.lit(&gates, wire));
        assert_eq!(clauses.solve(&assumed, soon()), Answer::Impossible);
        let needed = assumed.map(|lit| clauses.is_needed(lit));
        assert_eq!(needed, [true, true, false, true]);
        assert_eq!(clauses.solve(&assumed[..3], soon()), Answer::Possible);
        assert!(clauses.is_high(both) && clauses.is_high(a) && !clauses.is_high(b));
    }

    #[test]
    fn a_search_ends_at_its_time() {
        let mut gates = Gates::new();
        let words = [0, 24].map(|first: u32| {
            let bits = first..first + 24;
            bits.map(|bit| gates.input(bit)).collect::<Vec<_>>()
        });
        let wide: Vec<Vec<Wire>> = words
            .iter()
            .map(|word| [&word[..], &[!HIGH; 24]].concat())
            .collect();
        // A prime of 47 bits has no factors of 24 but one and itself.
        let product = gates.multiply(&wide[0], &wide[1]);
        let prime = gates.is(&product, 140_737_488_355_213);
        let mut clauses = Clauses::new();
        let prime = clauses.lit(&gates, prime);
        let until = ThreadTime::now() + Duration::from_millis(20);
        assert_eq!(clauses.solve(&[prime], until), Answer::Unknown);
        assert!(until.elapsed() < Duration::from_secs(1));
    }
}
