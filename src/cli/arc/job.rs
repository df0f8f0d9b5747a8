//! What a run of the arc generator begins with: a path as segments and as records.

use crate::cli::Failure;
use crate::cli::job::{Source, drawing_fault};
use motion_rtl::arc_generator::error::{PathError, Reason};
use motion_rtl::arc_generator::path::{Piece, from_drawing, from_points};
use motion_rtl::arc_generator::prepare::prepare;
use motion_rtl::arc_generator::prepared::Prepared;
use motion_rtl::arc_generator::record::{Record, records};
use motion_rtl::arc_generator::settings::{SettingError, Settings};
use motion_rtl::arc_generator::widths::Widths;
use motion_rtl::input::scenario::Loaded;
use motion_rtl::input::scenario::arc_generator::Scenario;
use motion_rtl::input::{Drawing, Fault, Point};

/// Where the path begins if nothing says so.
const ORIGIN: Point = [0.0; 3];

/// A path ready to be run.
#[derive(Debug)]
pub struct Job {
    /// What its files are called.
    pub stem: String,
    /// The input; none where the scenario has the path.
    pub drawing: Option<Drawing>,
    /// Its settings.
    pub settings: Settings,
    /// Ts in ticks.
    pub sample_ticks: u32,
    /// The segments.
    pub prepared: Prepared,
    /// The same as words.
    pub records: Vec<Record>,
    /// The scenario it came from.
    pub loaded: Loaded,
}

impl Job {
    /// Makes the records of a path.
    pub fn prepare(source: Source, scenario: &Scenario) -> Result<Self, Failure> {
        let (settings, loaded) = (scenario.settings(), &source.loaded);
        let refuse = |error: SettingError| loaded.fault(error.field, error.problem, error.allowed);
        let widths = Widths::FULL;
        let timing = settings.timing(&widths).map_err(refuse)?;
        let sample_ticks = settings.sample_ticks(&widths).map_err(refuse)?;
        let taught = scenario.taught().map_err(refuse)?;
        let drawing = match (source.drawing_if_any(), taught.is_empty()) {
            (Some(_), false) => return Err(not_both(loaded).into()),
            (Some(drawing), true) => Some(drawing?),
            (None, false) => None,
            (None, true) => return Err(no_path(loaded).into()),
        };
        let refuse = |error: PathError| fault(loaded, drawing.as_ref(), &settings, &error);
        let (start, pieces): (Point, Vec<Piece>) = match &drawing {
            Some(_) if scenario.start_mm != ORIGIN => {
                let problem = format!("is {:?} beside an input", scenario.start_mm);
                let allowed = "where the drawing begins: no start_mm".to_owned();
                return Err(loaded.fault("start_mm", problem, allowed).into());
            }
            Some(drawing) => (
                drawing.start,
                from_drawing(drawing, &settings).map_err(refuse)?,
            ),
            None => {
                let pieces = from_points(scenario.start_mm, &taught, &settings);
                (scenario.start_mm, pieces.map_err(refuse)?)
            }
        };
        let prepared = prepare(start, &pieces, &timing).map_err(refuse)?;
        let records = records(
            &prepared,
            settings.counts_per_mm,
            &widths,
            settings.rounding,
        );
        let records = records.map_err(refuse)?;
        let Source { stem, loaded, .. } = source;
        Ok(Job {
            stem,
            drawing,
            settings,
            sample_ticks,
            prepared,
            records,
            loaded,
        })
    }

    /// Ticks that the samples take, for the progress bar.
    pub fn ticks_at_least(&self) -> u64 {
        let ticks = u64::from(self.sample_ticks);
        self.prepared.samples().saturating_mul(ticks)
    }

    /// A command in millimetres.
    pub fn mm(&self, counts: [i64; 3]) -> Point {
        counts.map(|counts| counts as f64 / self.settings.counts_per_mm)
    }
}

fn no_path(loaded: &Loaded) -> Fault {
    let allowed = "tables [[piece]], or an input: an HPGL drawing or a G-code program".to_owned();
    loaded.fault("piece", "missing".to_owned(), allowed)
}

fn not_both(loaded: &Loaded) -> Fault {
    let allowed = "a drawing or pieces, not both".to_owned();
    loaded.fault("piece", "given beside an input".to_owned(), allowed)
}

/// What cannot be generated, with the file and line it stands in.
fn fault(
    loaded: &Loaded,
    drawing: Option<&Drawing>,
    settings: &Settings,
    error: &PathError,
) -> Fault {
    let PathError {
        piece,
        line,
        reason,
    } = error;
    let (problem, allowed) = (reason.to_string(), reason.allowed());
    if let Reason::Empty = reason {
        return loaded.fault(reason.field(), problem, allowed);
    }
    let Some(drawing) = drawing else {
        return loaded.table_fault(("piece", *piece), reason.field(), problem, allowed);
    };
    let step = drawing.moves.get(*piece);
    // A speed may come from the scenario: its key is at fault then, on account of this line.
    let field = match (reason.word(), step) {
        ("F", Some(step)) if step.rapid => "rapid_mm_per_s",
        ("F", Some(step))
            if step.feed_mm_per_min.is_none() && settings.speed_mm_per_s.is_some() =>
        {
            "speed_mm_per_s"
        }
        (word, _) => word,
    };
    let allowed = match reason {
        Reason::NoSpeed => "a feed, or speed_mm_per_s for all".to_owned(),
        _ => allowed,
    };
    drawing_fault(drawing, line.unwrap_or(0), field, problem, allowed)
}
