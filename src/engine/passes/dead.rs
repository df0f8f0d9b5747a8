use crate::engine::flat::{Flat, Place};

/// Removes dead nodes. Registers and memories are live, and nets whose leaf is `wanted`; the place
/// of an unwanted leaf becomes the first node, whatever that is. Properties follow the leaves in
/// `wanted`.
pub fn dead(flat: &Flat, wanted: &[bool]) -> Flat {
    let mut live = vec![false; flat.nodes.len()];
    let wants = |index: usize| wanted.get(index).copied().unwrap_or(false);
    let mut flat = flat.clone();
    let leaves = flat.leaves.len();
    for (index, place) in flat.leaves.iter_mut().enumerate() {
        if matches!(place, Place::Node(_)) && !wants(index) {
            *place = Place::Node(0);
        }
    }
    for (index, property) in flat.properties.iter_mut().enumerate() {
        if !wants(leaves + index) {
            *property = 0;
        }
    }
    for root in flat.roots() {
        live[root as usize] = true;
    }
    if let Some(first) = live.first_mut() {
        *first = true;
    }
    for id in (0..live.len()).rev() {
        if live[id] {
            for operand in flat.nodes[id].op.operands() {
                live[operand as usize] = true;
            }
        }
    }
    let mut live = live.into_iter();
    flat.rebuild(|nodes, node| {
        // Nodes that are not kept have only dead readers.
        if live.next() == Some(true) {
            nodes.push(node);
        }
        nodes.len() as u32 - 1
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::flat::{Node, Op, Register};

    #[test]
    fn what_nobody_asks_for_is_gone() {
        let node = |op| Node {
            op,
            width: 4,
            instance: 0,
        };
        let flat = Flat {
            nodes: vec![
                node(Op::Input(0)),
                node(Op::Not(0)),
                node(Op::Register(0)),
                node(Op::Add(0, 2)),
                node(Op::Negate(1)),
            ],
            inputs: vec![4],
            registers: vec![Register {
                width: 4,
                power_on: 0,
                next: 3,
                instance: 0,
            }],
            leaves: vec![Place::Node(4), Place::Node(3), Place::Register(0)],
            ..Flat::default()
        };
        let none = dead(&flat, &[false; 3]);
        assert_eq!(
            none.nodes,
            [0, 2]
                .map(|id| flat.nodes[id])
                .into_iter()
                .chain([node(Op::Add(0, 1))])
                .collect::<Vec<_>>()
        );
        assert_eq!(none.registers[0].next, 2);
        let all = dead(&flat, &[true; 3]);
        assert_eq!(all, flat);
    }
}
