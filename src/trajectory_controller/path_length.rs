//! Path length: qc, how far along the path the command is, for an interpolation period.
//!
//! ```text
//!             ┌─────────────┐
//!  sample ───▶│             ├──▶ length
//!  present ──▶│ path_length ├──▶ preset, fresh
//!  profile ──▶│             ├──▶ held
//!  restart ──▶│             │
//!             └─────────────┘
//! ```
//!
//! From power-on and from `restart` to its first length there is no path: its segments may be
//! written, and no point is looked up.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const P: usize> {
        /// An interpolation period begins.
        pub sample: L::Bit,
        /// The profile has a length for it.
        pub present: L::Bit,
        /// The length.
        pub profile: L::I<P>,
        /// Another path: there is none before its first length. What was begun with the last
        /// length goes on: segments are written from the next beginning of a period on.
        pub restart: L::Bit,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const P: usize> {
        /// qc: the length along the path.
        pub length: L::I<P> as Analog = 0,
        /// There is no path yet.
        pub waiting: L::Bit = 1,
        /// A period has begun.
        begun: L::Bit = 0,
        /// The length is the first of a path: the tangential response goes there at once.
        pub preset: L::Bit = 0,
        /// A period has begun with the length that stands.
        pub fresh: L::Bit = 0,
        /// A period has begun without a path: commands stay as they are.
        pub held: L::Bit = 0,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// There is no path in this tick.
        none: L::Bit,
    }
}

/// Register of a length of `P` bits.
///
/// `fresh` or `held` is high 2 ticks after `sample`.
#[derive(Debug, Clone, Default)]
pub struct PathLength<const P: usize>;

impl<const P: usize> Circuit for PathLength<P> {
    const NAME: &'static str = "path_length";
    const ABOUT: &'static str = "how far along the path the command is";
    type In<L: Logic> = In<L, P>;
    type Reg<L: Logic> = Reg<L, P>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, P>, i: &In<L, P>) -> Net<L> {
        Net {
            none: i.restart | (q.waiting & !i.present),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, P>, w: &Net<L>, i: &In<L, P>) -> Reg<L, P> {
        Reg {
            length: (i.present & !i.restart).mux(i.profile, q.length),
            waiting: w.none,
            begun: i.sample,
            preset: i.present & q.waiting & !i.restart,
            fresh: q.begun & !w.none,
            held: q.begun & w.none,
        }
    }
}

impl<const P: usize> Specified for PathLength<P> {
    fn invariants(&self) -> Invariants<'_, Self> {
        Invariants::<Self>::new()
            .step(
                "the length is the profile's last, but for one that comes with restart",
                |now, next| {
                    let i = now.i;
                    let expected = match i.present.get() && !i.restart.get() {
                        true => i.profile,
                        false => now.q.length,
                    };
                    let right = next.length == expected;
                    require(right, ["length"], || format!("not {expected:?}"))
                },
            )
            .step(
                "there is no path from power-on or restart to the first length",
                |now, next| {
                    let without = now.q.waiting.get();
                    let (waits, first) = match (now.i.restart.get(), now.i.present.get()) {
                        (true, _) => (true, false),
                        (false, true) => (false, without),
                        (false, false) => (without, false),
                    };
                    let right = next.waiting.get() == waits && next.preset.get() == first;
                    require(right, ["waiting", "preset"], || {
                        format!("not {waits}, {first}")
                    })
                },
            )
            .step(
                "two ticks after its beginning a period is one with a length, or one without a path",
                |now, next| {
                    let due = match now.q.begun.get() {
                        true => [!next.waiting.get(), next.waiting.get()],
                        false => [false; 2],
                    };
                    let right = [next.fresh.get(), next.held.get()] == due
                        && next.begun == now.i.sample;
                    require(right, ["fresh", "held", "begun"], || format!("not {due:?}"))
                },
            )
    }
}
