//! `equal`: designs of these tests proved equal to circuits, and planted faults found.

mod parts;
mod vhdl;

use super::golden_model;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const NOTE: &str = "rtl_notes/equal.md";

/// Time for random inputs, of which the limit gives a quarter, on a busy machine.
const BUSY: &str = "--limit-seconds 240";

/// A design of these tests.
fn design(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cosim/equal");
    fs::read_to_string(path.join(name)).unwrap()
}

/// A directory with a design and the files of its check.
struct Bench(TempDir);

impl Bench {
    fn with(files: &[(&str, &str)]) -> Self {
        let bench = Bench(tempfile::tempdir().unwrap());
        for (name, text) in files {
            fs::write(bench.0.path().join(name), text).unwrap();
        }
        bench
    }

    /// Runs the program with these words; returns the exit code and all that it prints.
    fn run(&self, words: &str) -> (i32, String) {
        let output = Command::new(env!("CARGO_BIN_EXE_motion-rtl"))
            .args(words.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .unwrap();
        let text = [output.stdout, output.stderr].concat();
        (
            output.status.code().unwrap(),
            String::from_utf8(text).unwrap(),
        )
    }

    /// Time enough for a busy machine.
    #[track_caller]
    fn proves(&self, words: &str) -> String {
        let limit = match words.contains("--limit-seconds") {
            true => "",
            false => " --limit-seconds 900",
        };
        let (code, said) = self.run(&format!("{words}{limit}"));
        assert!(
            code == 0 && said.starts_with("proved equal "),
            "{code}: {said}"
        );
        said
    }

    /// The design differs: returns the first line, and checks that `compare` says so of the waves.
    #[track_caller]
    fn differs(&self, circuit: &str, words: &str) -> String {
        let (code, said) = self.run(words);
        assert!(
            code == 1 && said.starts_with("differs in tick "),
            "{code}: {said}"
        );
        let compare = format!(
            "compare waves/equal/{circuit}.golden.vcd waves/equal/{circuit}.design.vcd --map \
             waves/equal/{circuit}.names.toml --scope miter --other-clock miter.clk --any-length \
             --allow-missing"
        );
        let (code, compared) = self.run(&compare);
        assert_eq!(code, 1, "{compared}");
        said.lines().next().unwrap().to_owned()
    }
}

/// A text with one place replaced.
#[track_caller]
fn replaced(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replace(from, to)
}

#[test]
#[ignore = "needs Yosys"]
fn a_design_with_other_names_is_proved_equal_and_its_faults_differ() {
    let (text, map) = (design("step_train.v"), design("step_train.toml"));
    let words = "equal pulse_train step_train.v --top step_train --map step_train.toml --clock ck \
                 --reset !rst_n";
    let bench = Bench::with(&[("step_train.v", &text), ("step_train.toml", &map)]);
    let said = bench.proves(words);
    let verdict = "proved equal at full width: pulse_train and step_train, from power-on, for all \
                   inputs\ncompared: 3 ports out and 3 other signals\n";
    assert!(said.starts_with(verdict), "{said}");
    for (from, to) in [
        ("up >= half_q", "up > half_q"),
        ("(to_go == 1 && falls)", "(to_go == 2 && falls)"),
        ("idle_n = 1'b1;", "idle_n = 1'b0;"),
        ("            to_go <= 0;\n", ""),
        ("to_go - 1'b1", "to_go + 1'b1"),
        ("dir <= back", "dir <= !back"),
    ] {
        let faulty = replaced(&text, from, to);
        let bench = Bench::with(&[("step_train.v", &faulty), ("step_train.toml", &map)]);
        bench.differs("pulse_train", words);
    }
}

#[test]
#[ignore = "needs Yosys"]
fn system_verilog_is_proved_equal_and_its_faults_differ() {
    let text = design("phase_counter.sv");
    let words = "equal phase_counter phase_counter.sv";
    Bench::with(&[("phase_counter.sv", &text)]).proves(words);
    for (from, to) in [
        ("phase >= 2 ?", "phase > 2 ?"),
        ("= 3'b111", "= 3'b000"),
        ("            sync_secondary <= '1;\n", ""),
        ("phase + period - 18'd2", "phase - period - 18'd2"),
    ] {
        let bench = Bench::with(&[("phase_counter.sv", &replaced(&text, from, to))]);
        let (code, said) = bench.run(words);
        // Half of the period is subtracted twice: the sum is the same modulo 2^18 only sometimes.
        assert!(
            code != 0 && !said.contains("proved equal"),
            "{from}: {said}"
        );
    }
}

#[test]
#[ignore = "needs Yosys"]
fn the_difference_is_named_with_its_tick_and_both_values() {
    let text = "module enable_counter(input clk, rst, input [23:0] period, output enable);
        reg [23:0] count = 0;
        assign enable = count >= period;
        always @(posedge clk) count <= rst || enable ? 0 : count + 1;
        endmodule\n";
    let bench = Bench::with(&[("mine.v", text)]);
    let first = bench.differs("enable_counter", "equal enable_counter mine.v");
    let expected = "differs in tick 0: enable_counter.enable is 1, but enable of the design is 0";
    assert_eq!(first, expected);
}

#[test]
#[ignore = "needs Yosys"]
fn registers_without_power_on_value_are_compared_after_a_reset() {
    let text = "module differentiator(input clk, rst, load, valid, input signed [31:0] from, position,
        output signed [31:0] increment);
        reg signed [31:0] lagged;
        assign increment = position - lagged;
        always @(posedge clk) if (rst) lagged <= 0; else if (load | valid) lagged <= load ? from : position;
        endmodule\n";
    let bench = Bench::with(&[("mine.v", text)]);
    let (code, said) = bench.run("equal differentiator mine.v");
    assert_eq!(code, 1, "{said}");
    assert!(
        said.contains("without power-on value: lagged; --after-reset"),
        "{said}"
    );
    let said = bench.proves("equal differentiator mine.v --after-reset");
    assert!(said.contains("after a tick of reset"), "{said}");
    // With another sign it differs there too.
    let wrong = replaced(text, "position - lagged", "lagged - position");
    let bench = Bench::with(&[("mine.v", &wrong)]);
    let first = bench.differs(
        "differentiator",
        "equal differentiator mine.v --after-reset",
    );
    // Both values are signed, and the one is the negative of the other.
    let numbers = first
        .split([' ', ','])
        .filter_map(|word| word.parse::<i64>().ok());
    let numbers: Vec<i64> = numbers.collect();
    let [own, other] = numbers[..] else {
        panic!("{first}");
    };
    assert!(own == -other && own != 0, "{first}");
}

#[test]
#[ignore = "needs Yosys"]
fn a_port_of_another_width_is_named_with_both_widths() {
    let text = "module enable_counter(input clk, rst, input [15:0] Period, output enable);
        assign enable = Period == 0;
        endmodule\n";
    let bench = Bench::with(&[("mine.v", text)]);
    let (code, said) = bench.run("equal enable_counter mine.v");
    let told = "error: ports of enable_counter without partner in enable_counter: period; period has \
                24 bits, but Period of the design has 16 bits: --width and --set change those of the \
                circuit, --param those of the design; copy waves/equal/enable_counter.template.toml, \
                fill in the names, and pass it with --map\n";
    assert!(code == 2 && said.ends_with(told), "{code}: {said}");
}

#[test]
#[ignore = "needs Yosys"]
fn stages_and_registers_without_partner_are_told_during_the_run() {
    // The register has another name, and the proof needs its partner.
    let text = "module enable_counter(input clk, rst, input [23:0] period, output enable);
        reg [23:0] ticks = 0;
        wire [23:0] next = ticks + 1;
        assign enable = next >= period;
        always @(posedge clk) ticks <= rst || enable ? 0 : next;
        endmodule\n";
    let bench = Bench::with(&[("mine.v", text)]);
    let (code, said) = bench.run("equal enable_counter mine.v --limit-seconds 20 -v");
    assert_eq!(code, 2, "{said}");
    let mut rest = &*said;
    for told in [
        " s: Yosys reads the circuit and the design\n",
        " s: random inputs\n",
        " s: proof of the whole\n",
        "warning: no proof so far; registers of enable_counter without partner: \
         count\n",
        " s: no proof so far; random inputs without resets\n",
        " s: no difference so far; the solver searches for one\n",
        "error: not proved ",
    ] {
        let at = rest.find(told);
        rest = &rest[at.unwrap_or_else(|| panic!("{told}: {said}"))..];
    }
}

#[test]
#[ignore = "needs Yosys"]
fn ports_without_partner_are_listed_and_a_template_maps_them() {
    let text = "module mine(input clk, rst, p, u, output s);
        reg q = 0; assign s = q;
        always @(posedge clk) q <= p & ~u & ~rst;
        endmodule\n";
    let bench = Bench::with(&[("mine.v", text)]);
    let (code, said) = bench.run("equal sync_stage mine.v --top mine");
    assert_eq!(code, 2, "{said}");
    let wanted = "ports of sync_stage without partner in mine: pulse, unit_rst, step; copy \
                  waves/equal/sync_stage.template.toml";
    assert!(said.contains(wanted), "{said}");
    let template = fs::read_to_string(bench.0.path().join("waves/equal/sync_stage.template.toml"));
    let template = template.unwrap();
    assert!(template.contains("#   p # 1 bit\n"), "{template}");
    let filled = template
        .replace(
            "#\"sync_stage.pulse\" = \"\"",
            "\"sync_stage.pulse\" = \"p\"",
        )
        .replace(
            "#\"sync_stage.unit_rst\" = \"\"",
            "\"sync_stage.unit_rst\" = \"u\"",
        )
        .replace("#\"sync_stage.step\" = \"\"", "\"sync_stage.step\" = \"q\"");
    fs::write(bench.0.path().join("names.toml"), filled).unwrap();
    bench.proves("equal sync_stage mine.v --top mine --map names.toml");
}

#[test]
#[ignore = "needs Yosys"]
fn late_faults_are_found_by_random_inputs() {
    for (circuit, from, to) in [
        ("scaler", "bit_index == 6'd23", "bit_index == 6'd22"),
        ("mul_div", "state[1] ? 6'd57", "state[1] ? 6'd56"),
    ] {
        let bench = Bench::with(&[]);
        let (code, said) = bench.run(&format!("verilog {circuit} --out own"));
        assert_eq!(code, 0, "{said}");
        let text = fs::read_to_string(bench.0.path().join(format!("own/{circuit}.v"))).unwrap();
        fs::write(bench.0.path().join("mine.v"), replaced(&text, from, to)).unwrap();
        let first = bench.differs(circuit, &format!("equal {circuit} mine.v {BUSY}"));
        let tick = first.split([' ', ':']).nth(3).unwrap();
        // The solver gets no further than some 30 ticks in the time.
        assert!(tick.parse::<u32>().unwrap() > 20, "{first}");
    }
}

#[test]
#[ignore = "needs Yosys"]
fn what_is_too_wide_to_prove_is_proved_narrower() {
    let text = design("serial_scaler.v");
    let words = "equal scaler serial_scaler.v --top serial_scaler --limit-seconds 10";
    let narrow = format!("{words} --param GAIN=gain --param VALUE=value");
    let bench = Bench::with(&[("serial_scaler.v", &text)]);
    // No parameter follows a key.
    let (code, said) = bench.run(words);
    assert!(
        code == 2 && said.contains("takes longer than 10 s"),
        "{code}: {said}"
    );
    let said = bench.proves(&narrow);
    assert!(
        said.starts_with("proved equal at width ") && said.contains("widths: --set gain="),
        "{said}"
    );
    // Three times a sum needs three bits more: a narrow word shows it.
    let faulty = replaced(&text, "[VALUE+2:0] triple", "[VALUE:0] triple");
    let bench = Bench::with(&[("serial_scaler.v", &faulty)]);
    bench.differs("scaler", &narrow);
}

#[test]
#[ignore = "needs Yosys"]
fn the_task_of_symbiyosys_proves_the_miter() {
    let text = design("step_train.v");
    let map = design("step_train.toml");
    let bench = Bench::with(&[("step_train.v", &text), ("step_train.toml", &map)]);
    bench.proves(
        "equal pulse_train step_train.v --top step_train --map step_train.toml --clock ck --reset !rst_n",
    );
    let out = bench.0.path().join("waves/equal");
    let task = fs::read_to_string(out.join("pulse_train.sby")).unwrap();
    let (head, rest) = task.split_once("[script]\n").unwrap();
    assert_eq!(
        head,
        "[options]\nmode prove\ndepth 5\n\n[engines]\nsmtbmc\n\n"
    );
    let (script, files) = rest.split_once("\n[files]\n").unwrap();
    // SymbiYosys runs the script in a directory with copies of these files.
    let copies = tempfile::tempdir().unwrap();
    for file in files.lines() {
        fs::copy(out.join(file), copies.path().join(file)).unwrap();
    }
    let script = format!("{script}\nsat -verify -tempinduct -prove-asserts -maxsteps 4 miter\n");
    fs::write(copies.path().join("task.ys"), script).unwrap();
    let run = Command::new("yosys")
        .args(["-Q", "-T", "task.ys"])
        .current_dir(copies.path())
        .output()
        .unwrap();
    let log = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(
        run.status.success() && log.contains("Induction step proven: SUCCESS!"),
        "{log}"
    );
}

/// The printed Verilog of a circuit, as the design's files.
fn printed(bench: &Bench, words: &str) -> String {
    let (code, said) = bench.run(&format!("verilog {words} --out own"));
    assert_eq!(code, 0, "{said}");
    let name = words.split(' ').next().unwrap();
    let list = fs::read_to_string(bench.0.path().join(format!("own/{name}.f"))).unwrap();
    let files = list.lines().filter(|line| line.ends_with(".v"));
    let files: Vec<String> = files.map(|file| format!("own/{file}")).collect();
    files.join(" ")
}

#[test]
#[ignore = "needs Yosys"]
fn memories_and_parts_pair_by_name() {
    let bench = Bench::with(&[]);
    for words in [
        "record_memory --set data=4 --set record=1",
        "unit_law --width 16",
    ] {
        let files = printed(&bench, words);
        let said = bench.proves(&format!("equal {words} {files}"));
        assert!(!said.contains("without partner"), "{said}");
    }
}

#[test]
#[ignore = "needs Yosys"]
fn a_verdict_names_what_it_leaves_out() {
    let bench = Bench::with(&[("m.toml", "leave = [\"spent\"]\n")]);
    let files = printed(&bench, "pulse_train");
    let words = format!("equal pulse_train {files} --map m.toml");
    let said = bench.proves(&words);
    let left = "\nports of pulse_train that the map leaves out: spent\n";
    assert!(said.contains(left), "{said}");
    assert!(said.contains("from power-on, for all inputs"), "{said}");
}

#[test]
#[ignore = "needs Yosys"]
fn designs_that_prove_nothing_are_refused() {
    let stage = |body: &str| {
        format!(
            "module sync_stage(input clk, rst, pulse, unit_rst, output reg step = 0);\n{body}\nendmodule\n"
        )
    };
    for (body, told) in [
        (
            "always @(negedge clk) step <= pulse;",
            "DESIGN: step takes the falling edge of clk",
        ),
        (
            "always @(posedge pulse) step <= 1;",
            "DESIGN: step takes the rising edge of pulse",
        ),
        ("always @* if (pulse) step = 1;", "DESIGN: step is a latch"),
        ("other o (clk);", "DESIGN: Module `\\other' referenced"),
        (
            "wire a; assign a = ~(a & pulse); always @(posedge clk) step <= a;",
            "DESIGN: found logic loop",
        ),
        ("always @(posedge clk) step <= ;", "DESIGN: "),
    ] {
        let bench = Bench::with(&[("mine.v", &stage(body))]);
        let (code, said) = bench.run("equal sync_stage mine.v");
        assert!(code == 2 && said.contains(told), "{code}: {said}");
        assert!(
            !bench.0.path().join("waves").exists(),
            "{told}: files are left"
        );
    }
    let whole = stage("always @(posedge clk) step <= pulse;");
    let bench = Bench::with(&[("mine.v", &whole)]);
    for reset in ["clk", "step", "nothing"] {
        let (code, said) = bench.run(&format!("equal sync_stage mine.v --reset {reset}"));
        let told = format!(
            "--reset: the design has no input {reset} of one bit beside its clock; allowed: none, or \
             one of pulse, rst, unit_rst"
        );
        assert!(code == 2 && said.contains(&told), "{code}: {said}");
    }
    // An assumption of the design would hide the fault.
    let lie = stage("always @(posedge clk) step <= pulse; always @* assume (!unit_rst);");
    let bench = Bench::with(&[("mine.sv", &lie)]);
    bench.differs("sync_stage", "equal sync_stage mine.sv");
}

#[test]
#[ignore = "needs Yosys"]
fn the_note_shows_what_its_commands_print() {
    golden_model::hold_note(NOTE);
}

#[test]
#[ignore = "needs Yosys"]
fn encodings_that_do_not_occur_are_proved_along() {
    // From state 3, which does not occur, the two would go on in different ways.
    let text = "module refinement(input clk, rst, start, input [23:0] multiplicand,
        input [10:0] multiplier, input [23:0] divisor, input negative, divider_done,
        input [10:0] quotient, output reg done = 0, output divide, output [23:0] first_factor,
        output [11:0] second_factor, output [23:0] divide_by, addend);
        localparam IDLE = 2'd0, FIRST = 2'd1, SECOND = 2'd2;
        reg [1:0] state = IDLE;
        reg [23:0] error_amount = 0, overrun_amount = 0;
        wire take = state == IDLE && start;
        wire refine = state == FIRST && divider_done && error_amount < overrun_amount;
        wire over = state != IDLE && divider_done && !refine;
        wire [11:0] sum = negative ? multiplier - quotient : multiplier + quotient;
        assign divide = take || refine;
        assign first_factor = refine ? error_amount : multiplicand;
        assign second_factor = refine ? sum : multiplier;
        assign divide_by = refine ? overrun_amount : divisor;
        assign addend = divide_by / 2;
        always @(posedge clk) begin
            done <= !rst && over;
            if (take) begin
                error_amount <= multiplicand;
                overrun_amount <= divisor;
            end
            case (state)
                IDLE: if (start) state <= FIRST;
                FIRST: if (divider_done) state <= refine ? SECOND : IDLE;
                SECOND: if (divider_done) state <= IDLE;
                default: state <= FIRST;
            endcase
            if (rst) begin
                state <= IDLE;
                error_amount <= 0;
                overrun_amount <= 0;
            end
        end
        endmodule\n";
    let words = "equal refinement mine.v";
    let said = Bench::with(&[("mine.v", text)]).proves(words);
    assert!(said.contains("proved along: "), "{said}");
    let wrong = replaced(text, "state <= refine ? SECOND : IDLE", "state <= SECOND");
    Bench::with(&[("mine.v", &wrong)]).differs("refinement", words);
}
