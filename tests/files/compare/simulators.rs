//! A counter in Verilog, run by Icarus Verilog and by Verilator.

use super::damage::counter;
use motion_rtl::compare::{Settings, compare};
use std::fs;
use std::path::Path;
use std::process::Command;

const VERILOG: &str = r#"
module enable_counter(input clk, input [7:0] period, output enable);
  reg [7:0] count = 0;
  wire [7:0] next = count + 1;
  assign enable = next >= period;
  always @(posedge clk) count <= enable ? 0 : next;
endmodule

module tb;
  reg clk = 0;
  reg [7:0] period = 3;
  wire enable;
  enable_counter dut(.clk(clk), .period(period), .enable(enable));
  always #5 clk = ~clk;
  initial begin
    $dumpfile("DUMP");
    $dumpvars(0, tb);
    #203 $finish;
  end
endmodule
"#;

fn run(directory: &Path, program: &str, arguments: &[&str]) {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(directory)
        .output();
    let output = output.unwrap_or_else(|error| panic!("{program}: {error}"));
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program}: {text}");
}

#[track_caller]
fn compares(directory: &Path, dump: &str) {
    let golden = directory.join("golden.vcd");
    counter(directory);
    let report = compare(&golden, &directory.join(dump), &Settings::default()).unwrap();
    assert!(report.is_equal(), "{report}");
    assert_eq!((report.ticks, report.signals), (20, 4), "{report}");
    // Golden's own next-state net, period, count and enable; held against the tick before, it differs.
    let late = Settings {
        skip: 1,
        ..Settings::default()
    };
    let report = compare(&golden, &directory.join(dump), &late).unwrap();
    assert_eq!(
        report.first.as_ref().map(|first| first.tick),
        Some(0),
        "{report}"
    );
}

fn bench(dump: &str) -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("tb.v"), VERILOG.replace("DUMP", dump)).unwrap();
    directory
}

#[test]
#[ignore = "needs Icarus Verilog"]
fn icarus_verilog() {
    let directory = bench("tb.vcd");
    run(directory.path(), "iverilog", &["-o", "tb.vvp", "tb.v"]);
    run(directory.path(), "vvp", &["tb.vvp"]);
    compares(directory.path(), "tb.vcd");
}

fn verilator(trace: &str, dump: &str) -> tempfile::TempDir {
    let directory = bench(dump);
    let arguments = [
        "--binary",
        "--timing",
        "-Wno-fatal",
        // It runs for less time than g++ takes to optimise it.
        "-MAKEFLAGS",
        "OPT_FAST=-O0",
        "-MAKEFLAGS",
        "OPT_GLOBAL=-O0",
        "--top",
        "tb",
        trace,
        "tb.v",
    ];
    run(directory.path(), "verilator", &arguments);
    run(directory.path(), "obj_dir/Vtb", &[]);
    directory
}

#[test]
#[ignore = "needs Verilator"]
fn verilator_vcd() {
    let directory = verilator("--trace", "tb.vcd");
    compares(directory.path(), "tb.vcd");
}

#[test]
#[ignore = "needs Verilator"]
fn verilator_fst() {
    let directory = verilator("--trace-fst", "tb.fst");
    compares(directory.path(), "tb.fst");
    // Cut off or with wrong bytes it is an error or a report, never a panic.
    let bytes = fs::read(directory.path().join("tb.fst")).unwrap();
    let [golden, other] = ["golden.vcd", "other.fst"].map(|name| directory.path().join(name));
    for place in 0..bytes.len() {
        fs::write(&other, &bytes[..place]).unwrap();
        assert!(
            compare(&golden, &other, &Settings::default()).is_err(),
            "{place}"
        );
        let mut bytes = bytes.clone();
        bytes[place] ^= 0x55;
        fs::write(&other, &bytes).unwrap();
        let _ = compare(&golden, &other, &Settings::default());
    }
}
