//! `compare` on what it cannot use.

use super::compare::dump;
use super::support::Bench;
use expect_test::{Expect, expect};

const ROWS: [&[&str]; 2] = [&["0"], &["1"]];

fn plain() -> String {
    dump(&["top"], &["reg 4 count [3:0] out"], &ROWS)
}

#[track_caller]
fn refused(golden: &str, other: &str, more: &[&str], text: &Expect) {
    let bench = Bench::with("g.vcd", golden);
    bench.write("o.vcd", other);
    let done = bench.run(&[&["compare", "g.vcd", "o.vcd"], more].concat());
    text.assert_eq(&done.stderr);
    assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{more:?}");
}

#[test]
fn files_that_are_no_waves_are_refused() {
    let cut = plain();
    let cases: [(&str, &Expect); 19] = [
        (
            "",
            &expect![[r#"
            error: o.vcd: file: empty; allowed: a VCD, an FST or a GHW
        "#]],
        ),
        (
            "G1 X10\n",
            &expect![[r#"
            error: o.vcd: file: neither VCD, FST nor GHW; allowed: a VCD, an FST or a GHW
        "#]],
        ),
        (
            "$version\n",
            &expect![[r#"
            error: o.vcd:1: $version: has no $end; allowed: a complete VCD: this one is cut off
        "#]],
        ),
        (
            "$var wire 1 ! a $end\n",
            &expect![[r#"
            error: o.vcd:2: file: the file ends before $enddefinitions; allowed: a complete VCD: this one is cut off
        "#]],
        ),
        (
            "$enddefinitions $end\n#0\n",
            &expect![[r#"
            error: o.vcd: file: no signal in it; allowed: a VCD with signals
        "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#0\n",
            &expect![[r#"
                error: o.vcd: file: no value in it; allowed: a VCD with values
            "#]],
        ),
        (
            "$var wire one ! a $end\n",
            &expect![[r#"
            error: o.vcd:1: a: has no width; allowed: a number of bits
        "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#0\n$dumpoff\nx!\n$end\n",
            &expect![[r#"
            error: o.vcd: file: no value in it; allowed: a VCD with values
        "#]],
        ),
        (
            "$var wire 1 ! $end\n",
            &expect![[r#"
            error: o.vcd:1: $var: a word is missing; allowed: $var KIND WIDTH CODE NAME $end
        "#]],
        ),
        (
            "$upscope $end\n",
            &expect![[r#"
            error: o.vcd:1: $upscope: no scope is open; allowed: one $upscope for each $scope
        "#]],
        ),
        (
            "$timescale 1 ns $end\n$timescale 1 ps $end\n",
            &expect![[r#"
            error: o.vcd:2: $timescale: stands here again; allowed: one in a file
        "#]],
        ),
        (
            "$var wire 1 ! a $end\n$var wire 2 ! b $end\n",
            &expect![[r#"
                error: o.vcd:2: b: another variable of its code has another width or kind; allowed: one code for each signal
            "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#0\n1?\n",
            &expect![[r#"
                error: o.vcd:4: 1?: ? is no code of a variable; allowed: 0, 1, x or z and the code of a variable, b and the bits, r, s, or # and a time
            "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#0\nb10 !\n",
            &expect![[r#"
                error: o.vcd:4: b10: is no value of a signal of 1 bit; allowed: 0, 1, x or z and the code of a variable, b and the bits, r, s, or # and a time
            "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#5\n1!\n#4\n",
            &expect![[r#"
                error: o.vcd:5: #4: the time goes back; allowed: times that grow
            "#]],
        ),
        (
            "$var wire 1 ! a $end\n$enddefinitions $end\n#x\n",
            &expect![[r#"
                error: o.vcd:3: #x: is no time; allowed: # and a whole number below 2^64
            "#]],
        ),
        (
            "$var wire 1 ! clk $end\n$var wire 1 a b $end\n$var wire 1 c b $end\n$enddefinitions $end\n#0\n1!\n",
            &expect![[r#"
                error: o.vcd: b: two signals have this name; allowed: a name for each signal
            "#]],
        ),
        (
            &cut[..cut.len() - 3],
            &expect![[r#"
                error: o.vcd:18: #: is no time; allowed: # and a whole number below 2^64
            "#]],
        ),
        (
            "$version motion-rtl 0.1.0 $end\n$var wire 1 ! clk $end\n$enddefinitions $end\n#0\n1!\n",
            &expect![[r#"
                error: o.vcd:5: file: the last line is no time; allowed: a complete VCD: this one is cut off
            "#]],
        ),
    ];
    for (other, text) in cases {
        refused(&plain(), other, &[], text);
    }
    let bench = Bench::with("g.vcd", plain());
    bench.refuse(
        &["compare", "g.vcd", "none.fst"],
        "none.fst: file: cannot be read: No such file or directory (os error 2); allowed: a readable file",
    );
    bench.refuse(
        &["compare", ".", "g.vcd"],
        ".: file: not a regular file; allowed: a readable file",
    );
    bench.refuse(
        &["compare", "g.vcd", "g.vcd", "--map", "."],
        ".: file: not a regular file; allowed: a readable file",
    );
    bench.write("m.toml", b"# a map\n\xff");
    bench.refuse(
        &["compare", "g.vcd", "g.vcd", "--map", "m.toml"],
        "m.toml:2: file: not UTF-8; allowed: a map in TOML",
    );
    bench.refuse(
        &["compare", "g.vcd", "g.vcd", "--ticks", "0"],
        "--ticks: is 0; allowed: 1 or more",
    );
}

#[test]
fn clocks_that_are_none_are_refused() {
    let plain = plain();
    let renamed = plain.replace(" clk ", " clock ");
    refused(
        &plain,
        &renamed,
        &[],
        &expect![[r#"
        error: o.vcd: --other-clock: no common clock: there is top.clk in the golden file and no clk here; allowed: a signal of 1 bit: top.clock
    "#]],
    );
    refused(
        &renamed,
        &plain,
        &[],
        &expect![[r#"
        error: g.vcd: --clock: there is no clk of 1 bit; allowed: a signal of 1 bit: top.clock
    "#]],
    );
    refused(
        &plain,
        &plain,
        &["--clock", "count"],
        &expect![[r#"
        error: g.vcd: --clock: there is no count of 1 bit; allowed: a signal of 1 bit: top.clk
    "#]],
    );
    refused(
        &plain,
        &plain.replace("\n0!", ""),
        &[],
        &expect![[r#"
        error: o.vcd: top.clk: the clock never changes; allowed: a clock that is 0 or 1 at all times and changes
    "#]],
    );
    refused(
        &plain,
        &plain.replace("\n0!", "\nx!"),
        &[],
        &expect![[r#"
        error: o.vcd: top.clk: the clock is x or z at 5 ns; allowed: a clock that is 0 or 1 at all times and changes
    "#]],
    );
    let two = dump(
        &["tb"],
        &["wire 4 count [3:0]", "wire 1 u.clk"],
        &[&["0", "1"], &["1", "0"]],
    );
    let two = two.replace(" clk $end", " v.clk $end");
    refused(
        &plain,
        &two,
        &[],
        &expect![[r#"
        error: o.vcd: --other-clock: 2 signals of different edges are called clk; allowed: one of them by its path: tb.v.clk, tb.u.clk
    "#]],
    );
    refused(
        &two.replace("$scope", "$comment ports out: tb.count $end\n$scope"),
        &plain,
        &[],
        &expect![[r#"
        error: g.vcd: --clock: 2 signals of different edges are called clk; allowed: one of them by its path: tb.v.clk, tb.u.clk
    "#]],
    );
    // Named, either will do.
    let bench = Bench::with("g.vcd", &plain);
    bench.write("o.vcd", &two);
    bench.succeed(&["compare", "g.vcd", "o.vcd", "--other-clock", "v.clk"]);
    bench.write("o.vcd", &renamed);
    bench.succeed(&["compare", "g.vcd", "o.vcd", "--other-clock", "top.clock"]);
}

#[test]
fn scopes_and_windows_that_are_none_are_refused() {
    let plain = plain();
    refused(
        &plain,
        &plain,
        &["--scope", "tb"],
        &expect![[r#"
        error: o.vcd: --scope: there is no tb; allowed: a scope: top
    "#]],
    );
    let foreign = dump(&["tb"], &["wire 4 other [3:0]"], &ROWS);
    refused(
        &plain,
        &foreign,
        &[],
        &expect![[r#"
            error: o.vcd: names: no golden signal has a partner of the same name in any scope; allowed: --map, which pairs other names; `compare --template` begins one
        "#]],
    );
    refused(
        &plain,
        &foreign,
        &["--scope", "tb"],
        &expect![[r#"
        error: o.vcd: file: no signal of the golden file has a partner here; allowed: --scope or --map that pairs at least one of top.count
    "#]],
    );
    let twice = dump(
        &["tb"],
        &["wire 4 a.count [3:0]", "wire 4 b.count [3:0]"],
        &[&["0", "0"], &["1", "1"]],
    );
    refused(
        &plain,
        &twice,
        &[],
        &expect![[r#"
        error: o.vcd: --scope: 2 scopes have the same number of signals of the golden file's; allowed: one of tb.a, tb.b
    "#]],
    );
    refused(
        &plain,
        &plain,
        &["--skip", "2"],
        &expect![[r#"
        error: o.vcd: ticks: no common tick: g.vcd has ticks 0 to 1, this file ticks -2 to -1 in golden's count; allowed: --skip, --from and --ticks that leave a tick of both
    "#]],
    );
    refused(
        &plain,
        &plain,
        &["--from", "2"],
        &expect![[r#"
            error: o.vcd: ticks: no common tick: g.vcd has ticks 0 to 1, this file ticks 0 to 1 in golden's count, asked for are ticks from 2 on; allowed: --skip, --from and --ticks that leave a tick of both
        "#]],
    );
}

#[test]
fn maps_that_do_not_fit_are_refused() {
    let plain = plain();
    let cases = [
        (
            "ignore = [\"top.x\"]",
            expect![[r#"
            error: m.toml:1: top.x: no signal of the golden file is called so; allowed: a signal of g.vcd, or a scope as "top.scope.*"
        "#]],
        ),
        (
            "ignore = [\"tap.*\"]",
            expect![[r#"
            error: m.toml:1: tap.*: no scope of the golden file is called tap; allowed: a scope: top
        "#]],
        ),
        (
            "[scopes]\n\"tap\" = \"top\"",
            expect![[r#"
            error: m.toml:2: tap: no scope of the golden file is called tap; allowed: a scope: top
        "#]],
        ),
        (
            "[scopes]\n\"top\" = \"tap\"",
            expect![[r#"
            error: m.toml:2: top: no scope of the other file is called tap; allowed: a scope: top
        "#]],
        ),
        (
            "[signals]\n\"top.x\" = \"top.count\"",
            expect![[r#"
            error: m.toml:2: top.x: no signal of the golden file is called so; allowed: a signal of g.vcd
        "#]],
        ),
        (
            "[signals]\n\"top.clk\" = \"top.clk\"",
            expect![[r#"
            error: m.toml:2: top.clk: is the clock; allowed: --other-clock for the other file's clock
        "#]],
        ),
        (
            "[signals]\n\"top.count\" = \"top.x\"",
            expect![[r#"
            error: m.toml:2: top.count: no signal of the other file is called top.x; allowed: a signal of g.vcd
        "#]],
        ),
        (
            "[signals]\n\"top.count\" = \"top.count[4:1]\"",
            expect![[r#"
                error: m.toml:2: top.count: top.count[4:1] is no part of the signal; allowed: bits of top.count[3:0]
            "#]],
        ),
        (
            "[signals\n",
            expect![[r#"
                error: m.toml:1: [signals: unclosed table, expected `]`; allowed: ignore = ["golden name"] and leave = ["port out"] first, then [scopes] and [signals] with lines of "golden name" = "other name"
            "#]],
        ),
    ];
    for (map, text) in cases {
        let bench = Bench::with("g.vcd", &plain);
        bench.write("m.toml", map);
        let done = bench.run(&["compare", "g.vcd", "g.vcd", "--map", "m.toml"]);
        text.assert_eq(&done.stderr);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{map}");
    }
}
