//! All circuits by name, each with a full and a small value whose keys can be changed.
//!
//! ```
//! use motion_rtl::registry::{Base, Pair, find};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let comparator = find("comparator").ok_or("no such circuit")?;
//! let pairs = [Pair::new("position", 20), "comparing=equal".parse()?];
//! let circuit = comparator.made(Base::Full, &pairs)?;
//! assert_eq!(circuit.name(), "comparator");
//!
//! let refused = comparator.made(Base::Full, &["comparing=equl".parse()?]).err();
//! let text = "comparing: unknown variant `equl`; did you mean equal?; \
//!             allowed: `crossing` or `equal`";
//! assert_eq!(refused.map(|error| error.to_string()).as_deref(), Some(text));
//! # Ok(())
//! # }
//! ```

mod campaign;
mod circuits;
mod entry;
#[cfg(test)]
mod full_width;
mod keys;
mod listed;
mod model;
#[cfg(test)]
mod ports_out;
mod ranges;
mod reader;
mod running;
mod scaled;
mod sweep;

pub use crate::settings::{Pair, PairError};
pub use campaign::{Campaign, CampaignError, Fate, Found, Single, Suspect, Witness};
pub use circuits::CATALOGUE;
pub use entry::{Base, Entry};
pub use keys::{Key, Refused, WrongPair};
pub use model::{AnyCircuit, AnyModel, ProofSearch, Verdict};
pub use sweep::AnySweep;

/// Returns the entry of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}
