//! Record sequencer: plays segment after segment, one point per sampling time.
//!
//! ```text
//!                     ┌───────────────────┐
//!  start, halt ──────▶│                   ├──▶ take
//!  sample ───────────▶│                   ├──▶ advance, rotate
//!  available, loaded ▶│ record_sequencer  ├──▶ present, sampled
//!  load, word, data ─▶│                   ├──▶ kind, rotating, modulus
//!  rotated ──────────▶│                   ├──▶ busy, late, starved
//!                     └───────────────────┘
//! ```
//!
//! The path A → A⁺ → (B) → C⁻ → C of JPH0743606B2 is a blend, an arc and a blend; with lines it
//! becomes line, blend, arc, blend, line. Each segment begins at the point where the previous one
//! has ended, and its record says how many samples it has.
//!
//! At `sample` the point becomes the command, and the next point is computed at once: it is ready
//! long before the next `sample`. After the last point of a segment, the next segment is fetched
//! first. The first point of a path is the start of its first segment. A segment of 0 samples
//! outputs its starting point.

use super::record_memory::{ARC, KINDS, RecordWord};
use crate::prelude::*;

/// Names of the states.
const STATES: &[&str] = &["idle", "fetch", "step", "rotate", "ready"];
const IDLE: u64 = 0;
pub(crate) const FETCH: u64 = 1;
const STEP: u64 = 2;
const ROTATE: u64 = 3;
pub(crate) const READY: u64 = 4;

/// Sequencer of records.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordSequencer {
    /// Width of a modulus in bits.
    pub modulus: usize,
    /// Width of the number of a segment's samples.
    pub samples: usize,
    /// Width of a word of a record.
    pub data: usize,
    /// True to wait for `rotated` on blends and lines too, as on arcs.
    pub waits: bool,
}

signals! { for RecordSequencer as c;
    /// Input ports.
    pub struct In {
        /// Starts a path; ignored while a path runs, or if no segment waits.
        pub start: Bit,
        /// Ends the path. The commands keep their values; waiting segments are discarded.
        pub halt: Bit,
        /// A sampling time begins.
        pub sample: Bit,
        /// A segment is waiting.
        pub available: Bit,
        /// Word of a record.
        pub record: RecordWord(&c.data) as Flat,
        /// All words of the record have been sent.
        pub loaded: Bit,
        /// The rotation, or another block that the sequencer waits for, has its next point.
        pub rotated: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// State of the sequence.
        pub(crate) state: U(3) as States(STATES) = 0,
        /// The current point is the first of a path.
        first: Bit = 0,
        /// Kind of the current segment.
        pub kind: U(2) as States(KINDS) = 0,
        /// The current segment ends at rest.
        rests: Bit = 0,
        /// Remaining points of the segment.
        remaining: U(c.samples) as Analog = 0,
        /// Modulus of the segment's differences.
        pub modulus: U(c.modulus) = 0,
        /// Fetches the next record.
        pub take: Bit = 0,
        /// Starts the next point in the rotation, or in another block that the sequencer waits for.
        pub rotate: Bit = 0,
        /// New commands are valid in this tick.
        pub sampled: Bit = 0,
        /// A sampling time has begun before the point was ready; cleared when the next path begins.
        pub late: Bit = 0,
        /// The path has ended in motion because no segment was waiting; cleared when the next path
        /// begins.
        pub starved: Bit = 0,
    }
    /// Nets.
    pub struct Net {
        /// The record word is the header, word 0.
        header: Bit,
        /// A path begins.
        begins: Bit,
        /// The last point of the segment becomes the command.
        over: Bit,
        /// The current segment is an arc.
        pub rotating: Bit,
        /// The next point is started.
        makes: Bit,
        /// Advances the difference engines to the next point of a blend or line.
        pub advance: Bit,
        /// The point becomes the command.
        pub present: Bit,
        /// A path is running.
        pub busy: Bit,
        /// A sampling time begins before the point is ready.
        hurried: Bit,
    }
}

impl Circuit for RecordSequencer {
    const NAME: &'static str = "record_sequencer";
    const ABOUT: &'static str = "plays segment after segment, one point per sampling time";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let needed = self.modulus.max(self.samples + 3);
        (self.data < needed).then(|| "a word of a record holds header and modulus".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let is = |state: u64| q.state.equals(state);
        let header = i.record.load & i.record.word.is_zero();
        let begins = is(IDLE) & i.start & i.available & !i.halt;
        let present = is(READY) & i.sample & !i.halt;
        let over = present & q.remaining.is_zero();
        let rotating = q.kind.equals(ARC);
        let makes = is(STEP) & !i.halt;
        let hurried = i.sample & !q.first & !i.halt & (is(FETCH) | is(STEP) | is(ROTATE));

        let to = |state: u64| U::new(state, 3);
        let ended = i.available.mux(to(FETCH), to(IDLE));
        let stands = q.first | q.remaining.is_zero();
        let waits = if self.waits { Bit::high() } else { rotating };
        let made = waits.mux(to(ROTATE), to(READY));
        let state = begins.mux(FETCH, q.state);
        let state = (i.loaded & is(FETCH)).mux(stands.mux(to(READY), to(STEP)), state);
        let state = makes.mux(made, state);
        let state = (i.rotated & is(ROTATE)).mux(READY, state);
        let state = present.mux(over.mux(ended, to(STEP)), state);
        let samples = i.record.data.shift_right(3).resize(self.samples);
        let remaining = makes.mux(q.remaining - 1, q.remaining);
        let modulus = i.record.load & i.record.word.equals(1);
        let net = Net {
            header,
            begins,
            over,
            rotating,
            makes,
            advance: makes & !rotating,
            present,
            busy: !is(IDLE),
            hurried,
        };
        let next = Reg {
            state: i.halt.mux(IDLE, state),
            first: begins | (q.first & !present),
            kind: header.mux(i.record.data.resize(2), q.kind),
            rests: header.mux(i.record.data.bit(2), q.rests),
            remaining: header.mux(samples, remaining),
            modulus: modulus.mux(i.record.data.resize(self.modulus), q.modulus),
            take: begins | (over & i.available),
            rotate: makes & waits,
            sampled: present,
            late: (q.late & !begins) | hurried,
            starved: (q.starved & !begins) | (over & !q.rests & !i.available),
        };
        (net, next)
    }
}

/// Returns the next state by the state chart; `None` if the state stays.
fn after(q: &Reg<Value>, i: &In<Value>, waits: bool) -> Option<u64> {
    let on = |condition: bool, state| condition.then_some(state);
    let next = on(i.available, FETCH).unwrap_or(IDLE);
    match q.state {
        _ if i.halt => Some(IDLE),
        IDLE => on(i.start && i.available, FETCH),
        FETCH if q.first || q.remaining == 0 => on(i.loaded, READY),
        FETCH => on(i.loaded, STEP),
        STEP if q.kind == ARC || waits => Some(ROTATE),
        STEP => Some(READY),
        ROTATE => on(i.rotated, READY),
        _ if q.remaining == 0 => on(i.sample, next),
        _ => on(i.sample, STEP),
    }
}

impl Specified for RecordSequencer {
    fn invariants(&self) -> Invariants<'_, Self> {
        let begins = |q: &Reg<Value>, next: &Reg<Value>| q.state == IDLE && next.state == FETCH;
        Invariants::<Self>::new()
            .step(
                "every transition is one of the table of states",
                |now, next| {
                    let expected = after(now.q, now.i, self.waits).unwrap_or(now.q.state);
                    require(next.q.state == expected, ["state"], || {
                        format!("not {}", STATES[expected as usize])
                    })
                },
            )
            .step(
                "each step requests one point and decrements the remaining samples",
                |now, next| {
                    let header = now.i.record.load && now.i.record.word == 0;
                    let steps = now.q.state == STEP && !now.i.halt;
                    let arc = now.q.kind == ARC;
                    let words = 1 << self.samples;
                    let left = (now.q.remaining + words - u64::from(steps)) % words;
                    let counted = header || next.q.remaining == left;
                    let right = now.see(|s| s.w.advance) == (steps && !arc)
                        && next.q.rotate == (steps && (arc || self.waits));
                    require(right && counted, ["remaining", "advance", "rotate"], || {
                        format!("{left} left")
                    })
                },
            )
            .step(
                "a point becomes the command if and only if a sample comes while it is ready",
                |now, next| {
                    let due = now.i.sample && now.q.state == READY && !now.i.halt;
                    let right = now.see(|s| s.w.present) == due && next.q.sampled == due;
                    require(right, ["present", "sampled"], || "not so".into())
                },
            )
            .step(
                "take is high in the first tick of a fetch, and only there",
                |now, next| {
                    let fetches = next.q.state == FETCH && now.q.state != FETCH;
                    require(next.q.take == fetches, ["take", "state"], || {
                        "not so".into()
                    })
                },
            )
            .step(
                "first is high from a path's beginning until its first point becomes the command",
                move |now, next| {
                    let kept = now.q.first && !next.q.sampled;
                    let expected = begins(now.q, &next.q) || kept;
                    require(next.q.first == expected, ["first"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "late is set if a sample comes while the next point is being computed",
                move |now, next| {
                    let making = [FETCH, STEP, ROTATE].contains(&now.q.state);
                    let missed = now.i.sample && !now.i.halt && making && !now.q.first;
                    let expected = missed || (now.q.late && !begins(now.q, &next.q));
                    require(next.q.late == expected, ["late"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "starved is set if the sequencer becomes idle without a rest and without a halt",
                move |now, next| {
                    let idles = now.q.state != IDLE && next.q.state == IDLE;
                    let moving = idles && !now.i.halt && !now.q.rests;
                    let expected = moving || (now.q.starved && !begins(now.q, &next.q));
                    require(next.q.starved == expected, ["starved"], || {
                        format!("not {expected}")
                    })
                },
            )
            .step(
                "words 0 and 1 of a record load the header and the modulus",
                |now, next| {
                    let word = now.i.record.load.then_some(now.i.record.word);
                    let data = now.i.record.data;
                    let header = match word {
                        Some(0) => [data % 4, data / 4 % 2],
                        _ => [now.q.kind, u64::from(now.q.rests)],
                    };
                    let samples = data / 8 % (1 << self.samples);
                    let counted = word != Some(0) || next.q.remaining == samples;
                    let modulus = match word {
                        Some(1) => data % (1 << self.modulus),
                        _ => now.q.modulus,
                    };
                    let same = [next.q.kind, u64::from(next.q.rests)] == header;
                    let right = same && counted && next.q.modulus == modulus;
                    require(right, ["kind", "rests", "remaining", "modulus"], || {
                        "not so".into()
                    })
                },
            )
    }

    /// A word is loaded in a fetch; one from 2 on does not differ from another such.
    fn applies(&self, i: &In<Value>) -> bool {
        i.record.is_among(&[0, 1, 2]) && !(i.record.load && i.loaded)
    }
}
