//! The systems of a job with their waves.

use super::beside::{Planned, Run, runs, samples};
use super::{Job, OVERVIEW, window};
use crate::cli::Failure;
use crate::cli::traces::{End, Focus};
use crate::cli::waves_of::{Ending, System};
use motion_rtl::circuits::arc_generator::{ArcGenerator, Conventional};
use motion_rtl::hdl::Circuit;
use motion_rtl::input::COORDINATES;
use motion_rtl::jobs::arc_generator::beside::play_each;
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::{Command, Played, arc_generator};
use motion_rtl::jobs::arc_generator::joints::{Following, Hand, Joints};
use motion_rtl::path::record::Record;
use motion_rtl::sim::{Elaborated, Observer, RunError};

/// Rows on top of the save file of the conventional generator.
const CONVENTIONAL_OVERVIEW: [&str; 12] = [
    "sampled",
    "kind",
    "sequencer.state",
    "memory.word",
    "engine.nearest",
    "cordic.turning.iteration",
    "x",
    "y",
    "z",
    "arm.base",
    "arm.shoulder",
    "arm.elbow",
];

/// Names of the coordinates.
pub const NAMES: [&str; COORDINATES] = ["x", "y", "z"];

/// The systems of the summary. Each has two names in it: of its method and of its circuit.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    let mut systems: Vec<_> = ["patent", ArcGenerator::NAME]
        .map(|name| own(job, name))
        .into();
    let compared = [
        ("conventional", Method::new as Run),
        ("conventional, without ramps", Method::even),
        (Conventional::NAME, Method::new),
    ];
    for (name, run) in compared {
        if let Ok((arcs, records)) = runs(job, run)
            && !arcs.is_empty()
        {
            systems.push(conventional(job, name, &arcs, records));
        }
    }
    systems
}

/// A circuit, with an arm beside it if there is one.
pub fn shown<C: Circuit>(circuit: &C, arm: bool) -> Result<Elaborated, RunError> {
    Ok(match arm {
        false => Elaborated::new(circuit),
        true => Elaborated::with_beside(circuit, &Joints),
    }?)
}

fn ending(played: &Played, focus: Focus) -> Ending {
    let last = played.last.map(|command| command.counts);
    Ending {
        end: End {
            ticks: played.ticks,
            focus,
        },
        position: NAMES.into_iter().zip(last.into_iter().flatten()).collect(),
        unit: "counts",
    }
}

/// Finds the tick of one sample in a run.
struct TickOf {
    sample: u64,
    next: u64,
    tick: u64,
}

impl TickOf {
    fn new(sample: u64) -> Self {
        TickOf {
            sample,
            next: 0,
            tick: 0,
        }
    }

    fn take(&mut self, command: Command) {
        if self.next == self.sample {
            self.tick = command.tick;
        }
        self.next += 1;
    }
}

/// The whole path on the arc generator.
fn own<'a>(job: &'a Job, name: &str) -> System<'a> {
    System::new(name, job.ticks_at_least(), move || {
        let circuit = arc_generator(&job.settings);
        let model = shown(&circuit, job.arm.is_some())?;
        let run = move |circuit: &ArcGenerator, observer: &mut dyn Observer<ArcGenerator>| {
            let mut change = TickOf::new(job.change());
            let each = &mut |command| change.take(command);
            let played = super::play(job, circuit, observer, each)?;
            let focus = window(job, change.tick, &OVERVIEW);
            Ok(ending(&played, focus))
        };
        Ok((circuit, model, run))
    })
}

/// Arcs of the path on the conventional generator, each from rest to rest.
fn conventional<'a>(
    job: &'a Job,
    name: &str,
    arcs: &[Planned],
    records: Vec<Record>,
) -> System<'a> {
    let middle = samples(arcs) / 2;
    System::new(name, job.ticks_at_least(), move || {
        let circuit = Conventional::new(job.settings.rounding);
        let hand = hand(job, &circuit, &records)?;
        let model = shown(&circuit, hand.is_some())?;
        let run = move |circuit: &Conventional, observer: &mut dyn Observer<Conventional>| {
            let mut middle = TickOf::new(middle);
            let each = &mut |command| middle.take(command);
            let played = play_each(circuit, &records, job.sample_ticks, hand, observer, each)?;
            let focus = window(job, middle.tick, &CONVENTIONAL_OVERVIEW);
            Ok(ending(&played, focus))
        };
        Ok((circuit, model, run))
    })
}

/// The arm, if there is one, at the start of what the conventional generator commands; refused if it
/// cannot follow.
fn hand(job: &Job, circuit: &Conventional, records: &[Record]) -> Result<Option<Hand>, Failure> {
    let Some((arm, _)) = &job.arm else {
        return Ok(None);
    };
    let mut following = Following::new(arm, job.prepared.timing.sample_s);
    let mut refused = None;
    let each = &mut |command: Command| {
        if refused.is_none() {
            refused = following.take(job.mm(command.counts)).err();
        }
    };
    play_each(circuit, records, job.sample_ticks, None, &mut (), each)?;
    if let Some((sample, pose)) = refused {
        return Err(Failure::Check(format!(
            "command {sample} of the conventional generator: {pose}"
        )));
    }
    let start = following.finish().start;
    Ok(Some(Hand::new(arm, start, job.settings.counts_per_mm)))
}
