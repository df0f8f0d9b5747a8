//! Choice of the backend: the interpreter at first, which counts block runs, and compiled code
//! once the run is long enough to pay.

#[cfg(feature = "jit")]
use super::compiler::{Code, CompileError};
use super::interpreter::{self, Counts};
use super::plan::{Block, Plan};
use super::replay::Replay;
#[cfg(not(any(feature = "jit", all(feature = "wasm", target_family = "wasm"))))]
use super::uncompiled::{Code, CompileError};
#[cfg(all(feature = "wasm", target_family = "wasm", not(feature = "jit")))]
use super::wasm::{Code, CompileError};
use std::sync::{Arc, OnceLock};

/// Average number of times each step is interpreted before compiling: the cost of compiling a step
/// in interpreted steps.
const PAYS: u64 = 600;
/// Cost of an interpreted step, in compiled steps.
const INTERPRETED: u64 = 6;
/// Least number of ticks in which blocks are counted.
const COUNTED: u64 = 256;

/// True if there is a compiler.
const COMPILES: bool = cfg!(any(
    feature = "jit",
    all(feature = "wasm", target_family = "wasm")
));

/// Backend with its statistics.
#[derive(Debug, Clone)]
pub(super) struct Tier {
    backend: Backend,
    counts: Counts,
    ticks: u64,
    /// Number of interpreted steps after which the circuit is compiled.
    due: u64,
    /// Cost of a tick, in compiled steps.
    pace: u64,
    /// Blocks that are inlined.
    hot: Arc<[bool]>,
    /// Code that one of all clones has compiled.
    shared: Arc<OnceLock<Compiled>>,
}

/// Backend, its inlined blocks, and the cost of a tick.
type Compiled = (Backend, Arc<[bool]>, u64);

#[derive(Debug, Clone)]
enum Backend {
    Interpreter,
    Code(Arc<Code>),
}

impl Tier {
    pub fn new(plan: &Plan) -> Self {
        let steps: u64 = plan.blocks.iter().map(Block::cost).sum();
        Tier {
            backend: Backend::Interpreter,
            counts: vec![0; plan.blocks.len()],
            ticks: 0,
            pace: INTERPRETED * steps,
            due: match COMPILES {
                true => steps * PAYS,
                false => u64::MAX,
            },
            hot: vec![false; plan.blocks.len()].into(),
            shared: Arc::default(),
        }
    }

    /// Takes over the code of a clone in place of the interpreter, unless this tier never compiles.
    ///
    /// Code is not exchanged for other code, which may leave out the bits of other blocks.
    pub fn adopt(&mut self) {
        if self.due != u64::MAX
            && !self.is_compiled()
            && let Some((backend, hot, pace)) = self.shared.get()
        {
            (self.backend, self.hot, self.pace) = (backend.clone(), hot.clone(), *pace);
        }
    }

    /// Stays on the interpreter from here on.
    pub fn interpret(&mut self) {
        self.backend = Backend::Interpreter;
        self.due = u64::MAX;
    }

    /// True if there is compiled code.
    pub fn is_compiled(&self) -> bool {
        !matches!(self.backend, Backend::Interpreter)
    }

    /// True if it stays on the interpreter.
    pub fn is_interpreted(&self) -> bool {
        self.due == u64::MAX && !self.is_compiled()
    }

    /// Compiles at once with all blocks inlined; returns true if there is code.
    pub fn straight(&mut self, plan: &Plan) -> bool {
        self.compile(plan, vec![true; plan.blocks.len()]);
        self.is_compiled()
    }

    /// Returns the cost of some steps, in compiled ones.
    pub fn cost(&self, steps: u64) -> u64 {
        match &self.backend {
            Backend::Interpreter => INTERPRETED * steps,
            Backend::Code(_) => steps,
        }
    }

    /// Returns the cost of a tick, in compiled steps.
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
            Backend::Code(code) => code.settle(slab),
        }
    }

    pub fn edge(&mut self, plan: &Plan, slab: &mut [u64]) {
        match &self.backend {
            Backend::Interpreter => {
                interpreter::edge(plan, slab, &mut self.counts);
                self.tick(plan);
            }
            Backend::Code(code) => code.edge(slab),
        }
    }

    /// Makes up to `ticks` edges, each with a settling; may stop earlier. Returns the number of
    /// ticks.
    pub fn advance(&mut self, plan: &Plan, slab: &mut [u64], ticks: u64) -> u64 {
        match &self.backend {
            Backend::Interpreter => {
                self.edge(plan, slab);
                self.settle(plan, slab);
                1
            }
            Backend::Code(code) => code.advance(slab, ticks),
        }
    }

    /// Continues a replay up to its stop or its end, or until its rows are full.
    pub fn replay(&mut self, plan: &Plan, slab: &mut [u64], replay: &mut Replay<'_>) {
        while !replay.is_at_stop() && !replay.is_full() {
            #[cfg(feature = "jit")]
            if let Backend::Code(code) = &self.backend {
                return code.replay(slab, replay);
            }
            match (replay.settled, replay.steady()) {
                (true, 0) => {
                    self.edge(plan, slab);
                    replay.tick += 1;
                    replay.settled = false;
                }
                (true, ticks) => {
                    replay.tick += self.advance(plan, slab, ticks);
                    replay.show(&plan.layout, slab);
                }
                (false, _) => {
                    replay.drive(&plan.layout, slab);
                    self.settle(plan, slab);
                    replay.settled = true;
                    replay.show(&plan.layout, slab);
                }
            }
        }
    }

    /// Counts an interpreted tick.
    fn tick(&mut self, plan: &Plan) {
        self.ticks += 1;
        // Checked rarely: the sum takes longer than some ticks.
        if self.due == u64::MAX || !self.ticks.is_multiple_of(COUNTED) {
            return;
        }
        self.adopt();
        if self.is_compiled() {
            return;
        }
        let steps = plan.blocks.iter().map(Block::cost);
        let counted = self.counts.iter().zip(steps);
        let work: u64 = counted.map(|(count, steps)| count * steps).sum();
        self.pace = INTERPRETED * work / self.ticks;
        if work >= self.due {
            self.compile_now(plan);
        }
    }

    /// Compiles with the blocks inlined that ran in most ticks; returns true if there is code.
    pub fn compile_now(&mut self, plan: &Plan) -> bool {
        self.adopt();
        if !self.is_compiled() {
            let often = |count: &u64| 2 * count > self.ticks;
            self.compile(plan, self.counts.iter().map(often).collect());
        }
        self.is_compiled()
    }

    fn compile(&mut self, plan: &Plan, hot: Vec<bool>) {
        match Code::compile(plan, &hot) {
            Ok(code) => {
                self.backend = Backend::Code(Arc::new(code));
                self.hot = hot.into();
                self.pace /= INTERPRETED;
                // The first one is kept if another clone was as fast.
                let _ = self
                    .shared
                    .set((self.backend.clone(), self.hot.clone(), self.pace));
            }
            Err(error) => {
                if std::mem::replace(&mut self.due, u64::MAX) != u64::MAX {
                    say(&error);
                }
            }
        }
    }
}

/// Prints one warning that circuits are interpreted.
fn say(error: &CompileError) {
    static SAID: std::sync::Once = std::sync::Once::new();
    SAID.call_once(|| {
        eprintln!("warning: circuits are interpreted, which takes longer: {error}");
    });
}
