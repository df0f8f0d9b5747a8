//! The pieces of a path, from a scenario's tables or its drawing, and what is wrong with one.

use super::Failure;
use super::source::{Source, drawing_fault};
use motion_rtl::input::{Drawing, Fault, Point};
use motion_rtl::path::error::{PathError, Reason};
use motion_rtl::path::pieces::{Piece, Speeds, Taught, from_drawing, from_points};
use motion_rtl::scenario::Loaded;

/// Default start of a path.
const ORIGIN: Point = [0.0; 3];

/// Speeds of a scenario, for pieces without an own speed, and their keys.
#[derive(Debug, Clone, Copy)]
pub struct SpeedKeys {
    pub speeds: Speeds,
    /// Key of the speed of lines and arcs.
    pub key: &'static str,
    /// Key of the speed of rapid moves.
    pub rapid: &'static str,
}

/// Returns the drawing if the pieces are from one, the path's start, and the pieces.
pub fn pieces(
    source: &Source,
    start_mm: Point,
    taught: &[Taught],
    keys: SpeedKeys,
) -> Result<(Option<Drawing>, Point, Vec<Piece>), Failure> {
    let loaded = &source.loaded;
    let drawing = match (source.drawing_if_any(), taught.is_empty()) {
        (Some(_), false) => return Err(not_both(loaded).into()),
        (Some(drawing), true) => Some(drawing?),
        (None, false) => None,
        (None, true) => return Err(no_path(loaded).into()),
    };
    let (start, pieces) = match &drawing {
        Some(_) if start_mm != ORIGIN => {
            let problem = format!("is {start_mm:?} beside an input");
            let allowed = "where the drawing begins: no start_mm".to_owned();
            return Err(loaded.fault("start_mm", problem, allowed).into());
        }
        Some(drawing) => (drawing.start, from_drawing(drawing, keys.speeds)),
        None => (start_mm, from_points(start_mm, taught, keys.speeds)),
    };
    let pieces = pieces.map_err(|error| fault(loaded, drawing.as_ref(), keys, &error))?;
    Ok((drawing, start, pieces))
}

fn no_path(loaded: &Loaded) -> Fault {
    let allowed = "tables [[piece]], or an input: an HPGL drawing or a G-code program".to_owned();
    loaded.fault("piece", "missing".to_owned(), allowed)
}

fn not_both(loaded: &Loaded) -> Fault {
    let allowed = "a drawing or pieces, not both".to_owned();
    loaded.fault("piece", "given beside an input".to_owned(), allowed)
}

/// Returns a path error with its file and line.
pub fn fault(
    loaded: &Loaded,
    drawing: Option<&Drawing>,
    keys: SpeedKeys,
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
        return match reason {
            Reason::Segments { .. } => loaded.fault(reason.field(), problem, allowed),
            _ => loaded.table_fault(("piece", *piece), reason.field(), problem, allowed),
        };
    };
    let step = drawing.moves.get(*piece);
    let told = keys.speeds.wanted.is_some();
    // A speed may come from the scenario: its key is at fault then, on account of this line.
    let field = match (reason.word(), step) {
        ("F", Some(step)) if step.rapid => keys.rapid,
        ("F", Some(step)) if step.feed_mm_per_min.is_none() && told => keys.key,
        (word, _) => word,
    };
    let allowed = match reason {
        Reason::NoSpeed => format!("a feed, or {} for all", keys.key),
        _ => allowed,
    };
    drawing_fault(drawing, line.unwrap_or(0), field, problem, allowed)
}
