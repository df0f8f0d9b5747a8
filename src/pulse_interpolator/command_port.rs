//! Command port: where the control computer 2 leaves its next command (¶0018, ¶0026).
//!
//! ```text
//!                ┌──────────────┐
//!  valid ───────▶│              ├──▶ ready
//!  base, last, ─▶│ command port ├──▶ pending
//!  cyclic, run, ▶│              ├──▶ pending_base, pending_last, …
//!  now, period ─▶│              │
//!  take ────────▶│              │
//!                └──────────────┘
//! ```
//!
//! One command waits until the address sequencer takes it. A command is accepted in a tick in
//! which the port is ready; one with `now` is always accepted and replaces the one that waits. It
//! can be taken from the next tick on: a command given in the tick of RST is for the RST after.
//!
//! Departures: the text says only that the read address is switched by command. With power-on
//! contents the port starts a pattern by itself: the free-running operation of ¶0032.

use super::Pattern;
use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Sim};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const T: usize> {
        /// A command is given.
        pub valid: L::Bit,
        /// First address of the pattern.
        pub base: L::U<A> as Hex,
        /// Last address of the pattern.
        pub last: L::U<A> as Hex,
        /// The pattern starts again after its last word.
        pub cyclic: L::Bit,
        /// Starts a pattern; low: stops the one that runs.
        pub run: L::Bit,
        /// At the next RST; low: at the RST that ends the pattern that runs.
        pub now: L::Bit,
        /// Unit time from that RST on, in ticks.
        pub period: L::U<T>,
        /// The waiting command is taken with this tick.
        pub take: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const A: usize, const T: usize> {
        /// A command waits.
        pub pending: L::Bit = 0,
        /// First address of its pattern.
        pub pending_base: L::U<A> as Hex = 0,
        /// Last address of its pattern.
        pub pending_last: L::U<A> as Hex = 0,
        /// Its pattern starts again after its last word.
        pub pending_cyclic: L::Bit = 0,
        /// It starts a pattern.
        pub pending_run: L::Bit = 0,
        /// It does not wait for the end of a pattern.
        pub pending_now: L::Bit = 0,
        /// Its unit time in ticks.
        pub pending_period: L::U<T> = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// A command without `now` would be accepted.
        pub ready: L::Bit,
        /// A command is accepted.
        accept: L::Bit,
    }
}

/// Command port of the control computer 2, one command deep.
#[derive(Debug, Clone, Default)]
pub struct CommandPort<const A: usize, const T: usize> {
    /// The pattern that starts without a command at the first RST after power-on.
    pub free_running: Option<Pattern>,
}

impl<const A: usize, const T: usize> Circuit for CommandPort<A, T> {
    const NAME: &'static str = "command_port";
    const ABOUT: &'static str = "holds the control computer's next command until it is taken";
    type In<L: Logic> = In<L, A, T>;
    type Reg<L: Logic> = Reg<L, A, T>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, T>, i: &In<L, A, T>) -> Net<L> {
        Net {
            ready: !q.pending,
            accept: i.valid & (!q.pending | i.now),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, A, T>, w: &Net<L>, i: &In<L, A, T>) -> Reg<L, A, T> {
        Reg {
            pending: w.accept | (q.pending & !i.take),
            pending_base: w.accept.mux(i.base, q.pending_base),
            pending_last: w.accept.mux(i.last, q.pending_last),
            pending_cyclic: w.accept.mux(i.cyclic, q.pending_cyclic),
            pending_run: w.accept.mux(i.run, q.pending_run),
            pending_now: w.accept.mux(i.now, q.pending_now),
            pending_period: w.accept.mux(i.period, q.pending_period),
        }
    }

    fn power_on(&self) -> Reg<Sim, A, T> {
        let pattern = self.free_running.unwrap_or(Pattern {
            base: 0,
            last: 0,
            cyclic: false,
            period: 0,
        });
        Reg {
            pending: self.free_running.is_some().into(),
            pending_base: pattern.base.into(),
            pending_last: pattern.last.into(),
            pending_cyclic: pattern.cyclic.into(),
            pending_run: self.free_running.is_some().into(),
            pending_now: false.into(),
            pending_period: pattern.period.into(),
        }
    }
}

impl<const A: usize, const T: usize> Specified for CommandPort<A, T> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "a command given to a ready port, or with now, waits as it was given",
                |now, next| {
                    let accepted = now.i.valid.get() && (now.w.ready.get() || now.i.now.get());
                    let there = next.pending.get()
                        && next.pending_base == now.i.base
                        && next.pending_last == now.i.last
                        && next.pending_cyclic == now.i.cyclic
                        && next.pending_run == now.i.run
                        && next.pending_now == now.i.now
                        && next.pending_period == now.i.period;
                    require(
                        !accepted || there,
                        ["pending", "pending_base", "pending_last"],
                        || "not stored".into(),
                    )
                },
            )
            .step(
                "a waiting command stays until it is taken or replaced",
                |now, next| {
                    let replaced = now.i.valid.get() && now.i.now.get();
                    let stays = now.q.pending.get() && !replaced;
                    let same = next.pending_base == now.q.pending_base
                        && next.pending_last == now.q.pending_last
                        && next.pending_cyclic == now.q.pending_cyclic
                        && next.pending_run == now.q.pending_run
                        && next.pending_now == now.q.pending_now
                        && next.pending_period == now.q.pending_period;
                    let held = same && next.pending.get() != now.i.take.get();
                    require(
                        !stays || held,
                        ["pending", "pending_base", "pending_last"],
                        || "lost or altered".into(),
                    )
                },
            )
            .step("no command comes by itself", |now, next| {
                let none = !now.q.pending.get() && !now.i.valid.get();
                require(!none || !next.pending.get(), ["pending"], || {
                    "a command".into()
                })
            })
            .always("ready means that none waits", |now| {
                require(now.w.ready.get() != now.q.pending.get(), ["ready"], || {
                    "both".into()
                })
            })
    }
}
