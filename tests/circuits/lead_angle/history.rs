//! The position history in both forms.

use super::below;
use motion_rtl::check::{Invariants, Lockstep, Outcome, Pair, PairIn, Random, reach};
use motion_rtl::circuits::lead_angle::position_history::{self, In};
use motion_rtl::circuits::lead_angle::{PositionHistory, RamHistory};
use motion_rtl::hdl::{Circuit, Place, Signals, Value};
use motion_rtl::sim::{Simulator, State};
use motion_rtl::trace::LastTicks;

/// Runs a history over `samples` random samples with the tap `tap`, restarted after `start` of
/// them, a CK every few ticks, against the list of all samples.
fn is_the_sample_k_old<H: Circuit<In<Value> = In<Value>>>(
    mut simulator: Simulator<H>,
    pair: fn(&Signals<H>) -> &position_history::Pair<Place>,
    tap: u64,
    start: usize,
    samples: usize,
) {
    let width = pair(simulator.signals()).present.width();
    let mut random = Random::new(tap * 1000 + start as u64);
    let mut taken: Vec<i64> = Vec::new();
    let mut restarted = 0;
    while taken.len() < samples {
        let gap = below(&mut random, 3);
        for between in (0..=gap).rev() {
            let ck = between == 0;
            let restart = ck && start > 0 && taken.len() + 1 == start;
            let position = random.word() as i64 % (1 << (width - 1));
            let i = In {
                ck,
                restart,
                position,
                tap,
                ratio: 1,
            };
            simulator.step_with(&i, |_| ()).unwrap();
            assert_eq!(simulator.see(|s| pair(s).fresh), ck && !restart);
            if restart {
                restarted = taken.len() + 1;
            }
            if ck {
                taken.push(position);
            }
            let Some(&newest) = taken.last() else {
                continue;
            };
            assert_eq!(simulator.see(|s| pair(s).present), newest);
            let since = taken.len() - restarted;
            let enough = since as u64 > tap;
            let given = simulator.see(|s| pair(s).enough);
            assert_eq!(given, enough, "tap {tap} after {since}");
            if enough {
                let old = taken[taken.len() - 1 - tap as usize];
                let given = simulator.see(|s| pair(s).old);
                assert_eq!(given, old, "tap {tap}, sample {}", taken.len());
            }
        }
    }
}

/// Every tap with these starts, in both forms.
fn every_tap(stages: usize, position: usize, starts: &[usize], samples: usize) {
    let shift = Simulator::new(&PositionHistory { stages, position }).unwrap();
    let ram = Simulator::new(&RamHistory { stages, position }).unwrap();
    for tap in 1..=stages as u64 {
        for &start in starts {
            is_the_sample_k_old(shift.clone(), |s| &s.q.pair, tap, start, samples);
            is_the_sample_k_old(ram.clone(), |s| &s.q.pair, tap, start, samples);
        }
    }
}

#[test]
fn tap_k_is_the_sample_k_cks_old_for_every_k_and_every_start() {
    every_tap(15, 8, &Vec::from_iter(0..=36), 60);
}

#[test]
fn so_it_is_with_199_stages() {
    every_tap(199, 24, &[0, 1, 57, 199, 256], 480);
}

/// A tap that is changed takes effect with the next CK, together with its ratio.
#[test]
fn pair_and_ratio_belong_together_when_the_tap_changes() {
    let circuit = PositionHistory {
        stages: 15,
        position: 8,
    };
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let mut taken = Vec::new();
    let mut random = Random::new(5);
    for tick in 0..20_000 {
        let (ck, tap) = (below(&mut random, 3) == 0, below(&mut random, 16));
        let position = random.word() as i64 % 128;
        let i = In {
            ck,
            restart: false,
            position,
            tap,
            ratio: tap ^ 5,
        };
        let before = simulator.registers().q.pair;
        simulator.step_with(&i, |_| ()).unwrap();
        let pair = simulator.registers().q.pair;
        if !ck {
            assert_eq!(pair.old, before.old);
            assert_eq!(pair.pair_ratio, before.pair_ratio);
            continue;
        }
        taken.push(position);
        assert_eq!(pair.pair_ratio, tap ^ 5, "tick {tick}");
        if tap > 0 && taken.len() > tap as usize {
            let old = taken[taken.len() - 1 - tap as usize];
            assert_eq!((pair.old, pair.enough), (old, true));
        }
    }
}

/// Both forms side by side.
fn both(stages: usize, position: usize) -> Pair<PositionHistory, RamHistory> {
    Pair {
        left: PositionHistory { stages, position },
        right: RamHistory { stages, position },
    }
}

/// The RAM equals the shift register in every tick, under every input.
#[test]
fn both_forms_are_proved_equal() {
    let pair = both(2, 2);
    let lockstep = Lockstep::by_name(&pair).unwrap();
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    // The ratio is only handed on: it may depend on the position.
    let tied = |i: &PairIn<PositionHistory, Value>| i.ratio == i.position.rem_euclid(2) as u64 * 15;
    let outcome = reach(&pair, &agree).inputs(tied).run().unwrap();
    assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
}

#[test]
fn both_forms_agree_at_full_width() {
    let pair = both(199, 24);
    let lockstep = Lockstep::by_name(&pair).unwrap();
    let mut random = Random::new(11);
    let stimulus = |tick: u64, _: &State<'_, _>| {
        let mut i = random.inputs(&pair);
        // Rarely, so that the history fills.
        i.0.restart = tick.is_multiple_of(2503);
        i
    };
    let mut simulator = LastTicks::simulator(&pair).unwrap();
    simulator.run(100_000, stimulus, lockstep).unwrap();
}
