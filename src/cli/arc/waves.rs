//! The systems of a job with their waves.

use super::beside::{Run, runs};
use super::{Job, focus, window};
use crate::cli::Failure;
use crate::cli::traces::Focus;
use crate::cli::waves_of::{Ending, System};
use motion_rtl::circuits::arc_generator::{ArcGenerator, Conventional};
use motion_rtl::hdl::{Circuit, Model, Observer, RunError, model, model_beside};
use motion_rtl::input::{COORDINATES, Point};
use motion_rtl::jobs::arc_generator::beside::play;
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::{Played, arc_generator, play_arm};
use motion_rtl::jobs::arc_generator::joints::{Joints, follow};
use motion_rtl::path::arm::JOINTS;
use motion_rtl::path::record::Record;

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
const NAMES: [&str; COORDINATES] = ["x", "y", "z"];

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
            systems.push(conventional(job, name, records));
        }
    }
    systems
}

/// A circuit with the arm whose joints are given, if there are some.
fn shown<C: Circuit>(circuit: &C, joints: &[[i64; JOINTS]]) -> Result<Model, RunError> {
    Ok(match joints.is_empty() {
        true => model(circuit),
        false => model_beside(circuit, &Joints),
    }?)
}

fn ending(played: &Played, focus: Focus) -> Ending {
    let last = played.commands.last().map(|command| command.counts);
    Ending {
        ticks: played.ticks,
        focus,
        position: NAMES.into_iter().zip(last.into_iter().flatten()).collect(),
        unit: "counts",
    }
}

/// The whole path on the arc generator.
fn own<'a>(job: &'a Job, name: &str) -> System<'a> {
    System::new(name, job.ticks_at_least(), move || {
        let circuit = arc_generator(&job.settings);
        let joints = job.arm.as_ref().map_or(&[][..], |(_, arm)| &arm.counts);
        let model = shown(&circuit, joints)?;
        let run = move |circuit: &ArcGenerator, observer: &mut dyn Observer<ArcGenerator>| {
            let played = play_arm(circuit, &job.records, job.sample_ticks, joints, observer)?;
            Ok(ending(&played, focus(job, &played)))
        };
        Ok((circuit, model, run))
    })
}

/// The arcs of the path on the conventional generator, each from rest to rest.
fn conventional<'a>(job: &'a Job, name: &str, records: Vec<Record>) -> System<'a> {
    System::new(name, job.ticks_at_least(), move || {
        let circuit = Conventional::new(job.settings.rounding);
        let joints = joints(job, &circuit, &records)?;
        let model = shown(&circuit, &joints)?;
        let run = move |circuit: &Conventional, observer: &mut dyn Observer<Conventional>| {
            let played = play(circuit, &records, job.sample_ticks, &joints, observer)?;
            let middle = played.commands.len() / 2;
            let focus = window(job, &played, middle, &CONVENTIONAL_OVERVIEW);
            Ok(ending(&played, focus))
        };
        Ok((circuit, model, run))
    })
}

/// The joints of the arm, if there is one, at the commands of the conventional generator.
fn joints(
    job: &Job,
    circuit: &Conventional,
    records: &[Record],
) -> Result<Vec<[i64; JOINTS]>, Failure> {
    let Some((arm, _)) = &job.arm else {
        return Ok(Vec::new());
    };
    let played = play(circuit, records, job.sample_ticks, &[], &mut ())?;
    let commands = played.commands.iter();
    let points: Vec<Point> = commands.map(|command| job.mm(command.counts)).collect();
    let followed = follow(arm, &points, job.prepared.timing.sample_s);
    let followed = followed.map_err(|(sample, pose)| {
        Failure::Check(format!(
            "command {sample} of the conventional generator: {pose}"
        ))
    })?;
    Ok(followed.counts)
}
