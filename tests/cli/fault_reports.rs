//! Faults as they are told: all of a file at once, with their lines and what is at fault in them.

use super::support::Bench;
use expect_test::{Expect, expect};

fn told(name: &str, text: impl AsRef<[u8]>, report: Expect) {
    let bench = Bench::with(name, text);
    bench.refuse_with(&["run", name], |stderr| report.assert_eq(stderr));
}

#[test]
fn all_faults_of_a_part_program_are_told() {
    told(
        "p.ngc",
        "G21 (mm)\nG1 X10 Y1O F600\nG1 X[2*#<no>] Y3\nG41 D1\nG2 X20 Y0 I1 J1\nG1 X30 A45\n\tG1 X1 X2\nM1234\n",
        expect![[r#"
            error: p.ngc:2: O: a letter without its number, or out of place; allowed: words of a letter and a number, such as X10.5
              |
            2 | G1 X10 Y1O F600
              |          ^
            error: p.ngc:3: #<no>: has no value; allowed: a parameter that was set before
              |
            3 | G1 X[2*#<no>] Y3
              |    ^^^^^^^^^
            error: p.ngc:4: G41: cutter compensation changes the path; allowed: G0 to G5 G5.1 to G5.3 G6.2 G8 G10 G11 G15 to G21 G28 G30 G38.2 to G38.5 G40 G43 G49 G52 to G59.3 G61 G64 G68 G69 G73 G80 to G86 G89 to G94 G97 to G99
              |
            4 | G41 D1
              | ^^^
            error: p.ngc:6: A: 45: an axis that no circuit has; allowed: X, Y and Z; A, B, C, U, V and W at 0
              |
            6 | G1 X30 A45
              |        ^^^
            error: p.ngc:7: X: twice in one line; allowed: each of these letters once in a line
              |
            7 |  G1 X1 X2
              |        ^^
            error: p.ngc:8: M1234: not known to leave the path as it is; allowed: M words that neither move nor change the path
              |
            8 | M1234
              | ^^^^^
        "#]],
    );
}

#[test]
fn all_faults_of_a_drawing_are_told_in_one_long_line_too() {
    let text = format!(
        "IN;PU{}0,0;QQ1;PD1,2,3;PA9999999999,1;PD4,4;LBx",
        "1,1,".repeat(40)
    );
    told(
        "p.hpgl",
        text,
        expect![[r#"
        error: p.hpgl:1: QQ: is not known and may move the pen; allowed: instructions of HPGL and HPGL/2; with --lenient it is skipped
          |
        1 | ...1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,0,0;QQ1;PD1,2,3;PA9999999999,1;PD4,4;LBx
          |                                                                ^^
        error: p.hpgl:1: PD: an X without its Y: an odd count of coordinates; allowed: pairs of X and Y
          |
        1 | ...1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,0,0;QQ1;PD1,2,3;PA9999999999,1;PD4,4;LBx
          |                                                                ^
        error: p.hpgl:1: PA: 9999999999 is out of range; allowed: -1073741824 to 1073741824
          |
        1 | ...1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,0,0;QQ1;PD1,2,3;PA9999999999,1;PD4,4;LBx
          |                                                                ^^^^^^^^^^
        error: p.hpgl:1: LB: no label terminator after it, to the end of the file; allowed: '\u{3}' at its end
          |
        1 | ...,1,1,1,1,1,1,1,1,1,1,1,0,0;QQ1;PD1,2,3;PA9999999999,1;PD4,4;LBx
          |                                                                ^^
    "#]],
    );
}

#[test]
fn all_faults_of_a_scenario_are_told() {
    let text = "circuit = \"lead_angle\"\nclock_hz = \"fast\" # too fast\ncolour = 3\n\n[[step]]\n\
                target = 1\nspeed_counts_per_s = -1\n\n[[step]]\ntarget = 2\nsped = 10\n";
    told(
        "s.toml",
        text,
        expect![[r#"
            error: s.toml:2: clock_hz: invalid type: string "fast"; allowed: a whole number from 1 to 10000000000
              |
            2 | clock_hz = "fast" # too fast
              |            ^^^^^^
            error: s.toml:3: colour: unknown key; allowed: `motion-rtl keys lead_angle` lists all
              |
            3 | colour = 3
              | ^^^^^^
            error: s.toml:7: speed_counts_per_s: is -1; allowed: a whole number from 10 to 655350
              |
            7 | speed_counts_per_s = -1
              |                      ^^
            error: s.toml:11: sped: unknown key; allowed: one of `target`, `speed_counts_per_s`, `lead_ms`, `load_lead_ms`
               |
            11 | sped = 10
               | ^^^^
            error: s.toml:9: speed_counts_per_s: missing, and has no default; allowed: a whole number from 10 to 655350
        "#]],
    );
    told(
        "s.toml",
        "clock_hz = = 3\nlearn = yes\n",
        expect![[r#"
        error: s.toml:1: clock_hz: extra `=`, expected nothing; allowed: lines of key = value, in TOML
          |
        1 | clock_hz = = 3
          |            ^
        error: s.toml:1: clock_hz: unexpected key or value, expected newline, `#`; allowed: lines of key = value, in TOML
          |
        1 | clock_hz = = 3
          |              ^
        error: s.toml:2: learn: string values must be quoted, expected literal string; allowed: lines of key = value, in TOML
          |
        2 | learn = yes
          |         ^^^
    "#]],
    );
    // What its settings may not be.
    told(
        "s.toml",
        "circuit = \"lead_angle\"\nclock_hz = 0 # none\n[[step]]\ntarget = 1\nspeed_counts_per_s = 5\nlead_ms = 1\n",
        expect![[r#"
            error: s.toml:2: clock_hz: is 0; allowed: 1 to 10000000000
              |
            2 | clock_hz = 0 # none
              |            ^
        "#]],
    );
}

#[test]
fn all_faults_of_a_log_are_told() {
    told(
        "l.csv",
        "time,counts\n0,0\n1,x\n 1 , 2\n0.5,3\n3,4.5\n4\n5,6\n",
        expect![[r#"
            error: l.csv:3: counts: is 'x'; allowed: a whole number, -2147483648 to 2147483648
              |
            3 | 1,x
              |   ^
            error: l.csv:5: time: 0.5 falls below line 4; allowed: times that do not fall
              |
            5 | 0.5,3
              | ^^^
            error: l.csv:6: counts: is '4.5'; allowed: a whole number, -2147483648 to 2147483648
              |
            6 | 3,4.5
              |   ^^^
            error: l.csv:7: counts: the line has only 1 of its fields; allowed: a number
              |
            7 | 4
              | ^
        "#]],
    );
}

#[test]
fn there_is_an_end_to_what_is_told() {
    let bench = Bench::with("p.ngc", "G41\n".repeat(50));
    bench.refuse_with(&["run", "p.ngc"], |stderr| {
        assert_eq!(stderr.matches("error: ").count(), 20, "{stderr}");
        assert!(stderr.ends_with("\nonly the first 20 errors are shown; there may be more\n"));
    });
}
