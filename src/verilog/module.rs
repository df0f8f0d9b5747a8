use super::conversion::literal;
use super::design::Modules;
use super::expression::Expressions;
use super::memories::{memories, write_memories};
use super::names::Names;
use super::statements::edge;
use super::text::{Body, annotated, ascii, column, comment, range};
use super::unused::unused;
use crate::netlist::{Module, Node, Role, Signal};
use std::fmt::Write as _;

/// The room for a definition before it is broken into lines.
const ROOM: usize = 66;

impl Modules<'_> {
    /// The text of a module.
    pub(super) fn print(&self, module: &Module) -> String {
        let names = Names::new(module, self.modules);
        let expressions = Expressions::new(module, &names);
        let clocked = self.clocked(module);
        let mut text = String::new();
        let _ = writeln!(text, "// {}: {}.", module.name, ascii(module.about));
        let _ = writeln!(text, "// Made by motion-rtl from the circuit of that name.");
        text.push('\n');
        text += &self.header(module, clocked);

        let mut body = Body::default();
        memories(module, &mut body);
        let inner = module
            .signals
            .iter()
            .filter(|signal| is_own_register(signal));
        let inner: Vec<&Signal> = inner.collect();
        let column = column(inner.iter().map(|signal| signal.shape));
        let registers: Vec<(String, String)> = inner
            .iter()
            .map(|signal| {
                let power_on = literal(signal.power_on, signal.shape);
                let range = format!("{:column$}", range(signal.shape));
                // A port is described where it stands.
                let comment = match signal.is_port() {
                    true => String::new(),
                    false => comment(signal),
                };
                (
                    format!("reg  {range}{} = {power_on};", stored(signal)),
                    comment,
                )
            })
            .collect();
        for line in annotated(&registers) {
            body.line(&line);
        }
        for (signal, behind) in inner.iter().filter_map(|one| Some((one, one.behind()?))) {
            body.line(&format!("assign {} = {behind};", signal.name));
        }
        body.space();
        let outputs = self.outputs(module, &names);
        let column = self::column(outputs.wires.iter().map(|(shape, _)| *shape));
        for (shape, name) in &outputs.wires {
            body.line(&format!("wire {:column$}{name};", range(*shape)));
        }
        body.space();
        definitions(module, &expressions, &mut body);
        self.instances(module, &expressions, &outputs, &mut body);
        clock(module, &expressions, &mut body);
        unused(module, &expressions, &outputs, clocked, &mut body);
        text += &body.finish();
        text += &self.assertions(module);
        text + "endmodule\n"
    }
}

pub(super) fn is_own_register(signal: &Signal) -> bool {
    signal.role == Role::Register && signal.owner.is_none()
}

/// Name of a register: that of its port is a wire.
pub(super) fn stored(signal: &Signal) -> String {
    signal.behind().unwrap_or_else(|| signal.name.clone())
}

/// Nets and shared subexpressions, each after what it reads.
fn definitions(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    let mut done = vec![false; module.signals.len()];
    let nets = |id: usize| {
        let nets = module.signals.iter().enumerate();
        nets.filter(move |(_, signal)| signal.role == Role::Net && signal.driver == Some(id))
    };
    for id in 0..module.nodes.len() {
        let name = expressions.names.get(id).map(str::to_owned);
        if expressions.names.shared.contains(&id) {
            let name = name.clone().unwrap_or_default();
            let shape = module.nodes[id].1;
            let start = format!("wire {}{name} = ", range(shape));
            let definition = expressions.definition(id, ROOM, "            ");
            body.line(&format!("{start}{definition};"));
        }
        for (index, signal) in nets(id) {
            if std::mem::replace(&mut done[index], true) {
                continue;
            }
            let first = name.as_deref() == Some(&signal.name);
            // An instance drives it by its port.
            if first && matches!(module.nodes[id].0, Node::Port { .. } | Node::Signal(_)) {
                continue;
            }
            let value = match first {
                true => expressions.definition(id, ROOM, "            "),
                false => expressions.value(id),
            };
            let start = match signal.is_port() {
                true => format!("assign {}", signal.name),
                false => format!("wire {}{}", range(signal.shape), signal.name),
            };
            match signal.is_port() {
                true => body.line(&format!("{start} = {value};")),
                false => body.described(signal, &format!("{start} = {value};")),
            }
        }
    }
    body.space();
}

/// Adds the statements at the rising edge.
fn clock(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    write_memories(module, expressions, body);
    let lines = edge(module, expressions, 1);
    if lines.is_empty() {
        return;
    }
    body.line("always @(posedge clk)");
    for line in lines {
        body.line(&line);
    }
    body.space();
}
