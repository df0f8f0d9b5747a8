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
//! Everything happens at RST: the address counts up, the pattern starts again, ends, or gives way
//! to the waiting command.
//!
//! Departures: the text counts without end. Here a pattern has a last address, where it loops or
//! stops; stopped, the address is held and no axis gets pulses. At power-on the sequencer is
//! idle; a pattern begins at the first RST after its command.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::kernel::Sample;
use crate::logic::Sim;
use crate::logic::{Bit, Logic, Unsigned};
use crate::signals;

/// Names of the states.
pub const STATES: &[&str] = &["IDLE", "RUN"];

signals! {
    /// Ports in.
    pub struct In<L, const A: usize> {
        /// Last tick of the unit time.
        pub unit_rst: L::Bit,
        /// A command waits.
        pub pending: L::Bit,
        /// Its pattern's first address.
        pub pending_base: L::U<A> as Hex,
        /// Its pattern's last address.
        pub pending_last: L::U<A> as Hex,
        /// Its pattern starts again after its last word.
        pub pending_cyclic: L::Bit,
        /// It starts a pattern; low: it stops the one that runs.
        pub pending_run: L::Bit,
        /// It is taken at the next RST; low: at the RST that ends the pattern.
        pub pending_now: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const A: usize> {
        /// Whether a pattern runs.
        pub state: L::U<1> as States(STATES) = 0,
        /// Address of the unit time that runs.
        pub address: L::U<A> as Hex = 0,
        /// First address of the pattern that runs.
        base: L::U<A> as Hex = 0,
        /// Last address of the pattern that runs.
        last: L::U<A> as Hex = 0,
        /// The pattern that runs starts again after its last word.
        cyclic: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const A: usize> {
        /// The unit time that runs is the last of its pattern.
        at_last: L::Bit,
        /// That, or no pattern runs.
        at_end: L::Bit,
        /// The waiting command is for the next RST.
        due: L::Bit,
        /// That command starts a pattern.
        start: L::Bit,
        /// Address that follows in the pattern that runs.
        following: L::U<A> as Hex,
        /// The waiting command is taken with this tick.
        pub take: L::Bit,
        /// A pattern runs in the unit time to come, if this is the tick of RST.
        go_on: L::Bit,
        /// Address of the unit time to come.
        pub next_address: L::U<A> as Hex,
        /// The pattern memory reads `next_address`.
        pub read: L::Bit,
        /// The unit time to come has no pulses.
        pub blank: L::Bit,
    }
}

/// Address sequencer 50 with addresses of `A` bits; registers change only at RST.
#[derive(Debug, Clone, Default)]
pub struct AddressSequencer<const A: usize>;

impl<const A: usize> Circuit for AddressSequencer<A> {
    const NAME: &'static str = "address_sequencer";
    const ABOUT: &'static str = "read address: counts on RST, loops, stops, switches patterns";
    type In<L: Logic> = In<L, A>;
    type Reg<L: Logic> = Reg<L, A>;
    type Net<L: Logic> = Net<L, A>;

    fn comb<L: Logic>(&self, q: &Reg<L, A>, i: &In<L, A>) -> Net<L, A> {
        let running = q.state.bit(0);
        let at_last = q.address.equals(q.last);
        let at_end = !running | at_last;
        let due = i.pending & (at_end | i.pending_now);
        let start = due & i.pending_run;
        let following = (at_last & q.cyclic).mux(q.base, q.address + 1);
        let go_on = due.mux(i.pending_run, running & (!at_last | q.cyclic));
        let going_on = start.mux(i.pending_base, following);
        Net {
            at_last,
            at_end,
            due,
            start,
            following,
            take: i.unit_rst & due,
            go_on,
            next_address: go_on.mux(going_on, q.address),
            read: i.unit_rst & go_on,
            blank: i.unit_rst & !go_on,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, A>, w: &Net<L, A>, i: &In<L, A>) -> Reg<L, A> {
        let start = i.unit_rst & w.start;
        Reg {
            state: i.unit_rst.mux(w.go_on.word(), q.state),
            address: i.unit_rst.mux(w.next_address, q.address),
            base: start.mux(i.pending_base, q.base),
            last: start.mux(i.pending_last, q.last),
            cyclic: start.mux(i.pending_cyclic, q.cyclic),
        }
    }
}

impl<const A: usize> Specified for AddressSequencer<A> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let running = |q: &Reg<Sim, A>| q.state.get() == 1;
        let taken = |now: &Sample<'_, Self>| now.i.unit_rst.get() && now.w.take.get();
        let ends = |q: &Reg<Sim, A>| q.address == q.last;
        Invariants::<Self>::new()
            .step("nothing changes but at RST", move |now, next| {
                let kept = next.state == now.q.state && next.address == now.q.address;
                require(now.i.unit_rst.get() || kept, ["state", "address"], || {
                    "changed in mid-unit".into()
                })
            })
            .always(
                "a command is taken at RST, at once or at the end of the pattern",
                move |now| {
                    let end = !running(now.q) || ends(now.q);
                    let due = now.i.unit_rst.get()
                        && now.i.pending.get()
                        && (now.i.pending_now.get() || end);
                    require(due == now.w.take.get(), ["take"], || {
                        format!("take is {:?}", now.w.take)
                    })
                },
            )
            .step("a pattern begins at its base", move |now, next| {
                let begins = taken(now) && now.i.pending_run.get();
                let there = running(next)
                    && next.address == now.i.pending_base
                    && next.base == now.i.pending_base
                    && next.last == now.i.pending_last
                    && next.cyclic == now.i.pending_cyclic;
                require(
                    !begins || there,
                    ["address", "base", "last", "cyclic"],
                    || "another pattern".into(),
                )
            })
            .step(
                "a stop command ends it and holds the address",
                move |now, next| {
                    let stop = taken(now) && !now.i.pending_run.get();
                    let held = !running(next) && next.address == now.q.address;
                    require(!stop || held, ["state", "address"], || "goes on".into())
                },
            )
            .step("a running pattern skips no address", move |now, next| {
                let on = now.i.unit_rst.get() && !taken(now) && running(now.q) && !ends(now.q);
                let up = running(next) && next.address == now.q.address + 1;
                require(!on || up, ["address"], || format!("{:?}", next.address))
            })
            .step(
                "at its end a pattern starts again or holds",
                move |now, next| {
                    let end = now.i.unit_rst.get() && !taken(now) && running(now.q) && ends(now.q);
                    let good = match now.q.cyclic.get() {
                        true => running(next) && next.address == now.q.base,
                        false => !running(next) && next.address == now.q.address,
                    };
                    require(!end || good, ["state", "address"], || {
                        format!("{:?}", next.address)
                    })
                },
            )
            .step("idle holds the address", move |now, next| {
                let idle = now.i.unit_rst.get() && !taken(now) && !running(now.q);
                let held = !running(next) && next.address == now.q.address;
                require(!idle || held, ["state", "address"], || "moves".into())
            })
            .step(
                "the memory reads the address to come, or goes blank",
                move |now, next| {
                    let (read, blank) = (now.w.read.get(), now.w.blank.get());
                    let one = (read ^ blank) == now.i.unit_rst.get() && !(read && blank);
                    let right = !read || running(next) && next.address == now.w.next_address;
                    let right = right && (!blank || !running(next));
                    require(one && right, ["read", "blank", "next_address"], || {
                        "not in step".into()
                    })
                },
            )
    }
}
