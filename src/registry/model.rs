//! Circuits whose types are forgotten.

use crate::check::{
    CheckError, Concluded, Drive, Driven, InductError, Outcome, Progress, Proof, Specified,
    Violation, conclude, reach,
};
use crate::engine::EngineError;
use crate::hdl::{Circuit, Declarations};
use crate::sim::{Elaborated, RunError};
use crate::trace::chart::{Chart, ChartFailure};
use crate::trace::{Layout, LayoutError};
use crate::verilog::{Connections, Verilog};
use crate::vhdl::Vhdl;
use std::io::Write;
use std::time::{Duration, Instant};

/// A circuit, its type forgotten.
pub trait AnyModel: Send + Sync {
    /// Returns the name of the circuit.
    fn name(&self) -> &'static str;
    /// Returns a description in one line.
    fn about(&self) -> &'static str;
    /// Elaborates the circuit.
    ///
    /// # Errors
    /// All errors of the circuit.
    fn model(&self) -> Result<Elaborated, EngineError>;
    /// Returns its signals in the order of its waves.
    fn outline(&self) -> Declarations;
}

impl<C: Circuit> AnyModel for C {
    fn name(&self) -> &'static str {
        Circuit::name(self)
    }

    fn about(&self) -> &'static str {
        Circuit::about(self)
    }

    fn model(&self) -> Result<Elaborated, EngineError> {
        Elaborated::new(self)
    }

    fn outline(&self) -> Declarations {
        Declarations::of(self)
    }
}

impl dyn AnyModel + '_ {
    /// Its signals, in the order of its waves, with what they are at power-on.
    ///
    /// # Errors
    /// No netlist can be made of it.
    pub fn declarations(&self) -> Result<Declarations, EngineError> {
        Ok(self.model()?.declarations().clone())
    }

    /// Lays its signals out for waves.
    ///
    /// # Errors
    /// A name that is used twice in a scope, or that waveform files cannot carry.
    pub fn layout(&self) -> Result<(), LayoutError> {
        Layout::new(self.name(), self.outline().leaves, None).map(drop)
    }

    /// Runs a timing chart.
    ///
    /// # Errors
    /// The circuit does something else than the chart says, or the chart cannot be run on it.
    pub fn chart(&self, chart: &Chart) -> Result<(), ChartFailure> {
        chart.run_on(&self.model()?)
    }

    /// Returns the circuit as Verilog.
    ///
    /// # Errors
    /// No netlist can be made of it.
    pub fn verilog(&self) -> Result<Verilog, EngineError> {
        Verilog::new(&self.model()?)
    }

    /// Returns the circuit as VHDL.
    ///
    /// # Errors
    /// No netlist can be made of it.
    pub fn vhdl(&self) -> Result<Vhdl, EngineError> {
        Vhdl::new(&self.model()?)
    }

    /// Returns the parts of the circuit and their connections.
    ///
    /// # Errors
    /// No netlist can be made of it.
    pub fn connections(&self) -> Result<Connections, EngineError> {
        Ok(Connections::of(self.model()?.design(), &self.outline()))
    }

    /// Proves its properties at its own widths, see [`induct`](crate::check::induct()). `limit` is
    /// the time for each property.
    ///
    /// # Errors
    /// No netlist can be made of it, or it has no properties.
    pub fn induct(&self, limit: Duration) -> Result<Vec<Concluded<Violation>>, InductError> {
        conclude(&self.model()?, limit)
    }

    /// Drives it with random inputs, see [`drive`](crate::check::drive()).
    ///
    /// # Errors
    /// A writer failed; a name that is used twice in a scope or that waves cannot carry; it is no
    /// netlist.
    pub fn drive(
        &self,
        run: &Drive,
        waves: &mut dyn Write,
        stimulus: &mut dyn Write,
        expected: &mut dyn Write,
    ) -> Result<Driven, RunError> {
        run.run(&self.model()?, waves, stimulus, expected)
    }
}

/// A circuit with its proofs, its type forgotten.
pub trait AnyCircuit: AnyModel {
    /// Returns the names of its invariants.
    fn invariants(&self) -> Vec<String>;
    /// Proves its invariants, or finds the shortest way to break one.
    ///
    /// # Errors
    /// The circuit is too wide to be proved.
    fn prove(
        &self,
        search: &ProofSearch<'_>,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<Verdict, CheckError>;
}

/// Options of the search for a proof.
#[derive(Debug, Clone)]
pub struct ProofSearch<'a> {
    /// States after which it is given up.
    pub states: u32,
    /// Transitions after which it is given up.
    pub transitions: u64,
    /// Time at which it is given up.
    pub until: Option<Instant>,
    /// Names of the invariants to prove; all by default.
    pub invariants: Option<&'a [String]>,
    /// A netlist of the circuit to take in place of its own.
    pub model: Option<Elaborated>,
}

impl Default for ProofSearch<'_> {
    fn default() -> Self {
        ProofSearch {
            states: 1 << 26,
            transitions: u64::MAX,
            until: None,
            invariants: None,
            model: None,
        }
    }
}

/// Result of a proof or a sweep.
#[derive(Debug)]
#[must_use = "that something is broken is seen by looking at it"]
pub enum Verdict<P = Proof> {
    /// Every invariant holds.
    Proved(P),
    /// An invariant does not hold.
    Broken(Violation),
    /// More states than the limit.
    Undecided(Progress),
}

impl<C: Specified> AnyCircuit for C {
    fn invariants(&self) -> Vec<String> {
        let invariants = Specified::invariants(self);
        invariants.names().map(str::to_owned).collect()
    }

    fn prove(
        &self,
        search: &ProofSearch<'_>,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<Verdict, CheckError> {
        let mut invariants = Specified::invariants(self);
        if let Some(names) = search.invariants {
            invariants = invariants.only(names);
        }
        let mut reach = reach(self, &invariants)
            .inputs(|i| self.applies(i))
            .limit(search.states)
            .transitions(search.transitions)
            .progress(progress);
        if let Some(until) = search.until {
            reach = reach.until(until);
        }
        if let Some(model) = &search.model {
            reach = reach.model(model.clone());
        }
        let outcome = reach.run()?;
        Ok(match outcome {
            Outcome::Proof(proof) => Verdict::Proved(proof),
            Outcome::Limit(progress) => Verdict::Undecided(progress),
            Outcome::Counterexample(found) => Verdict::Broken(found.into_violation()),
        })
    }
}
