//! The feedback in words against numbers.

use super::super::widths::FeedbackWidths;
use super::*;
use crate::check::sweep;

/// Shows the feedback in words.
#[derive(Debug, Clone)]
struct Shown(FeedbackSweep);

signals! { for Shown as c;
    pub struct Case { case: In(&c.0) as Flat }
    pub struct Fed { sum: [I(c.0.feedback.widths.sum()); c.0.feedback.axes] }
}

impl Circuit for Shown {
    const NAME: &'static str = "shown";
    const ABOUT: &'static str = "shows the feedback of a case";
    records!(Case, Nothing, Fed);

    fn tick(&self, i: Case, _: Nothing, _: Nothing) -> (Fed, Nothing) {
        let width = self.0.feedback.widths.sum();
        let fed = self.0.fed(&i.case).into_iter();
        let sum = fed.map(|word| word.resize(width)).collect();
        (Fed { sum }, Nothing)
    }
}

/// Returns `number` / 2^`bits`, rounded down.
fn down(number: i128, bits: usize) -> i128 {
    let divisor = 1 << bits;
    (number - (number % divisor + divisor) % divisor) / divisor
}

impl Law for Shown {
    fn law(&self) -> &str {
        "the words are the numbers"
    }

    fn ticks(&self) -> u64 {
        1
    }

    fn expected(&self, case: &Case<Value>) -> Option<Fed<Value>> {
        let (case, widths) = (&case.case, self.0.feedback.widths);
        let guard = widths.position - widths.count;
        let axes = case.axes.iter();
        let axes: Vec<[i128; 2]> = axes
            .map(|axis| [axis.error, axis.way].map(i128::from))
            .collect();
        if axes.iter().any(|[_, way]| way.abs() > 1 << guard) {
            return None;
        }
        let along = down(axes.iter().map(|[error, way]| error * way).sum(), guard);
        let sum = axes.iter().map(|[error, way]| {
            let own = down(along * way, guard);
            let normal = i128::from(case.normal_gain) * (error - own);
            let fed = normal + i128::from(case.tangential_gain) * own;
            down(fed, widths.gain / 2) as i64
        });
        Some(Fed { sum: sum.collect() })
    }
}

#[test]
fn the_words_are_the_numbers() {
    let widths = FeedbackWidths {
        count: 2,
        position: 4,
        gain: 2,
    };
    let shown = Shown(FeedbackSweep::new(ErrorFeedback { widths, axes: 2 }));
    let swept = sweep(&shown).run().unwrap();
    // Nine ways of a count at most, 16 errors, 4 gains of each kind.
    let axis: u64 = 9 * 16;
    assert_eq!(swept.held(), Some(axis * axis * 16), "{swept:?}");
}
