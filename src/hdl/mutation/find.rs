//! Search for the possible faults of a module.

use super::{Change, Mutation, Place};
use crate::hdl::{
    build::{Builder, Instance},
    elaborate::Nets,
};
use crate::netlist::{Id, Kind, Module, Node, Operator, Port, Register, Role, live};
use std::collections::HashMap;

/// Returns all faults of a module.
pub(super) fn all(
    circuit: &str,
    builder: &Builder,
    nets: &Nets,
    modules: &[Module],
) -> Vec<Mutation> {
    let mut found = Vec::new();
    let mut add = |place: &Place, change| {
        found.push(Mutation {
            circuit: circuit.to_owned(),
            place: place.clone(),
            change,
        });
    };
    let driving = driving(builder, nets);
    for (id, place) in places(builder).into_iter().enumerate() {
        if driving[id] {
            for change in of_node(builder, id) {
                add(&place, change);
            }
        }
    }
    for register in &builder.registers[..builder.own] {
        match register {
            Register::Signal(signal) => {
                let name = builder.signals[*signal].name.clone();
                add(&Place::Signal(name), Change::PowerOn);
            }
            Register::Memory(memory) => {
                let memory = &builder.memories[*memory];
                let place = Place::Memory(memory.name.clone());
                if !matches!(memory.port, Port::Rom) {
                    add(&place, Change::Low);
                    add(&place, Change::High);
                }
            }
        }
    }
    for signal in &builder.signals {
        let driver = signal.driver.map(|driver| builder.nodes[driver].0);
        let constant = matches!(driver, Some(Node::Constant(_)));
        if signal.role == Role::Net && signal.owner.is_none() && !constant {
            add(&Place::Signal(signal.name.clone()), Change::Low);
        }
    }
    for instance in &builder.instances {
        let inputs = &instance.child.inputs;
        for (at, (port, id)) in ports(instance, modules).zip(inputs).enumerate() {
            let place = Place::Port(instance.child.name.clone(), port.to_owned());
            if !matches!(builder.nodes[*id].0, Node::Constant(0)) {
                add(&place, Change::Low);
            }
            let next = inputs.get(at + 1);
            if next.is_some_and(|next| next != id && builder.shape(*next) == builder.shape(*id)) {
                add(&place, Change::Crossed);
            }
        }
    }
    found
}

/// Returns the input ports of a part.
pub(super) fn ports<'m>(
    part: &Instance,
    modules: &'m [Module],
) -> impl Iterator<Item = &'m str> + use<'m> {
    let module = modules.get(part.child.module);
    let inputs = module.into_iter().flat_map(Module::inputs);
    inputs.map(|input| input.name.as_str())
}

/// Returns for each node if it drives something.
fn driving(builder: &Builder, nets: &Nets) -> Vec<bool> {
    let drivers = builder.signals.iter().filter_map(|signal| signal.driver);
    let memories = builder.memories.iter();
    let memories = memories.flat_map(|memory| memory.port.operands());
    let instances = builder.instances.iter();
    let inputs = instances.flat_map(|instance| &instance.child.inputs);
    let others = inputs.chain(&nets.nodes).copied();
    live(&builder.nodes, drivers.chain(memories).chain(others))
}

/// Returns the place of each node.
pub(super) fn places(builder: &Builder) -> Vec<Place> {
    let mut counts = HashMap::new();
    let nodes = builder.nodes.iter().zip(&builder.sites);
    nodes
        .map(|((node, _), site)| {
            let kind = kind(*node);
            let count = counts.entry((*site, kind)).or_insert(0);
            *count += 1;
            Place::Node {
                site: *site,
                kind,
                nth: *count - 1,
            }
        })
        .collect()
}

fn kind(node: Node) -> &'static str {
    match node {
        Node::Constant(_) => "constant",
        Node::Parameter(_) => "parameter",
        Node::Signal(_) => "signal",
        Node::Port { .. } => "net of a part",
        Node::Not(_) => "not",
        Node::Negate(_) => "negation",
        Node::Binary(operator, ..) => match operator {
            Operator::Add => "sum",
            Operator::Subtract => "difference",
            Operator::Multiply => "product",
            Operator::And => "and",
            Operator::Or => "or",
            Operator::Xor => "exclusive or",
            Operator::Equal => "equal",
            Operator::Below => "below",
        },
        Node::Mux(..) => "choice",
        Node::ShiftLeft(..) => "shift up",
        Node::ShiftRight(..) => "shift down",
        Node::Slice(..) => "slice",
        Node::Extend(_) => "extension",
        Node::Join(..) => "concatenation",
        Node::Cast(_) => "cast",
        Node::Past(_) => "past",
        Node::Read(..) => "word read",
    }
}

/// Returns the possible faults of a node.
fn of_node(builder: &Builder, id: Id) -> Vec<Change> {
    let (node, _) = builder.nodes[id];
    let constant = |id: Id| matches!(builder.nodes[id].0, Node::Constant(_));
    let mut changes = match node {
        Node::Not(_) | Node::Negate(_) => vec![Change::Plain],
        Node::Extend(of) if builder.shape(of).kind == Kind::Signed => vec![Change::Plain],
        Node::Binary(operator, a, b) => match operator {
            Operator::Add | Operator::Multiply | Operator::Equal => vec![Change::Operator],
            Operator::Subtract | Operator::Below => vec![Change::Operator, Change::Exchanged],
            Operator::And | Operator::Or | Operator::Xor if constant(a) || constant(b) => {
                vec![Change::Operator]
            }
            Operator::And | Operator::Or | Operator::Xor => {
                vec![Change::Operator, Change::First, Change::Second]
            }
        },
        Node::Mux(_, then, other) => {
            let mut changes = vec![Change::Then, Change::Otherwise];
            // If the next choice takes the same word, the order makes no difference.
            if let Node::Mux(_, next, _) = builder.nodes[other].0
                && next != then
            {
                changes.push(Change::Priority);
            }
            changes
        }
        Node::ShiftLeft(_, by) | Node::ShiftRight(_, by) => {
            let mut changes = vec![Change::Down];
            if by + 1 < builder.shape(id).width {
                changes.push(Change::Up);
            }
            changes
        }
        Node::Slice(of, low) => {
            let (from, to) = (builder.shape(of).width, builder.shape(id).width);
            let mut changes = Vec::new();
            if low + to < from {
                changes.push(Change::Up);
            }
            if low > 0 {
                changes.push(Change::Down);
            }
            changes
        }
        _ => Vec::new(),
    };
    for (number, operand) in node.operands().enumerate() {
        if constant(operand) && !matches!(node, Node::Cast(_) | Node::Extend(_)) {
            changes.push(Change::More(number));
            if builder.shape(operand).kind != Kind::Bit {
                changes.push(Change::Less(number));
            }
        }
    }
    changes
}
