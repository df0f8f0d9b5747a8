//! Files of printed circuits, and what the printers of all languages share: modules with their
//! parameters, names of subexpressions, statements at the clock edge, comments.

mod definitions;
mod design;
mod fold;
mod names;
mod outputs;
mod statements;
mod text;

pub(crate) use definitions::{Definition, definitions};
pub(crate) use design::{Modules, Parameter, is_own_register, own_memories, stored};
pub(crate) use fold::folded;
pub(crate) use names::{Names, Rules, index_width, reserved};
pub(crate) use outputs::Outputs;
pub(crate) use statements::{Statement, Values, edge};
pub(crate) use text::{Body, LINE, annotated, ascii, clean, comment};

/// A file of a design.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SourceFile {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
}
