//! The host side of the trajectory controller: paths, profiles, records, settings.

mod axis_limits;
mod planner;
mod records;
mod segments;
mod settings;
mod splines;

use motion_rtl::jobs::trajectory_controller::speed_limits::Span;
use proptest::prelude::*;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig::with_cases(cases)
}

/// Spans of many lengths and speeds, some of whose joints have a limit, some a stop.
fn spans(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Span>> {
    let entry = prop_oneof![
        4 => Just(f64::INFINITY),
        4 => 0.0..6.0f64,
        1 => Just(-9.0),
    ];
    let span = (0.0..7.0f64, 1.0..5.0f64, entry).prop_map(|(length, speed, entry)| Span {
        length: 10f64.powf(length) as u64,
        speed: 10f64.powf(speed),
        entry: 10f64.powf(entry).floor(),
    });
    prop::collection::vec(span, count)
}
