//! The whole compensator: its variants side by side, and what must hold whatever comes in.

use super::below;
use motion_rtl::check::{Lockstep, Pair, PairIn, Random};
use motion_rtl::circuits::lead_angle::codes;
use motion_rtl::circuits::lead_angle::compensator::In;
use motion_rtl::circuits::lead_angle::{
    Compensator, Division, LeadForm, LeadFrom, Memory, Placement, Variant, Widths,
};
use motion_rtl::hdl::{Image, Value};
use motion_rtl::sim::{Observer, Simulator, State};
use motion_rtl::trace::LastTicks;

/// Outputs by which runs are compared.
const OUTPUTS: [&str; 12] = [
    "position",
    "target",
    "lead_time",
    "step",
    "busy",
    "drive",
    "reverse",
    "fire",
    "brake",
    "complete",
    "learned",
    "error",
];

fn small(memory: Memory, placement: Placement) -> Compensator {
    let widths = Widths {
        converter: 7,
        stages: 15,
        position: 8,
        step: 2,
        speed: 8,
        cks: 8,
        ck_period: 8,
        code: 7,
    };
    Compensator {
        widths,
        lead_from: LeadFrom::Time {
            memory,
            form: LeadForm::Embodiment,
        },
        variant: Variant {
            placement,
            ..Variant::default()
        },
        rom: Image::of(2, widths.time(), [7, 15, 40, 110]),
    }
}

/// One whose lead is on the position, with its history in such a memory.
fn plain(memory: Memory) -> Compensator {
    small(memory, Placement::Position)
}

/// A control computer at random, and an encoder that goes to and fro.
struct Bench {
    random: Random,
    position: i64,
    up: bool,
    settings: In<Value>,
}

impl Bench {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        Bench {
            settings: random.inputs(&plain(Memory::Ram)),
            random,
            position: 0,
            up: true,
        }
    }

    /// The inputs of a tick, with the motor following the drive that the tick before showed.
    fn tick(&mut self, drive: Option<bool>) -> In<Value> {
        let random = &mut self.random;
        if below(random, 400) == 0 {
            self.settings = random.inputs(&plain(Memory::Ram));
        }
        if below(random, 60) == 0 {
            self.up = below(random, 2) == 0;
        }
        let up = drive.unwrap_or(self.up);
        if below(random, 3) > 0 {
            self.position += if up { 1 } else { -1 };
        }
        let quarter = self.position.rem_euclid(4);
        let rarely = |random: &mut Random| below(random, 50) == 0;
        In {
            a: quarter == 1 || quarter == 2,
            b: quarter >= 2,
            clear: below(random, 2000) == 0,
            run: below(random, 20) > 0,
            halt: below(random, 300) == 0,
            ck_period: below(random, 6),
            standstill: below(random, 4),
            time_out: below(random, 40),
            rest: below(random, 4),
            write_target: rarely(random),
            write_time: rarely(random),
            write_step: below(random, 4),
            step_target: random.word() as i64 % 128,
            step_time: below(random, 256),
            ..self.settings.clone()
        }
    }
}

#[test]
fn the_ram_compensator_is_the_compensator_in_every_tick() {
    let pair = Pair {
        left: plain(Memory::ShiftRegister),
        right: plain(Memory::Ram),
    };
    let outputs = OUTPUTS.map(|name| (name, name));
    for seed in 0..4 {
        let lockstep = Lockstep::of(&pair, &outputs).unwrap();
        let mut bench = Bench::new(seed);
        let stimulus = |_, _: &State<'_, _>| PairIn(bench.tick(None));
        let mut simulator = LastTicks::simulator(&pair).unwrap();
        simulator.run(100_000, stimulus, lockstep).unwrap();
    }
}

#[test]
fn the_three_placements_fire_in_the_same_tick() {
    let of = |placement| small(Memory::ShiftRegister, placement);
    for other in [Placement::Target, Placement::Halves] {
        let pair = Pair {
            left: of(Placement::Position),
            right: of(other),
        };
        let outputs = OUTPUTS.map(|name| (name, name));
        let mut lockstep = Lockstep::of(&pair, &outputs).unwrap();
        let mut bench = Bench::new(9);
        let mut fired = 0;
        let mut simulator = LastTicks::simulator(&pair).unwrap();
        for _ in 0..100_000 {
            let seen = simulator
                .step_with(&PairIn(bench.tick(None)), |now| {
                    lockstep.sample(now).map(|_| now.see(|s| s.p.left.w.fire))
                })
                .unwrap();
            fired += u64::from(seen.unwrap());
        }
        assert!(fired > 300, "{fired}");
    }
}

/// The forms are equal in every tick: with N fixed at 1 as long as N is 1 elsewhere too.
#[test]
fn every_form_is_the_embodiment_in_every_tick() {
    let names = OUTPUTS
        .into_iter()
        .chain(["predicted", "learned_time", "refused"]);
    let outputs: Vec<_> = names.map(|name| (name, name)).collect();
    for &form in LeadForm::ALL {
        for memory in [Memory::ShiftRegister, Memory::Ram] {
            if (form, memory) == (LeadForm::EarlyDifference, Memory::Ram) {
                continue;
            }
            let one = form.division() == Division::One;
            let mut left = plain(Memory::ShiftRegister);
            if one {
                left.rom = Image::of(2, left.widths.time(), [7, 15, 1, 4]);
            }
            let mut right = left.clone();
            right.lead_from = LeadFrom::Time { memory, form };
            let pair = Pair { left, right };
            let mut lockstep = Lockstep::of(&pair, &outputs).unwrap();
            let mut bench = Bench::new(5);
            let mut simulator = LastTicks::simulator(&pair).unwrap();
            let (mut fired, mut learned) = (0u64, 0u64);
            for tick in 0..60_000 {
                let mut i = bench.tick(None);
                if one {
                    i.learn = false;
                    i.step_time %= 16;
                }
                let seen = simulator
                    .step_with(&PairIn(i), |now| {
                        let seen = [
                            now.see(|s| s.p.left.w.fire),
                            now.see(|s| s.p.left.w.learned),
                        ];
                        lockstep.sample(now).map(|_| seen)
                    })
                    .unwrap();
                let seen =
                    seen.unwrap_or_else(|error| panic!("{form:?}, {memory:?}, {tick}: {error}"));
                fired += u64::from(seen[0]);
                learned += u64::from(seen[1]);
            }
            assert!(
                fired > 120 && (one || learned > 20),
                "{form:?}: {fired}, {learned}"
            );
        }
    }
}

/// Combinations that forms do not have.
#[test]
fn a_form_says_what_it_has_not() {
    let refused = |form, memory, placement| {
        let mut circuit = small(memory, placement);
        circuit.lead_from = LeadFrom::Time { memory, form };
        Simulator::new(&circuit).unwrap_err().to_string()
    };
    let early = refused(LeadForm::EarlyDifference, Memory::Ram, Placement::Position);
    assert!(
        early.ends_with("a RAM is its own take-out: no subtractor stands before that"),
        "{early}"
    );
    for placement in [Placement::Target, Placement::Halves] {
        let products = refused(LeadForm::Products, Memory::Ram, placement);
        let end = "the products are the place itself: no lead is put on a target";
        assert!(products.ends_with(end), "{products}");
    }
}

/// Runs a compensator and counts, beside it, the samples since the history began anew.
fn never_fires_too_early(circuit: &Compensator, wanted: impl Fn(u64) -> Option<u64>) {
    let (mut samples, mut fired, mut early) = (0u64, 0u64, 0u64);
    let mut bench = Bench::new(21);
    let mut simulator = LastTicks::simulator(circuit).unwrap();
    // Time and number of samples that the pair was made with which is looked at in this tick.
    let mut pair: Option<(u64, u64)> = None;
    for tick in 0..400_000 {
        let i = bench.tick(None);
        let restart = i.clear;
        let (ck, fire, halting, time) = simulator
            .step_with(&i, |now| {
                let [ck, fire] = [now.see(|s| s.w.ck), now.see(|s| s.w.fire)];
                let halting = now.see(|s| s.p.sequencer.q.halting);
                (ck, fire, halting, now.see(|s| s.w.lead_time))
            })
            .unwrap();
        let covered = pair.is_some_and(|(time, samples)| {
            wanted(time).is_some_and(|samples_wanted| samples > samples_wanted)
        });
        assert!(!fire || covered, "tick {tick}: {pair:?}, halting {halting}");
        fired += u64::from(fire);
        early += u64::from(pair.is_some() && !covered);
        samples = if restart { 0 } else { samples + u64::from(ck) };
        pair = (ck && !restart).then_some((time, samples));
    }
    assert!(fired > 1000 && early > 100, "{fired} and {early}");
}

#[test]
fn nothing_fires_before_the_history_is_valid() {
    let tap = |time: u64| match time {
        0 => Some(0),
        time => codes::code(15, time).map(|code| code.tap),
    };
    never_fires_too_early(&plain(Memory::ShiftRegister), tap);
    never_fires_too_early(&plain(Memory::Ram), tap);
}
