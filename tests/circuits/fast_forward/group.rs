//! Groups under random control computers, and drawings that ship with the crate.

use super::registers;
use motion_rtl::check::Random;
use motion_rtl::circuits::pulse_interpolator::group::{Group, In};
use motion_rtl::circuits::pulse_interpolator::pattern_memory::WritePort;
use motion_rtl::circuits::pulse_interpolator::{Pattern, Variant, Widths};
use motion_rtl::hdl::{Value, zero};
use motion_rtl::input::{Drawing, read_text};
use motion_rtl::jobs::pulse_interpolator::job::{fast_forward, group, play};
use motion_rtl::jobs::pulse_interpolator::{Settings, compile};
use motion_rtl::scenario::{Loaded, Scenario};
use motion_rtl::sim::{Observer, RunError, Sample, Simulator};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Words of the memories that are played.
const WORDS: u64 = 6;
type Port = In<Value>;

/// Every change of a port out with its tick; ends the run when it has seen so many.
#[derive(Debug)]
struct Events {
    /// The tick, and the ports out as bits.
    seen: Vec<(u64, u32)>,
    most: usize,
}

impl Events {
    fn new(most: usize) -> Self {
        let seen = Vec::new();
        Events { seen, most }
    }
}

impl Observer<Group> for Events {
    fn sample(&mut self, now: &Sample<'_, Group>) -> Result<ControlFlow<()>, RunError> {
        let lines = now.w.step.iter().chain(&now.w.dir);
        let lines = lines.chain([&now.w.ready, &now.w.busy, &now.w.unit_rst]);
        let lines = lines.fold(0, |bits, line| bits << 1 | u32::from(*line));
        let same = self.seen.last().is_some_and(|(_, before)| *before == lines);
        if !same {
            self.seen.push((now.tick, lines));
        }
        Ok(match self.seen.len() < self.most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        })
    }
}

/// A half-period or T: none, short, long, any.
fn duration(most: u64) -> impl Strategy<Value = u64> {
    prop_oneof![Just(0), 1..8u64, 50..400u64, 0..=most]
}

/// Action of the control computer: the ticks it waits before, and its outputs then.
fn act() -> impl Strategy<Value = (u64, Port)> {
    let words = (
        0..WORDS,
        0..WORDS,
        duration(3000),
        0..4u64,
        duration(65_535),
    );
    let wait = prop_oneof![0..3u64, 0..3000u64];
    (wait, 0..9u8, any::<[bool; 4]>(), words).prop_map(|(wait, kind, flags, words)| {
        let [cyclic, stop, now, write_direction] = flags;
        let (base, last, period, axis, half_period) = words;
        let port = Port {
            command: kind < 4,
            base,
            last,
            cyclic,
            run: !stop || kind != 0,
            now,
            period,
            write_period: kind == 4,
            unit_end: kind == 5,
            port: WritePort {
                write: kind > 5,
                write_axis: axis,
                write_address: base,
                write_half_period: half_period,
                write_direction,
            },
        };
        (wait, port)
    })
}

/// The acts by tick.
fn schedule(acts: &[(u64, Port)]) -> Vec<(u64, Port)> {
    let mut due = 0;
    let act = |(wait, port): &(u64, Port)| {
        let tick = due + wait;
        due = tick + 1;
        (tick, port.clone())
    };
    acts.iter().map(act).collect()
}

/// The outputs of a computer in a tick, and for how many ticks it holds them. Between two acts the
/// lines without strobes stand somewhere.
fn drive(group: &Group, acts: &[(u64, Port)], tick: u64) -> (Port, u64) {
    let next = acts.partition_point(|(due, _)| *due < tick);
    match acts.get(next) {
        Some((due, port)) if *due == tick => (port.clone(), 1),
        other => {
            let held = other.map_or(u64::MAX, |(due, _)| due - tick);
            let mut lines = Random::new(next as u64).inputs(group);
            for strobe in [
                &mut lines.command,
                &mut lines.write_period,
                &mut lines.unit_end,
                &mut lines.port.write,
            ] {
                *strobe = false;
            }
            (lines, held)
        }
    }
}

fn same(group: &Group, acts: &[(u64, Port)], ticks: u64, most: usize) -> Result<(), TestCaseError> {
    let (mut stepped, mut jumped) = (Events::new(most), Events::new(most));
    let mut run = Simulator::new(group).unwrap();
    let mut forward = run.clone();
    let failed = |error: RunError| TestCaseError::fail(error.to_string());
    run.run(ticks, |tick, _| drive(group, acts, tick).0, &mut stepped)
        .map_err(failed)?;
    let held = |forward: &mut Simulator<Group>| {
        let (i, held) = drive(group, acts, forward.tick());
        forward.apply(&i)?;
        Ok(held)
    };
    forward
        .fast_forward(ticks, held, &mut jumped)
        .map_err(failed)?;
    prop_assert_eq!(stepped.seen, jumped.seen);
    prop_assert_eq!(run.tick(), forward.tick());
    prop_assert_eq!(registers(&run), registers(&forward));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    #[test]
    fn every_port_changes_in_its_tick_and_the_registers_end_the_same(
        literal in any::<bool>(),
        period in duration(3000),
        words in prop::collection::vec((duration(65_535), any::<bool>()), 3 * WORDS as usize),
        acts in prop::collection::vec(act(), 0..40),
        ticks in 0..30_000u64,
        most in prop_oneof![4 => Just(usize::MAX), 1 => 1..50usize],
    ) {
        let variant = if literal { Variant::Literal } else { Variant::Safe };
        let pattern = Pattern { base: 1, last: WORDS - 1, cyclic: true, period };
        let mut group = Group::free_running(3, Widths::default(), variant, pattern);
        for (index, (half_period, negative)) in words.into_iter().enumerate() {
            let memory = &mut group.memories[index % 3];
            memory.half_periods.set(index / 3, half_period);
            memory.directions.set(index / 3, negative.into());
        }
        same(&group, &schedule(&acts), ticks, most)?;
    }
}

#[test]
fn a_run_cut_into_pieces_is_the_same_run() {
    let period = 23;
    let pattern = Pattern {
        base: 0,
        last: 1,
        cyclic: true,
        period,
    };
    let mut group = Group::free_running(1, Widths::default(), Variant::Safe, pattern);
    group.memories[0].half_periods.set(0, 5);
    for piece in 1..50 {
        let mut events = Events::new(usize::MAX);
        let mut simulator = Simulator::new(&group).unwrap();
        while simulator.tick() < 300 {
            let ticks = piece.min(300 - simulator.tick());
            simulator
                .fast_forward(ticks, |_| Ok(u64::MAX), &mut events)
                .expect("no objection");
        }
        let mut whole = Events::new(usize::MAX);
        let mut stepped = Simulator::new(&group).unwrap();
        stepped
            .run(300, |_, _| zero(&group), &mut whole)
            .expect("no objection");
        assert_eq!(events.seen, whole.seen, "pieces of {piece} ticks");
        assert_eq!(registers(&simulator), registers(&stepped));
    }
}

/// A scenario that ships with the crate, and its drawing.
fn shipped(name: &str, text: &str, input: (&str, &[u8]), times: u32) -> (Drawing, Settings) {
    let loaded = Loaded::parse(name, text, &[]).expect("a scenario");
    let Scenario::PulseInterpolator(keys) = loaded.scenario else {
        panic!("{name} is of another circuit");
    };
    let mut scenario = keys.settings;
    scenario.clock_hz *= u64::from(times);
    scenario.line_unit_ticks *= times;
    scenario.arc_unit_ticks = scenario.arc_unit_ticks.map(|ticks| ticks * times);
    let drawing = read_text(input.0, input.1).expect("a drawing");
    let settings = scenario.settings(&drawing);
    (drawing, settings)
}

/// Plays a drawing both ways.
fn both((drawing, settings): &(Drawing, Settings), variant: Variant) {
    let (table, _) = compile(drawing, settings).expect("it compiles");
    let group = group(&table, variant);
    let stepped = play(&group, &table, &mut ()).expect("no observer objects");
    let jumped = fast_forward(&group, &table, &mut ()).expect("no observer objects");
    assert!(stepped == jumped, "the drivers saw something else");
}

#[test]
#[ignore = "takes long"]
fn the_drawings_that_ship_are_played_the_same_at_slow_and_fast_clocks() {
    let bracket = |times| {
        let input = include_bytes!("../../../waves/bracket.ngc");
        let text = include_str!("../../../waves/bracket.toml");
        shipped("bracket.toml", text, ("bracket.ngc", input), times)
    };
    let text = include_str!("../../../waves/rosette.toml");
    let input = include_bytes!("../../../waves/rosette.hpgl");
    let rosette = shipped("rosette.toml", text, ("rosette.hpgl", input), 1);
    both(&rosette, Variant::Safe);
    both(&bracket(1), Variant::Literal);
    both(&bracket(1), Variant::Safe);
    both(&bracket(5), Variant::Safe);
}
