//! Speed and times of a position pattern.
//!
//! An acceleration time is from rest to 100 % speed (¶0004). A pattern takes the time from rest to
//! its own speed, which is proportional, so that the slope is constant.

use super::settings::{Settings, ShortMoves};
use super::targets::TIME_BITS;

/// Word of one count per scan: a speed has as many fraction bits as a time has bits.
pub const SPEED_ONE: u64 = 1 << TIME_BITS;

/// Least speed of a target in counts per scan: the fraction rounds it by at most 1 %.
pub const SLOWEST: f64 = 100.0 / SPEED_ONE as f64;

/// Relative distance below a step of the fraction that still counts as that step: floating-point
/// rounding must not lose one.
const ROUNDING: f64 = 1e-12;

/// Speed and times of one position pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Profile {
    /// Speed in counts per scan times [`SPEED_ONE`], at least 1.
    pub speed: u64,
    /// Time from rest to that speed in scans, at least 1.
    pub acceleration_scans: u64,
    /// Time from that speed to rest in scans, at least 1.
    pub deceleration_scans: u64,
}

impl Profile {
    /// Returns the profile of an axis (0 is X, 1 is Y) for a distance in counts at a speed;
    /// `times` are from rest to 100 % speed and back in scans. Without `short` a short move keeps
    /// its slope.
    pub(super) fn over(
        settings: &Settings,
        axis: usize,
        distance: u64,
        speed: u64,
        times: [u64; 2],
        short: Option<ShortMoves>,
    ) -> Self {
        let full = settings.full_speed(axis);
        let times = times.map(|time| {
            let time = (u128::from(time) * u128::from(speed)).div_ceil(u128::from(full));
            u64::try_from(time).unwrap_or(u64::MAX).max(1)
        });
        let [acceleration_scans, deceleration_scans] = match short {
            Some(ShortMoves::ConstantTime) => times,
            _ => shortened(distance, speed, times),
        };
        Profile {
            speed,
            acceleration_scans,
            deceleration_scans,
        }
    }

    /// Returns the speed in counts per scan.
    #[must_use]
    pub fn counts_per_scan(&self) -> f64 {
        self.speed as f64 / SPEED_ONE as f64
    }
}

/// Returns the word of a speed in counts per scan, never above the given one; `None` below the
/// last bit of the fraction.
pub(crate) fn speed_word(exact: f64) -> Option<u64> {
    let word = (exact * SPEED_ONE as f64 * (1.0 + ROUNDING)).floor() as u64;
    (word > 0).then_some(word)
}

/// Returns the times of acceleration and deceleration over `distance` counts at `speed`.
///
/// The two ramps take V·(Ta + Td)/2. Over a shorter distance Δ the same accelerations give the
/// times k·Ta and k·Td and the peak k·V with k² = 2·Δ/(V·(Ta + Td)). Rounded up, they never give a
/// greater acceleration.
fn shortened(distance: u64, speed: u64, times: [u64; 2]) -> [u64; 2] {
    let twice = 2 * u128::from(distance) * u128::from(SPEED_ONE);
    let ramps = u128::from(speed) * u128::from(times[0] + times[1]);
    if twice >= ramps {
        return times;
    }
    times.map(|time| {
        let square = (u128::from(time).pow(2) * twice).div_ceil(ramps);
        let root = square.isqrt();
        let up = u128::from(root * root < square);
        // At most `time`, as 2·Δ is below V·(Ta + Td); at least 1, as Δ is.
        ((root + up) as u64).max(1)
    })
}
