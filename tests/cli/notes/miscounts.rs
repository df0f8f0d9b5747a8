//! How often RST that clears the flip-flop 40 alone (¶0017) miscounts.

use motion_rtl::circuits::pulse_interpolator::counts;
use motion_rtl::circuits::pulse_interpolator::{PulseGenerator, SyncStage, Variant};
use motion_rtl::circuits::pulse_interpolator::{pulse_generator, sync_stage};
use motion_rtl::prelude::*;

/// The longest unit time looked at.
const PERIODS: u32 = 64;
/// Unit times played of every T and n, one behind the other.
const UNITS: usize = 8;

/// A pulse generator with its sync stage.
#[derive(Debug, Clone)]
struct Line {
    variant: Variant,
}

signals! { for Line as c;
    struct In {
        half_period: U(7),
        unit_rst: Bit,
    }
    struct Parts {
        generator: Part<PulseGenerator>(PulseGenerator { width: 7, variant: c.variant }),
        sync: Part<SyncStage>(SyncStage {}),
    }
    struct Net { step: Bit }
}

impl Circuit for Line {
    const NAME: &'static str = "line";
    const ABOUT: &'static str = "pulses of one axis";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let generator = p.generator.settle(pulse_generator::In {
            half_period: i.half_period,
            unit_rst: i.unit_rst,
        });
        let sync = p.sync.settle(sync_stage::In {
            pulse: generator.w.pulse,
            unit_rst: i.unit_rst,
        });
        (Net { step: sync.q.step }, Nothing)
    }
}

/// The pulses of each of [`UNITS`] unit times, beginning with a counter of 0 and a low line.
fn play(mut line: Simulator<Line>, half_period: u32, period: u32) -> Vec<u32> {
    let step = line.signals().w.step;
    line.set(|i| i.half_period, half_period.into()).unwrap();
    let mut units = Vec::new();
    for _ in 0..UNITS {
        let mut pulses = 0;
        // The line is forced low at RST, so each unit time's rises are its own.
        let mut before = false;
        for tick in 1..=period {
            line.set(|i| i.unit_rst, tick == period).unwrap();
            let level = line.get(step);
            pulses += u32::from(level && !before);
            before = level;
            line.step();
        }
        units.push(pulses);
    }
    units
}

/// Which half-periods are played.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Data {
    All,
    Recipe,
    Filling,
}

impl Data {
    const ALL: [(Data, &str); 3] = [
        (Data::All, "all up to T"),
        (Data::Recipe, "by the recipe"),
        (Data::Filling, "2Yn = T"),
    ];

    /// The half-periods for a unit time.
    fn half_periods(self, period: u32) -> Vec<u32> {
        let recipe = |pulses| counts::recipe(pulses, period).expect("there are pulses");
        match self {
            Data::All => (1..=period).collect(),
            Data::Recipe => (1..=period / 2)
                .filter(|&pulses| counts::pulses(recipe(pulses), period) == pulses)
                .map(recipe)
                .collect(),
            Data::Filling => (1..=period / 2)
                .filter(|pulses| period.is_multiple_of(2 * pulses))
                .map(recipe)
                .collect(),
        }
    }
}

/// Unit times played, and those of them whose count is not the law's.
fn count(variant: Variant, data: Data, units: std::ops::Range<usize>) -> (usize, usize) {
    let line = Simulator::new(&Line { variant }).expect("a circuit");
    let (mut played, mut wrong) = (0, 0);
    for period in 1..=PERIODS {
        for half_period in data.half_periods(period) {
            let law = counts::pulses(half_period, period);
            let counted = play(line.clone(), half_period, period);
            played += units.len();
            wrong += counted[units.clone()].iter().filter(|&&c| c != law).count();
        }
    }
    (played, wrong)
}

/// A table of both variants.
pub fn table() -> String {
    let mut text = String::from(
        "| variant | half-periods | unit times | played | miscounted | share |\n\
         |---|---|---|---|---|---|\n",
    );
    for (name, variant) in [("safe", Variant::Safe), ("literal", Variant::Literal)] {
        for (data, half_periods) in Data::ALL {
            for (which, units) in [("first", 0..1), ("2nd to 8th", 1..UNITS)] {
                let (played, wrong) = count(variant, data, units);
                let share = 100.0 * wrong as f64 / played as f64;
                text += &format!(
                    "| {name} | {half_periods} | {which} | {played} | {wrong} | {share:.1} % |\n"
                );
            }
        }
    }
    text
}

#[test]
#[ignore = "takes long"]
fn the_share_of_miscounted_units() {
    println!("{}", table());
    for (data, _) in Data::ALL {
        assert_eq!(count(Variant::Safe, data, 0..UNITS).1, 0);
        assert_eq!(count(Variant::Literal, data, 0..1).1, 0);
    }
    let literal = |data| count(Variant::Literal, data, 1..UNITS);
    assert_eq!(literal(Data::All), (14_560, 4299));
    assert_eq!(literal(Data::Recipe), (2170, 442));
    assert_eq!(literal(Data::Filling), (833, 0));
}
