//! Input of a run of the arc generator: a path as segments and as records.

use crate::cli::pieces::{SpeedKeys, fault, pieces};
use crate::cli::source::Source;
use crate::cli::{Failure, progress};
use motion_rtl::circuits::arc_generator::{Blend, Widths};
use motion_rtl::input::{Drawing, Point};
use motion_rtl::jobs::arc_generator::joints::{Followed, Following, Hand};
use motion_rtl::jobs::arc_generator::mechanism::Mechanism;
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::prepared::Prepared;
use motion_rtl::jobs::arc_generator::settings::Settings;
use motion_rtl::jobs::arc_generator::{products, record, reference};
use motion_rtl::jobs::taught::taught;
use motion_rtl::path::arm::Arm;
use motion_rtl::path::error::{PathError, Reason};
use motion_rtl::path::pieces::Speeds;
use motion_rtl::path::record::Record;
use motion_rtl::scenario::Loaded;

/// A path ready to be run.
#[derive(Debug)]
pub struct Job {
    /// Stem of the names of its files.
    pub stem: String,
    /// The input; `None` if the scenario has the path.
    pub drawing: Option<Drawing>,
    /// Its settings.
    pub settings: Settings,
    /// Ts in ticks.
    pub sample_ticks: u32,
    /// The segments.
    pub prepared: Prepared,
    /// The segments as records.
    pub records: Vec<Record>,
    /// Records by differences, for comparison with those by products; `None` if their words do not
    /// hold the path.
    pub differences: Option<Vec<Record>>,
    /// The arm whose hand the commands are of, and what its joints do.
    pub arm: Option<(Arm, Followed)>,
    /// An elastic mechanism under the commands.
    pub mechanism: Option<Mechanism>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Makes the records of a path.
    pub fn prepare(source: Source, settings: Settings) -> Result<Self, Failure> {
        let loaded = &source.loaded;
        let refuse = |error| loaded.refuse(error);
        let widths = settings.blend.widths(Widths::FULL);
        let timing = settings.timing(&widths).map_err(refuse)?;
        let sample_ticks = settings.sample_ticks(&widths).map_err(refuse)?;
        let arm = settings.arm;
        arm.map_or(Ok(()), |arm| arm.validate()).map_err(refuse)?;
        let mechanism = settings.mechanism;
        mechanism
            .map_or(Ok(()), |mechanism| mechanism.validate())
            .map_err(refuse)?;
        let taught = taught(loaded.scenario.input(), &settings.piece, false).map_err(refuse)?;
        let keys = SpeedKeys {
            speeds: Speeds::from(&settings),
            key: "feed_mm_per_min",
            rapid: "rapid_mm_per_min",
        };
        let (drawing, start, pieces) = pieces(&source, settings.start_mm, &taught, keys)?;
        let refuse = |error: PathError| fault(loaded, drawing.as_ref(), keys, &error);
        progress::stage("planning the path");
        let prepared = prepare(start, &pieces, &timing).map_err(refuse)?;
        let (scale, rounding) = (settings.counts_per_mm, settings.rounding);
        let records = match settings.blend {
            Blend::Differences => record::records(&prepared, scale, &widths, rounding),
            Blend::Products => products::records(&prepared, scale, &widths, rounding),
        };
        let records = records.map_err(refuse)?;
        let compared = match settings.blend {
            Blend::Differences => false,
            Blend::Products => {
                timing.blend_samples <= Blend::Differences.most_samples(&Widths::FULL)
            }
        };
        let differences =
            compared.then(|| record::records(&prepared, scale, &Widths::FULL, rounding).ok());
        if arm.is_some() {
            progress::stage("the arm's joints");
        }
        let followed = arm.map(|arm| {
            let mut following = Following::new(&arm, timing.sample_s);
            let each = |counts: [i64; 3]| {
                following.take(counts.map(|counts| counts as f64 / settings.counts_per_mm))
            };
            let followed = match settings.blend {
                Blend::Differences => {
                    reference::commands(&records, &widths, rounding).try_for_each(each)
                }
                Blend::Products => {
                    products::commands(&records, &widths, rounding).try_for_each(each)
                }
            };
            let followed = followed.map(|()| following.finish());
            let pose = |(sample, pose)| {
                let time_s = sample as f64 * timing.sample_s;
                let place = prepared.place(sample as u64);
                let piece = place.map_or(0, |place| prepared.segments[place.segment].piece);
                let line = prepared.pieces.get(piece).and_then(|piece| piece.line);
                let reason = Reason::Pose { time_s, pose };
                refuse(PathError {
                    piece,
                    line,
                    reason,
                })
            };
            followed.map(|followed| (arm, followed)).map_err(pose)
        });
        let arm = followed.transpose()?;
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            sample_ticks,
            prepared,
            records,
            differences: differences.flatten(),
            arm,
            mechanism,
            loaded,
        })
    }

    /// Ticks that the samples take, for the progress bar.
    pub fn ticks_at_least(&self) -> u64 {
        let ticks = u64::from(self.sample_ticks);
        self.prepared.samples().saturating_mul(ticks)
    }

    /// Sample at which the second segment begins.
    pub fn change(&self) -> u64 {
        let first = self.prepared.segments.first();
        first.map_or(0, |first| first.samples)
    }

    /// The arm, if there is one, at the start of the path, to stand beside the circuit.
    pub fn hand(&self) -> Option<Hand> {
        let (arm, followed) = self.arm.as_ref()?;
        Some(Hand::new(arm, followed.start, self.settings.counts_per_mm))
    }

    /// A command in millimetres.
    pub fn mm(&self, counts: [i64; 3]) -> Point {
        counts.map(|counts| counts as f64 / self.settings.counts_per_mm)
    }
}
