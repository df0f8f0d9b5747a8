//! Elaborated circuits.

use super::ports::Ports;
use super::{Circuit, Declarations, Role, netlist::Design};
use crate::engine::{Engine, EngineError, Flat, Program, Watch, ports_out};
use std::fmt;
use std::sync::{Arc, OnceLock};

/// What a [`Model`] can be made of: a circuit, or a model.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no circuit",
    note = "a `Circuit` or an elaborated `Model` is wanted, by reference: `&circuit`"
)]
pub trait Described {
    /// The circuit elaborated.
    ///
    /// # Errors
    /// All that is wrong with it.
    fn described(&self) -> Result<Model, EngineError>;
    /// Its name and its signals; what they are at power-on is left at 0.
    fn outlined(&self) -> (&'static str, Declarations);
}

impl Described for Model {
    fn described(&self) -> Result<Model, EngineError> {
        Ok(self.clone())
    }
    fn outlined(&self) -> (&'static str, Declarations) {
        (self.name(), self.outline().clone())
    }
}

impl<C: Circuit> Described for C {
    fn described(&self) -> Result<Model, EngineError> {
        super::model(self)
    }
    fn outlined(&self) -> (&'static str, Declarations) {
        (self.name(), Declarations::of(self))
    }
}

/// A circuit that is elaborated, its type forgotten: what waves, charts, Verilog and random runs
/// are made of.
#[derive(Clone)]
pub struct Model {
    name: &'static str,
    about: &'static str,
    design: Arc<Design>,
    flat: Arc<Flat>,
    /// Names of all words of memories take as long as the rest of a circuit, and who only runs it
    /// wants none.
    declare: Declare,
    /// The signals without what they are at power-on.
    outline: OnceLock<Arc<Declarations>>,
    declarations: OnceLock<Arc<Declarations>>,
}

/// Makes the signals of a circuit, without what they are at power-on.
pub(crate) type Declare = Arc<dyn Fn() -> Declarations + Send + Sync>;

impl fmt::Debug for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Model")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Model {
    /// Of a circuit that is elaborated: its name and what it does, its modules, what makes its
    /// signals.
    pub(crate) fn new(
        (name, about): (&'static str, &'static str),
        design: Design,
        declare: Declare,
    ) -> Result<Model, EngineError> {
        Ok(Model {
            name,
            about,
            flat: Arc::new(Flat::of(&design)?),
            design: Arc::new(design),
            declare,
            outline: OnceLock::new(),
            declarations: OnceLock::new(),
        })
    }

    /// The circuit's name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What it does, in one line.
    pub fn about(&self) -> &'static str {
        self.about
    }

    /// Its modules.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// Its signals, in the order of its leaves; what they are at power-on is left at 0.
    pub(crate) fn outline(&self) -> &Declarations {
        self.outline.get_or_init(|| Arc::new((self.declare)()))
    }

    /// It as one netlist.
    pub(crate) fn flat(&self) -> &Flat {
        &self.flat
    }

    /// Its signals, in the order of the leaves of its [`engine`](Self::engine), with what they are
    /// at power-on.
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

    /// It ready to run, at power-on with all ports in low.
    pub fn engine(&self, watch: Watch<'_>) -> Engine {
        Engine::new(self.program(watch))
    }

    /// It planned.
    pub(crate) fn program(&self, watch: Watch<'_>) -> Arc<Program> {
        self.program_with(watch, &[])
    }

    /// It planned, where idle ticks leave not only ports out as they are, but these leaves too.
    pub(crate) fn program_with(&self, watch: Watch<'_>, seen: &[usize]) -> Arc<Program> {
        let mut held = ports_out(&self.design);
        held.extend(seen);
        Arc::new(Program::planned(&self.flat, watch, &held))
    }

    /// The leaves that are ports out.
    pub fn ports_out(&self) -> Vec<usize> {
        ports_out(&self.design)
    }

    /// Its ports in.
    pub(crate) fn ports(&self) -> Ports {
        Ports::of(&self.design, &self.declare)
    }

    /// How many of its nets are its own, and not of a circuit inside it.
    pub(crate) fn own_nets(&self) -> usize {
        let modules = &self.design.modules;
        modules.last().map_or(0, |whole| whole.own_nets(modules))
    }

    /// The leaves of a part of the whole.
    pub(crate) fn leaves(&self, role: Role) -> std::ops::Range<usize> {
        self.flat.part(role)
    }
}
