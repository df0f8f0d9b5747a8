//! Motion-control patents as cycle-accurate register-transfer-level models on one shared
//! reference tick.
//!
//! A [circuit](kernel::Circuit) is two pure functions: `comb` settles the nets of a tick, `next`
//! makes the registers of the next. It is written once, for any meaning of its
//! [words](logic::Logic). As nodes they are a netlist, which the [engine] runs, proves and sweeps, and
//! which is printed as [Verilog](verilog). Every signal can be dumped.
//!
//! | patent | circuit | module |
//! |---|---|---|
//! | JP3640909B2 | multi-axis pulse interpolator | [`pulse_interpolator`] |
//! | JP3608587B2 | linear interpolator | [`linear_interpolator`] |
//! | JPH0646367B2 | lead-angle compensator | [`lead_angle`] |
//! | JPH0743606B2 | arc generator | [`arc_generator`] |
//! | CN104204977 | trajectory controller | [`trajectory_controller`] |
//! | all of them | one motion controller | [`machine`] |
//!
//! # Use one circuit in my test
//!
//! Two axes that play one word of pattern memory over and over: half-periods of 50 and 80 ticks in
//! unit times of 1000 ticks. The first unit time is silent, since nothing is read yet.
//!
//! ```
//! use motion_rtl::kernel::{Sample, Simulator, StopWhen, zero};
//! use motion_rtl::pulse_interpolator::{Group, Pattern, Variant};
//!
//! let pattern = Pattern { base: 0, last: 0, cyclic: true, period: 1000 };
//! let mut group = Group::<2>::free_running(Variant::Safe, pattern);
//! group.axes[0].memory.half_periods.set(0, 50);
//! group.axes[1].memory.half_periods.set(0, 80);
//!
//! let (mut rises, mut before) = ([0; 2], [false; 2]);
//! let look = StopWhen(|now: &Sample<'_, Group<2>>| {
//!     for axis in 0..2 {
//!         let step = now.w.step[axis].get();
//!         rises[axis] += u32::from(step && !before[axis]);
//!         before[axis] = step;
//!     }
//!     false
//! });
//! Simulator::new(&group)?.run(11_000, |_, _| zero(), look)?;
//! assert_eq!(rises, [100, 60]);
//! # Ok::<(), motion_rtl::kernel::RunError>(())
//! ```
//!
//! [`trace::Vcd`] as observer writes all signals; [`trace::replay`] writes dump and GTKWave save
//! file of a list of inputs.
//!
//! # Build my own circuit
//!
//! A watchdog: `bark` goes high when nothing came for `limit` ticks. [`check::reach`] tries every
//! input in every state that it can come to.
//!
//! ```
//! use motion_rtl::check::{Invariants, reach, require};
//! use motion_rtl::kernel::Circuit;
//! use motion_rtl::logic::{Bit, Logic, Unsigned};
//! use motion_rtl::signals;
//!
//! signals! { pub struct In<L, const W: usize> { pub alive: L::Bit, pub limit: L::U<W> } }
//! signals! { pub struct Reg<L, const W: usize> { count: L::U<W> as Analog, pub bark: L::Bit } }
//! signals! { pub struct Net<L, const W: usize> { next: L::U<W>, over: L::Bit } }
//!
//! struct Watchdog<const W: usize>;
//!
//! impl<const W: usize> Circuit for Watchdog<W> {
//!     const NAME: &'static str = "watchdog";
//!     const ABOUT: &'static str = "barks when nothing came for too long";
//!     type In<L: Logic> = In<L, W>;
//!     type Reg<L: Logic> = Reg<L, W>;
//!     type Net<L: Logic> = Net<L, W>;
//!
//!     fn comb<L: Logic>(&self, q: &Reg<L, W>, i: &In<L, W>) -> Net<L, W> {
//!         let next = q.count + 1;
//!         Net { next, over: !i.alive & !next.below(i.limit) }
//!     }
//!
//!     fn next<L: Logic>(&self, q: Reg<L, W>, w: &Net<L, W>, i: &In<L, W>) -> Reg<L, W> {
//!         let counts = w.over.mux(q.count, w.next);
//!         Reg { count: i.alive.mux(0.into(), counts), bark: w.over }
//!     }
//! }
//!
//! let law = Invariants::<Watchdog<4>>::new()
//!     .step("it never barks at what is alive", |now, next| {
//!         require(!now.i.alive.get() || !next.bark.get(), ["bark"], String::new)
//!     });
//! let proof = reach(&Watchdog::<4>, &law).run()?.proof().expect("it holds");
//! assert_eq!(proof.states, 30);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `rtl_notes/conventions.md` walks through all of it, up to the note and the catalogue.
//!
//! # Compose two
//!
//! A circuit made of circuits holds their registers and nets, settles them in the order in which
//! data flows, and computes nothing itself. Here an enable counter opens a gate in which the edges
//! of an encoder are counted.
//!
//! ```
//! use motion_rtl::blocks::{EnableCounter, QuadratureCounter};
//! use motion_rtl::blocks::{enable_counter, quadrature_counter};
//! use motion_rtl::kernel::{Circuit, Instance, Simulator};
//! use motion_rtl::logic::{Logic, Signed};
//! use motion_rtl::signals;
//!
//! signals! { pub struct In<L> { pub a: L::Bit, pub b: L::Bit, pub gate: L::U<8> } }
//! signals! {
//!     pub struct Reg<L> {
//!         gate_counter: enable_counter::Reg<L, 8>,
//!         position_counter: quadrature_counter::Reg<L, 16>,
//!     }
//! }
//! signals! {
//!     pub struct Net<L> {
//!         gate_counter: Instance<EnableCounter<8>, L>,
//!         position_counter: Instance<QuadratureCounter<16>, L>,
//!         pub way: L::I<16> as Analog,
//!     }
//! }
//!
//! /// Counts of an encoder between two ends of a gate.
//! struct SpeedMeter;
//!
//! impl Circuit for SpeedMeter {
//!     const NAME: &'static str = "speed_meter";
//!     const ABOUT: &'static str = "counts of an encoder in a gate";
//!     type In<L: Logic> = In<L>;
//!     type Reg<L: Logic> = Reg<L>;
//!     type Net<L: Logic> = Net<L>;
//!
//!     fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
//!         let gate_counter = Instance::settle(
//!             &EnableCounter,
//!             &q.gate_counter,
//!             enable_counter::In { period: i.gate },
//!         );
//!         let position_counter = Instance::settle(
//!             &QuadratureCounter,
//!             &q.position_counter,
//!             quadrature_counter::In { a: i.a, b: i.b, clear: gate_counter.w.enable },
//!         );
//!         Net { way: q.position_counter.position, gate_counter, position_counter }
//!     }
//!
//!     fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, _: &In<L>) -> Reg<L> {
//!         Reg {
//!             gate_counter: w.gate_counter.next(&EnableCounter, q.gate_counter),
//!             position_counter: w.position_counter.next(&QuadratureCounter, q.position_counter),
//!         }
//!     }
//! }
//!
//! // A count every four ticks, in gates of 100 ticks.
//! let mut meter = Simulator::new(&SpeedMeter)?;
//! let mut ways = Vec::new();
//! for tick in 0..400u64 {
//!     let (a, b) = ((tick + 4) / 8 % 2 == 1, tick / 8 % 2 == 1);
//!     let i = In { a: a.into(), b: b.into(), gate: 100.into() };
//!     let (next, way) = meter.step(i, |now| {
//!         now.w.gate_counter.w.enable.get().then(|| now.w.way.get())
//!     });
//!     ways.extend(way);
//!     meter = next;
//! }
//! assert_eq!(ways[1..], [25, 25, 25]);
//! # Ok::<(), motion_rtl::engine::EngineError>(())
//! ```
//!
//! # A golden model for my HDL
//!
//! Random inputs, the waves that belong to them, and a comparison of both dumps, tick by tick and
//! signal by signal. In between your simulator reads the stimulus and dumps what your design does.
//!
//! ```
//! use motion_rtl::check::{Drive, drive};
//! use motion_rtl::compare::{Settings, compare};
//! use motion_rtl::pulse_interpolator::UnitLaw;
//! use motion_rtl::trace::Clock;
//! use std::fs::File;
//!
//! let directory = tempfile::tempdir()?;
//! let at = |name: &str| directory.path().join(name);
//! let run = Drive { seed: 1, ticks: 1000, resets: true, clock: Clock::default() };
//! let mut stimulus = File::create(at("unit_law.stimulus"))?;
//! drive(&UnitLaw::<8>::default(), &run, &mut File::create(at("golden.vcd"))?, &mut stimulus)?;
//!
//! // What stands for your simulator here.
//! std::fs::copy(at("golden.vcd"), at("tb.vcd"))?;
//!
//! let report = compare(&at("golden.vcd"), &at("tb.vcd"), &Settings::default())?;
//! assert!(report.is_equal(), "{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `rtl_notes/golden_model.md` does it with a design in Verilog;
//! [`verilog::Verilog`] prints any circuit with a testbench.
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod arc_generator;
pub mod blocks;
pub mod check;
pub mod compare;
pub mod engine;
pub mod files;
pub mod input;
pub mod jobs;
pub mod kernel;
pub mod lead_angle;
pub mod linear_interpolator;
pub mod logic;
pub mod machine;
pub mod path;
pub mod picture;
pub mod plan;
pub mod plant;
pub mod pulse_interpolator;
pub mod registry;
pub mod scenario;
pub mod settings;
pub mod trace;
pub mod trajectory_controller;
pub mod verilog;

/// The code in the note on conventions is compiled and run as a test.
#[cfg(doctest)]
#[allow(rustdoc::invalid_codeblock_attributes, reason = "charts stand in it")]
#[doc = include_str!("../rtl_notes/conventions.md")]
pub struct Conventions;

/// The code in the README is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
