//! Sequencer of the positioning cycles (¶0005, ¶0013–0014): from one target to the next, and scan
//! by scan through a cycle.
//!
//! ```text
//!                                      ┌───────────┐
//!  scan, hold, halt, clear ──────────▶│           ├──▶ pop ──▶ target data 20
//!  available, target_x, target_y ─────▶│           ├──▶ start, advance ──▶ generator 14
//!  x, y ──────────────────────────────▶│ sequencer ├──▶ swapped, master…, slave…
//!  pattern_active, _ready, _valid ────▶│           ├──▶ busy, late, refused
//!  integrating, load ─────────────────▶│           ├──▶ home
//!                                      └───────────┘
//! ```
//!
//! Departures: a cycle starts from the command that stands, not from the target before, so that a
//! cycle that was aborted leaves nothing behind. A target that is farther away than a signed word
//! of the position's width can say is refused. A scan that comes before the last one is computed
//! is left out, and flagged.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Sim, Unsigned};
use crate::signals;

/// Names of the states.
const STATES: &[&str] = &["idle", "pop", "fetch", "plan", "begin", "run"];
const IDLE: u64 = 0;
const POP: u64 = 1;
const FETCH: u64 = 2;
const PLAN: u64 = 3;
const BEGIN: u64 = 4;
const RUN: u64 = 5;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// A scan begins.
        pub scan: L::Bit,
        /// No new cycle begins.
        pub hold: L::Bit,
        /// Ends the cycle that runs: the axes slow down along the line.
        pub halt: L::Bit,
        /// Between two cycles: the commands become 0, the flags go.
        pub clear: L::Bit,
        /// A target waits.
        pub available: L::Bit,
        /// X of the target, from the tick after `pop` on.
        pub target_x: L::I<P>,
        /// Y of it.
        pub target_y: L::I<P>,
        /// Position command of X.
        pub x: L::I<P>,
        /// Position command of Y.
        pub y: L::I<P>,
        /// The position pattern is under way.
        pub pattern_active: L::Bit,
        /// It takes an `advance`.
        pub pattern_ready: L::Bit,
        /// It shows a new position.
        pub pattern_valid: L::Bit,
        /// The integrator divides.
        pub integrating: L::Bit,
        /// It shows a new integral: the commands of a scan are complete.
        pub load: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// Where it stands.
        pub state: L::U<3> as States(STATES) = 0,
        /// The next target is wanted.
        pub pop: L::Bit = 0,
        /// A cycle begins.
        pub start: L::Bit = 0,
        /// The commands of a scan are to be computed.
        pub advance: L::Bit = 0,
        /// Distance in X.
        pub delta_x: L::I<P> = 0,
        /// Distance in Y.
        pub delta_y: L::I<P> = 0,
        /// A distance does not fit its word.
        too_far: L::Bit = 0,
        /// Y is the master axis (Fig. 6).
        pub swapped: L::Bit = 0,
        /// Where the master axis starts.
        pub master_from: L::I<P> = 0,
        /// Where the slave axis starts.
        pub slave_from: L::I<P> = 0,
        /// Δ of the master axis.
        pub master: L::I<P> = 0,
        /// Δ of the slave axis.
        pub slave: L::I<P> = 0,
        /// The commands of a scan are being computed.
        computing: L::Bit = 0,
        /// A scan came too early since the flags were cleared.
        pub late: L::Bit = 0,
        /// A target was too far since the flags were cleared.
        pub refused: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const P: usize> {
        /// A target is taken.
        takes: L::Bit,
        /// The commands of a scan are begun.
        begins: L::Bit,
        /// Nothing is being computed.
        quiet: L::Bit,
        /// |Δx|.
        way_x: L::U<P>,
        /// |Δy|.
        way_y: L::U<P>,
        /// The target is too far in X.
        far_x: L::Bit,
        /// The target is too far in Y.
        far_y: L::Bit,
        /// The target is refused.
        refuses: L::Bit,
        /// What is prepared is given up.
        ends: L::Bit,
        /// The cycle is over.
        over: L::Bit,
        /// A scan comes too early.
        early: L::Bit,
        /// `clear` is taken.
        pub home: L::Bit,
        /// A cycle runs or is prepared.
        pub busy: L::Bit,
    }
}

/// Sequencer for positions of `P` bits. `start` is high four ticks after a target is available,
/// `advance` a tick after `scan`.
#[derive(Debug, Clone, Default)]
pub struct Sequencer<const P: usize>;

/// Whether `a - b`, which wraps, has the wrong sign.
fn overflows<L: Logic, const P: usize>(a: L::I<P>, b: L::I<P>) -> L::Bit {
    let apart = a.is_negative() ^ b.is_negative();
    apart & ((a - b).is_negative() ^ a.is_negative())
}

impl<const P: usize> Circuit for Sequencer<P> {
    const NAME: &'static str = "sequencer";
    const ABOUT: &'static str = "takes targets, chooses the master axis, starts cycles and scans";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L, P>;

    fn comb<L: Logic>(&self, q: &Reg<L, P>, i: &In<L, P>) -> Net<L, P> {
        let is = |state: u64| q.state.equals(state.into());
        let runs = is(RUN);
        let waits = i.pattern_ready | !i.pattern_active;
        let refuses = is(PLAN) & q.too_far;
        let quiet = waits & !q.advance & !i.pattern_valid & !i.integrating & !i.load;
        Net {
            refuses,
            ends: i.halt | refuses,
            takes: is(IDLE) & i.available & !i.hold & !i.halt & !i.clear,
            begins: runs & i.scan & i.pattern_active & i.pattern_ready & quiet & !i.halt,
            quiet,
            way_x: q.delta_x.magnitude(),
            way_y: q.delta_y.magnitude(),
            far_x: overflows::<L, P>(i.target_x, i.x),
            far_y: overflows::<L, P>(i.target_y, i.y),
            over: runs & quiet & !i.pattern_active,
            early: runs & i.scan & q.computing & !quiet,
            home: is(IDLE) & i.clear,
            busy: !is(IDLE),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L, P>, i: &In<L, P>) -> Reg<L, P> {
        let is = |state: u64| q.state.equals(state.into());
        let to = |state: u64| L::U::<3>::from(state);
        let (fetch, plan) = (is(FETCH), is(PLAN));
        let onward = w.takes.mux(to(POP), is(IDLE).mux(to(IDLE), q.state + 1));
        let running = w.over.mux(to(IDLE), to(RUN));
        let swapped = w.way_x.below(w.way_y);
        let pick =
            |choose: L::Bit, y: L::I<P>, x: L::I<P>, old: L::I<P>| plan.mux(choose.mux(y, x), old);
        Reg {
            state: is(RUN).mux(running, w.ends.mux(to(IDLE), onward)),
            pop: w.takes,
            start: plan & !w.ends,
            advance: w.begins,
            delta_x: fetch.mux(i.target_x - i.x, q.delta_x),
            delta_y: fetch.mux(i.target_y - i.y, q.delta_y),
            too_far: fetch.mux(w.far_x | w.far_y, q.too_far),
            swapped: plan.mux(swapped, q.swapped),
            master_from: pick(swapped, i.y, i.x, q.master_from),
            slave_from: pick(swapped, i.x, i.y, q.slave_from),
            master: pick(swapped, q.delta_y, q.delta_x, q.master),
            slave: pick(swapped, q.delta_x, q.delta_y, q.slave),
            computing: w.begins | (q.computing & !w.quiet),
            late: (q.late | w.early) & !w.home,
            refused: (q.refused | (w.refuses & !i.halt)) & !w.home,
        }
    }
}

impl<const P: usize> Specified for Sequencer<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "the master axis is the one with the greater distance, X where they are alike",
                |now, next| {
                    let (dx, dy) = (now.q.delta_x.get(), now.q.delta_y.get());
                    let swapped = dx.abs() < dy.abs();
                    let expected = match swapped {
                        false => [dx, dy, now.i.x.get(), now.i.y.get()],
                        true => [dy, dx, now.i.y.get(), now.i.x.get()],
                    };
                    let found = [next.master, next.slave, next.master_from, next.slave_from];
                    let right =
                        next.swapped.get() == swapped && found.map(|word| word.get()) == expected;
                    let planned = now.q.state.get() == PLAN;
                    require(!planned || right, ["swapped", "master", "slave"], || {
                        format!("{expected:?}")
                    })
                },
            )
            .step(
                "distances are those from command to target, or the target is refused",
                |now, next| {
                    let i = now.i;
                    let far = [
                        i.target_x.get() - i.x.get() - next.delta_x.get(),
                        i.target_y.get() - i.y.get() - next.delta_y.get(),
                    ];
                    let right = next.too_far.get() == (far != [0, 0]);
                    let fetched = now.q.state.get() == FETCH;
                    require(!fetched || right, ["delta_x", "delta_y", "too_far"], || {
                        format!("{far:?}")
                    })
                },
            )
            .step(
                "no cycle begins with a distance that is wrong",
                |now, next| {
                    let wrong = now.q.too_far.get() && now.q.state.get() == PLAN;
                    let refused =
                        next.state.get() == IDLE && (now.i.halt.get() || next.refused.get());
                    require(!wrong || refused, ["state", "refused"], || "begun".into())
                },
            )
            .step(
                "an abort before the start of a cycle ends it, none begins with one",
                |now, next| {
                    let early = now.q.state.get() != RUN;
                    let ended = next.state.get() == IDLE && !next.start.get() && !next.pop.get();
                    require(
                        !now.i.halt.get() || !early || ended,
                        ["state", "start"],
                        || "goes on".into(),
                    )
                },
            )
            .step(
                "distances and starts stand while a cycle runs",
                |now, next| {
                    let words = |q: &Reg<Sim, P>| {
                        let bits = [q.master, q.slave, q.master_from, q.slave_from];
                        (q.swapped, bits)
                    };
                    let stands = now.q.state.get() != RUN || words(now.q) == words(next);
                    require(stands, ["master", "slave", "swapped"], || "changed".into())
                },
            )
            .step(
                "a scan is begun where nothing is computed, and only with a cycle",
                |now, next| {
                    let busy = [
                        now.i.pattern_valid,
                        now.i.integrating,
                        now.i.load,
                        now.q.advance,
                    ];
                    let rests =
                        now.i.pattern_ready.get() && !busy.map(|bit| bit.get()).contains(&true);
                    let runs = now.q.state.get() == RUN && now.i.scan.get();
                    let right = !next.advance.get() || rests && runs;
                    require(right, ["advance"], || "begun".into())
                },
            )
            .step(
                "a start comes once, when the distances stand",
                |now, next| {
                    let right = next.start.get() == (next.state.get() == BEGIN);
                    let planned = !next.start.get() || now.q.state.get() == PLAN;
                    require(right && planned, ["start", "state"], || {
                        "at a wrong time".into()
                    })
                },
            )
            .step(
                "a scan that comes while one is computed is flagged",
                |now, next| {
                    let busy = [
                        now.q.advance,
                        now.i.pattern_valid,
                        now.i.integrating,
                        now.i.load,
                    ];
                    let scanning = now.i.pattern_active.get() && !now.i.pattern_ready.get();
                    let works = scanning || busy.map(|bit| bit.get()).contains(&true);
                    let computed = now.q.computing.get() && works;
                    let early = computed && now.q.state.get() == RUN && now.i.scan.get();
                    require(!early || next.late.get(), ["late"], || "not flagged".into())
                },
            )
            .always("a cycle ends only when its last commands are out", |now| {
                let busy = [
                    now.i.load,
                    now.i.integrating,
                    now.i.pattern_valid,
                    now.i.pattern_active,
                ];
                let right = !now.w.over.get() || !busy.map(|bit| bit.get()).contains(&true);
                require(right, ["over"], || "too early".into())
            })
            .step(
                "flags go by clear alone, which acts between cycles",
                |now, next| {
                    let cleared = now.i.clear.get() && now.q.state.get() == IDLE;
                    let kept = (!now.q.late.get() || next.late.get())
                        && (!now.q.refused.get() || next.refused.get());
                    let right = cleared == now.w.home.get() && (kept || cleared);
                    require(right, ["late", "refused", "home"], || "lost".into())
                },
            )
    }

    /// Words are tried with the strobes low, and strobes with the words zero: no equation has both.
    fn applies(&self, i: &In<Sim, P>) -> bool {
        let words = [i.target_x, i.target_y, i.x, i.y];
        let strobes = [
            i.scan,
            i.hold,
            i.clear,
            i.pattern_active,
            i.pattern_ready,
            i.pattern_valid,
            i.integrating,
            i.load,
        ];
        words.iter().all(|word| word.get() == 0) || strobes.iter().all(|strobe| !strobe.get())
    }

    /// Target and commands are looked at while a cycle is prepared only.
    fn assumes(&self, q: &Reg<Sim, P>, i: &In<Sim, P>) -> bool {
        let words = [i.target_x, i.target_y, i.x, i.y];
        let quiet = words.iter().all(|word| word.get() == 0);
        matches!(q.state.get(), FETCH | PLAN) || quiet
    }
}
