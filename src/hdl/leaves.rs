//! Conversion of the leaves of a circuit's records into nodes.

use super::Path;
use super::build::{self, builder, dotted, flat, masked, mistake, node, signal};
use super::memory::{Contents, MOST_ADDRESS};
use super::record::{Cells, MemoryShape, Source};
use crate::netlist::{Field, Id, Memory, Node, Port, Register, Role, Shape};

/// Source that creates input ports and registers.
#[derive(Default)]
pub(super) struct Leaves {
    path: Path,
}

impl Leaves {
    /// Passes the current scopes on to the declaration of parts.
    fn scoped(&self) {
        let scope = self.path.scopes().join("_");
        builder(|builder| builder.scope = scope);
    }

    /// Returns the names of the next leaf in its module and in the waves of its circuit.
    fn names(&mut self, field: &'static Field) -> (String, String) {
        let name = self.path.name(field);
        let scopes = self.path.scopes();
        (flat(scopes, &name), dotted(scopes, &name))
    }
}

/// Records a mistake of a leaf. Mistakes of a part are reported when that part is elaborated.
fn object(what: String) {
    if let (site, false) = builder(|builder| (builder.site(), builder.of_part)) {
        mistake(site, what);
    }
}

/// Records a leaf of an impossible shape, which makes the result of `tick` useless.
fn unmade(what: String) {
    object(what);
    builder(|builder| builder.unmade |= !builder.of_part);
}

impl Source for Leaves {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
        self.scoped();
    }
    fn leave(&mut self) {
        self.path.leave();
        self.scoped();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }

    fn word(&mut self, field: &'static Field, shape: Shape, power_on: i128) -> u64 {
        let (name, path) = self.names(field);
        let role = self.path.role();
        let shape = match build::is_word(shape) {
            Ok(()) => shape,
            Err(wrong) => {
                unmade(format!("`{path}` {wrong}"));
                build::nearest(shape)
            }
        };
        let made = !builder(|builder| builder.unmade);
        if let (Role::Register, true, Err(wrong)) = (role, made, build::fits(power_on, shape)) {
            object(format!("`{path}` at power-on: {wrong}"));
        }
        builder(|builder| {
            let mut made = signal((name, path), field, role, shape);
            if role == Role::Register {
                made.power_on = masked(power_on as u64, shape);
                let register = Register::Signal(builder.signals.len());
                builder.registers.push(register);
            }
            let signal = builder.signal(made);
            let site = builder.site();
            builder.node(Node::Signal(signal), shape, site) as u64
        })
    }

    fn memory(
        &mut self,
        field: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        contents: &dyn Fn() -> Contents,
    ) -> Cells {
        let (name, path) = self.names(field);
        let contents = contents();
        let most = 1 << MOST_ADDRESS;
        if !(1..=64).contains(&shape.width) || !(1..=most).contains(&shape.words) {
            unmade(format!(
                "memory `{path}` has {} words of {}; there are 1 to {most} words of 1 to 64 bits",
                shape.words,
                build::bits(shape.width)
            ));
        }
        if let Some((address, width)) = contents.shape()
            && (shape.address != Some(address) || shape.width != width)
        {
            let words = match shape.address {
                Some(address) => format!("addresses of {}", build::bits(address)),
                None => format!("{} stages", shape.words),
            };
            unmade(format!(
                "memory `{path}` has {words} and words of {}, what it holds at power-on has {} and {}",
                build::bits(shape.width),
                build::bits(address),
                build::bits(width)
            ));
        }
        if let Some((site, wrong)) = contents.wrong()
            && !builder(|builder| builder.of_part)
        {
            mistake(site, format!("memory `{path}` at power-on: {wrong}"));
        }
        let shape = MemoryShape {
            words: shape.words.clamp(1, most),
            width: shape.width.clamp(1, 64),
            ..shape
        };
        let words = contents.words(shape);
        let first = builder(|builder| {
            builder.memories.push(Memory {
                name,
                doc: field.doc,
                words: shape.words,
                width: shape.width,
                port: Port::Rom,
                filled: words.iter().any(|word| *word != 0),
                inner: false,
            });
            builder.shapes.push(shape);
            builder.contents.push(words);
            let memory = builder.memories.len() - 1;
            builder.registers.push(Register::Memory(memory));
            memory
        });
        Cells::at(first, shape)
    }
}

/// Existing nodes, one after the other.
pub(crate) struct Nodes<'a>(pub std::slice::Iter<'a, Id>);

impl Source for Nodes<'_> {
    fn word(&mut self, _: &'static Field, shape: Shape, _: i128) -> u64 {
        match self.0.next() {
            Some(id) => *id as u64,
            // A walk has as many leaves as there are nodes.
            None => node(Node::Constant(0), shape) as u64,
        }
    }
}
