//! Completion detector 26: the positioning is complete when the body stands still, when the
//! operation that the control signal starts has taken effect, or when the time-out is over.
//!
//! ```text
//!                          ┌─────────────────────┐
//!  evaluate, position ────▶│                     ├──▶ complete
//!  active, effect ────────▶│ completion detector │
//!  standstill, time_out ──▶│                     ├──▶ timed_out
//!                          └─────────────────────┘
//! ```
//!
//! Departure: the text leaves open how long a standstill has to last and which of the two
//! conditions is used. Here both are used, and `timed_out` is high if neither was met in time.

use crate::prelude::*;

/// Completion detector 26; `complete` is high in the tick after the sample that decides.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompletionDetector {
    /// Width of a position.
    pub position: usize,
    /// Width of a time in CKs.
    pub time: usize,
}

signals! { for CompletionDetector as c;
    /// Input ports.
    pub struct In {
        /// A sample of the position is new in this tick.
        pub evaluate: Bit,
        /// Dx.
        pub position: I(c.position),
        /// The control signal has been given for the running step.
        pub active: Bit,
        /// The operation that the control signal starts has taken effect.
        pub effect: Bit,
        /// CKs without a change that count as a standstill; 0 counts as 1.
        pub standstill: U(c.time),
        /// CKs from the control signal after which the positioning is complete in any case; 0
        /// counts as 1.
        pub time_out: U(c.time),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Previous sample.
        last: I(c.position),
        /// CKs without a change so far.
        still: U(c.time) as Analog,
        /// CKs since the control signal.
        elapsed: U(c.time) as Analog,
        /// High for one tick: the positioning is complete.
        pub complete: Bit,
        /// The time-out came before standstill or effect; valid until the next positioning is
        /// complete.
        pub timed_out: Bit,
    }
    /// Nets.
    pub struct Net {
        /// The sample equals the previous one.
        same: Bit,
        /// CKs without a change, including this one.
        next_still: U(c.time),
        /// CKs since the control signal, including this one.
        next_elapsed: U(c.time),
        /// A positioning is waiting for its completion.
        running: Bit,
        /// The body stands still.
        stands: Bit,
        /// The body stands still, or the operation has taken effect.
        done: Bit,
        /// The positioning is completed by this sample.
        over: Bit,
        /// The counts are enabled in this tick.
        counts: Bit,
    }
}

/// High if one more CK makes `limit`, where 0 counts as 1.
fn is_last(count: U, limit: U) -> Bit {
    limit.is_zero() | !count.below(limit - 1)
}

/// High if `after` is one more than `before`, without a wrap.
fn one_more(before: U, after: U) -> Bit {
    after.equals(before + 1) & before.below(after)
}

impl Circuit for CompletionDetector {
    const NAME: &'static str = "completion_detector";
    const ABOUT: &'static str = "detects that the body stands still, or that the time-out is over";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let same = i.position.equals(q.last);
        let next_still = q.still + 1;
        let next_elapsed = q.elapsed + 1;
        let stands = same & !next_still.below(i.standstill);
        let late = !next_elapsed.below(i.time_out);
        let running = i.active & !q.complete;
        let done = stands | i.effect;
        let over = i.evaluate & running & (done | late);
        let counts = running & !over;
        let count = |more: Bit, next: U, old: U| {
            let counted = i.evaluate.mux(more.mux(next, 0), old);
            counts.mux(counted, 0)
        };
        let edge = Reg {
            last: i.evaluate.mux(i.position, q.last),
            still: count(same, next_still, q.still),
            elapsed: count(Bit::high(), next_elapsed, q.elapsed),
            complete: over,
            timed_out: over.mux(!done, q.timed_out),
        };
        let net = Net {
            same,
            next_still,
            next_elapsed,
            running,
            stands,
            done,
            over,
            counts,
        };
        (net, edge)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, next) = (&now.i, &now.q, &now.next.q);
        let runs = i.active & !q.complete;
        let rests = i.position.equals(q.last);
        let done = (rests & is_last(q.still, i.standstill)) | i.effect;
        let completes = i.evaluate & runs & (done | is_last(q.elapsed, i.time_out));
        let timed_out = next.complete.mux(!done, q.timed_out);

        let zero = next.still.is_zero() & next.elapsed.is_zero();
        let kept = next.still.equals(q.still) & next.elapsed.equals(q.elapsed);
        let still = rests.mux(one_more(q.still, next.still), next.still.is_zero());
        let counted = still & one_more(q.elapsed, next.elapsed);
        let sampled = next.complete.mux(zero, counted);

        let most = u64::MAX.cut(self.time);
        vec![
            Property::step(
                "complete follows standstill, effect or the time limit, which sets timed_out",
                &["complete", "timed_out"],
                next.complete.equals(completes) & next.timed_out.equals(timed_out),
            ),
            Property::step(
                "while active is high, elapsed counts all samples and still those at rest",
                &["still", "elapsed"],
                runs.mux(i.evaluate.mux(sampled, kept), zero),
            ),
            Property::step(
                "last holds the previous sample",
                &["last"],
                next.last.equals(i.evaluate.mux(i.position, q.last)),
            ),
            Property::always(
                "still and elapsed never reach their greatest value",
                &["still", "elapsed"],
                q.still.below(most) & q.elapsed.below(most),
            ),
        ]
    }
}

impl Specified for CompletionDetector {}
