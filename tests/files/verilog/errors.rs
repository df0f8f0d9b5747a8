//! Circuits that are no netlist, or no Verilog.

use motion_rtl::engine::EngineError;
use motion_rtl::prelude::*;
use motion_rtl::verilog::Verilog;

#[derive(Debug, Clone)]
struct Count {
    starts: u64,
}

signals! { for Count as c;
    pub struct CountIn { pub step: Bit }
    pub struct CountReg { pub count: U(4) = c.starts, hidden: U(4) }
    pub struct CountNet { pub zero: Bit, secret: Bit }
}

impl Circuit for Count {
    const NAME: &'static str = "count_up";
    const ABOUT: &'static str = "counts";
    records!(CountIn, CountReg, CountNet);

    fn tick(&self, i: CountIn, q: CountReg, _: Nothing) -> (CountNet, CountReg<Edge>) {
        let net = CountNet {
            zero: q.count.is_zero(),
            secret: q.hidden.is_zero() | i.step,
        };
        let next = CountReg {
            count: q.count + 1,
            hidden: q.count,
        };
        (net, next)
    }
}

/// Signal of its counter that a surrounding circuit reads.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Ports,
    HiddenRegister,
    HiddenNet,
}

#[derive(Debug, Clone)]
struct Around(Way);

signals! { for Around as _c;
    pub struct AroundParts { pub counter: Part<Count>(Count { starts: 11 }) }
    pub struct AroundNet { pub seen: Bit }
}

impl Circuit for Around {
    const NAME: &'static str = "around";
    const ABOUT: &'static str = "has a counter";
    records!(Nothing, Nothing, AroundNet, AroundParts);

    fn tick(&self, _: Nothing, _: Nothing, p: AroundParts) -> (AroundNet, Nothing) {
        let counter = p.counter.settle(CountIn { step: Bit::high() });
        let seen = match self.0 {
            Way::HiddenRegister => counter.q.hidden.is_zero(),
            Way::HiddenNet => counter.w.secret,
            Way::Ports => counter.w.zero & counter.q.count.bit(1),
        };
        (AroundNet { seen }, Nothing)
    }
}

/// Returns the mistakes of a circuit, without their source lines.
fn refused(circuit: &impl Circuit) -> Vec<String> {
    match Verilog::new(circuit) {
        Err(EngineError::Circuit(wrong)) => {
            let mistakes = wrong.0.into_iter();
            mistakes
                .map(|mistake| format!("{}: {}", mistake.path, mistake.what))
                .collect()
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_port_cannot_be_read() {
    for (way, signal) in [(Way::HiddenRegister, "hidden"), (Way::HiddenNet, "secret")] {
        let expected =
            format!("around: `counter.{signal}` is read, but is no port: it is not declared pub");
        assert_eq!(refused(&Around(way)), [expected]);
    }
}

#[test]
fn the_surrounding_circuit_says_what_registers_hold_at_power_on() {
    let sources = Verilog::new(&Around(Way::Ports)).unwrap().sources();
    let text = &sources[0].text;
    assert_eq!(sources[0].name, "count_up.v");
    assert!(text.contains("reg  [3:0] count_reg = 4'd11;"), "{text}");
    assert!(text.contains("count_reg <= 4'd11;"), "{text}");
}

/// A signal called as one in a bundle is.
#[derive(Debug, Clone)]
struct Twice;

signals! { for Twice as c;
    pub struct Bundle { pub x: Bit }
    pub struct TwiceNet { wire_x: Bit, wire: Bundle(c) }
}

impl Circuit for Twice {
    const NAME: &'static str = "odd";
    const ABOUT: &'static str = "has a name twice";
    records!(Nothing, Nothing, TwiceNet);

    fn tick(&self, _: Nothing, _: Nothing, _: Nothing) -> (TwiceNet, Nothing) {
        let net = TwiceNet {
            wire_x: Bit::high(),
            wire: Bundle { x: Bit::low() },
        };
        (net, Nothing)
    }
}

#[test]
fn names_that_verilog_does_not_take_are_refused() {
    assert_eq!(refused(&Twice), ["odd: the name `wire_x` is used twice"]);
}
