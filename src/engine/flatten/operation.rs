//! Operations of nodes.

use crate::engine::flat::{EngineError, Id, Op};
use crate::netlist::{self, Kind, Operator, Shape};

/// Returns the operation of a node that depends on its operands only.
pub(super) fn operation(
    node: netlist::Node,
    shape: Shape,
    before: impl Fn(netlist::Id) -> Shape,
    of: impl Fn(netlist::Id) -> Result<Id, EngineError>,
) -> Result<Op, EngineError> {
    use netlist::Node;
    let signed = |id| before(id).kind == Kind::Signed;
    let bits = |bits: usize| bits.min(64) as u8;
    Ok(match node {
        Node::Not(a) => Op::Not(of(a)?),
        Node::Negate(a) => Op::Negate(of(a)?),
        Node::Binary(operator, a, b) => {
            let (x, y) = (of(a)?, of(b)?);
            match operator {
                Operator::Add => Op::Add(x, y),
                Operator::Subtract => Op::Subtract(x, y),
                Operator::Multiply => Op::Multiply(x, y),
                Operator::And => Op::And(x, y),
                Operator::Or => Op::Or(x, y),
                Operator::Xor => Op::Xor(x, y),
                Operator::Equal => Op::Equal(x, y),
                Operator::Below if signed(a) => Op::BelowSigned(x, y),
                Operator::Below => Op::Below(x, y),
            }
        }
        Node::Mux(choose, then, other) => Op::Mux(of(choose)?, of(then)?, of(other)?),
        Node::ShiftLeft(a, by) => Op::ShiftLeft(of(a)?, bits(by)),
        Node::ShiftRight(a, by) if shape.kind == Kind::Signed => {
            Op::ShiftRightSigned(of(a)?, bits(by))
        }
        Node::ShiftRight(a, by) => Op::ShiftRight(of(a)?, bits(by)),
        Node::Slice(a, low) => Op::Slice(of(a)?, bits(low)),
        Node::Extend(a) if signed(a) => Op::ExtendSigned(of(a)?),
        Node::Extend(a) => Op::Extend(of(a)?),
        Node::Join(a, b) => Op::Join(of(a)?, of(b)?),
        Node::Cast(a) | Node::Past(a) => Op::Slice(of(a)?, 0),
        Node::Constant(bits) => Op::Constant(bits),
        // Other nodes need the parts, and are made there.
        Node::Parameter(_) | Node::Signal(_) | Node::Port { .. } | Node::Read(..) => {
            Op::Constant(0)
        }
    })
}
