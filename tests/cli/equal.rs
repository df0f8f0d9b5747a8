//! `equal` without Yosys: its scripts, and what it refuses. `cosim` runs the proofs.

use super::support::Bench;

const DESIGN: &str = "module enable_counter(input clk); endmodule\n";

#[test]
fn without_yosys_the_scripts_are_written_and_nothing_is_proved() {
    let bench = Bench::with("my own.v", DESIGN);
    let done = bench.run(&[
        "equal",
        "enable_counter",
        "my own.v",
        "--param",
        "WIDTH=24",
        "--param",
        "LEAST=4'd3",
        "--yosys",
        "no/yosys",
        "--out",
        "e",
    ]);
    assert_eq!(done.code, 2);
    let told = "error: --yosys: no/yosys: No such file or directory (os error 2); nothing is proved, \
                only scripts are written; allowed: Yosys 0.23 or later, in PATH or by its path\n";
    assert_eq!(done.stderr, told);
    let files = [
        "e/enable_counter.design.ys",
        "e/enable_counter.f",
        "e/enable_counter.golden.ys",
        "e/enable_counter.v",
    ];
    for file in files {
        assert!(
            done.stdout.contains(&format!("{file} (")),
            "{}",
            done.stdout
        );
    }
    let golden =
        "read_verilog enable_counter.v\nhierarchy -check -top enable_counter\nproc\nflatten\n";
    assert!(bench.read(files[2]).starts_with(golden));
    let design = bench.read(files[0]);
    let path = bench.path("my own.v").canonicalize().unwrap();
    let read = format!(
        "read_verilog -noassert -noassume -norestrict \"{}\"\n",
        path.display()
    );
    assert!(design.starts_with(&read), "{design}");
    let top = "hierarchy -check -top enable_counter -chparam WIDTH 24 -chparam LEAST 4'd3\n";
    assert!(design.contains(top), "{design}");
}

#[test]
fn wrong_arguments_are_refused() {
    let bench = Bench::with("mine.v", DESIGN);
    bench.write("mine.txt", DESIGN);
    bench.write("map.toml", "[signal]\n");
    let refuse = |more: &[&str], text: &str| {
        bench.refuse(&[&["equal", "enable_counter"], more].concat(), text);
    };
    refuse(
        &["none.v"],
        "DESIGN: none.v: No such file or directory (os error 2); allowed: a file that can be read",
    );
    refuse(
        &["mine.txt"],
        "DESIGN: mine.txt has another extension; allowed: Verilog (.v), SystemVerilog (.sv) or VHDL \
         (.vhd)",
    );
    refuse(
        &["mine.v", "--param", "W"],
        "--param: \"W\" gives no parameter a value; allowed: NAME=VALUE with a number in Verilog or a \
         key of the circuit, such as WIDTH=16, LIMIT=12'sd622 or WIDTH=value+1",
    );
    refuse(
        &["mine.v", "--param", "W=1; delete"],
        "--param: \"W=1; delete\" gives no parameter a value; allowed: NAME=VALUE with a number in \
         Verilog or a key of the circuit, such as WIDTH=16, LIMIT=12'sd622 or WIDTH=value+1",
    );
    refuse(
        &["mine.v", "--param", "W=wide"],
        "--param: W=wide: enable_counter has no such number; allowed: a number in Verilog, or one of \
         width",
    );
    bench.write("mine.vhd", "entity mine is end;\n");
    refuse(
        &["mine.v", "mine.vhd"],
        "DESIGN: some are VHDL, some are Verilog; allowed: files in one language",
    );
    refuse(
        &["mine.vhd", "--ghdl", "no/ghdl"],
        "--ghdl: no/ghdl: No such file or directory (os error 2); nothing is proved; allowed: GHDL \
         2.0 or later, in PATH or by its path",
    );
    let name = "allowed: letters, digits, _ and $, with a letter or _ first";
    refuse(
        &["mine.v", "--top", "a b"],
        &format!("--top: \"a b\" is no name in Verilog; {name}"),
    );
    refuse(
        &["mine.v", "--reset", "!"],
        &format!("--reset: \"\" is no name in Verilog; {name}"),
    );
    refuse(
        &["mine.v", "--after-reset", "--reset", "none"],
        "--after-reset: there is no reset; allowed: a design with a reset, or a comparison from \
         power-on",
    );
    bench.refuse_with(
        &["equal", "enable_counter", "mine.v", "--map", "map.toml"],
        |told| {
            assert!(
                told.starts_with("error: map.toml:1: [signal]: unknown field"),
                "{told}"
            )
        },
    );
}
