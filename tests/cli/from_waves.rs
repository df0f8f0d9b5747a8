//! `--from-waves`: inputs that a design had in a simulation.

use super::support::Bench;

/// Waves of a design with a reset that is active low, and a word that is part of a bus. A tick ends
/// at 10, 20, 30 …
const DESIGN: &str = "\
$timescale 1 ns $end
$scope module tb $end
$scope module dut $end
$var wire 1 c clk $end
$var wire 1 r rst_n $end
$var wire 8 b bus [7:0] $end
$var wire 1 e lap $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
0c
0r
bx b
xe
#10
1c
b00110000 b
#15
0c
#20
1c
1r
#25
0c
#30
1c
#35
0c
#40
1c
b00101111 b
0r
#45
0c
#50
1c
1r
#55
0c
#60
1c
#65
0c
";

const MAP: &str = "[signals]\n\"enable_counter.period\" = \"dut.bus[7:4]\"\n";

fn command<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let command = ["verilog", "enable_counter", "--width", "4"];
    let design = ["--from-waves", "design.vcd", "--map", "names.toml"];
    [&command[..], &design, &["--out", "v"], more].concat()
}

fn bench() -> Bench {
    let bench = Bench::with("design.vcd", DESIGN);
    bench.write("names.toml", MAP);
    bench
}

#[test]
fn inputs_of_a_simulation_are_played() {
    let bench = bench();
    let asked = ["--reset", "!dut.rst_n", "--skip", "1"];
    let said = bench.succeed(&command(&asked));
    let begin = "6 ticks of design.vcd, 2 of them with rst; ";
    assert!(said.starts_with(begin), "{said}");
    let source = "\ninputs by the clock tb.dut.clk, reset by !tb.dut.rst_n\n\
                  to compare your waves with the golden ones: motion-rtl compare \
                  v/enable_counter.vcd design.vcd --map names.toml --skip 1\n";
    assert!(said.contains(source), "{said}");
    // Period 3, which a reset interrupts after two ticks; then period 2.
    let stimulus = bench.read("v/enable_counter.stimulus");
    assert_eq!(stimulus, "13\n03\n03\n12\n02\n02\n");
    let short = bench.succeed(&command(&[&asked[..], &["--ticks", "3"]].concat()));
    assert!(short.contains(" --skip 1 --ticks 3\n"), "{short}");
    assert_eq!(bench.read("v/enable_counter.stimulus"), "13\n03\n03\n");
    // The delay of a line: the value shows a tick later in the design.
    let delayed = MAP.replace("\"dut.bus[7:4]\"", "{ name = \"dut.bus[7:4]\", delay = 1 }");
    bench.write("names.toml", delayed);
    bench.succeed(&command(&["--reset", "none"]));
    assert_eq!(
        bench.read("v/enable_counter.stimulus"),
        "03\n03\n03\n02\n02\n02\n"
    );
}

/// The signals have the circuit's names, and the reset is `rst`.
#[test]
fn names_of_the_circuit_need_no_map() {
    let bench = bench();
    let design = DESIGN.replace("wire 8 b bus [7:0]", "wire 4 b period [3:0]");
    let design = design
        .replace("b00110000", "b0011")
        .replace("b00101111", "b0010");
    bench.write("design.vcd", design.replace("rst_n", "rst"));
    let command = [
        "verilog",
        "enable_counter",
        "--width",
        "4",
        "--from-waves",
        "design.vcd",
    ];
    let taken = [&command[..], &["--skip", "1", "--out", "v"]].concat();
    let said = bench.succeed(&taken);
    let source = "\ninputs from tb.dut, by the clock tb.dut.clk, reset by tb.dut.rst\n";
    assert!(said.contains(source), "{said}");
    let stimulus = bench.read("v/enable_counter.stimulus");
    assert_eq!(stimulus, "03\n13\n13\n02\n12\n12\n");
    bench.succeed(&[&taken[..], &["--reset", "none"]].concat());
    let stimulus = bench.read("v/enable_counter.stimulus");
    assert_eq!(stimulus, "03\n03\n03\n02\n02\n02\n");
    bench.refuse(
        &[&taken[..], &["--clock", "clock"]].concat(),
        "design.vcd: --clock: there is no clock of 1 bit; allowed: a signal of 1 bit: tb.dut.clk, \
         tb.dut.rst, tb.dut.lap",
    );
}

#[test]
fn a_reset_that_is_not_named_is_told() {
    let bench = bench();
    let warning = "warning: design.vcd: tb.dut.rst_n has the name of a reset, but the circuit gets no \
                   reset; allowed: --reset NAME, --reset '!NAME' if it is active low, or --reset none\n";
    let done = bench.run(&command(&["--skip", "1"]));
    assert_eq!((done.code, &*done.stderr), (0, warning));
    assert!(done.stdout.contains(", no reset\n"), "{}", done.stdout);
    for named in ["none", "!dut.rst_n"] {
        let done = bench.run(&command(&["--skip", "1", "--reset", named]));
        assert_eq!((done.code, &*done.stderr), (0, ""));
    }
    // In a scope of no input.
    let outside = DESIGN.replace(
        "$scope module dut $end\n",
        "$var wire 1 r rst_n $end\n$scope module dut $end\n",
    );
    bench.write(
        "design.vcd",
        outside.replacen("$var wire 1 r rst_n $end\n$var wire 8", "$var wire 8", 1),
    );
    let done = bench.run(&command(&["--skip", "1"]));
    assert_eq!((done.code, &*done.stderr), (0, ""));
}

#[test]
fn a_port_that_the_map_ignores_stays_low() {
    let bench = bench();
    bench.write("names.toml", "ignore = [\"enable_counter.period\"]\n[signals]\n\"enable_counter.enable\" = \"dut.lap\"\n");
    let said = bench.succeed(&command(&[]));
    assert!(said.contains("\nports that stay low: period\n"), "{said}");
    assert!(said.contains(", no reset\n"), "{said}");
}

/// Golden waves as those of another simulation give the same files again.
#[test]
fn waves_of_the_circuit_give_its_inputs_again() {
    let bench = Bench::new();
    let inputs = "scan,push,target_x,speed\n1,1,-5,3\n0,0,0,9\n1,0,7,1\n1,1,-1,2\n";
    bench.write("inputs.csv", inputs);
    for printer in ["verilog", "vhdl"] {
        let command = [printer, "linear_interpolator"];
        let stimulus = ["--stimulus", "inputs.csv", "--out", "a"];
        bench.succeed(&[&command[..], &stimulus].concat());
        let waves = ["--from-waves", "a/linear_interpolator.vcd", "--out", "b"];
        let said = bench.succeed(&[&command[..], &waves].concat());
        assert!(
            said.contains(
                "inputs from linear_interpolator, by the clock linear_interpolator.clk, no reset\n"
            ),
            "{said}"
        );
        for end in [".stimulus", ".expected", ".still"] {
            let [first, again] =
                ["a", "b"].map(|folder| bench.read(&format!("{folder}/linear_interpolator{end}")));
            assert_eq!(first, again, "{end}");
        }
        let read = bench
            .path("a/linear_interpolator.vcd")
            .canonicalize()
            .unwrap();
        bench.refuse(
            &[&command[..], &waves[..3], &["a"]].concat(),
            &format!(
                "--out: {} is the input; allowed: another directory",
                read.display()
            ),
        );
    }
}

#[test]
fn waves_that_cannot_be_taken_are_refused() {
    let bench = bench();
    bench.refuse(
        &command(&[]),
        "design.vcd: tb.dut.bus[7:4]: is x or z in tick 0; allowed: 0 or 1: from tick 1 on all \
         inputs are known, which --skip 1 takes",
    );
    bench.refuse(
        &command(&["--skip", "1", "--reset", "dut.reset"]),
        "design.vcd: --reset: no signal of the other file is called dut.reset; allowed: a signal of \
         design.vcd",
    );
    bench.refuse(
        &command(&["--skip", "1", "--reset", "dut.bus"]),
        "design.vcd: --reset: tb.dut.bus has 8 bits; allowed: a signal of 1 bit, or one of its bits",
    );
    bench.refuse(
        &command(&["--skip", "6"]),
        "design.vcd: ticks: 1 of its 7 ticks are taken; allowed: 2 or more",
    );
    bench.write(
        "names.toml",
        "[signals]\n\"enable_counter.enable\" = \"dut.lap\"\n",
    );
    bench.refuse(
        &command(&["--skip", "1"]),
        "design.vcd: names: no signal for enable_counter.period; allowed: a map that pairs each \
         input port, or ignores it: it is low then",
    );
    bench.write("names.toml", MAP.replace("7:4", "7:3"));
    bench.refuse(
        &command(&["--skip", "1"]),
        "design.vcd: enable_counter.period: tb.dut.bus[7:3] has 5 bits; allowed: 4 bits, or a part \
         of the signal in a map",
    );
    bench.write("names.toml", MAP);
    bench.write("design.vcd", DESIGN.replace("b00101111 b", "bz0101111 b"));
    bench.refuse(
        &command(&["--skip", "1"]),
        "design.vcd: tb.dut.bus[7:4]: is x or z in tick 4; allowed: 0 or 1 at all input ports in \
         all ticks",
    );
    let off = "#67\n$dumpoff\nxc\nxr\nbx b\nxe\n$end\n#97\n$dumpon\n0c\n1r\nb00101111 b\nxe\n\
               $end\n#100\n1c\n#105\n0c\n";
    bench.write("design.vcd", DESIGN.to_owned() + off);
    bench.refuse(
        &command(&["--skip", "1"]),
        "design.vcd: ticks: the dump is switched off in ticks 6 to 8; allowed: --skip and --ticks \
         that leave them out",
    );
    assert!(!bench.path("v").exists());
    bench.succeed(&command(&["--skip", "1", "--ticks", "5"]));
}
