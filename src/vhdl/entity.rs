//! Entities in VHDL, and their architectures.

use super::constant::typed;
use super::expression::{Expressions, NATURAL};
use super::memories::{memories, writes};
use super::rules::{inputs, needed, purposes};
use super::scope::Scope;
use super::statements::registers;
use super::text::{MARK, STEP, assignment, subtype};
use super::units::{Unit, Units};
use crate::netlist::{Format, Module, Node, Role, Shape, unsigned};
use crate::printed::{
    Body, Definition, Names, Outputs, Rules, annotated, ascii, comment, definitions,
    is_own_register, stored,
};
use std::fmt::Write as _;

/// Libraries of every file.
pub(super) const LIBRARIES: &str = "\
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
";

impl Units<'_> {
    /// Returns the text of an entity and its architecture.
    pub(super) fn print(&self, unit: &Unit) -> String {
        let (module, scope) = self.inside(unit);
        let shown = |name: &str| scope.own(name);
        let purposes = purposes(module, scope);
        let fallback = |id: usize| format!("{}_part", purposes[id]);
        let rules = Rules {
            shown: &shown,
            taken: scope.taken(),
            given: inputs(module, self.modules.modules, scope),
            needs: needed,
            fallback: &fallback,
        };
        let names = Names::new(module, self.modules.modules, rules);
        let expressions = Expressions::new(module, &names, scope);
        let outputs = self.modules.outputs(module, &names);

        let mut statements = Body::new(MARK);
        for port in module.signals.iter().filter(|own| is_own_register(own)) {
            if let Some(behind) = port.behind() {
                let [port, behind] = [&port.name, &behind].map(|name| scope.own(name));
                statements.line(&format!("{port} <= {behind};"));
            }
        }
        statements.space();
        define(module, &expressions, &mut statements);
        self.instances(unit, &expressions, &outputs, &mut statements);
        writes(&expressions, &mut statements);
        for line in registers(&expressions) {
            statements.raw(&line);
        }

        let mut declared = Body::new(MARK);
        memories(unit, &expressions, &mut declared);
        states(module, &expressions, &mut declared);
        signals(module, &expressions, &outputs, &mut declared);

        let mut text = String::new();
        let name = &unit.name;
        let _ = writeln!(text, "-- {}: {}.", module.name, ascii(module.about));
        let _ = writeln!(
            text,
            "-- Made by motion-rtl from the circuit of that name.\n"
        );
        let _ = writeln!(text, "{LIBRARIES}\nentity {name} is");
        text += &self.generics(unit);
        text += &ports(module, scope, self.modules.clocked(module));
        let _ = writeln!(text, "end entity {name};\n");
        let _ = writeln!(text, "architecture rtl of {name} is\n");
        text += &declared.finish();
        let _ = writeln!(text, "begin\n");
        text += &statements.finish();
        let _ = writeln!(text, "end architecture rtl;");
        text
    }

    /// Returns the generics of an entity.
    fn generics(&self, unit: &Unit) -> String {
        let (module, scope) = self.inside(unit);
        let parameters = self.modules.numbers(module);
        let lines = parameters.iter().map(|parameter| {
            let top = self.modules.is_top(module);
            let value = if top {
                self.modules.number(&parameter.path)
            } else {
                0
            };
            let name = scope.generic(&parameter.name());
            let width = parameter.width.unwrap_or_default();
            match width <= NATURAL {
                true => {
                    let most = (1_u64 << width) - 1;
                    format!("{STEP}{STEP}{name} : natural range 0 to {most} := {value}")
                }
                false => {
                    let shape = unsigned(width);
                    let value = typed(value, shape).0;
                    format!("{STEP}{STEP}{name} : {} := {value}", subtype(shape))
                }
            }
        });
        let lines: Vec<String> = lines.collect();
        match lines.is_empty() {
            true => String::new(),
            false => format!("{STEP}generic (\n{}\n{STEP});\n", lines.join(";\n")),
        }
    }

    fn instances(
        &self,
        unit: &Unit,
        expressions: &Expressions<'_>,
        outputs: &Outputs,
        body: &mut Body,
    ) {
        let (module, scope) = self.inside(unit);
        let children = module.instances.iter().zip(&unit.children);
        for ((child, inner), outputs) in children.zip(&outputs.connections) {
            let inner = &self.units[*inner];
            let (inside, names) = self.inside(inner);
            let mut map = Vec::new();
            if self.modules.clocked(inside) {
                map.extend(["clk", "rst"].map(|name| (name.to_owned(), name.to_owned())));
            }
            for (port, driver) in inside.inputs().zip(&child.inputs) {
                map.push((names.own(&port.name), expressions.value(*driver)));
            }
            for (port, wire) in outputs {
                map.push((names.own(port), wire.clone()));
            }
            let generics = self.modules.numbers(inside).into_iter().map(|parameter| {
                let path = [std::slice::from_ref(&child.name), &parameter.path].concat();
                let width = parameter.width.unwrap_or_default();
                let value = match self.modules.is_top(module) {
                    true if width <= NATURAL => self.modules.number(&path).to_string(),
                    true => typed(self.modules.number(&path), unsigned(width)).0,
                    false => scope.generic(&path.join("_").to_uppercase()),
                };
                (names.generic(&parameter.name()), value)
            });
            let generics: Vec<_> = generics.collect();
            let label = scope.own(&child.name);
            let mut lines = vec![format!("{label} : entity work.{}", inner.name)];
            lines.extend(association("generic map", &generics));
            lines.extend(association("port map", &map));
            if let Some(last) = lines.last_mut() {
                last.push(';');
            }
            for line in lines {
                body.line(&line);
            }
            body.space();
        }
    }
}

/// Returns an association by name; no lines if nothing is associated.
fn association(begin: &str, map: &[(String, String)]) -> Vec<String> {
    if map.is_empty() {
        return Vec::new();
    }
    let width = map.iter().map(|(formal, _)| formal.len()).max();
    let width = width.unwrap_or(0);
    let mut lines = vec![format!("{STEP}{begin} (")];
    for (index, (formal, actual)) in map.iter().enumerate() {
        let comma = if index + 1 == map.len() { "" } else { "," };
        lines.push(format!("{STEP}{STEP}{formal:width$} => {actual}{comma}"));
    }
    lines.push(format!("{STEP})"));
    lines
}

/// Returns the ports of an entity.
fn ports(module: &Module, scope: &Scope, clocked: bool) -> String {
    let mut ports = Vec::new();
    if clocked {
        let about = "Registers to their power-on values; memories stay.";
        ports.push(("clk".to_owned(), "in  std_logic".to_owned(), String::new()));
        ports.push((
            "rst".to_owned(),
            "in  std_logic".to_owned(),
            about.to_owned(),
        ));
    }
    for signal in module.signals.iter().filter(|signal| signal.is_port()) {
        let way = match signal.role {
            Role::Input => "in ",
            Role::Net | Role::Register => "out",
        };
        let kind = format!("{way} {}", subtype(signal.shape));
        ports.push((scope.own(&signal.name), kind, comment(signal)));
    }
    port_lines(ports)
}

/// Returns the declarations of ports: their names, their types with a mode, and comments.
pub(super) fn port_lines(ports: Vec<(String, String, String)>) -> String {
    if ports.is_empty() {
        return String::new();
    }
    let width = ports.iter().map(|(name, ..)| name.len()).max().unwrap_or(0);
    let last = ports.len() - 1;
    let lines = ports
        .into_iter()
        .enumerate()
        .map(|(index, (name, kind, comment))| {
            let end = if index == last { "" } else { ";" };
            let pad = STEP.repeat(2);
            (format!("{pad}{name:width$} : {kind}{end}"), comment)
        });
    let lines: Vec<_> = lines.collect();
    let mut text = format!("{STEP}port (\n");
    for line in annotated(&lines, MARK) {
        let _ = writeln!(text, "{line}");
    }
    text + STEP + ");\n"
}

/// Adds the states of signals as constants, if a statement uses them.
fn states(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    for (index, signal) in module.signals.iter().enumerate() {
        let Format::States(states) = signal.field.format else {
            continue;
        };
        if !expressions.uses_states(index) {
            continue;
        }
        for value in 0..states.len() as u64 {
            if let Some(name) = expressions.scope.state(signal, value) {
                let (kind, value) = (subtype(signal.shape), typed(value, signal.shape).0);
                body.line(&format!("constant {name} : {kind} := {value};"));
            }
        }
        body.space();
    }
}

/// Adds registers, wires of instances, nets and shared subexpressions.
fn signals(module: &Module, expressions: &Expressions<'_>, outputs: &Outputs, body: &mut Body) {
    let scope = expressions.scope;
    let signal = |name: &str, shape: Shape| format!("{STEP}signal {name} : {}", subtype(shape));
    let mut lines = Vec::new();
    for register in module.signals.iter().filter(|own| is_own_register(own)) {
        let name = scope.own(&stored(register));
        let value = expressions.power_on(register);
        // A port is described where it stands.
        let comment = match register.is_port() {
            true => String::new(),
            false => comment(register),
        };
        let begin = signal(&name, register.shape);
        lines.push((format!("{begin} := {value};"), comment));
    }
    add(&mut lines, body);
    for (shape, name) in &outputs.wires {
        lines.push((format!("{};", signal(name, *shape)), String::new()));
    }
    add(&mut lines, body);
    for definition in definitions(module, expressions.names) {
        let (name, shape, comment) = match definition {
            Definition::Shared(id) => {
                let name = expressions.names.get(id).unwrap_or_default();
                (name.to_owned(), module.nodes[id].1, String::new())
            }
            Definition::Net { signal, .. } if !signal.is_port() => {
                (scope.own(&signal.name), signal.shape, comment(signal))
            }
            Definition::Net { .. } => continue,
        };
        lines.push((format!("{};", signal(&name, shape)), comment));
    }
    // Nets that instances drive are among their wires.
    add(&mut lines, body);
}

fn add(lines: &mut Vec<(String, String)>, body: &mut Body) {
    for line in annotated(&std::mem::take(lines), MARK) {
        body.raw(&line);
    }
    body.space();
}

/// Adds the statements of nets and shared subexpressions.
fn define(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    for definition in definitions(module, expressions.names) {
        let (target, alternatives) = match definition {
            Definition::Shared(id) => {
                let name = expressions.names.get(id).unwrap_or_default().to_owned();
                (name, expressions.alternatives(id, None))
            }
            Definition::Net {
                signal,
                id,
                computed,
            } => {
                let index = expressions.index(signal);
                let value = match computed || matches!(module.nodes[id].0, Node::Constant(_)) {
                    true => expressions.alternatives(id, index),
                    false => vec![expressions.value(id)],
                };
                (expressions.scope.own(&signal.name), value)
            }
        };
        for line in assignment(&target, &alternatives, 1) {
            body.raw(&line);
        }
    }
    body.space();
}
