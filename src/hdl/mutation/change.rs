//! Insertion of a fault into a module.

use super::{Change, Mutation, Place, find};
use crate::hdl::{
    build::{Builder, masked},
    elaborate::Nets,
};
use crate::netlist::{BIT, Id, Kind, Module, Node, Operator, Port, Role, Shape, Site};

/// Inserts the fault; returns false if it has no place in this module.
pub(super) fn put(
    mutation: &Mutation,
    builder: &mut Builder,
    nets: &mut Nets,
    modules: &[Module],
) -> bool {
    let change = mutation.change;
    match &mutation.place {
        place @ Place::Node { .. } => {
            let places = find::places(builder);
            let Some(id) = places.iter().position(|other| other == place) else {
                return false;
            };
            rebuild(builder, nets, id, change)
        }
        Place::Signal(name) => {
            let role = match change {
                Change::PowerOn => Role::Register,
                _ => Role::Net,
            };
            let mut signals = builder.signals.iter();
            let at = signals.position(|signal| {
                signal.owner.is_none() && signal.role == role && signal.name == *name
            });
            let Some(at) = at else {
                return false;
            };
            match (change, builder.signals[at].driver) {
                (Change::PowerOn, _) => {
                    builder.signals[at].power_on ^= 1;
                    true
                }
                (_, Some(driver)) => rebuild(builder, nets, driver, change),
                (_, None) => false,
            }
        }
        Place::Memory(name) => {
            let level = u64::from(change == Change::High);
            let to = constant(builder, level, BIT);
            let mut memories = builder.memories.iter_mut();
            let memory = memories.find(|memory| !memory.inner && memory.name == *name);
            match memory.map(|memory| &mut memory.port) {
                Some(Port::Ram { enable, .. } | Port::Shift { enable, .. }) => {
                    *enable = to;
                    true
                }
                _ => false,
            }
        }
        Place::Port(part, port) => {
            let mut instances = builder.instances.iter();
            let Some(instance) = instances.position(|other| other.child.name == *part) else {
                return false;
            };
            let mut ports = find::ports(&builder.instances[instance], modules);
            let Some(at) = ports.position(|other| other == port) else {
                return false;
            };
            let inputs = &builder.instances[instance].child.inputs;
            let (Some(id), next) = (inputs.get(at), inputs.get(at + 1)) else {
                return false;
            };
            let shape = builder.shape(*id);
            match (change, next) {
                (Change::Crossed, None) => return false,
                (Change::Crossed, Some(_)) => {
                    builder.instances[instance].child.inputs.swap(at, at + 1);
                }
                _ => builder.instances[instance].child.inputs[at] = constant(builder, 0, shape),
            }
            true
        }
    }
}

/// Adds a node at the end.
fn add(builder: &mut Builder, node: Node, shape: Shape, site: Site) -> Id {
    builder.nodes.push((node, shape));
    builder.sites.push(site);
    builder.nodes.len() - 1
}

/// Adds a constant at the end.
fn constant(builder: &mut Builder, value: u64, shape: Shape) -> Id {
    let site = builder.site();
    add(builder, Node::Constant(value), shape, site)
}

/// Rebuilds the nodes with another one in place of `at`.
fn rebuild(builder: &mut Builder, nets: &mut Nets, at: Id, change: Change) -> bool {
    let old = std::mem::take(&mut builder.nodes);
    let sites = std::mem::take(&mut builder.sites);
    let mut map: Vec<Id> = Vec::with_capacity(old.len());
    let mut done = false;
    for (id, ((node, shape), site)) in old.into_iter().zip(sites).enumerate() {
        let node = node.map(|id| map[id]);
        let made = match id == at {
            true => other(builder, (node, shape, site), change),
            false => None,
        };
        done |= made.is_some();
        map.push(made.unwrap_or_else(|| add(builder, node, shape, site)));
    }
    renumber(builder, nets, &map);
    done
}

/// Returns the replacement of a node whose operands exist already.
fn other(
    builder: &mut Builder,
    (node, shape, site): (Node, Shape, Site),
    change: Change,
) -> Option<Id> {
    let make = |builder: &mut Builder, node, shape| add(builder, node, shape, site);
    let node = match (change, node) {
        (Change::First, Node::Binary(_, a, _))
        | (Change::Second, Node::Binary(_, _, a))
        | (Change::Plain, Node::Not(a) | Node::Negate(a))
        | (Change::Then, Node::Mux(_, a, _))
        | (Change::Otherwise, Node::Mux(_, _, a)) => return Some(a),
        (Change::Low, _) => Node::Constant(0),
        (Change::Operator, Node::Binary(operator, a, b)) => match operator {
            Operator::Add => Node::Binary(Operator::Subtract, a, b),
            Operator::Subtract | Operator::Multiply => Node::Binary(Operator::Add, a, b),
            Operator::And | Operator::Xor => Node::Binary(Operator::Or, a, b),
            Operator::Or => Node::Binary(Operator::And, a, b),
            // At least.
            Operator::Equal => Node::Not(make(builder, Node::Binary(Operator::Below, a, b), BIT)),
            // At most.
            Operator::Below => Node::Not(make(builder, Node::Binary(Operator::Below, b, a), BIT)),
        },
        (Change::Exchanged, Node::Binary(operator, a, b)) => Node::Binary(operator, b, a),
        (Change::Plain, Node::Extend(of)) => {
            let unsigned = |width| Shape {
                kind: Kind::Unsigned,
                width,
            };
            let width = builder.shape(of).width;
            let plain = make(builder, Node::Cast(of), unsigned(width));
            Node::Cast(make(builder, Node::Extend(plain), unsigned(shape.width)))
        }
        (Change::Priority, Node::Mux(first, then, other)) => {
            let Node::Mux(second, next, last) = builder.nodes[other].0 else {
                return None;
            };
            let inner = make(builder, Node::Mux(first, then, last), shape);
            Node::Mux(second, next, inner)
        }
        (Change::Up, Node::ShiftLeft(a, by)) => Node::ShiftLeft(a, by + 1),
        (Change::Down, Node::ShiftLeft(a, by)) => Node::ShiftLeft(a, by - 1),
        (Change::Up, Node::ShiftRight(a, by)) => Node::ShiftRight(a, by + 1),
        (Change::Down, Node::ShiftRight(a, by)) => Node::ShiftRight(a, by - 1),
        (Change::Up, Node::Slice(a, low)) => Node::Slice(a, low + 1),
        (Change::Down, Node::Slice(a, low)) => Node::Slice(a, low - 1),
        (Change::More(number) | Change::Less(number), node) => {
            let operand = node.operands().nth(number)?;
            let (Node::Constant(bits), of) = builder.nodes[operand] else {
                return None;
            };
            let bits = match change {
                Change::More(_) => bits.wrapping_add(1),
                _ => bits.wrapping_sub(1),
            };
            let constant = make(builder, Node::Constant(masked(bits, of)), of);
            let mut operands = 0..;
            node.map(|id| match operands.next() == Some(number) {
                true => constant,
                false => id,
            })
        }
        _ => return None,
    };
    Some(make(builder, node, shape))
}

/// Renumbers everything that refers to nodes.
fn renumber(builder: &mut Builder, nets: &mut Nets, map: &[Id]) {
    for signal in &mut builder.signals {
        signal.driver = signal.driver.map(|id| map[id]);
    }
    for memory in &mut builder.memories {
        memory.port = memory.port.map(|id| map[id]);
    }
    for instance in &mut builder.instances {
        let inputs = instance.child.inputs.iter_mut();
        for id in inputs.chain(&mut instance.ports) {
            *id = map[*id];
        }
    }
    for id in &mut nets.nodes {
        *id = map[*id];
    }
}
