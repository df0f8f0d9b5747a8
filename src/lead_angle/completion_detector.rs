//! Completion detector 26: the positioning is complete when the body stands still, or when its time
//! is over.
//!
//! ```text
//!                          ┌─────────────────────┐
//!  evaluate, position ────▶│                     ├──▶ complete
//!  active ────────────────▶│ completion detector │
//!  standstill, time_out ──▶│                     ├──▶ timed_out
//!                          └─────────────────────┘
//! ```
//!
//! Departure: the text leaves open how long a standstill has to last and which of the two
//! conditions is used. Both are, and which of them it was is told.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize, const N: usize> {
        /// A sample of the position is new in this tick.
        pub evaluate: L::Bit,
        /// Dx.
        pub position: L::I<W>,
        /// The control signal has been given for the step that runs.
        pub active: L::Bit,
        /// CKs without a change that are a standstill; 0 counts as 1.
        pub standstill: L::U<N>,
        /// CKs from the control signal on after which it is complete anyway; 0 counts as 1.
        pub time_out: L::U<N>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize, const N: usize> {
        /// The sample before.
        last: L::I<W>,
        /// CKs without a change.
        still: L::U<N> as Analog,
        /// CKs since the control signal.
        elapsed: L::U<N> as Analog,
        /// The positioning is complete; one tick.
        pub complete: L::Bit,
        /// Its time was over before it stood still; until the next.
        pub timed_out: L::Bit,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const N: usize> {
        /// The sample is the same as the one before.
        same: L::Bit,
        /// CKs without a change, this one included.
        next_still: L::U<N>,
        /// CKs since the control signal, this one included.
        next_elapsed: L::U<N>,
        /// A positioning is being completed.
        running: L::Bit,
        /// It stands still.
        stands: L::Bit,
        /// It is complete with this sample.
        over: L::Bit,
        /// The times go on.
        counts: L::Bit,
    }
}

/// Completion detector 26 of positions of `W` bits and times of `N` bits, in CKs; `complete` shows
/// in the tick after the sample that decides.
#[derive(Debug, Clone, Default)]
pub struct CompletionDetector<const W: usize, const N: usize>;

impl<const W: usize, const N: usize> Circuit for CompletionDetector<W, N> {
    const NAME: &'static str = "completion_detector";
    const ABOUT: &'static str = "finds that the body stands still, or that its time is over";
    type In<L: Logic> = In<L, W, N>;
    type Reg<L: Logic> = Reg<L, W, N>;
    type Net<L: Logic> = Net<L, N>;

    fn comb<L: Logic>(&self, q: &Reg<L, W, N>, i: &In<L, W, N>) -> Net<L, N> {
        let same = i.position.equals(q.last);
        let next_still = q.still + 1;
        let next_elapsed = q.elapsed + 1;
        let stands = same & !next_still.below(i.standstill);
        let late = !next_elapsed.below(i.time_out);
        let running = i.active & !q.complete;
        let over = i.evaluate & running & (stands | late);
        Net {
            same,
            next_still,
            next_elapsed,
            running,
            stands,
            over,
            counts: running & !over,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W, N>, w: &Net<L, N>, i: &In<L, W, N>) -> Reg<L, W, N> {
        let count = |more: L::Bit, next: L::U<N>, old: L::U<N>| {
            let counted = i.evaluate.mux(more.mux(next, 0.into()), old);
            w.counts.mux(counted, 0.into())
        };
        Reg {
            last: i.evaluate.mux(i.position, q.last),
            still: count(w.same, w.next_still, q.still),
            elapsed: count(true.into(), w.next_elapsed, q.elapsed),
            complete: w.over,
            timed_out: w.over.mux(!w.stands, q.timed_out),
        }
    }
}

impl<const W: usize, const N: usize> Specified for CompletionDetector<W, N> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "it is complete when it stood still for long enough, or its time is over",
                |now, next| {
                    let (i, q) = (now.i, now.q);
                    let still = match i.position == q.last {
                        true => q.still.get() + 1,
                        false => 0,
                    };
                    let stands = still >= i.standstill.get().max(1);
                    let late = q.elapsed.get() + 1 >= i.time_out.get().max(1);
                    let looks = i.evaluate.get() && i.active.get() && !q.complete.get();
                    let right = next.complete.get() == (looks && (stands || late))
                        && (!next.complete.get() || next.timed_out.get() != stands)
                        && (next.complete.get() || next.timed_out == q.timed_out);
                    require(right, ["complete", "timed_out"], || {
                        format!("still for {still}, {} since control", q.elapsed.get() + 1)
                    })
                },
            )
            .step(
                "both times count from the control signal on",
                |now, next| {
                    let (i, q) = (now.i, now.q);
                    let (still, elapsed) =
                        match (i.active.get() && !q.complete.get(), i.evaluate.get()) {
                            (false, _) => (0, 0),
                            (true, false) => (q.still.get(), q.elapsed.get()),
                            (true, true) if next.complete.get() => (0, 0),
                            (true, true) => match i.position == q.last {
                                true => (q.still.get() + 1, q.elapsed.get() + 1),
                                false => (0, q.elapsed.get() + 1),
                            },
                        };
                    let right = next.still.get() == still && next.elapsed.get() == elapsed;
                    require(right, ["still", "elapsed"], || {
                        format!("{still} and {elapsed} expected")
                    })
                },
            )
            .step("the sample before is kept", |now, next| {
                let last = match now.i.evaluate.get() {
                    true => now.i.position,
                    false => now.q.last,
                };
                require(next.last == last, ["last"], || "another".into())
            })
            .always("neither count reaches its greatest value", |now| {
                let most = (1 << N) - 1;
                let right = now.q.still.get() < most && now.q.elapsed.get() < most;
                require(right, ["still", "elapsed"], || "it would wrap".into())
            })
    }
}
