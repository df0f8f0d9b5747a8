//! Names of a module's nodes.

use crate::netlist::{Id, Kind, Module, Node, Operator, Role, Signal};
use std::collections::{HashMap, HashSet};

/// Names longer than this say less than a number.
const LONGEST: usize = 28;

/// Function that returns the nodes that a language does not take without a name. Gets how often
/// each node is used by nodes, signals, memories and instances that are in use themselves.
pub(crate) type Needs = fn(&Names<'_>, &Module, &[usize]) -> Vec<bool>;

/// Rules of a language for names.
pub(crate) struct Rules<'r> {
    /// Formats the name of a signal.
    pub(crate) shown: &'r dyn Fn(&str) -> String,
    /// Names that no subexpression may have.
    pub(crate) taken: HashSet<String>,
    /// Names of nodes that get a certain name unless a signal shows them.
    pub(crate) given: HashMap<Id, String>,
    /// Finds the nodes that need a name.
    pub(crate) needs: Needs,
    /// Returns the beginning of a name for a node that has no short name.
    pub(crate) fallback: &'r dyn Fn(Id) -> String,
}

/// Names of a module's nodes in its text.
pub(crate) struct Names<'r> {
    /// The names of nodes: signals, ports of instances, nets, shared subexpressions.
    of: HashMap<Id, String>,
    /// The nodes that are called after no signal, in their order.
    pub(crate) shared: Vec<Id>,
    rules: Rules<'r>,
}

impl<'r> Names<'r> {
    /// Names the nodes of `module`; `modules` are those that it may contain.
    pub(crate) fn new(module: &Module, modules: &[Module], rules: Rules<'r>) -> Self {
        let mut names = Names::of_signals(module, modules, rules);
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
                own.any(|signal| names.shown(&signal.name) == *name)
            });
            if own && !renamed {
                let name = names.shown(&signal.name);
                names.of.insert(driver, name);
            }
        }
        names.share(module);
        names
    }

    /// Returns names for a text that shows `module` beside the modules inside it: an instance's
    /// output keeps its name there.
    pub(crate) fn of_parts(module: &Module, modules: &[Module], rules: Rules<'r>) -> Self {
        let mut names = Names::of_signals(module, modules, rules);
        for signal in &module.signals {
            let computed = |id: &Id| !matches!(module.nodes[*id].0, Node::Constant(_));
            if let Some(driver) = signal.driver.filter(computed)
                && signal.role == Role::Net
            {
                let shown = names.shown(&signal.name);
                names.of.entry(driver).or_insert(shown);
            }
        }
        names.share(module);
        names
    }

    /// Only ports in, registers and ports of instances have names.
    fn of_signals(module: &Module, modules: &[Module], rules: Rules<'r>) -> Self {
        let mut names = Names {
            of: HashMap::new(),
            shared: Vec::new(),
            rules,
        };
        for (id, (node, _)) in module.nodes.iter().enumerate() {
            let name = match *node {
                Node::Signal(signal) => signal_name(module, modules, signal),
                Node::Port { instance, leaf } => port_name(module, modules, instance, leaf),
                _ => None,
            };
            if let Some(name) = name {
                let name = names.shown(&name);
                names.of.insert(id, name);
            }
        }
        names
    }

    /// Returns the name of a signal in the text.
    pub(crate) fn shown(&self, name: &str) -> String {
        (self.rules.shown)(name)
    }

    /// True if the expressions of the module read a node by the name of this net.
    pub(crate) fn is_net(&self, id: Id, net: &Signal) -> bool {
        self.get(id) == Some(&*self.shown(&net.name))
    }

    /// The name of a node, if it has one.
    pub(crate) fn get(&self, id: Id) -> Option<&str> {
        self.of.get(&id).map(String::as_str)
    }

    /// Names what is used more than once, and what the language does not take without a name.
    fn share(&mut self, module: &Module) {
        let live = module.live();
        let mut uses = self.uses(module, &live);
        for root in module.roots() {
            uses[root] += 1;
        }
        let needed = (self.rules.needs)(self, module, &uses);
        let fallback = self.rules.fallback;
        self.share_of(module, &live, (&uses, &needed), fallback);
    }

    /// Returns how often the nodes that are read use each node.
    fn uses(&self, module: &Module, read: &[bool]) -> Vec<usize> {
        let mut uses = vec![0_usize; module.nodes.len()];
        for (id, (node, _)) in module.nodes.iter().enumerate() {
            for operand in node.operands().filter(|_| read[id]) {
                uses[operand] += 1;
            }
        }
        uses
    }

    /// Names, of what is read, what is used more than once, and what is needed.
    pub(crate) fn share_of(
        &mut self,
        module: &Module,
        read: &[bool],
        (uses, needed): (&[usize], &[bool]),
        fallback: &dyn Fn(Id) -> String,
    ) {
        for id in 0..module.nodes.len() {
            let (node, _) = module.nodes[id];
            let constant = matches!(node, Node::Constant(_) | Node::Parameter(_));
            if !read[id] || self.of.contains_key(&id) || constant {
                continue;
            }
            if needed[id] || uses[id] > 1 && !self.is_plain(module, id) {
                let name = match self.rules.given.get(&id) {
                    Some(name) => name.clone(),
                    None => {
                        let name = self.describe(module, id);
                        let name = name.unwrap_or_else(|| fallback(id));
                        self.free(&name)
                    }
                };
                self.of.insert(id, name);
                self.shared.push(id);
            }
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

    /// Gives a node a name.
    pub(crate) fn insert(&mut self, id: Id, name: String) {
        self.of.insert(id, name);
    }

    /// Returns this name, or one with a number, and keeps it from others. A name that differs in
    /// the case of letters only is taken too.
    pub(crate) fn free(&mut self, name: &str) -> String {
        let name = if name.is_empty() { "net" } else { name };
        let mut free = name.to_owned();
        let mut number = 1;
        while !self.rules.taken.insert(free.to_ascii_lowercase()) {
            number += 1;
            free = format!("{name}_{number}");
        }
        free
    }
}

/// Returns the bits of an index into `words` words.
pub(crate) fn index_width(words: usize) -> usize {
    words.next_power_of_two().trailing_zeros() as usize
}

/// The name by which a module reads one of its signals.
fn signal_name(module: &Module, modules: &[Module], signal: usize) -> Option<String> {
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

/// Returns the names that a module has for other reasons.
pub(crate) fn reserved(module: &Module, modules: &[Module]) -> Vec<String> {
    let mut names = vec!["clk".to_owned(), "rst".to_owned()];
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
    names
}
