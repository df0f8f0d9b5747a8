use crate::hdl::{Declaration, STAGE, WORD};
use crate::netlist::Format;
use crate::sim::Described;
use std::borrow::Cow;
use std::collections::HashSet;
use std::io;
use std::ops::Range;

/// Selection of a run for a waveform.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Options {
    /// Ticks, half-open: `10..20` is ten ticks. The first one has all values.
    pub ticks: Range<u64>,
    /// Scopes and signals, by path from the circuit's name on (`machine.axis0`,
    /// `machine.axis0.count`); `None` selects all.
    pub only: Option<Vec<String>>,
}

impl Default for Options {
    /// Selects the whole run and all signals.
    fn default() -> Self {
        Options {
            ticks: 0..u64::MAX,
            only: None,
        }
    }
}

/// Error in laying out signals as a tree of scopes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A name is duplicate in a scope.
    #[error("{0} is declared twice")]
    Duplicate(String),
    /// A waveform file cannot contain the name.
    #[error("{0}: a name is made of ASCII letters, digits and underscores")]
    Name(String),
    /// A waveform file cannot contain the state name.
    #[error("{path}: state {state:?}: the name of a state is made of visible ASCII characters")]
    State {
        /// Signal.
        path: String,
        /// Name of the state.
        state: String,
    },
    /// A selected path is neither scope nor signal.
    #[error("no scope or signal is called {wanted}; scopes: {}", scopes.join(", "))]
    Unknown {
        /// Requested path.
        wanted: String,
        /// Existing scopes.
        scopes: Vec<String>,
    },
}

impl From<LayoutError> for io::Error {
    fn from(error: LayoutError) -> Self {
        io::Error::new(io::ErrorKind::InvalidInput, error)
    }
}

/// Name of the clock in the circuit's own scope.
pub(super) const CLK: &str = "clk";

/// Signals of a circuit as a tree of scopes.
///
/// Input ports, registers and nets of a circuit share a scope, though a walk visits it three
/// times.
#[derive(Debug)]
pub(crate) struct Layout {
    /// All leaves of the walk, in its order.
    pub leaves: Vec<Declaration>,
    /// For each leaf: true if it is selected.
    pub selected: Vec<bool>,
    /// Scope of the circuit, with the selected leaves.
    pub top: Scope,
    /// Selected output ports of the outermost circuit that has any selected.
    pub ports_out: Vec<usize>,
    /// Remark at the head of the waves.
    pub comment: Option<String>,
}

/// Scope with the selected leaves in it.
#[derive(Debug, Default)]
pub(crate) struct Scope {
    pub name: String,
    /// Indices of its own leaves, in the order of the walk.
    pub leaves: Vec<usize>,
    pub scopes: Vec<Scope>,
}

impl Layout {
    /// Lays out the signals of a circuit.
    pub fn of(circuit: &impl Described, only: Option<&[String]>) -> Result<Self, LayoutError> {
        let (name, declarations) = circuit.outlined();
        Layout::new(name, declarations.leaves, only)
    }

    /// Lays out the leaves of a circuit with this name.
    pub fn new(
        name: &str,
        leaves: Vec<Declaration>,
        only: Option<&[String]>,
    ) -> Result<Self, LayoutError> {
        check(name, &leaves)?;
        let mut top = Scope::tree(name, &leaves, |_| true);
        top.check(&leaves, Some(CLK))?;
        let selected = select(&leaves, only)?;
        if only.is_some() {
            top = Scope::tree(name, &leaves, |index| selected[index]);
        }
        let ports_out = ports_out(&leaves, &selected);
        Ok(Layout {
            leaves,
            selected,
            top,
            ports_out,
            comment: None,
        })
    }
}

impl Scope {
    /// Builds the circuit's scope with the selected leaves.
    fn tree(name: &str, leaves: &[Declaration], wanted: impl Fn(usize) -> bool) -> Self {
        let mut top = Scope {
            name: name.to_owned(),
            ..Scope::default()
        };
        for (index, leaf) in leaves
            .iter()
            .enumerate()
            .filter(|(index, _)| wanted(*index))
        {
            // The first scope is the circuit's own.
            top.descend(&leaf.scopes[1..]).leaves.push(index);
        }
        top
    }

    /// Returns an error for duplicate names.
    fn check(&self, leaves: &[Declaration], clk: Option<&str>) -> Result<(), LayoutError> {
        let scopes = self.scopes.iter().map(|scope| scope.name.as_str());
        let mut taken: HashSet<Cow<'_, str>> = scopes.chain(clk).map(Cow::from).collect();
        for leaf in self.leaves.iter().map(|&index| &leaves[index]) {
            let names = [Some(Cow::from(&leaf.name)), companion(leaf).map(Cow::from)];
            for name in names.into_iter().flatten() {
                if taken.contains(&name) {
                    let path = format!("{}.{name}", leaf.scopes.join("."));
                    return Err(LayoutError::Duplicate(path));
                }
                taken.insert(name);
            }
        }
        self.scopes
            .iter()
            .try_for_each(|scope| scope.check(leaves, None))
    }

    fn descend(&mut self, path: &[String]) -> &mut Scope {
        let Some((name, rest)) = path.split_first() else {
            return self;
        };
        // A walk stays in a scope for a while: search the newest first.
        let place = match self.scopes.iter().rposition(|scope| scope.name == *name) {
            Some(place) => place,
            None => {
                self.scopes.push(Scope {
                    name: name.clone(),
                    ..Scope::default()
                });
                self.scopes.len() - 1
            }
        };
        self.scopes[place].descend(rest)
    }
}

/// Returns the output ports by which a dump is compared. Output ports of a circuit inside another
/// one that has some are nets of that circuit.
fn ports_out(leaves: &[Declaration], selected: &[bool]) -> Vec<usize> {
    let is_port = |&index: &usize| selected[index] && leaves[index].is_port_out();
    let ports: Vec<usize> = (0..leaves.len()).filter(is_port).collect();
    let circuit = |index: usize| &leaves[index].scopes[..leaves[index].circuit];
    let circuits: HashSet<_> = ports.iter().map(|&index| circuit(index)).collect();
    let is_outermost = |&index: &usize| {
        let own = circuit(index);
        !(0..own.len()).any(|around| circuits.contains(&own[..around]))
    };
    ports.into_iter().filter(is_outermost).collect()
}

/// Returns the name of the string that shows a state by name, beside the state itself.
pub(super) fn companion(leaf: &Declaration) -> Option<String> {
    matches!(leaf.field.format, Format::States(_)).then(|| format!("{}_name", leaf.name))
}

/// True if a leaf is a word of a memory or shift register.
pub(super) fn is_word(leaf: &Declaration) -> bool {
    std::ptr::eq(leaf.field, &WORD) || is_stage(leaf)
}

/// True if a leaf is a stage of a shift register.
pub(super) fn is_stage(leaf: &Declaration) -> bool {
    std::ptr::eq(leaf.field, &STAGE)
}

/// Returns for each leaf if the paths select it; a path ends at a component boundary.
pub(super) fn select(
    leaves: &[Declaration],
    only: Option<&[String]>,
) -> Result<Vec<bool>, LayoutError> {
    let Some(only) = only else {
        return Ok(vec![true; leaves.len()]);
    };
    let mut selected = vec![false; leaves.len()];
    for wanted in only {
        let mut any = false;
        for (leaf, selected) in leaves.iter().zip(&mut selected) {
            let mut names = leaf.names();
            if wanted.split('.').all(|name| names.next() == Some(name)) {
                *selected = true;
                any = true;
            }
        }
        if !any {
            return Err(LayoutError::Unknown {
                wanted: wanted.clone(),
                scopes: scopes(leaves),
            });
        }
    }
    Ok(selected)
}

/// Returns the paths of all scopes, each once, in the order of the walk.
fn scopes(leaves: &[Declaration]) -> Vec<String> {
    let mut seen = HashSet::new();
    let mut scopes = Vec::new();
    for leaf in leaves {
        for depth in 1..=leaf.scopes.len() {
            let scope = &leaf.scopes[..depth];
            if seen.insert(scope) {
                scopes.push(scope.join("."));
            }
        }
    }
    scopes
}

fn is_plain(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// Returns an error for names that cannot be written.
fn check(top: &str, leaves: &[Declaration]) -> Result<(), LayoutError> {
    if !is_plain(top) {
        return Err(LayoutError::Name(top.to_owned()));
    }
    for leaf in leaves {
        if !leaf.names().all(is_plain) {
            return Err(LayoutError::Name(leaf.path()));
        }
        if let Format::States(states) = leaf.field.format {
            let visible =
                |state: &&str| !state.is_empty() && state.bytes().all(|b| b.is_ascii_graphic());
            if let Some(state) = states.iter().find(|state| !visible(state)) {
                let (path, state) = (leaf.path(), (*state).to_owned());
                return Err(LayoutError::State { path, state });
            }
        }
    }
    Ok(())
}
