use super::expression::{Expressions, literal};
use super::names::Names;
use super::statements::{edge, guarded};
use crate::kernel::{Format, Kind, Role, Shape};
use crate::logic::netlist::{Memory, Module, Node, Port, Setting, Signal, Value};
use std::fmt::Write as _;

/// The length of a line, and the room that a comment has at least.
const LINE: usize = 100;
const SHORTEST: usize = 32;

/// What reads the bits that nothing else reads.
pub(super) const UNUSED: &str = "_unused";

/// The room for a definition before it is broken into lines.
const ROOM: usize = 66;

/// The modules of a design, the circuit itself last, and what they are set to.
pub(super) struct Modules<'d> {
    pub(super) modules: &'d [Module],
    pub(super) settings: &'d [Setting],
}

/// A parameter of a module in Verilog.
struct Parameter {
    /// The instances around it, and its name.
    path: Vec<String>,
    /// The width of a number; none for the file that a memory is filled from.
    width: Option<usize>,
}

impl Parameter {
    fn name(&self) -> String {
        self.path.join("_").to_uppercase()
    }

    fn declaration(&self, top: bool, value: u64) -> String {
        let name = self.name();
        match self.width {
            Some(width) => {
                let shape = unsigned(width);
                format!(
                    "parameter {}{name} = {}",
                    range(shape),
                    literal(value, shape)
                )
            }
            None if top => format!("parameter {name} = \"{}.hex\"", self.path.join("_")),
            None => format!("parameter {name} = \"\""),
        }
    }
}

fn unsigned(width: usize) -> Shape {
    Shape {
        kind: Kind::Unsigned,
        width,
    }
}

impl Modules<'_> {
    /// Whether anything in a module is clocked.
    pub(super) fn clocked(&self, module: &Module) -> bool {
        module
            .signals
            .iter()
            .any(|signal| signal.role == Role::Register)
            || module
                .memories
                .iter()
                .any(|memory| memory.port != Port::Rom)
            || module
                .instances
                .iter()
                .any(|child| self.clocked(&self.modules[child.module]))
    }

    /// The memories of a module and of those inside it: path and number of words.
    pub(super) fn memories_within(&self, module: &Module) -> Vec<(String, usize)> {
        let own = module.memories.iter().filter(|memory| !memory.inner);
        let mut memories: Vec<_> = own
            .map(|memory| (memory.name.clone(), memory.words))
            .collect();
        for child in &module.instances {
            for (path, words) in self.memories_within(&self.modules[child.module]) {
                memories.push((format!("{}.{path}", child.name), words));
            }
        }
        memories
    }

    /// The parameters of a module: its own, and what it passes on to those inside it. The
    /// circuit itself passes numbers on as such.
    fn parameters(&self, module: &Module) -> Vec<Parameter> {
        let numbers = module.parameters.iter().map(|parameter| Parameter {
            path: vec![parameter.name.to_owned()],
            width: Some(parameter.width),
        });
        let filled = |memory: &&Memory| memory.filled && !memory.inner;
        let files = module
            .memories
            .iter()
            .filter(filled)
            .map(|memory| Parameter {
                path: vec![memory.name.clone()],
                width: None,
            });
        let mut parameters: Vec<Parameter> = numbers.chain(files).collect();
        for child in &module.instances {
            for mut parameter in self.parameters(&self.modules[child.module]) {
                if parameter.width.is_none() || !self.is_top(module) {
                    parameter.path.insert(0, child.name.clone());
                    parameters.push(parameter);
                }
            }
        }
        parameters
    }

    /// Whether it is the module of the circuit itself.
    fn is_top(&self, module: &Module) -> bool {
        self.modules
            .last()
            .is_some_and(|last| std::ptr::eq(last, module))
    }

    /// The number that a parameter of the circuit itself, or of one inside it, is set to.
    fn number(&self, path: &[String]) -> u64 {
        let setting = self.settings.iter().find(|setting| setting.path == path);
        match setting.map(|setting| &setting.value) {
            Some(Value::Number(number)) => *number,
            _ => 0,
        }
    }

    /// The text of a module.
    pub(super) fn print(&self, module: &Module) -> String {
        let names = Names::new(module, self.modules);
        let expressions = Expressions::new(module, &names);
        let clocked = self.clocked(module);
        let mut text = String::new();
        let _ = writeln!(text, "// {}: {}.", module.name, module.about);
        let _ = writeln!(text, "// Made by motion-rtl from the circuit of that name.");
        text.push('\n');
        text += &self.header(module, clocked);

        let mut body = Body::default();
        self.memories(module, &mut body);
        let inner = module.signals.iter().filter(|signal| !signal.is_port());
        let inner: Vec<&Signal> = inner.filter(|signal| is_own_register(signal)).collect();
        let column = column(inner.iter().map(|signal| signal.shape));
        let registers: Vec<(String, String)> = inner
            .iter()
            .map(|signal| {
                let power_on = literal(signal.power_on, signal.shape);
                let range = format!("{:column$}", range(signal.shape));
                let line = format!("reg  {range}{} = {power_on};", signal.name);
                (line, comment(signal))
            })
            .collect();
        for line in annotated(&registers) {
            body.line(&line);
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
        self.unused(module, &expressions, &outputs, clocked, &mut body);
        text += &body.finish();
        text += &self.assertions(module);
        text + "endmodule\n"
    }

    /// Parameters and ports.
    fn header(&self, module: &Module, clocked: bool) -> String {
        let mut text = format!("module {} ", module.name);
        let parameters = self.parameters(module);
        match parameters.is_empty() {
            true => text += "(\n",
            false => {
                let lines: Vec<String> = parameters
                    .iter()
                    .map(|parameter| {
                        let top = self.is_top(module);
                        let value = if top { self.number(&parameter.path) } else { 0 };
                        format!("    {}", parameter.declaration(top, value))
                    })
                    .collect();
                let _ = writeln!(text, "#(\n{}\n) (", lines.join(",\n"));
            }
        }
        let mut ports = Vec::new();
        let signals = module.signals.iter().filter(|signal| signal.is_port());
        let column = column(signals.map(|signal| signal.shape));
        if clocked {
            ports.push((format!("input  wire {:column$}clk", ""), String::new()));
            let about = "Registers to their power-on values; memories stay.";
            ports.push((format!("input  wire {:column$}rst", ""), about.to_owned()));
        }
        for signal in module.signals.iter().filter(|signal| signal.is_port()) {
            let Signal { name, shape, .. } = signal;
            let range = format!("{:column$}", range(*shape));
            let port = match signal.role {
                Role::Input => format!("input  wire {range}{name}"),
                Role::Net => format!("output wire {range}{name}"),
                Role::Register => {
                    let power_on = literal(signal.power_on, *shape);
                    format!("output reg  {range}{name} = {power_on}")
                }
            };
            ports.push((port, comment(signal)));
        }
        let last = ports.len().saturating_sub(1);
        for (index, (port, _)) in ports.iter_mut().enumerate() {
            if index != last {
                port.push(',');
            }
        }
        for line in annotated(&ports) {
            let _ = writeln!(text, "    {line}");
        }
        text + ");\n\n"
    }

    /// Declarations and contents of memories.
    fn memories(&self, module: &Module, body: &mut Body) {
        for memory in module.memories.iter().filter(|memory| !memory.inner) {
            let shape = unsigned(memory.width);
            body.comment(&clean(memory.doc));
            let last = memory.words - 1;
            // Words of one bit have a range too: without it, dumps mistake them for a vector.
            let range = match memory.width {
                1 => "[0:0] ".to_owned(),
                _ => range(shape),
            };
            body.line(&format!("reg  {range}{} [0:{last}];", memory.name));
            match memory.filled {
                true => {
                    let file = memory.name.to_uppercase();
                    body.line("generate");
                    body.line(&format!("    if ({file} != \"\")"));
                    body.line(&format!(
                        "        initial $readmemh({file}, {});",
                        memory.name
                    ));
                    body.line("endgenerate");
                }
                false => {
                    let zero = literal(0, shape);
                    body.line(&format!("integer {}_word;", memory.name));
                    body.line("initial");
                    body.line(&format!(
                        "    for ({0}_word = 0; {0}_word < {1}; {0}_word = {0}_word + 1)",
                        memory.name, memory.words
                    ));
                    body.line(&format!("        {0}[{0}_word] = {zero};", memory.name));
                }
            }
            body.space();
        }
    }

    /// The wires that the ports out of instances drive.
    fn outputs(&self, module: &Module, names: &Names) -> Outputs {
        let mut outputs = Outputs {
            wires: Vec::new(),
            connections: Vec::new(),
        };
        for (index, child) in module.instances.iter().enumerate() {
            let inside = &self.modules[child.module];
            let mut connections = Vec::new();
            for (inner, signal) in inside.signals.iter().enumerate() {
                if signal.role == Role::Input || !signal.is_port() {
                    continue;
                }
                let name = module.nodes.iter().enumerate().find_map(|(id, (node, _))| {
                    let here = match *node {
                        Node::Signal(own) => module.signals[own].owner == Some((index, inner)),
                        Node::Port { instance, leaf } => {
                            instance == index && inside.net(leaf) == Some(inner)
                        }
                        _ => false,
                    };
                    here.then(|| names.get(id)).flatten().map(str::to_owned)
                });
                let name = name.unwrap_or_else(|| format!("{}_{}", child.name, signal.name));
                let own = module
                    .signals
                    .iter()
                    .any(|own| own.owner.is_none() && own.name == name);
                let own_wire = own
                    && !module
                        .signals
                        .iter()
                        .any(|own| own.owner.is_none() && own.name == name && own.is_port());
                if !own || own_wire {
                    outputs.wires.push((signal.shape, name.clone()));
                }
                connections.push((signal.name.clone(), name));
            }
            outputs.connections.push(connections);
        }
        outputs
    }

    fn instances(
        &self,
        module: &Module,
        expressions: &Expressions<'_>,
        outputs: &Outputs,
        body: &mut Body,
    ) {
        for (child, outputs) in module.instances.iter().zip(&outputs.connections) {
            let inside = &self.modules[child.module];
            let mut connections = Vec::new();
            if self.clocked(inside) {
                connections.push(("clk".to_owned(), "clk".to_owned()));
                connections.push(("rst".to_owned(), "rst".to_owned()));
            }
            let inputs = inside
                .signals
                .iter()
                .filter(|signal| signal.role == Role::Input);
            for (signal, driver) in inputs.zip(&child.inputs) {
                connections.push((signal.name.clone(), expressions.value(*driver)));
            }
            connections.extend(outputs.iter().cloned());
            let parameters: Vec<String> = self
                .parameters(inside)
                .iter()
                .map(|parameter| {
                    let name = parameter.name();
                    let value = match parameter.width.filter(|_| self.is_top(module)) {
                        Some(width) => {
                            let mut path = parameter.path.clone();
                            path.insert(0, child.name.clone());
                            literal(self.number(&path), unsigned(width))
                        }
                        None => format!("{}_{name}", child.name.to_uppercase()),
                    };
                    format!("        .{name}({value})")
                })
                .collect();
            match parameters.is_empty() {
                true => body.line(&format!("{} {} (", inside.name, child.name)),
                false => {
                    body.line(&format!("{} #(", inside.name));
                    body.raw(&parameters.join(",\n"));
                    body.line(&format!(") {} (", child.name));
                }
            }
            let width = connections
                .iter()
                .map(|(port, _)| port.len())
                .max()
                .unwrap_or(0);
            let lines: Vec<String> = connections
                .iter()
                .map(|(port, value)| format!("        .{port:width$} ({value})"))
                .collect();
            body.raw(&lines.join(",\n"));
            body.line(");");
            body.space();
        }
    }

    /// A wire that reads what nothing else does, so that a linter stays quiet about it alone.
    fn unused(
        &self,
        module: &Module,
        expressions: &Expressions<'_>,
        outputs: &Outputs,
        clocked: bool,
        body: &mut Body,
    ) {
        let mut unread = Vec::new();
        let resets = module.signals.iter().any(is_own_register);
        if clocked && !resets && module.instances.is_empty() {
            unread.push("rst".to_owned());
        }
        let own = module
            .signals
            .iter()
            .filter(|signal| signal.owner.is_none());
        let hidden = own.filter(|signal| signal.role == Role::Input || !signal.is_port());
        let declared = hidden.map(|signal| (signal.shape, signal.name.clone()));
        let shared = expressions.names.shared.iter().filter_map(|id| {
            let name = expressions.names.get(*id)?;
            Some((module.nodes[*id].1, name.to_owned()))
        });
        let mut seen = std::collections::HashSet::new();
        for (shape, name) in declared.chain(outputs.wires.iter().cloned()).chain(shared) {
            if seen.insert(name.clone()) {
                unread.extend(parts_unread(
                    shape.width,
                    &name,
                    expressions.bits_read(&name),
                ));
            }
        }
        if !unread.is_empty() {
            body.comment("Read by nothing here: for the waves, or bits that are not needed.");
            let mut line = format!("wire {UNUSED} = &{{1'b0");
            for part in unread {
                line.push(',');
                if line.len() + part.len() + 4 > LINE {
                    body.line(&line);
                    line = "       ".to_owned();
                }
                line.push(' ');
                line += &part;
            }
            body.line(&(line + "};"));
            body.space();
        }
    }
}

/// How the ports out of instances are connected.
struct Outputs {
    /// Wires to declare.
    wires: Vec<(Shape, String)>,
    /// For every instance its ports out and what they drive.
    connections: Vec<Vec<(String, String)>>,
}

pub(super) fn is_own_register(signal: &Signal) -> bool {
    signal.role == Role::Register && signal.owner.is_none()
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

/// What happens at the rising edge.
fn clock(module: &Module, expressions: &Expressions<'_>, body: &mut Body) {
    for (index, memory) in module
        .memories
        .iter()
        .enumerate()
        .filter(|(_, memory)| !memory.inner)
    {
        if let Some((condition, write)) = expressions.port(index) {
            body.line("always @(posedge clk)");
            for line in guarded(condition, write, 1) {
                body.line(&line);
            }
            body.space();
        }
        if let Port::Shift { enable, data } = memory.port {
            let name = &memory.name;
            let condition = match module.nodes[enable].0 {
                Node::Constant(0) => continue,
                Node::Constant(_) => None,
                _ => Some(expressions.value(enable)),
            };
            body.line("always @(posedge clk)");
            let first = format!("{name}[0] <= {};", expressions.value(data));
            for line in guarded(condition.clone(), first, 1) {
                body.line(&line);
            }
            if memory.words > 1 {
                body.line("generate");
                body.line(&format!("    genvar {name}_to;"));
                body.line(&format!(
                    "    for ({name}_to = 1; {name}_to < {}; {name}_to = {name}_to + 1) begin : {name}_shift",
                    memory.words
                ));
                body.line("        always @(posedge clk)");
                let next = format!("{name}[{name}_to] <= {name}[{name}_to - 1];");
                for line in guarded(condition, next, 3) {
                    body.line(&line);
                }
                body.line("    end");
                body.line("endgenerate");
            }
            body.space();
        }
    }
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

/// The bits of a name that nothing reads.
fn parts_unread(width: usize, name: &str, read: u64) -> Vec<String> {
    let unread = |bit: usize| read >> bit & 1 == 0;
    let mut parts = Vec::new();
    let mut bit = 0;
    while bit < width {
        if !unread(bit) {
            bit += 1;
            continue;
        }
        let first = bit;
        while bit < width && unread(bit) {
            bit += 1;
        }
        parts.push(match (first, bit - first) {
            (0, all) if all == width => name.to_owned(),
            (first, 1) => format!("{name}[{first}]"),
            (first, _) => format!("{name}[{}:{first}]", bit - 1),
        });
    }
    parts
}

/// `signed` and the range of a word, with a space behind.
fn range(shape: Shape) -> String {
    let signed = if shape.kind == Kind::Signed {
        "signed "
    } else {
        ""
    };
    match shape.width {
        1 => signed.to_owned(),
        width => format!("{signed}[{}:0] ", width - 1),
    }
}

/// The room that the ranges of such words take.
fn column(shapes: impl Iterator<Item = Shape>) -> usize {
    shapes.map(|shape| range(shape).len()).max().unwrap_or(0)
}

/// Lines with comments behind them, in a column of their own.
fn annotated(lines: &[(String, String)]) -> Vec<String> {
    let width = lines.iter().map(|(line, _)| line.len()).max().unwrap_or(0) + 1;
    let room = LINE.saturating_sub(width + 3).max(SHORTEST);
    let mut annotated = Vec::new();
    for (line, comment) in lines {
        let mut start = line.as_str();
        let mut text = String::new();
        for word in comment.split(' ').filter(|word| !word.is_empty()) {
            if !text.is_empty() && text.len() + 1 + word.len() > room {
                annotated.push(format!("{start:width$}//{text}"));
                (start, text) = ("", String::new());
            }
            text.push(' ');
            text.push_str(word);
        }
        annotated.push(match text.is_empty() {
            true => start.to_owned(),
            false => format!("{start:width$}//{text}"),
        });
    }
    annotated
}

/// What is said of a signal: its doc comment and the names of its states.
fn comment(signal: &Signal) -> String {
    let mut comment = clean(signal.field.doc);
    if let Format::States(states) = signal.field.format {
        let states = states
            .iter()
            .enumerate()
            .map(|(value, state)| format!("{value} {state}"));
        let states: Vec<String> = states.collect();
        let _ = write!(comment, " {}.", states.join(", "));
    }
    comment
}

/// A doc comment in one line, without the marks of a link.
fn clean(doc: &str) -> String {
    let words: Vec<&str> = doc.split_whitespace().collect();
    words
        .join(" ")
        .replace("[`", "")
        .replace("`]", "")
        .replace('`', "")
}

/// The lines between the ports and the end.
#[derive(Default)]
struct Body(String);

impl Body {
    fn line(&mut self, line: &str) {
        self.0.push_str("    ");
        self.raw(line);
    }

    fn raw(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    fn comment(&mut self, comment: &str) {
        if !comment.is_empty() {
            self.line(&format!("// {comment}"));
        }
    }

    fn described(&mut self, signal: &Signal, line: &str) {
        self.comment(&comment(signal));
        self.line(line);
    }

    /// One empty line, if something stands before it.
    fn space(&mut self) {
        if !self.0.is_empty() && !self.0.ends_with("\n\n") {
            self.0.push('\n');
        }
    }

    fn finish(mut self) -> String {
        self.space();
        self.0
    }
}
