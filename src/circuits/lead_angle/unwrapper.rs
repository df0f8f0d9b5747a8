//! Unwrapper: makes a continuous position from places in a turn or pitch. Part of position detector
//! 10 of JPH0646367B2.
//!
//! ```text
//!                ┌───────────┐
//!  take, fault ─▶│           ├──▶ sample, position
//!  place ───────▶│ unwrapper │
//!  modulus ─────▶│           ├──▶ lost
//!  clear ───────▶│           │
//!                └───────────┘
//! ```
//!
//! A sensor knows only the place in its turn or pitch. The shorter way round from sample to sample
//! is added to a position, which wraps at 2^position only. The text says nothing about turns.
//!
//! Departures: the position after power-on or `clear` is the place. A move of more than a quarter
//! of the modulus per sample is counted, but sets `lost`, because a move of half the modulus or
//! more looks like one in the other direction. A place with `fault` is not counted, and sets `lost`
//! too.

use crate::prelude::*;

/// Unwrapper; a place taken in tick n is in `position` from tick n + 1 on. `sample` is high in tick
/// n + 1.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unwrapper {
    /// Width of a place.
    pub place: usize,
    /// Width of the position, greater than that.
    pub position: usize,
}

signals! { for Unwrapper as c;
    /// Input ports.
    pub struct In {
        /// A place is taken.
        pub take: Bit,
        /// The place is invalid: it is not counted.
        pub fault: Bit,
        /// Place in the turn or pitch, below the modulus.
        pub place: U(c.place),
        /// Counts of a turn or of a pitch; 0 for 2^place.
        pub modulus: U(c.place),
        /// The next place becomes the position, as after power-on; clears `lost`.
        pub clear: Bit,
    }
    /// Flip-flops.
    pub struct Reg {
        /// A place has been counted since power-on or `clear`.
        known: Bit,
        /// Place of the last sample.
        last: U(c.place),
        /// High for one tick: `position` is a new sample. CK of the memory 11.
        pub sample: Bit,
        /// Dx: place plus the counts of whole turns; wraps.
        pub position: I(c.position) as Analog = 0,
        /// The body was too fast, or a place was invalid; cleared by `clear`.
        pub lost: Bit,
    }
    /// Nets.
    pub struct Net {
        /// The place is counted.
        counted: Bit,
        /// Modulus, 2^place where `modulus` is 0.
        counts: U(c.place + 1),
        /// Place as a signed word.
        placed: I(c.place + 2),
        /// Modulus as a signed word.
        whole: I(c.place + 2),
        /// Half of the modulus as a signed word.
        half: I(c.place + 2),
        /// Place minus the place of the last sample.
        gone: I(c.place + 2),
        /// Move since the last sample, the shorter way round.
        way: I(c.place + 2),
        /// The move is longer than a quarter of the modulus.
        far: Bit,
        /// Change of the position by this sample.
        step: I(c.position),
    }
}

impl Circuit for Unwrapper {
    const NAME: &'static str = "unwrapper";
    const ABOUT: &'static str = "continuous position from places in a turn or pitch";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let wider = self.position > self.place && self.place >= 2;
        (!wider).then(|| "a position is wider than a place, and that has 2 bits at least".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let n = self.place;
        let counts = i.modulus.is_zero().word().join(i.modulus);
        let signed = |word: U| word.resize(n + 2).signed();
        let placed = signed(i.place);
        let gone = placed - signed(q.last);
        let (whole, half) = (signed(counts), signed(counts.shift_right(1)));
        let up = half.below(gone);
        let down = gone.below(-half);
        let way = up.mux(gone - whole, down.mux(gone + whole, gone));
        let far = counts.shift_right(2).below_any(way.magnitude());
        let counted = i.take & !i.fault;
        let step = q.known.mux(way, placed).resize(self.position);
        let before = q.known.mux(q.position, 0);
        let net = Net {
            counted,
            counts,
            placed,
            whole,
            half,
            gone,
            way,
            far,
            step,
        };
        let next = Reg {
            known: (q.known | counted) & !i.clear,
            last: counted.mux(i.place, q.last),
            sample: i.take,
            position: counted.mux(before + step, q.position),
            lost: (q.lost | (i.take & (i.fault | (q.known & far)))) & !i.clear,
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let wide = |word: U| word.resize(self.place + 2).signed();
        let counts = i.modulus.is_zero().word().join(i.modulus);
        let gone = wide(i.place) - wide(q.last);
        let across = counts.shift_right(1).below_any(gone.magnitude());
        let back = gone
            .is_negative()
            .mux(gone + wide(counts), gone - wide(counts));
        let way = across.mux(back, gone);
        let far = counts.shift_right(2).below_any(way.magnitude());

        let counted = i.take & !i.fault;
        let first = i.place.resize(self.position).signed();
        let moved = q.known.mux(q.position + way.resize(self.position), first);
        let position = next.position.equals(counted.mux(moved, q.position));
        let last = next.last.equals(counted.mux(i.place, q.last));
        let known = (q.known | counted) & !i.clear;
        let lost = (q.lost | (i.take & (i.fault | (q.known & far)))) & !i.clear;
        let flags = next.sample.equals(i.take) & next.lost.equals(lost) & next.known.equals(known);
        vec![Property::step(
            "the first sample loads its place, and each later one adds the shorter way round",
            &["position", "last", "sample", "lost", "known"],
            position & last & flags,
        )]
    }
}

impl Specified for Unwrapper {}
