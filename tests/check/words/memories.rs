//! Memories against vectors.

use motion_rtl::check::Random;
use motion_rtl::prelude::*;
use std::collections::VecDeque;

fn image(address: usize, width: usize) {
    let len = 1usize << address;
    let mut image = Image::new(address, width);
    assert_eq!(
        (image.words(), image.address(), image.width()),
        (len, address, width)
    );
    let mut oracle = vec![0; len];
    let mut random = Random::new(width as u64);
    for _ in 0..200 {
        let (address, word) = (random.word() as usize % len, random.word().cut(width));
        image.set(address, word);
        oracle[address] = word;
        for (address, word) in oracle.iter().enumerate() {
            assert_eq!(image.get(address), Some(*word));
        }
        assert_eq!(image.get(len), None);
    }
    // A list that is too short is filled with zeros.
    let words: Vec<_> = (0..len).map(|_| random.word().cut(width)).collect();
    let full = Image::of(address, width, words.iter().copied());
    let short = Image::of(address, width, words[..1].iter().copied());
    for (address, word) in words.iter().enumerate() {
        assert_eq!(full.get(address), Some(*word));
        let expected = if address == 0 { *word } else { 0 };
        assert_eq!(short.get(address), Some(expected));
    }
    assert_eq!(full, Image::from_fn(address, width, |place| words[place]));
    store(&image, &full);
}

#[test]
fn images_and_rams() {
    image(1, 1);
    image(2, 3);
    image(3, 13);
    image(4, 13);
    image(2, 63);
    image(2, 64);
}

/// A memory with an output register, and a ROM.
#[derive(Debug, Clone)]
struct Store {
    power_on: Image,
    rom: Image,
}

signals! { for Store as c;
    struct StoreIn {
        address: U(c.power_on.address()),
        other: U(c.power_on.address()),
        write: Bit,
        data: U(c.power_on.width()),
        held: U(c.power_on.width()),
    }
    struct StoreReg {
        ram: Ram(c.power_on.address(), c.power_on.width()) = &c.power_on,
        kept: Ram(c.power_on.address(), c.power_on.width()) = &c.rom,
        out: U(c.power_on.width()),
    }
    struct StoreNet {
        read: U(c.power_on.width()),
        read_other: U(c.power_on.width()),
        read_kept: U(c.power_on.width()),
        read_or_held: U(c.power_on.width()),
        looked_up: U(c.rom.width()),
    }
}

impl Circuit for Store {
    const NAME: &'static str = "store";
    const ABOUT: &'static str = "reads and writes";
    records!(StoreIn, StoreReg, StoreNet);

    fn tick(&self, i: StoreIn, q: StoreReg, _: Nothing) -> (StoreNet, StoreReg<Edge>) {
        let net = StoreNet {
            read: q.ram.read(i.address),
            read_other: q.ram.read(i.other),
            read_kept: q.kept.read(i.other),
            read_or_held: q.ram.read_when(!i.write, i.address, i.held),
            looked_up: self.rom.rom(i.address),
        };
        // Read and write at the same address in one tick: the output takes the old word.
        let next = StoreReg {
            out: q.ram.read_when(i.write, i.address, q.out),
            ram: q.ram.write(i.write, i.address, i.data),
            kept: q.kept.keep(),
        };
        (net, next)
    }
}

/// Reads and writes at random, interpreted and compiled.
fn store(power_on: &Image, rom: &Image) {
    let (power_on, rom) = (power_on.clone(), rom.clone());
    let circuit = Store { power_on, rom };
    let words = |image: &Image| -> Vec<u64> { image.iter().collect() };
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut compiled = simulator.clone();
    simulator.interpret();
    compiled.compile();
    for simulator in [&mut simulator, &mut compiled] {
        let (mut oracle, mut out) = (words(&circuit.power_on), 0);
        let rom = words(&circuit.rom);
        let mut random = Random::new(circuit.power_on.address() as u64);
        for _ in 0..500 {
            let i = random.inputs(&circuit);
            let (address, other) = (i.address as usize, i.other as usize);
            simulator
                .step_with(&i, |now| {
                    assert_eq!(now.q.ram[..], oracle[..]);
                    assert_eq!(now.q.kept[..], rom[..]);
                    assert_eq!(now.q.out, out);
                    assert_eq!(now.w.read, oracle[address]);
                    assert_eq!(now.w.read_other, oracle[other]);
                    assert_eq!(now.w.read_kept, rom[other]);
                    let or_held = if i.write { i.held } else { oracle[address] };
                    assert_eq!(now.w.read_or_held, or_held);
                    assert_eq!(now.w.looked_up, rom[address]);
                })
                .unwrap();
            if i.write {
                out = std::mem::replace(&mut oracle[address], i.data);
            }
        }
    }
}

/// A shift register.
#[derive(Debug, Clone)]
struct Row {
    stages: usize,
    width: usize,
}

signals! { for Row as c;
    struct RowIn { shift: Bit, word: U(c.width), tap: U(5), far: U(64) }
    struct RowReg { row: Shift(c.stages, c.width) }
    struct RowNet {
        stage: [U(c.width); c.stages],
        tapped: U(c.width),
        by_far: U(c.width),
        by_one_bit: U(c.width),
    }
}

impl Circuit for Row {
    const NAME: &'static str = "shift_row";
    const ABOUT: &'static str = "shifts";
    records!(RowIn, RowReg, RowNet);

    fn tick(&self, i: RowIn, q: RowReg, _: Nothing) -> (RowNet, RowReg<Edge>) {
        let net = RowNet {
            stage: (0..self.stages).map(|stage| q.row.stage(stage)).collect(),
            tapped: q.row.tap(i.tap),
            by_far: q.row.tap(i.far),
            by_one_bit: q.row.tap(i.tap.slice(0, 1)),
        };
        let row = q.row.shift(i.shift, i.word);
        (net, RowReg { row })
    }
}

fn shift_register(stages: usize, width: usize) {
    let circuit = Row { stages, width };
    let mut random = Random::new(stages as u64);
    let mut simulator = Simulator::new(&circuit).unwrap();
    let mut oracle = VecDeque::from(vec![0; stages]);
    for tick in 0..500 {
        if tick == 250 {
            simulator.compile();
        }
        let mut i = random.inputs(&circuit);
        i.shift = !random.word().is_multiple_of(3);
        // Near, and everywhere.
        i.far = random.word() >> (random.word() & 63);
        let at = |index: u64| {
            usize::try_from(index)
                .ok()
                .and_then(|index| oracle.get(index))
        };
        let at = |index: u64| at(index).copied().unwrap_or(0);
        simulator
            .step_with(&i, |now| {
                assert_eq!(now.q.row.to_vec(), Vec::from(oracle.clone()));
                for (index, stage) in (0..).zip(&now.w.stage) {
                    assert_eq!(*stage, at(index), "stage {index}");
                }
                assert_eq!(now.w.tapped, at(i.tap), "{i:?}");
                assert_eq!(now.w.by_far, at(i.far), "{i:?}");
                assert_eq!(now.w.by_one_bit, at(i.tap & 1), "{i:?}");
            })
            .unwrap();
        if i.shift {
            oracle.push_front(i.word);
            oracle.truncate(stages);
        }
    }
}

#[test]
fn shift_registers() {
    shift_register(1, 1);
    shift_register(2, 5);
    shift_register(7, 13);
    shift_register(8, 2);
    shift_register(3, 64);
    let none = Row {
        stages: 0,
        width: 3,
    };
    let wrong = Simulator::new(&none).unwrap_err().to_string();
    assert!(
        wrong.contains("memory `row` has 0 words of 3 bits"),
        "{wrong}"
    );
}
