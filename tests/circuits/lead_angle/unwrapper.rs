//! The unwrapper for every pair of places of every modulus of four bits.

use motion_rtl::circuits::lead_angle::Unwrapper;
use motion_rtl::trace::LastTicks;

/// The shorter way from one place to another. At half the modulus both are as long: the one that does
/// not pass place 0 counts.
fn way(last: i64, place: i64, counts: i64) -> i64 {
    let gone = place - last;
    if 2 * gone > counts {
        gone - counts
    } else if 2 * gone < -counts {
        gone + counts
    } else {
        gone
    }
}

#[test]
fn every_step_goes_the_shorter_way_and_half_a_pitch_the_way_without_place_0() {
    let circuit = Unwrapper {
        place: 4,
        position: 8,
    };
    let mut unwrapper = LastTicks::simulator(&circuit).unwrap();
    for counts in 1..=16i64 {
        unwrapper.set(|i| i.modulus, counts as u64 % 16).unwrap();
        unwrapper.set(|i| i.take, true).unwrap();
        for (last, place) in (0..counts).flat_map(|last| (0..counts).map(move |to| (last, to))) {
            unwrapper.set(|i| i.take, false).unwrap();
            unwrapper.set(|i| i.clear, true).unwrap();
            unwrapper.step();
            unwrapper.set(|i| i.clear, false).unwrap();
            unwrapper.set(|i| i.take, true).unwrap();
            unwrapper.set(|i| i.place, last as u64).unwrap();
            unwrapper.step();
            unwrapper.set(|i| i.place, place as u64).unwrap();
            unwrapper.step();
            let way = way(last, place, counts);
            let far = way.abs() > counts / 4;
            let seen = (unwrapper.see(|s| s.q.position), unwrapper.see(|s| s.q.lost));
            assert_eq!(seen, (last + way, far), "{last} to {place} of {counts}");
        }
    }
}
