//! Which backend runs: the interpreter at first, which counts how often each block runs, and
//! compiled code once it has run for long enough to pay.

#[cfg(feature = "jit")]
use super::compiler::Code;
use super::interpreter::{self, Counts};
use super::plan::Plan;
use std::sync::{Arc, OnceLock};

/// How often all of a circuit's steps, on average, are interpreted before it is compiled: compiling
/// takes so many times as long as interpreting.
const PAYS: u64 = 600;
/// How many compiled steps take as long as one that is interpreted.
const INTERPRETED: u64 = 6;
/// Ticks in which blocks are counted at least.
const COUNTED: u64 = 256;

/// A backend, and what it knows of the circuit.
#[derive(Debug, Clone)]
pub(super) struct Tier {
    backend: Backend,
    counts: Counts,
    ticks: u64,
    /// Steps interpreted after which it is compiled.
    due: u64,
    /// Compiled steps that take as long as a tick.
    pace: u64,
    /// The blocks compiled in line.
    hot: Arc<[bool]>,
    /// What one of all clones has compiled.
    shared: Arc<OnceLock<Compiled>>,
}

/// A backend with the blocks that are in line of it.
type Compiled = (Backend, Arc<[bool]>, u64);

#[derive(Debug, Clone)]
enum Backend {
    Interpreter,
    #[cfg(feature = "jit")]
    Code(Arc<Code>),
}

impl Tier {
    pub fn new(plan: &Plan) -> Self {
        let steps: usize = plan.blocks.iter().map(|block| block.steps.len() + 8).sum();
        Tier {
            backend: Backend::Interpreter,
            counts: vec![0; plan.blocks.len()],
            ticks: 0,
            pace: INTERPRETED * steps as u64,
            due: if cfg!(feature = "jit") {
                steps as u64 * PAYS
            } else {
                u64::MAX
            },
            hot: vec![false; plan.blocks.len()].into(),
            shared: Arc::default(),
        }
    }

    /// Takes over what a clone has compiled, if this one is to be compiled at all.
    pub fn adopt(&mut self) {
        if self.due != u64::MAX
            && let Some((backend, hot, pace)) = self.shared.get()
        {
            (self.backend, self.hot, self.pace) = (backend.clone(), hot.clone(), *pace);
        }
    }

    /// Never compiles.
    pub fn interpret(&mut self) {
        self.backend = Backend::Interpreter;
        self.due = u64::MAX;
    }

    /// Compiles at once, all blocks in line; whether it could.
    pub fn straight(&mut self, plan: &Plan) -> bool {
        self.compile(plan, vec![true; plan.blocks.len()]);
        !matches!(self.backend, Backend::Interpreter)
    }

    /// How long a tick takes, in compiled steps.
    pub fn pace(&self) -> u64 {
        self.pace
    }

    pub fn hot(&self) -> &[bool] {
        &self.hot
    }

    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    pub fn settle(&mut self, plan: &Plan, slab: &mut [u64]) {
        match &self.backend {
            Backend::Interpreter => interpreter::settle(plan, slab, &mut self.counts),
            #[cfg(feature = "jit")]
            Backend::Code(code) => code.settle(slab),
        }
    }

    pub fn edge(&mut self, plan: &Plan, slab: &mut [u64]) {
        match &self.backend {
            Backend::Interpreter => {
                interpreter::edge(plan, slab, &mut self.counts);
                self.tick(plan);
            }
            #[cfg(feature = "jit")]
            Backend::Code(code) => code.edge(slab),
        }
    }

    /// Edge and settling, up to so many times; ends earlier where it likes. Returns how often.
    pub fn advance(&mut self, plan: &Plan, slab: &mut [u64], ticks: u64) -> u64 {
        let _ = ticks;
        match &self.backend {
            Backend::Interpreter => {
                self.edge(plan, slab);
                self.settle(plan, slab);
                1
            }
            #[cfg(feature = "jit")]
            Backend::Code(code) => code.advance(slab, ticks),
        }
    }

    /// A tick was interpreted.
    fn tick(&mut self, plan: &Plan) {
        self.ticks += 1;
        // Not in every tick: the sum takes longer than some ticks.
        if self.due == u64::MAX || !self.ticks.is_multiple_of(COUNTED) {
            return;
        }
        let steps = plan.blocks.iter().map(|block| block.steps.len() as u64 + 8);
        let counted = self.counts.iter().zip(steps);
        let work: u64 = counted.map(|(count, steps)| count * steps).sum();
        self.pace = INTERPRETED * work / self.ticks;
        if work >= self.due {
            self.compile_now(plan);
        }
    }

    /// Compiles with the blocks in line that have run in most ticks; whether there is code.
    pub fn compile_now(&mut self, plan: &Plan) -> bool {
        if matches!(self.backend, Backend::Interpreter) {
            let often = |count: &u64| 2 * count > self.ticks;
            self.compile(plan, self.counts.iter().map(often).collect());
        }
        !matches!(self.backend, Backend::Interpreter)
    }

    #[cfg(feature = "jit")]
    fn compile(&mut self, plan: &Plan, hot: Vec<bool>) {
        match Code::compile(plan, &hot) {
            Ok(code) => {
                self.backend = Backend::Code(Arc::new(code));
                self.hot = hot.into();
                self.pace /= INTERPRETED;
                // The first one stays, if another was as fast.
                let _ = self
                    .shared
                    .set((self.backend.clone(), self.hot.clone(), self.pace));
            }
            Err(error) => {
                self.due = u64::MAX;
                say(&error);
            }
        }
    }

    #[cfg(not(feature = "jit"))]
    fn compile(&mut self, _: &Plan, _: Vec<bool>) {}
}

/// Says once why runs are slow.
#[cfg(feature = "jit")]
fn say(error: &super::compiler::CompileError) {
    static SAID: std::sync::Once = std::sync::Once::new();
    SAID.call_once(|| {
        eprintln!("warning: circuits are interpreted, which takes longer: {error}");
    });
}
