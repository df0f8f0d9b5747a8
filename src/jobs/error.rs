//! Reasons why a job cannot be played.

use crate::engine::EngineError;
use crate::settings::SettingError;
use crate::sim::RunError;

/// Reason why a job cannot be played.
#[derive(thiserror::Error)]
pub enum JobError {
    /// A setting that a circuit or a plant does not take.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// An error of an observer.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The circuit cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

crate::netlist::debug_as_display!(JobError);
