//! All circuits by name: what `list` and `check` show, what a note's timing charts run.

mod campaign;
mod circuits;
mod entry;
mod model;
mod sweep;

pub use campaign::{Campaign, CampaignError, Fate, Found, Suspect};
pub use circuits::CATALOGUE;
pub use entry::{Entry, Refused, Request, WIDTHS};
pub use model::{AnyCircuit, AnyModel, ProofSearch, Verdict};
pub use sweep::{AnySweep, SWEEPS, SweepEntry};

/// The entry of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}

/// The laws of the circuit of that name.
pub fn sweeps(circuit: &str) -> impl Iterator<Item = &'static SweepEntry> {
    SWEEPS.iter().filter(move |entry| entry.circuit == circuit)
}
