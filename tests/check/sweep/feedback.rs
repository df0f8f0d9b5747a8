//! The law of the error feedback, which it keeps, and of one that confuses its gains.

use motion_rtl::check::{Law, sweep};
use motion_rtl::circuits::trajectory_controller::feedback_sweep::{In as Case, Net as Fed};
use motion_rtl::circuits::trajectory_controller::widths::FeedbackWidths;
use motion_rtl::circuits::trajectory_controller::{ErrorFeedback, FeedbackSweep};
use motion_rtl::prelude::*;

fn feedback(count: usize) -> FeedbackSweep {
    let widths = FeedbackWidths {
        count,
        position: count + 2,
        gain: count,
    };
    FeedbackSweep::new(ErrorFeedback { widths, axes: 2 })
}

/// The law, where both gains are exchanged if y goes a count backwards.
#[derive(Debug, Clone)]
struct Mutant(FeedbackSweep);

signals! { for Mutant as c;
    /// A case.
    pub struct In { case: Case(&c.0) as Flat }
    /// The law.
    pub struct Parts { law: Part<FeedbackSweep>(c.0.clone()) }
    /// Observed signals.
    pub struct Net { fed: Fed(&c.0) as Flat }
}

impl Circuit for Mutant {
    const NAME: &'static str = "mutant";
    const ABOUT: &'static str = "an error feedback with one thing wrong";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let certain = i.case.axes[1].way.equals(-4);
        let mut case = i.case;
        let [tangential, normal] = [case.tangential_gain, case.normal_gain];
        case.tangential_gain = certain.mux(normal, tangential);
        case.normal_gain = certain.mux(tangential, normal);
        let fed = p.law.settle(case).w;
        (Net { fed }, Nothing)
    }
}

impl Law for Mutant {
    fn law(&self) -> &str {
        self.0.law()
    }
    fn ticks(&self) -> u64 {
        self.0.ticks()
    }
    fn expected(&self, case: &In<Value>) -> Option<Net<Value>> {
        let fed = self.0.expected(&case.case)?;
        Some(Net { fed })
    }
}

/// In simulation the numbers confirm every case.
#[test]
fn properties_and_numbers_say_the_same_of_every_case() {
    let law = feedback(2);
    // The first cases, and some around the middle.
    for from in [0, 1 << 18] {
        let cases = from..from + (1 << 15);
        let gates = sweep(&law).range(cases.clone()).run().unwrap().held();
        let simulated = sweep(&law).range(cases).run_simulated().unwrap().held();
        assert!(gates.is_some_and(|held| held > 0), "{gates:?}");
        assert_eq!(gates, simulated);
    }
}

#[test]
#[ignore = "takes long"]
fn the_feedback_is_both_parts_by_their_gains_and_a_mutant_confuses_them() {
    for (count, bits) in [(2, 4), (3, 5)] {
        let swept = sweep(&feedback(count)).run().unwrap();
        // Nine ways of a count at most, an axis.
        let axis = 9u64 << bits;
        let cases = (axis * axis) << (2 * count);
        assert_eq!(swept.held(), Some(cases), "{swept:?}");
    }
    let mutant = Mutant(feedback(2));
    let found = sweep(&mutant).run().unwrap().counterexample();
    let found = found.expect("the mutant is found");
    assert!(found.message.contains("way = -4"), "{found}");
    let sums = found
        .signals
        .iter()
        .filter(|signal| signal.starts_with("sum_"));
    assert!(sums.count() > 0, "{found}");
}
