use super::*;

fn accept(text: &str) -> PositionLog {
    read("l.csv", text.as_bytes(), &Columns::default()).unwrap()
}

fn refuse(text: &str, columns: &Columns) -> String {
    read("l.csv", text.as_bytes(), columns)
        .unwrap_err()
        .to_string()
}

/// Returns counts and lines of the samples.
fn samples(log: &PositionLog) -> Vec<(i64, usize)> {
    let of = |sample: &Sample| (sample.counts, sample.line);
    log.samples.iter().map(of).collect()
}

#[test]
fn a_log_is_read_with_header_and_without() {
    let plain = accept("7170,0\n7175,12\n7180,-30\n");
    assert_eq!(samples(&plain), [(0, 1), (12, 2), (-30, 3)]);
    let seconds: Vec<f64> = plain.samples.iter().map(|s| s.seconds).collect();
    assert_eq!(seconds, [0.0, 0.005, 0.01]);
    assert_eq!(plain.seconds(), 0.01);

    let text = "\u{feff}time,   left\r\n# rest\r\n\r\n 7170,   0 \r\n\n7175,\t12,9\r\n  \n\
                #\n7180,\"-30\"";
    let log = accept(text);
    assert_eq!(samples(&log), [(0, 4), (12, 6), (-30, 9)]);
    let bare = |log: &PositionLog| log.samples.iter().map(|s| s.seconds).collect::<Vec<_>>();
    assert_eq!(bare(&log), bare(&plain));
}

#[test]
fn of_equal_times_the_last_count_holds() {
    let log = accept("Time (ms), Position (count)\n100, 10\n100, 11\n101, 12\n102, 14\n");
    assert_eq!(samples(&log), [(11, 3), (12, 4), (14, 5)]);
    // As integers of 53 bits these times would be equal.
    let log = accept("t_ns,c\n1600000000010000000,1\n1600000000010000001,2\n");
    assert_eq!(samples(&log), [(1, 2), (2, 3)]);
    assert_eq!(log.seconds(), 1e-9);
}

#[test]
fn counts_may_be_written_as_fractions() {
    let log = accept("time,encoder\n0,0.0\n10,12.0\n20,-25.\n");
    assert_eq!(samples(&log), [(0, 2), (12, 3), (-25, 4)]);
}

#[test]
fn the_unit_is_given_in_the_header_or_that_of_the_steps() {
    let unit = |text: &str, time_unit_s| {
        let columns = Columns {
            time_unit_s,
            ..Columns::default()
        };
        let log = read("l.csv", text.as_bytes(), &columns).unwrap();
        (log.seconds(), log.unit.to_string(), log.unit.from)
    };
    let header = "Time [s],Count\n0.00,0\n0.01,3\n0.02,7\n0.03,9\n";
    let of = |seconds: f64, unit: &str, from| (seconds, unit.to_owned(), from);
    assert_eq!(unit(header, None), of(0.03, "s", UnitFrom::Header));
    let given = unit(header, Some(2.5e-3));
    assert_eq!(
        given,
        of(0.03 * 2.5e-3, "units of 0.0025 s", UnitFrom::Given)
    );
    assert_eq!(unit(header, Some(1e-3)).1, "ms");
    let ns = "1600000000010000000,0\n1600000000020000000,3\n1600000000030000000,5\n";
    assert_eq!(unit(ns, None), of(0.02, "ns", UnitFrom::Step));
    assert_eq!(
        unit("0,0\n5,1\n10,2\n", None),
        of(0.01, "ms", UnitFrom::Step)
    );
    for (text, fault) in [
        (
            "time,c\n0,0\n20,1\n40,2\n",
            "l.csv:1: time: without a unit, and its median step may be 20 ms or 20 us; allowed: a \
             unit in the header, as in time_ms, or by log_time_unit_ms",
        ),
        (
            "time,c\n0,0\n1e11,1\n",
            "l.csv:1: time: without a unit, and its median step, 100000000000, is of none; \
             allowed: a unit in the header, as in time_ms, or by log_time_unit_ms",
        ),
        (
            "Time [ticks],c\n0,0\n5,1\n",
            "l.csv:1: Time [ticks]: is in 'ticks', which is no unit of time; allowed: a unit in \
             the header, as in time_ms, or by log_time_unit_ms",
        ),
    ] {
        assert_eq!(refuse(text, &Columns::default()), fault);
    }
}

#[test]
fn positions_are_interpolated() {
    let log = accept("0,0\n10,40\n20,-60\n");
    for (ms, position) in [
        (-5.0, 0.0),
        (0.0, 0.0),
        (2.5, 10.0),
        (10.0, 40.0),
        (15.0, -10.0),
        (20.0, -60.0),
        (99.0, -60.0),
    ] {
        let seen = log.position_at(ms * 1e-3);
        assert!((seen - position).abs() < 1e-9, "{ms}: {seen}");
    }
    let (speed, line) = log.fastest();
    assert!((speed - 1e4).abs() < 1e-6);
    assert_eq!(line, 3);
}

#[test]
fn what_cannot_be_used_is_refused_with_its_line() {
    let none = Columns::default();
    let cases = [
        (
            "",
            "l.csv: file: 0 samples in it; allowed: a log of 2 samples or more",
        ),
        (
            "t,c\n1,2\n",
            "l.csv: file: 1 sample in it; allowed: a log of 2 samples or more",
        ),
        (
            "7\n8\n",
            "l.csv:1: file: only one column; allowed: a column of times and one of \
          counts, with a comma between them",
        ),
        (
            "1,x\n",
            "l.csv:1: counts (column 2): is 'x'; allowed: a whole number, -2147483648 to 2147483648",
        ),
        (
            "t,c\n1,2\n\n2,3.5\n",
            "l.csv:4: c: is '3.5'; allowed: a whole number, -2147483648 to \
          2147483648",
        ),
        (
            "1,2\n2,2147483649\n",
            "l.csv:2: counts (column 2): is '2147483649'; allowed: a whole number, \
          -2147483648 to 2147483648",
        ),
        (
            "t,c\n1,2\n#\nnan,3\n",
            "l.csv:4: t: is 'nan'; allowed: a number",
        ),
        (
            "1,2\n2\n",
            "l.csv:2: counts (column 2): the line has only 1 of its fields; allowed: a number",
        ),
        (
            "1,2\n2,3\n1.5,4\n",
            "l.csv:3: time (column 1): 1.5 falls below line 2; allowed: times that do not fall",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(refuse(text, &none), message, "{text:?}");
    }
    let fault = read("l.csv", b"1,2\n2,\xff\n", &none).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "l.csv:2: file: not UTF-8; allowed: a position log in CSV"
    );
    let fault = read_path(Path::new("/nowhere/l.csv"), &none).unwrap_err();
    assert_eq!(fault.allowed, "a readable file");
}

#[test]
fn there_is_a_most_of_samples() {
    let mut text = String::new();
    for k in 0..=MOST_SAMPLES {
        text.push_str(&format!("{k},1\n"));
    }
    assert_eq!(
        refuse(&text, &Columns::default()),
        "l.csv:4000001: file: more than 4000000 samples; allowed: at most 4000000"
    );
}

/// In a file that is not a log the first record may be everything.
#[test]
fn a_record_has_an_end() {
    let allowed = format!("records of at most {LONGEST_RECORD} bytes");
    for (line, text) in [
        (1, "1".repeat(LONGEST_RECORD + 1)),
        (1, "1,".repeat(LONGEST_RECORD)),
        (3, format!("0,0\n1,0\n{}", "7".repeat(LONGEST_RECORD + 1))),
    ] {
        let fault = read("z.csv", text.as_bytes(), &Columns::default()).unwrap_err();
        assert_eq!(
            (fault.line, fault.problem.as_str()),
            (line, "a record without an end")
        );
        assert_eq!(fault.allowed, allowed);
    }
    // Quotes may contain lines.
    let text = format!("0,0\n\"{}", "7\n".repeat(LONGEST_RECORD));
    let fault = read("z.csv", text.as_bytes(), &Columns::default()).unwrap_err();
    assert_eq!(fault.problem, "a record without an end");
    // Comments and records of the whole log may be longer in total.
    let comments = "# a comment\n\n".repeat(LONGEST_RECORD / 8);
    let samples: String = (0..300_000).map(|k| format!("{k},7\n")).collect();
    let text = format!("{comments}time_ms,counts\n{samples}");
    let log = read("a.csv", text.as_bytes(), &Columns::default()).unwrap();
    assert_eq!(log.samples.len(), 300_000);
}
