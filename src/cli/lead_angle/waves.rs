//! The systems of a job with their waves.

use super::systems::{NONE, systems as of_settings};
use super::{Job, alone, end, log};
use crate::cli::Failure;
use crate::cli::waves_of::{Ending, System};
use motion_rtl::circuits::lead_angle::Compensator;
use motion_rtl::jobs::lead_angle::job::{play, positioner};
use motion_rtl::plant::waves::Body;
use motion_rtl::sim::{Elaborated, Observer, RunError};

/// The systems of the summary; of a log the one that is replayed.
pub fn systems(job: &Job) -> Vec<System<'_>> {
    if let Some(of) = &job.log {
        return vec![log::system(job, of)];
    }
    let all = of_settings(&job.settings);
    let none = all.iter().find(|system| system.name == NONE).cloned();
    let each = all.into_iter().map(|mut system| {
        let none = none.clone();
        System::new(system.name, job.ticks_at_least(), move || {
            if let Some(none) = none.filter(|_| system.is_set_up()) {
                system.set_up(&alone(&none)?);
            }
            let circuit = positioner(&system.settings);
            let model = Elaborated::with_beside(&circuit, &Body).map_err(RunError::from)?;
            let run = move |circuit: &Compensator, observer: &mut dyn Observer<Compensator>| {
                let played = play(circuit, &system.settings, observer)?;
                Ok::<_, Failure>(Ending {
                    end: end(&system.settings, &played),
                    position: [("position", played.position)].into(),
                    unit: "counts",
                })
            };
            Ok((circuit, model, run))
        })
    });
    each.collect()
}
