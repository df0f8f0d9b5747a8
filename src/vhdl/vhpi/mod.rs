//! VHDL that puts a model beside a design in a simulator, by VHPIDIRECT.

mod library;
mod package;

pub use library::{LibraryPath, LibraryPathError};

use super::entity::{LIBRARIES, port_lines};
use super::scope::Scope;
use super::text::{MARK, subtype};
use super::words::legal;
use crate::checker::{PrintedChecker, VERSION};
use crate::netlist::Kind;
use crate::printed::SourceFile;
use crate::sim::Model;
use std::fmt::Write as _;

/// Names that the text of a checker uses, beside those of all printed VHDL.
const USED: [&str; 11] = [
    "boolean",
    "false",
    "from_power_on",
    "integer",
    "leave",
    "motion_rtl_pkg",
    "mrtl_checker",
    "mrtl_ports",
    "std_ulogic_vector",
    "string",
    "waves",
];

/// Longest part of a string literal.
const PART: usize = 60;

/// Entity that compares the ports of a design with a model at every clock edge.
///
/// A bench or the design instantiates it; the model runs in the shared library of `bindings/c`.
///
/// ```
/// use motion_rtl::{Model, vhdl::VhpiChecker};
///
/// let counter = Model::new("enable_counter", &["width=8".parse()?])?;
/// let checker = VhpiChecker::new(&counter, "width=8", "/usr/local/lib/libmotion_rtl.so".parse()?);
/// let [package, entity] = checker.sources();
/// assert_eq!(package.name, "motion_rtl_pkg.vhd");
/// assert!(entity.text.contains("entity enable_counter_checker is"));
/// assert!(entity.text.contains("period : in unsigned(7 downto 0);"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct VhpiChecker {
    printed: PrintedChecker,
    library: LibraryPath,
}

impl VhpiChecker {
    /// Prepares a checker for a model of the catalogue with these settings, one `key=value` per
    /// line.
    pub fn new(model: &Model, settings: &str, library: LibraryPath) -> Self {
        VhpiChecker {
            printed: PrintedChecker::of(model, settings),
            library,
        }
    }

    /// Returns the package with the functions of the library, and the checker, in the order in
    /// which they are analysed.
    pub fn sources(&self) -> [SourceFile; 2] {
        let checker = SourceFile {
            name: format!("{}_checker.vhd", self.printed.circuit),
            text: self.entity(),
        };
        [package::package(&self.library), checker]
    }

    fn scope(&self) -> Scope {
        let ports = self.printed.ports.iter();
        Scope::of_ports(&USED, ports.map(|port| port.verilog.as_str()))
    }

    /// Returns the declarations of the ports.
    fn ports(&self, scope: &Scope) -> String {
        let bit = "in std_logic".to_owned();
        let mut ports = vec![("clk".to_owned(), bit.clone(), "Clock.".to_owned())];
        if self.printed.clocked {
            ports.push(("rst".to_owned(), bit, "Synchronous reset.".to_owned()));
        }
        for port in &self.printed.ports {
            let kind = format!("in {}", subtype(port.shape));
            ports.push((scope.own(&port.verilog), kind, port.comment()));
        }
        port_lines(ports)
    }

    /// Returns the statements that put the values of the ports side by side, and their number.
    fn values(&self, scope: &Scope) -> (String, usize) {
        let rst = if self.printed.clocked { "rst" } else { "'0'" };
        let mut text = format!("            mrtl_ports(0) := {rst};\n");
        let mut first = 1;
        for port in &self.printed.ports {
            let name = scope.own(&port.verilog);
            let end = first + port.shape.width;
            // Writing to a string does not fail.
            let _ = match port.shape.kind {
                Kind::Bit => writeln!(text, "            mrtl_ports({first}) := {name};"),
                Kind::Unsigned | Kind::Signed => writeln!(
                    text,
                    "            mrtl_ports({first} to {last}) := std_ulogic_vector({name});",
                    last = end - 1
                ),
            };
            first = end;
        }
        (text, first)
    }

    fn entity(&self) -> String {
        let PrintedChecker {
            circuit,
            settings,
            hash,
            ..
        } = &self.printed;
        let name = legal(&format!("{circuit}_checker"));
        let scope = self.scope();
        let (values, count) = self.values(&scope);
        format!(
            "\
{head}
{LIBRARIES}
entity {name} is
    generic (
        -- Compares from the first edge on, with the model at power-on.
        FROM_POWER_ON : boolean := false;
        -- File for the model's waves around the first difference, VCD or FST; %m is the name of
        -- the instance. No waves if it is empty.
        WAVES : string := \"%m.vcd\";
        -- Ports to leave out, separated by commas: output ports are not compared, input ports of
        -- the model stay low. They are connected nevertheless.
        LEAVE : string := \"\"
    );
{ports}end entity {name};

architecture vhpidirect of {name} is
begin

    process
        variable mrtl_checker : integer;
        -- The reset, the input ports and the output ports, the highest bit of each first.
        variable mrtl_ports : std_ulogic_vector(0 to {last});
    begin
        mrtl_checker := work.motion_rtl_pkg.new_checker(
            \"{VERSION}\",
            {circuit},
            {settings},
            \"{hash:016x}\",
            LEAVE, FROM_POWER_ON, WAVES, {name}'path_name);
        loop
            wait until rising_edge(clk);
{values}            work.motion_rtl_pkg.edge(mrtl_checker, mrtl_ports);
        end loop;
    end process;

end architecture vhpidirect;
",
            head = self.printed.head(MARK),
            ports = self.ports(&scope),
            last = count - 1,
            circuit = literal(circuit),
            settings = literal(settings),
        )
    }
}

/// Returns a text as a string literal of VHDL, in several lines if it is long.
fn literal(text: &str) -> String {
    let mut parts = Vec::new();
    for (index, line) in text.split('\n').enumerate() {
        let letters: Vec<char> = line.chars().collect();
        let mut pieces = letters
            .chunks(PART)
            .map(String::from_iter)
            .collect::<Vec<_>>();
        if pieces.is_empty() {
            pieces.push(String::new());
        }
        for (part, piece) in pieces.iter().enumerate() {
            let feed = if index > 0 && part == 0 { "LF & " } else { "" };
            parts.push(format!("{feed}\"{}\"", piece.replace('"', "\"\"")));
        }
    }
    parts.join("\n            & ")
}

#[cfg(test)]
mod tests;
