//! Signals by name, in the order of a walk.

use super::Circuit;
use crate::netlist::{Field, Role, Shape, unsigned};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Position of a walk: the scopes around the next leaf, and the part of the circuit that the leaf
/// belongs to.
///
/// Keep one in a [`Source`](super::Source) or [`Sink`](super::Sink) and pass it every `enter`, `leave` and
/// `element`.
#[derive(Debug, Clone, Default)]
pub struct Path {
    scopes: Vec<String>,
    /// Saved state of each struct entered.
    entered: Vec<Around>,
    role: Option<Role>,
    /// Number of scopes, up to and including the scope of the current circuit.
    circuit: usize,
    element: Option<usize>,
}

/// Saved state of a walk from before a struct was entered.
#[derive(Debug, Clone)]
struct Around {
    /// True if the struct added a scope.
    scoped: bool,
    role: Option<Role>,
    circuit: usize,
}

impl Path {
    /// Enters a struct.
    pub fn enter(&mut self, field: &'static Field) {
        self.entered.push(Around {
            scoped: !field.name.is_empty(),
            role: self.role,
            circuit: self.circuit,
        });
        if !field.name.is_empty() {
            let name = self.name(field);
            self.scopes.push(name);
        }
        if field.role.is_some() {
            self.role = field.role;
            self.circuit = self.scopes.len();
        }
    }

    /// Leaves the struct entered last.
    pub fn leave(&mut self) {
        if let Some(around) = self.entered.pop() {
            (self.role, self.circuit) = (around.role, around.circuit);
            if around.scoped {
                self.scopes.pop();
            }
        }
    }

    /// Marks the next leaf or struct as element `index` of an array.
    pub fn element(&mut self, index: usize) {
        self.element = Some(index);
    }

    /// Returns the name of the next leaf or scope.
    pub fn name(&mut self, field: &'static Field) -> String {
        match self.element.take() {
            Some(index) => field.element(index).into_owned(),
            None => field.name.to_owned(),
        }
    }

    /// Returns the scopes around the next leaf, outermost first.
    pub fn scopes(&self) -> &[String] {
        &self.scopes
    }

    /// Returns the role of the next leaf in its own circuit.
    pub fn role(&self) -> Role {
        self.role.unwrap_or(Role::Net)
    }

    /// Returns the role of the next leaf in the outermost circuit.
    fn outermost_role(&self) -> Role {
        let around = self.entered.iter().find_map(|around| around.role);
        around.unwrap_or(self.role())
    }
}

/// One leaf of a walk, without its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// Scopes around the leaf, outermost first; words of a memory share them.
    pub scopes: Arc<[String]>,
    /// Name in the innermost scope.
    pub name: String,
    /// Input port, register or net.
    pub role: Role,
    /// Kind and width.
    pub shape: Shape,
    /// Number of bits behind the binary point, as declared; 0 for an integer.
    pub fraction: usize,
    /// Bits at power-on, with all input ports low.
    pub power_on: u64,
    /// Declaration in `signals!`.
    pub field: &'static Field,
    /// Role in the outermost circuit.
    pub(crate) part: Role,
    /// Number of scopes up to that of the leaf's own circuit; the scopes after it are bundles and
    /// memories.
    pub(crate) circuit: usize,
}

impl Declaration {
    /// True if the leaf is an output port of its own circuit.
    pub(crate) fn is_port_out(&self) -> bool {
        self.role != Role::Input && self.field.public
    }

    /// Returns scopes and name joined by dots.
    pub fn path(&self) -> String {
        let mut path = self.scopes.join(".");
        if !path.is_empty() {
            path.push('.');
        }
        path + &self.name
    }

    /// Returns scopes and name, outermost first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.scopes.iter().chain([&self.name]).map(String::as_str)
    }
}

/// Memory of a walk; its words are leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryDeclaration {
    /// Scopes around the memory, outermost first.
    pub scopes: Vec<String>,
    /// Name in the innermost scope, which is also the scope of the words.
    pub name: String,
    /// Leaf that is the first word.
    pub first: usize,
    /// Number of words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// Declaration in `signals!`.
    pub field: &'static Field,
}

/// All leaves of a walk, in its order.
#[derive(Debug, Clone, Default)]
pub struct Declarations {
    /// Leaves; the index identifies a leaf.
    pub leaves: Vec<Declaration>,
    /// Memories, ordered by their first word.
    pub memories: Vec<MemoryDeclaration>,
    path: Path,
    /// Fraction bits of the next leaf.
    fraction: usize,
}

impl Declarations {
    /// Returns the signals of a circuit, in the order of its leaves. Power-on values are left at
    /// 0; an [`Elaborated`](crate::sim::Elaborated) circuit has them.
    pub fn of<C: Circuit>(circuit: &C) -> Self {
        super::declarations(circuit, &mut |_| {})
    }

    /// Returns an empty list whose leaves will be in the scope `scope`.
    pub(crate) fn within(scope: &str) -> Self {
        Declarations {
            path: Path {
                scopes: vec![scope.to_owned()],
                ..Path::default()
            },
            ..Declarations::default()
        }
    }

    /// Returns the number of leaves that are input ports; they come first.
    pub fn inputs(&self) -> usize {
        self.before(Role::Register)
    }

    /// Returns the number of leaves that come before those of `role` in the outermost circuit.
    pub(crate) fn before(&self, role: Role) -> usize {
        let order = |role| match role {
            Role::Input => 0,
            Role::Register => 1,
            Role::Net => 2,
        };
        // Input ports of parts are among the nets.
        let outer = |place: &Declaration| order(place.part) < order(role);
        self.leaves.iter().take_while(|leaf| outer(leaf)).count()
    }

    /// Returns index and name of the circuit's own leaves, without those of its parts and the
    /// words of its memories. Names start below the circuit's scope. Signals in a bundle are
    /// included.
    pub fn own(&self) -> Vec<(usize, String)> {
        let parts = self.parts();
        let name = |(index, leaf): (usize, &Declaration)| match &leaf.scopes[..] {
            [_] => Some((index, leaf.name.clone())),
            [_, bundle] if !parts.contains(bundle.as_str()) => {
                Some((index, format!("{bundle}.{}", leaf.name)))
            }
            _ => None,
        };
        self.signals().filter_map(name).collect()
    }

    /// Returns the scopes in the circuit that are parts. A bundle holds signals of one role, and a
    /// part has others beside them.
    fn parts(&self) -> HashSet<&str> {
        let mut roles = HashMap::new();
        let inner = self.signals().filter_map(|(_, leaf)| {
            let scope = leaf.scopes.get(1)?;
            Some((scope.as_str(), leaf.role))
        });
        let words = self.memories.iter().filter_map(|memory| {
            let scope = memory.scopes.get(1)?;
            Some((scope.as_str(), Role::Register))
        });
        let other = |(scope, role)| (*roles.entry(scope).or_insert(role) != role).then_some(scope);
        inner.chain(words).filter_map(other).collect()
    }

    /// Returns the leaves with their indices, without the words of memories.
    pub(crate) fn signals(&self) -> impl Iterator<Item = (usize, &Declaration)> {
        let mut memories = self.memories.iter().peekable();
        let mut index = 0;
        std::iter::from_fn(move || {
            while let Some(memory) = memories.next_if(|memory| memory.first == index) {
                index += memory.words;
            }
            let leaf = self.leaves.get(index)?;
            index += 1;
            Some((index - 1, leaf))
        })
    }
}

/// Receiver of a circuit's signals without their values.
pub(crate) trait Outline {
    /// Enters a struct.
    fn enter(&mut self, field: &'static Field);
    /// Leaves the struct entered last.
    fn leave(&mut self);
    /// Marks the next leaf or struct as element `index` of an array.
    fn element(&mut self, index: usize);
    /// Sets the number of fraction bits of the next leaf.
    fn fraction(&mut self, _bits: usize) {}
    /// Receives a leaf.
    fn leaf(&mut self, field: &'static Field, shape: Shape);
    /// Receives a memory of `words` words, each named after `label`.
    fn memory(&mut self, field: &'static Field, label: &'static Field, words: usize, width: usize);
}

impl Outline for Declarations {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn fraction(&mut self, bits: usize) {
        self.fraction = bits;
    }
    fn leaf(&mut self, field: &'static Field, shape: Shape) {
        let name = self.path.name(field);
        let scopes = match self.leaves.last() {
            Some(last) if *last.scopes == *self.path.scopes() => last.scopes.clone(),
            _ => self.path.scopes().into(),
        };
        self.leaves.push(Declaration {
            scopes,
            name,
            role: self.path.role(),
            shape,
            fraction: std::mem::take(&mut self.fraction),
            power_on: 0,
            field,
            part: self.path.outermost_role(),
            circuit: self.path.circuit,
        });
    }
    fn memory(&mut self, field: &'static Field, label: &'static Field, words: usize, width: usize) {
        let scopes = self.path.scopes().to_vec();
        let first = self.leaves.len();
        self.enter(field);
        let name = self.path.scopes().last().cloned().unwrap_or_default();
        let word = Declaration {
            scopes: self.path.scopes().into(),
            name: String::new(),
            role: self.path.role(),
            shape: unsigned(width),
            fraction: 0,
            power_on: 0,
            field: label,
            part: self.path.outermost_role(),
            circuit: self.path.circuit,
        };
        self.leaves.extend((0..words).map(|index| Declaration {
            name: label.element(index).into_owned(),
            ..word.clone()
        }));
        self.leave();
        self.memories.push(MemoryDeclaration {
            scopes,
            name,
            first,
            words,
            width,
            field,
        });
    }
}
