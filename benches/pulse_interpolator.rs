//! Ticks a second of the pulse interpolator, for groups of 1, 2, 3 and 8 axes that play a pattern
//! of their own: untraced, with every output read at each tick, and with a dump of every signal.
//! And for the job that ships with the crate, with drivers that count the pulses: every tick
//! stepped, and over idle ticks.

use divan::counter::ItemsCount;
use motion_rtl::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
use motion_rtl::hdl::zero;
use motion_rtl::input::read_text;
use motion_rtl::jobs::pulse_interpolator::job::{self, fast_forward, play};
use motion_rtl::jobs::pulse_interpolator::{Table, compile};
use motion_rtl::scenario::{Loaded, Scenario};
use motion_rtl::sim::{Observer, RunError, Sample, Simulator};
use motion_rtl::trace::{Clock, Options, Vcd};
use std::io;
use std::ops::ControlFlow;

/// Ticks of a run, and of a run with a dump.
const TICKS: u64 = 1_000_000;
const TICKS_DUMPED: u64 = 50_000;
/// Words of the pattern, and its unit time in ticks.
const WORDS: u64 = 64;
const PERIOD: u64 = 1000;

/// A group that plays half-periods from 10 to 500 ticks, others on each axis, both ways.
fn group(axes: usize) -> Group {
    let pattern = Pattern {
        base: 0,
        last: WORDS - 1,
        cyclic: true,
        period: PERIOD,
    };
    let mut group = Group::free_running(axes, Widths::default(), Variant::Safe, pattern);
    for (axis, memory) in (0..).zip(&mut group.memories) {
        for unit in 0..WORDS {
            let half_period = 10 + (unit * 37 + axis * 101) % 491;
            memory.half_periods.set(unit as usize, half_period);
            memory.directions.set(unit as usize, unit / 8 % 2);
        }
    }
    group
}

/// Reads every output; the sum keeps the reading from being left out.
#[derive(Default)]
struct Outputs(u64);

impl Observer<Group> for Outputs {
    fn sample(&mut self, now: &Sample<'_, Group>) -> Result<ControlFlow<()>, RunError> {
        let lines = now.w.step.iter().chain(&now.w.dir);
        let lines = lines.chain([&now.w.unit_rst, &now.w.ready, &now.w.busy]);
        self.0 += lines.filter(|line| **line).count() as u64;
        Ok(ControlFlow::Continue(()))
    }
}

fn run(group: &Group, ticks: u64, observer: impl Observer<Group>) {
    let mut simulator = Simulator::new(group).unwrap();
    let quiet = zero(group);
    simulator
        .run(ticks, |_, _| quiet.clone(), observer)
        .expect("no observer objects");
    divan::black_box(simulator.registers());
}

#[divan::bench(args = [1, 2, 3, 8])]
fn untraced(bencher: divan::Bencher<'_, '_>, axes: usize) {
    let group = group(axes);
    let bencher = bencher.counter(ItemsCount::new(TICKS));
    bencher.bench_local(|| run(&group, TICKS, ()));
}

#[divan::bench(args = [1, 2, 3, 8])]
fn outputs_read(bencher: divan::Bencher<'_, '_>, axes: usize) {
    let group = group(axes);
    bencher.counter(ItemsCount::new(TICKS)).bench_local(|| {
        let mut outputs = Outputs::default();
        run(&group, TICKS, &mut outputs);
        outputs.0
    });
}

#[divan::bench(args = [1, 2, 3, 8], sample_count = 20)]
fn dumped(bencher: divan::Bencher<'_, '_>, axes: usize) {
    let group = group(axes);
    let clock = Clock::from_hz(1_000_000).expect("a clock that a dump can show");
    bencher
        .counter(ItemsCount::new(TICKS_DUMPED))
        .with_inputs(|| Vcd::new(io::sink(), &group, clock, &Options::default()).expect("a dump"))
        .bench_local_values(|mut vcd| {
            run(&group, TICKS_DUMPED, &mut vcd);
            vcd.finish().is_ok()
        });
}

/// The job that ships with the crate, at another clock: unit times last as long as they did.
fn bracket(times: u32) -> Table {
    let (scenario, drawing) = (
        include_str!("../waves/bracket.toml"),
        include_bytes!("../waves/bracket.ngc"),
    );
    let loaded = Loaded::parse("bracket.toml", scenario, &[]).expect("a scenario");
    let Scenario::PulseInterpolator(keys) = loaded.scenario else {
        panic!("{:?}", loaded.scenario);
    };
    let mut scenario = keys.settings;
    scenario.clock_hz *= u64::from(times);
    scenario.line_unit_ticks *= times;
    scenario.arc_unit_ticks = scenario.arc_unit_ticks.map(|ticks| ticks * times);
    let drawing = read_text("bracket.ngc", drawing).expect("a program");
    let (table, _) = compile(&drawing, &scenario.settings(&drawing)).expect("a table");
    table
}

/// The clock, as a multiple of the 100 kHz of the scenario.
#[divan::bench(args = [1, 10], sample_count = 10)]
fn job_stepped(bencher: divan::Bencher<'_, '_>, times: u32) {
    let table = bracket(times);
    let group = job::group(&table, Variant::Safe);
    bencher
        .counter(ItemsCount::new(table.total_ticks()))
        .bench_local(|| play(&group, &table, &mut ()).expect("no observer objects"));
}

/// The clock, as a multiple of the 100 kHz of the scenario; idle ticks are skipped.
#[divan::bench(args = [1, 10, 100])]
fn job_fast_forward(bencher: divan::Bencher<'_, '_>, times: u32) {
    let table = bracket(times);
    let group = job::group(&table, Variant::Safe);
    bencher
        .counter(ItemsCount::new(table.total_ticks()))
        .bench_local(|| fast_forward(&group, &table, &mut ()).expect("no observer objects"));
}

fn main() {
    divan::main();
}
