//! Ticks a second of the pulse interpolator, for groups of 1, 2, 3 and 8 axes that play a pattern
//! of their own: untraced, with every output read at each tick, and with a dump of every signal.

use divan::counter::ItemsCount;
use motion_rtl::kernel::{Observer, RunError, Sample, Simulator, zero};
use motion_rtl::pulse_interpolator::{Group, Pattern, Variant};
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
fn group<const AXES: usize>() -> Group<AXES> {
    let pattern = Pattern {
        base: 0,
        last: WORDS - 1,
        cyclic: true,
        period: PERIOD,
    };
    let mut group = Group::free_running(Variant::Safe, pattern);
    for (axis, unit) in (0..AXES).flat_map(|axis| (0..WORDS).map(move |unit| (axis, unit))) {
        let half_period = 10 + (unit * 37 + axis as u64 * 101) % 491;
        let memory = &mut group.axes[axis].memory;
        memory.half_periods.set(unit as usize, half_period);
        memory.directions.set(unit as usize, unit / 8 % 2);
    }
    group
}

/// Reads every output; the sum keeps the reading from being left out.
#[derive(Default)]
struct Outputs(u64);

impl<const AXES: usize> Observer<Group<AXES>> for Outputs {
    #[inline]
    fn sample(&mut self, now: &Sample<'_, Group<AXES>>) -> Result<ControlFlow<()>, RunError> {
        let lines = now.w.step.iter().chain(&now.w.dir);
        let lines = lines.chain([&now.w.unit_rst, &now.w.ready, &now.w.busy]);
        self.0 += lines.filter(|line| line.get()).count() as u64;
        Ok(ControlFlow::Continue(()))
    }
}

fn run<const AXES: usize>(group: &Group<AXES>, ticks: u64, observer: impl Observer<Group<AXES>>) {
    let run = Simulator::new(group).run(ticks, |_, _| zero(), observer);
    divan::black_box(run.expect("no observer objects").registers());
}

#[divan::bench(consts = [1, 2, 3, 8])]
fn untraced<const AXES: usize>(bencher: divan::Bencher<'_, '_>) {
    let group = group::<AXES>();
    let bencher = bencher.counter(ItemsCount::new(TICKS));
    bencher.bench_local(|| run(&group, TICKS, ()));
}

#[divan::bench(consts = [1, 2, 3, 8])]
fn outputs_read<const AXES: usize>(bencher: divan::Bencher<'_, '_>) {
    let group = group::<AXES>();
    bencher.counter(ItemsCount::new(TICKS)).bench_local(|| {
        let mut outputs = Outputs::default();
        run(&group, TICKS, &mut outputs);
        outputs.0
    });
}

#[divan::bench(consts = [1, 2, 3, 8], sample_count = 20)]
fn dumped<const AXES: usize>(bencher: divan::Bencher<'_, '_>) {
    let group = group::<AXES>();
    let clock = Clock::from_hz(1_000_000).expect("a clock that a dump can show");
    bencher
        .counter(ItemsCount::new(TICKS_DUMPED))
        .with_inputs(|| Vcd::new(io::sink(), &group, clock, &Options::default()).expect("a dump"))
        .bench_local_values(|mut vcd| {
            run(&group, TICKS_DUMPED, &mut vcd);
            vcd.finish().is_ok()
        });
}

fn main() {
    divan::main();
}
