//! Verdicts on handwritten designs.

use super::*;

/// An enable counter with faults that the command line chooses, driven at random.
const DESIGN: &str = "\
module my_counter (
    input  wire       clk,
    input  wire       rst_n,
    input  wire [7:0] length,
    output wire       tick
);
    reg [7:0] count = 8'd0;
    reg late = 1'b0, deaf = 1'b0;
    wire [7:0] next = count + 8'd1;
    wire over = late ? next == length : next >= length;
    assign tick = over;
    always @(posedge clk) count <= (!rst_n && !deaf) || over ? 8'd0 : next;
    initial begin
        if ($test$plusargs(\"late\") != 0) late = 1'b1;
        if ($test$plusargs(\"deaf\") != 0) deaf = 1'b1;
    end
endmodule
";

/// Bench of two designs; the clock is a port or made by delays.
fn bench(clock: Clock) -> String {
    let (head, clocked) = match clock {
        Clock::Program => ("(input wire clk)", ""),
        Clock::Delays => ("", "    reg clk = 1'b0;\n    always #5 clk = ~clk;\n"),
    };
    format!(
        "\
module bench {head};
{clocked}    reg rst_n = 1'b1;
    reg [7:0] length = 8'd1, other = 8'd1;
    wire [1:0] ticks;
    integer cycle = 0;
    reg reset = 1'b1, moving = 1'b1;
    my_counter first (.clk(clk), .rst_n(rst_n), .length(length), .tick(ticks[0]));
    my_counter second (.clk(clk), .rst_n(rst_n), .length(other), .tick(ticks[1]));
    initial begin
        if ($test$plusargs(\"unreset\") != 0) reset = 1'b0;
        if ($test$plusargs(\"still\") != 0) moving = 1'b0;
    end
    always @(posedge clk) begin
        cycle <= cycle + 1;
        rst_n <= !(reset && (cycle < 3 || $urandom_range(99) == 0));
        if (moving && $urandom_range(9) == 0) length <= 8'($urandom_range(12));
        if (moving && $urandom_range(9) == 0 && $test$plusargs(\"one\") == 0)
            other <= 8'($urandom_range(12));
        if (cycle == 3000) $finish;
    end
    wire unused = &{{1'b0, ticks}};
endmodule
"
    )
}

/// Checker that is bound to the design.
fn binding() -> Binding {
    let port = |path: &str, own: &str| (path.to_owned(), own.to_owned());
    Binding {
        module: "my_counter".to_owned(),
        clock: "clk".to_owned(),
        reset: "~rst_n".to_owned(),
        ports: vec![port("period", "length"), port("enable", "tick")],
        from_power_on: false,
    }
}

/// The lines with verdicts, without the names of the instances.
fn verdicts(text: &str) -> Vec<&str> {
    let lines = text
        .lines()
        .filter_map(|line| line.split_once(": ").map(|(_, rest)| rest));
    let is_verdict = |line: &&str| {
        ["PASS: ", "FAIL: ", "VACUOUS: "]
            .iter()
            .any(|word| line.starts_with(word))
    };
    lines.filter(is_verdict).collect()
}

fn judges(clock: Clock) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut files = write(path, "enable_counter", "width=8", &binding());
    for (name, text) in [("design.v", DESIGN.to_owned()), ("bench.sv", bench(clock))] {
        fs::write(path.join(name), text).unwrap();
        files.push(path.join(name));
    }
    let program = compiled(path, clock, &files).unwrap_or_else(|text| panic!("{text}"));
    let plays = |arguments: &[&str]| ended(started(path, &program).args(arguments));

    let (code, text) = plays(&[]);
    let equal = "PASS: 2999 values equal in 2999 ticks";
    assert_eq!((code, verdicts(&text)), (Some(0), vec![equal; 2]), "{text}");
    assert!(text.contains("moved, how often: period "), "{text}");

    // A fault in both designs: each says it, and the simulation fails at its end.
    let (code, text) = plays(&["+late"]);
    assert_ne!(code, Some(0), "{text}");
    let failed = verdicts(&text);
    assert!(
        failed.len() == 2 && failed.iter().all(|line| line.starts_with("FAIL: ")),
        "{text}"
    );
    assert!(text.contains("  enable: design 0, model 1\n"), "{text}");
    let (code, text) = plays(&["+deaf"]);
    assert_ne!(code, Some(0), "{text}");
    assert!(text.contains("first difference in tick "), "{text}");
    for design in ["first", "second"] {
        for extension in ["vcd", "gtkw"] {
            let name = format!("bench.{design}.mrtl_checker.{extension}");
            let file = path.join(&name);
            assert!(text.contains(&name) || extension == "gtkw", "{text}");
            assert!(fs::metadata(file).unwrap().len() > 500);
        }
    }

    // One of two that cannot be judged is enough.
    let (code, text) = plays(&["+one"]);
    assert_ne!(code, Some(0), "{text}");
    let still = "VACUOUS: no output port moved in 2999 ticks";
    let mut found = verdicts(&text);
    found.sort_unstable();
    assert_eq!(found, [equal, still], "{text}");
    let (code, text) = plays(&["+still"]);
    assert_eq!(
        (code == Some(0), verdicts(&text)),
        (false, vec![still; 2]),
        "{text}"
    );
    let (code, text) = plays(&["+unreset"]);
    let unreset = "VACUOUS: rst was 1 in none of 3001 edges, so nothing was compared; \
                   FROM_POWER_ON (from_power_on in Python) compares from the first edge";
    assert_eq!(
        (code == Some(0), verdicts(&text)),
        (false, vec![unreset; 2]),
        "{text}"
    );

    if clock == Clock::Program {
        let (_, text) = plays(&["+early"]);
        let lines = text.lines();
        let ends =
            lines.filter(|line| line.contains("the comparison has not ended; a bench in C++"));
        assert_eq!((ends.count(), verdicts(&text).len()), (2, 0), "{text}");
    }
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn designs_are_judged_with_delays() {
    judges(Clock::Delays);
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn designs_are_judged_without_delays() {
    judges(Clock::Program);
}

/// Every circuit of these against its own Verilog, from power-on, with random inputs: ports of all
/// kinds, more words than a call passes, and no registers.
#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn exported_circuits_pass() {
    for circuit in ["linear_interpolator", "path_point", "placement"] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        let model = motion_rtl::registry::find(circuit).unwrap().full();
        let verilog = model.verilog().unwrap();
        let clocked = verilog.top().text.contains("input  wire") && circuit != "placement";
        let mut files = write(
            path,
            circuit,
            "",
            &Binding {
                module: circuit.to_owned(),
                clock: if clocked { "clk" } else { "bench.clk" }.to_owned(),
                reset: "rst".to_owned(),
                ports: Vec::new(),
                from_power_on: true,
            },
        );
        for source in verilog.sources() {
            let file = path.join(&source.name);
            fs::write(&file, &source.text).unwrap();
            if source.name.ends_with(".v") {
                files.push(file);
            }
        }
        let file = path.join("bench.sv");
        fs::write(&file, random_bench(circuit, &verilog, clocked)).unwrap();
        files.push(file);
        let program = compiled(path, Clock::Delays, &files).unwrap_or_else(|text| panic!("{text}"));
        let text = run(&mut started(path, &program));
        assert_eq!(verdicts(&text).len(), 1, "{text}");
        assert!(verdicts(&text)[0].starts_with("PASS: "), "{text}");
    }
}

/// Bench that sets every input port of a circuit at random.
fn random_bench(circuit: &str, verilog: &motion_rtl::verilog::Verilog, clocked: bool) -> String {
    let top = verilog.design().modules.last().unwrap();
    let (mut declared, mut ports, mut set) = (String::new(), Vec::new(), String::new());
    for port in top.inputs() {
        let (name, width) = (&port.name, port.shape.width);
        declared += &format!("    reg [{}:0] {name} = 0;\n", width - 1);
        ports.push(format!(".{name}({name})"));
        let word = match width {
            33.. => format!("{width}'({{$urandom, $urandom}})"),
            _ => format!("{width}'($urandom)"),
        };
        set += &format!("        if ($urandom_range(3) == 0) {name} <= {word};\n");
    }
    if clocked {
        ports.extend([".clk(clk)".to_owned(), ".rst(rst)".to_owned()]);
    }
    let ports = ports.join(", ");
    format!(
        "\
`timescale 1ns / 1ps
/* verilator lint_off WIDTH */
/* verilator lint_off PINMISSING */
/* verilator lint_off UNUSED */
module bench;
    reg clk = 1'b0, rst = 1'b0;
    integer cycle = 0;
{declared}    {circuit} dut ({ports});
    always #5 clk = ~clk;
    always @(posedge clk) begin
        cycle <= cycle + 1;
        rst <= $urandom_range(99) == 0;
{set}        if (cycle == 2000) $finish;
    end
endmodule
"
    )
}
