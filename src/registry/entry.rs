use super::{AnyCircuit, AnyModel};
use crate::check::Specified;
use crate::hdl::{Circuit, Declarations};
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
    /// Its widths.
    pub widths: &'static [Width<C>],
    /// It with its proofs, if it has some.
    pub proved: Option<fn(C) -> Box<dyn AnyCircuit>>,
}

/// A width by its name.
pub type Width<C> = (&'static str, fn(&mut C) -> &mut usize);

impl<C: Circuit> Of<C> {
    fn build(&self, request: &Request) -> Result<C, Refused> {
        if self.widths.is_empty() && !request.named.is_empty() {
            return Err(Refused::NoWidths);
        }
        let named = request.named.iter().map(|(_, bits)| *bits);
        if let Some(bits) = named.chain(request.width).find(|bits| *bits > MOST) {
            return Err(Refused::Wrong(format!("{bits} is no width")));
        }
        let refused = |given: &[u64]| Refused::Numbers(given.to_vec());
        let mut circuit = match request.width {
            Some(width) => {
                let mut given = vec![width];
                given.extend(&request.with);
                (self.from)(&given).ok_or_else(|| refused(&given))?
            }
            None => {
                (self.with)((self.full)(), &request.with).ok_or_else(|| refused(&request.with))?
            }
        };
        for (name, bits) in &request.named {
            let known = self.widths.iter().find(|(known, _)| known == name);
            let (_, width) = known.ok_or_else(|| Refused::NoSuchWidth {
                name: name.clone(),
                names: self.widths.iter().map(|(name, _)| *name).collect(),
            })?;
            *width(&mut circuit) = usize::try_from(*bits).unwrap_or(usize::MAX);
        }
        match crate::hdl::elaborate(&circuit) {
            Ok(_) => Ok(circuit),
            Err(wrong) => Err(Refused::Wrong(wrong.to_string())),
        }
    }
}

impl<C: Circuit> Maker for Of<C> {
    fn widths(&self) -> Vec<(&'static str, usize)> {
        let mut full = (self.full)();
        let widths = self.widths.iter();
        widths
            .map(|(name, width)| (*name, *width(&mut full)))
            .collect()
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
        if self.widths.is_empty() && request.width.is_some() {
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
/// `widths: [half_period = widths.half_period]` names a width and the field that it is; `[width]` is
/// short for `[width = width]`. `from` makes the circuit from numbers, the first a width; `with`
/// changes the full one by the numbers behind. `proved: 3` says at which width it is proved,
/// `proved: none` that it is not.
macro_rules! entry {
    (
        $circuit:ty, $source:literal,
        full: $full:expr,
        widths: [$($name:ident $(= $first:ident $(. $field:ident)*)?),* $(,)?],
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
                widths: &[$((
                    stringify!($name),
                    |circuit: &mut $circuit| entry!(@field circuit $name $($first $(. $field)*)?),
                )),*],
                proved: entry!(@proof $proved),
            },
        }
    };
    (@either $own:expr) => { $own };
    (@either $own:expr, $named:literal) => { $named };
    (@width none) => { None };
    (@width $width:literal) => { Some($width) };
    (@proof none) => { None };
    (@proof $width:literal) => { Some($crate::registry::entry::specified) };
    (@field $circuit:ident $name:ident) => { &mut $circuit.$name };
    (@field $circuit:ident $name:ident $first:ident $(. $field:ident)*) => {
        &mut $circuit.$first$(.$field)*
    };
}

pub(super) use entry;
