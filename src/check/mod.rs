//! Proofs by exhaustion, shortest counterexamples, comparison of two circuits.
//!
//! [`reach`] visits every state a circuit can reach from power-on under every input, and checks
//! [`Invariants`] on every transition. At the small widths at which that ends, it is a proof over
//! all input sequences of any length. [`sweep()`] checks a [`Law`] on every case of a finite space,
//! many side by side, where words are too wide for that. [`Monitor`] checks the same invariants
//! along a simulated run, at any width. [`Pair`] and [`Lockstep`] turn "these two circuits do the
//! same" into such an invariant. [`drive()`] runs a circuit on a random [`Stimulus`] and writes
//! waves and stimulus, for a comparison with another form of the circuit, its HDL say; [`Coverage`]
//! tells which bits that run has moved.
//!
//! # What is not in the state
//!
//! An invariant sees one transition. A property of the past ("two ticks of `unit_rst` are never
//! adjacent") needs a memory of the past: a circuit that contains the circuit under test and, next
//! to it, ghost registers that no hardware will have.
//!
//! ```
//! use motion_rtl::check::{Invariants, Outcome, reach, require};
//! use motion_rtl::kernel::{Circuit, Instance};
//! use motion_rtl::logic::{Bit, Logic, Unsigned};
//! use motion_rtl::signals;
//!
//! signals! { pub struct In<L> { period: L::U<3> } }
//! signals! { pub struct Reg<L> { count: L::U<3> } }
//! signals! { pub struct Net<L> { next: L::U<3>, pub unit_rst: L::Bit } }
//!
//! /// Pulses `unit_rst` every `period` ticks.
//! pub struct Counter;
//!
//! impl Circuit for Counter {
//!     const NAME: &'static str = "counter";
//!     const ABOUT: &'static str = "divides the tick";
//!     type In<L: Logic> = In<L>;
//!     type Reg<L: Logic> = Reg<L>;
//!     type Net<L: Logic> = Net<L>;
//!     fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
//!         let next = q.count + 1;
//!         Net { next, unit_rst: !next.below(i.period) }
//!     }
//!     fn next<L: Logic>(&self, _: Reg<L>, w: &Net<L>, _: &In<L>) -> Reg<L> {
//!         Reg { count: w.unit_rst.mux(0.into(), w.next) }
//!     }
//! }
//!
//! signals! { pub struct GhostReg<L> { counter: Reg<L>, rst_before: L::Bit } }
//! signals! { pub struct GhostNet<L> { counter: Instance<Counter, L> } }
//!
//! /// The counter, and whether it pulsed a tick ago.
//! struct WithGhost;
//!
//! impl Circuit for WithGhost {
//!     const NAME: &'static str = "with_ghost";
//!     const ABOUT: &'static str = "remembers the last pulse";
//!     type In<L: Logic> = In<L>;
//!     type Reg<L: Logic> = GhostReg<L>;
//!     type Net<L: Logic> = GhostNet<L>;
//!     fn comb<L: Logic>(&self, q: &GhostReg<L>, i: &In<L>) -> GhostNet<L> {
//!         GhostNet { counter: Instance::settle(&Counter, &q.counter, i.clone()) }
//!     }
//!     fn next<L: Logic>(&self, q: GhostReg<L>, w: &GhostNet<L>, _: &In<L>) -> GhostReg<L> {
//!         GhostReg { counter: w.counter.next(&Counter, q.counter), rst_before: w.counter.w.unit_rst }
//!     }
//! }
//!
//! let invariants = Invariants::<WithGhost>::new().always("pulses stand alone", |now| {
//!     let adjacent = now.q.rst_before.get() && now.w.counter.w.unit_rst.get();
//!     require(!adjacent, ["counter.unit_rst", "rst_before"], || "two pulses side by side".into())
//! });
//!
//! // With a period of 0 or 1 it pulses on every tick: found at tick 1, the earliest possible …
//! let found = reach(&WithGhost, &invariants).run()?;
//! let found = found.counterexample().expect("a period of 1 violates it");
//! assert_eq!((found.tick, found.inputs.len()), (1, 2));
//!
//! // … and with longer periods never, whatever the sequence of periods.
//! let outcome = reach(&WithGhost, &invariants)
//!     .assume(|_, i| i.period.get() >= 2)
//!     .run()?;
//! assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
//! # Ok::<(), motion_rtl::check::CheckError>(())
//! ```

mod counterexample;
mod coverage;
mod drive;
mod enumerate;
mod invariant;
mod lockstep;
mod pair;
mod reach;
mod search;
mod specified;
mod stimulus;
mod sweep;
mod visited;

pub use counterexample::Counterexample;
pub use coverage::{Coverage, Untoggled};
pub use drive::{Drive, Driven, drive};
pub use enumerate::{CheckError, Random, TooWide, all};
pub use invariant::{Fault, Invariants, Monitor, Verdict, require};
pub use lockstep::{Lockstep, LockstepError};
pub use pair::{Pair, SamePorts, Sides};
pub use reach::{Outcome, Progress, Proof, Reach, reach};
pub use specified::Specified;
pub use stimulus::Stimulus;
pub use sweep::{Law, Sweep, Swept, cases, sweep};
