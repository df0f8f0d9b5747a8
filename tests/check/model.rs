//! Running models without types: every circuit of the catalogue against an engine that watches
//! everything.

mod names;
mod refusals;
mod replays;

use motion_rtl::Model;
use motion_rtl::check::Stimulus;
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::engine::{Engine, Watch};
use motion_rtl::registry::{CATALOGUE, find};
use motion_rtl::sim::{Elaborated, Handle, SignalInfo, Simulator};
use rayon::prelude::*;

/// A model, and an engine with the same inputs.
struct Twin {
    name: &'static str,
    model: Model,
    golden: Engine,
    signals: Vec<SignalInfo>,
    ports_out: Vec<usize>,
}

impl Twin {
    fn of(circuit: &Elaborated) -> Self {
        let model = Model::of(circuit).unwrap();
        Twin {
            name: circuit.name(),
            signals: model.signals(),
            model,
            golden: circuit.engine(Watch::All),
            ports_out: circuit.ports_out(),
        }
    }

    fn apply(&mut self, random: &mut Stimulus) {
        random.apply(&mut self.golden);
        for port in 0..self.golden.ports() {
            let word = self.golden.port(port).unwrap();
            let handle = self.model.at(port).unwrap();
            self.model.set_bits(handle, word).unwrap();
        }
        self.golden.settle();
    }

    /// Compares leaves of this tick.
    fn compare(&mut self, leaves: impl IntoIterator<Item = usize>) {
        for leaf in leaves {
            let seen = self.model.get(self.signals[leaf].handle).unwrap();
            let (tick, path) = (self.model.tick(), &self.signals[leaf].path);
            let golden = self.golden.leaf(leaf);
            assert_eq!(Some(seen), golden, "{}, tick {tick}: {path}", self.name);
        }
    }

    /// Runs random ticks: compares output ports in all, and everything in some.
    fn run(&mut self, ticks: u64, random: &mut Stimulus) {
        for tick in 0..ticks {
            let reset = random.reset();
            self.apply(random);
            self.compare(self.ports_out.clone());
            if tick % 13 == 5 {
                self.compare(0..self.signals.len());
            }
            match reset {
                true => {
                    self.golden.reset();
                    self.model.reset();
                }
                false => {
                    self.golden.edge();
                    self.model.step();
                }
            }
        }
    }

    /// The bits of all registers and words of memories.
    fn registers(&mut self) -> Vec<u64> {
        let leaves = self
            .signals
            .iter()
            .filter(|signal| signal.role == motion_rtl::netlist::Role::Register);
        let handles: Vec<Handle> = leaves.map(|signal| signal.handle).collect();
        let words = handles.into_iter().map(|handle| self.model.get(handle));
        words.collect::<Result<_, _>>().unwrap()
    }
}

/// Random ticks, a snapshot in the middle, and ticks after it that are undone. The costly reads
/// have the circuit planned anew on the way.
#[test]
fn every_circuit_is_that_of_its_engine() {
    CATALOGUE.par_iter().for_each(|entry| {
        let circuit = entry.small().model().unwrap();
        let mut twin = Twin::of(&circuit);
        let mut random = Stimulus::new(11);
        twin.run(300, &mut random);
        let (then, golden) = (twin.model.snapshot(), twin.golden.clone());
        twin.run(300, &mut random);

        twin.golden = golden.clone();
        twin.model.restore(&then).unwrap();
        assert_eq!((then.tick(), twin.model.tick()), (300, 300));
        twin.run(100, &mut random);

        // A model of its own, which watches other signals.
        let mut other = Twin::of(&entry.small().model().unwrap());
        let all: Vec<Handle> = other.signals.iter().map(|signal| signal.handle).collect();
        other.model.watch(&all).unwrap();
        other.golden = golden;
        other.model.restore(&then).unwrap();
        other.run(100, &mut random);
        assert_eq!(other.model.tick(), 400);
    });
}

#[test]
fn the_power_on_state_is_that_of_the_declarations() {
    CATALOGUE.par_iter().for_each(|entry| {
        let circuit = entry.small().model().unwrap();
        let mut model = Model::of(&circuit).unwrap();
        model.step();
        let declared = circuit.declarations();
        for (signal, leaf) in model.signals().iter().zip(&declared.leaves) {
            assert_eq!(signal.power_on, leaf.power_on, "{}", signal.path);
            assert_eq!(signal.shape, leaf.shape, "{}", signal.path);
        }
        assert_eq!(model.signals().len(), declared.leaves.len());
    });
}

/// Jumps over idle ticks end in the state of single steps.
#[test]
fn going_forward_is_stepping() {
    CATALOGUE.par_iter().for_each(|entry| {
        let circuit = entry.small().model().unwrap();
        let mut twin = Twin::of(&circuit);
        let mut random = Stimulus::new(3);
        for ticks in [1, 2, 3, 700, 40, 1, 250, 90, 1000, 5, 31, 64].repeat(2) {
            twin.apply(&mut random);
            let mut stepped = twin.model.clone();
            match ticks % 2 {
                0 => twin.model.fast_forward(ticks),
                _ => twin.model.run(ticks),
            }
            for _ in 0..ticks {
                twin.golden.settle();
                twin.golden.edge();
                stepped.step();
            }
            assert_eq!(twin.model.tick(), stepped.tick());
            twin.golden.settle();
            twin.compare(twin.ports_out.clone());
            let forward = twin.registers();
            std::mem::swap(&mut twin.model, &mut stepped);
            assert_eq!(twin.registers(), forward, "{}", twin.name);
            std::mem::swap(&mut twin.model, &mut stepped);
        }
    });
}

/// The circuits of the patents in full size, with inputs that stay for long.
#[test]
fn full_circuits_go_forward_as_they_step() {
    let names = [
        "pulse_interpolator",
        "linear_interpolator",
        "compensator",
        "arc_generator",
        "trajectory_controller",
        "machine",
    ];
    names.par_iter().for_each(|name| {
        let circuit = find(name).expect(name).full().model().unwrap();
        let mut twin = Twin::of(&circuit);
        let mut random = Stimulus::new(5);
        for ticks in [200, 1, 350, 20] {
            twin.apply(&mut random);
            twin.model.fast_forward(ticks);
            for _ in 0..ticks {
                twin.golden.settle();
                twin.golden.edge();
            }
            twin.golden.settle();
            twin.compare(twin.ports_out.clone());
        }
    });
}

#[test]
fn arrays_are_ticks_one_by_one() {
    let circuit = find("linear_interpolator").unwrap().full().model().unwrap();
    let mut model = Model::of(&circuit).unwrap();
    let inputs: Vec<Handle> = (0..circuit.engine(Watch::All).ports())
        .map(|port| model.at(port).unwrap())
        .collect();
    let mut random = Stimulus::new(9);
    let mut engine = circuit.engine(Watch::All);
    for ticks in [200, 7] {
        let mut columns = vec![Vec::new(); inputs.len()];
        for _ in 0..ticks {
            random.apply(&mut engine);
            for (port, column) in columns.iter_mut().enumerate() {
                let word = engine.port(port).unwrap();
                let signal = &circuit.declarations().leaves[port];
                let is_signed = signal.shape.kind == motion_rtl::netlist::Kind::Signed;
                let above = if is_signed {
                    64 - signal.shape.width
                } else {
                    0
                };
                column.push(((word << above) as i64 >> above) as u64);
            }
        }
        let mut stepped = model.clone();
        // A signed output port, a register inside, and nets inside that nobody watches.
        let seen = [
            "x",
            "sequencer.state",
            "pattern.ready",
            "differentiator.increment",
        ];
        let seen = seen.map(|name| model.find(name).unwrap());
        let given: Vec<(Handle, &[u64])> = inputs
            .iter()
            .zip(&columns)
            .map(|(handle, column)| (*handle, &column[..]))
            .collect();
        let played = model.play(ticks, &given, &seen).unwrap();
        for tick in 0..ticks {
            for (handle, column) in &given {
                let is_signed = column[tick] >> 63 == 1;
                match is_signed {
                    true => stepped.set(*handle, column[tick] as i64).unwrap(),
                    false => stepped.set(*handle, column[tick]).unwrap(),
                }
            }
            let signed = |model: &mut Model, handle| model.get_signed(handle).unwrap() as u64;
            assert_eq!(
                played[0][tick],
                signed(&mut stepped, seen[0]),
                "tick {tick}"
            );
            assert_eq!(
                played[1][tick],
                stepped.get(seen[1]).unwrap(),
                "tick {tick}"
            );
            assert_eq!(
                played[2][tick],
                stepped.get(seen[2]).unwrap(),
                "tick {tick}"
            );
            assert_eq!(
                played[3][tick],
                signed(&mut stepped, seen[3]),
                "tick {tick}"
            );
            stepped.step();
        }
        assert_eq!(model.tick(), stepped.tick());
        for port in &inputs {
            assert_eq!(model.get(*port).unwrap(), stepped.get(*port).unwrap());
        }
        assert!(played.iter().all(|column| column.len() == ticks));
    }
}

/// A net that is read again and again is watched after some reads, and stays right.
#[test]
fn unwatched_nets_are_read_right() {
    let mut model = Model::new("enable_counter", &["width=8".parse().unwrap()]).unwrap();
    let mut simulator = Simulator::new(&EnableCounter { width: 8 }).unwrap();
    model.set("period", 5).unwrap();
    simulator.set(|i| i.period, 5).unwrap();
    let next = model.find("next").unwrap();
    for tick in 0..300 {
        let golden = simulator.now(|now| now.engine().leaf(next.index()).unwrap());
        assert_eq!(model.get(next).unwrap(), golden, "tick {tick}");
        model.step();
        simulator.step();
    }
}

/// Compiled code does not say which of its blocks are due; the interpreter has to be woken.
#[test]
fn a_snapshot_of_compiled_code_runs_on_the_interpreter() {
    let mut compiled = Model::new("unit_law", &["width=8".parse().unwrap()]).unwrap();
    let mut interpreted = compiled.clone();
    compiled.set("period", 50).unwrap();
    compiled.set("half_period", 7).unwrap();
    for _ in 0..100_000 {
        compiled.step();
    }
    interpreted.restore(&compiled.snapshot()).unwrap();
    let signals = compiled.signals();
    for tick in 0..200 {
        for signal in &signals {
            let [seen, golden] =
                [&mut interpreted, &mut compiled].map(|model| model.get(signal.handle).unwrap());
            assert_eq!(seen, golden, "tick {tick}: {}", signal.path);
        }
        interpreted.step();
        compiled.step();
    }
}

/// A circuit that was still when its waves began goes on after them.
#[test]
fn what_moves_when_the_waves_end_goes_on() {
    let directory = tempfile::tempdir().unwrap();
    let mut plain = Model::new("linear_interpolator", &[]).unwrap();
    let inputs = [
        ("target_x", 4000),
        ("speed", 10 << 12),
        ("acceleration_time", 2),
        ("deceleration_time", 2),
    ];
    for (port, value) in inputs {
        plain.set(port, value).unwrap();
    }
    plain.run(50);
    let mut waved = plain.clone();
    waved.waves_to(directory.path().join("waves.vcd")).unwrap();
    for model in [&mut plain, &mut waved] {
        for port in ["push", "scan", "scan", "scan", "scan", "scan", "scan"] {
            model.set(port, 1).unwrap();
            model.step();
            model.set(port, 0).unwrap();
            model.run(if port == "push" { 3 } else { 150 });
        }
        model.set("scan", 1).unwrap();
        model.step();
        model.set("scan", 0).unwrap();
        model.run(2);
        model.finish_waves().unwrap();
        model.run(300);
    }
    for signal in plain.signals() {
        let [seen, golden] =
            [&mut waved, &mut plain].map(|model| model.get(signal.handle).unwrap());
        assert_eq!(seen, golden, "{}", signal.path);
    }
    assert_ne!(plain.get("x").unwrap(), 0, "it has moved");
}

#[test]
fn models_move_to_other_threads() {
    let mut model = Model::new("linear_interpolator", &[]).unwrap();
    model.set("speed", 77).unwrap();
    let mut copy = model.clone();
    let there = std::thread::spawn(move || {
        model.set("speed", 78).unwrap();
        model.run(1000);
        let speed = model.get("speed").unwrap();
        (model.snapshot(), speed)
    });
    let (snapshot, speed) = there.join().unwrap();
    assert_eq!((speed, copy.get("speed").unwrap()), (78, 77));
    copy.restore(&snapshot).unwrap();
    assert_eq!((copy.tick(), copy.get("speed").unwrap()), (1000, 78));
}
