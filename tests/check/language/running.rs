//! Setting, stepping, reading and sweeping a circuit, with others beside it.

use super::*;
use motion_rtl::check::{Law, Lockstep, Pair, sweep};
use motion_rtl::hdl::At;
use motion_rtl::sim::{Each, Elaborated, InputRecorder, Sample, State, Watcher};

#[test]
fn a_simulator_is_set_stepped_and_asked() {
    let mut simulator = Simulator::new(&around(Fault::None)).unwrap();
    simulator.set(|i| i.by, 5).unwrap();
    for tick in 0..9 {
        let before = (3 + 5 * tick) % 16;
        assert_eq!(simulator.see(|s| s.p.counter.q.sum), before, "{tick}");
        assert_eq!(simulator.see(|s| s.w.sum), (before + 5) % 16);
        assert_eq!(simulator.now(|now| now.i.by), 5);
        simulator.step();
    }
    simulator.now(|now| {
        let last = (3 + 5 * 9) % 16;
        assert_eq!((now.q.last, now.w.words.len()), (last, 2));
        assert_eq!(now.p.counter.w.next, (last + 5) % 16);
        assert_eq!(now.next().p.counter.q.sum, (last + 5) % 16);
        assert!(now.q.one.iter().any(|word| *word != 0), "{:?}", now.q.one);
    });
    simulator.reset();
    assert_eq!(simulator.registers().p.counter.q.sum, 3);
    assert_eq!(simulator.tick(), 10);
}

#[test]
fn what_stands_beside_a_circuit_stands_in_its_waves() {
    let circuit = Counter { width: 4, other: 4 };
    let watch = |watch: &Watcher<'_, Counter>| watch.at(watch.q.sum);
    let (mut simulator, sum): (_, At<u64>) =
        Simulator::watching_beside(&circuit, &Load, true, watch).unwrap();
    let model = Elaborated::with_beside(&circuit, &Load).unwrap();
    let paths: Vec<_> = model
        .declarations()
        .leaves
        .iter()
        .map(|leaf| leaf.path())
        .collect();
    assert_eq!(
        paths[..3],
        ["counter.by", "counter.load.position", "counter.sum"]
    );
    simulator.set(|i| i.by, 1).unwrap();
    simulator
        .show::<Load>(&LoadSignals { position: -3 })
        .unwrap();
    simulator.step();
    assert_eq!(
        (simulator.get(sum), simulator.engine().port(1)),
        (4, Some(0xfd))
    );
}

#[test]
fn circuits_are_held_side_by_side() {
    let pair = |other| Pair {
        left: Counter { width: 4, other: 4 },
        right: Counter {
            width: other,
            other: 4,
        },
    };
    let same = pair(4);
    let lockstep = Lockstep::by_name(&same).unwrap();
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    let proof = reach(&same, &agree)
        .run()
        .unwrap()
        .proof()
        .expect("a proof");
    assert_eq!((proof.states, proof.transitions), (16, 256));
    let wrong = elaborate(&pair(5)).unwrap_err().to_string();
    assert!(
        wrong.contains("pair.right: sum of `sum` (5 bits) and `by` (4 bits)"),
        "{wrong}"
    );
}

/// Law of two additions by one counter.
#[derive(Debug, Clone)]
struct Adds {
    wrong_at: Option<u64>,
}

signals! { for Adds as _c;
    /// A case.
    pub struct AddsIn {
        /// Summand.
        by: U(6),
    }
    /// Parts.
    pub struct AddsParts {
        /// Counter.
        counter: Part<Counter>(Counter { width: 6, other: 6 }),
    }
    /// Nets.
    pub struct AddsNet {
        /// The sum.
        sum: U(6),
    }
}

impl Circuit for Adds {
    const NAME: &'static str = "adds";
    const ABOUT: &'static str = "adds a number twice";
    records!(AddsIn, Nothing, AddsNet, AddsParts);

    fn tick(&self, i: AddsIn, _: Nothing, p: AddsParts) -> (AddsNet, Nothing) {
        let counter = p.counter.settle(In { by: i.by });
        (
            AddsNet {
                sum: counter.w.next,
            },
            Nothing,
        )
    }
}

impl Law for Adds {
    fn law(&self) -> &str {
        "twice is twice"
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn expected(&self, case: &AddsIn<Value>) -> Option<AddsNet<Value>> {
        let wrong = u64::from(self.wrong_at == Some(case.by));
        (case.by != 7).then_some(AddsNet {
            sum: (3 + 2 * case.by + wrong) % 64,
        })
    }
}

#[test]
fn a_law_is_swept() {
    let law = Adds { wrong_at: None };
    assert_eq!(sweep(&law).run().unwrap().held(), Some(63));
    assert_eq!(sweep(&law).run_simulated().unwrap().held(), Some(63));
    let law = Adds { wrong_at: Some(21) };
    for found in [sweep(&law).run(), sweep(&law).run_simulated()] {
        let found = found.unwrap().counterexample().expect("a case");
        let message = "sum is 45, not 46 with by = 21 (case 21)";
        assert_eq!((found.message.as_str(), found.tick), (message, 1));
    }
}

#[test]
fn recorded_inputs_are_played_again() {
    let circuit = Counter { width: 4, other: 4 };
    let by = |tick: u64| [0, 3, 3, 5, 0, 0, 1, 1][tick as usize % 8];
    let mut recorder = InputRecorder::new(&circuit, 8);
    let mut sums = Vec::new();
    let each = Each(|now: &Sample<'_, Counter>| sums.push(now.q.sum));
    let mut simulator = Simulator::new(&circuit).unwrap();
    let drive = |tick, _: &State<'_, Counter>| In { by: by(tick) };
    simulator.run(100, drive, (&mut recorder, each)).unwrap();
    let inputs = recorder.finish();
    assert_eq!((inputs.ticks, simulator.tick()), (8, 8));
    let changes = inputs.changes.iter();
    let changes: Vec<_> = changes
        .map(|change| (change.tick, change.port, change.word))
        .collect();
    assert_eq!(changes, [(1, 0, 3), (3, 0, 5), (4, 0, 0), (6, 0, 1)]);

    let mut playback = inputs.playback();
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut held = Vec::new();
    for sum in sums {
        held.push(playback.held(&mut simulator).unwrap());
        assert_eq!(simulator.see(|s| s.q.sum), sum);
        simulator.step();
    }
    assert_eq!(held, [1, 2, 1, 1, 2, 1, u64::MAX, u64::MAX]);
    assert_eq!(
        inputs
            .playback()
            .tick(&mut Simulator::new(&circuit).unwrap())
            .unwrap(),
        1
    );
}
