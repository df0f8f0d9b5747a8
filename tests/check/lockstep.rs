//! Two circuits side by side.

use crate::circuits::*;
use motion_rtl::check::{Invariants, Lockstep, LockstepError, Pair, Random, reach};
use motion_rtl::hdl::{Circuit, Declarations, zero};
use motion_rtl::sim::{RunError, Simulator};

fn counters(flaw: u64) -> Pair<Up, Down> {
    Pair {
        left: Up { n: 5 },
        right: Down { flaw },
    }
}

/// Runs a pair on random inputs.
fn run(pair: &Pair<Up, Down>, ticks: u64, lockstep: Lockstep) -> Result<u64, RunError> {
    let mut random = Random::new(3);
    let mut simulator = Simulator::new(pair)?;
    simulator.run(ticks, |_, _| random.inputs(pair), lockstep)?;
    Ok(simulator.tick())
}

#[test]
fn two_ways_of_counting_are_proved_equal() {
    let pair = counters(0);
    let lockstep = Lockstep::by_name(&pair).unwrap();
    assert_eq!(
        lockstep.to_string(),
        "left.count = right.count, left.last = right.last"
    );
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    let outcome = reach(&pair, &agree).run().unwrap();
    let proof = outcome.proof().unwrap();
    assert_eq!((proof.states, proof.transitions, proof.depth), (5, 10, 4));
}

#[test]
fn the_first_difference_is_found() {
    let pair = counters(16);
    let lockstep = Lockstep::by_name(&pair).unwrap();
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    let found = reach(&pair, &agree)
        .run()
        .unwrap()
        .counterexample()
        .unwrap();
    assert_eq!(found.tick, 4);
    assert_eq!(found.signals, ["left.count", "right.count"]);
    assert_eq!(found.message, "left.count is 4, right.count is 20");
    assert!(found.to_string().contains("* left.count"), "{found}");

    let end = run(&pair, 1000, lockstep.clone());
    let Err(RunError::Violation {
        tick,
        signals,
        message,
    }) = end
    else {
        panic!("{end:?}");
    };
    assert!(tick >= 4);
    assert_eq!((signals, message), (found.signals, found.message));
}

#[test]
fn equal_circuits_agree_on_long_runs() {
    let pair = counters(0);
    let lockstep = Lockstep::by_name(&pair).unwrap();
    assert_eq!(run(&pair, 10_000, lockstep).unwrap(), 10_000);
}

#[test]
fn what_has_no_partner_is_reported() {
    let pair = Pair {
        left: Up { n: 2 },
        right: Toggle,
    };
    let unpaired = vec!["modulo.count".to_owned(), "toggle.parity".to_owned()];
    let error = Lockstep::by_name(&pair).unwrap_err();
    assert_eq!(error, LockstepError::Unpaired(unpaired.clone()));
    assert_eq!(
        error.to_string(),
        "ports out without partner: modulo.count, toggle.parity"
    );

    // A list may leave them out, and says so.
    let lockstep = Lockstep::of(&pair, &[("last", "last")]).unwrap();
    assert_eq!(lockstep.unpaired(), unpaired);
    assert_eq!(
        lockstep.to_string(),
        "modulo.last = toggle.last; not compared: modulo.count, toggle.parity"
    );
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    assert!(reach(&pair, &agree).run().unwrap().proof().is_some());
}

#[test]
fn a_list_may_name_what_is_private_and_what_has_another_name() {
    let pair = Pair {
        left: Up { n: 2 },
        right: Toggle,
    };
    let pairs = [("count", "last"), ("last", "parity")];
    let lockstep = Lockstep::of(&pair, &pairs).unwrap();
    assert_eq!(lockstep.unpaired(), ["toggle.last"; 0]);
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    let found = reach(&pair, &agree)
        .run()
        .unwrap()
        .counterexample()
        .unwrap();
    // The parity shows the input at once, the last count a tick later.
    assert_eq!(found.message, "modulo.last is 0, toggle.parity is 1");
    assert_eq!(found.tick, 0);

    let named = |left, right| {
        let lockstep = Lockstep::of(&pair, &[(left, right)]);
        lockstep.map_err(|error| error.to_string())
    };
    assert!(named("last", "hidden").is_ok());
    let error = named("last", "enable").unwrap_err();
    assert_eq!(error, "toggle has not exactly one signal enable");
    let error = named("lost", "last").unwrap_err();
    assert_eq!(error, "modulo has not exactly one signal lost");
    assert_eq!(
        Lockstep::of(&pair, &[]).unwrap_err(),
        LockstepError::Nothing
    );
}

const WIDE: Wide = Wide {
    width: 1,
    stages: 1,
};

#[test]
fn circuits_without_a_name_in_common_have_no_partners() {
    let pair = Pair {
        left: Up { n: 2 },
        right: WIDE,
    };
    let alone = ["modulo.count", "modulo.last"].map(str::to_owned);
    assert_eq!(
        Lockstep::by_name(&pair).unwrap_err(),
        LockstepError::Unpaired(alone.into())
    );
    // The two have no ports in common either.
    let error = Simulator::new(&pair).unwrap_err().to_string();
    let what = "pair: the ports in of both are not the same: enable of 1; word of 1";
    assert!(error.ends_with(what), "{error}");
}

#[test]
fn circuits_without_ports_out_are_not_equal_by_default() {
    let pair = Pair {
        left: WIDE,
        right: WIDE,
    };
    assert_eq!(
        Lockstep::by_name(&pair).unwrap_err(),
        LockstepError::Nothing
    );
    // The words of a memory have names as well.
    let words = Lockstep::of(&pair, &[("line.stage0", "line.stage0")]).unwrap();
    let agree = Invariants::new().always("agree", |now| words.compare(now));
    assert!(reach(&pair, &agree).run().unwrap().proof().is_some());
}

#[test]
fn a_pair_stands_in_two_scopes() {
    fn paths<C: Circuit>(circuit: &C) -> Vec<String> {
        let leaves = Declarations::of(circuit).leaves;
        leaves.iter().map(|leaf| leaf.path()).collect()
    }
    assert_eq!(
        paths(&counters(0)),
        [
            "pair.enable",
            "pair.left.count",
            "pair.right.left",
            "pair.left.enable",
            "pair.left.last",
            "pair.left.carry",
            "pair.right.enable",
            "pair.right.last",
            "pair.right.count"
        ]
    );
    let pair = Pair {
        left: Toggle,
        right: Up { n: 3 },
    };
    let mut simulator = Simulator::new(&pair).unwrap();
    assert!(
        !simulator
            .step_with(&zero(&pair), |now| now.p.left.w.parity)
            .unwrap()
    );
    assert_eq!(paths(&pair)[1], "pair.toggle.last");
}
