//! The law of the straight line, proved; and what a rule that does not keep it does.

use motion_rtl::check::{Outcome, Specified, reach};
use motion_rtl::circuits::linear_interpolator::{Integrator, LineLaw, Rule};

#[test]
#[ignore = "takes long"]
fn every_rule_keeps_the_line_under_any_increments() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let position = 3;
        let circuit = LineLaw {
            integrator: Integrator { position, rule },
        };
        let all = circuit.invariants();
        let outcome = reach(&circuit, &all)
            .inputs(|i| circuit.applies(i))
            .run()
            .expect("narrow enough");
        assert!(matches!(outcome, Outcome::Proof(_)), "{rule:?}: {outcome}");
    }
}
