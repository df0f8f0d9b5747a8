//! Parts that checkers in all printed languages share.

use super::{Port, PortList, VERSION};
use crate::printed::ascii;
use crate::sim::{Model, PortDirection};

/// Facts about a model that its printed checker has.
#[derive(Debug, Clone)]
pub(crate) struct PrintedChecker {
    pub circuit: String,
    /// One `key=value` per line.
    pub settings: String,
    /// True if the circuit has registers, and thus a clock and a reset.
    pub clocked: bool,
    /// Hash of the ports.
    pub hash: u64,
    /// Input ports, then output ports.
    pub ports: Vec<Port>,
}

impl PrintedChecker {
    pub fn of(model: &Model, settings: &str) -> Self {
        let list = PortList::of(model);
        PrintedChecker {
            circuit: model.name().to_owned(),
            settings: settings.trim().to_owned(),
            clocked: list.clocked,
            hash: list.hash(),
            ports: list.inputs_first().cloned().collect(),
        }
    }

    /// Returns the comment at the head of a checker; each line begins with `mark`, of two letters.
    pub fn head(&self, mark: &str) -> String {
        let circuit = &self.circuit;
        let about = match self.settings.is_empty() {
            true => String::new(),
            false => format!(" with {}", self.settings.replace('\n', ", ")),
        };
        let begins = match self.clocked {
            true => {
                "\
The comparison begins with the edge after the first one at which rst is 1, or, with
FROM_POWER_ON, with the first edge."
            }
            false => "The circuit has no registers: the comparison begins with the first edge.",
        };
        let text = format!(
            "\
Checker of {circuit}{about}, made by motion-rtl {VERSION}.

Compares the ports of a design with the model at every rising edge of clk. All ports are inputs
of the checker. At the end of the simulation it prints PASS, FAIL or VACUOUS.
{begins}
Drive the inputs of the design with <= at the edge, or between edges.
"
        );
        let lines = text.lines().map(|line| format!("{mark} {line}"));
        let lines: Vec<_> = lines.map(|line| line.trim_end().to_owned()).collect();
        lines.join("\n") + "\n"
    }
}

impl Port {
    /// Returns the comment of a port of a checker.
    pub(crate) fn comment(&self) -> String {
        let side = match self.direction {
            PortDirection::In => "Input:",
            PortDirection::Out => "Output:",
        };
        ascii(&format!("{side} {}", self.doc))
    }
}
