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
use std::array::from_fn;

/// Names of the settings of a target: one for both axes, or X's and Y's.
pub(super) const SPEED: &[&str] = &["speed", "speed_y"];
pub(super) const ACCELERATION_TIME: &[&str] = &["acceleration_time", "acceleration_time_y"];
pub(super) const DECELERATION_TIME: &[&str] = &["deceleration_time", "deceleration_time_y"];
const TARGET_SPEED: &[&str] = &["target_speed", "target_speed_y"];
const TARGET_ACCELERATION: &[&str] = &["target_acceleration", "target_acceleration_y"];
const TARGET_DECELERATION: &[&str] = &["target_deceleration", "target_deceleration_y"];
const SPEEDS: &[&str] = &["speeds", "speeds_y"];
const ACCELERATIONS: &[&str] = &["accelerations", "accel_y"];
const DECELERATIONS: &[&str] = &["decelerations", "decel_y"];

signals! {
    /// Ports in.
    pub struct In<L, const A: usize, const P: usize, const T: usize, const N: usize> {
        /// A target is given; not taken unless `ready`.
        pub push: L::Bit,
        /// Its X.
        pub x: L::I<P>,
        /// Its Y.
        pub y: L::I<P>,
        /// Steady speed on the way there: counts a scan, with `T` bits of fraction.
        pub speed: [L::U<P>; N] as Elements(SPEED),
        /// Acceleration time in scans.
        pub acceleration_time: [L::U<T>; N] as Elements(ACCELERATION_TIME),
        /// Deceleration time in scans.
        pub deceleration_time: [L::U<T>; N] as Elements(DECELERATION_TIME),
        /// The next target comes to the outputs, if there is one.
        pub pop: L::Bit,
        /// What was pushed before this tick is forgotten.
        pub flush: L::Bit,
    }
}

signals! {
    /// Flip-flops and memories.
    pub struct Reg<L, const A: usize, const P: usize, const T: usize, const N: usize> {
        /// Where the next target is written.
        write_address: L::U<A> as Hex = 0,
        /// Where the next target is read.
        read_address: L::U<A> as Hex = 0,
        /// X of the target that was popped last.
        pub target_x: L::I<P> = 0,
        /// Y of it.
        pub target_y: L::I<P> = 0,
        /// Its speed.
        pub target_speed: [L::U<P>; N] as Elements(TARGET_SPEED),
        /// Its acceleration time.
        pub target_acceleration: [L::U<T>; N] as Elements(TARGET_ACCELERATION),
        /// Its deceleration time.
        pub target_deceleration: [L::U<T>; N] as Elements(TARGET_DECELERATION),
        /// Buffer of X.
        xs: L::Ram<A, P>,
        /// Buffer of Y.
        ys: L::Ram<A, P>,
        /// Buffer of speeds.
        speeds: [L::Ram<A, P>; N] as Elements(SPEEDS),
        /// Buffer of acceleration times.
        accelerations: [L::Ram<A, T>; N] as Elements(ACCELERATIONS),
        /// Buffer of deceleration times.
        decelerations: [L::Ram<A, T>; N] as Elements(DECELERATIONS),
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

/// Target data 20: a buffer of 2^`A` − 1 targets with positions of `P` bits and times of `T` bits,
/// each with `N` settings of speed and times, one for both axes or one for each.
///
/// A target is available in the tick after its push, and stands at the outputs in the tick after
/// its pop, until the next.
#[derive(Debug, Clone, Default)]
pub struct TargetData<const A: usize, const P: usize, const T: usize, const N: usize = 1>;

impl<const A: usize, const P: usize, const T: usize, const N: usize> Circuit
    for TargetData<A, P, T, N>
{
    const NAME: &'static str = "target_data";
    const ABOUT: &'static str = "buffer of the positioning cycles to come";
    type In<L: Logic> = In<L, A, P, T, N>;
    type Reg<L: Logic> = Reg<L, A, P, T, N>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, A, P, T, N>, i: &In<L, A, P, T, N>) -> Net<L> {
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
        q: Reg<L, A, P, T, N>,
        w: &Net<L>,
        i: &In<L, A, P, T, N>,
    ) -> Reg<L, A, P, T, N> {
        let (at, to) = (q.read_address, q.write_address);
        let next_at = w.bring.mux(at + 1, at);
        let (x, y) = (q.target_x.unsigned(), q.target_y.unsigned());
        Reg {
            write_address: w.take.mux(to + 1, to),
            read_address: i.flush.mux(to, next_at),
            target_x: q.xs.read_when(w.bring, at, x).signed(),
            target_y: q.ys.read_when(w.bring, at, y).signed(),
            target_speed: from_fn(|n| q.speeds[n].read_when(w.bring, at, q.target_speed[n])),
            target_acceleration: from_fn(|n| {
                q.accelerations[n].read_when(w.bring, at, q.target_acceleration[n])
            }),
            target_deceleration: from_fn(|n| {
                q.decelerations[n].read_when(w.bring, at, q.target_deceleration[n])
            }),
            xs: q.xs.write(w.take, to, i.x.unsigned()),
            ys: q.ys.write(w.take, to, i.y.unsigned()),
            speeds: written::<L, A, _, N>(q.speeds, w.take, to, i.speed),
            accelerations: written::<L, A, _, N>(q.accelerations, w.take, to, i.acceleration_time),
            decelerations: written::<L, A, _, N>(q.decelerations, w.take, to, i.deceleration_time),
        }
    }
}

/// The memories after a write of a word into each.
fn written<L: Logic, const A: usize, const D: usize, const N: usize>(
    rams: [L::Ram<A, D>; N],
    enable: L::Bit,
    address: L::U<A>,
    words: [L::U<D>; N],
) -> [L::Ram<A, D>; N] {
    let mut n = 0;
    rams.map(|ram| {
        n += 1;
        ram.write(enable, address, words[n - 1])
    })
}

/// The fields of a target as numbers, X first.
fn fields<const A: usize, const P: usize, const T: usize, const N: usize>(
    i: &In<Sim, A, P, T, N>,
) -> Vec<u64> {
    let mut fields = vec![i.x.unsigned().get(), i.y.unsigned().get()];
    fields.extend(i.speed.map(|speed| speed.get()));
    fields.extend(i.acceleration_time.map(|time| time.get()));
    fields.extend(i.deceleration_time.map(|time| time.get()));
    fields
}

/// The fields of the target in the buffer at `address`.
fn buffered<const A: usize, const P: usize, const T: usize, const N: usize>(
    q: &Reg<Sim, A, P, T, N>,
    address: u64,
) -> Vec<u64> {
    let address = address.into();
    let mut fields = vec![q.xs.read(address).get(), q.ys.read(address).get()];
    fields.extend(q.speeds.iter().map(|ram| ram.read(address).get()));
    fields.extend(q.accelerations.iter().map(|ram| ram.read(address).get()));
    fields.extend(q.decelerations.iter().map(|ram| ram.read(address).get()));
    fields
}

/// The fields of the target at the outputs.
fn shown<const A: usize, const P: usize, const T: usize, const N: usize>(
    q: &Reg<Sim, A, P, T, N>,
) -> Vec<u64> {
    let (x, y) = (q.target_x.unsigned().get(), q.target_y.unsigned().get());
    let mut fields = vec![x, y];
    fields.extend(q.target_speed.map(|speed| speed.get()));
    fields.extend(q.target_acceleration.map(|time| time.get()));
    fields.extend(q.target_deceleration.map(|time| time.get()));
    fields
}

impl<const A: usize, const P: usize, const T: usize, const N: usize> Specified
    for TargetData<A, P, T, N>
{
    fn invariants(&self) -> Invariants<'_, Self> {
        let level = |q: &Reg<Sim, A, P, T, N>| {
            (q.write_address.get() + (1 << A) - q.read_address.get()) % (1 << A)
        };
        let waiting = move |q: &Reg<Sim, A, P, T, N>| -> Vec<Vec<u64>> {
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
                let first = waiting(now.q).into_iter().next().filter(|_| popped);
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
    fn applies(&self, i: &In<Sim, A, P, T, N>) -> bool {
        let fields = fields(i);
        fields.iter().all(|field| *field == fields[0]) && (i.push.get() || fields[0] == 0)
    }
}
