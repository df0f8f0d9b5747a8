//! Part programs whose subroutines are in files of their own.

use super::support::{Bench, SHORT};

const PROGRAM: &str = "G1 X1 F1200\no<far> call [5]\nM98 P2\n";

fn bench() -> Bench {
    let bench = Bench::with("p.ngc", PROGRAM);
    bench.write("subs/far.ngc", "o<far> sub\nG1 X#1\no<far> endsub\n");
    bench.write("more/O0002.nc", "O2\nG1 Y3\nM99\n");
    bench.write("other/far.ngc", "o<far> sub\nG1 X9\no<far> endsub\n");
    let keys = "circuit = \"pulse_interpolator\"\ninput = \"p.ngc\"\n";
    let paths = "[program]\nsubroutine_path = [\"subs\", \"more\"]\n";
    bench.write("s.toml", format!("{keys}{paths}"));
    bench.write(
        "in/s.toml",
        format!("{keys}{paths}").replace("p.ngc", "../p.ngc"),
    );
    bench.write("in/subs/far.ngc", "o<far> sub\nG1 X2\no<far> endsub\n");
    bench.write("in/more/2.ngc", "O2\nG1 Y-1\nM99\n");
    bench
}

#[test]
fn directories_of_subroutines_come_from_the_command_line_and_the_scenario() {
    let bench = bench();
    let ends = |arguments: &[&str]| {
        let run = bench.json(&[&["run"], arguments, &["--no-vcd"]].concat());
        ["x", "y"].map(|axis| run["axes"][axis]["end_position"].as_i64().unwrap())
    };
    let both = ["--subroutines", "subs", "--subroutines", "more"];
    assert_eq!(ends(&[&["p.ngc"], &both[..]].concat()), [400, 240]);
    assert_eq!(ends(&["s.toml"]), [400, 240]);
    // Relative to the scenario, but for an override; the command line goes first.
    assert_eq!(ends(&["in/s.toml"]), [160, -80]);
    let set = ["--set", "program.subroutine_path=[\"subs\",\"more\"]"];
    assert_eq!(ends(&[&["in/s.toml"], &set[..]].concat()), [400, 240]);
    assert_eq!(ends(&["s.toml", "--subroutines", "other"]), [720, 240]);
}

#[test]
fn what_is_wrong_with_subroutines_is_refused() {
    let bench = bench();
    let none = "which is not in this file; allowed: subroutines of the file itself, and of files in \
                the directories of --subroutines";
    let run = |flags: &[&'static str]| [&["run", "p.ngc", "--no-vcd"], flags, &SHORT].concat();
    bench.refuse(
        &run(&[]),
        &format!("p.ngc:2: O<far> CALL: calls a subroutine, {none}"),
    );
    bench.refuse(
        &run(&["--subroutines", "subs"]),
        &format!("p.ngc:3: M98: calls program O2, {none}"),
    );
    bench.refuse(
        &run(&["--subroutines", "nowhere"]),
        "--subroutines: DIR: nowhere is not a directory; allowed: directories with subroutines",
    );
    bench.refuse(
        &run(&["--set", "program={subroutine_path=[\"p.ngc\"]}"]),
        "--set: program.subroutine_path: p.ngc is not a directory; allowed: directories with \
         subroutines",
    );
    bench.write("subs/far.ngc", "o<far> sub\n\nG1 Q#1\no<far> endsub\n");
    let fault = "far.ngc:3: Q: without a word that it belongs to; allowed: Q with G5, G64, G73, G83 \
                 and M words";
    let directory = std::path::Path::new("subs").join("");
    bench.refuse(
        &run(&["--subroutines", "subs", "--subroutines", "more"]),
        &format!("{}{fault}", directory.display()),
    );
    bench.write("l.hpgl", "PD400,0;");
    bench.refuse(
        &["run", "l.hpgl", "--subroutines", "subs"],
        "--subroutines: is for a G-code program; the input is an HPGL drawing; allowed: a G-code \
         program, or a run without --subroutines",
    );
}
