//! The conventional lead of Fig. 7: speed detector 2 and lead angle calculation 1.
//!
//! ```text
//!                          ┌────────────┐
//!  ck, position, restart ─▶│            ├──▶ present, speed, lead
//!  lead_parameter, gate ──▶│ speed lead ├──▶ fresh, enough
//!                          └────────────┘
//! ```
//!
//! The speed is the way of a gate of so many CKs, and stands until the next gate is over: on
//! average it is a whole gate old, which is what the text holds against the method.
//! The lead is speed times `lead_parameter` (a), rounded down: θa = f(ν, a) for a constant stopping time.

use crate::check::{Invariants, Specified, require};
use crate::kernel::Circuit;
use crate::logic::{Bit, Logic, Signed, Unsigned};
use crate::signals;

signals! {
    /// Ports in.
    pub struct In<L, const W: usize, const N: usize> {
        /// CK: a sample is taken.
        pub ck: L::Bit,
        /// What was sampled so far counts no more.
        pub restart: L::Bit,
        /// The position.
        pub position: L::I<W>,
        /// a: lead time in gates, in 1/256 of a gate.
        pub lead_parameter: L::U<14>,
        /// CKs of a gate; 0 counts as 1.
        pub gate: L::U<N>,
    }
}

signals! {
    /// Flip-flops.
    pub struct Reg<L, const W: usize, const N: usize> {
        /// Dx: the present sample.
        pub present: L::I<W> as Analog,
        /// The sample is new in this tick.
        pub fresh: L::Bit,
        /// A whole gate was measured since the last restart.
        pub enough: L::Bit,
        /// CKs of the gate that are over.
        count: L::U<N>,
        /// A sample began the gate.
        begun: L::Bit,
        /// The sample that the gate began with.
        gate_position: L::I<W>,
        /// 2: ν, counts of the last gate.
        speed: L::I<W> as Analog,
    }
}

signals! {
    /// Nets.
    pub struct Net<L, const W: usize, const N: usize> {
        /// CKs of the gate with this one.
        next_count: L::U<N>,
        /// The gate ends with this sample.
        over: L::Bit,
        /// Way of the gate that ends.
        way: L::I<W>,
        /// A gate begins with this sample.
        begins: L::Bit,
        /// a with a sign.
        factor: L::I<15>,
        /// ν·a in 1/256 of a count.
        product: L::I<64>,
        /// 1: θa.
        pub lead: L::I<W> as Analog,
    }
}

/// Conventional lead for positions of `W` bits, gates of `N`. A position that stands in the tick of
/// CK is at `present` in the tick after it.
#[derive(Debug, Clone, Default)]
pub struct SpeedLead<const W: usize, const N: usize>;

impl<const W: usize, const N: usize> Circuit for SpeedLead<W, N> {
    const NAME: &'static str = "speed_lead";
    const ABOUT: &'static str = "conventional lead: measured speed times a parameter";
    type In<L: Logic> = In<L, W, N>;
    type Reg<L: Logic> = Reg<L, W, N>;
    type Net<L: Logic> = Net<L, W, N>;

    fn comb<L: Logic>(&self, q: &Reg<L, W, N>, i: &In<L, W, N>) -> Net<L, W, N> {
        const { assert!(W + 15 <= 64, "the product has at most 64 bits") };
        let next_count = q.count + 1;
        let factor = i.lead_parameter.resize::<15>().signed();
        let product = q.speed.times::<15, 64>(factor);
        let over = i.ck & q.begun & !next_count.below(i.gate);
        Net {
            next_count,
            over,
            way: i.position - q.gate_position,
            begins: over | (i.ck & !q.begun),
            factor,
            product,
            lead: product.shift_right(8).resize(),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W, N>, w: &Net<L, W, N>, i: &In<L, W, N>) -> Reg<L, W, N> {
        let counted = i.ck.mux(w.next_count, q.count);
        Reg {
            present: i.ck.mux(i.position, q.present),
            fresh: i.ck & !i.restart,
            enough: (q.enough | w.over) & !i.restart,
            count: (w.begins | i.restart).mux(0.into(), counted),
            begun: (q.begun | i.ck) & !i.restart,
            gate_position: w.begins.mux(i.position, q.gate_position),
            speed: w.over.mux(w.way, q.speed),
        }
    }
}

impl<const W: usize, const N: usize> Specified for SpeedLead<W, N> {
    fn invariants(&self) -> Invariants<'_, Self> {
        let range = 1i128 << W;
        Invariants::<Self>::new()
            .always("the lead is the speed's share, rounded down", move |now| {
                let product =
                    i128::from(now.q.speed.get()) * i128::from(now.i.lead_parameter.get());
                let lead = i128::from(now.w.lead.get());
                let right = (product.div_euclid(256) - lead) % range == 0;
                require(right, ["lead"], || format!("{lead} for {product}"))
            })
            .step(
                "a gate ends with its last CK and gives its way",
                move |now, next| {
                    let (q, i) = (now.q, now.i);
                    let length = i.gate.get().max(1);
                    let ends = i.ck.get() && q.begun.get() && q.count.get() + 1 >= length;
                    let way = i.position.get() - q.gate_position.get();
                    let right = match ends {
                        true => i128::from(way - next.speed.get()) % range == 0,
                        false => next.speed == q.speed,
                    };
                    let enough = (q.enough.get() || ends) && !i.restart.get();
                    require(
                        right && next.enough.get() == enough,
                        ["speed", "enough"],
                        || format!("a way of {way}"),
                    )
                },
            )
            .step(
                "a gate begins where the one before ends, or with the first sample",
                |now, next| {
                    let (q, i) = (now.q, now.i);
                    let ends =
                        i.ck.get() && q.begun.get() && q.count.get() + 1 >= i.gate.get().max(1);
                    let first = i.ck.get() && !q.begun.get();
                    let position = if ends || first {
                        i.position
                    } else {
                        q.gate_position
                    };
                    let count = match ends || first || i.restart.get() {
                        true => 0,
                        false => q.count.get() + u64::from(i.ck.get()),
                    };
                    let begun = (q.begun.get() || i.ck.get()) && !i.restart.get();
                    let right = next.gate_position == position
                        && next.count.get() == count
                        && next.begun.get() == begun;
                    require(right, ["gate_position", "count", "begun"], || {
                        format!("{} of {}", next.count.get(), i.gate.get())
                    })
                },
            )
            .step("the sample is fresh after CK", |now, next| {
                let (ck, restart) = (now.i.ck.get(), now.i.restart.get());
                let present = if ck { now.i.position } else { now.q.present };
                let right = next.present == present && next.fresh.get() == (ck && !restart);
                require(right, ["present", "fresh"], || "another".into())
            })
    }

    /// Parameters as a proof can bear: none, one half, one, the greatest.
    fn applies(&self, i: &In<crate::logic::Sim, W, N>) -> bool {
        [0, 128, 256, 16_383].contains(&i.lead_parameter.get())
    }
}
