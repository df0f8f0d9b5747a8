use crate::engine::flat::{Flat, Op};
use rustc_hash::FxHashMap;

/// Merges nodes that compute the same; the instance that comes first keeps the node.
pub fn equal(flat: &Flat) -> Flat {
    let mut known = FxHashMap::default();
    flat.rebuild(|nodes, node| {
        let op = match node.op {
            Op::Add(a, b) => Op::Add(a.min(b), a.max(b)),
            Op::Multiply(a, b) => Op::Multiply(a.min(b), a.max(b)),
            Op::And(a, b) => Op::And(a.min(b), a.max(b)),
            Op::Or(a, b) => Op::Or(a.min(b), a.max(b)),
            Op::Xor(a, b) => Op::Xor(a.min(b), a.max(b)),
            Op::Equal(a, b) => Op::Equal(a.min(b), a.max(b)),
            op => op,
        };
        *known.entry((op, node.width)).or_insert_with(|| {
            nodes.push(node);
            nodes.len() as u32 - 1
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::flat::{Node, Place};

    #[test]
    fn the_same_sum_is_computed_once() {
        let node = |op, instance| Node {
            op,
            width: 4,
            instance,
        };
        let flat = Flat {
            nodes: vec![
                node(Op::Input(0), 0),
                node(Op::Input(1), 0),
                node(Op::Add(0, 1), 1),
                node(Op::Add(1, 0), 2),
                node(Op::Subtract(0, 1), 2),
                node(Op::Subtract(1, 0), 2),
            ],
            inputs: vec![4, 4],
            leaves: (2..6).map(Place::Node).collect(),
            ..Flat::default()
        };
        let one = equal(&flat);
        assert_eq!(one.nodes.len(), 5);
        assert_eq!(one.nodes[2].instance, 1);
        let places = [2, 2, 3, 4].map(Place::Node);
        assert_eq!(one.leaves, places);
    }
}
