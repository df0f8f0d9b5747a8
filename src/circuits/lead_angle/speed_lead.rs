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

use crate::hdl::prelude::*;

/// Conventional lead. A position that stands in the tick of CK is at `present` in the tick after it.
#[derive(Debug, Clone)]
pub struct SpeedLead {
    /// Width of a position.
    pub position: usize,
    /// Width of a gate in CKs.
    pub gate: usize,
}

signals! { for SpeedLead as c;
    /// Ports in.
    pub struct In {
        /// CK: a sample is taken.
        pub ck: Bit,
        /// What was sampled so far counts no more.
        pub restart: Bit,
        /// The position.
        pub position: I(c.position),
        /// a: lead time in gates, in 1/256 of a gate.
        pub lead_parameter: U(14),
        /// CKs of a gate; 0 counts as 1.
        pub gate: U(c.gate),
    }
    /// Flip-flops.
    pub struct Reg {
        /// Dx: the present sample.
        pub present: I(c.position) as Analog,
        /// The sample is new in this tick.
        pub fresh: Bit,
        /// A whole gate was measured since the last restart.
        pub enough: Bit,
        /// CKs of the gate that are over.
        count: U(c.gate),
        /// A sample began the gate.
        begun: Bit,
        /// The sample that the gate began with.
        gate_position: I(c.position),
        /// 2: ν, counts of the last gate.
        speed: I(c.position) as Analog,
    }
    /// Nets.
    pub struct Net {
        /// CKs of the gate with this one.
        next_count: U(c.gate),
        /// The gate ends with this sample.
        over: Bit,
        /// Way of the gate that ends.
        way: I(c.position),
        /// A gate begins with this sample.
        begins: Bit,
        /// a with a sign.
        factor: I(15),
        /// ν·a in 1/256 of a count.
        product: I(64),
        /// 1: θa.
        pub lead: I(c.position) as Analog,
    }
}

impl Circuit for SpeedLead {
    const NAME: &'static str = "speed_lead";
    const ABOUT: &'static str = "conventional lead: measured speed times a parameter";
    records!(In, Reg, Net);

    fn objection(&self) -> Option<String> {
        let fits = self.position + 15 <= 64;
        (!fits).then(|| "a position has at most 49 bits, its product with a at most 64".into())
    }

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next_count = q.count + 1;
        let factor = i.lead_parameter.resize(15).signed();
        let product = q.speed.times(factor, 64);
        let over = i.ck & q.begun & !next_count.below(i.gate);
        let way = i.position - q.gate_position;
        let begins = over | (i.ck & !q.begun);
        let counted = i.ck.mux(next_count, q.count);
        let edge = Reg {
            present: i.ck.mux(i.position, q.present),
            fresh: i.ck & !i.restart,
            enough: (q.enough | over) & !i.restart,
            count: (begins | i.restart).mux(0, counted),
            begun: (q.begun | i.ck) & !i.restart,
            gate_position: begins.mux(i.position, q.gate_position),
            speed: over.mux(way, q.speed),
        };
        let net = Net {
            next_count,
            over,
            way,
            begins,
            factor,
            product,
            lead: product.shift_right(8).resize(self.position),
        };
        (net, edge)
    }
}

impl Specified for SpeedLead {
    fn invariants(&self) -> Invariants<'_, Self> {
        let range = 1i128 << self.position;
        Invariants::<Self>::new()
            .always("the lead is the speed's share, rounded down", move |now| {
                let product = i128::from(now.q.speed) * i128::from(now.i.lead_parameter);
                let lead = i128::from(now.w.lead);
                let right = (product.div_euclid(256) - lead) % range == 0;
                require(right, ["lead"], || format!("{lead} for {product}"))
            })
            .step(
                "a gate ends with its last CK and gives its way",
                move |now, next| {
                    let (q, i, next) = (now.q, now.i, &next.q);
                    let ends = i.ck && q.begun && q.count + 1 >= i.gate.max(1);
                    let way = i.position - q.gate_position;
                    let right = match ends {
                        true => i128::from(way - next.speed) % range == 0,
                        false => next.speed == q.speed,
                    };
                    let enough = (q.enough || ends) && !i.restart;
                    require(right && next.enough == enough, ["speed", "enough"], || {
                        format!("a way of {way}")
                    })
                },
            )
            .step(
                "a gate begins where the one before ends, or with the first sample",
                |now, next| {
                    let (q, i, next) = (now.q, now.i, &next.q);
                    let ends = i.ck && q.begun && q.count + 1 >= i.gate.max(1);
                    let first = i.ck && !q.begun;
                    let position = if ends || first {
                        i.position
                    } else {
                        q.gate_position
                    };
                    let count = match ends || first || i.restart {
                        true => 0,
                        false => q.count + u64::from(i.ck),
                    };
                    let begun = (q.begun || i.ck) && !i.restart;
                    let right = next.gate_position == position
                        && next.count == count
                        && next.begun == begun;
                    require(right, ["gate_position", "count", "begun"], || {
                        format!("{} of {}", next.count, i.gate)
                    })
                },
            )
            .step("the sample is fresh after CK", |now, next| {
                let (ck, restart) = (now.i.ck, now.i.restart);
                let present = if ck { now.i.position } else { now.q.present };
                let right = next.q.present == present && next.q.fresh == (ck && !restart);
                require(right, ["present", "fresh"], || "another".into())
            })
    }

    /// Parameters as a proof can bear: none, one half, one, the greatest.
    fn applies(&self, i: &In<Value>) -> bool {
        [0, 128, 256, 16_383].contains(&i.lead_parameter)
    }
}
