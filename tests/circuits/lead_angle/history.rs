//! The position history in both forms.

use super::below;
use motion_rtl::check::{Invariants, Lockstep, Outcome, Pair, Random, reach};
use motion_rtl::kernel::{Circuit, Simulator};
use motion_rtl::lead_angle::position_history::{self, In};
use motion_rtl::lead_angle::{History, PositionHistory, RamHistory};
use motion_rtl::logic::{Signed, Sim};

/// Runs a history over `samples` random samples with the tap `tap`, restarted after `start` of
/// them, a CK every few ticks, against the list of all samples.
fn is_the_sample_k_old<H, const K: usize, const T: usize, const W: usize>(
    tap: u64,
    start: usize,
    samples: usize,
) where
    H: History<T, W> + Circuit<In<Sim> = In<Sim, T, W>>,
{
    let circuit = H::default();
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut random = Random::new(tap * 1000 + start as u64);
    let mut taken: Vec<i64> = Vec::new();
    let mut restarted = 0;
    while taken.len() < samples {
        let gap = below(&mut random, 3);
        for between in (0..=gap).rev() {
            let ck = between == 0;
            let restart = ck && start > 0 && taken.len() + 1 == start;
            let position = random.word() as i64 % (1 << (W - 1));
            let i = In {
                ck: ck.into(),
                restart: restart.into(),
                position: position.into(),
                tap: tap.into(),
                ratio: 1.into(),
            };
            let (next, ()) = simulator.step(i, |_| ());
            simulator = next;
            let registers = simulator.registers();
            let pair = H::pair(&registers);
            assert_eq!(pair.fresh.get(), ck && !restart);
            if restart {
                restarted = taken.len() + 1;
            }
            if ck {
                taken.push(position);
            }
            let Some(&newest) = taken.last() else {
                continue;
            };
            assert_eq!(pair.present.get(), newest);
            let since = taken.len() - restarted;
            let enough = since as u64 > tap;
            assert_eq!(pair.enough.get(), enough, "tap {tap} after {since}");
            if enough {
                let old = taken[taken.len() - 1 - tap as usize];
                assert_eq!(pair.old.get(), old, "tap {tap}, sample {}", taken.len());
            }
        }
    }
}

#[test]
fn tap_k_is_the_sample_k_cks_old_for_every_k_and_every_start() {
    for tap in 1..=15 {
        for start in 0..=36 {
            is_the_sample_k_old::<PositionHistory<15, 4, 8>, 15, 4, 8>(tap, start, 60);
            is_the_sample_k_old::<RamHistory<15, 4, 8>, 15, 4, 8>(tap, start, 60);
        }
    }
}

#[test]
fn so_it_is_with_199_stages() {
    for tap in 1..=199 {
        for start in [0, 1, 57, 199, 256] {
            is_the_sample_k_old::<PositionHistory<199, 8, 24>, 199, 8, 24>(tap, start, 480);
            is_the_sample_k_old::<RamHistory<199, 8, 24>, 199, 8, 24>(tap, start, 480);
        }
    }
}

/// A tap that is changed takes effect with the next CK, together with its ratio.
#[test]
fn pair_and_ratio_belong_together_when_the_tap_changes() {
    let circuit = PositionHistory::<15, 4, 8>;
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut taken = Vec::new();
    let mut random = Random::new(5);
    for tick in 0..20_000 {
        let (ck, tap) = (below(&mut random, 3) == 0, below(&mut random, 16));
        let position = random.word() as i64 % 128;
        let i = In {
            ck: ck.into(),
            restart: false.into(),
            position: position.into(),
            tap: tap.into(),
            ratio: (tap ^ 5).into(),
        };
        let before = simulator.registers().pair.clone();
        let (next, ()) = simulator.step(i, |_| ());
        simulator = next;
        let pair = &simulator.registers().pair;
        if !ck {
            assert_eq!(pair.old, before.old);
            assert_eq!(pair.pair_ratio, before.pair_ratio);
            continue;
        }
        taken.push(position);
        assert_eq!(pair.pair_ratio.get(), tap ^ 5, "tick {tick}");
        if tap > 0 && taken.len() > tap as usize {
            let old = taken[taken.len() - 1 - tap as usize];
            assert_eq!((pair.old.get(), pair.enough.get()), (old, true));
        }
    }
}

/// The RAM equals the shift register in every tick, under every input.
#[test]
fn both_forms_are_proved_equal() {
    let pair = Pair {
        left: PositionHistory::<2, 2, 2>,
        right: RamHistory::<2, 2, 2>,
    };
    let lockstep = Lockstep::by_name(&pair).unwrap();
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    // The ratio is only handed on: it may depend on the position.
    let tied = |i: &In<Sim, 2, 2>| i.ratio.get() == i.position.unsigned().get() % 2 * 15;
    let outcome = reach(&pair, &agree).inputs(tied).run().unwrap();
    assert!(matches!(outcome, Outcome::Proof(_)), "{outcome}");
}

#[test]
fn both_forms_agree_at_full_width() {
    let pair = Pair {
        left: PositionHistory::<199, 8, 24>,
        right: RamHistory::<199, 8, 24>,
    };
    let lockstep = Lockstep::by_name(&pair).unwrap();
    let mut random = Random::new(11);
    let stimulus = |tick: u64, _: &motion_rtl::kernel::Part<'_, _>| {
        let mut i: position_history::In<Sim, 8, 24> = random.signals();
        // Rarely, so that the history fills.
        i.restart = tick.is_multiple_of(2503).into();
        i
    };
    let end = Simulator::new(&pair)
        .unwrap()
        .run(100_000, stimulus, lockstep);
    end.unwrap();
}
