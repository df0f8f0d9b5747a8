//! Synchronous reset: flip-flops as at power-on, memories by their edge.

use super::reader;
use super::zoo::{Zoo, inputs};
use super::{SEED, clock};
use motion_rtl::hdl::Declarations;
use motion_rtl::netlist::Role;
use motion_rtl::sim::{Observer, Simulator};
use motion_rtl::trace::{Options, Recorder, Vcd};

const TICKS: u64 = 700;

/// Reset in single ticks, in neighbouring ones, and in tick 0.
fn rst(tick: u64) -> bool {
    tick.is_multiple_of(37) || (300..304).contains(&tick)
}

/// The leaves that are registers, and which of them are words of memories.
fn layout() -> Vec<(usize, bool)> {
    let declarations = Declarations::of(&Zoo);
    let leaves = declarations.leaves.iter().enumerate();
    let registers = leaves.filter(|(_, leaf)| leaf.role == Role::Register);
    let is_word = |index| {
        let mut memories = declarations.memories.iter();
        memories.any(|memory| (memory.first..memory.first + memory.words).contains(&index))
    };
    registers
        .map(|(index, _)| (index, is_word(index)))
        .collect()
}

#[test]
fn flip_flops_show_power_on_and_memories_take_the_edge() {
    let layout = layout();
    let registers = |simulator: &Simulator<Zoo>| -> Vec<u64> {
        let leaves = layout.iter();
        leaves
            .map(|(leaf, _)| simulator.engine().leaf(*leaf).unwrap())
            .collect()
    };
    let mut inputs = inputs(SEED);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    let power_on = registers(&simulator);
    let mut changed_by_reset = 0;
    for tick in 0..TICKS {
        let i = inputs.next().unwrap();
        let before = registers(&simulator);
        let mut without = simulator.clone();
        without.step_with(&i, |_| ()).unwrap();
        let edge = registers(&without);
        simulator.step_with_reset(rst(tick), &i, |_| ()).unwrap();
        let after = registers(&simulator);
        assert_eq!(simulator.tick(), tick + 1);
        for (place, (leaf, is_word)) in layout.iter().enumerate() {
            let from = match rst(tick) && !is_word {
                true => &power_on,
                false => &edge,
            };
            assert_eq!(after[place], from[place], "leaf {leaf} after tick {tick}");
            changed_by_reset += u64::from(rst(tick) && *is_word && before[place] != after[place]);
        }
    }
    // The test is worth something only if memories change in ticks of reset.
    assert!(changed_by_reset > 0);
}

/// A memory's change marks survive the reset, so the incremental path sees them.
#[test]
fn the_waves_show_what_a_tick_of_reset_wrote() {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &Options::default()).unwrap();
    let mut recorder = Recorder::new(&Zoo, &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    for tick in 0..TICKS {
        let i = inputs.next().unwrap();
        let seen = simulator
            .step_with_reset(rst(tick), &i, |now| {
                (&mut vcd, &mut recorder).sample(now).map(|_| ())
            })
            .unwrap();
        seen.unwrap();
    }
    let dump = reader::read(&vcd.finish().unwrap());
    for (index, leaf) in recorder.leaves().iter().enumerate() {
        let path = leaf.path();
        for (tick, &bits) in (0..).zip(recorder.column_at(index)) {
            let shown = dump.variables[&path].number_at(2 * tick);
            assert_eq!(shown, Some(bits), "{path} at tick {tick}");
        }
    }
}
