use super::zoo::{Part, Zoo};
use expect_test::expect;
use motion_rtl::trace::chart::{ChartFailure, parse};

const NOTE: &str = "\
# A note

```rust
let chart = 1;
```

```chart part[step=9, names=['a]', 3]] it goes up, then down
// A comment.
tick          0     1     2     3

> step        3     .     .     7
> up          #     #     _     _
= level       0     3     6     3
= next_level  3     6     3    -4
= wrapped     ___#
= phase       IDLE  .     .     .
```

````markdown
```chart quoted in a block
```
````
";

#[test]
fn a_chart_that_holds() {
    let charts = parse(NOTE).unwrap();
    assert_eq!(charts.len(), 1);
    assert_eq!((charts[0].circuit.as_str(), charts[0].line), ("part", 7));
    let pairs: Vec<_> = charts[0]
        .pairs
        .iter()
        .map(|pair| pair.to_string())
        .collect();
    assert_eq!(pairs, ["step=9", "names=['a]', 3]"]);
    assert_eq!(charts[0].title, "it goes up, then down");
    charts[0].run(&Part).unwrap();
}

#[test]
fn a_mismatch_shows_what_the_circuit_does() {
    let wrong = NOTE.replace("6     3\n= next", "5     -\n= next");
    let failure = parse(&wrong).unwrap()[0].run(&Part).unwrap_err();
    expect![[r#"
        line 13: tick 2: level is 6, the chart says 5
        what the circuit does:
        ```chart part[step=9, names=['a]', 3]] it goes up, then down
        tick          0     1     2     3
        > step        3     .     .     7
        > up          #     #     _     _
        = level       0     3     6     -
        = next_level  3     6     3     -4
        = wrapped     _     _     _     #
        = phase       IDLE  .     .     .
        ```"#]]
    .assert_eq(&failure.to_string());
    let ChartFailure::Mismatch(mismatch) = failure else {
        panic!("{failure}");
    };
    parse(&mismatch.chart).unwrap()[0]
        .run(&Part)
        .expect("what is printed holds");
}

#[test]
fn the_first_mismatch_by_tick_is_reported() {
    let wrong = NOTE
        .replace("IDLE  .     .", "IDLE  RUN   .")
        .replace("___#", "__##");
    let failure = parse(&wrong).unwrap()[0]
        .run(&Part)
        .unwrap_err()
        .to_string();
    assert!(
        failure.starts_with("line 16: tick 1: phase is IDLE, the chart says RUN\n"),
        "{failure}"
    );
}

#[test]
fn unlisted_ports_stay_at_zero_and_parts_have_paths() {
    let note = "```chart zoo\ntick 0 1 2\n= count 1020 1021 1022\n= left.level 0 . .\n= flags1 ---\n= held 0xdeadbeef . 0xdeadbeef\n= total -1 . .\n```";
    parse(note).unwrap()[0].run(&Zoo).unwrap();
}

/// Returns the error of a chart of these lines.
fn wrong(lines: &str) -> String {
    let note = format!("```chart part\n{lines}\n```\n");
    match parse(&note) {
        Err(error) => error.to_string(),
        Ok(charts) => charts[0].run(&Part).unwrap_err().to_string(),
    }
}

#[test]
fn what_can_be_wrong_with_a_chart() {
    let cases = [
        (
            "tick 0 1\n= level 0",
            "line 3: level has 1 cells, the chart has 2 ticks",
        ),
        (
            "tick 0 1\n> step 0\n= level 0 0",
            "line 3: step has 1 cells, the chart has 2 ticks",
        ),
        (
            "tick 0\n= level 0 0",
            "line 3: level has 2 cells, the chart has 1 ticks",
        ),
        (
            "tick 0 2\n= level 0 0",
            "line 2: a chart has one `tick` line, before its signals: tick 0 1 2 ...",
        ),
        (
            "= level 0",
            "line 2: a chart has one `tick` line, before its signals: tick 0 1 2 ...",
        ),
        (
            "tick\n= level",
            "line 2: a chart has one `tick` line, before its signals: tick 0 1 2 ...",
        ),
        (
            "tick 0\ntick 0\n= level 0",
            "line 3: a chart has one `tick` line, before its signals: tick 0 1 2 ...",
        ),
        (
            "tick 0\nlevel 0",
            "line 3: a line begins with `tick`, `> port`, `= signal` or `//`",
        ),
        (
            "tick 0\n=",
            "line 3: a line begins with `tick`, `> port`, `= signal` or `//`",
        ),
        (
            "tick 0\n> step 1",
            "line 1: the chart expects nothing: it has no `= signal` line",
        ),
        (
            "tick 0\n= level 0\n= level 0",
            "line 4: level has a line already",
        ),
        (
            "tick 0\n= level .",
            "line 3: level begins with `.`: there is no cell before it",
        ),
        (
            "tick 0 1\n> step 1 -\n= level 0 0",
            "line 3: step is a port in: `-` gives it no value",
        ),
        (
            "tick 0\n= levle 0",
            "line 3: the circuit has no signal levle; it has: level, phase, step, up, next_level",
        ),
        (
            "tick 0\n> level 0\n= level 0",
            "line 3: the circuit has no port in level; it has: step, up",
        ),
        (
            "tick 0\n> step 8\n= level 0",
            "line 3: step: 8 is not a value of 3 bits: 0 to 7",
        ),
        (
            "tick 0\n> step -1\n= level 0",
            "line 3: step: -1 is not a value of 3 bits: 0 to 7",
        ),
        (
            "tick 0\n= level 256",
            "line 3: level: 256 is not a value of 9 bits: -256 to 255",
        ),
        (
            "tick 0\n= level #",
            "line 3: level: # is not a value of 9 bits: -256 to 255",
        ),
        (
            "tick 0\n= phase RAN",
            "line 3: phase: RAN is not a value of 2 bits: IDLE, RUN, STOP",
        ),
        (
            "tick 0\n> up 2\n= level 0",
            "line 3: up: 2 is not a value of 1 bit: 0 to 1",
        ),
    ];
    for (lines, message) in cases {
        assert_eq!(wrong(lines), message, "{lines}");
    }
}

#[test]
fn what_can_be_wrong_with_a_fence() {
    let fence = "line 1: a chart begins with ```chart CIRCUIT or ```chart CIRCUIT[KEY=VALUE, ...]";
    for note in [
        "```chart\n```",
        "```chart part[3\n```",
        "```chart part-3\n```",
    ] {
        assert_eq!(parse(note).unwrap_err().to_string(), fence, "{note}");
    }
    // The numbers of earlier charts.
    for (pairs, text, problem) in [("9, 3", "9", "no '='"), ("a=1, =3", "=3", "no key")] {
        let error = parse(&format!("```chart part[{pairs}]\n```")).unwrap_err();
        let told = format!("line 1: `{text}`: {problem}; allowed: key=value");
        assert_eq!(error.to_string(), told);
    }
    let open = "text\n```chart part\ntick 0\n= level 0\n";
    assert_eq!(
        parse(open).unwrap_err().to_string(),
        "line 2: the chart is not closed"
    );
    // Markdown would skip it without a message.
    let ticked = "text\n```chart part `level` goes up\ntick 0\n= level 0\n```\n";
    assert_eq!(
        parse(ticked).unwrap_err().to_string(),
        "line 2: a title has no backtick: Markdown takes the line for text"
    );
    let other = parse("```chart zoo\ntick 0\n= level 0\n```").unwrap();
    assert_eq!(
        other[0].run(&Part).unwrap_err().to_string(),
        "line 1: the chart is of zoo, the circuit is part"
    );
}
