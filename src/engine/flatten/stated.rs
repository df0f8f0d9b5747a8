//! Statements about parts, in terms of the tick before the edge.

use super::{Flattening, circle, operation};
use crate::engine::flat::{EngineError, Flat, Id, Op, Port, mask};
use crate::netlist::{self, Assertion, Claim, Design};

/// Statement about a circuit or a part of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Statement {
    /// Scopes of the part below the outermost circuit, which has none.
    pub path: Vec<String>,
    /// The statement in words.
    pub name: &'static str,
    /// Use in proofs of the part alone.
    pub claim: Claim,
    /// Signals at fault if the statement is violated.
    pub signals: &'static [&'static str],
}

impl Statement {
    /// Returns the statement, with the path of its part.
    pub fn title(&self) -> String {
        match self.path.is_empty() {
            true => self.name.to_owned(),
            false => format!("{}: {}", self.path.join("."), self.name),
        }
    }
}

impl Flat {
    /// Flattens a design with the statements of all parts that rely on an assumption, or contain a
    /// part that does, and with the helpers of the parts beside those. The properties of the netlist
    /// are in the order of the statements; those of the outermost circuit are first.
    ///
    /// # Errors
    /// Returns the errors of [`of`](Self::of).
    pub fn with_parts(design: &Design) -> Result<(Flat, Vec<Statement>), EngineError> {
        let mut flattening = Flattening::of(design)?;
        let mut statements = Vec::new();
        let beside = flattening.beside();
        for part in 0..flattening.parts.len() {
            let wanted = |claim| match part == 0 || flattening.relies(part) {
                true => true,
                false => claim == Claim::Helper && beside.contains(&part),
            };
            let assertions = flattening.parts[part].module.assertions.iter();
            let assertions: Vec<_> = assertions.filter(|it| wanted(it.claim)).collect();
            let properties = flattening.stated(part, &assertions)?;
            flattening.flat.properties.extend(properties);
            let instance = flattening.parts[part].instance;
            let path = &flattening.flat.instances[instance as usize].path;
            statements.extend(assertions.into_iter().map(|it| Statement {
                path: path.clone(),
                name: it.name,
                claim: it.claim,
                signals: it.signals,
            }));
        }
        flattening.leaves(0)?;
        Ok((flattening.flat, statements))
    }
}

/// Nodes of a part's properties under construction.
struct Stated {
    part: usize,
    /// Nodes made so far: of this tick, and of signals after its edge.
    made: [Vec<Option<Id>>; 2],
}

impl Stated {
    fn at(&self, (step, id): (bool, netlist::Id)) -> Option<Id> {
        self.made[usize::from(step)].get(id).copied().flatten()
    }
}

impl Flattening<'_> {
    /// True if a part, or a part inside it, relies on an assumption about its input ports.
    fn relies(&self, part: usize) -> bool {
        let part = &self.parts[part];
        let mut assertions = part.module.assertions.iter();
        let mut children = part.children.iter();
        assertions.any(|it| it.claim == Claim::Given) || children.any(|&child| self.relies(child))
    }

    /// Returns the parts in circuits with a part that relies on an assumption.
    fn beside(&self) -> Vec<usize> {
        let all = self.parts.iter().map(|part| &part.children);
        let relied = all.filter(|children| children.iter().any(|&child| self.relies(child)));
        relied.flatten().copied().collect()
    }

    /// Makes properties of a settled part, in terms of the tick before the edge: a register
    /// after the edge is the node that it takes.
    pub(super) fn stated(
        &mut self,
        part: usize,
        assertions: &[&Assertion],
    ) -> Result<Vec<Id>, EngineError> {
        let module = self.parts[part].module;
        let mut stated = Stated {
            part,
            made: [(); 2].map(|()| vec![None; module.nodes.len()]),
        };
        let assertions = assertions.iter();
        assertions
            .map(|assertion| self.state(&mut stated, assertion.step, assertion.holds))
            .collect()
    }

    /// Makes a node of a property, and those that it needs; where it spans a `step`, of signals
    /// after the edge.
    fn state(
        &mut self,
        stated: &mut Stated,
        step: bool,
        id: netlist::Id,
    ) -> Result<Id, EngineError> {
        // A list of nodes to make, as properties may be deep.
        let mut open = vec![(step, id)];
        let mut made = None;
        while let Some(&(step, id)) = open.last() {
            made = stated.at((step, id));
            if made.is_none() {
                let before = open.len();
                for needed in self.needed(stated.part, step, id)? {
                    if stated.at(needed).is_none() {
                        open.push(needed);
                    }
                }
                if open.len() > before {
                    continue;
                }
                made = Some(self.state_one(stated, step, id)?);
                stated.made[usize::from(step)][id] = made;
            }
            open.pop();
        }
        made.ok_or_else(|| circle(self.parts[stated.part].module, id))
    }

    /// Returns the nodes that have to be made before a node of a property.
    fn needed(
        &self,
        part: usize,
        step: bool,
        id: netlist::Id,
    ) -> Result<Vec<(bool, netlist::Id)>, EngineError> {
        use netlist::Node;
        let module = self.parts[part].module;
        let circle = || circle(module, id);
        let (node, _) = *module.nodes.get(id).ok_or_else(circle)?;
        let step = match node {
            _ if !step && id < module.logic => return Ok(Vec::new()),
            Node::Past(_) => false,
            _ => step,
        };
        let needed: Vec<_> = node.operands().map(|operand| (step, operand)).collect();
        match needed.iter().all(|(_, operand)| *operand < id) {
            true => Ok(needed),
            false => Err(circle()),
        }
    }

    /// Makes a node of a property whose operands are made.
    fn state_one(
        &mut self,
        stated: &Stated,
        step: bool,
        id: netlist::Id,
    ) -> Result<Id, EngineError> {
        use netlist::Node;
        let part = stated.part;
        let module = self.parts[part].module;
        let circle = || circle(module, id);
        let (node, shape) = module.nodes[id];
        let width = shape.width as u8;
        let of = |step: bool, id| stated.at((step, id)).ok_or_else(circle);
        Ok(match node {
            _ if !step && id < module.logic => self.made(part, id)?,
            Node::Past(a) => of(false, a)?,
            Node::Signal(signal) if step => match self.register(part, signal) {
                Some(register) => self.flat.registers[register as usize].next,
                None => self.node(part, id, &self.input_ports(part))?,
            },
            Node::Constant(bits) => self.add(part, Op::Constant(bits & mask(width)), width),
            Node::Signal(_) | Node::Parameter(_) | Node::Port { .. } => {
                self.node(part, id, &self.input_ports(part))?
            }
            Node::Read(memory, a) => {
                let memory = self.memory(part, memory).ok_or_else(circle)?;
                let address = of(step, a)?;
                match step {
                    true => self.read_after(part, memory, address),
                    false => self.add(part, Op::Read(memory, address), width),
                }
            }
            node => {
                let before = |id: netlist::Id| module.nodes[id].1;
                let op = operation(node, shape, before, |id| of(step, id))?;
                self.add_unless_same(part, op, width)
            }
        })
    }

    /// Makes the word that a memory has at an address after the edge.
    fn read_after(&mut self, part: usize, memory: u32, address: Id) -> Id {
        let of = &self.flat.memories[memory as usize];
        let (width, port, words) = (of.width, of.port, of.contents.len() as u64);
        let held = self.add(part, Op::Read(memory, address), width);
        let wide = self.flat.node(address).width;
        match port {
            Port::Rom => held,
            Port::Ram {
                enable,
                address: at,
                data,
            } => {
                let here = self.add(part, Op::Equal(address, at), 1);
                let mut here = self.add(part, Op::And(enable, here), 1);
                if words <= mask(wide) {
                    let end = self.add(part, Op::Constant(words), wide);
                    let inside = self.add(part, Op::Below(address, end), 1);
                    here = self.add(part, Op::And(here, inside), 1);
                }
                self.add(part, Op::Mux(here, data, held), width)
            }
            Port::Shift { enable, data } => {
                let one = self.add(part, Op::Constant(1), wide);
                let zero = self.add(part, Op::Constant(0), wide);
                let before = self.add(part, Op::Subtract(address, one), wide);
                let moved = self.add(part, Op::Read(memory, before), width);
                let first = self.add(part, Op::Equal(address, zero), 1);
                let mut moved = self.add(part, Op::Mux(first, data, moved), width);
                if words <= mask(wide) {
                    // Past the last stage stays zero.
                    let end = self.add(part, Op::Constant(words), wide);
                    let inside = self.add(part, Op::Below(address, end), 1);
                    moved = self.add(part, Op::Mux(inside, moved, held), width);
                }
                self.add(part, Op::Mux(enable, moved, held), width)
            }
        }
    }
}
