//! SystemVerilog that puts a model beside a design in a simulator, by DPI.

mod package;

use super::text::{MARK, column, range};
use crate::checker::{DPI_VERSION, Place, Port, PortWords, PrintedChecker, VERSION};
use crate::printed::{SourceFile, annotated};
use crate::sim::{Model, ModelError};
use std::fmt::Write as _;

/// Words that a call passes.
const CALL: usize = 8;

/// Beginning of the names that a checker has for itself. No port has a `$` in its name.
const OWN: &str = "mrtl$";

/// Module that compares the ports of a design with a model at every clock edge.
///
/// The design is bound beside it or instantiates it; the model runs in the shared library of
/// `bindings/c`.
///
/// ```
/// use motion_rtl::{Model, verilog::DpiChecker};
///
/// let counter = Model::new("enable_counter", &["width=8".parse()?])?;
/// let checker = DpiChecker::new(&counter, "width=8", &[])?;
/// let [package, module] = checker.sources();
/// assert_eq!(package.name, "motion_rtl_pkg.sv");
/// assert!(module.text.contains("module enable_counter_checker"));
/// assert!(module.text.contains("input wire [7:0] period"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct DpiChecker {
    printed: PrintedChecker,
    /// Paths of the ports that are left out.
    left: Vec<String>,
    /// Input ports, then output ports, with their places; without those that are left out.
    ports: Vec<(Port, Place)>,
    words: usize,
}

/// Module of a design to which a checker is bound, with the expressions that stand for the ports of
/// the checker there.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Binding {
    /// Name of the module.
    pub module: String,
    /// Expression for the clock.
    pub clock: String,
    /// Expression for the reset, active high.
    pub reset: String,
    /// Ports by their paths, with their expressions; a port that is missing has its own name.
    pub ports: Vec<(String, String)>,
    /// Compares from the first edge on, without waiting for a reset.
    pub from_power_on: bool,
}

impl DpiChecker {
    /// Prepares a checker for a model of the catalogue with these settings, one `key=value` per
    /// line. Ports in `left` are left out: output ports are not compared, input ports of the model
    /// stay low.
    ///
    /// # Errors
    /// Returns an error if a signal to leave out does not exist.
    pub fn new(model: &Model, settings: &str, left: &[String]) -> Result<Self, ModelError> {
        let printed = PrintedChecker::of(model, settings);
        let handles = left.iter().map(|name| model.find(name.as_str()));
        let handles = handles.collect::<Result<Vec<_>, _>>()?;
        let (left, kept): (Vec<_>, Vec<_>) =
            (printed.ports.iter().cloned()).partition(|port| handles.contains(&port.handle));
        let layout = PortWords::of_ports(kept.iter().map(|port| (port.direction, port.shape)));
        let places = layout.inputs.iter().chain(&layout.outputs).copied();
        Ok(DpiChecker {
            printed,
            left: left.into_iter().map(|port| port.path).collect(),
            ports: kept.into_iter().zip(places).collect(),
            words: layout.words,
        })
    }

    /// Returns true if the circuit has registers, and thus a clock and a reset.
    pub fn is_clocked(&self) -> bool {
        self.printed.clocked
    }

    /// Returns the package with the functions of the library, and the checker.
    pub fn sources(&self) -> [SourceFile; 2] {
        let checker = SourceFile {
            name: format!("{}_checker.sv", self.printed.circuit),
            text: self.module(),
        };
        [package::package(), checker]
    }

    /// Returns the statement that binds the checker to a module.
    pub fn binding(&self, binding: &Binding) -> SourceFile {
        let circuit = &self.printed.circuit;
        let mut ports = vec![format!("    .clk ({})", binding.clock)];
        if self.printed.clocked {
            ports.push(format!("    .rst ({})", binding.reset));
        }
        let mut bits = Vec::new();
        for (port, _) in &self.ports {
            let mut given = binding.ports.iter();
            let given = given.find(|(path, _)| *path == port.path);
            let name = given.map_or(&port.verilog, |(_, expression)| expression);
            ports.push(format!("    .{} ({name})", port.verilog));
            bits.push(format!("$bits({name})"));
        }
        let mut parameters = Vec::new();
        if binding.from_power_on {
            parameters.push("    .FROM_POWER_ON (1'b1)".to_owned());
        }
        parameters.push(format!(
            "    .{OWN}bits ('{{\n        {}\n    }})",
            bits.join(",\n        ")
        ));
        let text = format!(
            "\
// Puts {circuit}_checker into every instance of {module}.
bind {module} {circuit}_checker #(
{}
) mrtl_checker (
{}
);
",
            parameters.join(",\n"),
            ports.join(",\n"),
            module = binding.module,
        );
        SourceFile {
            name: format!("{circuit}_bind.sv"),
            text,
        }
    }

    /// Returns the declarations of the ports.
    fn declared(&self) -> String {
        let width = column(self.ports.iter().map(|(port, _)| port.shape));
        let mut lines = vec![(
            format!("    input wire {:width$}clk,", ""),
            "Clock.".to_owned(),
        )];
        if self.printed.clocked {
            lines.push((
                format!("    input wire {:width$}rst,", ""),
                "Synchronous reset.".to_owned(),
            ));
        }
        for (port, _) in &self.ports {
            let range = range(port.shape);
            lines.push((
                format!("    input wire {range:width$}{},", port.verilog),
                port.comment(),
            ));
        }
        if let Some((last, _)) = lines.last_mut() {
            last.pop();
        }
        annotated(&lines, MARK).join("\n")
    }

    /// Returns the expressions of the words.
    fn words(&self) -> Vec<String> {
        let word = |index: usize| {
            let ports = self.ports.iter().filter(|(_, place)| place.word == index);
            let mut parts: Vec<String> = ports
                .clone()
                .map(|(port, _)| port.verilog.clone())
                .collect();
            let used: usize = ports.map(|(_, place)| place.width).sum();
            if used < 64 {
                parts.push(format!("{}'d0", 64 - used));
            }
            // The first port is the lowest.
            parts.reverse();
            format!("{{{}}}", parts.join(", "))
        };
        (0..self.words).map(word).collect()
    }

    /// Returns the statements that pass the words of an edge; the last one is the edge.
    fn calls(&self) -> String {
        let mut words = self.words();
        words.resize(self.words.next_multiple_of(CALL).max(CALL), "64'd0".into());
        let calls = words.chunks(CALL).count();
        let mut text = String::new();
        for (index, words) in words.chunks(CALL).enumerate() {
            let words: String = words
                .iter()
                .map(|word| format!(",\n                {word}"))
                .collect();
            let first = CALL * index;
            // Writing to a string does not fail.
            let _ = match index + 1 == calls {
                false => writeln!(
                    text,
                    "            motion_rtl_pkg::mrtl_dpi_words(\n                \
                     {OWN}checker, {first}{words});"
                ),
                true => writeln!(
                    text,
                    "            if (motion_rtl_pkg::mrtl_dpi_edge(\n                \
                     {OWN}checker, {}, {first}{words}) != 0)",
                    self.reset()
                ),
            };
        }
        text
    }

    /// Returns the widths of the ports.
    fn widths(&self) -> Vec<String> {
        let widths = self.ports.iter().map(|(_, place)| place.width.to_string());
        widths.collect()
    }

    /// Returns the statements that compare widths with those of the ports.
    fn fits(&self) -> String {
        let lines = self.ports.iter().enumerate().map(|(index, (port, place))| {
            let (name, width) = (&port.verilog, place.width);
            format!("        {OWN}fits(\"{name}\", {width}, {OWN}bits[{index}]);\n")
        });
        lines.collect()
    }

    fn reset(&self) -> &'static str {
        match self.printed.clocked {
            true => "{31'd0, rst}",
            false => "0",
        }
    }

    /// Returns the statements that report ports with unknown bits.
    fn unknowns(&self) -> String {
        let reset = self.printed.clocked.then_some(("rst", -1));
        let ports = (0..).zip(&self.ports);
        let ports = ports.map(|(index, (port, _))| (port.verilog.as_str(), index));
        let lines = reset.into_iter().chain(ports).map(|(name, index): (&str, i32)| {
            format!(
                "        if ($isunknown({name}))\n            \
                 motion_rtl_pkg::mrtl_dpi_unknown({OWN}checker, {index}, $sformatf(\"%b\", {name}));\n"
            )
        });
        lines.collect()
    }

    fn all(&self) -> String {
        let reset = self.printed.clocked.then_some("rst").into_iter();
        let ports = self.ports.iter().map(|(port, _)| port.verilog.as_str());
        reset.chain(ports).collect::<Vec<_>>().join(", ")
    }

    fn module(&self) -> String {
        let circuit = &self.printed.circuit;
        let settings = self.printed.settings.replace('\n', "\\n");
        format!(
            "\
{head}
/* verilator lint_off TIMESCALEMOD */
module {circuit}_checker #(
    // 1: compares from the first edge on, with the model at power-on.
    parameter bit FROM_POWER_ON = 1'b0,
    // File for the model's waves around the first difference, VCD or FST; %m is the name of the
    // instance. No waves if it is empty.
    parameter string WAVES = \"%m.vcd\",
    // Bits of what is connected to each port; a bind statement measures them.
    parameter int {OWN}bits [{count}] = '{{{widths}}}
) (
{ports}
);

    int {OWN}checker = 0;
    int {OWN}failed;
    bit {OWN}narrow = 1'b0;
    string {OWN}instance;

    // A simulator extends or cuts what has another width.
    function automatic void {OWN}fits(string port, int width, int connected);
        if (connected != width) begin
            {OWN}narrow = 1'b1;
            $display(\"FAIL: %s: port %s has %0d bits, but what is connected to it has %0d\",
                {OWN}instance, port, width, connected);
        end
    endfunction

    initial begin
        {OWN}instance = $sformatf(\"%m\");
{fits}        if ({OWN}narrow) $fatal(1, \"{circuit}_checker cannot be used\");
        {OWN}checker = motion_rtl_pkg::mrtl_dpi_new({DPI_VERSION}, \"{VERSION}\",
            \"{circuit}\", \"{settings}\", 64'h{hash:016x}, \"{left}\",
            {{31'd0, FROM_POWER_ON}}, WAVES, {OWN}instance);
        if ({OWN}checker <= 0) begin
            $display(\"FAIL: %s\", motion_rtl_pkg::mrtl_dpi_error());
            $fatal(1, \"{circuit}_checker cannot be used\");
        end
    end

    function automatic void {OWN}unknowns();
{unknowns}    endfunction

    always @(posedge clk) begin
        if ({OWN}checker > 0) begin
            // Always false in a simulator with two states.
            if ($isunknown({{{all}}})) {OWN}unknowns();
{calls}                $display(\"at time %0t: %s\", $time, motion_rtl_pkg::mrtl_dpi_text({OWN}checker));
        end
    end

    final begin
        if ({OWN}checker > 0) begin
            {OWN}failed = motion_rtl_pkg::mrtl_dpi_end({OWN}checker);
            $display(\"%s\", motion_rtl_pkg::mrtl_dpi_text({OWN}checker));
            // The last checker of a simulation ends it.
            if ({OWN}failed != 0) $fatal(1, \"a checker of motion-rtl has not passed\");
        end
    end

endmodule
",
            head = self.printed.head(MARK),
            ports = self.declared(),
            count = self.ports.len(),
            widths = self.widths().join(", "),
            fits = self.fits(),
            hash = self.printed.hash,
            left = self.left.join("\\n"),
            unknowns = self.unknowns(),
            all = self.all(),
            calls = self.calls(),
        )
    }
}
