//! Address sequencer 50 (¶0018–0019): the read address of the pattern memory.
//!
//! ```text
//!                  ┌───────────────────┐
//!  unit_rst ──────▶│                   ├──▶ read, blank
//!  pending ───────▶│ address sequencer ├──▶ next_address
//!  base, last, … ─▶│                   ├──▶ take
//!                  └───────────────────┘
//! ```
//!
//! All changes happen at RST: the address counts up, the pattern starts again, ends, or is
//! replaced by the waiting command.
//!
//! Departures: the text counts without end. Here a pattern has a last address, where it repeats or
//! stops. After a stop the address is held, and no axis gets pulses. At power-on the sequencer is
//! idle; a pattern begins at the first RST after its command.

use crate::prelude::*;

/// Names of the states.
pub const STATES: &[&str] = &["IDLE", "RUN"];

/// Address sequencer 50; registers change only at RST.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AddressSequencer {
    /// Width of an address in bits.
    pub width: usize,
}

signals! { for AddressSequencer as c;
    /// Input ports.
    pub struct In {
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
        /// A command is waiting.
        pub pending: Bit,
        /// First address of the waiting command's pattern.
        pub pending_base: U(c.width) as Hex,
        /// Last address of the waiting command's pattern.
        pub pending_last: U(c.width) as Hex,
        /// The waiting command's pattern repeats after its last word.
        pub pending_cyclic: Bit,
        /// High: the waiting command starts a pattern; low: it stops the running one.
        pub pending_run: Bit,
        /// High: the waiting command is taken at the next RST; low: at the RST that ends the
        /// running pattern.
        pub pending_now: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// State: RUN while a pattern runs.
        pub state: U(1) as States(STATES) = 0,
        /// Address of the current unit time.
        pub address: U(c.width) as Hex = 0,
        /// First address of the running pattern.
        base: U(c.width) as Hex = 0,
        /// Last address of the running pattern.
        last: U(c.width) as Hex = 0,
        /// The running pattern repeats after its last word.
        cyclic: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The address is the last of the pattern.
        at_last: Bit,
        /// The address is the last of the pattern, or no pattern runs.
        at_end: Bit,
        /// The waiting command can be taken at an RST in this tick.
        due: Bit,
        /// The waiting command can be taken, and starts a pattern.
        start: Bit,
        /// Next address of the running pattern.
        following: U(c.width) as Hex,
        /// The waiting command is taken at the end of this tick.
        pub take: Bit,
        /// A pattern runs in the next unit time; valid in the tick of RST.
        go_on: Bit,
        /// Address of the next unit time; valid in the tick of RST.
        pub next_address: U(c.width) as Hex,
        /// The pattern memories read `next_address`.
        pub read: Bit,
        /// The next unit time has no pulses.
        pub blank: Bit,
    }
}

impl Circuit for AddressSequencer {
    const NAME: &'static str = "address_sequencer";
    const ABOUT: &'static str = "read address: counts at RST, repeats, stops, switches patterns";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let running = q.state.bit(0);
        let at_last = q.address.equals(q.last);
        let at_end = !running | at_last;
        let due = i.pending & (at_end | i.pending_now);
        let start = due & i.pending_run;
        let following = (at_last & q.cyclic).mux(q.base, q.address + 1);
        let go_on = due.mux(i.pending_run, running & (!at_last | q.cyclic));
        let next_address = go_on.mux(start.mux(i.pending_base, following), q.address);
        let begins = i.unit_rst & start;
        let net = Net {
            at_last,
            at_end,
            due,
            start,
            following,
            take: i.unit_rst & due,
            go_on,
            next_address,
            read: i.unit_rst & go_on,
            blank: i.unit_rst & !go_on,
        };
        let next = Reg {
            state: i.unit_rst.mux(go_on.word(), q.state),
            address: i.unit_rst.mux(next_address, q.address),
            base: begins.mux(i.pending_base, q.base),
            last: begins.mux(i.pending_last, q.last),
            cyclic: begins.mux(i.pending_cyclic, q.cyclic),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let (running, runs) = (q.state.bit(0), next.state.bit(0));
        let at_last = q.address.equals(q.last);
        let taken = i.unit_rst & w.take;
        let left = i.unit_rst & !w.take;
        let stays = next.address.equals(q.address);
        let due = i.unit_rst & i.pending & (i.pending_now | !running | at_last);
        let pattern = Bit::all([
            runs,
            next.address.equals(i.pending_base),
            next.base.equals(i.pending_base),
            next.last.equals(i.pending_last),
            next.cyclic.equals(i.pending_cyclic),
        ]);
        let restarts = runs & next.address.equals(q.base);
        let reads = runs & next.address.equals(w.next_address);
        vec![
            Property::step(
                "state and address change only at RST",
                &["state", "address"],
                i.unit_rst | (next.state.equals(q.state) & stays),
            ),
            Property::always(
                "a command is taken at RST if pending_now is high, in IDLE, or at the last address",
                &["take"],
                w.take.equals(due),
            ),
            Property::step(
                "a command with pending_run starts its pattern at pending_base",
                &["address", "base", "last", "cyclic"],
                (taken & i.pending_run).implies(pattern),
            ),
            Property::step(
                "a command without pending_run stops the pattern and holds the address",
                &["state", "address"],
                (taken & !i.pending_run).implies(!runs & stays),
            ),
            Property::step(
                "without a command, a running pattern advances by one address per RST",
                &["address"],
                (left & running & !at_last).implies(runs & next.address.equals(q.address + 1)),
            ),
            Property::step(
                "after the last address, a cyclic pattern restarts and any other stops there",
                &["state", "address"],
                (left & running & at_last).implies(q.cyclic.mux(restarts, !runs & stays)),
            ),
            Property::step(
                "in IDLE, state and address stay until a command is taken",
                &["state", "address"],
                (left & !running).implies(!runs & stays),
            ),
            Property::step(
                "RST reads the next address if a pattern runs next, and otherwise blanks",
                &["read", "blank", "next_address"],
                Bit::all([
                    (w.read | w.blank).equals(i.unit_rst),
                    !(w.read & w.blank),
                    w.read.implies(reads),
                    w.blank.implies(!runs),
                ]),
            ),
        ]
    }
}

impl Specified for AddressSequencer {}
