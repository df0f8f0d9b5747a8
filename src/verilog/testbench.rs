use super::SourceFile;
use super::design::Modules;
use crate::hdl::Role;
use crate::hdl::netlist::{Module, Signal};
use std::fmt::Write as _;

/// A testbench for the last of `modules`: it applies a stimulus file and dumps every signal.
pub(super) fn testbench(modules: &Modules<'_>, module: &Module) -> SourceFile {
    let name = &module.name;
    let inputs: Vec<&Signal> = module
        .signals
        .iter()
        .filter(|signal| signal.role == Role::Input)
        .collect();
    let rst: usize = inputs.iter().map(|signal| signal.shape.width).sum();
    let mut ports = Vec::new();
    // What has no clock is compared by the testbench's.
    let clock = match modules.clocked(module) {
        true => "",
        false => "        $dumpvars(0, clk);\n",
    };
    if modules.clocked(module) {
        ports.push("        .clk (clk)".to_owned());
        ports.push(format!("        .rst (stimulus[{rst}])"));
    }
    let mut low = 0;
    for input in inputs {
        let range = match input.shape.width {
            1 => low.to_string(),
            width => format!("{}:{low}", low + width - 1),
        };
        ports.push(format!("        .{} (stimulus[{range}])", input.name));
        low += input.shape.width;
    }
    let outputs = module.signals.iter().filter(|signal| signal.is_port());
    for output in outputs.filter(|signal| signal.role != Role::Input) {
        ports.push(format!("        .{} ()", output.name));
    }
    let mut memories = String::new();
    for (path, words) in modules.memories_within(module) {
        let _ = writeln!(
            memories,
            "        for (word = 0; word < {words}; word = word + 1)\n            \
             $dumpvars(0, dut.{path}[word]);"
        );
    }
    let word = if memories.is_empty() { "" } else { ", word" };
    let memories = match memories.is_empty() {
        true => memories,
        // The others dump the words of memories by an option of theirs.
        false => format!("`ifdef __ICARUS__\n{memories}`endif\n"),
    };
    let ports = ports.join(",\n");
    let text = format!(
        "\
// Testbench of {name}.
//
// Applies {name}.stimulus, a line a tick, and dumps every signal.
// A line is a hexadecimal word: the inputs side by side, the first lowest, and rst on top. A tick
// is what stands before a rising edge of clk; inputs change soon after it.

module {name}_tb;

    reg clk = 1'b0;
    reg [{rst}:0] stimulus;
    reg [{rst}:0] line;
    integer file, items{word};

    {name} dut (
{ports}
    );

    initial begin
        file = $fopen(\"{name}.stimulus\", \"r\");
        if (file == 0) begin
            $display(\"{name}.stimulus cannot be opened\");
            $finish;
        end
        items = $fscanf(file, \"%h\", stimulus);
        $dumpfile(\"{name}_tb.vcd\");
        $dumpvars(0, dut);
{clock}{memories}        while (items == 1) begin
            #5 items = $fscanf(file, \"%h\", line);
            if (items == 1) begin
                clk = 1'b1;
                #1 stimulus = line;
                #4 clk = 1'b0;
            end
        end
        $finish;
    end

endmodule
"
    );
    SourceFile {
        name: format!("{name}_tb.v"),
        text,
    }
}
