use super::make::{choice, one_of, words};
use crate::lead_angle::{
    Comparator, Comparing, Compensator, CompletionDetector, Correction, CorrectionArithmetic, Lead,
    LeadPlacement, Placement, PositionHistory, RamHistory, RatioLogic, Sign, SpeedLead,
    StepSequencer, StopError, TargetSetter, TimeData, TimeLead, Variant,
};
use crate::logic::Image;
use crate::registry::Entry;
use crate::registry::entry::{Made, at_width, entry, proved_at, some_widths};

/// Stages of history where positions have `width` bits.
const fn stages(width: usize) -> usize {
    match width {
        2 => 2,
        3 | 4 => 3,
        _ => 15,
    }
}

/// Bits of a tap of so many stages.
const fn tap_bits(width: usize) -> usize {
    if width <= 4 { 2 } else { 4 }
}

/// Bits of a lead time of ten times as many.
const fn time_bits(width: usize) -> usize {
    if width <= 4 { 5 } else { 8 }
}

const PLACEMENTS: &[Placement] = &[Placement::Position, Placement::Target, Placement::Halves];
const COMPARINGS: &[Comparing] = &[Comparing::Crossing, Comparing::Equal];
const SIGNS: &[Sign] = &[Sign::Converging, Sign::Literal];

/// The variant that follows the width.
fn variant(given: &[u64]) -> Option<Variant> {
    Some(Variant {
        placement: choice(given, 1, PLACEMENTS)?,
        comparing: choice(given, 2, COMPARINGS)?,
        sign: choice(given, 3, SIGNS)?,
    })
}

/// The times from a place on, one in each word from step 0 up.
fn rom<const A: usize, const C: usize>(given: &[u64], place: usize) -> Option<Image<A, C>> {
    let times = words(given, place, 1 << A, C)?;
    Some(Image::new(times.iter().copied()))
}

/// A time lead of the widths that go with positions of `$width` bits.
macro_rules! time_lead {
    ($history:ident, $width:ident) => {
        TimeLead::<
            $history<{ stages($width) }, { tap_bits($width) }, $width>,
            { stages($width) },
            { tap_bits($width) },
            { time_bits($width) },
            $width,
        >
    };
}

/// A compensator with such a lead, or with another.
macro_rules! compensator {
    ($lead:ty, $width:ident, $given:ident) => {
        Compensator::<
            $lead,
            { stages($width) },
            { tap_bits($width) },
            { time_bits($width) },
            $width,
            2,
            $width,
            { $width + time_bits($width) },
            $width,
            $width,
        >::new(variant($given)?, rom($given, 4)?)
    };
}

/// The circuits of JPH0646367B2.
pub(super) const CIRCUITS: &[Entry] = &[
    entry!(
        RatioLogic<199, 8, 11>,
        RatioLogic,
        Some(4),
        "JPH0646367B2 13",
        ["K" = 199, "T" = 8, "C" = 11],
        "4 for 3 stages, 8 for 15",
        proved_at!([4]; [4 8], |W| RatioLogic::<{ stages(W) }, { tap_bits(W) }, { time_bits(W) }>)
    ),
    entry!(
        PositionHistory<199, 8, 24>,
        PositionHistory,
        Some(2),
        "JPH0646367B2 11 + 14",
        ["K" = 199, "T" = 8, "W" = 24],
        "width: 2 stages for 2, 3 for 4, 15 for 8",
        proved_at!([2]; [2 4 8], |W| PositionHistory::<{ stages(W) }, { tap_bits(W) }, W>)
    ),
    entry!(
        RamHistory<199, 8, 24>,
        RamHistory,
        Some(2),
        "JPH0646367B2 11 + 14, as a RAM",
        ["K" = 199, "T" = 8, "W" = 24],
        "width: 2 stages for 2, 3 for 4, 15 for 8",
        proved_at!([2]; [4 8], |W| RamHistory::<{ stages(W) }, { tap_bits(W) }, W>)
    ),
    entry!(
        Lead<24>,
        Lead,
        Some(4),
        "JPH0646367B2 15 + 16",
        ["W" = 24],
        "width",
        proved_at!([4]; [4 8], |W| Lead::<W>)
    ),
    entry!(
        TimeLead<PositionHistory<199, 8, 24>, 199, 8, 11, 24>,
        TimeLead::default(),
        None,
        "JPH0646367B2 11, 13–16",
        ["K" = 199, "T" = 8, "C" = 11, "W" = 24],
        "width of positions: 3 stages for 4, 15 for 8",
        some_widths!([4 8], |W| <time_lead!(PositionHistory, W)>::default())
    ),
    entry!(
        TimeLead<RamHistory<199, 8, 24>, 199, 8, 11, 24>,
        TimeLead::default(),
        None,
        "JPH0646367B2 11, 13–16, with a RAM",
        ["K" = 199, "T" = 8, "C" = 11, "W" = 24],
        "width of positions: 3 stages for 4, 15 for 8",
        some_widths!([4 8], |W| <time_lead!(RamHistory, W)>::default())
    ),
    entry!(
        SpeedLead<24, 16>,
        SpeedLead,
        Some(2),
        "JPH0646367B2 1 + 2 of Fig. 7",
        ["W" = 24, "N" = 16],
        "width",
        proved_at!([2]; [4 8], |W| SpeedLead::<W, W>)
    ),
    entry!(
        LeadPlacement<24>,
        LeadPlacement::default(),
        Some(4),
        "JPH0646367B2 17, 20",
        ["W" = 24],
        "width, 0 for the position, 1 for the target or 2 for halves",
        proved_at!([4]; [4 8], |given, W| LeadPlacement::<W> {
            placement: one_of(given, PLACEMENTS)?
        })
    ),
    entry!(
        Comparator<24>,
        Comparator::default(),
        Some(4),
        "JPH0646367B2 19",
        ["W" = 24],
        "width, 0 for crossing or 1 for equal",
        proved_at!([4]; [4 8], |given, W| Comparator::<W> {
            comparing: one_of(given, COMPARINGS)?
        })
    ),
    entry!(
        TargetSetter<4, 24, 16>,
        TargetSetter,
        Some(2),
        "JPH0646367B2 18",
        ["A" = 4, "W" = 24, "D" = 16],
        "width of positions and speeds (steps have two bits)",
        proved_at!([2]; [4 8], |W| TargetSetter::<2, W, W>)
    ),
    entry!(
        TimeData<4, 11>,
        TimeData::default(),
        Some(2),
        "JPH0646367B2 21 = 24 + 25, 29",
        ["A" = 4, "C" = 11],
        "width (steps have two bits), and the times of the ROM",
        proved_at!([2]; [4 8], |given, W| TimeData::<2, W> { rom: rom(given, 1)? })
    ),
    entry!(
        CompletionDetector<24, 16>,
        CompletionDetector,
        Some(2),
        "JPH0646367B2 26",
        ["W" = 24, "N" = 16],
        "width",
        proved_at!([2]; [4 8], |W| CompletionDetector::<W, W>)
    ),
    entry!(
        StopError<24>,
        StopError::default(),
        Some(4),
        "JPH0646367B2 27, 30, 31",
        ["W" = 24],
        "width, 0 for the converging sign or 1 for the literal one",
        proved_at!([4]; [4 8], |given, W| StopError::<W> {
            sign: one_of(given, SIGNS)?
        })
    ),
    entry!(
        CorrectionArithmetic<199, 11, 24, 35>,
        CorrectionArithmetic,
        None,
        "JPH0646367B2 28",
        ["K" = 199, "C" = 11, "W" = 24, "R" = 35],
        "width of positions: 3 stages for 4, 15 for 8",
        some_widths!([4 8], |W| CorrectionArithmetic::<
            { stages(W) },
            { time_bits(W) },
            W,
            { W + time_bits(W) },
        >)
    ),
    entry!(
        Correction<199, 8, 11, 24, 35>,
        Correction::default(),
        None,
        "JPH0646367B2 23 = 27, 28, 30, 31",
        ["K" = 199, "T" = 8, "C" = 11, "W" = 24, "R" = 35],
        "width of positions (3 stages for 4, 15 for 8), 0 for the converging sign or 1 for the \
         literal one",
        some_widths!([4 8], |given, W| Correction::<
            { stages(W) },
            { tap_bits(W) },
            { time_bits(W) },
            W,
            { W + time_bits(W) },
        >::new(one_of(given, SIGNS)?))
    ),
    entry!(
        StepSequencer<4, 24, 16>,
        StepSequencer,
        Some(2),
        "JPH0646367B2, step numbers",
        ["A" = 4, "W" = 24, "N" = 16],
        "width of positions and times (steps have two bits)",
        proved_at!([2]; [4 8], |W| StepSequencer::<2, W, W>)
    ),
    entry!(
        Compensator<TimeLead<PositionHistory<199, 8, 24>, 199, 8, 11, 24>>,
        Compensator::default(),
        None,
        "JPH0646367B2, Figs 1, 5 and 6",
        [
            "K" = 199,
            "T" = 8,
            "C" = 11,
            "W" = 24,
            "A" = 4,
            "D" = 16,
            "R" = 35,
            "N" = 16,
            "S" = 24
        ],
        "width of positions, speeds and CK (3 stages for 4, 15 for 8; steps have two bits), \
         placement, comparing and sign as 0, 1 and 2, times of the ROM",
        some_widths!([4 8], |given, W| compensator!(time_lead!(PositionHistory, W), W, given))
    ),
    entry!(
        Compensator<TimeLead<RamHistory<199, 8, 24>, 199, 8, 11, 24>>,
        Compensator::default(),
        None,
        "JPH0646367B2, Figs 1, 5 and 6, with a RAM",
        [
            "K" = 199,
            "T" = 8,
            "C" = 11,
            "W" = 24,
            "A" = 4,
            "D" = 16,
            "R" = 35,
            "N" = 16,
            "S" = 24
        ],
        "width of positions, speeds and CK (3 stages for 4, 15 for 8; steps have two bits), \
         placement, comparing and sign as 0, 1 and 2, times of the ROM",
        some_widths!([4 8], |given, W| compensator!(time_lead!(RamHistory, W), W, given))
    ),
    entry!(
        Compensator<SpeedLead<24, 16>>,
        Compensator::default(),
        None,
        "JPH0646367B2, Fig. 7",
        [
            "K" = 199,
            "T" = 8,
            "C" = 11,
            "W" = 24,
            "A" = 4,
            "D" = 16,
            "R" = 35,
            "N" = 16,
            "S" = 24
        ],
        "width of positions, speeds and CK (steps have two bits), placement, comparing and sign \
         as 0, 1 and 2, times of the ROM",
        some_widths!([4 8], |given, W| compensator!(SpeedLead::<W, W>, W, given))
    ),
];
