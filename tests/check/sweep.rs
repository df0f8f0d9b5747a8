//! Sweeps: what they find, and that it is the same whatever runs them.

mod feedback;
mod line;
mod stated;
mod words;

use motion_rtl::check::{Law, cases, sweep};
use motion_rtl::prelude::*;
use motion_rtl::trace::Clock;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicU64, Ordering};

/// Adds two numbers into a register; wrong where it was told to be.
#[derive(Debug, Clone)]
struct Adder {
    wrong_from: u64,
}

signals! { for (Adder, Adds) as _c;
    pub struct In { a: U(8), b: U(8) }
}
signals! { for Adder as _c;
    pub struct Reg { pub sum: U(8), pub carry: Bit }
    pub struct Net { total: U(9) }
}

impl Circuit for Adder {
    const NAME: &'static str = "adder";
    const ABOUT: &'static str = "adds";
    records!(In, Reg, Net);

    fn tick(&self, i: In, _: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let total = i.a.plus(i.b);
        let wrong = !i.b.below(self.wrong_from) & i.a.bit(6);
        let sum = total.resize(8);
        let next = Reg {
            sum: wrong.mux(sum ^ 1, sum),
            carry: total.bit(8),
        };
        (Net { total }, next)
    }
}

/// a + b, for every a of which b is no multiple.
#[derive(Debug, Clone)]
struct Adds {
    wrong_from: u64,
}

signals! { for Adds as c;
    /// The adder.
    pub struct Parts { adder: Part<Adder>(Adder { wrong_from: c.wrong_from }) }
    /// The sum.
    pub struct Seen { sum: U(8), carry: Bit }
}

impl Circuit for Adds {
    const NAME: &'static str = "adds";
    const ABOUT: &'static str = "adds two numbers";
    records!(In, Nothing, Seen, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Seen, Nothing) {
        let Reg { sum, carry } = p.adder.settle(i).q;
        (Seen { sum, carry }, Nothing)
    }
}

impl Law for Adds {
    fn law(&self) -> &str {
        "it adds"
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn expected(&self, case: &In<Value>) -> Option<Seen<Value>> {
        let (a, b) = (case.a, case.b);
        let (sum, carry) = ((a + b) % 256, a + b > 255);
        (a == 0 || b % a != 0).then_some(Seen { sum, carry })
    }
}

const RIGHT: Adds = Adds { wrong_from: 255 };

#[test]
fn every_case_that_is_meant_is_checked() {
    // The adder itself is wrong at b = 255 and a's with bit 6: leave them out.
    let meant = (0..255u32)
        .flat_map(|b| (0..256u32).map(move |a| (a, b)))
        .filter(|&(a, b)| a == 0 || b % a != 0)
        .count() as u64;
    let all = 0..255 << 8;
    assert_eq!(cases(&RIGHT), Ok(1 << 16));
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
        let law = Adds { wrong_from };
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
    let law = Adds { wrong_from: 9 };
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
        .save(&law, Clock::default(), directory.path())
        .unwrap();
    let names: Vec<_> = files.iter().filter_map(|file| file.file_name()).collect();
    assert_eq!(names, ["adds_it_adds.vcd", "adds_it_adds.gtkw"]);
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
