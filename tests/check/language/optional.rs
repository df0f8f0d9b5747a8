//! Optional ports, registers, nets and parts, and input ports that are left low.

use super::*;
use motion_rtl::sim::Elaborated;

/// A counter of choice that can be limited, and adds up to 15 without a port.
#[derive(Debug, Clone, Copy)]
struct Meter {
    /// It has a limit.
    limited: bool,
    /// Width of the sum.
    width: usize,
}

impl Meter {
    fn wide(&self, least: usize) -> bool {
        self.width >= least
    }

    fn counter(&self) -> Counter {
        Counter {
            width: self.width,
            other: self.width,
        }
    }
}

signals! { for Meter as c;
    /// A bundle.
    struct Bounds {
        /// Least number.
        least: U(c.width),
        /// Greatest number.
        greatest: U(c.width) if c.wide(5),
    }
    /// Ports in.
    struct MeterIn {
        /// Summand.
        by: U(c.width),
        /// The limits.
        bounds: Bounds(c) if c.limited,
    }
    /// Registers.
    struct MeterReg {
        /// The sum of before.
        pub last: U(c.width) as Hex if (c.width > 4) = 9,
        /// Its last bits.
        bits: [Bit; 2] if c.limited,
    }
    /// The counter.
    struct MeterParts {
        /// The counter.
        counter: Part<Counter>(c.counter()) if c.limited,
    }
    /// Nets.
    struct MeterNet {
        /// The sum.
        pub sum: U(c.width) if c.limited,
        /// The summand again.
        pub by_again: U(c.width),
    }
}

impl Circuit for Meter {
    const NAME: &'static str = "meter";
    const ABOUT: &'static str = "adds up, if it has a counter";
    records!(MeterIn, MeterReg, MeterNet, MeterParts);

    fn tick(&self, i: MeterIn, q: MeterReg, p: MeterParts) -> (MeterNet, MeterReg<Edge>) {
        let bounds = i.bounds.as_ref();
        let by = bounds.map_or(i.by, |bounds| i.by.below(bounds.least).mux(0, i.by));
        let counter = p.counter.map(|part| part.settle(In { by }));
        let sum = counter.map(|counter| counter.q.sum);
        let next = MeterReg {
            last: q.last.map(|_| sum.unwrap_or(i.by)),
            bits: q.bits.map(|bits| vec![!bits[0], bits[0]]),
        };
        (
            MeterNet {
                sum,
                by_again: i.by,
            },
            next,
        )
    }
}

fn paths(meter: Meter) -> Vec<String> {
    let model = Elaborated::new(&meter).unwrap();
    let leaves = &model.declarations().leaves;
    leaves.iter().map(|leaf| leaf.path()).collect()
}

#[test]
fn what_is_optional_exists_by_its_condition_under_its_own_name() {
    let all = [
        "meter.by",
        "meter.bounds.least",
        "meter.bounds.greatest",
        "meter.last",
        "meter.bits0",
        "meter.bits1",
        "meter.counter.sum",
        "meter.counter.by",
        "meter.counter.next",
        "meter.counter.hidden",
        "meter.sum",
        "meter.by_again",
    ];
    let without = |names: &[&str]| {
        let left = all.iter().filter(|name| !names.contains(name));
        left.map(|name| name.to_string()).collect::<Vec<_>>()
    };
    let meter = |limited, width| Meter { limited, width };
    assert_eq!(paths(meter(true, 5)), without(&[]));
    let wide = ["meter.bounds.greatest", "meter.last"];
    assert_eq!(paths(meter(true, 4)), without(&wide));
    let limited = all[1..11].iter().filter(|name| **name != "meter.last");
    let limited: Vec<_> = limited.copied().collect();
    assert_eq!(paths(meter(false, 5)), without(&limited));
}

#[test]
fn what_is_optional_runs() {
    let meter = Meter {
        limited: true,
        width: 5,
    };
    let mut simulator = Simulator::new(&meter).unwrap();
    assert_eq!(simulator.see(|s| s.q.last.unwrap()), 9);
    simulator
        .set(|i| i.bounds.as_ref().unwrap().least, 4)
        .unwrap();
    simulator.set(|i| i.by, 3).unwrap();
    simulator.step();
    simulator.set(|i| i.by, 6).unwrap();
    simulator.step();
    // The counter begins with 3, and adds only what is not below 4.
    assert_eq!(simulator.see(|s| s.w.sum.unwrap()), 9);
    assert_eq!(simulator.see(|s| s.q.last.unwrap()), 3);
    let registers = simulator.registers();
    assert_eq!(registers.p.counter.unwrap().q.sum, 9);
    assert_eq!(registers.q.bits, Some(vec![false, true]));
    let i = MeterIn {
        by: 1,
        bounds: Some(Bounds {
            least: 40,
            greatest: None,
        }),
    };
    let wrong = simulator.step_with(&i, |_| ()).unwrap_err();
    assert_eq!(wrong.to_string(), "tick 2: 2 words for 3 ports in");
}

/// A circuit around a meter that drives only some of its ports.
#[derive(Debug, Clone)]
struct Partly {
    meter: Meter,
    /// The ports that are left stay low, or those of the limits are forgotten.
    low: bool,
}

const PARTLY: u32 = line!();
signals! { for Partly as c;
    /// Ports in.
    struct PartlyIn {
        /// Summand.
        by: U(c.meter.width),
    }
    /// The meter.
    struct PartlyParts {
        /// The meter.
        meter: Part<Meter>(c.meter),
    }
    /// Nets.
    struct PartlyNet {
        /// The sum.
        pub total: U(c.meter.width),
    }
}

impl Circuit for Partly {
    const NAME: &'static str = "partly";
    const ABOUT: &'static str = "leaves ports of a part low";
    records!(PartlyIn, Nothing, PartlyNet, PartlyParts);

    fn tick(&self, i: PartlyIn, _: Nothing, p: PartlyParts) -> (PartlyNet, Nothing) {
        let meter = p.meter.settle(match self.low {
            true => MeterIn {
                by: i.by,
                ..MeterIn::low(&self.meter)
            },
            false => MeterIn {
                by: i.by,
                bounds: None,
            },
        });
        let total = meter.w.sum.unwrap_or(i.by);
        (PartlyNet { total }, Nothing)
    }
}

#[test]
fn ports_that_are_left_are_low_and_none_is_forgotten() {
    let meter = Meter {
        limited: true,
        width: 5,
    };
    let mut partly = Simulator::new(&Partly { meter, low: true }).unwrap();
    partly.set(|i| i.by, 7).unwrap();
    partly.step();
    let bounds = |bounds: &Bounds<Value>| (bounds.least, bounds.greatest);
    partly.now(|now| {
        let low = now.p.meter.i.bounds.as_ref().map(bounds);
        assert_eq!((low, now.w.total), (Some((0, Some(0))), 10));
    });
    // The same of numbers.
    let low: MeterIn<Value> = MeterIn::low(&meter);
    assert_eq!(
        (low.by, low.bounds.as_ref().map(bounds)),
        (0, Some((0, Some(0))))
    );
    let forgotten = Partly { meter, low: false };
    mistakes(
        &forgotten,
        PARTLY,
        &expect![[r#"
            optional.rs:25:29: partly: port `meter.bounds.least` is given nothing
        "#]],
    );
}
