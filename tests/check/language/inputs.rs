//! Inputs that do not fit their ports are errors, however they are given.

use super::*;
use motion_rtl::engine::{InputError, Watch};
use motion_rtl::sim::{Elaborated, InputChange, RunError};
use motion_rtl::trace::{Clock, StimulusFile, replay};

/// Ports in of every kind.
#[derive(Debug, Clone)]
struct Ports;

signals! { for Ports as _c;
    /// Two words.
    pub struct Channels {
        /// Signed word.
        shift: I(6),
        /// Unsigned word.
        count: U(6),
    }
    /// Ports in.
    pub struct PortsIn {
        /// A bit.
        go: Bit,
        /// Arrays of both.
        channel: [Channels(_c); 2],
        /// The widest words.
        wide: U(64),
        /// Signed.
        deep: I(64),
    }
    /// Registers.
    pub struct PortsReg {
        /// Latest word.
        shift: I(6),
    }
}

impl Circuit for Ports {
    const NAME: &'static str = "ports";
    const ABOUT: &'static str = "has ports in of every kind";
    records!(PortsIn, PortsReg, Nothing);

    fn tick(&self, i: PortsIn, _: PortsReg, _: Nothing) -> (Nothing, PortsReg<Edge>) {
        let shift = i.channel[1].shift;
        (Nothing, PortsReg { shift })
    }
}

/// An array of ports and no others.
#[derive(Debug, Clone)]
struct Levels;

signals! { for Levels as _c;
    /// Ports in.
    pub struct LevelsIn {
        /// Two bits.
        levels: [Bit; 2],
    }
    /// Registers.
    pub struct LevelsReg {
        /// First level.
        first: Bit,
    }
}

impl Circuit for Levels {
    const NAME: &'static str = "levels";
    const ABOUT: &'static str = "has an array of ports in";
    records!(LevelsIn, LevelsReg, Nothing);

    fn tick(&self, i: LevelsIn, _: LevelsReg, _: Nothing) -> (Nothing, LevelsReg<Edge>) {
        let first = i.levels[0];
        (Nothing, LevelsReg { first })
    }
}

fn ports(shift: i64, count: u64) -> PortsIn<Value> {
    let channel = |shift, count| Channels { shift, count };
    PortsIn {
        go: true,
        channel: vec![channel(0, 0), channel(shift, count)],
        wide: u64::MAX,
        deep: i64::MIN,
    }
}

const SHIFT: &str = "port in channel1.shift: 32 does not fit; allowed are -32 to 31";

#[test]
fn the_ends_of_a_range_fit_and_their_neighbours_do_not() {
    let mut simulator = Simulator::new(&Ports).unwrap();
    for (shift, count) in [(-32, 0), (31, 63)] {
        let got = simulator.step_with(&ports(shift, count), |now| {
            (now.i.channel[1].shift, now.i.channel[1].count, now.i.deep)
        });
        assert_eq!(got.unwrap(), (shift, count, i64::MIN));
    }
    for (shift, count, what) in [
        (32, 0, SHIFT),
        (
            -33,
            0,
            "port in channel1.shift: -33 does not fit; allowed are -32 to 31",
        ),
        (
            0,
            64,
            "port in channel1.count: 64 does not fit; allowed are 0 to 63",
        ),
    ] {
        let error = simulator.step_with(&ports(shift, count), |_| ());
        assert_eq!(error.unwrap_err().to_string(), format!("tick 2: {what}"));
        let error = simulator.apply(&ports(shift, count)).unwrap_err();
        assert_eq!(error.to_string(), format!("tick 2: {what}"));
    }
    // The refused ticks did not happen, and no port has changed.
    assert_eq!(simulator.tick(), 2);
    assert_eq!(simulator.now(|now| now.i.channel[1].shift), 31);
}

#[test]
fn single_ports_are_checked() {
    let mut simulator = Simulator::new(&Ports).unwrap();
    simulator.set(|i| i.channel[1].shift, -32).unwrap();
    simulator.set(|i| i.wide, u64::MAX).unwrap();
    simulator.set(|i| i.deep, i64::MAX).unwrap();
    let error = simulator.set(|i| i.channel[1].shift, 32).unwrap_err();
    let RunError::Input { tick: 0, error } = error else {
        panic!("{error}");
    };
    let expected = InputError::Range {
        port: "channel1.shift".into(),
        value: 32,
        least: -32,
        greatest: 31,
    };
    assert_eq!(error, expected);
    assert_eq!(simulator.see(|s| s.i.channel[1].shift), -32);

    // `set_port` takes a word as its bits.
    simulator.set_port(3, 0x3f).unwrap();
    assert_eq!(simulator.see(|s| s.i.channel[1].shift), -1);
    let error = simulator.set_port(3, 0x40).unwrap_err().to_string();
    assert_eq!(
        error,
        "tick 0: port in channel1.shift: 64 does not fit; allowed are 0 to 63"
    );
    let error = simulator.set_port(7, 0).unwrap_err().to_string();
    assert_eq!(
        error,
        "tick 0: port in 7 does not exist; the circuit has 7, counted from 0"
    );
    // Place that is not an input port.
    let register = simulator.signals().q.shift;
    assert!(simulator.set(|_| register, 1).is_err());
}

#[test]
fn an_array_has_its_length() {
    let mut simulator = Simulator::new(&Ports).unwrap();
    let mut i = ports(0, 0);
    i.channel.pop();
    let error = simulator.apply(&i).unwrap_err().to_string();
    assert_eq!(error, "tick 0: 5 words for 7 ports in");
    let mut simulator = Simulator::new(&Levels).unwrap();
    let error = simulator.apply(&LevelsIn { levels: vec![] }).unwrap_err();
    assert_eq!(error.to_string(), "tick 0: 0 words for 2 ports in");
}

#[test]
fn inputs_that_are_given_again_replace_those_between() {
    type Set = fn(&mut Simulator<Ports>) -> Result<(), RunError>;
    let between: [Set; 4] = [
        |at| at.set(|i| i.channel[1].shift, 5),
        |at| at.set_port(3, 5),
        |at| at.apply(&ports(5, 0)),
        |at| {
            let (tick, port, word) = (at.tick(), 3, 5);
            at.replay(1, &[InputChange { tick, port, word }], &[], |_| {})
        },
    ];
    let mut simulator = Simulator::new(&Ports).unwrap();
    let shift = simulator.signals().i.channel[1].shift;
    for set in between {
        simulator.apply(&ports(7, 0)).unwrap();
        set(&mut simulator).unwrap();
        assert_eq!(simulator.get(shift), 5);
        simulator.apply(&ports(7, 0)).unwrap();
        assert_eq!(simulator.get(shift), 7);
    }
}

#[test]
fn a_run_names_tick_and_port() {
    let bad = |tick| ports(if tick == 5 { 32 } else { 0 }, 0);
    let run = Simulator::new(&Ports)
        .unwrap()
        .run(9, |tick, _| bad(tick), ());
    assert_eq!(run.unwrap_err().to_string(), format!("tick 5: {SHIFT}"));
    let drive = |at: &mut Simulator<Ports>| {
        at.apply(&bad(at.tick()))?;
        Ok(1)
    };
    for forward in [false, true] {
        let mut simulator = Simulator::new(&Ports).unwrap();
        let run = match forward {
            true => simulator.fast_forward(9, drive, ()),
            false => simulator.run_changes(9, drive, ()),
        };
        assert_eq!(run.unwrap_err().to_string(), format!("tick 5: {SHIFT}"));
    }
    let mut simulator = Simulator::new(&Ports).unwrap();
    let look = simulator.look(&ports(32, 0), (), |_| ()).map(|_| ());
    assert_eq!(look.unwrap_err().to_string(), format!("tick 0: {SHIFT}"));
    let look = simulator.step_watched(&ports(32, 0), (), |_| ());
    assert_eq!(look.unwrap_err().to_string(), format!("tick 0: {SHIFT}"));
}

#[test]
fn what_stands_beside_a_circuit_fits_too() {
    let (mut simulator, ()) = Simulator::watching_beside(&Ports, &Load, true, |_| ()).unwrap();
    simulator.apply(&ports(1, 1)).unwrap();
    let error = simulator.show::<Load>(&LoadSignals { position: 128 });
    assert_eq!(
        error.unwrap_err().to_string(),
        "tick 0: port in load.position: 128 does not fit; allowed are -128 to 127"
    );
}

#[test]
fn words_that_are_played_fit() {
    let directory = tempfile::tempdir().unwrap();
    let mut words = vec![vec![1, 0, 0, 0x3f, 0, 0, u64::MAX]; 3];
    let at = |words: &[Vec<u64>]| {
        let words = words.iter().cloned();
        replay(&Ports, words, Clock::default(), directory.path(), "ports").map(|_| ())
    };
    at(&words).unwrap();
    words[2][3] = 0x40;
    assert_eq!(
        at(&words).unwrap_err().to_string(),
        "tick 2: port in channel1.shift: 64 does not fit; allowed are 0 to 63"
    );
    words[2].pop();
    assert_eq!(
        at(&words).unwrap_err().to_string(),
        "tick 2: 6 words for 7 ports in"
    );

    let mut file = StimulusFile::new(Vec::new(), &Ports);
    file.line(&words[0], false).unwrap();
    for wrong in [&words[2][..], &[0, 0, 0, 0x40, 0, 0, 0]] {
        assert!(file.line(wrong, false).is_err(), "{wrong:?}");
    }
    let text = String::from_utf8(file.finish().unwrap()).unwrap();
    assert_eq!(text.lines().count(), 1);
}

#[test]
fn an_engine_refuses_words_and_ports() {
    let mut engine = Elaborated::new(&Ports).unwrap().engine(Watch::All);
    assert_eq!(engine.ports(), 7);
    engine.input(3, 0x3f).unwrap();
    assert_eq!(
        engine.input(3, 0x40).unwrap_err().to_string(),
        "port in 3: 64 does not fit; allowed are 0 to 63"
    );
    let missing = InputError::Port { port: 7, ports: 7 };
    assert_eq!(engine.input(7, 0), Err(missing));
    let count = InputError::Count { words: 1, ports: 7 };
    assert_eq!(engine.inputs(&[1]), Err(count));
    assert!(engine.inputs(&[2, 0, 0, 0, 0, 0, 0]).is_err());
    engine.settle();
    assert_eq!((engine.port(3), engine.port(0)), (Some(0x3f), Some(0)));
    assert_eq!((engine.port(7), engine.leaf(engine.leaves())), (None, None));
    assert_eq!(engine.leaf(3), Some(0x3f));
}
