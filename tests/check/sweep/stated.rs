//! Laws that are stated twice: as properties of the law, and as numbers.

use motion_rtl::check::{Law, sweep};
use motion_rtl::prelude::*;

/// Statement of the properties.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stated {
    Right,
    /// One more than the numbers say.
    OneMore,
    /// Nothing.
    Weak,
    /// An assumption excludes a case that counts by the numbers.
    Narrow,
    /// No assumption excludes a case that does not count.
    Wide,
}

/// Doubles a number; too large by one for the numbers from `wrong_from` on.
#[derive(Debug, Clone)]
struct Doubles {
    stated: Stated,
    wrong_from: u64,
}

signals! { for Doubles as _c;
    pub struct In { a: U(12) }
    pub struct Reg { held: U(12), started: Bit }
    pub struct Net { pub twice: U(13) }
}

impl Circuit for Doubles {
    const NAME: &'static str = "doubles";
    const ABOUT: &'static str = "doubles a number";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let wrong = !i.a.resize(13).below(self.wrong_from);
        let net = Net {
            twice: q.held.plus(i.a) + wrong.word().resize(13),
        };
        let next = Reg {
            held: i.a,
            started: Bit::high(),
        };
        (net, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (i, q, w) = (&now.i, &now.q, &now.w);
        let twice = i.a.resize(13).shift_left(1);
        let twice = match self.stated {
            Stated::OneMore => twice + 1,
            _ => twice,
        };
        let right = match self.stated {
            Stated::Weak => Bit::high(),
            _ => w.twice.equals(twice),
        };
        let counts = match self.stated {
            Stated::Narrow => !i.a.equals(9) & !i.a.equals(7),
            Stated::Wide => Bit::high(),
            _ => !i.a.equals(7),
        };
        vec![
            Property::given("7 does not count", counts),
            Property::always("it is twice the number", &["twice"], !q.started | right),
        ]
    }
}

impl Law for Doubles {
    fn law(&self) -> &str {
        "it doubles"
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn expected(&self, case: &In<Value>) -> Option<Net<Value>> {
        (case.a != 7).then_some(Net { twice: 2 * case.a })
    }
}

/// Message of the counterexample, if there is one.
fn message(stated: Stated, wrong_from: u64, simulated: bool) -> Option<String> {
    let law = Doubles { stated, wrong_from };
    let swept = match simulated {
        true => sweep(&law).run_simulated(),
        false => sweep(&law).run(),
    };
    let swept = swept.unwrap();
    match swept.held() {
        Some(held) => {
            assert_eq!(held, 4095, "7 does not count");
            None
        }
        None => swept.counterexample().map(|found| found.message),
    }
}

#[test]
fn a_law_that_is_stated_twice_holds_or_names_the_first_case() {
    for simulated in [false, true] {
        assert_eq!(message(Stated::Right, 4096, simulated), None);
        for wrong_from in [0, 1, 600, 2048, 4095] {
            let text = format!(
                "twice is {}, not {} with a = {wrong_from} (case {wrong_from})",
                2 * wrong_from + 1,
                2 * wrong_from
            );
            let found = message(Stated::Right, wrong_from, simulated);
            assert_eq!(found.as_deref(), Some(text.as_str()));
        }
    }
}

#[test]
fn properties_that_say_something_else_than_the_numbers_are_found() {
    for simulated in [false, true] {
        let text = "`it is twice the number` does not hold, but all numbers are as expected with \
                    a = 0 (case 0)";
        let found = message(Stated::OneMore, 4096, simulated);
        assert_eq!(found.as_deref(), Some(text));
    }
    // Some cases of a sweep by gates are confirmed by the numbers.
    for simulated in [false, true] {
        let found = message(Stated::Weak, 0, simulated).expect("every case is wrong");
        assert!(found.contains("but all properties hold"), "{found}");
    }
}

#[test]
fn assumptions_that_count_other_cases_than_the_numbers_are_found() {
    let text = "an assumption excludes the case, the numbers do not with a = 9 (case 9)";
    let found = message(Stated::Narrow, 4096, true);
    assert_eq!(found.as_deref(), Some(text));
    let text = "the numbers exclude the case, no assumption does with a = 7 (case 7)";
    let found = message(Stated::Wide, 4096, true);
    assert_eq!(found.as_deref(), Some(text));
}
