//! A circuit of the catalogue that is asked for on the command line.

use super::{Failure, named};
use clap::Args;
use motion_rtl::Model;
use motion_rtl::nearest::did_you_mean;
use motion_rtl::registry::{AnyModel, Base, CATALOGUE, Entry, Pair, Refused, find};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Changed keys of a circuit.
#[derive(Debug, Clone, Default, PartialEq, Args, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Changes {
    /// Gives a key of the circuit a value, `variant=literal` for instance; `list NAME` shows the keys.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Width in bits of a circuit that has one width.
    #[arg(long, value_name = "BITS", allow_negative_numbers = true)]
    width: Vec<String>,
    /// The former way to give values.
    #[serde(skip)]
    #[arg(long, hide = true, num_args = 0.., allow_negative_numbers = true)]
    with: Option<Vec<String>>,
}

/// A circuit with changed keys.
#[derive(Debug, Args)]
pub struct Chosen {
    /// Name of the circuit.
    circuit: String,
    #[command(flatten)]
    changes: Changes,
}

/// Names of circuits, for errors.
pub const CIRCUITS: &str = "a name of a circuit; `motion-rtl list` shows all";

/// Returns the circuit with that name.
pub fn entry(name: &str) -> Result<&'static Entry, Failure> {
    find(name).ok_or_else(|| {
        let names = || CATALOGUE.iter().map(|entry| entry.name);
        let near = did_you_mean(name, names());
        Failure::Argument {
            field: "CIRCUIT",
            problem: format!("there is no {}{near}", named(name)),
            allowed: CIRCUITS.into(),
        }
    })
}

/// Returns the circuits with these names, each once; all circuits if there are no names.
pub fn entries(names: &[String]) -> Result<Vec<&'static Entry>, Failure> {
    let mut entries: Vec<&Entry> = Vec::new();
    for name in names {
        let named = entry(name)?;
        if !entries.iter().any(|other| other.name == named.name) {
            entries.push(named);
        }
    }
    if entries.is_empty() {
        entries.extend(CATALOGUE);
    }
    Ok(entries)
}

/// Returns the indices of the texts that contain `wanted`; that of a text that is `wanted` itself
/// alone.
pub fn matching<'t>(wanted: &str, texts: impl Iterator<Item = &'t str> + Clone) -> Vec<usize> {
    if let Some(index) = texts.clone().position(|text| text == wanted) {
        return vec![index];
    }
    let wanted = wanted.to_lowercase();
    let contain = texts.enumerate();
    let contain = contain.filter(|(_, text)| text.to_lowercase().contains(&wanted));
    contain.map(|(index, _)| index).collect()
}

/// Refuses changed keys of all circuits at once.
pub fn no_circuit(changes: &Changes, command: &str) -> Failure {
    if changes.with.is_some() {
        return no_numbers("values by their keys, --set KEY=VALUE; see `list`".to_owned());
    }
    Failure::Argument {
        field: "CIRCUIT",
        problem: format!("missing beside{changes}"),
        allowed: format!(
            "the circuit whose key it is, as in `{command} comparator --set comparing=equal`"
        ),
    }
}

fn no_numbers(allowed: String) -> Failure {
    Failure::Argument {
        field: "--with",
        problem: "takes no numbers".to_owned(),
        allowed,
    }
}

/// Says why a circuit cannot be made, each key on a line.
pub fn refused(entry: &Entry, refused: Refused) -> Failure {
    match refused {
        Refused::Pairs(wrong) => Failure::Pairs(wrong),
        Refused::Values(problem) => Failure::Argument {
            field: "--set",
            problem: match problem.starts_with(entry.name) {
                true => problem.clone(),
                false => format!("{}: {problem}", entry.name),
            },
            allowed: format!(
                "values with which the circuit elaborates; `motion-rtl keys {}` lists their ranges",
                entry.name
            ),
        },
        _ => Failure::Argument {
            field: "CIRCUIT",
            problem: format!("{}: {refused}", entry.name),
            allowed:
                "a circuit that `motion-rtl list` shows as proved or swept, such as its blocks"
                    .to_owned(),
        },
    }
}

impl Changes {
    /// True if no key is changed.
    pub fn is_empty(&self) -> bool {
        self.set.is_empty() && self.width.is_empty() && self.with.is_none()
    }

    /// The changed keys of a circuit, the one width among them.
    pub fn pairs(&self, entry: &Entry) -> Result<Vec<Pair>, Failure> {
        let keys = entry.keys();
        let instance = keys.first().map(|key| {
            let value = key.full.as_deref().or(key.small.as_deref());
            format!("--set {}={}", key.name, value.unwrap_or_default())
        });
        let new = instance.unwrap_or_else(|| format!("none: {} has no keys", entry.name));
        if self.with.is_some() {
            let allowed = format!("values by their keys, {new}; see `list {}`", entry.name);
            return Err(no_numbers(allowed));
        }
        let mut pairs = Vec::new();
        // Of several the last counts, as of a key.
        if let Some(bits) = self.width.last() {
            pairs.push(self.one_width(entry, bits)?);
        }
        for text in &self.set {
            pairs.push(text.parse().map_err(|_| Failure::Argument {
                field: "--set",
                problem: format!("{text:?} gives no key a value"),
                allowed: format!("KEY=VALUE, {new}"),
            })?);
        }
        Ok(pairs)
    }

    /// The width of a circuit that has one.
    fn one_width(&self, entry: &Entry, bits: &str) -> Result<Pair, Failure> {
        let refuse = |problem: String, allowed: String| Failure::Argument {
            field: "--width",
            problem,
            allowed,
        };
        let widths = entry.widths(Base::Full, &[]);
        if let Some((key, bits)) = bits.split_once('=') {
            let named = widths
                .iter()
                .find(|(name, _)| name.rsplit('.').next() == Some(key));
            let near = named.map_or(key, |(name, _)| name);
            let problem = format!("{key} is a key");
            return Err(refuse(problem, format!("--set {near}={bits}")));
        }
        match &widths[..] {
            [(key, _)] => Ok(Pair::new(key, bits)),
            [] => Err(refuse(
                format!("{} has no width to choose", entry.name),
                "none".to_owned(),
            )),
            [(first, _), ..] => {
                let keys: Vec<_> = widths.iter().map(|(key, _)| key.as_str()).collect();
                let (name, keys) = (entry.name, keys.join(", "));
                Err(refuse(
                    format!("{name} has several widths: {keys}"),
                    format!("--set {first}={bits}"),
                ))
            }
        }
    }
}

/// Formats the options as on the command line.
impl fmt::Display for Changes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for bits in &self.width {
            write!(f, " --width {bits}")?;
        }
        self.set
            .iter()
            .try_for_each(|pair| write!(f, " --set {pair}"))
    }
}

/// Formats the arguments as on the command line.
impl fmt::Display for Chosen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.circuit, self.changes)
    }
}

impl Chosen {
    /// Returns the changed keys as on the command line.
    pub fn changes(&self) -> String {
        self.changes.to_string()
    }

    /// Returns the circuit in the catalogue, and its changed keys.
    pub fn entry(&self) -> Result<(&'static Entry, Vec<Pair>), Failure> {
        let entry = entry(&self.circuit)?;
        let pairs = self.changes.pairs(entry)?;
        Ok((entry, pairs))
    }

    /// The full circuit with its changes, running, and the changed keys, one per line.
    pub fn running(&self) -> Result<(Model, String), Failure> {
        let (entry, pairs) = self.entry()?;
        let made = entry.made(Base::Full, &pairs);
        made.map_err(|error| refused(entry, error))?;
        let model = Model::new(entry.name, &pairs).map_err(|error| Failure::Argument {
            field: "CIRCUIT",
            problem: error.to_string(),
            allowed: "circuits that can be run".to_owned(),
        })?;
        let lines = pairs.iter().map(|pair| format!("{pair}\n")).collect();
        Ok((model, lines))
    }

    /// The full circuit with its changes.
    pub fn model(&self) -> Result<Box<dyn AnyModel>, Failure> {
        let (entry, pairs) = self.entry()?;
        let made = entry.made(Base::Full, &pairs);
        made.map_err(|error| refused(entry, error))
    }
}
