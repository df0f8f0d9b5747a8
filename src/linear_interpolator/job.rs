//! A drawing's cycles through the linear interpolator, and through the conventional system.

use super::measure::Played;
use super::reference::{self, System};
use super::settings::Settings;
use super::targets::Target;
use crate::kernel::RunError;

/// Plays the cycles on the linear interpolator and on the conventional system of Fig. 3, each with
/// motors of its own. `each` sees the tick of every scan of the former.
///
/// # Errors
/// What an observer objects to.
pub fn play(
    targets: &[Target],
    settings: &Settings,
    mut each: impl FnMut(u64),
) -> Result<(Played, Played), RunError> {
    let interpolator = reference::play(targets, settings, System::Interpolator, &mut each);
    let conventional = reference::play(targets, settings, System::Conventional, &mut |_| ());
    Ok((interpolator, conventional))
}
