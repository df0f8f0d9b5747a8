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

use super::record_memory::{ARC, KINDS, RECORD, RecordMemory, RecordWord};
use crate::hdl::Opened;
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

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let fetches = next.state.equals(FETCH) & !q.state.equals(FETCH);
        let mut all = vec![Property::step(
            "every transition is one of the table of states",
            &["state"],
            next.state.equals(self.after(i, q)),
        )];
        all.extend(self.points(now));
        all.push(Property::step(
            "take is high in the first tick of a fetch, and only there",
            &["take", "state"],
            next.take.equals(fetches),
        ));
        all.extend(Self::flags(now));
        all.push(Property::step(
            "words 0 and 1 of a record load the header and the modulus",
            &["kind", "rests", "remaining", "modulus"],
            self.loads(i, q, next),
        ));
        all
    }
}

/// Assumptions about the records of a path: each block that gets their words needs a modulus, and
/// parts that are less.
pub(crate) fn given_of_records(blocks: impl IntoIterator<Item = [Bit; 2]>) -> [Property; 2] {
    let (modulus, parts): (Vec<_>, Vec<_>) = blocks
        .into_iter()
        .map(|[modulus, parts]| (modulus, parts))
        .unzip();
    [
        Property::given(
            "the modulus of a record is from 1 to half of its range",
            Bit::all(modulus),
        ),
        Property::given(
            "the parts of a record are less than its modulus",
            Bit::all(parts),
        ),
    ]
}

/// Helper of a circuit with sequencer and memory: a block steps in other states than that in which a
/// record is sent to it.
pub(crate) fn sends_in_fetch(
    sequencer: &Opened<RecordSequencer>,
    memory: &Opened<RecordMemory>,
) -> Property {
    let (fetches, q, take) = (sequencer.q.state.equals(FETCH), &memory.q, sequencer.q.take);
    let sends = q.reading | q.load;
    let over = q.load & q.word.equals(RECORD as u64 - 1);
    Property::helper(
        "a record is sent in the state fetch, once",
        &["sequencer.state"],
        Bit::all([
            (take | sends | q.loaded).implies(fetches),
            !(take & (sends | q.loaded)),
            !(q.loaded & sends),
            !(over & q.reading),
            !(sequencer.q.rotate & fetches),
        ]),
    )
}

impl RecordSequencer {
    /// Returns the next state by the state chart.
    fn after(&self, i: &In, q: &Reg<Open>) -> U {
        let to = |state: u64| U::new(state, 3);
        let empty = q.remaining.is_zero();
        let loaded = (q.first | empty).mux(to(READY), to(STEP));
        let turns = q.kind.equals(ARC) | self.waits;
        let ended = i.available.mux(to(FETCH), to(IDLE));
        let table = [
            (IDLE, i.start & i.available, to(FETCH)),
            (FETCH, i.loaded, loaded),
            (STEP, Bit::high(), turns.mux(to(ROTATE), to(READY))),
            (ROTATE, i.rotated, to(READY)),
            (READY, i.sample, empty.mux(ended, to(STEP))),
        ];
        let moved = table.into_iter().fold(q.state, |state, (from, on, to)| {
            (q.state.equals(from) & on).mux(to, state)
        });
        i.halt.mux(IDLE, moved)
    }

    /// High if the words 0 and 1 of a record load the registers of the segment, and nothing else.
    fn loads(&self, i: &In, q: &Reg<Open>, next: &Reg<Open>) -> Bit {
        let data = i.record.data;
        let [header, second] = [0, 1].map(|word| i.record.load & i.record.word.equals(word));
        let kind = next.kind.equals(header.mux(data.resize(2), q.kind));
        let rests = next.rests.equals(header.mux(data.bit(2), q.rests));
        let samples = next.remaining.equals(data.slice(3, self.samples));
        let modulus = second.mux(data.resize(self.modulus), q.modulus);
        kind & rests & (samples | !header) & next.modulus.equals(modulus)
    }

    /// Statements about the points of a segment.
    fn points(&self, now: &Moment<Self>) -> [Property; 2] {
        let (i, q, w, next) = (&now.i, &now.q, &now.w, &now.next.q);
        let header = i.record.load & i.record.word.is_zero();
        let steps = q.state.equals(STEP) & !i.halt;
        let arc = q.kind.equals(ARC);
        let left = steps.mux(q.remaining - 1, q.remaining);
        let counted = header | next.remaining.equals(left);
        let advances = w.advance.equals(steps & !arc);
        let rotates = next.rotate.equals(steps & (arc | self.waits));
        let due = i.sample & q.state.equals(READY) & !i.halt;
        [
            Property::step(
                "each step requests one point and decrements the remaining samples",
                &["remaining", "advance", "rotate"],
                advances & rotates & counted,
            ),
            Property::step(
                "a point becomes the command if and only if a sample comes while it is ready",
                &["present", "sampled"],
                w.present.equals(due) & next.sampled.equals(due),
            ),
        ]
    }

    /// Statements about the flags of a path.
    fn flags(now: &Moment<Self>) -> [Property; 3] {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let is = |state: u64| q.state.equals(state);
        let begins = is(IDLE) & next.state.equals(FETCH);
        let makes = is(FETCH) | is(STEP) | is(ROTATE);
        let missed = i.sample & !i.halt & makes & !q.first;
        let stops = !is(IDLE) & next.state.equals(IDLE) & !i.halt & !q.rests;
        [
            Property::step(
                "first is high from a path's beginning until its first point becomes the command",
                &["first"],
                next.first.equals(begins | (q.first & !next.sampled)),
            ),
            Property::step(
                "late is set if a sample comes while the next point is being computed",
                &["late"],
                next.late.equals(missed | (q.late & !begins)),
            ),
            Property::step(
                "starved is set if the sequencer becomes idle without a rest and without a halt",
                &["starved"],
                next.starved.equals(stops | (q.starved & !begins)),
            ),
        ]
    }
}

impl Specified for RecordSequencer {
    /// A word is loaded in a fetch; one from 2 on does not differ from another such.
    fn applies(&self, i: &In<Value>) -> bool {
        i.record.is_among(&[0, 1, 2]) && !(i.record.load && i.loaded)
    }
}
