use super::keys::{self, Key, Refused};
use super::reader::{self, Kinds, Misread};
use super::{AnyCircuit, AnyModel, AnySweep, Pair};
use crate::check::Specified;
use crate::hdl::{Circuit, Declarations};
use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Table;

/// One circuit of the catalogue, with a full and a small value.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Name of the circuit.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Patent and block.
    pub source: &'static str,
    /// True if the small circuit is proved by exhaustion.
    pub proved: bool,
    /// True if a law of the small circuit is swept over all cases.
    pub swept: bool,
    /// The keys below `widths` that it uses; all where there are none here.
    pub(super) uses: &'static [&'static str],
    /// Other keys without an effect.
    pub(super) idle: &'static [&'static str],
    pub(super) maker: &'static dyn Maker,
}

/// The value of a circuit that keys change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// The circuit in full size.
    Full,
    /// The small circuit of proofs and timing charts.
    Small,
}

impl std::fmt::Display for Base {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Base::Full => "full",
            Base::Small => "small",
        })
    }
}

impl std::fmt::Debug for Entry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Entry")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Entry {
    /// Returns the full circuit.
    pub fn full(&self) -> Box<dyn AnyModel> {
        self.maker.value(Base::Full).model
    }

    /// Returns the small circuit.
    pub fn small(&self) -> Box<dyn AnyModel> {
        self.maker.value(Base::Small).model
    }

    /// Returns the circuit with some keys changed.
    ///
    /// # Errors
    /// Every key and value that it does not take; values that do not go together.
    pub fn made(&self, base: Base, pairs: &[Pair]) -> Result<Box<dyn AnyModel>, Refused> {
        Ok(keys::made(self, base, pairs)?.model)
    }

    /// Returns the small circuit, some keys changed, with its proofs.
    ///
    /// # Errors
    /// The cases of [`made`](Self::made); the circuit is not proved.
    pub fn proof(&self, pairs: &[Pair]) -> Result<Box<dyn AnyCircuit>, Refused> {
        let made = keys::made(self, Base::Small, pairs)?;
        made.proofs.ok_or(Refused::NoProof)
    }

    /// Returns the law of the small circuit, some keys changed.
    ///
    /// # Errors
    /// The cases of [`made`](Self::made); the circuit has no law.
    pub fn law(&self, pairs: &[Pair]) -> Result<Box<dyn AnySweep>, Refused> {
        let made = keys::made(self, Base::Small, pairs)?;
        made.law.ok_or(Refused::NoProof)
    }

    /// Returns the law of the least circuit, if there is one: of few cases.
    pub fn least_law(&self) -> Option<Box<dyn AnySweep>> {
        self.maker.least_law()
    }

    /// Returns the keys of the circuit with their values, by name.
    pub fn keys(&self) -> Vec<Key> {
        keys::all(self)
    }

    /// Returns the keys that are widths or count something, with their values in the circuit, some keys
    /// changed.
    pub fn sizes(&self, base: Base, pairs: &[Pair]) -> Vec<(String, u64)> {
        keys::sizes(self, base, pairs)
    }

    /// Returns the keys that are widths, with their bits in the circuit, some keys changed.
    pub fn widths(&self, base: Base, pairs: &[Pair]) -> Vec<(String, u64)> {
        let mut widths = self.sizes(base, pairs);
        widths.retain(|(key, _)| keys::is_width(key));
        widths
    }

    /// Returns the signals of the full circuit.
    pub fn declarations(&self) -> Declarations {
        self.full().outline()
    }

    /// True for a key that changes nothing of this circuit.
    pub(super) fn is_idle(&self, key: &str) -> bool {
        let width = key.rsplit_once("widths.");
        self.idle.contains(&key)
            || width.is_some_and(|(_, width)| !self.uses.is_empty() && !self.uses.contains(&width))
    }
}

/// A circuit, its type forgotten, with what is known of it.
pub struct Made {
    pub(super) model: Box<dyn AnyModel>,
    pub(super) proofs: Option<Box<dyn AnyCircuit>>,
    pub(super) law: Option<Box<dyn AnySweep>>,
}

/// Makes circuits of one type.
pub trait Maker: Sync {
    /// Returns the circuit without any change.
    fn value(&self, base: Base) -> Made;
    /// Writes that circuit as a table of its keys.
    fn table(&self, base: Base) -> Result<Table, toml::ser::Error>;
    /// Reads a circuit from all its keys, whose kinds it adds.
    fn read(&self, table: &Table, kinds: &Kinds) -> Result<Made, Misread>;
    /// Returns the law of the least circuit.
    fn least_law(&self) -> Option<Box<dyn AnySweep>>;
}

/// Makes circuits of type `C`.
pub struct Of<C: 'static> {
    pub full: fn() -> C,
    pub small: fn() -> C,
    /// Adds the proofs.
    pub proofs: Option<fn(C) -> Box<dyn AnyCircuit>>,
    /// Adds the law.
    pub law: Option<fn(C) -> Box<dyn AnySweep>>,
    /// The circuit whose law has the fewest cases.
    pub least: Option<fn() -> C>,
}

impl<C: Circuit> Of<C> {
    fn known(&self, circuit: C) -> Made {
        Made {
            proofs: self.proofs.map(|proofs| proofs(circuit.clone())),
            law: self.law.map(|law| law(circuit.clone())),
            model: Box::new(circuit),
        }
    }

    fn base(&self, base: Base) -> C {
        match base {
            Base::Full => (self.full)(),
            Base::Small => (self.small)(),
        }
    }
}

impl<C: Circuit + Serialize + DeserializeOwned> Maker for Of<C> {
    fn value(&self, base: Base) -> Made {
        self.known(self.base(base))
    }

    fn table(&self, base: Base) -> Result<Table, toml::ser::Error> {
        Table::try_from(self.base(base))
    }

    fn read(&self, table: &Table, kinds: &Kinds) -> Result<Made, Misread> {
        reader::read(table, kinds).map(|circuit| self.known(circuit))
    }

    fn least_law(&self) -> Option<Box<dyn AnySweep>> {
        Some((self.law?)((self.least?)()))
    }
}

/// Adds the proofs of a circuit.
pub(super) fn specified<C: Specified>(circuit: C) -> Box<dyn AnyCircuit> {
    Box::new(circuit)
}

/// An entry: type, patent and block, the full and the small circuit.
///
/// `uses: [point, data]` are the keys below `widths` that have an effect, if there are others;
/// `idle: ["loops.position"]` are other keys that have none.
/// `proved: true` says that the small circuit is proved by exhaustion. `swept: Law::new` is a law of it,
/// and `least:` the circuit with the fewest cases. `named` gives name and line if a type stands in
/// the catalogue more than once.
macro_rules! entry {
    (
        $circuit:ty, $source:literal,
        full: $full:expr,
        small: $small:expr
        $(, uses: [$($used:ident),+])?
        $(, idle: [$($idle:literal),+])?
        $(, proved: $proved:literal)?
        $(, swept: $law:path, least: $least:expr)?
        $(, named: $named:literal, $about:literal)? $(,)?
    ) => {
        $crate::registry::Entry {
            name: entry!(@either <$circuit as $crate::hdl::Circuit>::NAME $(, $named)?),
            about: entry!(@either <$circuit as $crate::hdl::Circuit>::ABOUT $(, $about)?),
            source: $source,
            proved: entry!(@either false $(, $proved)?),
            swept: entry!(@is $($law)?),
            uses: &[$($(stringify!($used)),+)?],
            idle: &[$($($idle),+)?],
            maker: &$crate::registry::entry::Of::<$circuit> {
                full: || $full,
                small: || $small,
                proofs: entry!(@proofs $($proved)?),
                law: entry!(@law $($law)?),
                least: entry!(@least $($least)?),
            },
        }
    };
    (@either $own:expr) => { $own };
    (@either $own:expr, $named:literal) => { $named };
    (@is) => { false };
    (@is $law:path) => { true };
    (@proofs) => { None };
    (@proofs $proved:literal) => { Some($crate::registry::entry::specified) };
    (@law) => { None };
    (@law $law:path) => { Some(|circuit| Box::new($law(circuit))) };
    (@least) => { None };
    (@least $least:expr) => { Some(|| $least) };
}

pub(super) use entry;
