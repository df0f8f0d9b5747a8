//! A circuit of the catalogue that is asked for on the command line.

use super::{Failure, check::entry};
use clap::Args;
use motion_rtl::registry::{AnyModel, Entry, Refused, Request};
use std::fmt;
use std::str::FromStr;

/// Which circuit, and how it is made.
#[derive(Debug, Args)]
pub struct Chosen {
    /// The circuit.
    circuit: String,
    /// Width of the words, in bits, or of one of them by its name (`position=20`); without it the
    /// circuit's own widths, as `list` shows them.
    #[arg(long, value_name = "[NAME=]BITS", allow_negative_numbers = true)]
    width: Vec<Width>,
    /// What else the circuit is made with, as `list` tells.
    #[arg(
        long,
        value_name = "NUMBERS",
        allow_negative_numbers = true,
        value_delimiter = ','
    )]
    with: Vec<u64>,
}

/// A width: of all words, or of one by its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Width {
    name: Option<String>,
    bits: u64,
}

impl FromStr for Width {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, bits) = match text.split_once('=') {
            Some((name, bits)) => (Some(name.to_owned()), bits),
            None => (None, text),
        };
        let bits = bits.parse().map_err(|error| format!("{error}"))?;
        Ok(Width { name, bits })
    }
}

/// The width of all words, if one is given, and those of single ones by their names.
type Widths = (Option<u64>, Vec<(String, u64)>);

/// What is given.
pub fn widths(given: &[Width]) -> Result<Widths, Failure> {
    let all: Vec<u64> = given
        .iter()
        .filter(|width| width.name.is_none())
        .map(|width| width.bits)
        .collect();
    if all.len() > 1 {
        return Err(Failure::Argument {
            field: "--width",
            problem: format!("is {} and {}", all[0], all[1]),
            allowed: "one width of all words, and others by their names".into(),
        });
    }
    let named = given
        .iter()
        .filter_map(|width| Some((width.name.clone()?, width.bits)));
    Ok((all.first().copied(), named.collect()))
}

/// Why a circuit cannot be made so.
pub fn refused(entry: &Entry, request: &Request, refused: &Refused) -> Failure {
    let (field, allowed) = match refused {
        Refused::NoWidths => ("--width", "none".to_owned()),
        Refused::NoSuchWidth { names, .. } => ("--width", names.join(", ")),
        Refused::Numbers(_) => ("--with", entry.arguments.to_owned()),
        Refused::Wrong(_) => ("--width", "widths that go together".to_owned()),
        Refused::NoProof => ("CIRCUIT", "its blocks".to_owned()),
    };
    let (field, allowed) = match (refused, &request.with[..], request.width) {
        // Numbers that are only a width.
        (Refused::Numbers(_), [], Some(_)) => ("--width", format!("{allowed}, the width 1 to 64")),
        _ => (field, allowed),
    };
    let problem = match refused {
        Refused::NoWidths => format!("{} has no widths to choose", entry.name),
        Refused::Numbers(given) => format!("{} cannot be made with {given:?}", entry.name),
        other => format!("{}: {other}", entry.name),
    };
    Failure::Argument {
        field,
        problem,
        allowed,
    }
}

/// The arguments again.
impl fmt::Display for Chosen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.circuit)?;
        for Width { name, bits } in &self.width {
            match name {
                Some(name) => write!(f, " --width {name}={bits}")?,
                None => write!(f, " --width {bits}")?,
            }
        }
        let with: Vec<String> = self.with.iter().map(u64::to_string).collect();
        match with.is_empty() {
            true => Ok(()),
            false => write!(f, " --with {}", with.join(",")),
        }
    }
}

impl Chosen {
    /// It.
    pub fn model(&self) -> Result<Box<dyn AnyModel>, Failure> {
        let entry = entry(&self.circuit)?;
        let (width, named) = widths(&self.width)?;
        let request = Request {
            width,
            named,
            with: self.with.clone(),
        };
        entry
            .requested(&request)
            .map_err(|error| refused(entry, &request, &error))
    }
}
