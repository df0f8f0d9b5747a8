//! Parameters and O-words.

use motion_rtl::input::Options;
use motion_rtl::input::gcode::{read, read_with};

use crate::input::common::{accept, refuse};

/// The X coordinates that a program goes to.
fn ends(text: &str) -> Vec<f64> {
    let drawing = accept(read, text);
    drawing.moves.iter().map(|step| step.to[0]).collect()
}

#[test]
fn parameters_take_effect_after_their_line() {
    assert_eq!(ends("#1=5\n#1=7 G0 X#1\nX#1"), [5.0, 7.0]);
    assert_eq!(
        ends("#<a>=2 #<_b c>=3\nG0 X[#<A>*#<_bC>]\nX-#<a>"),
        [6.0, -2.0]
    );
    assert_eq!(ends("#100=101\n#101=4\nG0 X##100"), [4.0]);
    assert_eq!(ends("G0 X2\nX[#5420+1]\nX[#<_x>*2]"), [2.0, 3.0, 6.0]);
    assert_eq!(ends("#1=1 G#1 X[10 MOD 4] F60"), [2.0]);
}

#[test]
fn branches_and_loops() {
    for (text, expected) in [
        (
            "#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile",
            &[1.0, 2.0, 3.0][..],
        ),
        (
            "#1=0\no1 do\n#1=[#1+1]\nG0 X#1\no1 while [#1 LT 2]\nX9",
            &[1.0, 2.0, 9.0],
        ),
        (
            "G91\no1 repeat [3]\nG0 X1\no1 endrepeat\nX5",
            &[1.0, 2.0, 3.0, 8.0],
        ),
        ("G0 X1\no1 repeat [0]\nX7\no1 endrepeat\nX2", &[1.0, 2.0]),
        ("o1 while [0]\nG0 X7\no1 endwhile\nG0 X2", &[2.0]),
        // Loops inside each other, twice the same REPEAT.
        (
            "G91\no1 repeat [2]\no2 repeat [2]\nG0 X1\no2 endrepeat\nX10\no1 endrepeat",
            &[1.0, 2.0, 12.0, 13.0, 14.0, 24.0],
        ),
        (
            "#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\n\
             o3 if [#1 GT 3]\no1 break\no3 endif\nG0 X#1\no1 endwhile\nX9",
            &[1.0, 3.0, 9.0],
        ),
        (
            "#1=0 G91\no1 repeat [5]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 elseif [#1 EQ 4]\n\
             o1 break\no2 endif\nG0 X1\no1 endrepeat\nX9",
            &[1.0, 2.0, 11.0],
        ),
        (
            "#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 1]\no1 continue\no2 endif\nG0 X#1\no1 while [#1 LT 3]",
            &[2.0, 3.0],
        ),
        // The outer loop is left from within the inner one, and both run again.
        (
            "G91\no9 repeat [2]\no1 repeat [3]\no2 repeat [3]\nG0 X1\no1 break\no2 endrepeat\n\
             o1 endrepeat\no9 endrepeat\nX5",
            &[1.0, 2.0, 7.0],
        ),
    ] {
        assert_eq!(ends(text), expected, "{text}");
    }
    for (value, expected) in [(1, 1.0), (2, 2.0), (3, 3.0), (4, 4.0)] {
        let text = format!(
            "#1={value} G0\no<a> if [#1 EQ 1]\nX1\no<a> elseif [#1 EQ 2]\nX2\n\
             o<a> elseif [#1 EQ 3]\nX3\no<a> else\nX4\no<a> endif"
        );
        assert_eq!(ends(&text), [expected], "{value}");
    }
}

#[test]
fn calls_have_parameters_of_their_own() {
    let sub = "o<Go> sub\n#<far>=[#1+#2]\nG0 X#<far>\n#1=99\no<go> endsub [#<far>*2]\n";
    assert_eq!(
        ends(&format!("{sub}#1=3\no<go> call [1] [#1]\nX#1\nX#<_value>")),
        [4.0, 3.0, 8.0]
    );
    assert!(
        refuse(read, &format!("{sub}o<go> call [1]\nX#<far>")).contains("#<far>: has no value")
    );
    // A number that is computed.
    let two = "o2 sub\nG0 X2\no2 endsub\n#<n>=1\n";
    let computed = format!("{two}o[#<n>+1] call\nX3\n#5=2\no#5 call");
    assert_eq!(ends(&computed), [2.0, 3.0, 2.0]);
    // A sub that stands behind; one that calls itself.
    assert_eq!(ends("o5 call\nM2\no5 sub\nG0 X1\no5 endsub"), [1.0]);
    let down = "o1 sub\nG0 X#1\no2 if [#1 LE 1]\no1 return [7]\no2 endif\no1 call [#1-1]\n\
                o1 endsub\no1 call [3]\nX#<_value>\n";
    assert_eq!(ends(down), [3.0, 2.0, 1.0, 7.0]);
    // A loop that a call returns from is left, and starts anew in the next call.
    let out = "G91\no1 sub\no2 repeat [5]\nG0 X1\no1 return\no2 endrepeat\no1 endsub\n\
               o3 repeat [2]\no1 call\no3 endrepeat\nX10";
    assert_eq!(ends(out), [1.0, 2.0, 12.0]);
    // M70, M72 and M73 keep what is in force.
    let modes = "o1 sub\nM73\nG91 G0 X1\no1 endsub\nG90\no1 call\nG0 X5\nM70\nG91\nM72\nX6";
    assert_eq!(ends(modes), [1.0, 5.0, 6.0]);
}

#[test]
fn programs_by_their_numbers() {
    assert_eq!(
        ends("O1\nG91\nM98 P0100 L2\nG0 X5\nM30\nO100\nG0 X1\nM99"),
        [1.0, 2.0, 7.0]
    );
    assert_eq!(ends("G0 X1\nM99\nX2"), [1.0]);
    // The digits before the last four say how often, unless there is a program of that number.
    let twice = "G91\nM98 P20100\nG0 X5\nM30\nO100\nG0 X1\nM99";
    assert_eq!(ends(twice), [1.0, 2.0, 7.0]);
    assert_eq!(ends(&format!("{twice}\nO20100\nG0 X3\nM99")), [3.0, 8.0]);
    for text in ["M98 P20100 L2", "M98 P20101", "M98 P20100.5"] {
        let refused = refuse(read, &format!("{text}\nM30\nO100\nM99"));
        assert!(
            refused.starts_with("t:1: M98: calls program O2"),
            "{refused}"
        );
    }
}

#[test]
fn what_is_wrong_is_named() {
    for (text, fault) in [
        (
            "o1 call",
            "t:1: O1 CALL: calls a subroutine, which is not in this file; allowed: subroutines of the \
             file itself, and of files in the directories of --subroutines",
        ),
        (
            "G0 X1\no1 if [1]\nX2",
            "t:2: O1 IF: without the rest of its block",
        ),
        (
            "G0 X1\no1 endwhile",
            "t:2: O1 ENDWHILE: without the rest of its block",
        ),
        (
            "G0 X1\no1 break",
            "t:2: O1 BREAK: without the rest of its block",
        ),
        ("G0 X1\no1 return", "t:2: O1 RETURN: outside of a call"),
        ("o1 if\no1 endif", "t:1: O1 IF: without a value"),
        ("o1 if [1] x\no1 endif", "t:1: O1 IF: 'X' behind it"),
        (
            "o#1 if [1]",
            "t:1: O: an O-word without a number or name as written",
        ),
        ("o[1.5] call", "t:1: O: 1.5 is no number of a subroutine"),
        ("o[-1] call", "t:1: O: -1 is no number of a subroutine"),
        (
            "o#1 call",
            "t:1: O0 CALL: calls a subroutine, which is not in this file",
        ),
        (
            "o1 sub\no1 call\no1 endsub\no1 call",
            "t:2: call: calls nest deeper than 10",
        ),
        ("#5221=3", "t:1: #5221: sets an offset"),
        ("#6000=3", "t:1: #6000: no such parameter"),
        ("#1 3", "t:1: #13: without ="),
        ("G0 X[1", "t:1: [: no closing ]"),
        (
            "o1 sub\nG0 X1\no1 endsub",
            "t: file: no move in it; allowed: a G-code program that calls",
        ),
    ] {
        let refused = refuse(read, text);
        assert!(refused.starts_with(fault), "{refused}");
    }
}

#[test]
fn a_run_is_bounded() {
    let most = |most_lines, text: &str| {
        let options = Options {
            most_lines,
            ..Options::default()
        };
        read_with("t", text.as_bytes(), &options).map_err(|fault| fault.problem)
    };
    let forever = "o1 while [1]\no1 endwhile";
    assert_eq!(
        most(1000, forever),
        Err("more than 1000 lines are run".to_owned())
    );
    let three = "G0 X1\nX2\nX3";
    assert!(most(3, three).is_ok() && most(2, three).is_err());
    // Holes count as lines.
    let holes = "G91 G81 X1 Z-1 R0 L100";
    assert!(most(101, holes).is_ok() && most(100, holes).is_err());
    assert!(refuse(read, "G91 G83 X1 Z-1 R0 Q0.001 L100000").contains("more than 1000000 moves"));
    assert!(refuse(read, "G18 G2 I900 P9999 F9").contains("more than 1000000 moves"));
}
