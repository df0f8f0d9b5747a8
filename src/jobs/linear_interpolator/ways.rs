//! The two conventional methods of ¶0005, in which each axis has its own position pattern.

use super::profile::Profile;
use super::settings::Settings;
use super::targets::Target;

/// Settings of the patterns of X and Y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Equal speed and acceleration times on both axes: the axis with the shorter distance
    /// finishes earlier.
    SameSettings,
    /// Speeds in proportion to the distances, acceleration times in inverse proportion: straight
    /// except for rounding of the times to whole scans.
    InProportion,
}

impl Way {
    /// Both methods, in the text's order.
    pub const ALL: [Way; 2] = [Way::SameSettings, Way::InProportion];

    /// Returns the name in summaries.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Way::SameSettings => "same settings",
            Way::InProportion => "in proportion",
        }
    }

    /// Returns the cycles of the linear interpolator for this method, from the origin.
    ///
    /// A move that is too short for its speed keeps its slope too, as in the text.
    #[must_use]
    pub fn targets(self, targets: &[Target], settings: &Settings) -> Vec<Target<2>> {
        let mut at = [0; 2];
        let each = targets.iter().map(|target| {
            let to = [target.x, target.y];
            let way = [0, 1].map(|axis| to[axis].abs_diff(at[axis]));
            at = to;
            let [profile] = target.profiles;
            Target {
                x: target.x,
                y: target.y,
                profiles: self.profiles(way, profile.speed, settings),
                feed_mm_per_min: target.feed_mm_per_min,
                line: target.line,
                rapid: target.rapid,
            }
        });
        each.collect()
    }

    /// Returns the settings of X and Y for distances in counts; the longer one has `speed`.
    fn profiles(self, way: [u64; 2], speed: u64, settings: &Settings) -> [Profile; 2] {
        let master = usize::from(way[0] < way[1]);
        let (longer, times) = (way[master], settings.ramp_scans());
        let per_mm = settings.counts_per_mm;
        let full = [0, 1].map(|axis| settings.full_speed(axis) as f64);
        [0, 1].map(|axis| {
            let (mut own, mut speed) = (times, speed);
            let part = way[axis] as f64 / longer as f64;
            if axis != master {
                match self {
                    Way::SameSettings => {
                        speed = (speed as f64 * per_mm[axis] / per_mm[master]) as u64;
                    }
                    Way::InProportion => {
                        speed = (speed as f64 * part) as u64;
                        let inverse = full[axis] / full[master] / part;
                        own = times.map(|time| (time as f64 * inverse).round() as u64);
                    }
                }
            }
            match way[axis] {
                // No motion; a pattern without distance accepts any setting.
                0 => Profile {
                    speed: 1,
                    acceleration_scans: 1,
                    deceleration_scans: 1,
                },
                way => Profile::over(settings, axis, way, speed.max(1), own, None),
            }
        })
    }
}
