//! Target data 20 (¶0004): the positioning cycles to come, first in, first out.
//!
//! ```text
//!                          ┌─────────────┐
//!  push, x … times ───────▶│             ├──▶ ready, available
//!  pop ───────────────────▶│ target data ├──▶ target_x, target_y, target_speed,
//!  flush ─────────────────▶│             │    target_acceleration, target_deceleration
//!                          └─────────────┘
//! ```
//!
//! Departure: the text has the target positions ready in a table; here they come from a control
//! computer through a buffer, so a job may be of any length, and each brings its speed and its
//! times along.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Ram, Signed, Sim, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const P: usize, const T: usize> {
        /// A target is given; not taken unless `ready`.
        pub push: L::Bit,
        /// Its X.
        pub x: L::I<P>,
        /// Its Y.
        pub y: L::I<P>,
        /// Steady speed on the way there: steps of the master axis a scan.
        pub speed: L::U<P>,
        /// Acceleration time in scans.
        pub acceleration_time: L::U<T>,
        /// Deceleration time in scans.
        pub deceleration_time: L::U<T>,
        /// The next target comes to the outputs, if there is one.
        pub pop: L::Bit,
        /// What was pushed before this tick is forgotten.
        pub flush: L::Bit,
    }
}

signals! {
    /// Flip-flops and memories.
    pub struct Reg<L, const A: usize, const P: usize, const T: usize> {
        /// Where the next target is written.
        write_address: L::U<A> as Hex = 0,
        /// Where the next target is read.
        read_address: L::U<A> as Hex = 0,
        /// X of the target that was popped last.
        pub target_x: L::I<P> = 0,
        /// Y of it.
        pub target_y: L::I<P> = 0,
        /// Its speed.
        pub target_speed: L::U<P> = 0,
        /// Its acceleration time.
        pub target_acceleration: L::U<T> = 0,
        /// Its deceleration time.
        pub target_deceleration: L::U<T> = 0,
        /// Buffer of X.
        xs: L::Ram<A, P>,
        /// Buffer of Y.
        ys: L::Ram<A, P>,
        /// Buffer of speeds.
        speeds: L::Ram<A, P>,
        /// Buffer of acceleration times.
        accelerations: L::Ram<A, T>,
        /// Buffer of deceleration times.
        decelerations: L::Ram<A, T>,
    }
}

signals! {
    /// Nets.
    pub struct Net<L> {
        /// A push is taken.
        pub ready: L::Bit,
        /// There is a target to be popped.
        pub available: L::Bit,
        /// A push is taken in this tick.
        take: L::Bit,
        /// A target comes to the outputs with this tick.
        bring: L::Bit,
    }
}

/// Target data 20: a buffer of 2^`A` − 1 targets with positions of `P` bits and times of `T` bits.
///
/// A target is available in the tick after its push, and stands at the outputs in the tick after
/// its pop, until the next.
#[derive(Debug, Clone, Default)]
pub struct TargetData<const A: usize, const P: usize, const T: usize>;

impl<const A: usize, const P: usize, const T: usize> Circuit for TargetData<A, P, T> {
    const NAME: &'static str = "target_data";
    const ABOUT: &'static str = "buffer of the positioning cycles to come";
    type In<L: Logic> = In<L, A, P, T>;
    type Reg<L: Logic> = Reg<L, A, P, T>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, P, T>, i: &In<L, A, P, T>) -> Net<L> {
        let ready = !(q.write_address + 1).equals(q.read_address);
        let available = !q.write_address.equals(q.read_address);
        Net {
            ready,
            available,
            take: i.push & (ready | i.flush),
            bring: i.pop & available & !i.flush,
        }
    }

    fn next<L: Logic>(
        &self,
        q: Reg<L, A, P, T>,
        w: &Net<L>,
        i: &In<L, A, P, T>,
    ) -> Reg<L, A, P, T> {
        let (at, to) = (q.read_address, q.write_address);
        let next_at = w.bring.mux(at + 1, at);
        let (x, y) = (q.target_x.unsigned(), q.target_y.unsigned());
        Reg {
            write_address: w.take.mux(to + 1, to),
            read_address: i.flush.mux(to, next_at),
            target_x: q.xs.read_when(w.bring, at, x).signed(),
            target_y: q.ys.read_when(w.bring, at, y).signed(),
            target_speed: q.speeds.read_when(w.bring, at, q.target_speed),
            target_acceleration: q
                .accelerations
                .read_when(w.bring, at, q.target_acceleration),
            target_deceleration: q
                .decelerations
                .read_when(w.bring, at, q.target_deceleration),
            xs: q.xs.write(w.take, to, i.x.unsigned()),
            ys: q.ys.write(w.take, to, i.y.unsigned()),
            speeds: q.speeds.write(w.take, to, i.speed),
            accelerations: q.accelerations.write(w.take, to, i.acceleration_time),
            decelerations: q.decelerations.write(w.take, to, i.deceleration_time),
        }
    }
}

/// The fields of a target as numbers, X first.
fn fields<const A: usize, const P: usize, const T: usize>(i: &In<Sim, A, P, T>) -> [u64; 5] {
    let (x, y) = (i.x.unsigned().get(), i.y.unsigned().get());
    let times = (i.acceleration_time.get(), i.deceleration_time.get());
    [x, y, i.speed.get(), times.0, times.1]
}

/// The fields of the target in the buffer at `address`.
fn buffered<const A: usize, const P: usize, const T: usize>(
    q: &Reg<Sim, A, P, T>,
    address: u64,
) -> [u64; 5] {
    let address = address.into();
    [
        q.xs.read(address).get(),
        q.ys.read(address).get(),
        q.speeds.read(address).get(),
        q.accelerations.read(address).get(),
        q.decelerations.read(address).get(),
    ]
}

/// The fields of the target at the outputs.
fn shown<const A: usize, const P: usize, const T: usize>(q: &Reg<Sim, A, P, T>) -> [u64; 5] {
    let (x, y) = (q.target_x.unsigned().get(), q.target_y.unsigned().get());
    let times = (q.target_acceleration.get(), q.target_deceleration.get());
    [x, y, q.target_speed.get(), times.0, times.1]
}

impl<const A: usize, const P: usize, const T: usize> Specified for TargetData<A, P, T> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let level = |q: &Reg<Sim, A, P, T>| {
            (q.write_address.get() + (1 << A) - q.read_address.get()) % (1 << A)
        };
        let waiting = move |q: &Reg<Sim, A, P, T>| -> Vec<[u64; 5]> {
            let first = q.read_address.get();
            let places = (0..level(q)).map(|k| (first + k) % (1 << A));
            places.map(|address| buffered(q, address)).collect()
        };
        Invariants::<Self>::new()
            .step(
                "a push goes behind what waits, a pop takes the first, a flush all",
                move |now, next| {
                    let i = now.i;
                    let mut expected = waiting(now.q);
                    let pushed = i.push.get() && (i.flush.get() || expected.len() < (1 << A) - 1);
                    if i.flush.get() {
                        expected.clear();
                    } else if i.pop.get() && !expected.is_empty() {
                        expected.remove(0);
                    }
                    expected.extend(pushed.then(|| fields(i)));
                    let signals = ["write_address", "read_address", "xs", "ys"];
                    require(waiting(next) == expected, signals, || {
                        format!("{expected:?} expected")
                    })
                },
            )
            .step("the outputs show what was popped last", move |now, next| {
                let popped = now.i.pop.get() && !now.i.flush.get();
                let first = waiting(now.q).first().copied().filter(|_| popped);
                let expected = first.unwrap_or_else(|| shown(now.q));
                require(shown(next) == expected, ["target_x", "target_y"], || {
                    format!("{expected:?}")
                })
            })
            .always("ready unless full, available unless empty", move |now| {
                let level = level(now.q);
                let right = now.w.ready.get() == (level + 1 < 1 << A)
                    && now.w.available.get() == (level > 0);
                require(right, ["ready", "available"], || format!("{level} wait"))
            })
    }

    /// All fields of a target alike: none looks at another.
    fn applies(&self, i: &In<Sim, A, P, T>) -> bool {
        let [x, others @ ..] = fields(i);
        others.iter().all(|field| *field == x) && (i.push.get() || x == 0)
    }
}
