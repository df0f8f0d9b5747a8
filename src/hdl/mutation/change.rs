//! A fault put into a module.

use super::{Change, Mutation, Place, find};
use crate::hdl::build::{Builder, masked};
use crate::hdl::elaborate::Nets;
use crate::hdl::netlist::{Id, Module, Node, Operator, Port};
use crate::hdl::record::BIT;
use crate::hdl::{Kind, Role, Shape};

/// Puts it in; says whether it has a place there.
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
            let own = |role| move |role_of: Role| role == role_of;
            let of = match change {
                Change::PowerOn => own(Role::Register),
                _ => own(Role::Net),
            };
            let mut signals = builder.signals.iter();
            let at = signals.position(|signal| {
                signal.owner.is_none() && of(signal.role) && signal.name == *name
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

/// A new constant at the end.
fn constant(builder: &mut Builder, value: u64, shape: Shape) -> Id {
    builder.nodes.push((Node::Constant(value), shape));
    builder.sites.push(builder.site());
    builder.nodes.len() - 1
}

/// The nodes made anew, with another one in place of `at`.
fn rebuild(builder: &mut Builder, nets: &mut Nets, at: Id, change: Change) -> bool {
    let old = std::mem::take(&mut builder.nodes);
    let sites = std::mem::take(&mut builder.sites);
    let mut map: Vec<Id> = Vec::with_capacity(old.len());
    let mut done = false;
    for (id, ((node, shape), site)) in old.into_iter().zip(sites).enumerate() {
        let node = node.map(|id| map[id]);
        let mut made = None;
        if id == at {
            made = other(builder, node, shape, change);
            done = made.is_some();
            // What was made on the way came from here too.
            builder.sites.resize(builder.nodes.len(), site);
        }
        map.push(made.unwrap_or_else(|| {
            builder.nodes.push((node, shape));
            builder.sites.push(site);
            builder.nodes.len() - 1
        }));
    }
    renumber(builder, nets, &map);
    done
}

/// What stands in place of a node, of which the operands are there already.
fn other(builder: &mut Builder, node: Node, shape: Shape, change: Change) -> Option<Id> {
    let mut make = |node, shape| {
        builder.nodes.push((node, shape));
        builder.nodes.len() - 1
    };
    Some(match (change, node) {
        (Change::Low, _) => make(Node::Constant(0), shape),
        (Change::Operator, Node::Binary(operator, a, b)) => {
            let binary = |operator| Node::Binary(operator, a, b);
            match operator {
                Operator::Add => make(binary(Operator::Subtract), shape),
                Operator::Subtract | Operator::Multiply => make(binary(Operator::Add), shape),
                Operator::And | Operator::Xor => make(binary(Operator::Or), shape),
                Operator::Or => make(binary(Operator::And), shape),
                // At least.
                Operator::Equal => {
                    let below = make(binary(Operator::Below), BIT);
                    make(Node::Not(below), shape)
                }
                // At most.
                Operator::Below => {
                    let above = make(Node::Binary(Operator::Below, b, a), BIT);
                    make(Node::Not(above), shape)
                }
            }
        }
        (Change::Exchanged, Node::Binary(operator, a, b)) => {
            make(Node::Binary(operator, b, a), shape)
        }
        (Change::First, Node::Binary(_, a, _)) => a,
        (Change::Second, Node::Binary(_, _, b)) => b,
        (Change::Plain, Node::Not(a) | Node::Negate(a)) => a,
        (Change::Plain, Node::Extend(of)) => {
            let from = builder.nodes[of].1;
            let unsigned = |width| Shape {
                kind: Kind::Unsigned,
                width,
            };
            let mut make = |node, shape| {
                builder.nodes.push((node, shape));
                builder.nodes.len() - 1
            };
            let plain = make(Node::Cast(of), unsigned(from.width));
            let wide = make(Node::Extend(plain), unsigned(shape.width));
            make(Node::Cast(wide), shape)
        }
        (Change::Then, Node::Mux(_, then, _)) => then,
        (Change::Otherwise, Node::Mux(_, _, other)) => other,
        (Change::Priority, Node::Mux(first, then, other)) => {
            let Node::Mux(second, next, last) = builder.nodes[other].0 else {
                return None;
            };
            let mut make = |node| {
                builder.nodes.push((node, shape));
                builder.nodes.len() - 1
            };
            let inner = make(Node::Mux(first, then, last));
            make(Node::Mux(second, next, inner))
        }
        (Change::Up, Node::ShiftLeft(a, by)) => make(Node::ShiftLeft(a, by + 1), shape),
        (Change::Down, Node::ShiftLeft(a, by)) => make(Node::ShiftLeft(a, by - 1), shape),
        (Change::Up, Node::ShiftRight(a, by)) => make(Node::ShiftRight(a, by + 1), shape),
        (Change::Down, Node::ShiftRight(a, by)) => make(Node::ShiftRight(a, by - 1), shape),
        (Change::Up, Node::Slice(a, low)) => make(Node::Slice(a, low + 1), shape),
        (Change::Down, Node::Slice(a, low)) => make(Node::Slice(a, low - 1), shape),
        (Change::More(number) | Change::Less(number), node) => {
            let operand = node.operands().nth(number)?;
            let (Node::Constant(bits), of) = builder.nodes[operand] else {
                return None;
            };
            let bits = match change {
                Change::More(_) => bits.wrapping_add(1),
                _ => bits.wrapping_sub(1),
            };
            let mut make = |node, shape| {
                builder.nodes.push((node, shape));
                builder.nodes.len() - 1
            };
            let constant = make(Node::Constant(masked(bits, of)), of);
            let mut at = 0;
            let node = node.map(|id| {
                at += 1;
                if at == number + 1 { constant } else { id }
            });
            make(node, shape)
        }
        _ => return None,
    })
}

/// Everything that names nodes.
fn renumber(builder: &mut Builder, nets: &mut Nets, map: &[Id]) {
    for signal in &mut builder.signals {
        signal.driver = signal.driver.map(|id| map[id]);
    }
    for memory in &mut builder.memories {
        memory.port = match memory.port {
            Port::Rom => Port::Rom,
            Port::Ram {
                enable,
                address,
                data,
            } => Port::Ram {
                enable: map[enable],
                address: map[address],
                data: map[data],
            },
            Port::Shift { enable, data } => Port::Shift {
                enable: map[enable],
                data: map[data],
            },
        };
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
