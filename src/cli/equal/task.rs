//! A proof by induction that two netlists are equal: a design and a circuit, a part of both, or what
//! connects their parts.

use super::Failure;
use super::check::{Check, Paired, Work};
use super::invariants::{self, Invariant};
use super::miter::Miter;
use super::script::{self, Names};
use super::tool::{End, Ran};
use super::trace::Trace;
use motion_rtl::sim::SignalInfo;
use std::io;
use std::time::Instant;

/// What is to be proved.
#[derive(Clone, Copy)]
pub struct Task<'t> {
    pub check: &'t Check<'t>,
    pub names: Names<'t>,
    /// Signals of the circuit or of its part.
    pub signals: &'t [SignalInfo],
    pub paired: &'t Paired,
    /// Clock of the design.
    pub clock: &'t str,
    /// Reset of the design, and true if it is active low.
    pub reset: Option<(&'t str, bool)>,
}

/// Result of an attempt to prove a task.
#[derive(Debug, Clone)]
pub struct Proof {
    pub ran: Ran,
    pub invariants: Vec<Invariant>,
    /// Ticks that induction assumed at most.
    pub induction: u32,
    /// Ticks from power-on without a difference.
    pub ticks: u32,
}

impl<'t> Task<'t> {
    pub fn miter(&self, invariants: &'t [Invariant]) -> Miter<'t> {
        Miter {
            invariants,
            circuit: self.names.stem,
            signals: self.signals,
            golden: &self.paired.golden,
            design: &self.paired.design,
            pairs: &self.paired.pairs,
            clock: self.clock,
            reset: self.reset,
            after_reset: self.check.arguments.after_reset,
        }
    }

    /// Returns the name of the trace that a script leaves.
    fn trace(&self) -> String {
        format!("{}.trace.vcd", self.names.stem)
    }

    /// Reads the trace of a run.
    pub fn read_trace(&self, work: &Work) -> io::Result<Trace> {
        Ok(Trace::read(&work.read(&self.trace())?))
    }

    fn induct(
        &self,
        work: &Work,
        invariants: &[Invariant],
        induction: u32,
        until: Instant,
    ) -> io::Result<Ran> {
        let (miter, stem) = (self.miter(invariants), self.names.stem);
        work.write(&format!("{stem}.miter.v"), &miter.text())?;
        let script = format!("{stem}.miter.ys");
        work.write(&script, &self.names.miter(&miter.exposed(), induction))?;
        work.run(self.check, &script, until)
    }

    /// Tries a proof from the pairs alone, then with statements about the circuit's registers.
    pub fn prove(&self, work: &Work, until: Instant) -> Result<Proof, Failure> {
        let [induction, more] = script::INDUCTION;
        let ran = self.induct(work, &[], induction, until)?;
        let mut proof = Proof {
            ticks: ran.ticks_without_difference(),
            invariants: Vec::new(),
            ran,
            induction,
        };
        if proof.ran.is_open() {
            proof.invariants = self.invariants(work, until)?;
            proof.induction = more;
            proof.ran = self.induct(work, &proof.invariants, more, until)?;
            proof.ticks = proof.ticks.max(proof.ran.ticks_without_difference());
        }
        Ok(proof)
    }

    /// Returns statements about the circuit's registers that induction proves together.
    fn invariants(&self, work: &Work, until: Instant) -> Result<Vec<Invariant>, Failure> {
        let (names, check) = (self.names, self.check);
        let candidates = invariants::candidates(
            &check.model,
            &check.signals,
            self.signals,
            &self.paired.golden,
        );
        let mut candidates = candidates.map_err(|error| Failure::Undecided(error.to_string()))?;
        while !candidates.is_empty() {
            let miter = self.miter(&candidates);
            let (text, exposed) = miter.alone();
            let script = format!("{}.invariants.ys", names.stem);
            work.write(&format!("{}.invariants.v", names.stem), &text)?;
            work.write(&script, &names.invariants(&exposed))?;
            let ran = work.run(check, &script, until)?;
            if ran.is_proof() {
                break;
            }
            let trace = match ran.end {
                End::Success => self.read_trace(work)?,
                End::Failure | End::Late => Trace::default(),
            };
            let wires = miter.alone_wires();
            let wire = |index: usize| wires.get(&index).cloned().unwrap_or_default();
            if !invariants::refute(&mut candidates, &trace, wire) {
                // Out of time, or Yosys failed: no statement is known to hold.
                return Ok(Vec::new());
            }
        }
        Ok(candidates)
    }
}
