//! Grid of the times that can be set, to which learned and written times are limited.

use super::{DividedTime, Division, RatioLogic, TimeLimit, codes, ratio_logic, time_limit};
use crate::prelude::*;

choice! {
    /// The grid of a division.
    pub enum Grid as GridPart {
        /// The codes.
        Codes(RatioLogic),
        /// The codes, from which the time data are divided.
        Divided(RatioLogic),
        /// Every time of a history ten times as long.
        Limit(TimeLimit),
    }
}

/// A time on the grid.
#[derive(Debug)]
pub struct OnGrid {
    /// The time in CKs, or the one that takes its place.
    pub code: U,
    /// High if the given time is on the grid.
    pub on_grid: Bit,
    /// N above Δt/N, where the time data are divided beforehand.
    pub divided: Option<U>,
}

/// Stages of history for the times that `stages` stages allow with the ratios of the table.
#[must_use]
pub fn history(division: Division, stages: usize) -> usize {
    match division {
        Division::One => codes::largest(stages) as usize,
        _ => stages,
    }
}

/// Width of the time data.
#[must_use]
pub fn word(division: Division, stages: usize) -> usize {
    match division {
        Division::Beforehand => DividedTime { stages, one: false }.word(),
        _ => codes::time_width(stages),
    }
}

/// The time data of a time in CKs: as the ratio logic would round it, at most the longest.
#[must_use]
pub fn data(division: Division, stages: usize, time: u64) -> u64 {
    match division {
        Division::Logic => time,
        Division::One => time.min(codes::largest(stages)),
        Division::Beforehand => {
            let code = codes::rounded(stages as u64, time);
            code.ratio << codes::tap_width(stages) | code.tap
        }
    }
}

impl Grid {
    /// The grid of the times that `stages` stages allow with the ratios of the table.
    #[must_use]
    pub fn of(division: Division, stages: usize) -> Self {
        match division {
            Division::Logic => Grid::Codes(RatioLogic { stages }),
            Division::Beforehand => Grid::Divided(RatioLogic { stages }),
            Division::One => Grid::Limit(TimeLimit {
                stages: history(division, stages),
            }),
        }
    }
}

impl GridPart {
    /// Applies a time in CKs and settles the part.
    #[track_caller]
    pub fn settle(self, lead_time: U) -> OnGrid {
        match self {
            GridPart::Codes(part) => {
                let w = part.settle(ratio_logic::In { lead_time }).w;
                OnGrid {
                    code: w.code,
                    on_grid: w.on_grid,
                    divided: None,
                }
            }
            GridPart::Divided(part) => {
                let w = part.settle(ratio_logic::In { lead_time }).w;
                OnGrid {
                    code: w.code,
                    on_grid: w.on_grid,
                    divided: Some(w.ratio.join(w.tap)),
                }
            }
            GridPart::Limit(part) => {
                let w = part.settle(time_limit::In { lead_time }).w;
                OnGrid {
                    code: w.code,
                    on_grid: w.on_grid,
                    divided: None,
                }
            }
        }
    }
}
