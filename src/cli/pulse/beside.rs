//! Results of the device, and of the same program on the conventional device of Fig. 5.

use super::Job;
use crate::cli::Failure;
use crate::cli::source::drawing_fault;
use motion_rtl::circuits::pulse_interpolator::AXIS_NAMES;
use motion_rtl::jobs::pulse_interpolator::beside::{device, least_period, orders, play};
use motion_rtl::jobs::pulse_interpolator::job::{Played, group};
use motion_rtl::jobs::pulse_interpolator::moves::{self, MoveError, Moves};
use motion_rtl::jobs::pulse_interpolator::step_dir::TimingMinima;
use motion_rtl::jobs::pulse_interpolator::{UnitDemand, demanded};
use motion_rtl::scenario::pulse_interpolator::ConventionalMoves;
use motion_rtl::sim::{Elaborated, RunError};
use serde::Serialize;

/// A device.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Its circuit.
    pub circuit: &'static str,
    /// Unit times with a word or a move.
    pub units: usize,
    /// Unit times without pulses among them, because the next one was not there yet.
    pub late_units: u64,
    /// The shortest T in ticks in which the next unit time is there, where it was looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit_ticks_least: Option<u64>,
    /// Largest distance of a pulse from where an even motion through its unit time has it.
    pub jitter_ticks_max: f64,
    /// Largest distance from the exact demand at the end of a unit time.
    pub end_error_steps_max: f64,
    /// True if the driver's minimum times were met.
    pub timing_kept: bool,
    /// Adders, subtractors and comparators.
    pub adders: u64,
    /// Bits of the adders, subtractors and comparators.
    pub adder_bits: u64,
    /// Bits of registers.
    pub flip_flops: u64,
    /// Bits of memories.
    pub memory_bits: u64,
}

impl Row {
    fn costing(self, model: &Elaborated) -> Self {
        let cost = model.cost();
        Row {
            circuit: model.name(),
            adders: cost.adders,
            adder_bits: cost.adder_bits,
            flip_flops: cost.register_bits,
            memory_bits: cost.memory_bits,
            ..self
        }
    }
}

/// Largest distance of positions from the demand, each at the end of its unit time; behind the path
/// the demand is its end.
fn end_error(demands: &[UnitDemand], positions: &[i32], axes: usize) -> f64 {
    let demands = demands.iter().chain(demands.last().into_iter().cycle());
    let units = demands.zip(positions.chunks_exact(axes));
    let errors = units.flat_map(|(demand, at)| {
        let pairs = demand.exact.iter().zip(at);
        pairs.map(|(exact, at)| (exact - f64::from(*at)).abs())
    });
    errors.fold(0.0, f64::max)
}

/// Largest of some values, or 0.
fn most(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// The device as it played a job, without the search for its least T.
pub fn own(job: &Job, played: &Played, end_error: f64) -> Result<Row, Failure> {
    let model = Elaborated::new(&group(&job.table, job.variant.into())).map_err(RunError::from)?;
    let kept = |minima: TimingMinima| minima.too_short(&job.settings.timing).next().is_none();
    let row = Row {
        circuit: "",
        units: played.positions.units,
        late_units: played.idle_units,
        unit_ticks_least: None,
        jitter_ticks_max: most(played.axes.iter().map(|axis| axis.jitter)),
        end_error_steps_max: end_error,
        timing_kept: played.axes.iter().all(|axis| kept(axis.minima)),
        adders: 0,
        adder_bits: 0,
        flip_flops: 0,
        memory_bits: 0,
    };
    Ok(row.costing(&model))
}

/// The moves of the conventional device, and where the axes are to be at the end of their unit times.
pub fn moves(job: &Job) -> Result<Moves, Failure> {
    if job.conventional_moves == ConventionalMoves::Pieces {
        let refuse = |error| match error {
            MoveError::Move {
                line,
                field,
                problem,
                allowed,
            } => drawing_fault(&job.drawing, line, field, problem, allowed).into(),
            MoveError::Scales => {
                let problem = "of X and Y differ, and the conventional device is given arcs";
                let allowed = "the same of both, or conventional_moves = \"unit_times\"";
                let (problem, allowed) = (problem.to_owned(), allowed.to_owned());
                job.loaded.fault("steps_per_mm", problem, allowed).into()
            }
            MoveError::Run(error) => Failure::Run(error),
        };
        return moves::moves(&job.drawing, &job.settings).map_err(refuse);
    }
    let demands = demanded(&job.drawing, &job.settings, &job.table, job.path_units());
    let demands = demands.map_err(|error| Failure::Check(error.to_string()))?;
    Ok(Moves {
        orders: orders(&demands, &job.settings.timing),
        demands,
    })
}

/// Both devices, and what is wrong with the run of the conventional one; empty where nothing is.
pub fn compare(job: &Job, own: Row) -> Result<(Vec<Row>, Vec<String>), Failure> {
    let (table, timing) = (&job.table, &job.settings.timing);
    let axes = table.axes();
    let Moves { orders, demands } = moves(job)?;
    let circuit = device(axes, &orders);
    let beside = play(&circuit, &orders, None, &mut ())?;
    let kept = |minima: TimingMinima| minima.too_short(timing).next().is_none();
    let model = Elaborated::new(&circuit).map_err(RunError::from)?;
    let own = Row {
        unit_ticks_least: Some(least_period(table, job.variant.into())?.into()),
        ..own
    };
    let other = Row {
        units: beside.positions.len() / axes,
        late_units: beside.late_units,
        unit_ticks_least: Some(beside.needed),
        jitter_ticks_max: most(beside.jitter.iter().copied()),
        end_error_steps_max: end_error(&demands, &beside.positions, axes),
        timing_kept: beside.minima.iter().all(|minima| kept(*minima)),
        ..own
    };
    let rows = vec![own, other.costing(&model)];
    let ends = beside.positions.iter().rev().take(axes).rev();
    let astray = ends.zip(&job.report.axes).zip(AXIS_NAMES);
    let astray = astray.filter_map(|((end, report), name)| {
        let wanted = report.steps_demanded;
        (i64::from(*end) != wanted).then(|| {
            format!("{name}: {end} steps by the conventional device where {wanted} are demanded")
        })
    });
    Ok((rows, astray.collect()))
}
