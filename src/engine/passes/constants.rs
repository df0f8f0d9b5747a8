use crate::engine::flat::{Flat, Id, Node, Op, mask};
use crate::engine::value;

/// Constant folding: nodes of constants become constants, and operations that a constant makes
/// trivial are removed.
pub fn constants(flat: &Flat) -> Flat {
    let roms: Vec<Option<&[u64]>> = flat
        .memories
        .iter()
        .map(|memory| match memory.port {
            crate::engine::flat::Port::Rom => Some(&memory.contents[..]),
            _ => None,
        })
        .collect();
    flat.rebuild(|nodes, node| {
        match simpler(nodes, node, &roms) {
            Simpler::Same => {}
            Simpler::Is(id) => return id,
            Simpler::Op(op) => {
                let again = Node { op, ..node };
                // The result may be simplified further.
                if let Simpler::Is(id) = simpler(nodes, again, &roms) {
                    return id;
                }
                nodes.push(again);
                return nodes.len() as Id - 1;
            }
        }
        nodes.push(node);
        nodes.len() as Id - 1
    })
}

enum Simpler {
    /// No change.
    Same,
    /// Existing node.
    Is(Id),
    /// Other operation.
    Op(Op),
}

fn simpler(nodes: &[Node], node: Node, roms: &[Option<&[u64]>]) -> Simpler {
    let at = |id: Id| nodes[id as usize];
    let bits = |id: Id| match at(id).op {
        Op::Constant(bits) => Some(bits),
        _ => None,
    };
    if let Op::Read(memory, address) = node.op {
        return match (bits(address), roms[memory as usize]) {
            (Some(address), Some(words)) => {
                let word = usize::try_from(address)
                    .ok()
                    .and_then(|index| words.get(index));
                Simpler::Op(Op::Constant(word.copied().unwrap_or(0)))
            }
            _ => Simpler::Same,
        };
    }
    if !matches!(node.op, Op::Constant(_) | Op::Input(_) | Op::Register(_))
        && node.op.operands().all(|id| bits(id).is_some())
    {
        let value = value::of(node, |id| (bits(id).unwrap_or(0), at(id).width));
        return Simpler::Op(Op::Constant(value));
    }
    let ones = mask(node.width);
    match node.op {
        Op::Not(a) => match at(a).op {
            Op::Not(a) => Simpler::Is(a),
            _ => Simpler::Same,
        },
        Op::Add(a, b) => match (bits(a), bits(b)) {
            (Some(0), _) => Simpler::Is(b),
            (_, Some(0)) => Simpler::Is(a),
            _ => Simpler::Same,
        },
        Op::Subtract(a, b) => match (bits(a), bits(b)) {
            (_, Some(0)) => Simpler::Is(a),
            (Some(0), _) => Simpler::Op(Op::Negate(b)),
            _ if a == b => Simpler::Op(Op::Constant(0)),
            _ => Simpler::Same,
        },
        Op::Multiply(a, b) => match (bits(a), bits(b)) {
            (Some(number), _) => product(b, number),
            (_, Some(number)) => product(a, number),
            _ => Simpler::Same,
        },
        Op::And(a, b) => match (bits(a), bits(b)) {
            (Some(0), _) | (_, Some(0)) => Simpler::Op(Op::Constant(0)),
            (Some(all), _) if all == ones => Simpler::Is(b),
            (_, Some(all)) if all == ones => Simpler::Is(a),
            _ if a == b => Simpler::Is(a),
            _ => Simpler::Same,
        },
        Op::Or(a, b) => match (bits(a), bits(b)) {
            (Some(0), _) => Simpler::Is(b),
            (_, Some(0)) => Simpler::Is(a),
            (Some(all), _) | (_, Some(all)) if all == ones => Simpler::Op(Op::Constant(ones)),
            _ if a == b => Simpler::Is(a),
            _ => Simpler::Same,
        },
        Op::Xor(a, b) => match (bits(a), bits(b)) {
            (Some(0), _) => Simpler::Is(b),
            (_, Some(0)) => Simpler::Is(a),
            (Some(all), _) if all == ones => Simpler::Op(Op::Not(b)),
            (_, Some(all)) if all == ones => Simpler::Op(Op::Not(a)),
            _ if a == b => Simpler::Op(Op::Constant(0)),
            _ => Simpler::Same,
        },
        Op::Equal(a, b) => match (bits(a), bits(b), at(a).width) {
            _ if a == b => Simpler::Op(Op::Constant(1)),
            (Some(1), _, 1) => Simpler::Is(b),
            (_, Some(1), 1) => Simpler::Is(a),
            (Some(0), _, 1) => Simpler::Op(Op::Not(b)),
            (_, Some(0), 1) => Simpler::Op(Op::Not(a)),
            _ => Simpler::Same,
        },
        Op::Below(a, b) => match (bits(a), bits(b)) {
            _ if a == b => Simpler::Op(Op::Constant(0)),
            (_, Some(0)) => Simpler::Op(Op::Constant(0)),
            (Some(all), _) if all == mask(at(a).width) => Simpler::Op(Op::Constant(0)),
            _ => Simpler::Same,
        },
        Op::BelowSigned(a, b) if a == b => Simpler::Op(Op::Constant(0)),
        Op::Mux(choose, then, other) => match (bits(choose), bits(then), bits(other)) {
            (Some(0), _, _) => Simpler::Is(other),
            (Some(_), _, _) => Simpler::Is(then),
            _ if then == other => Simpler::Is(then),
            (_, Some(1), Some(0)) if node.width == 1 => Simpler::Is(choose),
            (_, Some(0), Some(1)) if node.width == 1 => Simpler::Op(Op::Not(choose)),
            (_, Some(1), _) if node.width == 1 => Simpler::Op(Op::Or(choose, other)),
            (_, _, Some(0)) if node.width == 1 => Simpler::Op(Op::And(choose, then)),
            _ => match at(choose).op {
                Op::Not(choose) => Simpler::Op(Op::Mux(choose, other, then)),
                _ => Simpler::Same,
            },
        },
        Op::ShiftLeft(a, by) | Op::ShiftRight(a, by) => match by {
            0 => Simpler::Is(a),
            by if by >= node.width => Simpler::Op(Op::Constant(0)),
            _ => Simpler::Same,
        },
        Op::ShiftRightSigned(a, 0) => Simpler::Is(a),
        Op::Slice(a, low) => {
            let (of, above) = (at(a), low + node.width);
            match of.op {
                _ if low == 0 && of.width == node.width => Simpler::Is(a),
                Op::Slice(a, lower) => Simpler::Op(Op::Slice(a, lower + low)),
                Op::Extend(a) | Op::ExtendSigned(a) if above <= at(a).width => {
                    match low == 0 && at(a).width == node.width {
                        true => Simpler::Is(a),
                        false => Simpler::Op(Op::Slice(a, low)),
                    }
                }
                Op::Extend(a) if low >= at(a).width => Simpler::Op(Op::Constant(0)),
                Op::Join(high, b) if low >= at(b).width => {
                    let low = low - at(b).width;
                    match low == 0 && at(high).width == node.width {
                        true => Simpler::Is(high),
                        false => Simpler::Op(Op::Slice(high, low)),
                    }
                }
                Op::Join(_, b) if above <= at(b).width => {
                    match low == 0 && at(b).width == node.width {
                        true => Simpler::Is(b),
                        false => Simpler::Op(Op::Slice(b, low)),
                    }
                }
                _ => Simpler::Same,
            }
        }
        Op::Extend(a) => match at(a).op {
            _ if at(a).width == node.width => Simpler::Is(a),
            Op::Extend(a) => Simpler::Op(Op::Extend(a)),
            _ => Simpler::Same,
        },
        Op::ExtendSigned(a) => match at(a).op {
            _ if at(a).width == node.width => Simpler::Is(a),
            Op::ExtendSigned(a) => Simpler::Op(Op::ExtendSigned(a)),
            Op::Extend(a) => Simpler::Op(Op::Extend(a)),
            _ => Simpler::Same,
        },
        Op::Join(high, low) if bits(high) == Some(0) => Simpler::Op(Op::Extend(low)),
        _ => Simpler::Same,
    }
}

/// Simplifies a product with a constant.
fn product(a: Id, number: u64) -> Simpler {
    match number {
        0 => Simpler::Op(Op::Constant(0)),
        1 => Simpler::Is(a),
        number if number.is_power_of_two() => {
            Simpler::Op(Op::ShiftLeft(a, number.trailing_zeros() as u8))
        }
        _ => Simpler::Same,
    }
}
