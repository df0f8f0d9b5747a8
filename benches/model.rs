//! Time of a model without types: until the first tick, a tick with ports set and read, and runs
//! with arrays.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use motion_rtl::Model;
use motion_rtl::registry::Pair;
use motion_rtl::sim::{Handle, PortDirection};

const CIRCUITS: [&str; 7] = [
    "enable_counter",
    "unit_law",
    "linear_interpolator",
    "arc_generator",
    "pulse_interpolator",
    "trajectory_controller",
    "machine",
];

/// Ticks of a run.
const TICKS: usize = 20_000;

fn main() {
    divan::main();
}

/// From nothing to the end of the first tick.
#[divan::bench(args = CIRCUITS, sample_count = 11)]
fn first_tick(name: &str) -> Model {
    let mut model = Model::new(name, &[]).unwrap();
    model.step();
    model
}

/// From nothing to the first handle, for which all names are made, and to the end of the first
/// tick.
#[divan::bench(args = CIRCUITS, sample_count = 11)]
fn first_tick_with_a_name(name: &str) -> Model {
    let mut model = Model::new(name, &[]).unwrap();
    let port = match name {
        "enable_counter" | "unit_law" => "period",
        "linear_interpolator" => "scan",
        "pulse_interpolator" => "command",
        _ => "halt",
    };
    model.set(port, 1).unwrap();
    model.step();
    model
}

/// A model at power-on, its input ports and its output ports.
fn cold(name: &str) -> (Model, Vec<Handle>, Vec<Handle>) {
    let model = Model::new(name, &[]).unwrap();
    let signals = model.signals();
    let ports = |direction| {
        let ports = signals
            .iter()
            .filter(|signal| signal.port == Some(direction));
        ports.map(|signal| signal.handle).collect::<Vec<_>>()
    };
    let (inputs, outputs) = (ports(PortDirection::In), ports(PortDirection::Out));
    (model, inputs, outputs)
}

/// A model that is compiled after all input ports have moved, its input ports and its output
/// ports.
fn warm(name: &str) -> (Model, Vec<Handle>, Vec<Handle>) {
    let (mut model, inputs, outputs) = cold(name);
    for tick in 0..20_000u64 {
        for (port, handle) in inputs.iter().enumerate() {
            let bit = tick.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (port % 64) & 1;
            model.set_bits(*handle, bit).unwrap();
        }
        model.step();
    }
    (model, inputs, outputs)
}

/// Set, get and step of a small circuit, by handle.
#[divan::bench]
fn three_calls(bencher: Bencher<'_, '_>) {
    let keys = [Pair::new("width", 16)];
    let mut model = Model::new("enable_counter", &keys).unwrap();
    let [period, enable] = ["period", "enable"].map(|name| model.find(name).unwrap());
    model.set(period, 100).unwrap();
    model.run(100_000);
    bencher.counter(ItemsCount::new(TICKS)).bench_local(|| {
        let mut enables = 0;
        for tick in 0..TICKS as u64 {
            model.set(period, black_box(100 + (tick & 1))).unwrap();
            enables += model.get(enable).unwrap();
            model.step();
        }
        enables
    });
}

/// The same by name.
#[divan::bench]
fn three_calls_by_name(bencher: Bencher<'_, '_>) {
    let keys = [Pair::new("width", 16)];
    let mut model = Model::new("enable_counter", &keys).unwrap();
    model.set("period", 100).unwrap();
    model.run(100_000);
    bencher.counter(ItemsCount::new(TICKS)).bench_local(|| {
        let mut enables = 0;
        for tick in 0..TICKS as u64 {
            model.set(black_box("period"), 100 + (tick & 1)).unwrap();
            enables += model.get(black_box("enable")).unwrap();
            model.step();
        }
        enables
    });
}

/// All input ports set to what they are, all output ports read, and a step.
#[divan::bench(args = CIRCUITS)]
fn all_ports(bencher: Bencher<'_, '_>, name: &str) {
    let (mut model, inputs, outputs) = warm(name);
    let held: Vec<u64> = inputs
        .iter()
        .map(|port| model.get(*port).unwrap())
        .collect();
    bencher.counter(ItemsCount::new(TICKS)).bench_local(|| {
        let mut sum = 0u64;
        for _ in 0..TICKS {
            for (port, word) in inputs.iter().zip(&held) {
                model.set_bits(*port, black_box(*word)).unwrap();
            }
            for port in &outputs {
                sum = sum.wrapping_add(model.get(*port).unwrap());
            }
            model.step();
        }
        sum
    });
}

/// One input port from an array, one output port to an array, compiled for this run.
#[divan::bench(args = CIRCUITS)]
fn arrays(bencher: Bencher<'_, '_>, name: &str) {
    let (mut model, inputs, outputs) = cold(name);
    let values = vec![1; TICKS];
    let input: Vec<(Handle, &[u64])> = vec![(inputs[0], &values)];
    let seen = &outputs[..1];
    model.play(TICKS, &input, seen).unwrap();
    bencher
        .counter(ItemsCount::new(TICKS))
        .bench_local(|| model.play(TICKS, &input, seen).unwrap());
}

/// A snapshot that is restored.
#[divan::bench(args = CIRCUITS)]
fn snapshot_and_restore(bencher: Bencher<'_, '_>, name: &str) {
    let (mut model, ..) = warm(name);
    bencher.bench_local(|| {
        let then = model.snapshot();
        model.restore(&then).unwrap();
    });
}
