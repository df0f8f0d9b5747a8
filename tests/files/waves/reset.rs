//! Synchronous reset: flip-flops as at power-on, memories by their edge.

use super::reader;
use super::zoo::{Zoo, inputs};
use super::{SEED, clock};
use motion_rtl::kernel::{Bits, Circuit, Declarations, Observer, Role, Simulator, pack};
use motion_rtl::trace::{Options, Recorder, Vcd};
use std::ops::Range;

const TICKS: u64 = 700;

/// Reset in single ticks, in neighbouring ones, and in tick 0.
fn rst(tick: u64) -> bool {
    tick.is_multiple_of(37) || (300..304).contains(&tick)
}

/// The bits of the registers, and which of them are memories.
fn layout() -> Vec<(Range<usize>, bool)> {
    let declarations = Declarations::of(&Zoo);
    let mut end = 0;
    let mut layout = Vec::new();
    for (index, leaf) in declarations.leaves.iter().enumerate() {
        if leaf.role == Role::Register {
            let mut memories = declarations.memories.iter();
            let is_word = memories.any(|m| (m.first..m.first + m.words).contains(&index));
            layout.push((end..end + leaf.shape.width, is_word));
            end += leaf.shape.width;
        }
    }
    layout
}

#[test]
fn flip_flops_show_power_on_and_memories_take_the_edge() {
    let (layout, power_on) = (layout(), pack(&Zoo.power_on()));
    assert_eq!(
        layout.last().map(|(bits, _)| bits.end),
        Some(power_on.len())
    );
    let mut inputs = inputs(SEED);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    let mut changed_by_reset = 0;
    for tick in 0..TICKS {
        let i = inputs.next().unwrap();
        let before = pack(&*simulator.registers());
        let (next, edge) = simulator.step_with_reset(rst(tick), i, |now| pack(&now.next()));
        let mut expected = Bits::new();
        for (bits, is_word) in &layout {
            let from = match rst(tick) && !is_word {
                true => &power_on,
                false => &edge,
            };
            expected.extend_from_bitslice(&from[bits.clone()]);
        }
        assert_eq!(pack(&*next.registers()), expected, "after tick {tick}");
        assert_eq!(next.tick(), tick + 1);
        let mut words = layout.iter().filter(|(_, is_word)| *is_word);
        let changed = words.any(|(bits, _)| before[bits.clone()] != expected[bits.clone()]);
        changed_by_reset += usize::from(rst(tick) && changed);
        simulator = next;
    }
    // The test is worth something only if memories change in ticks of reset.
    assert!(changed_by_reset > 0);
}

/// What a memory says it changed survives the reset, so the short way through it sees it.
#[test]
fn the_waves_show_what_a_tick_of_reset_wrote() {
    let mut vcd = Vcd::new(Vec::new(), &Zoo, clock(), &Options::default()).unwrap();
    let mut recorder = Recorder::new(&Zoo, &Options::default()).unwrap();
    let mut inputs = inputs(SEED);
    let mut simulator = Simulator::new(&Zoo).unwrap();
    for tick in 0..TICKS {
        let i = inputs.next().unwrap();
        let (next, seen) = simulator.step_with_reset(rst(tick), i, |now| {
            (&mut vcd, &mut recorder).sample(now).map(|_| ())
        });
        seen.unwrap();
        simulator = next;
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
