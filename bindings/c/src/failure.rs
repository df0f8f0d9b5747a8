//! Errors of calls: a code and a text.

use crate::codes::*;
use motion_rtl::sim::ModelError;

/// Reason why a call does nothing.
#[derive(Debug)]
pub struct Failure {
    pub code: i32,
    pub text: String,
}

impl Failure {
    #[cold]
    pub fn new(code: i32, text: impl Into<String>) -> Self {
        let text = text.into();
        Failure { code, text }
    }

    #[cold]
    pub fn null(what: &str) -> Self {
        Failure::new(MRTL_NULL, format!("{what} is NULL"))
    }
}

impl From<ModelError> for Failure {
    #[cold]
    fn from(error: ModelError) -> Self {
        let code = match error {
            ModelError::UnknownCircuit { .. } | ModelError::UnknownSignal { .. } => MRTL_UNKNOWN,
            ModelError::Settings { .. } => MRTL_SETTINGS,
            ModelError::Circuit(_) => MRTL_CIRCUIT,
            ModelError::NoInput { .. } => MRTL_NO_INPUT,
            ModelError::Input { .. } => MRTL_VALUE,
            ModelError::OtherCircuit { .. } => MRTL_OTHER_CIRCUIT,
            ModelError::Waves(_) | ModelError::WavesOn { .. } => MRTL_WAVES,
            _ => MRTL_OTHER,
        };
        let text = match error {
            ModelError::WavesOn { refused } => {
                format!("{refused} while waves are written; mrtl_finish_waves() ends them")
            }
            error => error.to_string(),
        };
        Failure { code, text }
    }
}
