//! How often RST that clears the flip-flop 40 alone (¶0017) miscounts.

use motion_rtl::kernel::{Circuit, Instance};
use motion_rtl::logic::Sim;
use motion_rtl::pulse_interpolator::counts;
use motion_rtl::pulse_interpolator::{PulseGenerator, SyncStage, Variant};
use motion_rtl::pulse_interpolator::{pulse_generator, sync_stage};

/// The longest unit time looked at.
const PERIODS: u32 = 64;
/// Unit times played of every T and n, one behind the other.
const UNITS: usize = 8;

/// The pulses of each of [`UNITS`] unit times, beginning with a counter of 0 and a low line.
fn play(variant: Variant, half_period: u32, period: u32) -> Vec<u32> {
    let (generator, sync) = (PulseGenerator::<7> { variant }, SyncStage);
    let (mut q, mut line) = (generator.power_on(), sync.power_on());
    let mut units = Vec::new();
    for _ in 0..UNITS {
        let mut pulses = 0;
        // The line is forced low at RST, so each unit time's rises are its own.
        let mut before = false;
        for tick in 1..=period {
            let level = line.step.get();
            pulses += u32::from(level && !before);
            before = level;
            let unit_rst = (tick == period).into();
            let half_period = u64::from(half_period).into();
            let ports = pulse_generator::In {
                half_period,
                unit_rst,
            };
            let block = Instance::<_, Sim>::settle(&generator, &q, ports);
            let pulse = block.w.pulse;
            let stage =
                Instance::<_, Sim>::settle(&sync, &line, sync_stage::In { pulse, unit_rst });
            q = block.next(&generator, q);
            line = stage.next(&sync, line);
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
    let (mut played, mut wrong) = (0, 0);
    for period in 1..=PERIODS {
        for half_period in data.half_periods(period) {
            let law = counts::pulses(half_period, period);
            let counted = play(variant, half_period, period);
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
