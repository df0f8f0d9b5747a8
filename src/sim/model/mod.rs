//! A running circuit whose type is erased.

mod access;
mod error;
mod handle;
mod names;
mod play;
mod replay;
mod run;
mod snapshot;
mod tap;
mod watched;

pub use error::ModelError;
pub use handle::{Handle, SignalRef};
pub use names::{PortDirection, SignalInfo};
pub use snapshot::Snapshot;
pub(crate) use tap::Tap;

use super::ports::Ports;
use super::{Described, Elaborated};
use crate::engine::{Engine, Program, Watch};
use names::Names;
use rustc_hash::FxHasher;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, OnceLock};

/// A running circuit whose signals have names: the model for benches, scripts and other languages.
///
/// [`Model::new`] makes a circuit of the catalogue, [`Model::of`] any circuit. In tick n input
/// ports are [set](Self::set), nets settle, and all signals can be [read](Self::get). Then
/// [`step`](Self::step) makes the registers of tick n + 1. A [`Simulator`](super::Simulator) is a
/// model together with the circuit's types.
///
/// A signal is given by its name or by a [`Handle`], which costs no search. Names are paths below
/// the circuit (`rates.scan_period`), as in the waves, or those in its Verilog
/// (`rates_scan_period`). A word of a memory is `memory[3]`.
///
/// ```
/// use motion_rtl::Model;
///
/// let mut counter = Model::new("enable_counter", &["width=8".parse()?])?;
/// counter.set("period", 4)?;
/// let enable = counter.find("enable")?;
/// for tick in 0..12 {
///     assert_eq!(counter.get(enable)?, u64::from(tick % 4 == 3));
///     counter.step();
/// }
///
/// let wrong = counter.set("period", 256).unwrap_err();
/// assert_eq!(
///     wrong.to_string(),
///     "tick 12: port in period: 256 does not fit; allowed are 0 to 255"
/// );
/// let unknown = counter.find("enabel").unwrap_err();
/// assert_eq!(unknown.to_string(), "enable_counter has no signal enabel; near it: enable");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Only output ports are watched. Reading another net computes all nets of the tick; after some
/// such reads the model watches that net too. [`watch`](Self::watch) does so at once. While
/// [waves](Self::waves_to) are written, all signals are watched.
pub struct Model {
    engine: Engine,
    tick: u64,
    settled: bool,
    circuit: Arc<Interface>,
    /// Leaves watched beside the output ports.
    watched: Vec<usize>,
    /// Reads that computed all nets since the circuit was last planned.
    costly: u32,
    tap: Option<Box<dyn Tap>>,
    /// Engine for the time after the tap, which needs all leaves.
    narrow: Option<Box<Engine>>,
}

/// Properties of a circuit that all its models share.
struct Interface {
    elaborated: Elaborated,
    ports: Ports,
    ports_out: Vec<usize>,
    /// Mark of the handles.
    mark: u32,
    names: OnceLock<Names>,
    /// Program that watches all leaves.
    all: OnceLock<Arc<Program>>,
}

impl fmt::Debug for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Model")
            .field("circuit", &self.name())
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

impl Interface {
    fn of(elaborated: &Elaborated) -> Self {
        let flat = elaborated.flat();
        let mut mark = FxHasher::default();
        elaborated.name().hash(&mut mark);
        (&flat.inputs, flat.leaves.len(), flat.parts).hash(&mut mark);
        for register in &flat.registers {
            mark.write_u8(register.width);
        }
        Interface {
            elaborated: elaborated.clone(),
            ports: elaborated.ports(),
            ports_out: elaborated.ports_out(),
            mark: (mark.finish() >> 32) as u32,
            names: OnceLock::new(),
            all: OnceLock::new(),
        }
    }

    fn names(&self) -> &Names {
        let names = || Names::of(self.elaborated.outline());
        self.names.get_or_init(names)
    }

    /// Returns the path of a leaf below the circuit.
    fn path(&self, leaf: usize) -> String {
        let leaves = &self.elaborated.outline().leaves;
        leaves.get(leaf).map_or(leaf.to_string(), names::path)
    }
}

impl Model {
    /// Creates a circuit in the power-on state, before tick 0, with all input ports low.
    ///
    /// ```
    /// use motion_rtl::Model;
    /// use motion_rtl::circuits::blocks::EnableCounter;
    ///
    /// let mut counter = Model::of(&EnableCounter { width: 8 })?;
    /// counter.set("period", 10)?;
    /// counter.run(9);
    /// assert_eq!(counter.get("enable")?, 1);
    /// # Ok::<(), motion_rtl::sim::ModelError>(())
    /// ```
    ///
    /// # Errors
    /// Returns all mistakes of the circuit.
    pub fn of(circuit: &impl Described) -> Result<Self, ModelError> {
        Ok(Model::ports_watched(&circuit.described()?))
    }

    /// Creates an elaborated circuit of which the output ports are watched.
    pub(crate) fn ports_watched(elaborated: &Elaborated) -> Self {
        let ports = elaborated.ports_out();
        Model::watching(elaborated, Watch::Leaves(&ports), &[])
    }

    /// Creates an elaborated circuit of which these leaves are watched; idle ticks also end when
    /// one of the leaves `seen` changes.
    pub(super) fn watching(elaborated: &Elaborated, watch: Watch<'_>, seen: &[usize]) -> Self {
        Model {
            engine: Engine::new(elaborated.program_with(watch, seen)),
            tick: 0,
            settled: false,
            circuit: Arc::new(Interface::of(elaborated)),
            watched: Vec::new(),
            costly: 0,
            tap: None,
            narrow: None,
        }
    }

    /// Returns the circuit's name.
    pub fn name(&self) -> &'static str {
        self.circuit.elaborated.name()
    }

    /// Returns the elaborated circuit.
    pub fn elaborated(&self) -> &Elaborated {
        &self.circuit.elaborated
    }

    /// Returns the number of this tick, from 0.
    #[inline]
    pub fn tick(&self) -> u64 {
        self.tick
    }

    #[inline]
    pub(super) fn engine(&self) -> &Engine {
        &self.engine
    }

    #[inline]
    pub(super) fn engine_mut(&mut self) -> &mut Engine {
        &mut self.engine
    }

    #[inline]
    pub(super) fn ports(&self) -> &Ports {
        &self.circuit.ports
    }
}
