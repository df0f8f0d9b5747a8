//! A map's lines for the ports of a module.

use super::map::{Entry, Map, Partner};
use super::names::brackets;
use crate::input::Fault;
use crate::sim::{Model, SignalInfo};

/// Ports of a circuit as a module of another design has them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BoundPorts {
    /// Paths of ports below the circuit, with expressions in the module.
    pub ports: Vec<(String, String)>,
    /// Paths of ports that are left out.
    pub left: Vec<String>,
}

/// True if a text is a name in Verilog.
pub fn is_identifier(text: &str) -> bool {
    let word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '$';
    let begins = text.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_');
    begins && text.chars().all(word)
}

impl Map {
    /// Returns the partners of a model's ports as expressions in the module that has them all.
    /// Lines for other signals, and `[scopes]`, have no effect.
    ///
    /// # Errors
    /// Returns an error if the model has no such signal, a port has a delay, its partner is no name
    /// of Verilog, or the partners are in different scopes.
    pub fn bound(&self, model: &Model) -> Result<BoundPorts, Fault> {
        let mut ports = model.signals();
        ports.retain(|signal| signal.port.is_some());
        let mut bound = BoundPorts::default();
        for entry in self.ignore.iter().chain(&self.leave) {
            if !entry.golden.ends_with(".*")
                && let Some(port) = self.port(model, &ports, entry)?
            {
                bound.left.push(port.path.clone());
            }
        }
        let mut scope = None;
        for entry in &self.signals {
            if let Some(port) = self.port(model, &ports, entry)? {
                let expression = self.expression(entry, &mut scope)?;
                bound.ports.push((port.path.clone(), expression));
            }
        }
        Ok(bound)
    }

    /// Returns the port that a line names; `None` for another signal.
    fn port<'p, T>(
        &self,
        model: &Model,
        ports: &'p [SignalInfo],
        entry: &Entry<T>,
    ) -> Result<Option<&'p SignalInfo>, Fault> {
        let handle = model.find(&entry.golden).map_err(|_| {
            let circuit = model.name();
            let names = ports.iter().map(|port| format!("{circuit}.{}", port.path));
            let names: Vec<String> = names.collect();
            let problem = format!("no signal of {circuit} is called so");
            self.fault(entry.line, &entry.golden, problem, names.join(", "))
        })?;
        Ok(ports.iter().find(|port| port.handle == handle))
    }

    /// Returns the expression for a partner; all of them are in one scope.
    fn expression<'m>(
        &'m self,
        entry: &'m Entry<Partner>,
        scope: &mut Option<&'m str>,
    ) -> Result<String, Fault> {
        let Partner {
            name,
            invert,
            delay,
        } = &entry.other;
        let fault = |problem: String, allowed: &str| {
            Err(self.fault(entry.line, &entry.golden, problem, allowed))
        };
        if *delay > 0 {
            return fault(
                format!("a delay of {delay}, which a checker does not have"),
                "a port without delay",
            );
        }
        let (around, own) = name.rsplit_once('.').unwrap_or(("", name));
        if !around.is_empty() {
            match *scope {
                Some(other) if other != around => {
                    let problem =
                        format!("{name} is not in {other}, where the ports before it are");
                    return fault(problem, "ports of one module");
                }
                _ => *scope = Some(around),
            }
        }
        let base = brackets(own).map_or(own, |(base, _, _)| base);
        if !is_identifier(base) {
            let problem = format!("{own} is no name of a port");
            return fault(
                problem,
                "a name, as \"tb.dut.count\" or \"tb.dut.bus[27:4]\"",
            );
        }
        Ok(format!("{}{own}", if *invert { "~" } else { "" }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bound(text: &str) -> Result<BoundPorts, String> {
        let model = Model::new("unit_law", &["width=16".parse().unwrap()]).unwrap();
        let map = Map::parse("m.toml", text).unwrap();
        map.bound(&model).map_err(|fault| fault.to_string())
    }

    #[test]
    fn ports_become_expressions_in_their_module() {
        let text = "\
leave = [\"unit_law.counted\"]
[signals]
\"unit_law.half_period\" = \"tb.dut.bus[31:16]\"
\"unit_law.step\" = \"!dut.step_n\"
\"unit_law.counter.count\" = \"tb.dut.u_timer.cnt\"
\"unit_law.period\" = \"limit\"
";
        // `dut` is another scope than `tb.dut`.
        let error = bound(text).unwrap_err();
        assert_eq!(
            error,
            "m.toml:4: unit_law.step: dut.step_n is not in tb.dut, where the ports before it are; \
             allowed: ports of one module"
        );
        let bound = bound(&text.replace("!dut", "!tb.dut")).unwrap();
        let pair = |path: &str, expression: &str| (path.to_owned(), expression.to_owned());
        assert_eq!(
            bound.ports,
            [
                pair("half_period", "bus[31:16]"),
                pair("step", "~step_n"),
                pair("period", "limit")
            ]
        );
    }

    #[test]
    fn lines_that_name_no_signal_or_no_port_of_a_module_are_refused() {
        let refusal = |line: &str| bound(&format!("[signals]\n{line}\n")).unwrap_err();
        let error = refusal("\"unit_law.stp\" = \"tb.dut.step\"");
        let start = "m.toml:2: unit_law.stp: no signal of unit_law is called so; allowed: \
                     unit_law.half_period, unit_law.period, ";
        assert!(error.starts_with(start), "{error}");
        assert_eq!(
            refusal("\"unit_law.step\" = { name = \"tb.dut.step\", delay = 2 }"),
            "m.toml:2: unit_law.step: a delay of 2, which a checker does not have; allowed: a port \
             without delay"
        );
        assert_eq!(
            refusal("\"unit_law.step\" = \"tb.dut.a b\""),
            "m.toml:2: unit_law.step: a b is no name of a port; allowed: a name, as \
             \"tb.dut.count\" or \"tb.dut.bus[27:4]\""
        );
    }
}
