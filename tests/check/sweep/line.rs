//! The law of the line, of integrators that keep it and of one that does not.

use motion_rtl::check::{Law, cases, sweep};
use motion_rtl::circuits::linear_interpolator::line_sweep::{In as Line, Net as Reached};
use motion_rtl::circuits::linear_interpolator::{Integrator, LineSweep, Rule};
use motion_rtl::prelude::*;

fn line(position: usize, rule: Rule) -> LineSweep {
    LineSweep::new(Integrator { position, rule })
}

/// The law, where B is one less if the last division of certain lines leaves 3.
#[derive(Debug, Clone)]
struct Mutant(LineSweep);

signals! { for Mutant as c;
    /// A case.
    pub struct In { line: Line(&c.0) as Flat }
    /// The law.
    pub struct Parts { law: Part<LineSweep>(c.0.clone()) }
    /// Observed signals.
    pub struct Net { reached: Reached(&c.0) as Flat }
}

impl Circuit for Mutant {
    const NAME: &'static str = "mutant";
    const ABOUT: &'static str = "an integrator with one thing wrong";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let certain = i.line.master.equals(7) & i.line.slave.equals(-2);
        let mut reached = p.law.settle(i.line).w;
        let left = reached.remainder;
        reached.remainder = (certain & left.equals(3)).mux(left - 1, left);
        (Net { reached }, Nothing)
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
        let reached = self.0.expected(&case.line)?;
        Some(Net { reached })
    }
}

/// Two points on a segment, and the way between them a word of four bits.
fn pairs_on(master: i64) -> u64 {
    let on = || 0.min(master)..=0.max(master);
    let pairs = on().flat_map(|from| on().map(move |to| to - from));
    pairs.filter(|way| (-8..8).contains(way)).count() as u64
}

#[test]
fn the_line_holds_by_every_rule_and_a_mutant_does_not_keep_it() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let swept = sweep(&line(4, rule)).run().unwrap();
        // Every case but those of a master that does not move; by truncation those on the segment.
        let masters = (-8..8i64).filter(|&master| master != 0);
        let meant = masters.map(|master| match rule {
            Rule::Truncating => 16 * pairs_on(master),
            Rule::Floor | Rule::Centred => 16 * 16 * 16,
        });
        assert_eq!(swept.held(), Some(meant.sum()), "{rule:?}: {swept:?}");
    }
    let mutant = Mutant(line(4, Rule::Floor));
    let found = sweep(&mutant).run().unwrap().counterexample();
    let found = found.expect("the mutant is found");
    // The lowest case with master 7 and slave -2 of which -2 times some sum leaves 3.
    assert!(found.message.contains("slave = -2, master = 7"), "{found}");
    assert!(found.signals.contains(&"remainder".to_owned()), "{found}");
}

/// In simulation the numbers confirm every case.
#[test]
fn properties_and_numbers_say_the_same_of_every_case() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        let law = line(3, rule);
        let [gates, simulated] = [sweep(&law).run(), sweep(&law).run_simulated()];
        let held = gates.unwrap().held().expect("the law holds");
        assert_eq!(simulated.unwrap().held(), Some(held), "{rule:?}");
        if rule != Rule::Truncating {
            assert_eq!(held, 7 << 9, "{rule:?}");
        }
    }
}

/// Too wide to be counted is said, not run.
#[test]
fn cases_of_64_bits_are_refused() {
    let error = cases(&line(16, Rule::Floor)).expect_err("64 bits");
    assert_eq!(
        error.to_string(),
        "the cases have 64 bits, at most 63 can be enumerated"
    );
}
