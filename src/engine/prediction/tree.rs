//! Items of an edge block, with the choices that several of its registers make merged: a register
//! that holds its word costs nothing there.

use super::graph::{From, Node};
use crate::engine::plan::{Code, Plan};

/// Effect of an edge block.
#[derive(Debug, Clone, Copy)]
pub(super) enum Root {
    Register { register: u32, next: From },
    Write { enable: From },
}

/// Item; the next one follows it unless it jumps.
#[derive(Debug, Clone, Copy)]
pub(super) enum Item {
    /// Jumps if `on` is low.
    Choose { on: From, low: u32 },
    /// Jumps.
    Goto { to: u32 },
    /// Updates a register.
    Register { register: u32, next: From },
    /// Writes a memory if `enable` is high.
    Write { enable: From },
    /// Stop the block.
    End,
}

/// Greatest nesting depth of choices.
const DEEP: usize = 12;
/// Greatest number of items of a block, per root.
const MANY: usize = 8;

/// Appends the items of a block.
pub(super) fn tree(plan: &Plan, nodes: &[Node], roots: &[Root], items: &mut Vec<Item>) {
    let mut growing = Growing {
        plan,
        nodes,
        most: items.len() + MANY * roots.len(),
        items,
        known: Vec::new(),
    };
    growing.grow(roots.to_vec());
    items.push(Item::End);
}

struct Growing<'t> {
    plan: &'t Plan,
    nodes: &'t [Node],
    items: &'t mut Vec<Item>,
    most: usize,
    /// Choices made on the way here.
    known: Vec<(From, bool)>,
}

/// Roots that make the same choice first.
struct Group {
    on: From,
    high: Vec<Root>,
    low: Vec<Root>,
}

impl Growing<'_> {
    fn node(&self, from: From) -> Option<&Node> {
        match from {
            From::Node(node) => Some(&self.nodes[node as usize]),
            _ => None,
        }
    }

    /// Returns a choice: its condition, and the values if it is high and low.
    fn choice(&self, from: From) -> Option<(From, From, From)> {
        let node = self.node(from).filter(|node| node.code == Code::Mux)?;
        let (mut on, mut high, mut low) = (node.a, node.b, node.c);
        while let Some(inner) = self.node(on)
            && inner.code == Code::Not
            && inner.width == 1
        {
            on = inner.a;
            (high, low) = (low, high);
        }
        Some((on, high, low))
    }

    fn grow(&mut self, roots: Vec<Root>) {
        let mut groups: Vec<Group> = Vec::new();
        for root in roots {
            let Root::Register { register, mut next } = root else {
                let Root::Write { enable } = root else {
                    continue;
                };
                self.items.push(Item::Write { enable });
                continue;
            };
            let slot = self.plan.registers[register as usize].slot;
            let choice = loop {
                let Some((on, high, low)) = self.choice(next) else {
                    break None;
                };
                match self.known.iter().find(|(known, _)| *known == on) {
                    Some((_, true)) => next = high,
                    Some((_, false)) => next = low,
                    None => break Some((on, high, low)),
                }
            };
            if next == From::Register(slot) {
                continue;
            }
            let full = self.known.len() >= DEEP || self.items.len() > self.most;
            let Some((on, high, low)) = choice.filter(|_| !full) else {
                self.items.push(Item::Register { register, next });
                continue;
            };
            let place = groups.iter().position(|group| group.on == on);
            let place = place.unwrap_or_else(|| {
                groups.push(Group {
                    on,
                    high: Vec::new(),
                    low: Vec::new(),
                });
                groups.len() - 1
            });
            let of = |next| Root::Register { register, next };
            groups[place].high.push(of(high));
            groups[place].low.push(of(low));
        }
        for group in groups {
            self.choose(group);
        }
    }

    fn choose(&mut self, group: Group) {
        let Group { on, high, low } = group;
        let start = self.items.len();
        self.items.push(Item::Choose { on, low: 0 });
        self.known.push((on, true));
        self.grow(high);
        self.known.pop();
        let jump = self.items.len();
        self.items.push(Item::Goto { to: 0 });
        self.items[start] = Item::Choose {
            on,
            low: self.items.len() as u32,
        };
        self.known.push((on, false));
        self.grow(low);
        self.known.pop();
        if self.items.len() == jump + 1 {
            // Nothing is done if it is low.
            self.items.pop();
            self.items[start] = Item::Choose {
                on,
                low: jump as u32,
            };
        } else {
            self.items[jump] = Item::Goto {
                to: self.items.len() as u32,
            };
        }
    }
}
