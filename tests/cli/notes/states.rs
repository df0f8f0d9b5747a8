//! Numbers that a register of states holds, from what drives it.

use motion_rtl::netlist::{Id, Module, Node, Operator};
use motion_rtl::registry::Entry;
use std::collections::BTreeSet;

/// The values that a node may have; none where that is not known.
type Values = Option<BTreeSet<u64>>;

/// The numbers without a name, from `names` on, of a register of that name, if it never holds one of
/// them, whatever comes in.
pub fn unreached(entry: &Entry, name: &str, names: usize) -> Vec<u64> {
    let verilog = entry.full().verilog().expect("a netlist");
    let module = verilog.design().modules.last().expect("a module");
    let mut signals = module.signals.iter();
    let register = signals.position(|signal| signal.owner.is_none() && signal.name == name);
    let Some(register) = register else {
        return Vec::new();
    };
    let signal = &module.signals[register];
    let Some(driver) = signal.driver else {
        return Vec::new();
    };
    let nameless = names as u64..1 << signal.shape.width;
    let (mut held, mut ahead) = (BTreeSet::new(), vec![signal.power_on]);
    while let Some(now) = ahead.pop() {
        let holder = Holder {
            module,
            register,
            now,
        };
        let Some(next) = holder.values(driver) else {
            return Vec::new();
        };
        if nameless.contains(&now) {
            return Vec::new();
        }
        held.insert(now);
        ahead.extend(next.difference(&held));
    }
    nameless.collect()
}

/// A module whose register holds a number.
struct Holder<'m> {
    module: &'m Module,
    register: usize,
    now: u64,
}

impl Holder<'_> {
    fn values(&self, id: Id) -> Values {
        let (node, shape) = self.module.nodes[id];
        let mask = u64::MAX >> (64 - shape.width);
        let each = |of: Id, map: &dyn Fn(u64) -> u64| -> Values {
            let values = self.values(of)?;
            Some(values.into_iter().map(|value| map(value) & mask).collect())
        };
        match node {
            Node::Constant(number) => Some(BTreeSet::from([number])),
            Node::Signal(signal) => (signal == self.register).then(|| BTreeSet::from([self.now])),
            Node::Mux(choice, then, other) => match self.one(choice) {
                Some(1) => self.values(then),
                Some(_) => self.values(other),
                None => Some(&self.values(then)? | &self.values(other)?),
            },
            Node::Binary(Operator::And, a, b)
                if [a, b].map(|of| self.one(of)).contains(&Some(0)) =>
            {
                Some(BTreeSet::from([0]))
            }
            Node::Binary(Operator::Or, a, b)
                if [a, b].map(|of| self.one(of)).contains(&Some(mask)) =>
            {
                Some(BTreeSet::from([mask]))
            }
            Node::Binary(operator, a, b) => {
                let (a, b) = (self.one(a)?, self.one(b)?);
                let value = match operator {
                    Operator::Add => a.wrapping_add(b),
                    Operator::Subtract => a.wrapping_sub(b),
                    Operator::And => a & b,
                    Operator::Or => a | b,
                    Operator::Xor => a ^ b,
                    Operator::Equal => u64::from(a == b),
                    Operator::Below | Operator::Multiply => return None,
                };
                Some(BTreeSet::from([value & mask]))
            }
            Node::Not(of) => each(of, &|value| !value),
            Node::Slice(of, low) => each(of, &|value| value >> low),
            Node::ShiftRight(of, by) => each(of, &|value| value >> by),
            Node::Cast(of) => each(of, &|value| value),
            _ => None,
        }
    }

    /// The value of a node that has but one.
    fn one(&self, id: Id) -> Option<u64> {
        let values = self.values(id)?;
        let mut all = values.iter();
        all.next().copied().filter(|_| all.next().is_none())
    }
}
