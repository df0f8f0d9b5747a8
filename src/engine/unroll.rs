//! Unrolling: consecutive ticks without registers.

use super::flat::{Flat, Id, Node, Op, Place, Port, Register};

/// Number of nodes at which unrolling is given up.
const MOST: usize = 1 << 20;

impl Flat {
    /// Returns the last `leaves` leaves of a circuit in the last of `ticks` ticks from power-on,
    /// with constant input ports, as a netlist without registers. A leaf of one bit follows for
    /// each of `groups`: high if all these properties hold in every tick. Returns `None` if a
    /// memory is written or there would be too many nodes.
    pub(crate) fn unrolled(
        &self,
        ticks: u64,
        leaves: usize,
        groups: &[Vec<usize>],
    ) -> Option<Flat> {
        let written = self.memories.iter().any(|memory| memory.port != Port::Rom);
        let nodes = u64::try_from(self.nodes.len()).ok()?.checked_mul(ticks)?;
        if written || ticks == 0 || nodes > MOST as u64 {
            return None;
        }
        let mut made: Vec<Node> = Vec::new();
        let mut add = |op, of: Node| {
            made.push(Node { op, ..of });
            made.len() as Id - 1
        };
        let node = |width, instance| Node {
            op: Op::Constant(0),
            width,
            instance,
        };
        let inputs: Vec<Id> = (0..self.inputs.len())
            .map(|port| add(Op::Input(port as u32), node(self.inputs[port], 0)))
            .collect();
        let power_on = |register: &Register| (register.power_on, register.width, register.instance);
        let mut state: Vec<Id> = Vec::new();
        for (value, width, instance) in self.registers.iter().map(power_on) {
            state.push(add(Op::Constant(value), node(width, instance)));
        }
        let high = add(Op::Constant(1), node(1, 0));
        let mut all = vec![high; groups.len()];
        let mut map: Vec<Id> = Vec::new();
        for tick in 0..ticks {
            if tick > 0 {
                let next = self.registers.iter();
                state = next.map(|register| map[register.next as usize]).collect();
            }
            map.clear();
            for of in &self.nodes {
                let id = match of.op {
                    Op::Input(port) => inputs[port as usize],
                    Op::Register(register) => state[register as usize],
                    op => add(op.map(|id| map[id as usize]), *of),
                };
                map.push(id);
            }
            for (all, group) in all.iter_mut().zip(groups) {
                for &property in group {
                    let holds = map[*self.properties.get(property)? as usize];
                    *all = add(Op::And(*all, holds), node(1, 0));
                }
            }
        }
        let seen = self.leaves.len().checked_sub(leaves)?;
        let mut places: Vec<Place> = (0..self.inputs.len() as u32).map(Place::Input).collect();
        for place in &self.leaves[seen..] {
            places.push(match *place {
                Place::Node(id) => Place::Node(map[id as usize]),
                Place::Input(port) => Place::Input(port),
                Place::Register(register) => Place::Node(state[register as usize]),
                Place::Word(..) => return None,
            });
        }
        places.extend(all.into_iter().map(Place::Node));
        Some(Flat {
            inputs: self.inputs.clone(),
            nodes: made,
            registers: Vec::new(),
            memories: self.memories.clone(),
            parts: [self.inputs.len(); 2],
            leaves: places,
            instances: self.instances.clone(),
            ..Flat::default()
        })
    }
}
