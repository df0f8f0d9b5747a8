//! A single fault: each check that finds it, with waves.

use super::{Campaign, CampaignError, Found, Made, Pair, Shown, of_all};
use crate::check::{Stimulus, Violation, stem};
use crate::engine::Watch;
use crate::hdl::{Mutation, mutation::mutated};
use crate::registry::{Entry, ProofSearch, Verdict};
use crate::sim::{Elaborated, RunError};
use crate::trace::chart::{Chart, ChartFailure};
use crate::trace::{Both, Clock, play_both};
use std::path::{Path, PathBuf};

/// Result of the checks of a circuit with a single fault.
#[derive(Debug, Default)]
pub struct Single {
    /// The checks that find the fault.
    pub found: Vec<Witness>,
    /// Properties that hold in spite of the fault.
    pub hold: Vec<String>,
    /// Properties without a result, and the reason.
    pub undecided: Option<(Vec<String>, String)>,
    /// Run on random inputs that shows the fault at an output port. It is tried only if no check
    /// of the circuit itself finds the fault.
    pub random: Option<Witness>,
    /// Reason why the circuit cannot be elaborated with the fault.
    pub refused: Option<String>,
}

/// A run on which a fault shows.
#[derive(Debug)]
pub struct Witness {
    /// The check that finds the fault; `None` for a run on random inputs.
    pub by: Option<Found>,
    /// Title of the chart, name of the property, or statement of the law.
    pub name: String,
    /// Circuit that was run.
    pub circuit: &'static str,
    /// Tick at which it shows.
    pub tick: u64,
    /// Description of the failure.
    pub report: String,
    /// First signal that differs from the circuit without the fault: tick, signal and values.
    pub first: Option<String>,
    /// Waves with and without the fault, and their save file.
    pub waves: Result<Vec<PathBuf>, RunError>,
}

/// A circuit without and with a fault.
struct Models<'m> {
    good: &'m Elaborated,
    faulty: &'m Elaborated,
}

impl Models<'_> {
    /// Replays the run on which the fault shows.
    fn witness(
        &self,
        (by, name): (Option<Found>, &str),
        (inputs, tick): (&[Vec<u64>], u64),
        report: String,
        dir: &Path,
    ) -> Witness {
        let circuit = self.good.name();
        let stem = format!("{}_with_fault", stem(circuit, name));
        let models = [self.faulty, self.good];
        let Both { first, files } = play_both(models, inputs, Clock::default(), dir, &stem);
        Witness {
            by,
            name: name.to_owned(),
            circuit,
            tick,
            report,
            first,
            waves: files,
        }
    }

    fn violation(&self, by: Found, found: &Violation, dir: &Path) -> Witness {
        let run = (found.inputs(), found.tick());
        self.witness((Some(by), found.invariant()), run, found.to_string(), dir)
    }
}

impl Campaign {
    /// Returns the faults of a circuit in the order of [`run`](Self::run).
    ///
    /// # Errors
    /// The circuit, or one that a chart is of, cannot be made or elaborated.
    pub fn faults(
        &self,
        entry: &'static Entry,
        pairs: &[Pair],
    ) -> Result<Vec<Mutation>, CampaignError> {
        let (own, _) = self.made(entry, pairs)?;
        Ok(of_all(&own, pairs))
    }

    /// Puts a single fault into a circuit and runs all of its charts, proves each of its properties
    /// at small widths with `pairs`, and sweeps its law. If nothing finds the fault, it runs on
    /// random inputs, and in circuits around it. Each run on which the fault shows is written into
    /// `dir` as VCD with a save file, beside the circuit without the fault.
    ///
    /// # Errors
    /// The circuit, or one that a chart is of, cannot be made or elaborated; a chart does not hold.
    pub fn single(
        &self,
        entry: &'static Entry,
        pairs: &[Pair],
        mutation: &Mutation,
        dir: &Path,
    ) -> Result<Single, CampaignError> {
        let (own, around) = self.made(entry, pairs)?;
        let mut single = Single::default();
        for made in &own {
            made.holds(&self.charts)?;
            match made.mutated(mutation) {
                None => {}
                Some(Err(error)) => {
                    single.refused = Some(error.to_string());
                    return Ok(single);
                }
                Some(Ok(faulty)) => single.found.extend(made.charts(&faulty, Found::Chart, dir)),
            }
        }
        self.properties((entry, pairs), mutation, &mut single, dir);
        single.found.extend(law(entry, mutation, dir));
        if single.found.is_empty() {
            single.random = self.random(&own, mutation, dir);
        }
        if single.random.is_some() {
            for made in &around {
                made.holds(&self.charts)?;
                let Some(Ok(faulty)) = made.mutated(mutation) else {
                    continue;
                };
                let by = |title| Found::Around(made.entry.name.to_owned(), title);
                single.found.extend(made.charts(&faulty, by, dir));
            }
        }
        Ok(single)
    }

    /// Proves the properties of the small circuit with the fault, until all that are left hold.
    fn properties(
        &self,
        (entry, pairs): (&Entry, &[Pair]),
        mutation: &Mutation,
        single: &mut Single,
        dir: &Path,
    ) {
        let Ok(circuit) = entry.proof(pairs) else {
            return;
        };
        let Ok(good) = circuit.model() else { return };
        let mut left = circuit.invariants();
        let faulty = match mutated(mutation, || circuit.model()) {
            Some(Ok(faulty)) => faulty,
            _ => {
                let reason = "the fault has no place in the circuit of the proof".to_owned();
                single.undecided = Some((left, reason));
                return;
            }
        };
        let models = Models {
            good: &good,
            faulty: &faulty,
        };
        while !left.is_empty() {
            let search = ProofSearch {
                transitions: self.transitions,
                model: Some(faulty.clone()),
                invariants: Some(&left),
                ..ProofSearch::default()
            };
            let reason = match circuit.prove(&search, &mut |_| {}) {
                Ok(Verdict::Proved(_)) => {
                    single.hold = left;
                    return;
                }
                Ok(Verdict::Broken(found)) => {
                    single
                        .found
                        .push(models.violation(Found::Proof, &found, dir));
                    let before = left.len();
                    left.retain(|name| name != found.invariant());
                    if left.len() < before {
                        continue;
                    }
                    "the circuit has inputs for which no property is promised".to_owned()
                }
                Ok(Verdict::Undecided(progress)) => {
                    format!("given up after {} transitions", progress.transitions)
                }
                Err(error) => error.to_string(),
            };
            single.undecided = Some((left, reason));
            return;
        }
    }

    /// Returns the run on random inputs that shows the fault at an output port.
    fn random(&self, own: &[Made<'_>], mutation: &Mutation, dir: &Path) -> Option<Witness> {
        own.iter().find_map(|made| {
            let faulty = made.mutated(mutation)?.ok()?;
            let shown: Shown = self.shown(&made.model);
            let (run, tick, port) = self.shows(&shown, &faulty)?;
            let pairs: Vec<_> = made.pairs.iter().map(Pair::to_string).collect();
            let name = format!("random run {run}");
            let report = format!(
                "tick {tick}: {port} shows it in {name} of {}[{}]",
                made.base,
                pairs.join(", ")
            );
            let models = Models {
                good: &made.model,
                faulty: &faulty,
            };
            let inputs = random_inputs(&made.model, run, tick);
            Some(models.witness((None, &name), (&inputs, tick), report, dir))
        })
    }
}

impl Made<'_> {
    /// Returns the charts that find a fault.
    fn charts(
        &self,
        faulty: &Elaborated,
        by: impl Fn(String) -> Found,
        dir: &Path,
    ) -> Vec<Witness> {
        let models = Models {
            good: &self.model,
            faulty,
        };
        let witness = |chart: &&Chart| {
            let Err(ChartFailure::Mismatch(mismatch)) = chart.run_on(faulty) else {
                return None;
            };
            // The chart holds without the fault, so its inputs can be read.
            let inputs = chart.inputs(&self.model).ok()?;
            let name = (Some(by(chart.title.clone())), chart.title.as_str());
            let run = (&inputs[..], mismatch.tick);
            Some(models.witness(name, run, mismatch.to_string(), dir))
        };
        self.charts.iter().filter_map(witness).collect()
    }
}

/// Sweeps the law of the least circuit with the fault.
fn law(entry: &Entry, mutation: &Mutation, dir: &Path) -> Option<Witness> {
    let law = entry.least_law()?;
    let good = law.model().ok()?;
    let faulty = mutated(mutation, || law.model())?.ok()?;
    let swept = law.sweep(0..law.cases().ok()?, Some(faulty.clone()), &|_| {});
    let Ok(Verdict::Broken(found)) = swept else {
        return None;
    };
    let models = Models {
        good: &good,
        faulty: &faulty,
    };
    Some(models.violation(Found::Law, &found, dir))
}

/// Returns the inputs of a random run up to a tick, as [`Campaign::play`] drives them.
fn random_inputs(model: &Elaborated, run: u64, last: u64) -> Vec<Vec<u64>> {
    let mut engine = model.engine(Watch::All);
    let mut random = Stimulus::new(run);
    let ports = 0..model.outline().inputs();
    let tick = |_| {
        random.apply(&mut engine);
        engine.settle();
        let words = ports.clone().map(|port| engine.word(port)).collect();
        engine.edge();
        words
    };
    (0..=last).map(tick).collect()
}
