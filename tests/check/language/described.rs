//! Names of words and parts in mistakes.

use super::{Counter, In, mistakes};
use expect_test::expect;
use motion_rtl::prelude::*;

/// Circuit that compares words of 5 bits with a port of 9.
#[derive(Debug, Clone)]
struct Named;

const NAMED: u32 = line!();
signals! { for Named as _c;
    /// Wires of an encoder.
    pub struct Pins {
        /// Angle.
        angle: U(5),
    }
    /// Ports in.
    pub struct NamedIn {
        /// Signed word.
        way: I(5),
        /// Bundle.
        encoder: Pins(_c),
        /// Wide word.
        wide: U(9),
        /// Wide word, signed.
        far: I(9),
    }
    /// Registers.
    pub struct NamedReg {
        /// Latest words.
        last: Shift(3, 5),
        /// A memory.
        store: Ram(2, 5),
    }
    /// The circuits inside.
    pub struct NamedParts {
        /// Counter.
        counter: Part<Counter>(Counter { width: 5, other: 5 }),
        /// Part that no mistake names.
        spare: Part<Counter>(Counter { width: 5, other: 5 }),
    }
}

impl Circuit for Named {
    const NAME: &'static str = "named";
    const ABOUT: &'static str = "compares words of other widths";
    records!(NamedIn, NamedReg, Nothing, NamedParts);

    fn tick(&self, i: NamedIn, q: NamedReg, p: NamedParts) -> (Nothing, NamedReg<Edge>) {
        let (way, angle) = (i.way, i.encoder.angle);
        let before = p.counter.q.sum;
        let counter = p.counter.settle(In { by: angle });
        p.spare.settle(In { by: angle });
        let address = angle.slice(0, 2);
        let stored = q.store.read_when(way.is_negative(), address, angle);
        let words = [
            angle,
            before,
            counter.w.next,
            way.unsigned(),
            way.magnitude(),
            (way + 1).magnitude(),
            !angle,
            angle.resize(6),
            i.wide.slice(1, 5),
            angle.shift_left(1),
            address.join(address),
            q.last.tap(address),
            q.last.stage(1),
            stored,
            Image::from_fn(2, 5, |word| word as u64).rom(address),
        ];
        for word in words {
            i.wide.below(word);
        }
        i.far.below(way.negated_by(angle.bit(0)));
        i.far.below(-way);
        let (last, store) = (q.last.keep(), q.store.keep());
        (Nothing, NamedReg { last, store })
    }
}

#[test]
fn words_are_named_as_in_source_and_waves() {
    mistakes(
        &Named,
        NAMED,
        &expect![[r#"
            described.rs:64:20: named: comparison of `wide` (9 bits) and `encoder.angle` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and `counter.sum` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and `counter.next` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and `way` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and the magnitude of `way` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and the magnitude of a word (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and the inverse of `encoder.angle` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and an extension of `encoder.angle` (6 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a slice of `wide` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a shift of `encoder.angle` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a joined word (4 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a word of `last` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a word of `store` (5 bits)
            described.rs:64:20: named: comparison of `wide` (9 bits) and a word of a ROM (5 bits)
            described.rs:66:15: named: comparison of `far` (9 bits) and the conditional negative of `way` (5 bits)
            described.rs:67:15: named: comparison of `far` (9 bits) and the negative of `way` (5 bits)
            described.rs:42:33: named: `counter` is Counter { width: 5, other: 5 }
        "#]],
    );
}

/// Circuit whose part has a port of another width.
#[derive(Debug, Clone)]
struct Apart {
    contents: Image,
}

const APART: u32 = line!();
signals! { for Apart as c;
    /// Ports in.
    pub struct ApartIn {
        /// Summand.
        by: U(4),
    }
    /// The circuits inside.
    pub struct ApartParts {
        /// Counters.
        counters: [Part<Counter>(Counter { width: 5, other: 5 }); 2] as Elements(&["x", "y"]),
        /// Circuit with a memory.
        lookup: Part<Table>(Table { contents: c.contents.clone(), numbers: vec![12345; 64] }),
    }
}

impl Circuit for Apart {
    const NAME: &'static str = "apart";
    const ABOUT: &'static str = "has a part with a wider port";
    records!(ApartIn, Nothing, Nothing, ApartParts);

    fn tick(&self, i: ApartIn, _: Nothing, p: ApartParts) -> (Nothing, Nothing) {
        settle_each(p.counters, |k| In {
            by: if k == 0 { i.by.resize(5) } else { i.by },
        });
        p.lookup.settle(TableIn { address: i.by });
        (Nothing, Nothing)
    }
}

/// Circuit with a memory, whose fields are long to print.
#[derive(Debug, Clone)]
struct Table {
    contents: Image,
    numbers: Vec<u64>,
}

signals! { for Table as _c;
    struct TableIn { address: U(6) }
    struct TableNet { pub word: U(8) }
}

impl Circuit for Table {
    const NAME: &'static str = "rom_table";
    const ABOUT: &'static str = "a memory";
    records!(TableIn, Nothing, TableNet);

    fn objection(&self) -> Option<String> {
        self.numbers.is_empty().then(|| "no numbers".into())
    }

    fn tick(&self, i: TableIn, _: Nothing, _: Nothing) -> (TableNet, Nothing) {
        (
            TableNet {
                word: self.contents.rom(i.address),
            },
            Nothing,
        )
    }
}

#[test]
fn parts_in_mistakes_come_with_their_fields() {
    let contents = Image::from_fn(6, 8, |word| word as u64);
    mistakes(
        &Apart { contents },
        APART,
        &expect![[r#"
        described.rs:22:9: apart: port `y.by` has 5 bits, `by` has 4 bits
        described.rs:25:18: apart: port `lookup.address` has 6 bits, `by` has 4 bits
        described.rs:22:9: apart: `y` is Counter { width: 5, other: 5 }
        described.rs:25:18: apart: `lookup` is Table { contents: Image { address: 6, width: 8, .. }, numbers: [12345, 12345, 12345, 12345, 12345, 12345, 12345, 12345,  …
    "#]],
    );
}
