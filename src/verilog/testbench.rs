//! Testbenches in Verilog.

use crate::netlist::{Module, Signal};
use crate::printed::{Modules, SourceFile};
use crate::trace::Clock;
use std::fmt::Write as _;

/// A testbench for the last of `modules`: applies a stimulus file, holds the ports out against the
/// file of expected values, and dumps every signal.
pub(super) fn testbench(modules: &Modules<'_>, module: &Module, clock: Clock) -> SourceFile {
    let name = &module.name;
    let clocked = modules.clocked(module);
    let rst: usize = module.inputs().map(|signal| signal.shape.width).sum();
    let mut ports = Vec::new();
    if clocked {
        ports.push("        .clk (clk)".to_owned());
        ports.push(format!("        .rst (stimulus[{rst}])"));
    }
    for (signal, range) in slices(module.inputs()) {
        ports.push(format!("        .{} (stimulus[{range}])", signal.name));
    }
    for (signal, range) in slices(module.outputs()) {
        ports.push(format!("        .{} (seen[{range}])", signal.name));
    }
    let ports = ports.join(",\n");
    // A circuit without a clock is compared at the testbench's clock.
    let dumped = match clocked {
        true => "",
        false => "        $dumpvars(0, clk);\n",
    };
    let (factor, unit) = clock.timescale();
    let half = delay(clock.period() / 2);
    let Judge {
        about,
        declared,
        opened,
        held,
        verdict,
    } = Judge::new(module);
    let text = format!(
        "\
// Testbench of {name}.
//
// Applies {name}.stimulus, a line a tick, and dumps every signal.
// A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
// is what stands before a rising edge of clk; inputs change with its falling edge.
{about}
`timescale {factor}{unit} / {factor}{unit}

module {name}_tb;

    reg  clk = 1'b0;
    reg  [{rst}:0] stimulus;
    reg  [{rst}:0] line;
    integer file, items, tick;
{declared}
    {name} dut (
{ports}
    );

    initial begin
        file = $fopen(\"{name}.stimulus\", \"r\");
        if (file == 0) begin
            $display(\"FAIL: {name}.stimulus cannot be opened\");
            $fatal;
        end
{opened}        $dumpfile(\"{name}_tb.vcd\");
        $dumpvars(0, dut);
{dumped}        tick = 0;
        items = $fscanf(file, \"%h\", stimulus);
        while (items == 1) begin
            #{half};
{held}            tick = tick + 1;
            items = $fscanf(file, \"%h\", line);
            if (items == 1) begin
                clk = 1'b1;
                #{half} clk = 1'b0;
                stimulus = line;
            end
        end
{verdict}        $finish;
    end

endmodule
"
    );
    SourceFile {
        name: format!("{name}_tb.v"),
        text,
    }
}

/// Signals with their bits in a word that has them side by side, the first lowest.
fn slices<'m>(
    signals: impl Iterator<Item = &'m Signal>,
) -> impl Iterator<Item = (&'m Signal, String)> {
    let mut low = 0;
    signals.map(move |signal| {
        let range = match signal.shape.width {
            1 => low.to_string(),
            width => format!("{}:{low}", low + width - 1),
        };
        low += signal.shape.width;
        (signal, range)
    })
}

/// A number of units as a delay: without a size it has 32 bits.
fn delay(units: u64) -> String {
    match units >> 31 {
        0 => units.to_string(),
        _ => format!("(64'd{units})"),
    }
}

/// The parts of a testbench that hold ports out against expected values; empty for a circuit
/// without ports out.
#[derive(Default)]
struct Judge {
    about: String,
    declared: String,
    opened: String,
    held: String,
    verdict: String,
}

impl Judge {
    fn new(module: &Module) -> Self {
        let name = &module.name;
        let bits: usize = module.outputs().map(|signal| signal.shape.width).sum();
        let Some(last) = bits.checked_sub(1) else {
            return Judge::default();
        };
        let mut named = String::new();
        for (Signal { name, .. }, range) in slices(module.outputs()) {
            // Writing to a string does not fail.
            let _ = write!(
                named,
                "                    if (seen[{range}] !== expected[{range}])
                        $display(\"FAIL: tick %0d: {name} is %h, expected %h\",
                            tick, seen[{range}], expected[{range}]);
"
            );
        }
        Judge {
            about: format!(
                "//
// Holds the ports out against {name}.expected, a line a tick.
// A line is a hexadecimal word: the ports out side by side, the first lowest. The last line printed
// begins with PASS, or lines begin with FAIL and $fatal ends the simulation.
"
            ),
            declared: format!(
                "    wire [{last}:0] seen;
    reg  [{last}:0] expected;
    integer golden, differ;
"
            ),
            opened: format!(
                "        golden = $fopen(\"{name}.expected\", \"r\");
        if (golden == 0) begin
            $display(\"FAIL: {name}.expected cannot be opened\");
            $fatal;
        end
        differ = 0;
"
            ),
            held: format!(
                "            items = $fscanf(golden, \"%h\", expected);
            if (items != 1) begin
                $display(\"FAIL: tick %0d: {name}.expected has no line for it\", tick);
                $fatal;
            end
            if (seen !== expected) begin
                // The waves show what follows from the first difference.
                if (differ == 0) begin
{named}                end
                differ = differ + 1;
            end
"
            ),
            verdict: format!(
                "        items = $fscanf(golden, \"%h\", expected);
        if (items == 1 || tick == 0) begin
            $display(\"FAIL: {name}.expected is not of a run of %0d ticks\", tick);
            $fatal;
        end
        if (differ != 0) begin
            $display(\"FAIL: ports out differ in %0d of %0d ticks\", differ, tick);
            $write(\"motion-rtl compare {name}.vcd \");
            $display(\"{name}_tb.vcd shows every signal that differs\");
            $fatal;
        end
        $display(\"PASS: ports out are as expected in all of %0d ticks\", tick);
"
            ),
        }
    }
}
