//! All circuits by name: what `list` and `check` show, what a note's timing charts run.

use crate::check::{Outcome, Progress, Proof, Specified, TooWide, reach};
use crate::kernel::{Circuit, Declarations, RunError};
use crate::pulse_interpolator::{
    AddressSequencer, Axis, CommandPort, Group, Pattern, PatternMemory, PulseGenerator, SyncStage,
    UnitLaw, UnitTimeCounter, UnitTimeRegister, Variant,
};
use crate::trace::chart::{Chart, ChartFailure};
use crate::trace::{Clock, LayoutError, Options, Vcd};
use std::io;
use std::path::{Path, PathBuf};

/// One circuit of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it does, in one line.
    pub about: &'static str,
    /// Its patent and block.
    pub source: &'static str,
    /// Its widths by name, with their defaults.
    pub widths: &'static [(&'static str, usize)],
    /// Its signals at the default widths.
    pub declarations: fn() -> Declarations,
    /// What it is made with for proofs and charts, in words: the numbers that [`Entry::make`]
    /// takes.
    pub arguments: &'static str,
    /// Makes it from those numbers; `None` where there is none with them.
    pub make: fn(&[u64]) -> Option<Box<dyn AnyCircuit>>,
    /// The width it is proved at unless another is asked for.
    pub proof_width: u64,
}

/// Widths that circuits are made with for proofs and charts.
pub const WIDTHS: std::ops::RangeInclusive<u64> = 2..=4;

/// A circuit whose type is forgotten.
pub trait AnyCircuit {
    /// Its name.
    fn name(&self) -> &'static str;
    /// What it does, in one line.
    fn about(&self) -> &'static str;
    /// Its signals, in the order of its waves.
    fn declarations(&self) -> Declarations;
    /// The names of its invariants.
    fn invariants(&self) -> Vec<String>;
    /// Proves its invariants, or finds the shortest way to break one; `waves` is where that is
    /// written as VCD and save file.
    ///
    /// # Errors
    /// The circuit is too wide to be proved.
    fn prove(
        &self,
        limit: u32,
        waves: Option<&Path>,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<Verdict, TooWide>;
    /// Prepares waves of it and throws them away.
    ///
    /// # Errors
    /// A name that is used twice in a scope, or that waveform files cannot carry.
    fn layout(&self) -> Result<(), LayoutError>;
    /// Runs a timing chart.
    ///
    /// # Errors
    /// The circuit does something else than the chart says, or the chart cannot be run on it.
    fn chart(&self, chart: &Chart) -> Result<(), ChartFailure>;
}

/// How a proof ended.
#[derive(Debug)]
pub enum Verdict {
    /// Every invariant holds.
    Proved(Proof),
    /// One does not.
    Broken {
        /// Tick, invariant, signals, and a table of the last ticks.
        report: String,
        /// The waves of it, where they were asked for.
        waves: Result<Vec<PathBuf>, RunError>,
    },
    /// More states than the limit.
    Undecided(Progress),
}

impl<C: Specified> AnyCircuit for C {
    fn name(&self) -> &'static str {
        C::NAME
    }

    fn about(&self) -> &'static str {
        C::ABOUT
    }

    fn declarations(&self) -> Declarations {
        Declarations::of(self)
    }

    fn invariants(&self) -> Vec<String> {
        let invariants = Specified::invariants(self);
        invariants.names().map(str::to_owned).collect()
    }

    fn prove(
        &self,
        limit: u32,
        waves: Option<&Path>,
        progress: &mut dyn FnMut(&Progress),
    ) -> Result<Verdict, TooWide> {
        let invariants = Specified::invariants(self);
        let outcome = reach(self, &invariants)
            .inputs(|i| self.applies(i))
            .limit(limit)
            .progress(progress)
            .run()?;
        Ok(match outcome {
            Outcome::Proof(proof) => Verdict::Proved(proof),
            Outcome::Limit(progress) => Verdict::Undecided(progress),
            Outcome::Counterexample(found) => Verdict::Broken {
                report: found.to_string(),
                waves: waves.map_or(Ok(Vec::new()), |directory| {
                    std::fs::create_dir_all(directory)?;
                    found.save(self, Clock::default(), directory)
                }),
            },
        })
    }

    fn layout(&self) -> Result<(), LayoutError> {
        Vcd::new(io::sink(), self, Clock::default(), &Options::default()).map(drop)
    }

    fn chart(&self, chart: &Chart) -> Result<(), ChartFailure> {
        chart.run(self)
    }
}

/// Makes a circuit with a width that is known only when the program runs.
macro_rules! of_width {
    ($arguments:expr, $width:ident => $circuit:expr) => {
        match $arguments.first() {
            Some(2) => boxed({
                const $width: usize = 2;
                $circuit
            }),
            Some(3) => boxed({
                const $width: usize = 3;
                $circuit
            }),
            Some(4) => boxed({
                const $width: usize = 4;
                $circuit
            }),
            _ => None,
        }
    };
}

fn boxed<C: Specified + 'static>(circuit: C) -> Option<Box<dyn AnyCircuit>> {
    Some(Box::new(circuit))
}

/// The argument after the width, or else `default`.
fn second(arguments: &[u64], default: u64) -> u64 {
    arguments.get(1).copied().unwrap_or(default)
}

fn variant(argument: u64) -> Variant {
    match argument {
        0 => Variant::Safe,
        _ => Variant::Literal,
    }
}

/// Fills a memory from address 0 up; a word is a half-period, 2^`N` more for the direction down.
fn fill<const N: usize, const A: usize>(
    memory: &mut PatternMemory<N, A>,
    words: impl Iterator<Item = u64>,
) {
    for (address, word) in words.enumerate() {
        memory.half_periods.set(address, word);
        memory.directions.set(address, word >> N);
    }
}

fn memory<const N: usize>(arguments: &[u64]) -> PatternMemory<N, 1> {
    let mut memory = PatternMemory::new(second(arguments, 0));
    fill(&mut memory, arguments.iter().skip(2).copied());
    memory
}

/// A group as small as a proof needs, or, where more than width and T is given, one for charts.
fn group<const W: usize>(arguments: &[u64]) -> Option<Box<dyn AnyCircuit>> {
    let period = second(arguments, 3);
    match arguments {
        [_, _, kind, start, words @ ..] => boxed(group_of_two::<W>(period, *kind, *start, words)),
        _ => boxed(small_group::<W>(period)),
    }
}

/// A group of one axis whose memory holds half-periods 1 and 2 in turn, the second downwards.
fn small_group<const W: usize>(period: u64) -> Group<1, W, W, 1> {
    let mut group = Group::new(Variant::Safe, period);
    fill(&mut group.axes[0].memory, [1, 2 | 1 << W].into_iter());
    group
}

/// A group of two axes with eight words of memory each; `words` are those of x and y in turn.
fn group_of_two<const W: usize>(
    period: u64,
    kind: u64,
    start: u64,
    words: &[u64],
) -> Group<2, W, W, 3> {
    let mut group = Group::new(variant(kind), period);
    for (axis, block) in group.axes.iter_mut().enumerate() {
        fill(
            &mut block.memory,
            words.iter().skip(axis).step_by(2).copied(),
        );
    }
    group.port.free_running = (start > 0).then_some(Pattern {
        base: 0,
        last: (words.len().div_ceil(2) as u64).saturating_sub(1),
        repeat: start == 2,
        period,
    });
    group
}

fn group_of_width(arguments: &[u64]) -> Option<Box<dyn AnyCircuit>> {
    match arguments.first() {
        Some(2) => group::<2>(arguments),
        Some(3) => group::<3>(arguments),
        Some(4) => group::<4>(arguments),
        _ => None,
    }
}

/// An entry for a circuit type, given with its default widths and how it is made small.
macro_rules! entry {
    (
        $full:ty, $circuit:expr, $proof_width:literal, $source:literal, [$($name:literal = $bits:literal),*],
        $arguments:literal, |$given:ident| $make:expr
    ) => {
        Entry {
            name: <$full as Circuit>::NAME,
            about: <$full as Circuit>::ABOUT,
            source: $source,
            widths: &[$(($name, $bits)),*],
            declarations: || Declarations::of::<$full>(&$circuit),
            arguments: $arguments,
            make: |$given| $make,
            proof_width: $proof_width,
        }
    };
}

/// Every circuit, blocks before what is made of them.
pub const CATALOGUE: &[Entry] = &[
    entry!(
        UnitTimeCounter<24>,
        UnitTimeCounter,
        3,
        "JP3640909B2 30",
        ["T" = 24],
        "width",
        |given| { of_width!(given, W => UnitTimeCounter::<W>) }
    ),
    entry!(
        UnitTimeRegister<24>,
        UnitTimeRegister { period: 1000 },
        3,
        "JP3640909B2 ¶0016",
        ["T" = 24],
        "width, T at power-on",
        |given| { of_width!(given, W => UnitTimeRegister::<W> { period: second(given, 1) }) }
    ),
    entry!(
        PulseGenerator<16>,
        PulseGenerator::default(),
        3,
        "JP3640909B2 20 = 201 + 202",
        ["N" = 16],
        "width, 0 for safe or 1 for literal",
        |given| {
            of_width!(given, W => PulseGenerator::<W> { variant: variant(second(given, 0)) })
        }
    ),
    entry!(
        SyncStage,
        SyncStage,
        3,
        "JP3640909B2 40",
        [],
        "nothing",
        |_given| boxed(SyncStage)
    ),
    entry!(
        PatternMemory<16, 12>, PatternMemory::new(0), 3, "JP3640909B2 10", ["N" = 16, "A" = 12],
        "width of the half-period (addresses have one bit), axis, words at power-on (a half-period, \
         2^width more for down)",
        |given| { of_width!(given, W => memory::<W>(given)) }
    ),
    entry!(
        AddressSequencer<12>,
        AddressSequencer,
        3,
        "JP3640909B2 50",
        ["A" = 12],
        "width",
        |given| { of_width!(given, W => AddressSequencer::<W>) }
    ),
    entry!(
        CommandPort<12, 24>, CommandPort::default(), 3, "JP3640909B2 ¶0018, ¶0026", ["A" = 12, "T" = 24],
        "width",
        |given| { of_width!(given, W => CommandPort::<W, W>::default()) }
    ),
    entry!(
        Axis<16, 12>, Axis::new(0, Variant::Safe), 3, "JP3640909B2 10 + 20 + 40", ["N" = 16, "A" = 12],
        "width of the half-period (addresses have one bit), 0 for safe or 1 for literal",
        |given| { of_width!(given, W => Axis::<W, 1>::new(0, variant(second(given, 0)))) }
    ),
    entry!(
        UnitLaw<16>,
        UnitLaw::default(),
        3,
        "JP3640909B2 30 + 20 + 40, with ghosts",
        ["W" = 16],
        "width, 0 for safe or 1 for literal",
        |given| { of_width!(given, W => UnitLaw::<W>::new(variant(second(given, 0)))) }
    ),
    entry!(
        Group<2>,
        Group::new(Variant::Safe, 1000),
        2,
        "JP3640909B2 1",
        ["AXES" = 2, "N" = 16, "T" = 24, "A" = 12],
        "width of half-period and T, T at power-on: one axis, two words of memory (1 up, 2 down); \
         then 0 for safe or 1 for literal, and 0 to wait, 1 to play once or 2 to loop by itself: two \
         axes of eight words; then words of x and y in turn (a half-period, 2^width more for down)",
        |given| { group_of_width(given) }
    ),
];

/// The entry of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    CATALOGUE.iter().find(|entry| entry.name == name)
}
