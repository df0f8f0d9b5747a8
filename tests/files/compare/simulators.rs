//! A counter in Verilog, run by Icarus Verilog and by Verilator.

use super::damage::counter;
use motion_rtl::compare::{Map, Settings, compare};
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
    compares_by(directory, dump, "");
}

#[track_caller]
fn compares_by(directory: &Path, dump: &str, map: &str) {
    let golden = directory.join("golden.vcd");
    counter(directory);
    let settings = Settings {
        map: Map::parse("map.toml", map).unwrap(),
        ..Settings::default()
    };
    let report = compare(&golden, &directory.join(dump), &settings).unwrap();
    assert!(report.is_equal(), "{report}");
    assert_eq!((report.ticks, report.signals), (20, 4), "{report}");
    // Golden's own next-state net, period, count and enable; held against the tick before, it differs.
    let late = Settings {
        skip: 1,
        ..settings
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

/// Packed as a whole.
#[test]
#[ignore = "needs Icarus Verilog"]
fn icarus_verilog_fst_space() {
    let directory = bench("tb.fst");
    run(directory.path(), "iverilog", &["-o", "tb.vvp", "tb.v"]);
    run(directory.path(), "vvp", &["tb.vvp", "-fst-space"]);
    let bytes = fs::read(directory.path().join("tb.fst")).unwrap();
    assert_eq!(bytes[0], 254);
    compares(directory.path(), "tb.fst");
}

const VHDL: &str = r#"
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity enable_counter is
  port (clk : in std_logic; period : in unsigned(7 downto 0); enable : out std_logic);
end entity;

architecture rtl of enable_counter is
  signal count : unsigned(7 downto 0) := (others => '0');
  signal count_up : unsigned(7 downto 0) := (others => '0');
begin
  count_up <= count + 1;
  enable <= '1' when count_up >= period else '0';
  process (clk) begin
    if rising_edge(clk) then
      if count_up >= period then
        count <= (others => '0');
      else
        count <= count_up;
      end if;
    end if;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity tb is
end entity;

architecture bench of tb is
  signal clk : std_logic := '0';
  signal period : unsigned(7 downto 0) := x"03";
  signal enable : std_logic;
begin
  dut : entity work.enable_counter port map (clk => clk, period => period, enable => enable);
  process begin
    for tick in 2 to 20 loop
      wait for 5 ns;
      clk <= '1';
      wait for 5 ns;
      clk <= '0';
    end loop;
    wait for 3 ns;
    wait;
  end process;
end architecture;
"#;

/// Its FST is packed as a whole, and each level of the design has a clock of its own in all three.
#[test]
#[ignore = "needs GHDL"]
fn ghdl() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("tb.vhd"), VHDL).unwrap();
    run(path, "ghdl", &["-a", "--std=08", "tb.vhd"]);
    run(path, "ghdl", &["-e", "--std=08", "tb"]);
    let waves = ["--vcd=tb.vcd", "--fst=tb.fst", "--wave=tb.ghw"];
    run(
        path,
        "ghdl",
        &[&["-r", "--std=08", "tb"][..], &waves].concat(),
    );
    assert_eq!(fs::read(path.join("tb.fst")).unwrap()[0], 254);
    let map = "[signals]\n\"enable_counter.next\" = \"count_up\"\n";
    for dump in ["tb.vcd", "tb.fst", "tb.ghw"] {
        compares_by(path, dump, map);
    }
    // Cut off or with wrong bytes it is an error or a report.
    let bytes = fs::read(path.join("tb.ghw")).unwrap();
    let [golden, other] = ["golden.vcd", "other.ghw"].map(|name| path.join(name));
    for place in 0..bytes.len() {
        fs::write(&other, &bytes[..place]).unwrap();
        let _ = compare(&golden, &other, &Settings::default());
    }
}

fn verilator(trace: &str, dump: &str) -> tempfile::TempDir {
    let directory = bench(dump);
    let arguments = [
        "--binary",
        "--timing",
        "-Wno-fatal",
        // The model runs for less time than g++ takes to optimise it.
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
