//! `plan`: how a circuit is run, under random inputs; and how that of a job is.

use super::chosen::Chosen;
use super::{Failure, to_standard_output};
use clap::Args;
use motion_rtl::check::Stimulus;
use motion_rtl::engine::{Engine, Inputs, Watch, report};
use motion_rtl::hdl::Circuit;
use motion_rtl::sim::{Described, Elaborated, Needs, Observer, RunError, Sample};
use std::ops::ControlFlow;

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    chosen: Chosen,
    /// Random ticks in which blocks are counted; `run --plan` counts them in a job.
    #[arg(
        long,
        value_name = "TICKS",
        allow_negative_numbers = true,
        default_value_t = 10_000
    )]
    ticks: u64,
    /// Seed of the random inputs.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_negative_numbers = true,
        default_value_t = 1
    )]
    seed: u64,
}

pub fn plan(arguments: &Arguments) -> Result<(), Failure> {
    let circuit = arguments.chosen.model()?;
    let model = circuit.model().map_err(RunError::from)?;
    let mut engine = counting(&model);
    let mut random = Stimulus::new(arguments.seed);
    for _ in 0..arguments.ticks {
        random.apply(&mut engine);
        engine.settle();
        engine.edge();
    }
    to_standard_output(&text(&model, &engine, arguments.ticks))
}

/// The plan of a job's circuit, and what of it its inputs have woken.
pub(super) fn of_job(circuit: &impl Described, inputs: &Inputs) -> Result<String, Failure> {
    let model = circuit.described().map_err(RunError::from)?;
    let mut engine = counting(&model);
    let played = inputs.play(&mut engine);
    played.map_err(|error| Failure::Check(error.to_string()))?;
    Ok(text(&model, &engine, inputs.ticks()))
}

/// An engine that only has the ports out looked at, and counts.
fn counting(model: &Elaborated) -> Engine {
    let mut engine = model.engine(Watch::Leaves(&model.ports_out()));
    engine.interpret();
    engine
}

fn text(model: &Elaborated, engine: &Engine, ticks: u64) -> String {
    let leaves = &model.outline().leaves;
    let name = |leaf: usize| {
        let path = leaves[leaf].path();
        let below = path.split_once('.').map(|(_, below)| below.to_owned());
        below.unwrap_or(path)
    };
    format!(
        "{}, {ticks} ticks: {}",
        model.name(),
        report(engine, ticks, &name)
    )
}

/// Notes the inputs of a run.
#[derive(Debug, Default)]
pub struct Noted(pub Inputs);

impl<C: Circuit> Observer<C> for Noted {
    fn needs(&self) -> Needs {
        Needs::NONE
    }

    fn sample(&mut self, now: &Sample<'_, C>) -> Result<ControlFlow<()>, RunError> {
        self.0.note(now.tick, now.engine());
        Ok(ControlFlow::Continue(()))
    }
}
