//! Elaborated circuits.

use super::Beside;
use super::beside::scope;
use super::ports::Ports;
use crate::engine::{Engine, EngineError, Flat, Program, Statement, Watch, ports_out};
use crate::hdl::{
    Circuit, Declarations, Record, Shapes, Source, declarations, elaborate, with_inputs,
};
use crate::netlist::{Assertion, Design, Role};
#[cfg(test)]
use crate::netlist::{BIT, Node};
use std::fmt;
use std::sync::{Arc, OnceLock};

/// Type from which an [`Elaborated`] circuit can be made: a circuit, or one that is elaborated.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no circuit",
    note = "a `Circuit` or an `Elaborated` is wanted, by reference: `&circuit`"
)]
pub trait Described {
    /// Elaborates the circuit.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    fn described(&self) -> Result<Elaborated, EngineError>;
    /// Returns name and signals; power-on values are left at 0.
    fn outlined(&self) -> (&'static str, Declarations);
}

impl Described for Elaborated {
    fn described(&self) -> Result<Elaborated, EngineError> {
        Ok(self.clone())
    }
    fn outlined(&self) -> (&'static str, Declarations) {
        (self.name(), self.outline().clone())
    }
}

impl<C: Circuit> Described for C {
    fn described(&self) -> Result<Elaborated, EngineError> {
        Elaborated::new(self)
    }
    fn outlined(&self) -> (&'static str, Declarations) {
        (self.name(), Declarations::of(self))
    }
}

/// Elaborated circuit with its type erased: the input of waves, charts, Verilog and random runs.
#[derive(Clone)]
pub struct Elaborated {
    name: &'static str,
    about: &'static str,
    design: Arc<Design>,
    flat: Arc<Flat>,
    /// Makes the declarations on demand: the names of all memory words take as long as the rest of
    /// a circuit, and a plain run needs none.
    declare: Declare,
    /// Signals without their power-on values.
    outline: OnceLock<Arc<Declarations>>,
    declarations: OnceLock<Arc<Declarations>>,
}

/// Function that makes the signals of a circuit, without their power-on values.
pub(crate) type Declare = Arc<dyn Fn() -> Declarations + Send + Sync>;

impl fmt::Debug for Elaborated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Elaborated")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Elaborated {
    /// Elaborates a circuit.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn new<C: Circuit>(circuit: &C) -> Result<Elaborated, EngineError> {
        let declared = circuit.clone();
        Elaborated::made(
            (circuit.name(), circuit.about()),
            elaborate(circuit)?,
            Arc::new(move || declarations(&declared, &mut |_| {})),
        )
    }

    /// Elaborates a circuit with signals beside it.
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn with_beside<C: Circuit, B: Beside>(
        circuit: &C,
        beside: &B,
    ) -> Result<Elaborated, EngineError> {
        let signals = |beside: &B, source: &mut dyn Source| {
            B::Signals::<Shapes>::make(beside, const { &scope::<B>() }, source);
        };
        let declared = (circuit.clone(), beside.clone());
        Elaborated::made(
            (circuit.name(), circuit.about()),
            with_inputs(circuit, &mut |source| signals(beside, source))?,
            Arc::new(move || declarations(&declared.0, &mut |source| signals(&declared.1, source))),
        )
    }

    /// Returns the circuit of a name and a description, modules, and the function that makes the
    /// signals.
    fn made(
        (name, about): (&'static str, &'static str),
        design: Design,
        declare: Declare,
    ) -> Result<Elaborated, EngineError> {
        Ok(Elaborated {
            name,
            about,
            flat: Arc::new(Flat::of(&design)?),
            design: Arc::new(design),
            declare,
            outline: OnceLock::new(),
            declarations: OnceLock::new(),
        })
    }

    /// Returns the circuit with one of its statements always true.
    #[cfg(test)]
    pub(crate) fn without(&self, statement: usize) -> Result<Elaborated, EngineError> {
        let mut design = (*self.design).clone();
        if let Some(module) = design.modules.last_mut() {
            module.nodes.push((Node::Constant(1), BIT));
            module.assertions[statement].holds = module.nodes.len() - 1;
        }
        Elaborated::made((self.name, self.about), design, self.declare.clone())
    }

    /// Returns the circuit's name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the one-line description.
    pub fn about(&self) -> &'static str {
        self.about
    }

    /// Returns the modules.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Returns the statements about the circuit, in the order of its properties.
    pub(crate) fn stated(&self) -> &[Assertion] {
        let whole = self.design.modules.last();
        whole.map_or(&[], |whole| &whole.assertions)
    }

    /// Returns the signals in the order of the leaves; power-on values are left at 0.
    pub fn outline(&self) -> &Declarations {
        self.outline.get_or_init(|| Arc::new((self.declare)()))
    }

    /// Returns the circuit as one flat netlist.
    pub(crate) fn flat(&self) -> &Flat {
        &self.flat
    }

    /// Returns the circuit with the statements of its parts as properties too, in this order: see
    /// [`Flat::with_parts`].
    pub(crate) fn with_parts(&self) -> Result<(Elaborated, Vec<Statement>), EngineError> {
        let (flat, statements) = Flat::with_parts(&self.design)?;
        let flat = Arc::new(flat);
        Ok((
            Elaborated {
                flat,
                ..self.clone()
            },
            statements,
        ))
    }

    /// Returns the signals, in the order of the leaves of its [`engine`](Self::engine), with their
    /// power-on values.
    pub fn declarations(&self) -> &Declarations {
        self.declarations.get_or_init(|| {
            let mut declarations = self.outline().clone();
            let mut engine = self.engine(Watch::All);
            engine.settle();
            for (leaf, declaration) in declarations.leaves.iter_mut().enumerate() {
                declaration.power_on = engine.word(leaf);
            }
            Arc::new(declarations)
        })
    }

    /// Creates an engine in the power-on state, with all input ports low.
    pub fn engine(&self, watch: Watch<'_>) -> Engine {
        Engine::new(self.program(watch))
    }

    /// Plans the circuit.
    pub(crate) fn program(&self, watch: Watch<'_>) -> Arc<Program> {
        self.program_with(watch, &[])
    }

    /// Plans the circuit; idle ticks also end when one of the leaves `seen` changes.
    pub(crate) fn program_with(&self, watch: Watch<'_>, seen: &[usize]) -> Arc<Program> {
        let mut held = ports_out(&self.design);
        held.extend(seen);
        Arc::new(Program::planned(&self.flat, watch, &held))
    }

    /// Returns the leaves that are output ports.
    pub fn ports_out(&self) -> Vec<usize> {
        ports_out(&self.design)
    }

    /// Returns the input ports.
    pub(crate) fn ports(&self) -> Ports {
        Ports::of(&self.design, &self.declare)
    }

    /// Returns the number of the circuit's own nets, without those of the circuits inside it.
    pub(crate) fn own_nets(&self) -> usize {
        let modules = &self.design.modules;
        modules.last().map_or(0, |whole| whole.own_nets(modules))
    }

    /// Returns the leaves of a part of the circuit.
    pub(crate) fn leaves(&self, role: Role) -> std::ops::Range<usize> {
        self.flat.part(role)
    }
}
