use super::{AnyCircuit, AnyModel};
use crate::check::Specified;
use crate::hdl::netlist::Design;
use crate::hdl::{Circuit, Declarations, Wrong};
use std::fmt;

/// Widths that circuits are proved at unless others are asked for.
pub const WIDTHS: std::ops::RangeInclusive<u64> = 2..=4;

/// More than any width or number of stages, axes or the like.
const MOST: u64 = 1 << 12;

/// One circuit of the catalogue.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it does, in one line.
    pub about: &'static str,
    /// Its patent and block.
    pub source: &'static str,
    /// What it is made with otherwise, in words: the numbers that [`Entry::make`] and
    /// [`Entry::model`] take.
    pub arguments: &'static str,
    /// The width it is proved at unless another is asked for; `None` where it is not proved by
    /// exhaustion.
    pub proof_width: Option<u64>,
    pub(super) maker: &'static dyn Maker,
}

/// How a circuit of the catalogue is asked for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Request {
    /// One width, from which the others follow; without it the circuit's own widths.
    pub width: Option<u64>,
    /// Single widths, by their names.
    pub named: Vec<(String, u64)>,
    /// What else it is made with.
    pub with: Vec<u64>,
}

/// Why a circuit cannot be made as it is asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// It has no width of that name.
    #[error("there is no width {name}")]
    NoSuchWidth {
        /// The name.
        name: String,
        /// The names there are.
        names: Vec<&'static str>,
    },
    /// It has no widths at all.
    #[error("it has no widths")]
    NoWidths,
    /// It does not take these numbers.
    #[error("it cannot be made with {0:?}")]
    Numbers(Vec<u64>),
    /// It cannot be elaborated with these widths.
    #[error("{0}")]
    Wrong(String),
    /// It is not proved by exhaustion.
    #[error("it is not proved by exhaustion")]
    NoProof,
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entry")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Entry {
    /// Its widths by name, with their defaults.
    pub fn widths(&self) -> Vec<(&'static str, usize)> {
        self.maker.widths()
    }

    /// It with its default widths, as it is built.
    pub fn full(&self) -> Box<dyn AnyModel> {
        self.maker.full()
    }

    /// It from numbers, the first a width if it has one; `None` where there is none with them.
    pub fn model(&self, given: &[u64]) -> Option<Box<dyn AnyModel>> {
        self.maker.model(given)
    }

    /// The same with its proofs; `None` where there are none.
    pub fn make(&self, given: &[u64]) -> Option<Box<dyn AnyCircuit>> {
        self.maker.proof(given)
    }

    /// It as it is asked for.
    ///
    /// # Errors
    /// It cannot be made so.
    pub fn requested(&self, request: &Request) -> Result<Box<dyn AnyModel>, Refused> {
        self.maker.requested(request)
    }

    /// The same with its proofs.
    ///
    /// # Errors
    /// It cannot be made so, or is not proved.
    pub fn proved(&self, request: &Request) -> Result<Box<dyn AnyCircuit>, Refused> {
        self.maker.proved(request)
    }

    /// Its signals at the default widths.
    pub fn declarations(&self) -> Declarations {
        self.full().outline()
    }
}

/// Makes circuits of one kind.
pub trait Maker: Sync {
    /// Its widths by name, with their defaults.
    fn widths(&self) -> Vec<(&'static str, usize)>;
    /// With the default widths.
    fn full(&self) -> Box<dyn AnyModel>;
    /// From numbers.
    fn model(&self, given: &[u64]) -> Option<Box<dyn AnyModel>>;
    /// From numbers, with proofs.
    fn proof(&self, given: &[u64]) -> Option<Box<dyn AnyCircuit>>;
    /// As it is asked for.
    fn requested(&self, request: &Request) -> Result<Box<dyn AnyModel>, Refused>;
    /// As it is asked for, with proofs.
    fn proved(&self, request: &Request) -> Result<Box<dyn AnyCircuit>, Refused>;
}

/// How circuits of type `C` are made.
pub struct Of<C: 'static> {
    /// With the default widths.
    pub full: fn() -> C,
    /// From numbers, the first a width if it has one.
    pub from: fn(&[u64]) -> Option<C>,
    /// With other numbers than widths.
    pub with: fn(C, &[u64]) -> Option<C>,
    /// The names of its widths, and where they are.
    pub names: &'static [&'static str],
    pub fields: &'static [Field<C>],
    /// It with its proofs, if it has some.
    pub proved: Option<fn(C) -> Box<dyn AnyCircuit>>,
}

/// One of a circuit's widths.
pub type Field<C> = fn(&mut C) -> &mut usize;

impl<C: Circuit> Of<C> {
    fn build(&self, request: &Request) -> Result<C, Refused> {
        let Numbers { numbers, widths } = request.against(self.names)?;
        let made = match request.width {
            Some(_) => (self.from)(&numbers),
            None => (self.with)((self.full)(), &numbers),
        };
        let Some(mut circuit) = made else {
            return Err(Refused::Numbers(numbers));
        };
        for (width, bits) in widths {
            *self.fields[width](&mut circuit) = bits;
        }
        sound(crate::hdl::elaborate(&circuit))?;
        Ok(circuit)
    }
}

// What does not depend on the circuit's type is not made for each.

/// What a circuit is made from.
struct Numbers {
    numbers: Vec<u64>,
    /// The widths that are named, by their place, with their bits.
    widths: Vec<(usize, usize)>,
}

impl Request {
    /// What is asked for of a circuit that has widths of these names.
    fn against(&self, names: &[&'static str]) -> Result<Numbers, Refused> {
        if names.is_empty() && !self.named.is_empty() {
            return Err(Refused::NoWidths);
        }
        let named = self.named.iter().map(|(_, bits)| *bits);
        if let Some(bits) = named.chain(self.width).find(|bits| *bits > MOST) {
            return Err(Refused::Wrong(format!("{bits} is no width")));
        }
        let numbers = self.width.iter().chain(&self.with).copied().collect();
        let place = |(name, bits): &(String, u64)| {
            let known = names.iter().position(|known| known == name);
            let known = known.ok_or_else(|| Refused::NoSuchWidth {
                name: name.clone(),
                names: names.to_vec(),
            })?;
            Ok((known, usize::try_from(*bits).unwrap_or(usize::MAX)))
        };
        let widths = self.named.iter().map(place).collect::<Result<_, _>>()?;
        Ok(Numbers { numbers, widths })
    }
}

/// Whether a circuit could be elaborated.
fn sound(elaborated: Result<Design, Wrong>) -> Result<(), Refused> {
    match elaborated {
        Ok(_) => Ok(()),
        Err(wrong) => Err(Refused::Wrong(wrong.to_string())),
    }
}

/// Names with what `width` says of each.
fn named(
    names: &[&'static str],
    width: &mut dyn FnMut(usize) -> usize,
) -> Vec<(&'static str, usize)> {
    let names = names.iter().enumerate();
    names.map(|(at, name)| (*name, width(at))).collect()
}

impl<C: Circuit> Maker for Of<C> {
    fn widths(&self) -> Vec<(&'static str, usize)> {
        let mut full = (self.full)();
        named(self.names, &mut |at| *self.fields[at](&mut full))
    }

    fn full(&self) -> Box<dyn AnyModel> {
        Box::new((self.full)())
    }

    fn model(&self, given: &[u64]) -> Option<Box<dyn AnyModel>> {
        Some(Box::new((self.from)(given)?))
    }

    fn proof(&self, given: &[u64]) -> Option<Box<dyn AnyCircuit>> {
        Some(self.proved?((self.from)(given)?))
    }

    fn requested(&self, request: &Request) -> Result<Box<dyn AnyModel>, Refused> {
        // A proof may have a number that is no width.
        if self.names.is_empty() && request.width.is_some() {
            return Err(Refused::NoWidths);
        }
        Ok(Box::new(self.build(request)?))
    }

    fn proved(&self, request: &Request) -> Result<Box<dyn AnyCircuit>, Refused> {
        let proved = self.proved.ok_or(Refused::NoProof)?;
        Ok(proved(self.build(request)?))
    }
}

/// A circuit with its proofs.
pub(super) fn specified<C: Specified>(circuit: C) -> Box<dyn AnyCircuit> {
    Box::new(circuit)
}

/// What is made from a width alone.
pub(super) fn alone<C>(given: &[u64], circuit: impl FnOnce(usize) -> C) -> Option<C> {
    match given {
        [width @ 1..=64] => Some(circuit(*width as usize)),
        _ => None,
    }
}

/// What takes no numbers beside its widths.
pub(super) fn nothing<C>(circuit: C, given: &[u64]) -> Option<C> {
    given.is_empty().then_some(circuit)
}

/// An entry.
///
/// `widths: [width]` names a width that is the field of that name, `[address, time in widths]` fields
/// of a field, behind `axes;` some of the circuit's own, `[gate = lead.gate]` any field. `by` makes the
/// circuit from a width, `|width| …`, or from that and a number that chooses a field,
/// `|width, sign of SIGNS| …`, which then can be chosen of the full circuit too. What takes other
/// numbers has `from`, which makes it from all of them, the first a width, and `with`, which changes
/// the full one by the numbers behind. `proved: 3` says at which width it is proved, `proved: none`
/// that it is not.
macro_rules! entry {
    (
        $circuit:ty, $source:literal,
        full: $full:expr,
        widths: $widths:tt,
        by: $arguments:literal, |$width:ident $(, $field:ident of $choices:ident)?| $made:expr,
        proved: $($rest:tt)*
    ) => {
        entry!(
            $circuit, $source,
            full: $full,
            widths: $widths,
            from: $arguments, entry!(@from $width $($field $choices)? $made),
            with: entry!(@with $circuit $(, $field $choices)?),
            proved: $($rest)*
        )
    };
    (
        $circuit:ty, $source:literal,
        full: $full:expr,
        widths: $widths:tt,
        from: $arguments:literal, $from:expr,
        with: $with:expr,
        proved: $proved:tt
        $(, named: $named:literal, $about:literal)? $(,)?
    ) => {
        $crate::registry::Entry {
            name: entry!(@either <$circuit as $crate::hdl::Circuit>::NAME $(, $named)?),
            about: entry!(@either <$circuit as $crate::hdl::Circuit>::ABOUT $(, $about)?),
            source: $source,
            arguments: $arguments,
            proof_width: entry!(@width $proved),
            maker: &$crate::registry::entry::Of::<$circuit> {
                full: $full,
                from: $from,
                with: $with,
                names: entry!(@names $widths),
                fields: entry!(@fields $circuit, $widths),
                proved: entry!(@proof $proved),
            },
        }
    };
    (@from $width:ident $made:expr) => {
        |given| $crate::registry::entry::alone(given, |$width| $made)
    };
    (@from $width:ident $field:ident $choices:ident $made:expr) => {
        |given| {
            let $width = $crate::registry::circuits::make::width(given)?;
            let $field = $crate::registry::circuits::make::one_of(given, $choices)?;
            Some($made)
        }
    };
    (@with $circuit:ty) => { $crate::registry::entry::nothing };
    (@with $circuit:ty, $field:ident $choices:ident) => {
        |mut circuit: $circuit, given| {
            circuit.$field = $crate::registry::circuits::make::only(given, $choices)?;
            Some(circuit)
        }
    };
    (@either $own:expr) => { $own };
    (@either $own:expr, $named:literal) => { $named };
    (@width none) => { None };
    (@width $width:literal) => { Some($width) };
    (@proof none) => { None };
    (@proof $width:literal) => { Some($crate::registry::entry::specified) };
    (@names [$($own:ident),+; $($name:ident),+ in $in:ident]) => {
        &[$(stringify!($own),)+ $(stringify!($name)),+]
    };
    (@names [$($name:ident),+ in $in:ident]) => { &[$(stringify!($name)),+] };
    (@names [$($name:ident $(= $first:ident $(. $field:ident)*)?),* $(,)?]) => {
        &[$(stringify!($name)),*]
    };
    (@fields $circuit:ty, [$($own:ident),+; $($name:ident),+ in $in:ident]) => {
        &[
            $(|circuit: &mut $circuit| &mut circuit.$own,)+
            $(|circuit: &mut $circuit| &mut circuit.$in.$name),+
        ]
    };
    (@fields $circuit:ty, [$($name:ident),+ in $in:ident]) => {
        &[$(|circuit: &mut $circuit| &mut circuit.$in.$name),+]
    };
    (@fields $circuit:ty, [$($name:ident $(= $first:ident $(. $field:ident)*)?),* $(,)?]) => {
        &[$(|circuit: &mut $circuit| entry!(@field circuit $name $($first $(. $field)*)?)),*]
    };
    (@field $circuit:ident $name:ident) => { &mut $circuit.$name };
    (@field $circuit:ident $name:ident $first:ident $(. $field:ident)*) => {
        &mut $circuit.$first$(.$field)*
    };
}

pub(super) use entry;
