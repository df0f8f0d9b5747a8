//! The whole compensator: its variants side by side, and what must hold whatever comes in.

use super::below;
use motion_rtl::check::{Lockstep, Pair, Random};
use motion_rtl::kernel::{Observer, Simulator};
use motion_rtl::lead_angle::codes;
use motion_rtl::lead_angle::compensator::In;
use motion_rtl::lead_angle::{
    Compensator, LeadSource, Placement, PositionHistory, RamHistory, TimeLead, Variant,
};
use motion_rtl::logic::{Image, Sim};

type Small<H> = Compensator<TimeLead<H, 15, 4, 8, 8>, 15, 4, 8, 8, 2, 8, 16, 8, 8>;
type Shift = PositionHistory<15, 4, 8>;
type Ram = RamHistory<15, 4, 8>;
type SmallIn = In<Sim, 8, 8, 2, 8, 8, 8>;

/// What the outputs of a run are compared by.
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

fn times() -> Image<2, 8> {
    Image::new([7, 15, 40, 110])
}

/// A control computer at random, and an encoder that goes to and fro.
struct Bench {
    random: Random,
    position: i64,
    up: bool,
    settings: SmallIn,
}

impl Bench {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        Bench {
            settings: random.signals(),
            random,
            position: 0,
            up: true,
        }
    }

    /// The inputs of a tick, with the motor following the drive that the tick before showed.
    fn tick(&mut self, drive: Option<bool>) -> SmallIn {
        let random = &mut self.random;
        if below(random, 400) == 0 {
            self.settings = random.signals();
        }
        if below(random, 60) == 0 {
            self.up = below(random, 2) == 0;
        }
        let up = drive.unwrap_or(self.up);
        if below(random, 3) > 0 {
            self.position += if up { 1 } else { -1 };
        }
        let quarter = self.position.rem_euclid(4);
        let rarely = |random: &mut Random| (below(random, 50) == 0).into();
        SmallIn {
            a: (quarter == 1 || quarter == 2).into(),
            b: (quarter >= 2).into(),
            clear: (below(random, 2000) == 0).into(),
            run: (below(random, 20) > 0).into(),
            halt: (below(random, 300) == 0).into(),
            ck_period: below(random, 6).into(),
            standstill: below(random, 4).into(),
            time_out: below(random, 40).into(),
            rest: below(random, 4).into(),
            write_target: rarely(random),
            write_time: rarely(random),
            write_step: below(random, 4).into(),
            step_target: (random.word() as i64 % 128).into(),
            step_time: below(random, 256).into(),
            ..self.settings.clone()
        }
    }
}

#[test]
fn the_ram_compensator_is_the_compensator_in_every_tick() {
    let pair = Pair {
        left: Small::<Shift>::new(Variant::default(), times()),
        right: Small::<Ram>::new(Variant::default(), times()),
    };
    let outputs = OUTPUTS.map(|name| (name, name));
    for seed in 0..4 {
        let lockstep = Lockstep::of(&pair, &outputs).unwrap();
        let mut bench = Bench::new(seed);
        let stimulus = |_, _: &motion_rtl::kernel::Part<'_, _>| bench.tick(None);
        let end = Simulator::new(&pair)
            .unwrap()
            .run(100_000, stimulus, lockstep);
        end.unwrap();
    }
}

#[test]
fn the_three_placements_fire_in_the_same_tick() {
    let of = |placement| {
        let variant = Variant {
            placement,
            ..Variant::default()
        };
        Small::<Shift>::new(variant, times())
    };
    for other in [Placement::Target, Placement::Halves] {
        let pair = Pair {
            left: of(Placement::Position),
            right: of(other),
        };
        let outputs = OUTPUTS.map(|name| (name, name));
        let lockstep = Lockstep::of(&pair, &outputs).unwrap();
        let mut bench = Bench::new(9);
        let mut fired = 0;
        let mut simulator = Simulator::new(&pair).unwrap();
        let mut observer = lockstep;
        for _ in 0..100_000 {
            let i = bench.tick(None);
            let (next, seen) =
                simulator.step(i, |now| observer.sample(now).map(|_| now.w.left.fire.get()));
            simulator = next;
            fired += u64::from(seen.unwrap());
        }
        assert!(fired > 300, "{fired}");
    }
}

/// Runs a compensator and counts, beside it, the samples since the history began anew.
fn never_fires_too_early<P: LeadSource<8, 8, 8>>(
    circuit: &Compensator<P, 15, 4, 8, 8, 2, 8, 16, 8, 8>,
    wanted: impl Fn(u64) -> Option<u64>,
) {
    let (mut samples, mut fired, mut early) = (0u64, 0u64, 0u64);
    let mut bench = Bench::new(21);
    let mut simulator = Simulator::new(circuit).unwrap();
    // Time and number of samples that the pair was made with which is looked at in this tick.
    let mut pair: Option<(u64, u64)> = None;
    for tick in 0..400_000 {
        let i = bench.tick(None);
        let restart = i.clear.get();
        let (next, (ck, fire, halting, time)) = simulator.step(i, |now| {
            let w = now.w;
            let halting = now.q.sequencer.halting.get();
            (w.ck.get(), w.fire.get(), halting, w.lead_time.get())
        });
        simulator = next;
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
    never_fires_too_early(&Small::<Shift>::new(Variant::default(), times()), tap);
    never_fires_too_early(&Small::<Ram>::new(Variant::default(), times()), tap);
}
