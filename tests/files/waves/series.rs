//! Series of a counter.

use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::sim::Simulator;
use motion_rtl::trace::{
    Position, Rows, SeriesAxis, SeriesFile, SeriesFormat, SeriesLayout, SeriesPlan,
};
use std::io::{self, Cursor};
use std::ops::Range;

fn signal(path: &str) -> Position {
    Position::Signal {
        path: path.to_owned(),
        scale: 0.5,
    }
}

/// Series of 20 ticks of a counter of periods of 3 ticks.
fn counter(rows: Rows, ticks: Range<u64>, format: SeriesFormat) -> io::Result<Vec<u8>> {
    let counter = EnableCounter { width: 2 };
    let layout = SeriesLayout {
        rows,
        plans: vec![SeriesPlan {
            clock: "enable".to_owned(),
            at: Box::new(|count| vec![count as f64]),
        }],
        axes: vec![
            SeriesAxis {
                name: "a".to_owned(),
                unit: "counts",
                commanded: Position::Planned { plan: 0, axis: 0 },
                actual: signal("count"),
            },
            SeriesAxis {
                name: "b".to_owned(),
                unit: "counts",
                commanded: Position::Nearest {
                    path: "next".to_owned(),
                },
                actual: Position::Steps {
                    step: "enable".to_owned(),
                    dir: "enable".to_owned(),
                },
            },
        ],
    };
    let out = Cursor::new(Vec::new());
    let mut series = SeriesFile::new(out, format, &counter, 4, ticks, layout)?;
    let mut simulator = Simulator::new(&counter).unwrap();
    simulator.set(|i| i.period, 3).unwrap();
    for _ in 0..20 {
        let ((), flow) = simulator.look_as_set(&mut series, |_| ()).unwrap();
        assert!(flow.is_continue());
        simulator.step();
    }
    Ok(series.finish()?.into_inner())
}

fn text(rows: Rows, ticks: Range<u64>) -> Vec<String> {
    let bytes = counter(rows, ticks, SeriesFormat::Csv).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    text.lines().map(str::to_owned).collect()
}

fn strobe(period: u64) -> Rows {
    Rows::Strobe {
        path: "enable".to_owned(),
        period,
    }
}

#[test]
fn a_row_is_at_each_strobe_with_its_time_and_differences() {
    let lines = text(strobe(3), 0..12);
    let head = "tick,time_s,a_commanded_counts,a_actual_counts,a_error_counts,\
                b_commanded_counts,b_actual_counts,b_error_counts";
    // Steps down, and `next`, which is 3, as the nearest of -1, -5 and so on.
    let due = [
        head,
        "2,0.5,1,1,0,-1,-1,0",
        "5,1.25,2,1,1,-1,-2,1",
        "8,2,3,1,2,-5,-3,-2",
        "11,2.75,4,1,3,-5,-4,-1",
    ];
    assert_eq!(lines, due);
}

#[test]
fn rows_come_by_distance_too_and_only_in_the_window() {
    let ticks = |lines: Vec<String>| -> Vec<u64> {
        let lines = lines.iter().skip(1);
        lines
            .map(|line| line.split(',').next().unwrap().parse().unwrap())
            .collect()
    };
    assert_eq!(ticks(text(Rows::Every(7), 1..20)), [1, 8, 15]);
    assert_eq!(ticks(text(Rows::Every(1), 17..100)), [17, 18, 19]);
    assert_eq!(ticks(text(strobe(1), 6..12)), [8, 11]);
    assert_eq!(ticks(text(strobe(4), 0..20)), [2, 8, 14]);
    // What is counted before the window counts.
    assert_eq!(text(strobe(3), 11..12)[1], "11,2.75,4,1,3,-5,-4,-1");
    assert_eq!(text(strobe(3), 3..5).len(), 1);
}

#[test]
fn the_header_has_one_length_for_any_number_of_rows() {
    let none = counter(strobe(3), 0..1, SeriesFormat::Npy).unwrap();
    let some = counter(strobe(3), 0..20, SeriesFormat::Npy).unwrap();
    assert_eq!(none.len() % 64, 0);
    assert_eq!(some.len(), none.len() + 6 * 8 * 8);
    let has = |bytes: &[u8], shape: &str| String::from_utf8_lossy(bytes).contains(shape);
    assert!(has(&none, "'shape': (0,), }") && has(&some, "'shape': (6,), }"));
    assert_eq!(none[none.len() - 1], b'\n');
}

#[test]
fn a_signal_that_does_not_exist_is_named() {
    let rows = Rows::Strobe {
        path: "enabled".to_owned(),
        period: 1,
    };
    let error = counter(rows, 0..1, SeriesFormat::Csv).unwrap_err();
    let text = "no signal enable_counter.enabled was recorded; near it: enable_counter.enable";
    assert!(error.to_string().starts_with(text), "{error}");
}
