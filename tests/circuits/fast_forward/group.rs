//! Groups under random control computers, and drawings that ship with the crate.

use crate::common;
use motion_rtl::check::Random;
use motion_rtl::input::{Drawing, read_text};
use motion_rtl::jobs::pulse_interpolator::job::{fast_forward, group, play};
use motion_rtl::jobs::pulse_interpolator::{Settings, compile};
use motion_rtl::kernel::{Observer, RunError, Sample, Simulator, pack};
use motion_rtl::logic::Sim;
use motion_rtl::pulse_interpolator::group::{Group, In};
use motion_rtl::pulse_interpolator::{Pattern, Variant};
use motion_rtl::scenario::{Loaded, Scenario};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Words of the memories that are played.
const WORDS: u64 = 6;
type Port = In<Sim, 16, 24, 12>;

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

impl<const AXES: usize> Observer<Group<AXES>> for Events {
    fn sample(&mut self, now: &Sample<'_, Group<AXES>>) -> Result<ControlFlow<()>, RunError> {
        let lines = now.w.step.iter().chain(&now.w.dir);
        let lines = lines.chain([&now.w.ready, &now.w.busy, &now.w.unit_rst]);
        let lines = lines.fold(0, |bits, line| bits << 1 | u32::from(line.get()));
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

/// What the control computer does: the ticks it waits before, and its outputs then.
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
            command: (kind < 4).into(),
            base: base.into(),
            last: last.into(),
            cyclic: cyclic.into(),
            run: (!stop || kind != 0).into(),
            now: now.into(),
            period: period.into(),
            write_period: (kind == 4).into(),
            unit_end: (kind == 5).into(),
            write: (kind > 5).into(),
            write_axis: axis.into(),
            write_address: base.into(),
            write_half_period: half_period.into(),
            write_direction: write_direction.into(),
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
fn drive(acts: &[(u64, Port)], tick: u64) -> (Port, u64) {
    let next = acts.partition_point(|(due, _)| *due < tick);
    match acts.get(next) {
        Some((due, port)) if *due == tick => (port.clone(), 1),
        other => {
            let held = other.map_or(u64::MAX, |(due, _)| due - tick);
            let lines: Port = Random::new(next as u64).signals();
            let quiet = Port {
                command: false.into(),
                write_period: false.into(),
                unit_end: false.into(),
                write: false.into(),
                ..lines
            };
            (quiet, held)
        }
    }
}

fn same<const AXES: usize>(
    group: &Group<AXES>,
    acts: &[(u64, Port)],
    ticks: u64,
    most: usize,
) -> Result<(), TestCaseError> {
    let (mut stepped, mut jumped) = (Events::new(most), Events::new(most));
    let run =
        Simulator::new(group)
            .unwrap()
            .run(ticks, |tick, _| drive(acts, tick).0, &mut stepped);
    let forward = Simulator::new(group).unwrap().fast_forward(
        ticks,
        |tick, _| drive(acts, tick),
        &mut jumped,
    );
    let failed = |error: RunError| TestCaseError::fail(error.to_string());
    let (run, forward) = (run.map_err(failed)?, forward.map_err(failed)?);
    prop_assert_eq!(stepped.seen, jumped.seen);
    prop_assert_eq!(run.tick(), forward.tick());
    prop_assert_eq!(pack(&*run.registers()), pack(&*forward.registers()));
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
        let mut group = Group::<3>::free_running(variant, pattern);
        for (index, (half_period, negative)) in words.into_iter().enumerate() {
            let memory = &mut group.axes[index % 3].memory;
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
    let mut group = Group::<1>::free_running(Variant::Safe, pattern);
    group.axes[0].memory.half_periods.set(0, 5);
    let quiet = |_, _: &motion_rtl::kernel::Part<'_, _>| (common::idle(), u64::MAX);
    for piece in 1..50 {
        let mut events = Events::new(usize::MAX);
        let mut simulator = Simulator::new(&group).unwrap();
        while simulator.tick() < 300 {
            let ticks = piece.min(300 - simulator.tick());
            simulator = simulator
                .fast_forward(ticks, quiet, &mut events)
                .expect("no objection");
        }
        let mut whole = Events::new(usize::MAX);
        let stepped = Simulator::new(&group)
            .unwrap()
            .run(300, |_, _| common::idle(), &mut whole)
            .expect("no objection");
        assert_eq!(events.seen, whole.seen, "pieces of {piece} ticks");
        assert_eq!(pack(&*simulator.registers()), pack(&*stepped.registers()));
    }
}

/// A scenario that ships with the crate, and its drawing.
fn shipped(name: &str, text: &str, input: (&str, &[u8]), times: u32) -> (Drawing, Settings) {
    let loaded = Loaded::parse(name, text, &[]).expect("a scenario");
    let Scenario::PulseInterpolator(mut scenario) = loaded.scenario else {
        panic!("{name} is of another circuit");
    };
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
    let group = group::<2>(&table, variant);
    let stepped = play(&group, &table, ()).expect("no observer objects");
    let jumped = fast_forward(&group, &table, ()).expect("no observer objects");
    assert!(stepped == jumped, "the drivers saw something else");
}

#[test]
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
