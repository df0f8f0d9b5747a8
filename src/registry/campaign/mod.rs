//! Single faults put into circuits, and what finds them.

mod single;

pub use single::{Single, Witness};

use super::{AnyModel, Base, Entry, Pair, ProofSearch, Refused, Verdict, find};
use crate::check::Stimulus;
use crate::engine::{EngineError, Watch};
use crate::hdl::{
    Mutation,
    mutation::{mutated, mutations},
};
use crate::sim::Elaborated;
use crate::trace::chart::{Chart, ChartFailure};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A search for faults of a circuit, by timing charts, proofs and laws.
///
/// A fault is put into every instance of the circuit in a netlist. The circuit's charts run first.
/// A fault that passes them all runs on random inputs, beside the circuit without it. If the output
/// ports differ, the circuit's proof, its laws and charts of circuits around it run too.
///
/// ```
/// use motion_rtl::registry::{Campaign, Fate, find};
/// use motion_rtl::trace::chart::parse;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let charts = parse(
///     "```chart sync_stage a pulse shows a tick later
/// tick        0 1 2
/// > pulse     _ # _
/// = step      _ _ #
/// ```",
/// )?;
/// let campaign = Campaign { charts, ticks: 1_000, runs: 4, transitions: 1_000_000 };
/// let circuit = find("sync_stage").expect("it is in the catalogue");
/// let suspects = campaign.run(circuit, &[], &|_| ())?;
/// assert!(suspects.iter().any(|suspect| matches!(suspect.fate, Fate::Found(_))));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Campaign {
    /// Timing charts, of any circuits.
    pub charts: Vec<Chart>,
    /// Ticks of each run on random inputs.
    pub ticks: u64,
    /// Largest count of runs on random inputs.
    pub runs: u64,
    /// Transitions after which a proof is given up.
    pub transitions: u64,
}

/// A fault and its fate.
#[derive(Debug, Clone)]
pub struct Suspect {
    /// The fault.
    pub mutation: Mutation,
    /// Fate of the fault.
    pub fate: Fate,
}

/// Result of the search for a fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Fate {
    /// A check found it.
    Found(Found),
    /// Nothing found it, and no run on random inputs showed it at an output port.
    Unseen,
    /// With it, the circuit cannot be elaborated.
    Refused,
    /// Nothing found it, although a random run shows it.
    Missed {
        /// The circuit as it was made: base and changed keys.
        made: (Base, Vec<Pair>),
        /// The number of the random run.
        run: u64,
        /// The first tick at which it shows.
        tick: u64,
        /// Name of the output port.
        port: String,
    },
}

/// The check that found a fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Found {
    /// A chart of the circuit, by its title.
    Chart(String),
    /// The proof of the circuit.
    Proof,
    /// A law of the circuit.
    Law,
    /// A chart of a circuit around it: the circuit, and the title.
    Around(String, String),
}

/// Reasons why a search for faults cannot run.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CampaignError {
    /// The circuit, or one around it, cannot be elaborated.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The circuit, or that of a chart, does not take its keys.
    #[error("{circuit}: {refused}")]
    Refused {
        /// Number of the chart in [`Campaign::charts`], from 0; none for the circuit itself.
        chart: Option<usize>,
        /// Name of the circuit.
        circuit: &'static str,
        /// Reason of the refusal.
        refused: Refused,
    },
    /// A chart does not hold of the circuit without a fault: it would find every one.
    #[error("chart {chart}: {failure}")]
    Chart {
        /// Its number in [`Campaign::charts`], from 0.
        chart: usize,
        /// The failure of the chart.
        failure: Box<ChartFailure>,
    },
}

crate::netlist::debug_as_display!(CampaignError);

/// A circuit as it was made, and the charts of it.
struct Made<'c> {
    entry: &'static Entry,
    base: Base,
    pairs: Vec<Pair>,
    circuit: Box<dyn AnyModel>,
    model: Elaborated,
    charts: Vec<&'c Chart>,
}

impl Made<'_> {
    /// Returns the netlist with a fault; `None` if the fault has no place in it.
    fn mutated(&self, mutation: &Mutation) -> Option<Result<Elaborated, EngineError>> {
        mutated(mutation, || self.circuit.model())
    }

    /// Checks that the circuit's charts hold; they are some of `all`.
    fn holds(&self, all: &[Chart]) -> Result<(), CampaignError> {
        for chart in &self.charts {
            if let Err(failure) = chart.run_on(&self.model) {
                let number = all.iter().position(|other| std::ptr::eq(other, *chart));
                return Err(CampaignError::Chart {
                    chart: number.unwrap_or_default(),
                    failure: Box::new(failure),
                });
            }
        }
        Ok(())
    }

    /// Returns the chart that finds a fault.
    fn chart(&self, model: &Elaborated) -> Option<&Chart> {
        let mut charts = self.charts.iter().copied();
        charts.find(|chart| matches!(chart.run_on(model), Err(ChartFailure::Mismatch(_))))
    }
}

/// Values of a circuit's output ports on random inputs, per run and tick.
struct Shown {
    runs: Vec<Vec<u64>>,
}

impl Campaign {
    /// Puts faults into a circuit and returns the fate of each. With `pairs`, the faults are those
    /// of the full circuit with these keys changed, otherwise those of the charts' circuits.
    /// `progress` is called after each fault with the count of all.
    ///
    /// # Errors
    /// The circuit, or one that a chart is of, cannot be made or elaborated; a chart does not hold.
    pub fn run(
        &self,
        entry: &'static Entry,
        pairs: &[Pair],
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Suspect>, CampaignError> {
        let (own, around) = self.made(entry, pairs)?;
        for made in own.iter().chain(&around) {
            made.holds(&self.charts)?;
        }
        let found = of_all(&own, pairs);
        let shown: Vec<Shown> = own.iter().map(|made| self.shown(&made.model)).collect();
        let all = found.len();
        let suspects = found.into_par_iter().map(|mutation| {
            let fate = self.fate(&mutation, (&own, &shown), &around);
            progress(all);
            Suspect { mutation, fate }
        });
        Ok(suspects.collect())
    }

    /// Returns the circuits of the charts of `entry` with these charts, and circuits of other charts
    /// that contain it. With `pairs` the full circuit with these keys comes first; without charts
    /// the full circuit is the only one.
    fn made(
        &self,
        entry: &'static Entry,
        pairs: &[Pair],
    ) -> Result<(Vec<Made<'_>>, Vec<Made<'_>>), CampaignError> {
        let mut charts: BTreeMap<_, Vec<(usize, &Chart)>> = BTreeMap::new();
        for (number, chart) in self.charts.iter().enumerate() {
            let key = (chart.circuit.as_str(), &chart.pairs[..]);
            charts.entry(key).or_default().push((number, chart));
        }
        let full = entry.full().model()?;
        let (mut own, mut around) = (Vec::new(), Vec::new());
        for ((name, pairs), charts) in charts {
            // A chart may be of a circuit that is not in the catalogue.
            let Some(of) = find(name) else { continue };
            let refused = |refused| CampaignError::Refused {
                chart: charts.first().map(|(number, _)| *number),
                circuit: of.name,
                refused,
            };
            let circuit = of.made(Base::Small, pairs).map_err(refused)?;
            let model = circuit.model()?;
            let inside = &model.design().modules[..model.design().modules.len() - 1];
            let is_inside = inside
                .iter()
                .any(|module| of_circuit(&module.name, full.name()));
            let made = Made {
                entry: of,
                base: Base::Small,
                pairs: pairs.to_vec(),
                charts: charts.into_iter().map(|(_, chart)| chart).collect(),
                circuit,
                model,
            };
            if of.name == entry.name {
                own.push(made);
            } else if is_inside {
                around.push(made);
            }
        }
        if own.is_empty() || !pairs.is_empty() {
            let made = entry.made(Base::Full, pairs);
            let made = made.map_err(|refused| CampaignError::Refused {
                chart: None,
                circuit: entry.name,
                refused,
            })?;
            let asked = Made {
                entry,
                base: Base::Full,
                pairs: pairs.to_vec(),
                model: made.model()?,
                circuit: made,
                charts: Vec::new(),
            };
            own.insert(0, asked);
        }
        Ok((own, around))
    }

    fn shown(&self, model: &Elaborated) -> Shown {
        let runs = (0..self.runs).map(|run| {
            let mut rows = Vec::new();
            self.play(model, run, &mut |_, _, value| {
                rows.push(value);
                true
            });
            rows
        });
        Shown {
            runs: runs.collect(),
        }
    }

    /// Runs a circuit on random inputs and passes its output ports to `see`, tick by tick, until
    /// `see` returns false.
    fn play(&self, model: &Elaborated, run: u64, see: &mut dyn FnMut(u64, usize, u64) -> bool) {
        let ports = model.ports_out();
        let mut engine = model.engine(Watch::All);
        let mut random = Stimulus::new(run);
        for tick in 0..self.ticks {
            random.apply(&mut engine);
            engine.settle();
            for leaf in &ports {
                if !see(tick, *leaf, engine.word(*leaf)) {
                    return;
                }
            }
            engine.edge();
        }
    }

    /// Returns where a fault first shows: run, tick and output port.
    fn shows(&self, shown: &Shown, model: &Elaborated) -> Option<(u64, u64, String)> {
        for (run, rows) in shown.runs.iter().enumerate() {
            let mut rows = rows.iter();
            let mut seen = None;
            self.play(model, run as u64, &mut |tick, leaf, value| {
                let same = rows.next() == Some(&value);
                if !same {
                    seen = Some((tick, leaf));
                }
                same
            });
            if let Some((tick, leaf)) = seen {
                let port = model.declarations().leaves[leaf].path();
                return Some((run as u64, tick, port));
            }
        }
        None
    }

    fn fate(
        &self,
        mutation: &Mutation,
        (own, shown): (&[Made<'_>], &[Shown]),
        around: &[Made<'_>],
    ) -> Fate {
        let mut faulty = Vec::new();
        for (made, shown) in own.iter().zip(shown) {
            match made.mutated(mutation) {
                None => continue,
                Some(Err(_)) => return Fate::Refused,
                Some(Ok(model)) => {
                    if let Some(chart) = made.chart(&model) {
                        return Fate::Found(Found::Chart(chart.title.clone()));
                    }
                    faulty.push((made, shown, model));
                }
            }
        }
        let mut missed = Fate::Unseen;
        for (made, shown, model) in &faulty {
            if let Some((run, tick, port)) = self.shows(shown, model) {
                missed = Fate::Missed {
                    made: (made.base, made.pairs.clone()),
                    run,
                    tick,
                    port,
                };
                break;
            }
        }
        if missed == Fate::Unseen {
            return missed;
        }
        let entry = own.first().map(|made| made.entry);
        if let Some(found) = entry.and_then(|entry| self.proof_or_law(entry, mutation)) {
            return Fate::Found(found);
        }
        for made in around {
            if let Some(Ok(model)) = made.mutated(mutation)
                && let Some(chart) = made.chart(&model)
            {
                let circuit = made.entry.name.to_owned();
                return Fate::Found(Found::Around(circuit, chart.title.clone()));
            }
        }
        missed
    }

    /// Returns the proof or law of the circuit that finds a fault.
    fn proof_or_law(&self, entry: &Entry, mutation: &Mutation) -> Option<Found> {
        if let Ok(circuit) = entry.proof(&[])
            && let Some(Ok(model)) = mutated(mutation, || circuit.model())
        {
            let search = ProofSearch {
                transitions: self.transitions,
                model: Some(model),
                ..ProofSearch::default()
            };
            if let Ok(Verdict::Broken(_)) = circuit.prove(&search, &mut |_| {}) {
                return Some(Found::Proof);
            }
        }
        let law = entry.least_law()?;
        let model = mutated(mutation, || law.model())?.ok()?;
        let swept = law.sweep(0..law.cases().ok()?, Some(model), &|_| {});
        matches!(swept, Ok(Verdict::Broken(_))).then_some(Found::Law)
    }
}

/// Returns the faults of the circuits of charts, or with `pairs` those of the first circuit.
fn of_all(own: &[Made<'_>], pairs: &[Pair]) -> Vec<Mutation> {
    let mut found: Vec<Mutation> = Vec::new();
    let asked = if pairs.is_empty() { own.len() } else { 1 };
    for made in &own[..asked] {
        for mutation in mutations(made.model.name(), || made.circuit.model()).1 {
            if !found.contains(&mutation) {
                found.push(mutation);
            }
        }
    }
    found
}

/// True if a module is of this circuit: another of the same has a number behind its name.
fn of_circuit(module: &str, circuit: &str) -> bool {
    let rest = module.strip_prefix(circuit);
    rest.is_some_and(|rest| {
        let number = |rest: &str| rest.bytes().all(|digit| digit.is_ascii_digit());
        rest.is_empty() || rest.strip_prefix('_').is_some_and(number)
    })
}
