//! A circuit of the catalogue that is asked for on the command line.

use super::{Failure, check::entry};
use clap::Args;
use motion_rtl::registry::AnyModel;

/// Which circuit, and how it is made.
#[derive(Debug, Args)]
pub struct Chosen {
    /// The circuit.
    circuit: String,
    /// Width of the words, in bits; without it the circuit's own widths, as `list` shows them.
    #[arg(long, value_name = "BITS", allow_negative_numbers = true)]
    width: Option<u64>,
    /// What else the circuit is made with, as `list` tells.
    #[arg(
        long,
        value_name = "NUMBERS",
        allow_negative_numbers = true,
        value_delimiter = ',',
        requires = "width"
    )]
    with: Vec<u64>,
}

impl Chosen {
    /// It.
    pub fn model(&self) -> Result<Box<dyn AnyModel>, Failure> {
        let entry = entry(&self.circuit)?;
        let Some(width) = self.width else {
            return Ok((entry.full)());
        };
        if entry.offered.is_empty() {
            return Err(Failure::Argument {
                field: "--width",
                problem: format!("{} has no widths to choose", entry.name),
                allowed: "none".into(),
            });
        }
        let mut given = vec![width];
        given.extend(&self.with);
        (entry.model)(&given).ok_or_else(|| {
            let widths: Vec<String> = entry.offered.iter().map(u64::to_string).collect();
            Failure::Argument {
                field: match entry.offered.contains(&width) {
                    true => "--with",
                    false => "--width",
                },
                problem: format!("{} cannot be made with {given:?}", entry.name),
                allowed: format!(
                    "{}, the first of them one of {}",
                    entry.arguments,
                    widths.join(", ")
                ),
            }
        })
    }
}
