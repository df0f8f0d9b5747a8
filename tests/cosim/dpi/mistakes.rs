//! What happens if something does not fit.

use super::*;

const DESIGN: &str = "\
module my_counter (
    input  wire       clk,
    input  wire       rst,
    input  wire [7:0] period,
    output wire       enable
);
    reg [7:0] count = 8'd0;
    wire [7:0] next = count + 8'd1;
    assign enable = next >= period;
    always @(posedge clk) count <= rst || enable ? 8'd0 : next;
endmodule
module bench;
    reg clk = 1'b0, rst = 1'b1;
    reg [7:0] period = 8'd3;
    wire enable;
    integer cycle = 0;
    my_counter dut (.clk(clk), .rst(rst), .period(period), .enable(enable));
    always #5 clk = ~clk;
    always @(posedge clk) begin
        cycle <= cycle + 1;
        rst <= cycle < 3;
        period <= 8'd3 + 8'(cycle % 3);
        if (cycle == 200) $finish;
    end
    wire unused = enable;
endmodule
";

/// Compiles the design after `change` has changed the files of its checker, by their names.
fn changed(
    folder: &Path,
    binding: &Binding,
    change: impl Fn(&str, String) -> String,
) -> Result<PathBuf, String> {
    let mut files = write(folder, "enable_counter", "width=8", binding);
    for file in &files {
        let name = file.file_name().unwrap().to_str().unwrap();
        let text = fs::read_to_string(file).unwrap();
        fs::write(file, change(name, text)).unwrap();
    }
    let file = folder.join("design.sv");
    fs::write(&file, DESIGN).unwrap();
    files.push(file);
    compiled(folder, Clock::Delays, &files)
}

fn binding() -> Binding {
    Binding {
        module: "my_counter".to_owned(),
        clock: "clk".to_owned(),
        reset: "rst".to_owned(),
        ..Binding::default()
    }
}

fn same(_: &str, text: String) -> String {
    text
}

/// Replaces a text that a file has.
#[track_caller]
fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}: {text}");
    text.replace(from, to)
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn wrong_names_and_widths_are_errors_of_the_simulator() {
    let folder = tempfile::tempdir().unwrap();
    let with = |expression: &str| Binding {
        ports: vec![("period".to_owned(), expression.to_owned())],
        ..binding()
    };
    let error = changed(folder.path(), &with("perid"), same).unwrap_err();
    assert!(
        error.contains("enable_counter_bind.sv") && error.contains("perid"),
        "{error}"
    );
    let error = changed(folder.path(), &with("period[3:0]"), same).unwrap_err();
    assert!(
        error.contains("WIDTH") && error.contains("period"),
        "{error}"
    );
}

/// Other simulators have no such warning, and many benches turn it off.
#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn a_width_that_no_warning_stops_is_found_at_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for (expression, bits) in [("period[6:0]", 7), ("{1'b0, period}", 9)] {
        let binding = Binding {
            ports: vec![("period".to_owned(), expression.to_owned())],
            ..binding()
        };
        let quiet = |name: &str, text: String| match name {
            "enable_counter_bind.sv" => format!("/* verilator lint_off WIDTH */\n{text}"),
            _ => text,
        };
        let program = changed(path, &binding, quiet).unwrap_or_else(|text| panic!("{text}"));
        let (code, text) = ended(&mut started(path, &program));
        let expected = format!(
            "mrtl_checker: port period has 8 bits, but what is connected to it has {bits}\n"
        );
        assert_ne!(code, Some(0), "{text}");
        assert!(
            text.contains("FAIL: ") && text.contains(&expected),
            "{text}"
        );
        assert!(!text.contains("PASS"), "{text}");
    }
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn another_version_and_other_ports_are_found_at_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let says = |from: &str, to: &str, expected: &str| {
        let change = |name: &str, text: String| match name {
            "enable_counter_checker.sv" => replaced(&text, from, to),
            _ => text,
        };
        let program = changed(path, &binding(), change).unwrap_or_else(|text| panic!("{text}"));
        let (code, text) = ended(&mut started(path, &program));
        assert_ne!(code, Some(0), "{text}");
        assert!(text.contains(expected) && text.contains("FAIL: "), "{text}");
        assert!(!text.contains("PASS"), "{text}");
    };
    let version = env!("CARGO_PKG_VERSION");
    says(
        &format!("\"{version}\""),
        "\"0.0.1\"",
        &format!(
            "the checker is of motion-rtl 0.0.1 (DPI 1), the library of {version} (DPI 1); \
                  `motion-rtl verilog enable_counter --dpi` prints the checker anew"
        ),
    );
    says(
        "mrtl_dpi_new(1,",
        "mrtl_dpi_new(2,",
        &format!("the checker is of motion-rtl {version} (DPI 2)"),
    );
    says(
        "width=8\"",
        "width=9\"",
        "enable_counter has other ports than the checker is made for; `motion-rtl verilog \
         enable_counter --dpi` prints the checker anew; the ports are:\nin period 9 unsigned\n",
    );
    says(
        "\"enable_counter\"",
        "\"enable_countr\"",
        "no circuit is called enable_countr; did you mean enable_counter?",
    );
}

#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn a_missing_library_ends_the_program_at_its_start() {
    let folder = tempfile::tempdir().unwrap();
    let program = changed(folder.path(), &binding(), same).unwrap_or_else(|text| panic!("{text}"));
    let (code, text) = ended(Command::new(&program).env_remove("LD_LIBRARY_PATH"));
    assert_eq!(code, Some(127), "{text}");
    let missing = "error while loading shared libraries: libmotion_rtl.so.1";
    assert!(text.contains(missing), "{text}");
}

/// Verilator has two states: in these files a 1 stands for an unknown bit.
#[test]
#[ignore = "needs Verilator and the library of bindings/c"]
fn unknown_ports_are_passed_on_with_their_places() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let says = |unknown: &str| {
        let change = |name: &str, text: String| match name {
            "enable_counter_checker.sv" => {
                let text = replaced(&text, "$isunknown({rst, period, enable})", "1'b1");
                let text = replaced(&text, unknown, &unknown.replace("$isunknown", "|"));
                text.replace("$isunknown", "1'b0 && |")
            }
            _ => text,
        };
        let program = changed(path, &binding(), change).unwrap_or_else(|text| panic!("{text}"));
        let (code, text) = ended(&mut started(path, &program));
        assert_ne!(code, Some(0), "{text}");
        text
    };
    let text = says("$isunknown(enable)");
    assert!(
        text.contains("  enable: design 1 (binary, unknown), model 1\n"),
        "{text}"
    );
    let text = says("$isunknown(period)");
    assert!(
        text.contains(": input period is 00000011 (binary, unknown); the comparison stops here"),
        "{text}"
    );
    assert!(
        text.contains("FAIL: an unknown input has stopped the comparison after 0 ticks"),
        "{text}"
    );
}
