//! Sweeps: what they find, and that it is the same whatever runs them.

mod words;

use motion_rtl::check::{Law, cases, sweep};
use motion_rtl::kernel::{Circuit, Moment};
use motion_rtl::linear_interpolator::{Integrator, LineSweep, Rule, integrator};
use motion_rtl::logic::{Bit, Logic, Signed, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::trace::Clock;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicU64, Ordering};

signals! { pub struct In<L> { a: L::U<8>, b: L::U<8> } }
signals! { pub struct Reg<L> { sum: L::U<8> = 0, carry: L::Bit } }
signals! { pub struct Net<L> { pub total: L::U<9> } }

/// Adds two numbers into a register; wrong where it was told to be.
struct Adder {
    wrong_from: u64,
}

impl Circuit for Adder {
    const NAME: &'static str = "adder";
    const ABOUT: &'static str = "adds";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, _: &Reg<L>, i: &In<L>) -> Net<L> {
        Net {
            total: i.a.resize::<9>() + i.b.resize(),
        }
    }

    fn next<L: Logic>(&self, _: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        let wrong = !i.b.below(self.wrong_from.into()) & i.a.bit(6);
        let sum: L::U<8> = w.total.resize();
        Reg {
            sum: wrong.mux(sum ^ 1.into(), sum),
            carry: w.total.bit(8),
        }
    }
}

signals! {
    /// Two numbers.
    pub struct Case<L> { a: L::U<8>, b: L::U<8> }
}
signals! {
    /// Their sum.
    pub struct Seen<L> { sum: L::U<8>, carry: L::Bit }
}

/// a + b, for every a of which b is no multiple.
struct Adds(Adder);

impl Law for Adds {
    type Circuit = Adder;
    type Case<L: Logic> = Case<L>;
    type Seen<L: Logic> = Seen<L>;

    fn name(&self) -> &str {
        "it adds"
    }
    fn circuit(&self) -> &Adder {
        &self.0
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn input<L: Logic>(&self, case: &Case<L>, tick: u64) -> In<L> {
        match tick {
            0 => In {
                a: case.a,
                b: case.b,
            },
            _ => In {
                a: 0.into(),
                b: 0.into(),
            },
        }
    }
    fn see<L: Logic>(&self, _: Seen<L>, _: u64, now: &Moment<'_, Adder, L>) -> Seen<L> {
        Seen {
            sum: now.q.sum,
            carry: now.q.carry,
        }
    }
    fn expected(&self, case: &Case<Sim>) -> Option<Seen<Sim>> {
        let (a, b) = (case.a.get(), case.b.get());
        let sum = u32::try_from(a + b).ok()?;
        (a == 0 || b % a != 0).then(|| Seen {
            sum: u64::from(sum as u8).into(),
            carry: (sum > 255).into(),
        })
    }
}

const RIGHT: Adds = Adds(Adder { wrong_from: 255 });

#[test]
fn every_case_that_is_meant_is_checked() {
    // The adder itself is wrong at b = 255 and a's with bit 6: leave them out.
    let meant = (0..255u32)
        .flat_map(|b| (0..256u32).map(move |a| (a, b)))
        .filter(|&(a, b)| a == 0 || b % a != 0)
        .count() as u64;
    let all = 0..255 << 8;
    assert_eq!(cases::<Adds>(), Ok(1 << 16));
    let many = sweep(&RIGHT).range(all.clone()).run().unwrap();
    assert_eq!(many.held(), Some(meant));
    let alone = sweep(&RIGHT).range(all).run_simulated().unwrap();
    assert_eq!(alone.held(), Some(meant));
}

#[test]
fn parts_are_the_whole() {
    let (mut sum, mut from) = (0, 0);
    // Beginnings and ends that nothing that runs side by side divides; one part is empty, one past the end.
    for to in [1, 1, 777, 16_385, 40_000, 255 << 8] {
        let part = sweep(&RIGHT).range(from..to).run().unwrap();
        sum += part.held().expect("it holds");
        from = to;
    }
    let whole = sweep(&RIGHT).range(0..255 << 8).run().unwrap();
    assert_eq!(whole.held(), Some(sum));
    let past = sweep(&RIGHT).range(1 << 16..1 << 20).run();
    assert_eq!(past.unwrap().held(), Some(0));
}

/// The index of the first case with b of at least `wrong_from`, a with bit 6, that is meant.
fn first(wrong_from: u64) -> u64 {
    let mut all = (wrong_from..256).flat_map(|b| (0..256).map(move |a| (a, b)));
    let wrong = |&(a, b): &(u64, u64)| a >> 6 & 1 == 1 && b % a != 0;
    let (a, b) = all.find(wrong).expect("one is wrong");
    b << 8 | a
}

#[test]
fn the_lowest_case_is_found_whatever_the_threads() {
    for wrong_from in [0, 3, 100, 254] {
        let law = Adds(Adder { wrong_from });
        let index = first(wrong_from);
        for threads in [1, 2, 7] {
            let pool = ThreadPoolBuilder::new().num_threads(threads);
            let found = pool.build().unwrap().install(|| {
                [
                    sweep(&law).run().unwrap(),
                    sweep(&law).run_simulated().unwrap(),
                ]
            });
            for found in found {
                let found = found.counterexample().expect("it is wrong");
                let (a, b) = (index & 255, index >> 8);
                let (sum, seen) = ((a + b) & 255, ((a + b) & 255) ^ 1);
                let text = format!("sum is {seen}, not {sum} with a = {a}, b = {b} (case {index})");
                assert_eq!(found.message, text);
                assert_eq!((found.tick, found.inputs.len()), (1, 2));
                assert_eq!(
                    (found.signals, found.invariant),
                    (vec!["sum".into()], "it adds".into())
                );
            }
        }
    }
}

#[test]
fn a_counterexample_is_replayed_in_waves() {
    let law = Adds(Adder { wrong_from: 9 });
    let found = sweep(&law).run().unwrap();
    let found = found.counterexample().expect("it is wrong");
    let table = found.to_string();
    assert!(table.contains("tick 1: it adds: sum is"), "{table}");
    assert!(
        table.lines().any(|line| line.starts_with("* sum")),
        "{table}"
    );
    let directory = tempfile::tempdir().unwrap();
    let files = found
        .save(&law.0, Clock::default(), directory.path())
        .unwrap();
    let names: Vec<_> = files.iter().filter_map(|file| file.file_name()).collect();
    assert_eq!(names, ["adder_it_adds.vcd", "adder_it_adds.gtkw"]);
}

#[test]
fn progress_comes_to_every_case() {
    let done = AtomicU64::new(0);
    let report = |cases| {
        done.fetch_add(cases, Ordering::Relaxed);
    };
    let swept = sweep(&RIGHT).range(0..50_000).progress(&report);
    assert!(swept.run().unwrap().held().is_some());
    assert_eq!(done.into_inner(), 50_000);
}

/// An integrator that loses one in B where a division of a certain line ends with a rest of 3.
struct Mutant(Integrator<4, 8>);

impl Circuit for Mutant {
    const NAME: &'static str = "mutant";
    const ABOUT: &'static str = "an integrator with one thing wrong";
    type In<L: Logic> = integrator::In<L, 4>;
    type Reg<L: Logic> = integrator::Reg<L, 4, 8>;
    type Net<L: Logic> = integrator::Net<L, 4, 8>;

    fn comb<L: Logic>(&self, q: &Self::Reg<L>, i: &Self::In<L>) -> Self::Net<L> {
        let mut w = self.0.comb(q, i);
        let left = w.remainder;
        let wrong = i.master.equals(7.into()) & i.slave.equals((-2).into());
        let wrong = wrong & left.equals(3.into()) & w.valid;
        w.remainder = wrong.mux(left - 1, left);
        w
    }

    fn next<L: Logic>(&self, q: Self::Reg<L>, w: &Self::Net<L>, i: &Self::In<L>) -> Self::Reg<L> {
        self.0.next(q, w, i)
    }
}

/// The law of the line, of the mutant.
struct OfMutant {
    law: LineSweep<4, 8>,
    circuit: Mutant,
}

impl Law for OfMutant {
    type Circuit = Mutant;
    type Case<L: Logic> = <LineSweep<4, 8> as Law>::Case<L>;
    type Seen<L: Logic> = <LineSweep<4, 8> as Law>::Seen<L>;

    fn name(&self) -> &str {
        self.law.name()
    }
    fn circuit(&self) -> &Mutant {
        &self.circuit
    }
    fn ticks(&self) -> u64 {
        self.law.ticks()
    }
    fn input<L: Logic>(&self, case: &Self::Case<L>, tick: u64) -> integrator::In<L, 4> {
        self.law.input(case, tick)
    }
    fn see<L: Logic>(
        &self,
        seen: Self::Seen<L>,
        tick: u64,
        now: &Moment<'_, Mutant, L>,
    ) -> Self::Seen<L> {
        let (i, q, w) = (now.i, now.q, now.w);
        self.law.see(seen, tick, &Moment { i, q, w })
    }
    fn expected(&self, case: &Self::Case<Sim>) -> Option<Self::Seen<Sim>> {
        self.law.expected(case)
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
        let law = LineSweep::<4, 8>::new(Integrator::new(rule));
        let swept = sweep(&law).run().unwrap();
        // Every case but those of a master that does not move; by truncation those on the segment.
        let masters = (-8..8i64).filter(|&master| master != 0);
        let meant = masters.map(|master| match rule {
            Rule::Truncating => 16 * pairs_on(master),
            Rule::Floor | Rule::Centred => 16 * 16 * 16,
        });
        assert_eq!(swept.held(), Some(meant.sum()), "{rule:?}: {swept:?}");
    }
    let mutant = OfMutant {
        law: LineSweep::new(Integrator::new(Rule::Floor)),
        circuit: Mutant(Integrator::new(Rule::Floor)),
    };
    let found = sweep(&mutant).run().unwrap().counterexample();
    let found = found.expect("the mutant is found");
    // The lowest case with master 7 and slave -2 of which -2 times some sum leaves 3.
    assert!(found.message.contains("slave = -2, master = 7"), "{found}");
    assert!(found.signals.contains(&"remainder".to_owned()), "{found}");
}

/// Too wide to be counted is said, not run.
#[test]
fn cases_of_64_bits_are_refused() {
    let error = cases::<LineSweep<16, 32>>().expect_err("64 bits");
    assert_eq!(
        error.to_string(),
        "the cases have 64 bits, at most 63 can be enumerated"
    );
}
