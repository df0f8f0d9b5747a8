//! Signals by name, in the order of a walk.

use super::Circuit;
use super::record::unsigned;
use super::signal::{Field, Role, Shape};
use std::sync::Arc;

/// Where a walk is: the scopes around the next leaf and the part of the circuit it belongs to.
///
/// Keep one in a [`Source`](super::Source) or [`Sink`](super::Sink) and pass it every `enter`, `leave` and
/// `element`.
#[derive(Debug, Clone, Default)]
pub struct Path {
    scopes: Vec<String>,
    /// For every struct entered.
    entered: Vec<Around>,
    role: Option<Role>,
    /// Scopes up to and with that of the circuit it is in.
    circuit: usize,
    element: Option<usize>,
}

/// State of a walk before a struct was entered.
#[derive(Debug, Clone)]
struct Around {
    /// The struct added a scope.
    scoped: bool,
    role: Option<Role>,
    circuit: usize,
}

impl Path {
    /// A struct begins.
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

    /// The struct entered last ends.
    pub fn leave(&mut self) {
        if let Some(around) = self.entered.pop() {
            (self.role, self.circuit) = (around.role, around.circuit);
            if around.scoped {
                self.scopes.pop();
            }
        }
    }

    /// What comes next is element `index` of an array.
    pub fn element(&mut self, index: usize) {
        self.element = Some(index);
    }

    /// The name of the leaf or scope that comes now.
    pub fn name(&mut self, field: &'static Field) -> String {
        match self.element.take() {
            Some(index) => field.element(index).into_owned(),
            None => field.name.to_owned(),
        }
    }

    /// The scopes around it, outermost first.
    pub fn scopes(&self) -> &[String] {
        &self.scopes
    }

    /// The part of the circuit it belongs to.
    pub fn role(&self) -> Role {
        self.role.unwrap_or(Role::Net)
    }

    /// The part of the outermost circuit that it is among.
    fn outermost_role(&self) -> Role {
        let around = self.entered.iter().find_map(|around| around.role);
        around.unwrap_or(self.role())
    }
}

/// One leaf of a walk, without its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// The scopes around it, outermost first; words of a memory share them.
    pub scopes: Arc<[String]>,
    /// Its name in the innermost scope.
    pub name: String,
    /// Port in, register or net.
    pub role: Role,
    /// Kind and width.
    pub shape: Shape,
    /// Its bits at power-on, with every port in low.
    pub power_on: u64,
    /// What `signals!` says of it.
    pub field: &'static Field,
    /// The part of the whole circuit that it is among.
    pub(crate) part: Role,
    /// How many of the scopes there are up to that of its own circuit; the others are bundles and
    /// memories.
    pub(crate) circuit: usize,
}

impl Declaration {
    /// True if its own circuit has it as a port out.
    pub(crate) fn is_port_out(&self) -> bool {
        self.role != Role::Input && self.field.public
    }

    /// Scopes and name joined by dots.
    pub fn path(&self) -> String {
        let mut path = self.scopes.join(".");
        if !path.is_empty() {
            path.push('.');
        }
        path + &self.name
    }

    /// Scopes and name, outermost first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.scopes.iter().chain([&self.name]).map(String::as_str)
    }
}

/// A memory of a walk; its words are leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryDeclaration {
    /// The scopes around it, outermost first.
    pub scopes: Vec<String>,
    /// Its name in the innermost scope, and the scope of its words.
    pub name: String,
    /// The leaf that is its first word.
    pub first: usize,
    /// The number of its words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// What `signals!` says of it.
    pub field: &'static Field,
}

/// Every leaf of a walk, in its order.
#[derive(Debug, Clone, Default)]
pub struct Declarations {
    /// The leaves; the index is a leaf's identity.
    pub leaves: Vec<Declaration>,
    /// The memories, in the order of their first words.
    pub memories: Vec<MemoryDeclaration>,
    path: Path,
}

impl Declarations {
    /// The signals of a circuit, in the order of its leaves. What they are at power-on is left at 0; a
    /// [`Model`](super::Model) knows it.
    pub fn of<C: Circuit>(circuit: &C) -> Self {
        super::declarations(circuit, &mut |_| {})
    }

    /// None, in a scope of that name.
    pub(crate) fn within(scope: &str) -> Self {
        Declarations {
            path: Path {
                scopes: vec![scope.to_owned()],
                ..Path::default()
            },
            ..Declarations::default()
        }
    }

    /// How many of the leaves are ports in, the first ones.
    pub fn inputs(&self) -> usize {
        self.before(Role::Register)
    }

    /// How many are ports in or registers.
    pub(crate) fn before(&self, role: Role) -> usize {
        let order = |role| match role {
            Role::Input => 0,
            Role::Register => 1,
            Role::Net => 2,
        };
        // Parts within have ports in of their own among the nets.
        let outer = |place: &Declaration| order(place.part) < order(role);
        self.leaves.iter().take_while(|leaf| outer(leaf)).count()
    }

    /// The circuit's own leaves, those of its blocks and the words of its memories left out: their
    /// indices, and their names from the circuit's scope. What stands in a bundle is its own.
    pub fn own(&self) -> Vec<(usize, String)> {
        let name = |(index, leaf): (usize, &Declaration)| match &leaf.scopes[..] {
            [_] => Some((index, leaf.name.clone())),
            [_, bundle] if self.is_bundled(index) => {
                Some((index, format!("{bundle}.{}", leaf.name)))
            }
            _ => None,
        };
        self.leaves.iter().enumerate().filter_map(name).collect()
    }

    /// True if a signal stands in a struct that is neither a memory nor a block, whose signals of
    /// other roles would stand beside it.
    fn is_bundled(&self, index: usize) -> bool {
        let leaf = &self.leaves[index];
        let is_word = |memory: &MemoryDeclaration| {
            (memory.first..memory.first + memory.words).contains(&index)
        };
        let of_a_block = |other: &Declaration| {
            other.role != leaf.role && other.scopes.starts_with(&leaf.scopes[..])
        };
        !self.memories.iter().any(is_word) && !self.leaves.iter().any(of_a_block)
    }
}

/// Sees what the signals of a circuit are, without their values.
pub(crate) trait Outline {
    /// A struct begins.
    fn enter(&mut self, field: &'static Field);
    /// The struct entered last ends.
    fn leave(&mut self);
    /// What comes next is element `index` of an array.
    fn element(&mut self, index: usize);
    /// A leaf.
    fn leaf(&mut self, field: &'static Field, shape: Shape);
    /// A memory of so many words, each of which is called `label`.
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
