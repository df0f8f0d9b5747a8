//! The linear interpolator's jobs: the formulas they are held against, the measures they are judged
//! by, and whole runs.

mod formulas;
mod measures;
mod runs;

use motion_rtl::circuits::linear_interpolator::{MasterAxis, Rule};
use motion_rtl::input::read_text;
use motion_rtl::jobs::linear_interpolator::job::{conventional, play, play_each, plotter};
use motion_rtl::jobs::linear_interpolator::measure::{
    Cycle, Deviation, Measuring, Played, ScanRecord, Seen, Segment,
};
use motion_rtl::jobs::linear_interpolator::profile::{Profile, SPEED_ONE};
use motion_rtl::jobs::linear_interpolator::reference::{self, Integrator, Pattern};
use motion_rtl::jobs::linear_interpolator::settings::Settings;
use motion_rtl::jobs::linear_interpolator::targets::{LATENCY_TICKS, Target, compile};
use motion_rtl::jobs::linear_interpolator::ways::Way;

const RULES: [Rule; 3] = [Rule::Floor, Rule::Truncating, Rule::Centred];

fn profile(speed: u64, times: [u64; 2]) -> Profile {
    Profile {
        speed,
        acceleration_scans: times[0],
        deceleration_scans: times[1],
    }
}
