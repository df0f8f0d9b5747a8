//! Text below each `--help`: examples and the shipped scenarios.

use super::shipped::SHIPPED;
use std::fmt::Write as _;
use std::sync::LazyLock;

pub const PROGRAM: &str = "\
Examples:
  motion-rtl                             run the shipped scenario waves/machine.toml
  motion-rtl waves/rosette.hpgl --open   run a drawing, show its waves
  motion-rtl check unit_law              prove a circuit
  motion-rtl list                        circuits and scenarios

A file whose name is a command is run as ./NAME.";

pub const RUN: &str = "\
Examples:
  motion-rtl run waves/turntable.toml
  motion-rtl run waves/turntable.toml --set detector=resolver --json
  motion-rtl run waves/pocket.ngc --set circuit=trajectory_controller --no-vcd
  motion-rtl run waves/circle.toml --format fst --from 100000 --to 200000
  motion-rtl run waves/plotter.toml --no-vcd --series build/plotter.csv
  motion-rtl run - --input-format hpgl --no-vcd <waves/rosette.hpgl";

pub const TABLE: &str = "\
Examples:
  motion-rtl table waves/bracket.toml
  motion-rtl table waves/bracket.toml --out build/bracket.csv --scale 3/2";

pub const CHECK: &str = "\
Examples:
  motion-rtl check unit_law sync_stage
  motion-rtl check unit_law --json
  motion-rtl check sequencer --full                              at the widths that ship
  motion-rtl check pulse_generator --full --set variant=literal  refuted, with waves";

pub const MUTATE: &str = "\
Examples:
  motion-rtl mutate enable_counter";

pub const VERILOG: &str = "\
Examples:
  motion-rtl verilog unit_law --out build/unit_law
  motion-rtl verilog unit_law --testbench 20000 --out build/unit_law
  motion-rtl verilog unit_law --stimulus inputs.csv --out build/own
  motion-rtl verilog unit_law --dpi --module my_channel --reset '!rst_n' --out build/dpi";

pub const VHDL: &str = "\
Examples:
  motion-rtl vhdl unit_law --out build/unit_law
  motion-rtl vhdl unit_law --testbench 20000 --out build/unit_law
  motion-rtl vhdl unit_law --vhpi --library build/c/lib/libmotion_rtl.so --out build/vhpi";

pub const COMPARE: &str = "\
Examples:
  motion-rtl compare golden.vcd tb.vcd
  motion-rtl compare golden.vcd tb.fst --other-clock clk_i --map map.toml";

pub const EQUAL: &str = "\
Examples:
  motion-rtl equal pulse_train my_train.v
  motion-rtl equal unit_law --width 16 my_*.v --top channel --param W=16 --map names.toml";

pub const PLAN: &str = "\
Examples:
  motion-rtl plan unit_law
  motion-rtl plan machine --ticks 100000";

pub const LIST: &str = "\
Examples:
  motion-rtl list
  motion-rtl list compensator
  motion-rtl list --json";

pub const KEYS: &str = "\
Examples:
  motion-rtl keys lead_angle
  motion-rtl keys lead_angle --json-schema >lead_angle.schema.json";

pub const SERVE: &str = "\
Examples:
  motion-rtl serve
  motion-rtl serve --port 8100";

pub const PAGE: &str = "\
Examples:
  motion-rtl page my_motion-rtl.wasm --out build/page";

pub const CLEAN: &str = "\
Examples:
  motion-rtl clean build --dry-run
  motion-rtl clean build --yes";

#[cfg(feature = "schema")]
pub const SCHEMA: &str = "\
Examples:
  motion-rtl schema >summary.schema.json";

#[cfg(feature = "shell")]
pub const COMPLETIONS: &str = "\
Examples:
  motion-rtl completions bash >~/.local/share/bash-completion/completions/motion-rtl";

#[cfg(feature = "shell")]
pub const MAN: &str = "\
Examples:
  motion-rtl man --out build/man";

static LONG_RUN: LazyLock<String> = LazyLock::new(|| {
    let mut text = format!("{RUN}\n\nShipped scenarios, which need no file:\n");
    for shipped in SHIPPED {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {}\n      {}", shipped.file, shipped.about);
    }
    text
});

/// Returns the examples of `run` with the shipped scenarios.
pub fn run() -> &'static str {
    &LONG_RUN
}
