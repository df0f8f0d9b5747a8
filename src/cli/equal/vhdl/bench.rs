//! A testbench in VHDL that plays bits on a design and writes its outputs as bits.

use super::entity::{Entity, Port};
use std::fmt::Write as _;

/// Name of the testbench.
pub const NAME: &str = "motion_rtl_bench";

/// Returns the conversion of bits, or of a slice of them, to a port.
fn driver(port: &Port, high: usize, width: usize) -> String {
    match port.vector() {
        Some("") => format!("word({high})"),
        Some("std_logic_vector" | "std_ulogic_vector") | None => {
            format!("word({high} downto {})", high + 1 - width)
        }
        Some(vector) => format!("{vector}(word({high} downto {}))", high + 1 - width),
    }
}

/// Returns the testbench of an entity. `inputs` are the ports in a line of the stimulus with their
/// widths; `outputs` those in a line of the results. `parameters` are values of generics.
pub fn bench(
    (name, entity): (&str, &Entity),
    clock: &str,
    parameters: &[(String, String)],
    inputs: &[(&Port, usize)],
    outputs: &[&Port],
    [stimulus, results]: [&str; 2],
) -> String {
    let mut text =
        String::from("library ieee;\nuse ieee.std_logic_1164.all;\nuse std.textio.all;\n");
    for clause in &entity.context {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{clause}");
    }
    let _ = write!(
        text,
        "\nentity {NAME} is\nend entity;\n\narchitecture test of {NAME} is\n"
    );
    let mut generics = Vec::new();
    for [generic, kind, default] in &entity.generics {
        let given = parameters
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(generic));
        let value = given.map_or(default, |(_, value)| value);
        let _ = writeln!(text, "    constant {generic} : {kind} := {value};");
        generics.push(format!("{generic} => {generic}"));
    }
    for port in &entity.ports {
        let start = if port.name == clock { " := '0'" } else { "" };
        let _ = writeln!(text, "    signal {} : {}{start};", port.name, port.kind);
    }
    let ports = entity
        .ports
        .iter()
        .map(|port| format!("{0} => {0}", port.name));
    let generics = match generics.is_empty() {
        true => String::new(),
        false => format!(" generic map ({})", generics.join(", ")),
    };
    let bits: usize = inputs.iter().map(|(_, width)| width).sum();
    let _ = write!(
        text,
        "begin\n    design : entity work.{name}{generics}\n        port map ({});\n\n    process\n        \
         file stimulus : text open read_mode is \"{stimulus}\";\n        file results : text open \
         write_mode is \"{results}\";\n        variable bits, result : line;\n        variable word : \
         std_logic_vector({} downto 0);\n    begin\n        while not endfile(stimulus) loop\n            \
         readline(stimulus, bits);\n            read(bits, word);\n",
        ports.collect::<Vec<_>>().join(", "),
        bits.max(1) - 1
    );
    let mut high = bits.max(1) - 1;
    for (port, width) in inputs {
        let _ = writeln!(
            text,
            "            {} <= {};",
            port.name,
            driver(port, high, *width)
        );
        high = high.saturating_sub(*width);
    }
    text += "            wait for 5 ns;\n";
    for port in outputs {
        let value = match port.vector() {
            Some("") => port.name.clone(),
            _ => format!("std_logic_vector({})", port.name),
        };
        let _ = writeln!(text, "            write(result, {value});");
    }
    let _ = write!(
        text,
        "            writeline(results, result);\n            {clock} <= '1';\n            wait for 5 \
         ns;\n            {clock} <= '0';\n        end loop;\n        wait;\n    end process;\nend \
         architecture;\n"
    );
    text
}
