//! Random traces, written in two ways: equal, and with one bit flipped.

use motion_rtl::compare::{Report, Settings, compare};
use proptest::prelude::*;
use std::fs;

/// A value for each signal in each tick.
#[derive(Debug, Clone)]
struct Trace {
    widths: Vec<u32>,
    ticks: Vec<Vec<u64>>,
}

fn bits(value: u64, width: u32) -> String {
    format!("{value:0digits$b}", digits = width as usize)
}

fn header(trace: &Trace, scale: &str, scopes: &[&str]) -> String {
    let mut text = format!("$timescale {scale} $end\n");
    let ports = (0..trace.widths.len()).map(|place| format!(" {}.sig{place}", scopes.join(".")));
    text += &format!("$comment ports out:{} $end\n", ports.collect::<String>());
    for scope in scopes {
        text += &format!("$scope module {scope} $end\n");
    }
    text += "$var wire 1 ! clk $end\n";
    for (place, width) in trace.widths.iter().enumerate() {
        text += &format!("$var reg {width} s{place} sig{place} $end\n");
    }
    text + &"$upscope $end\n".repeat(scopes.len()) + "$enddefinitions $end\n"
}

/// The clock is high at the start; values change with its rise; every value, every tick.
fn simple(trace: &Trace) -> String {
    let mut text = header(trace, "1 us", &["top"]);
    for (tick, values) in trace.ticks.iter().enumerate() {
        text += &format!("#{}\n1!\n", 2 * tick);
        for (place, value) in values.iter().enumerate() {
            text += &format!("b{} s{place}\n", bits(*value, trace.widths[place]));
        }
        text += &format!("#{}\n0!\n", 2 * tick + 1);
    }
    text + &format!("#{}\n", 2 * trace.ticks.len())
}

/// The clock is low at the start; some values change at its fall, some settle later, the clock
/// comes last; only changes are written.
fn awkward(trace: &Trace) -> String {
    let mut text = header(trace, "10 ps", &["tb", "dut"]) + "#0\n0!\n";
    let write = |text: &mut String, place: usize, value: u64| {
        *text += &format!("b{} s{place}\n", bits(value, trace.widths[place]));
    };
    for (tick, values) in trace.ticks.iter().enumerate() {
        let changed = |place: &usize| tick == 0 || trace.ticks[tick - 1][*place] != values[*place];
        let places: Vec<_> = (0..values.len()).rev().filter(changed).collect();
        let rise = 70 * tick;
        if tick > 0 {
            text += &format!("#{rise}\n");
        }
        for &place in places.iter().filter(|place| **place % 3 != 1) {
            // A glitch on the way for some.
            if place % 3 == 2 {
                write(
                    &mut text,
                    place,
                    !values[place] & u64::MAX >> (64 - trace.widths[place]),
                );
            } else {
                write(&mut text, place, values[place]);
            }
        }
        text += if tick > 0 { "1!\n" } else { "" };
        text += &format!("#{}\n", rise + 30);
        text += if tick > 0 { "0!\n" } else { "" };
        for &place in places.iter().filter(|place| **place % 3 != 0) {
            write(&mut text, place, values[place]);
        }
    }
    text
}

fn hold(golden: &str, other: &str) -> Report {
    let directory = tempfile::tempdir().unwrap();
    let [one, two] = ["golden.vcd", "other.vcd"].map(|name| directory.path().join(name));
    fs::write(&one, golden).unwrap();
    fs::write(&two, other).unwrap();
    compare(&one, &two, &Settings::default()).unwrap()
}

fn traces() -> impl Strategy<Value = Trace> {
    let widths = prop::collection::vec(1..=64_u32, 1..6);
    (widths, 1..20_usize).prop_flat_map(|(widths, ticks)| {
        let row: Vec<_> = widths
            .iter()
            .map(|&width| 0..=u64::MAX >> (64 - width))
            .collect();
        let ticks = prop::collection::vec(row, ticks);
        ticks.prop_map(move |ticks| Trace {
            widths: widths.clone(),
            ticks,
        })
    })
}

proptest! {
    #[test]
    fn the_same_trace_is_equal_however_it_is_written(trace in traces()) {
        // A clock that never moves is refused.
        prop_assume!(trace.ticks.len() > 1);
        let report = hold(&simple(&trace), &awkward(&trace));
        prop_assert!(report.is_equal(), "{report}");
        prop_assert_eq!(report.ticks, trace.ticks.len() as u64);
        prop_assert_eq!(report.values, (trace.ticks.len() * trace.widths.len()) as u64);
    }

    #[test]
    fn a_flipped_bit_is_found_where_it_is(
        trace in traces(),
        tick in any::<prop::sample::Index>(),
        signal in any::<prop::sample::Index>(),
        bit in any::<prop::sample::Index>(),
    ) {
        prop_assume!(trace.ticks.len() > 1);
        let tick = tick.index(trace.ticks.len());
        let signal = signal.index(trace.widths.len());
        let mut flipped = trace.clone();
        flipped.ticks[tick][signal] ^= 1 << bit.index(trace.widths[signal] as usize);
        let report = hold(&simple(&trace), &awkward(&flipped));
        prop_assert_eq!(report.differences.len(), 1);
        let found = &report.differences[0];
        prop_assert_eq!((found.tick, found.ticks), (tick as u64, 1));
        prop_assert_eq!(&found.golden, &format!("top.sig{signal}"));
        prop_assert_eq!(&found.other, &format!("tb.dut.sig{signal}"));
        prop_assert_eq!(report.first.map(|first| first.tick), Some(tick as u64));
    }
}
