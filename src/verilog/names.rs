use crate::netlist::{Assertion, Id, Kind, Module, Node, Operator, Port, Role};
use std::collections::{HashMap, HashSet};

/// Names longer than this say less than a number.
const LONGEST: usize = 28;

/// Names of a module's nodes in its text.
pub(super) struct Names {
    /// The names of nodes: signals, ports of instances, nets, shared subexpressions.
    of: HashMap<Id, String>,
    /// The nodes that are called after no signal, in their order.
    pub(super) shared: Vec<Id>,
    /// The names that are in use in the module.
    taken: HashSet<String>,
}

impl Names {
    /// Names the nodes of `module`; `modules` are those that it may contain.
    pub(super) fn new(module: &Module, modules: &[Module]) -> Self {
        let mut names = Names::of_signals(module, modules, str::to_owned);
        for signal in &module.signals {
            let Some(driver) = signal.driver.filter(|_| signal.role == Role::Net) else {
                continue;
            };
            let own = match module.nodes[driver].0 {
                Node::Constant(_) => false,
                // A port out is assigned from what an instance drives: Icarus gives a net that is both
                // an output and an instance's input two drivers in VHDL.
                Node::Signal(_) | Node::Port { .. } if signal.is_port() => false,
                Node::Signal(read) => module.signals[read].owner.is_some(),
                Node::Port { .. } => true,
                _ => !names.of.contains_key(&driver),
            };
            let renamed = names.of.get(&driver).is_some_and(|name| {
                let mut own = module
                    .signals
                    .iter()
                    .filter(|signal| signal.owner.is_none());
                own.any(|signal| signal.name == *name)
            });
            if own && !renamed {
                names.of.insert(driver, signal.name.clone());
            }
        }
        names.share(module);
        names
    }

    /// Returns names for a text that shows `module` beside the modules inside it: an instance's
    /// output keeps its name there. `shown` formats a name.
    pub(super) fn of_parts(
        module: &Module,
        modules: &[Module],
        shown: impl Fn(&str) -> String,
    ) -> Self {
        let mut names = Names::of_signals(module, modules, &shown);
        for signal in &module.signals {
            let computed = |id: &Id| !matches!(module.nodes[*id].0, Node::Constant(_));
            if let Some(driver) = signal.driver.filter(computed)
                && signal.role == Role::Net
            {
                let name = names.of.entry(driver);
                name.or_insert_with(|| shown(&signal.name));
            }
        }
        names.share(module);
        names
    }

    /// Only ports in, registers and ports of instances have names.
    fn of_signals(module: &Module, modules: &[Module], shown: impl Fn(&str) -> String) -> Self {
        let mut names = Names {
            of: HashMap::new(),
            shared: Vec::new(),
            taken: reserved(module, modules).collect(),
        };
        for (id, (node, _)) in module.nodes.iter().enumerate() {
            let name = match *node {
                Node::Signal(signal) => signal_name(module, modules, signal),
                Node::Port { instance, leaf } => port_name(module, modules, instance, leaf),
                _ => None,
            };
            if let Some(name) = name {
                names.of.insert(id, shown(&name));
            }
        }
        names
    }

    /// The name of a node, if it has one.
    pub(super) fn get(&self, id: Id) -> Option<&str> {
        self.of.get(&id).map(String::as_str)
    }

    /// Names what is used more than once, and what Verilog takes no part of without a name.
    fn share(&mut self, module: &Module) {
        let live = module.live();
        let (mut uses, mut parts) = self.uses(module, &live);
        for root in module.roots() {
            uses[root] += 1;
        }
        for memory in &module.memories {
            if let Port::Ram { address, .. } = memory.port {
                parts[address] |= !self.is_index(module, address);
            }
        }
        self.share_of(module, &live, (&uses, &parts), "net");
    }

    /// Names what Verilog takes no part of without a name in what assertions compute, and, where
    /// there is any, all values of before: wires cannot ask for them.
    pub(super) fn share_in_assertions(&mut self, module: &Module, printed: &[&Assertion]) {
        self.shared.clear();
        let mut read = vec![false; module.nodes.len()];
        for assertion in printed {
            read[assertion.holds] = true;
        }
        for id in (0..read.len()).rev() {
            let (node, _) = module.nodes[id];
            if read[id] && !self.of.contains_key(&id) && !matches!(node, Node::Past(_)) {
                for operand in node.operands() {
                    read[operand] = true;
                }
            }
        }
        let (_, parts) = self.uses(module, &read);
        let unnamed = |id: &usize| parts[*id] && !self.of.contains_key(id);
        if !(0..parts.len()).any(|id| unnamed(&id)) {
            return;
        }
        for (id, (node, _)) in module.nodes.iter().enumerate() {
            if let Node::Past(of) = *node
                && read[id]
            {
                let name = format!("past_{}", self.get(of).unwrap_or("net"));
                let name = self.free(&name.replace('.', "_"));
                self.of.insert(id, name);
                self.shared.push(id);
            }
        }
        self.share_of(module, &read, (&vec![0; read.len()], &parts), "f_value");
    }

    /// Returns how often the nodes that are read use each node, and whether they take parts of it.
    fn uses(&self, module: &Module, read: &[bool]) -> (Vec<usize>, Vec<bool>) {
        let mut uses = vec![0_usize; module.nodes.len()];
        let mut parts = vec![false; module.nodes.len()];
        for (id, (node, shape)) in module.nodes.iter().enumerate() {
            if !read[id] {
                continue;
            }
            for operand in node.operands() {
                uses[operand] += 1;
            }
            match *node {
                Node::Slice(of, low) => parts[of] |= !(low == 0 && self.narrows(module, of)),
                Node::Extend(of) => parts[of] |= shape.kind == Kind::Signed,
                Node::Read(memory, address) => {
                    let fits =
                        index_width(module.memories[memory].words) == module.nodes[address].1.width;
                    parts[address] |= !fits && !self.narrows(module, address);
                    parts[address] |= !self.is_index(module, address);
                }
                _ => {}
            }
        }
        (uses, parts)
    }

    /// Names, of what is read, what is used more than once, and that of which parts are taken.
    fn share_of(
        &mut self,
        module: &Module,
        read: &[bool],
        (uses, parts): (&[usize], &[bool]),
        fallback: &str,
    ) {
        for id in 0..module.nodes.len() {
            let (node, _) = module.nodes[id];
            let constant = matches!(node, Node::Constant(_) | Node::Parameter(_));
            if !read[id] || self.of.contains_key(&id) || constant {
                continue;
            }
            if parts[id] || uses[id] > 1 && !self.is_plain(module, id) {
                let name = self.describe(module, id);
                let name = self.free(&name.unwrap_or_else(|| fallback.to_owned()));
                self.of.insert(id, name);
                self.shared.push(id);
            }
        }
    }

    /// Returns true if the low bits of a node can be written without a name for the whole.
    pub(super) fn narrows(&self, module: &Module, id: Id) -> bool {
        if self.of.contains_key(&id) {
            return true;
        }
        match module.nodes[id].0 {
            Node::Constant(_) => true,
            Node::Binary(Operator::Equal | Operator::Below, ..) => false,
            Node::Binary(_, a, b) | Node::Mux(_, a, b) => {
                self.narrows(module, a) && self.narrows(module, b)
            }
            Node::Not(a) | Node::Negate(a) | Node::Cast(a) => self.narrows(module, a),
            _ => false,
        }
    }

    /// Returns true if a node can be written as an index. Icarus computes an index in more bits
    /// than its operands have, so an expression that may wrap needs a name.
    fn is_index(&self, module: &Module, id: Id) -> bool {
        let named = |id: Id| self.of.contains_key(&id);
        match module.nodes[id].0 {
            _ if named(id) => true,
            Node::Constant(_) | Node::Parameter(_) | Node::Read(..) | Node::Join(..) => true,
            Node::Cast(a) | Node::Extend(a) => self.is_index(module, a),
            Node::Slice(a, _) => named(a),
            _ => false,
        }
    }

    /// Returns true if a node's text is as short as a name would be.
    fn is_plain(&self, module: &Module, id: Id) -> bool {
        let named =
            |id: Id| self.of.contains_key(&id) || module.nodes[id].0.operands().count() == 0;
        match module.nodes[id].0 {
            Node::Not(a) | Node::Cast(a) | Node::Slice(a, _) | Node::Extend(a) => named(a),
            Node::Binary(Operator::And | Operator::Or, a, b) => {
                module.nodes[id].1.kind == Kind::Bit && named(a) && named(b)
            }
            node => node.operands().count() == 0,
        }
    }

    /// A name that says what is computed, if a short one does.
    fn describe(&self, module: &Module, id: Id) -> Option<String> {
        let word = |id: Id| match (self.get(id), module.nodes[id].0) {
            (Some(name), _) => Some(name.to_owned()),
            (None, Node::Constant(bits)) => Some(bits.to_string()),
            (None, Node::Cast(a)) => self.get(a).map(str::to_owned),
            (None, Node::Not(a)) => self.get(a).map(|name| format!("not_{name}")),
            _ => None,
        };
        let two = |a, between: &str, b| Some(format!("{}_{between}_{}", word(a)?, word(b)?));
        let name = match module.nodes[id].0 {
            Node::Not(a) => format!("not_{}", word(a)?),
            Node::Negate(a) => format!("minus_{}", word(a)?),
            Node::Binary(operator, a, b) => {
                let between = match operator {
                    Operator::Add => "plus",
                    Operator::Subtract => "minus",
                    Operator::Multiply => "times",
                    Operator::And => "and",
                    Operator::Or => "or",
                    Operator::Xor => "xor",
                    Operator::Equal => "is",
                    Operator::Below => "below",
                };
                two(a, between, b)?
            }
            Node::Mux(choose, then, other) => {
                format!("{}_if_{}_else_{}", word(then)?, word(choose)?, word(other)?)
            }
            Node::ShiftLeft(a, by) => format!("{}_up_{by}", word(a)?),
            Node::ShiftRight(a, by) => format!("{}_down_{by}", word(a)?),
            Node::Slice(a, low) => match low + module.nodes[id].1.width - 1 {
                high if high == low => format!("{}_{low}", word(a)?),
                high => format!("{}_{high}_{low}", word(a)?),
            },
            Node::Extend(a) => format!("{}_wide", word(a)?),
            Node::Join(a, b) => two(a, "and", b)?,
            Node::Read(memory, _) => format!("{}_read", module.memories[memory].name),
            _ => return None,
        };
        // Only names of parts have dots.
        let name = name.replace('.', "_");
        (name.len() <= LONGEST && name.starts_with(|c: char| c.is_ascii_alphabetic()))
            .then_some(name)
    }

    /// This name, or one with a number.
    fn free(&mut self, name: &str) -> String {
        let name = if name.is_empty() { "net" } else { name };
        let mut free = name.to_owned();
        let mut number = 1;
        while !self.taken.insert(free.clone()) {
            number += 1;
            free = format!("{name}_{number}");
        }
        free
    }
}

/// Returns the bits of an index into `words` words.
pub(super) fn index_width(words: usize) -> usize {
    words.next_power_of_two().trailing_zeros() as usize
}

/// The name by which a module reads one of its signals.
pub(super) fn signal_name(module: &Module, modules: &[Module], signal: usize) -> Option<String> {
    let signal = &module.signals[signal];
    match signal.owner {
        None => Some(signal.name.clone()),
        Some((instance, inner)) => {
            let child = &module.instances[instance];
            let inner = &modules[child.module].signals[inner];
            inner
                .is_port()
                .then(|| format!("{}_{}", child.name, inner.name))
        }
    }
}

fn port_name(module: &Module, modules: &[Module], instance: usize, leaf: usize) -> Option<String> {
    let child = &module.instances[instance];
    let inside = &modules[child.module];
    let inner = &inside.signals[inside.net(leaf)?];
    inner
        .is_port()
        .then(|| format!("{}_{}", child.name, inner.name))
}

/// The names that a module has for other reasons.
fn reserved(module: &Module, modules: &[Module]) -> impl Iterator<Item = String> {
    let mut names = vec![
        "clk".to_owned(),
        "rst".to_owned(),
        super::unused::UNUSED.to_owned(),
    ];
    for signal in module
        .signals
        .iter()
        .filter(|signal| signal.owner.is_none())
    {
        names.push(signal.name.clone());
        names.extend(signal.behind());
    }
    for memory in &module.memories {
        names.push(memory.name.clone());
        names.extend(memory.loops());
    }
    // A signal with the name of the instance that it is in is hidden by it.
    let around = modules.iter().flat_map(|around| &around.instances);
    let around = around.filter(|child| std::ptr::eq(&modules[child.module], module));
    names.extend(around.map(|child| child.name.clone()));
    for child in &module.instances {
        names.push(child.name.clone());
        for signal in &modules[child.module].signals {
            names.push(format!("{}_{}", child.name, signal.name));
        }
    }
    names.into_iter()
}
