//! The result in words against numbers, which say what a quotient is.

use super::*;
use crate::check::sweep;

/// Judges any words as I and B of a case.
#[derive(Debug, Clone)]
struct Judge(LineSweep);

signals! { for Judge as c;
    pub struct Claimed {
        line: In(&c.0) as Flat,
        integral: I(c.0.integrator.position),
        remainder: I(c.0.integrator.position),
    }
    pub struct Judged { right: Bit }
}

impl Circuit for Judge {
    const NAME: &'static str = "judge";
    const ABOUT: &'static str = "says if I and B are those of a case";
    records!(Claimed, Nothing, Judged);

    fn tick(&self, i: Claimed, _: Nothing, _: Nothing) -> (Judged, Nothing) {
        let [integral, remainder] = self.0.result(&i.line);
        let right = i.integral.equals(integral) & i.remainder.equals(remainder);
        (Judged { right }, Nothing)
    }
}

impl Law for Judge {
    fn law(&self) -> &str {
        "I and B are right if they are the quotient and the rest"
    }

    fn ticks(&self) -> u64 {
        1
    }

    fn expected(&self, case: &Claimed<Value>) -> Option<Judged<Value>> {
        let In {
            increment,
            sum,
            slave,
            master,
        } = case.line;
        let words = [increment, sum, slave, master, case.integral, case.remainder];
        let [increment, sum, slave, master, integral, rest] = words.map(i128::from);
        let is_on = |point: i128| match master > 0 {
            true => (0..=master).contains(&point),
            false => (master..=0).contains(&point),
        };
        let end = sum + increment;
        // Equal modulo 2^P.
        let is_integral =
            |number: i128| (number - integral) % (1 << self.0.integrator.position) == 0;
        let right = match self.0.integrator.rule {
            _ if master == 0 => return None,
            Rule::Truncating => {
                if !is_on(sum) || !is_on(end) {
                    return None;
                }
                let before = slave * sum / master;
                let dividend = slave * end - before * master;
                is_integral(before + dividend / master) && rest == dividend % master
            }
            rule @ (Rule::Floor | Rule::Centred) => {
                let first = if rule == Rule::Centred { master / 2 } else { 0 };
                let moved = slave * end + first - rest;
                let is_rest = rest * master >= 0 && rest.abs() < master.abs();
                is_rest && moved % master == 0 && is_integral(moved / master)
            }
        };
        Some(Judged { right })
    }
}

#[test]
fn the_words_are_right_where_the_numbers_are() {
    for rule in [Rule::Floor, Rule::Truncating, Rule::Centred] {
        for position in [2, 3] {
            let judge = Judge(LineSweep::new(Integrator { position, rule }));
            let swept = sweep(&judge).run().unwrap();
            let masters = (1u64 << position) - 1;
            let held = swept
                .held()
                .unwrap_or_else(|| panic!("{rule:?}: {swept:?}"));
            match rule {
                Rule::Truncating => assert!(held > 0),
                Rule::Floor | Rule::Centred => assert_eq!(held, masters << (5 * position)),
            }
        }
    }
}
