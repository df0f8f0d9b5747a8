//! Motion-control patents as cycle-accurate register-transfer-level models on one shared
//! reference tick.
//!
//! A [circuit](hdl::Circuit) is a struct with one function, [`tick`](hdl::Circuit::tick), which
//! computes the nets of a tick and the registers of the next. The function is elaborated to a
//! netlist, which the [engine] runs, proves and sweeps, and which is printed as
//! [Verilog](verilog) and [VHDL](vhdl). Every signal can be dumped.
//!
//! | patent | circuit | module |
//! |---|---|---|
//! | JP3640909B2 | multi-axis pulse interpolator | [`pulse_interpolator`](circuits::pulse_interpolator) |
//! | JP3608587B2 | linear interpolator | [`linear_interpolator`](circuits::linear_interpolator) |
//! | JPH0646367B2 | lead-angle compensator | [`lead_angle`](circuits::lead_angle) |
//! | JPH0743606B2 | arc generator | [`arc_generator`](circuits::arc_generator) |
//! | CN104204977 | trajectory controller | [`trajectory_controller`](circuits::trajectory_controller) |
//! | all of them | one motion controller | [`machine`](circuits::machine) |
//!
//! # Use one circuit in my test
//!
//! Two axes that play one word of pattern memory over and over: half-periods of 50 and 80 ticks in
//! unit times of 1000 ticks. The first unit time has no pulses, since nothing is read yet.
//!
//! ```
//! use motion_rtl::circuits::pulse_interpolator::{Group, Pattern, Variant, Widths};
//! use motion_rtl::sim::Simulator;
//!
//! let pattern = Pattern { base: 0, last: 0, cyclic: true, period: 1000 };
//! let mut group = Group::free_running(2, Widths::default(), Variant::Safe, pattern);
//! group.memories[0].half_periods.set(0, 50);
//! group.memories[1].half_periods.set(0, 80);
//! let mut simulator = Simulator::new(&group)?;
//!
//! let (mut rises, mut before) = ([0; 2], [false; 2]);
//! for _ in 0..11_000 {
//!     for axis in 0..2 {
//!         let step = simulator.see(|s| s.w.step[axis]);
//!         rises[axis] += u32::from(step && !before[axis]);
//!         before[axis] = step;
//!     }
//!     simulator.step();
//! }
//! assert_eq!(rises, [100, 60]);
//! # Ok::<(), motion_rtl::engine::EngineError>(())
//! ```
//!
//! A [`Model`] runs a circuit of the catalogue by name, and finds its signals by name: without any
//! type of the circuit, and with snapshots and waves that are switched on and off.
//!
//! A run with [`trace::Vcd`] as observer writes all signals; [`trace::replay`] writes the dump and
//! the GTKWave save file for a list of inputs.
//!
//! # Build my own circuit
//!
//! A watchdog: `bark` goes high after `limit` ticks without `alive`. [`check::reach`] tries every
//! input in every reachable state.
//!
//! ```
//! use motion_rtl::prelude::*;
//!
//! #[derive(Debug, Clone)]
//! struct Watchdog {
//!     width: usize,
//! }
//!
//! signals! { for Watchdog as c;
//!     pub struct In { pub alive: Bit, pub limit: U(c.width) }
//!     pub struct Reg { count: U(c.width) as Analog = 0, pub bark: Bit = 0 }
//!     pub struct Net { next: U(c.width), over: Bit }
//! }
//!
//! impl Circuit for Watchdog {
//!     const NAME: &'static str = "watchdog";
//!     const ABOUT: &'static str = "barks when nothing came for too long";
//!     records!(In, Reg, Net);
//!
//!     fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
//!         let next = q.count + 1;
//!         let over = !i.alive & !next.below(i.limit);
//!         let count = i.alive.mux(0, over.mux(q.count, next));
//!         (Net { next, over }, Reg { count, bark: over })
//!     }
//! }
//!
//! let watchdog = Watchdog { width: 4 };
//! let law = Invariants::<Watchdog>::new().step("it never barks at what is alive", |now, next| {
//!     require(!now.i.alive || !next.q.bark, ["bark"], String::new)
//! });
//! let proof = reach(&watchdog, &law).run()?.proof().expect("it holds");
//! assert_eq!(proof.states, 30);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `rtl_notes/conventions/add_a_circuit.md` walks through all of it, up to the note and the catalogue.
//!
//! # Compose two
//!
//! A circuit made of circuits settles them in the order in which data flows, and computes nothing
//! itself. Here an enable counter opens a gate in which the edges of an encoder are counted.
//!
//! ```
//! use motion_rtl::circuits::blocks::{EnableCounter, QuadratureCounter};
//! use motion_rtl::circuits::blocks::{enable_counter, quadrature_counter};
//! use motion_rtl::prelude::*;
//!
//! /// Counts of an encoder between two ends of a gate.
//! #[derive(Debug, Clone)]
//! struct SpeedMeter;
//!
//! signals! { for SpeedMeter as _c;
//!     pub struct In { pub a: Bit, pub b: Bit, pub gate: U(8) }
//!     pub struct Parts {
//!         gate_counter: Part<EnableCounter>(EnableCounter { width: 8 }),
//!         position_counter: Part<QuadratureCounter>(QuadratureCounter { width: 16 }),
//!     }
//!     pub struct Net { pub way: I(16) as Analog }
//! }
//!
//! impl Circuit for SpeedMeter {
//!     const NAME: &'static str = "speed_meter";
//!     const ABOUT: &'static str = "counts of an encoder in a gate";
//!     records!(In, Nothing, Net, Parts);
//!
//!     fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
//!         let gate = p.gate_counter.settle(enable_counter::In { period: i.gate });
//!         let counter = p.position_counter.settle(quadrature_counter::In {
//!             a: i.a,
//!             b: i.b,
//!             clear: gate.w.enable,
//!         });
//!         (Net { way: counter.q.position }, Nothing)
//!     }
//! }
//!
//! // A count every four ticks, in gates of 100 ticks.
//! let mut meter = Simulator::new(&SpeedMeter)?;
//! let mut ways = Vec::new();
//! for tick in 0..400u64 {
//!     let (a, b) = ((tick + 4) / 8 % 2 == 1, tick / 8 % 2 == 1);
//!     let way = meter.step_with(&In { a, b, gate: 100 }, |now| {
//!         now.p.gate_counter.w.enable.then(|| now.w.way)
//!     })?;
//!     ways.extend(way);
//! }
//! assert_eq!(ways[1..], [25, 25, 25]);
//! # Ok::<(), motion_rtl::sim::RunError>(())
//! ```
//!
//! # A golden model for my HDL
//!
//! Random inputs, the waves that belong to them, and a comparison of both dumps, tick by tick and
//! signal by signal. In between your simulator reads the stimulus and dumps what your design does.
//!
//! ```
//! use motion_rtl::check::{Drive, drive};
//! use motion_rtl::circuits::pulse_interpolator::{UnitLaw, Variant};
//! use motion_rtl::compare::{Settings, compare};
//! use motion_rtl::trace::Clock;
//! use std::fs::File;
//!
//! let directory = tempfile::tempdir()?;
//! let at = |name: &str| directory.path().join(name);
//! let run = Drive { seed: 1, ticks: 1000, resets: true, bounded: false, clock: Clock::default() };
//! let waves = File::create(at("golden.vcd"))?;
//! let stimulus = File::create(at("unit_law.stimulus"))?;
//! let expected = File::create(at("unit_law.expected"))?;
//! let circuit = UnitLaw { width: 8, variant: Variant::Safe };
//! drive(&circuit, &run, waves, stimulus, expected)?;
//!
//! // In place of your simulator.
//! std::fs::copy(at("golden.vcd"), at("tb.vcd"))?;
//!
//! let report = compare(&at("golden.vcd"), &at("tb.vcd"), &Settings::default())?;
//! assert!(report.is_equal(), "{report}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `rtl_notes/golden_model.md` does it with a design in Verilog;
//! [`verilog::Verilog`] prints any circuit with a testbench.
//!
//! # Floors
//!
//! A module uses only modules of the floors below it, and a test reads every path. The lowest
//! floor comes first, here and in the list of modules. The program stands above all of them.
//!
//! | modules | floor |
//! |---|---|
//! | [`nearest`], [`netlist`] | nearest names; nodes, signals and modules of a netlist, mistakes of a circuit |
//! | [`engine`], [`hdl`] | netlists made to run; the language that makes netlists |
//! | [`sim`] | simulator of a circuit, observers, elaborated and running circuits without their type |
//! | [`files`], [`picture`] | files replaced as a whole, drawings |
//! | [`settings`] | settings with defaults, ranges and units, and their errors |
//! | [`input`], [`trace`] | G-code, HPGL and position logs; waves, stimuli, timing charts |
//! | [`printed`] | files of printed circuits, what their printers share |
//! | [`checker`] | a design's ports compared with a running model |
//! | [`compare`], [`plan`], [`plant`], [`verilog`], [`vhdl`] | comparison of waves, speed profiles, motors, Verilog, VHDL |
//! | [`path`] | paths in space |
//! | [`check`] | proofs, sweeps, random stimuli |
//! | [`prelude`] | names for writing and testing a circuit |
//! | [`circuits`] | the circuits of the patents |
//! | [`jobs`], [`registry`] | control computers that feed the circuits; the catalogue |
//! | [`scenario`] | scenario files |
#![deny(unsafe_code)]

pub mod nearest;
#[warn(missing_docs)]
pub mod netlist;

#[warn(missing_docs)]
pub mod engine;
#[warn(missing_docs)]
pub mod hdl;

#[warn(missing_docs)]
pub mod sim;

pub mod files;
pub mod picture;

pub mod settings;

pub mod input;
#[warn(missing_docs)]
pub mod trace;

#[warn(missing_docs)]
pub mod printed;

#[warn(missing_docs)]
pub mod checker;

#[warn(missing_docs)]
pub mod compare;
pub mod plan;
pub mod plant;
#[warn(missing_docs)]
pub mod verilog;
#[warn(missing_docs)]
pub mod vhdl;

pub mod path;

#[warn(missing_docs)]
pub mod check;

#[warn(missing_docs)]
pub mod prelude;

pub mod circuits;

pub mod jobs;
#[warn(missing_docs)]
pub mod registry;

pub mod scenario;

pub use sim::Model;

/// The code in the notes on conventions is compiled and run as tests.
#[cfg(doctest)]
#[allow(rustdoc::invalid_codeblock_attributes, reason = "charts stand in it")]
pub mod conventions {
    #[doc = include_str!("../rtl_notes/conventions/README.md")]
    pub struct Readme;
    #[doc = include_str!("../rtl_notes/conventions/add_a_circuit.md")]
    pub struct AddACircuit;
    #[doc = include_str!("../rtl_notes/conventions/composites.md")]
    pub struct Composites;
    #[doc = include_str!("../rtl_notes/conventions/if_you_know_verilog.md")]
    pub struct IfYouKnowVerilog;
    #[doc = include_str!("../rtl_notes/conventions/memories.md")]
    pub struct Memories;
    #[doc = include_str!("../rtl_notes/conventions/proofs.md")]
    pub struct Proofs;
    #[doc = include_str!("../rtl_notes/proofs.md")]
    pub struct WhatIsProved;
    #[doc = include_str!("../rtl_notes/conventions/running.md")]
    pub struct Running;
}

/// The code in the note on the golden model is compiled as a test.
#[cfg(doctest)]
#[allow(rustdoc::invalid_codeblock_attributes, reason = "charts stand in it")]
#[doc = include_str!("../rtl_notes/golden_model.md")]
pub struct GoldenModel;

/// The code in the README is compiled and run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
