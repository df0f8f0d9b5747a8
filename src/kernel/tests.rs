use super::{Bits, Circuit, Declarations, Role, Sample, Simulator, StopWhen, pack, unpack, width};
use crate::logic::{Bit, Logic, Sim, Unsigned};
use crate::signals;

signals! { struct In<L, const W: usize> { pub period: L::U<W> } }
signals! { struct Reg<L, const W: usize> { count: L::U<W> as Analog = 1, seen: [L::Bit; 2] } }
signals! { struct Net<L, const W: usize> { next: L::U<W>, pub unit_rst: L::Bit } }

/// The counter of the design sketch.
struct Counter<const W: usize>;

impl<const W: usize> Circuit for Counter<W> {
    const NAME: &'static str = "counter";
    const ABOUT: &'static str = "counts";
    type In<L: Logic> = In<L, W>;
    type Reg<L: Logic> = Reg<L, W>;
    type Net<L: Logic> = Net<L, W>;

    fn comb<L: Logic>(&self, q: &Reg<L, W>, i: &In<L, W>) -> Net<L, W> {
        let next = q.count + 1;
        Net {
            next,
            unit_rst: !next.below(i.period),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L, W>, _: &In<L, W>) -> Reg<L, W> {
        Reg {
            count: w.unit_rst.mux(0.into(), w.next),
            seen: [w.unit_rst, q.seen[0]],
        }
    }
}

#[test]
fn a_register_shows_a_tick_later_what_was_decided() {
    let circuit = Counter::<3>;
    let mut seen = Vec::new();
    Simulator::new(&circuit)
        .unwrap()
        .run(
            6,
            |_, _| In { period: 3.into() },
            StopWhen(|now: &Sample<Counter<3>>| {
                seen.push((now.tick, now.q.count.get(), now.w.unit_rst.get()));
                now.tick == 4
            }),
        )
        .unwrap();
    assert_eq!(
        seen,
        [
            (0, 1, false),
            (1, 2, true),
            (2, 0, false),
            (3, 1, false),
            (4, 2, true)
        ]
    );
}

#[test]
fn declarations_name_every_leaf_once() {
    let paths: Vec<_> = Declarations::of(&Counter::<3>)
        .leaves
        .iter()
        .map(|leaf| (leaf.path(), leaf.role, leaf.shape.width))
        .collect();
    let expected = [
        ("counter.period", Role::Input, 3),
        ("counter.count", Role::Register, 3),
        ("counter.seen0", Role::Register, 1),
        ("counter.seen1", Role::Register, 1),
        ("counter.next", Role::Net, 3),
        ("counter.unit_rst", Role::Net, 1),
    ];
    assert_eq!(
        paths,
        expected.map(|(path, role, width)| (path.to_owned(), role, width))
    );
}

#[test]
fn packing_is_undone_by_unpacking() {
    let n = width::<Reg<Sim, 3>>();
    assert_eq!(n, 5);
    for value in 0..1u64 << n {
        let bits = Bits::from_element(value);
        let reg: Reg<Sim, 3> = unpack(&bits[..n]);
        assert_eq!(reg.count.get(), value & 7);
        assert_eq!(pack(&reg), bits[..n]);
    }
}
