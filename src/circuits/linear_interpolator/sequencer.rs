//! Sequencer of the positioning cycles (¶0005, ¶0013–0014): from one target to the next, and scan
//! by scan through a cycle.
//!
//! ```text
//!                                      ┌───────────┐
//!  scan, hold, halt, clear ───────────▶│           ├──▶ pop ──▶ target data 20
//!  available, target_x, target_y ─────▶│           ├──▶ start, advance ──▶ generator 14
//!  x, y ──────────────────────────────▶│ sequencer ├──▶ swapped, master…, slave…
//!  pattern_active, _ready, _valid ────▶│           ├──▶ busy, late, refused
//!  integrating, load ─────────────────▶│           ├──▶ home
//!                                      └───────────┘
//! ```
//!
//! The master axis is either the one with the greater distance (claim 2), or always the same one
//! (claim 1).
//!
//! Departures: a cycle starts from the present command, not from the previous target, so an aborted
//! cycle has no effect on the next. A target whose distance exceeds a signed word of the position's
//! width is refused. A scan that comes before the last one is computed is skipped and flagged.
//! Where a fixed master axis does not move, the other one leads, because the integrator would
//! divide by 0.

use crate::prelude::*;
use serde::Deserialize;

/// Names of the states.
const STATES: &[&str] = &["idle", "pop", "fetch", "plan", "begin", "run"];
const IDLE: u64 = 0;
const POP: u64 = 1;
const FETCH: u64 = 2;
const PLAN: u64 = 3;
const BEGIN: u64 = 4;
const RUN: u64 = 5;

/// Axis that gets the position pattern, and leads the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MasterAxis {
    /// The one with the greater distance, X where they are alike (claim 2, ¶0014).
    #[default]
    Longer,
    /// X (claim 1), unless it does not move.
    X,
    /// Y, unless it does not move.
    Y,
}

impl MasterAxis {
    /// The name it has in scenarios.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            MasterAxis::Longer => "longer",
            MasterAxis::X => "x",
            MasterAxis::Y => "y",
        }
    }

    /// The master axis of a move by Δx and Δy: 0 is X, 1 is Y.
    #[must_use]
    pub fn of(self, delta: [i64; 2]) -> usize {
        let [x, y] = delta.map(i64::unsigned_abs);
        usize::from(match self {
            MasterAxis::Longer => x < y,
            MasterAxis::X => x == 0,
            MasterAxis::Y => y != 0,
        })
    }

    /// High if Y leads.
    fn swapped(self, [x, y]: [U; 2]) -> Bit {
        match self {
            MasterAxis::Longer => x.below(y),
            MasterAxis::X => x.is_zero(),
            MasterAxis::Y => !y.is_zero(),
        }
    }
}

/// Sequencer. `start` is high four ticks after a target is available, `advance` one tick after
/// `scan`.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sequencer {
    /// Width of a position in bits.
    pub position: usize,
    /// Choice of the master axis.
    pub master: MasterAxis,
}

signals! { for Sequencer as c;
    /// Input ports.
    pub struct In {
        /// A scan begins.
        pub scan: Bit,
        /// Blocks the start of a new cycle.
        pub hold: Bit,
        /// Ends the running cycle; the axes slow down along the line.
        pub halt: Bit,
        /// Sets the commands to 0 and clears the flags; effective only between two cycles.
        pub clear: Bit,
        /// A target is waiting.
        pub available: Bit,
        /// X of the target in counts; valid from the tick after `pop`.
        pub target_x: I(c.position),
        /// Y of the target in counts; valid from the tick after `pop`.
        pub target_y: I(c.position),
        /// Position command of X, in counts.
        pub x: I(c.position),
        /// Position command of Y, in counts.
        pub y: I(c.position),
        /// The position pattern is running.
        pub pattern_active: Bit,
        /// The position pattern is ready for `advance`.
        pub pattern_ready: Bit,
        /// The position pattern has a new position.
        pub pattern_valid: Bit,
        /// The integrator is dividing.
        pub integrating: Bit,
        /// The integrator has a new integral: the commands of a scan are complete.
        pub load: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub state: U(3) as States(STATES) = 0,
        /// Requests the next target.
        pub pop: Bit = 0,
        /// A cycle begins.
        pub start: Bit = 0,
        /// Starts the computation of a scan's commands.
        pub advance: Bit = 0,
        /// Signed distance in X.
        pub delta_x: I(c.position) = 0,
        /// Signed distance in Y.
        pub delta_y: I(c.position) = 0,
        /// A distance exceeds the range of its word.
        too_far: Bit = 0,
        /// Y is the master axis (Fig. 6).
        pub swapped: Bit = 0,
        /// Position of the master axis at the start of the cycle.
        pub master_from: I(c.position) = 0,
        /// Position of the slave axis at the start of the cycle.
        pub slave_from: I(c.position) = 0,
        /// Signed distance of the master axis.
        pub master: I(c.position) = 0,
        /// Signed distance of the slave axis.
        pub slave: I(c.position) = 0,
        /// The commands of a scan are being computed.
        computing: Bit = 0,
        /// A scan has come before the previous one was computed; cleared by `clear`.
        pub late: Bit = 0,
        /// A target was too far away and has been refused; cleared by `clear`.
        pub refused: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// A target is accepted.
        takes: Bit,
        /// The computation of a scan's commands begins.
        begins: Bit,
        /// Nothing is being computed.
        quiet: Bit,
        /// |Δx|.
        way_x: U(c.position),
        /// |Δy|.
        way_y: U(c.position),
        /// The target is too far in X.
        far_x: Bit,
        /// The target is too far in Y.
        far_y: Bit,
        /// The target is refused.
        refuses: Bit,
        /// The cycle in preparation is abandoned.
        ends: Bit,
        /// The cycle is over.
        over: Bit,
        /// A scan comes before the previous one is computed.
        early: Bit,
        /// `clear` takes effect in this tick.
        pub home: Bit,
        /// A cycle runs or is being prepared.
        pub busy: Bit,
    }
}

/// High if `a - b`, which wraps, has the wrong sign.
fn overflows(a: I, b: I) -> Bit {
    let apart = a.is_negative() ^ b.is_negative();
    apart & ((a - b).is_negative() ^ a.is_negative())
}

impl Circuit for Sequencer {
    const NAME: &'static str = "sequencer";
    const ABOUT: &'static str = "takes targets, chooses the master axis, starts cycles and scans";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let [idle, fetch, plan, runs] = [IDLE, FETCH, PLAN, RUN].map(|state| q.state.equals(state));
        let waits = i.pattern_ready | !i.pattern_active;
        let quiet = waits & !q.advance & !i.pattern_valid & !i.integrating & !i.load;
        let refuses = plan & q.too_far;
        let ends = i.halt | refuses;
        let takes = idle & i.available & !i.hold & !i.halt & !i.clear;
        let begins = runs & i.scan & i.pattern_active & i.pattern_ready & quiet & !i.halt;
        let over = runs & quiet & !i.pattern_active;
        let early = runs & i.scan & q.computing & !quiet;
        let home = idle & i.clear;
        let (way_x, way_y) = (q.delta_x.magnitude(), q.delta_y.magnitude());
        let far_x = overflows(i.target_x, i.x);
        let far_y = overflows(i.target_y, i.y);

        let onward = takes.mux(POP, idle.mux(IDLE, q.state + 1));
        let running = over.mux(U::new(IDLE, 3), RUN);
        let swapped = self.master.swapped([way_x, way_y]);
        let pick = |choose: Bit, y: I, x: I, old: I| plan.mux(choose.mux(y, x), old);
        let next = Reg {
            state: runs.mux(running, ends.mux(IDLE, onward)),
            pop: takes,
            start: plan & !ends,
            advance: begins,
            delta_x: fetch.mux(i.target_x - i.x, q.delta_x),
            delta_y: fetch.mux(i.target_y - i.y, q.delta_y),
            too_far: fetch.mux(far_x | far_y, q.too_far),
            swapped: plan.mux(swapped, q.swapped),
            master_from: pick(swapped, i.y, i.x, q.master_from),
            slave_from: pick(swapped, i.x, i.y, q.slave_from),
            master: pick(swapped, q.delta_y, q.delta_x, q.master),
            slave: pick(swapped, q.delta_x, q.delta_y, q.slave),
            computing: begins | (q.computing & !quiet),
            late: (q.late | early) & !home,
            refused: (q.refused | (refuses & !i.halt)) & !home,
        };
        let net = Net {
            takes,
            begins,
            quiet,
            way_x,
            way_y,
            far_x,
            far_y,
            refuses,
            ends,
            over,
            early,
            home,
            busy: !idle,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let [idle, fetch, plan, runs] = [IDLE, FETCH, PLAN, RUN].map(|state| q.state.equals(state));
        let ended = next.state.equals(IDLE);
        // Nothing but the pattern computes the commands of a scan.
        let rests = !q.advance & !i.pattern_valid & !i.integrating & !i.load;
        let planned = |[master, slave, master_from, slave_from]: [I; 4]| {
            let distances = next.master.equals(master) & next.slave.equals(slave);
            let starts = next.master_from.equals(master_from);
            distances & starts & next.slave_from.equals(slave_from)
        };
        let swapped = self.master.swapped([w.way_x, w.way_y]);
        let x_first = planned([q.delta_x, q.delta_y, i.x, i.y]) & !next.swapped;
        let y_first = planned([q.delta_y, q.delta_x, i.y, i.x]) & next.swapped;
        let stands = planned([q.master, q.slave, q.master_from, q.slave_from]);
        let near_x = next.delta_x.equals(i.target_x - i.x);
        let near_y = next.delta_y.equals(i.target_y - i.y);
        // A distance that wraps has the wrong sign.
        let far_x = next.delta_x.is_negative() ^ i.target_x.below(i.x);
        let far_y = next.delta_y.is_negative() ^ i.target_y.below(i.y);
        let far = (far_x | far_y | !next.too_far) & (!far_x | next.too_far);
        let told = far & (!far_y | next.too_far);
        // A distance below 0 and its amount add up to 0.
        let amount = |way: U, distance: I| {
            let distance_word = distance.unsigned();
            let opposite = (way + distance_word).is_zero();
            distance
                .is_negative()
                .mux(opposite, way.equals(distance_word))
        };
        let starts = next.state.equals(BEGIN);
        let waits = !i.pattern_active | i.pattern_ready;
        let cleared = i.clear & idle;
        let no_target = i.target_x.is_zero() & i.target_y.is_zero();
        let no_words = no_target & i.x.is_zero() & i.y.is_zero();
        let kept = (!q.late | next.late) & (!q.refused | next.refused);
        vec![
            Property::always(
                "way_x and way_y are the magnitudes of delta_x and delta_y",
                &["way_x", "way_y"],
                amount(w.way_x, q.delta_x) & amount(w.way_y, q.delta_y),
            ),
            Property::step(
                match self.master {
                    MasterAxis::Longer => {
                        "the master is the axis with the greater distance, or X if both are equal"
                    }
                    MasterAxis::X => "X is the master axis unless its distance is 0",
                    MasterAxis::Y => "Y is the master axis unless its distance is 0",
                },
                &["swapped", "master", "slave"],
                plan.implies((swapped & y_first) | (!swapped & x_first)),
            ),
            Property::step(
                "fetch stores the distances to the target, and too_far if one overflows",
                &["delta_x", "delta_y", "too_far"],
                fetch.implies(near_x & near_y & told),
            ),
            Property::step(
                "with too_far, plan leads to idle and sets refused unless halt is high",
                &["state", "refused"],
                (q.too_far & plan).implies(ended & (i.halt | next.refused)),
            ),
            Property::step(
                "halt in any state but run leads to idle, without start and pop",
                &["state", "start"],
                i.halt.implies(runs | (ended & !next.start & !next.pop)),
            ),
            Property::step(
                "in run, the distances, the starting points and the master axis do not change",
                &["master", "slave", "swapped"],
                runs.implies(stands & next.swapped.equals(q.swapped)),
            ),
            Property::step(
                "a scan sets advance only in run, and only while nothing is being computed",
                &["advance"],
                next.advance
                    .implies(i.pattern_ready & rests & runs & i.scan),
            ),
            Property::step(
                "start is high in the state begin, which follows plan, and in no other",
                &["start", "state"],
                next.start.equals(starts) & (!next.start | plan),
            ),
            Property::step(
                "a scan in run sets late if the previous scan is still being computed",
                &["late"],
                runs.implies(!i.scan | !q.computing | (rests & waits) | next.late),
            ),
            Property::always(
                "over is low while load, integrating, pattern_valid or pattern_active is high",
                &["over"],
                w.over
                    .implies(!(i.load | i.integrating | i.pattern_valid | i.pattern_active)),
            ),
            Property::step(
                "clear in idle makes home high, and nothing else resets late or refused",
                &["late", "refused", "home"],
                cleared.equals(w.home) & (kept | cleared),
            ),
            Property::narrowing(
                "target and commands are 0 unless the state is fetch or plan",
                fetch | plan | no_words,
            ),
        ]
    }
}

impl Specified for Sequencer {
    /// Words are tried with the strobes low, and strobes with the words zero: no equation has both.
    fn applies(&self, i: &In<Value>) -> bool {
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
        words_are_zero(i) || !strobes.contains(&true)
    }
}

fn words_are_zero(i: &In<Value>) -> bool {
    [i.target_x, i.target_y, i.x, i.y] == [0; 4]
}
