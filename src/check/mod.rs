//! Exhaustive proofs, shortest counterexamples, comparison of two circuits.
//!
//! [`reach()`] visits every state that a circuit can reach from power-on under any input, and checks
//! [`Invariants`] on every transition. At widths small enough for that to finish, it proves them
//! for all input sequences of any length. [`sweep()`] checks a [`Law`] on every case of a finite
//! space, for words that are too wide for that; it evaluates many cases at once. [`induct()`]
//! proves the properties that a circuit states in its own words at any width, by a SAT solver.
//! [`Monitor`] checks the same invariants along a simulated run, at any width. [`Pair`] and
//! [`Lockstep`] turn the equivalence of two circuits into such an invariant. [`drive()`] runs a
//! circuit on a random [`Stimulus`] and writes waves and stimulus, to compare it with another
//! implementation such as its Verilog; [`Coverage`] tells which bits that run has moved.
//!
//! # State of the past
//!
//! An invariant sees one transition. A property of the past ("two ticks of `unit_rst` are never
//! adjacent") needs memory: a circuit that contains the circuit under test and ghost registers
//! beside it, which no hardware will have.
//!
//! ```
//! use motion_rtl::circuits::blocks::{EnableCounter, enable_counter};
//! use motion_rtl::prelude::*;
//!
//! /// A counter, and whether it pulsed a tick ago.
//! #[derive(Debug, Clone)]
//! struct WithGhost;
//!
//! signals! { for WithGhost as _c;
//!     struct In { period: U(3) }
//!     struct Reg { enable_before: Bit }
//!     struct Parts { counter: Part<EnableCounter>(EnableCounter { width: 3 }) }
//! }
//!
//! impl Circuit for WithGhost {
//!     const NAME: &'static str = "with_ghost";
//!     const ABOUT: &'static str = "remembers the last pulse";
//!     records!(In, Reg, Nothing, Parts);
//!
//!     fn tick(&self, i: In, _: Reg, p: Parts) -> (Nothing, Reg<Edge>) {
//!         let counter = p.counter.settle(enable_counter::In { period: i.period });
//!         (Nothing, Reg { enable_before: counter.w.enable })
//!     }
//! }
//!
//! let invariants = Invariants::<WithGhost>::new().always("pulses stand alone", |now| {
//!     let adjacent = now.q.enable_before && now.p.counter.w.enable;
//!     require(!adjacent, ["counter.enable", "enable_before"], || "two pulses side by side".into())
//! });
//!
//! // With a period of 0 or 1 it pulses on every tick: found at tick 1, the earliest possible …
//! let found = reach(&WithGhost, &invariants).run()?;
//! let found = found.counterexample().expect("a period of 1 violates it");
//! assert_eq!((found.tick, found.inputs.len()), (1, 2));
//!
//! // … and with longer periods never, whatever the sequence of periods.
//! let outcome = reach(&WithGhost, &invariants).assume(|_, i| i.period >= 2).run()?;
//! assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
//! # Ok::<(), motion_rtl::check::CheckError>(())
//! ```

mod batches;
mod blamed;
mod cases;
mod counterexample;
mod coverage;
mod drive;
mod enumerate;
mod induct;
mod invariant;
mod lockstep;
#[cfg(test)]
mod mutated;
mod pair;
mod reach;
mod records;
mod search;
mod searching;
mod specified;
mod states;
mod stimulus;
mod sweep;
mod visited;

pub use blamed::UnknownSignal;
pub(crate) use counterexample::stem;
pub use counterexample::{Counterexample, Violation};
pub use coverage::{Coverage, Untoggled};
pub use drive::{Drive, Driven, drive, play};
pub use enumerate::{CheckError, Random, TooWide, all};
pub use induct::{By, Clause, Concluded, Conclusion, Induct, InductError, NotInductive, induct};
pub(crate) use induct::{ThreadTime, conclude};
pub use invariant::{Fault, Invariants, Monitor, Verdict, require};
pub use lockstep::{Lockstep, LockstepError};
pub use pair::{Pair, PairIn, Sides};
pub use reach::{Outcome, Progress, Proof, Reach, prove, reach};
pub use specified::Specified;
pub use stimulus::Stimulus;
pub use sweep::{Law, Sweep, Swept, cases, sweep};
