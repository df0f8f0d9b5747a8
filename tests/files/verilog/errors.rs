//! Circuits that are no netlist, or no Verilog.

use motion_rtl::engine::EngineError;
use motion_rtl::kernel::{Circuit, Instance, Nothing};
use motion_rtl::logic::netlist::NetlistError;
use motion_rtl::logic::{Logic, Ram, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::verilog::{Verilog, VerilogError};

signals! { pub struct CountIn<L> { pub step: L::Bit } }
signals! { pub struct CountReg<L> { pub count: L::U<4> = 1, hidden: L::U<4> } }
signals! { pub struct CountNet<L> { pub zero: L::Bit, secret: L::Bit } }

#[derive(Debug)]
struct Count;

impl Circuit for Count {
    const NAME: &'static str = "count_up";
    const ABOUT: &'static str = "counts";
    type In<L: Logic> = CountIn<L>;
    type Reg<L: Logic> = CountReg<L>;
    type Net<L: Logic> = CountNet<L>;
    fn comb<L: Logic>(&self, q: &CountReg<L>, i: &CountIn<L>) -> CountNet<L> {
        CountNet {
            zero: q.count.is_zero(),
            secret: q.hidden.is_zero() | i.step,
        }
    }
    fn next<L: Logic>(&self, q: CountReg<L>, _: &CountNet<L>, _: &CountIn<L>) -> CountReg<L> {
        CountReg {
            count: q.count + 1,
            hidden: q.count,
        }
    }
}

/// What a surrounding circuit does with its counter.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    Ports,
    HiddenRegister,
    HiddenNet,
    Replaces,
    Keeps,
}

signals! { pub struct AroundReg<L> { counter: CountReg<L> } }
signals! { pub struct AroundNet<L> { counter: Instance<Count, L>, pub seen: L::Bit } }

#[derive(Debug)]
struct Around(Way);

impl Circuit for Around {
    const NAME: &'static str = "around";
    const ABOUT: &'static str = "has a counter";
    type In<L: Logic> = Nothing<L>;
    type Reg<L: Logic> = AroundReg<L>;
    type Net<L: Logic> = AroundNet<L>;
    fn comb<L: Logic>(&self, q: &AroundReg<L>, _: &Nothing<L>) -> AroundNet<L> {
        let inputs = CountIn { step: true.into() };
        let counter = Instance::settle(&Count, &q.counter, inputs);
        AroundNet {
            seen: match self.0 {
                Way::HiddenRegister => q.counter.hidden.is_zero(),
                Way::HiddenNet => counter.w.secret,
                _ => counter.w.zero & q.counter.count.bit(1),
            },
            counter,
        }
    }
    fn next<L: Logic>(&self, q: AroundReg<L>, w: &AroundNet<L>, _: &Nothing<L>) -> AroundReg<L> {
        let counter = match self.0 {
            Way::Keeps => q.counter,
            _ => w.counter.next(&Count, q.counter),
        };
        AroundReg {
            counter: match self.0 {
                Way::Replaces => CountReg {
                    count: counter.count + 1,
                    ..counter
                },
                _ => counter,
            },
        }
    }
    fn power_on(&self) -> AroundReg<Sim> {
        let counter = CountReg {
            count: 11.into(),
            hidden: 12.into(),
        };
        AroundReg { counter }
    }
}

fn refused<C: Circuit>(circuit: &C) -> Vec<NetlistError> {
    match Verilog::of(circuit) {
        Err(VerilogError::Engine(EngineError::Netlist(errors))) => errors,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_port_cannot_be_read() {
    for (way, signal) in [(Way::HiddenRegister, "hidden"), (Way::HiddenNet, "secret")] {
        let errors = refused(&Around(way));
        let expected = NetlistError::NotAPort {
            module: "around".into(),
            instance: "counter".into(),
            signal: signal.into(),
        };
        assert_eq!(errors, [expected]);
    }
    let text = refused(&Around(Way::HiddenNet))[0].to_string();
    let expected = "around: secret of counter is read, but is no port: it is not declared pub";
    assert_eq!(text, expected);
}

#[test]
fn registers_of_an_instance_come_from_its_next() {
    let expected = NetlistError::Registers {
        module: "around".into(),
        instance: "counter".into(),
    };
    assert_eq!(
        refused(&Around(Way::Replaces)),
        std::slice::from_ref(&expected)
    );
    assert!(refused(&Around(Way::Keeps)).contains(&expected));
    let text = "around: the registers of counter do not come from its next";
    assert_eq!(expected.to_string(), text);
}

#[test]
fn the_surrounding_circuit_says_what_registers_hold_at_power_on() {
    let sources = Verilog::of(&Around(Way::Ports)).unwrap().sources();
    let text = &sources[0].text;
    assert_eq!(sources[0].name, "count_up.v");
    assert!(text.contains("output reg  [3:0] count = 4'd11"), "{text}");
    assert!(text.contains("hidden = 4'd12;"), "{text}");
    assert!(text.contains("count <= 4'd11;"), "{text}");
}

signals! { pub struct StoreIn<L> { pub address: L::U<2>, pub write: L::Bit } }
signals! { pub struct StoreReg<L> { store: L::Ram<2, 5>, pub read: L::U<5> } }

/// Whether a memory is read, or else written again, after its write.
#[derive(Debug)]
struct Store(bool);

impl Circuit for Store {
    const NAME: &'static str = "keeper";
    const ABOUT: &'static str = "uses its memory after the edge";
    type In<L: Logic> = StoreIn<L>;
    type Reg<L: Logic> = StoreReg<L>;
    type Net<L: Logic> = Nothing<L>;
    fn comb<L: Logic>(&self, _: &StoreReg<L>, _: &StoreIn<L>) -> Nothing<L> {
        Nothing::new()
    }
    fn next<L: Logic>(&self, q: StoreReg<L>, _: &Nothing<L>, i: &StoreIn<L>) -> StoreReg<L> {
        let store = q.store.write(i.write, i.address, q.read + 1);
        match self.0 {
            true => StoreReg {
                read: store.read(i.address),
                store,
            },
            false => StoreReg {
                read: q.read,
                store: store.write(i.write, i.address + 1, q.read),
            },
        }
    }
}

#[test]
fn a_memory_is_not_used_after_its_write() {
    for again in [true, false] {
        let errors = refused(&Store(again));
        let expected = NetlistError::Memory {
            module: "keeper".into(),
            memory: "store".into(),
        };
        assert_eq!(errors, [expected]);
        let text = "keeper: memory store is used again after its write";
        assert_eq!(errors[0].to_string(), text);
    }
}

signals! { pub struct WordIn<L> { pub wire: L::Bit } }
signals! { pub struct TwiceNet<L> { wire_x: L::Bit, wire: Bundle<L> } }
signals! { pub struct Bundle<L> { pub x: L::Bit } }

/// A port that is a word of Verilog.
#[derive(Debug)]
struct Reserved;

impl Circuit for Reserved {
    const NAME: &'static str = "odd";
    const ABOUT: &'static str = "is called as Verilog calls something else";
    type In<L: Logic> = WordIn<L>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = Nothing<L>;
    fn comb<L: Logic>(&self, _: &Nothing<L>, _: &WordIn<L>) -> Nothing<L> {
        Nothing::new()
    }
    fn next<L: Logic>(&self, q: Nothing<L>, _: &Nothing<L>, _: &WordIn<L>) -> Nothing<L> {
        q
    }
}

/// A signal called as one in a bundle is.
#[derive(Debug)]
struct Twice;

impl Circuit for Twice {
    const NAME: &'static str = "odd";
    const ABOUT: &'static str = "has a name twice";
    type In<L: Logic> = Nothing<L>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = TwiceNet<L>;
    fn comb<L: Logic>(&self, _: &Nothing<L>, _: &Nothing<L>) -> TwiceNet<L> {
        TwiceNet {
            wire_x: true.into(),
            wire: Bundle { x: false.into() },
        }
    }
    fn next<L: Logic>(&self, q: Nothing<L>, _: &TwiceNet<L>, _: &Nothing<L>) -> Nothing<L> {
        q
    }
}

#[test]
fn names_that_verilog_does_not_take_are_refused() {
    let error = Verilog::of(&Reserved).unwrap_err();
    let text = "odd: wire is a word of Verilog or kept for the clock and the reset";
    assert_eq!(error.to_string(), text);
    let error = Verilog::of(&Twice).unwrap_err();
    assert_eq!(error.to_string(), "odd: wire_x is declared twice");
}
