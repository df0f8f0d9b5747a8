//! Command port: holds the next command of the control computer 2 (¶0018, ¶0026).
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
//! One command waits until the address sequencer takes it. The port accepts a command in every tick
//! in which it is ready. A command with `now` is always accepted and replaces the waiting one. A
//! command can be taken from the next tick on: one given in the tick of RST takes effect at the RST
//! after.
//!
//! Departures: the text says only that the read address is switched by command. With power-on
//! contents the port starts a pattern without a command: the free-running operation of ¶0032.

use super::Pattern;
use crate::prelude::*;

/// Command port of the control computer 2, one command deep.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CommandPort {
    /// Width of an address in bits.
    pub address: usize,
    /// Width of a unit time.
    pub period: usize,
    /// The pattern that starts without a command at the first RST after power-on.
    pub free_running: Option<Pattern>,
}

impl CommandPort {
    /// The pattern of the command that waits at power-on.
    fn pattern(&self) -> Pattern {
        self.free_running.unwrap_or_default()
    }
}

signals! { for CommandPort as c;
    /// Input ports.
    pub struct In {
        /// Gives the command that the ports `base` to `period` hold.
        pub valid: Bit,
        /// First address of the pattern.
        pub base: U(c.address) as Hex,
        /// Last address of the pattern.
        pub last: U(c.address) as Hex,
        /// The pattern repeats after its last word.
        pub cyclic: Bit,
        /// High: the command starts a pattern; low: it stops the running one.
        pub run: Bit,
        /// High: the command is taken at the next RST; low: at the RST that ends the running
        /// pattern.
        pub now: Bit,
        /// Unit time in ticks; applies from the RST at which the command is taken.
        pub period: U(c.period),
        /// The waiting command is taken at the end of this tick.
        pub take: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// A command is waiting.
        pub pending: Bit = c.free_running.is_some(),
        /// First address of the waiting command's pattern.
        pub pending_base: U(c.address) as Hex = c.pattern().base,
        /// Last address of the waiting command's pattern.
        pub pending_last: U(c.address) as Hex = c.pattern().last,
        /// The waiting command's pattern repeats after its last word.
        pub pending_cyclic: Bit = c.pattern().cyclic,
        /// High: the waiting command starts a pattern; low: it stops the running one.
        pub pending_run: Bit = c.free_running.is_some(),
        /// High: the waiting command is taken at the next RST; low: at the RST that ends the
        /// running pattern.
        pub pending_now: Bit = 0,
        /// Unit time of the waiting command, in ticks.
        pub pending_period: U(c.period) = c.pattern().period,
    }
    /// Nets.
    pub struct Net {
        /// No command is waiting, so one without `now` is accepted.
        pub ready: Bit,
        /// A command is accepted.
        accept: Bit,
    }
}

impl Circuit for CommandPort {
    const NAME: &'static str = "command_port";
    const ABOUT: &'static str = "holds the control computer's next command until it is taken";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let accept = i.valid & (!q.pending | i.now);
        let net = Net {
            ready: !q.pending,
            accept,
        };
        let next = Reg {
            pending: accept | (q.pending & !i.take),
            pending_base: accept.mux(i.base, q.pending_base),
            pending_last: accept.mux(i.last, q.pending_last),
            pending_cyclic: accept.mux(i.cyclic, q.pending_cyclic),
            pending_run: accept.mux(i.run, q.pending_run),
            pending_now: accept.mux(i.now, q.pending_now),
            pending_period: accept.mux(i.period, q.pending_period),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let accepted = i.valid & (w.ready | i.now);
        let given = waits(next, [i.base, i.last, i.period], [i.cyclic, i.run, i.now]);
        let kept = waits(
            next,
            [q.pending_base, q.pending_last, q.pending_period],
            [q.pending_cyclic, q.pending_run, q.pending_now],
        );
        let stays = q.pending & !(i.valid & i.now);
        vec![
            Property::step(
                "a command is stored as given if ready or now is high",
                &["pending", "pending_base", "pending_last"],
                accepted.implies(next.pending & given),
            ),
            Property::step(
                "a waiting command stays unchanged until it is taken or replaced",
                &["pending", "pending_base", "pending_last"],
                stays.implies(kept & (next.pending ^ i.take)),
            ),
            Property::step(
                "pending rises only after a tick with valid",
                &["pending"],
                q.pending | i.valid | !next.pending,
            ),
            Property::always(
                "ready is high if and only if no command waits",
                &["ready"],
                w.ready ^ q.pending,
            ),
        ]
    }
}

/// High if the waiting command has these words and bits.
fn waits(q: &Reg<Open>, words: [U; 3], bits: [Bit; 3]) -> Bit {
    let [base, last, period] = words;
    let [cyclic, run, now] = bits;
    let pattern = q.pending_base.equals(base) & q.pending_last.equals(last);
    let same =
        q.pending_cyclic.equals(cyclic) & q.pending_run.equals(run) & q.pending_now.equals(now);
    pattern & q.pending_period.equals(period) & same
}

impl Specified for CommandPort {}
