//! The whole arc generator against a program, tick by tick.

use super::below;
use super::engine::quartic;
use super::program::{differences, rotated, wrap};
use motion_rtl::check::Random;
use motion_rtl::circuits::arc_generator::generator::In;
use motion_rtl::circuits::arc_generator::{ArcGenerator, Blend, Rounding};
use motion_rtl::hdl::{Cut, Value, zero};
use motion_rtl::trace::LastTicks;

const FULL: ArcGenerator = ArcGenerator::new(Rounding::Nearest, Blend::Differences);
const GUARD: u32 = 16;

/// A segment as its record and the points it makes.
struct Segment {
    record: [i128; 32],
    /// From where it begins, in guard units.
    points: Vec<[i128; 3]>,
}

fn nearest(numerator: i128, modulus: i128) -> i128 {
    (2 * numerator + modulus).div_euclid(2 * modulus)
}

fn polynomial(
    kind: i128,
    samples: i128,
    rests: bool,
    modulus: i128,
    at: impl Fn(usize, i128) -> i128,
) -> Segment {
    let mut record = [0; 32];
    record[0] = kind + 4 * i128::from(rests) + 8 * samples;
    record[1] = modulus;
    for coordinate in 0..3 {
        let [value, differences @ ..] = differences(|sample| at(coordinate, sample));
        record[2 + coordinate] = value / modulus;
        for (order, difference) in differences.into_iter().enumerate() {
            let first = 8 + 8 * coordinate + 2 * order;
            record[first] = difference.div_euclid(modulus);
            record[first + 1] = difference.rem_euclid(modulus);
        }
    }
    let point = |sample| [0, 1, 2].map(|coordinate| nearest(at(coordinate, sample), modulus));
    Segment {
        record,
        points: (0..=samples).map(point).collect(),
    }
}

fn blend(points: [[i128; 3]; 3], samples: i128, rests: bool) -> Segment {
    polynomial(0, samples, rests, samples.pow(4), |coordinate, sample| {
        let of = |point: [i128; 3]| point[coordinate];
        quartic(points.map(of), samples, sample)
    })
}

fn line(from: [i128; 3], to: [i128; 3], samples: i128, rests: bool) -> Segment {
    polynomial(1, samples, rests, samples, |coordinate, sample| {
        from[coordinate] * samples + (to[coordinate] - from[coordinate]) * sample
    })
}

fn arc(
    centre: [i128; 3],
    start: [i128; 3],
    matrix: [[i128; 3]; 3],
    (samples, rests): (i128, bool),
    rounding: Rounding,
) -> Segment {
    let mut record = [0; 32];
    record[0] = 2 + 4 * i128::from(rests) + 8 * samples;
    record[1] = 1;
    for coordinate in 0..3 {
        record[2 + coordinate] = start[coordinate];
        record[5 + coordinate] = centre[coordinate];
        for column in 0..3 {
            record[8 + 8 * coordinate + column] = matrix[coordinate][column];
        }
    }
    let next = |vector: &[i128; 3]| {
        let to = rotated(&matrix, *vector, 40, rounding == Rounding::Nearest);
        Some(to.map(|word| wrap(word, 40)))
    };
    let vectors = std::iter::successors(Some(start), next);
    let point = |vector: [i128; 3]| [0, 1, 2].map(|k| centre[k] + vector[k]);
    Segment {
        record,
        points: vectors.take(samples as usize + 1).map(point).collect(),
    }
}

fn random_point(random: &mut Random) -> [i128; 3] {
    // A quarter of the range, so that no blend overshoots it.
    [0; 3].map(|_| i128::from(below(random, 1 << 38)) - (1 << 37))
}

/// A segment of any kind; coefficients are any of rows whose sum stays in range.
fn random_segment(random: &mut Random, rounding: Rounding) -> Segment {
    let rests = below(random, 4) == 0;
    let samples = 1 + i128::from(below(random, 12));
    match below(random, 3) {
        0 => {
            let points = [0; 3].map(|_| random_point(random));
            blend(points, 2 * samples, rests)
        }
        1 => line(random_point(random), random_point(random), samples, rests),
        _ => {
            let third = (1u64 << 40) / 3;
            let entry =
                |random: &mut Random| i128::from(below(random, 2 * third)) - i128::from(third);
            let matrix = [0; 3].map(|_| [0; 3].map(|_| entry(random)));
            let (centre, start) = (random_point(random), random_point(random));
            arc(centre, start, matrix, (samples, rests), rounding)
        }
    }
}

/// The commands of a path: its first point, then what every segment makes.
fn commands(segments: &[Segment]) -> Vec<[i128; 3]> {
    let first = segments[0].points[0];
    let made = segments.iter().flat_map(|segment| &segment.points[1..]);
    let half = 1 << (GUARD - 1);
    std::iter::once(&first)
        .chain(made)
        .map(|point| point.map(|word| wrap((word + half) >> GUARD, 24)))
        .collect()
}

/// Writes the records as they find room, and starts the path when `start_with` wait or all are in.
struct Host<'a> {
    segments: &'a [Segment],
    segment: usize,
    word: usize,
    start_with: usize,
    started: bool,
}

impl Host<'_> {
    fn ports(&mut self, ready: bool, period: u64) -> In<Value> {
        let circuit = ArcGenerator::default();
        let mut segments = zero(&circuit).segments;
        if self.segment == self.segments.len().min(self.start_with) && !self.started {
            self.started = true;
            segments.start = true;
        }
        if let Some(segment) = self.segments.get(self.segment).filter(|_| ready) {
            segments.record.write = true;
            segments.record.write_word = self.word as u64;
            let data = segment.record[self.word] as u64;
            segments.record.write_data = data.cut(circuit.widths.data);
            self.word += 1;
            if self.word == 32 {
                segments.record.push = true;
                (self.word, self.segment) = (0, self.segment + 1);
            }
        }
        In {
            segments,
            halt: false,
            sample_period: period,
        }
    }
}

/// Results of a run: the ticks with new commands, the commands, `late` and `starved` at the end.
#[derive(Debug)]
struct Run {
    commands: Vec<(u64, [i128; 3])>,
    late: bool,
    starved: bool,
}

fn run(segments: &[Segment], rounding: Rounding, period: u64, start_with: usize) -> Run {
    let mut simulator =
        LastTicks::simulator(&ArcGenerator::new(rounding, Blend::Differences)).unwrap();
    let mut host = Host {
        segments,
        segment: 0,
        word: 0,
        start_with,
        started: false,
    };
    let mut commands = Vec::new();
    let mut before = [0; 3];
    let (mut ready, mut over) = (true, 0);
    while over < 3 {
        let tick = simulator.tick();
        assert!(tick < 1_000_000, "no end");
        let i = host.ports(ready, period);
        let pushed = i.segments.record.push;
        let (now, sampled, busy, free) = simulator
            .step_with(&i, |now| {
                let w = now.w;
                let command = [w.x, w.y, w.z].map(i128::from);
                (command, w.sampled, w.busy, w.ready)
            })
            .unwrap();
        // A push may make it not ready: it is looked at again a tick later.
        ready = free && !pushed;
        match sampled {
            true => commands.push((tick, now)),
            false => assert_eq!(now, before, "tick {tick}: a command without a sample"),
        }
        before = now;
        let ended = host.started && !busy && host.segment == segments.len() && tick > 10_000;
        over = if ended { over + 1 } else { 0 };
    }
    Run {
        commands,
        late: simulator.see(|s| s.w.late),
        starved: simulator.see(|s| s.w.starved),
    }
}

fn expected_ticks(first: u64, period: u64, count: usize) -> Vec<u64> {
    (0..count as u64).map(|k| first + k * period).collect()
}

#[test]
#[ignore = "takes long"]
fn random_paths_are_those_of_the_program_in_both_roundings() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let rounding = match seed % 2 {
            0 => Rounding::Nearest,
            _ => Rounding::Floor,
        };
        let count = 1 + below(&mut random, 30) as usize;
        let segments: Vec<_> = (0..count)
            .map(|_| random_segment(&mut random, rounding))
            .collect();
        // The host writes a record in 33 ticks: it keeps up with the shortest segments.
        let period = FULL.least_period() + below(&mut random, 100);
        let run = run(
            &segments,
            rounding,
            period,
            1 + below(&mut random, 16) as usize,
        );
        let expected = commands(&segments);
        let (ticks, seen): (Vec<_>, Vec<_>) = run.commands.into_iter().unzip();
        assert_eq!(seen, expected, "seed {seed}");
        assert_eq!(
            ticks,
            expected_ticks(ticks[0], period, ticks.len()),
            "seed {seed}"
        );
        assert!(!run.late, "seed {seed}");
        let rests = segments.last().is_some_and(|last| last.record[0] & 4 != 0);
        assert_eq!(run.starved, !rests, "seed {seed}");
    }
}

/// A line, and an arc behind it.
fn line_and_arc() -> [Segment; 2] {
    let (count, unit) = (1 << GUARD, 1i128 << 40);
    let (from, corner) = ([0, 0, 0], [100 * count, 0, 0]);
    let matrix = [[0, -unit, 0], [unit, 0, 0], [0, 0, unit]];
    let centre = [100 * count, 50 * count, 0];
    [
        line(from, corner, 4, false),
        arc(
            centre,
            [0, -50 * count, 0],
            matrix,
            (3, true),
            Rounding::Nearest,
        ),
    ]
}

#[test]
fn a_quarter_turn_is_exact() {
    let run = run(&line_and_arc(), Rounding::Nearest, 200, 2);
    let seen: Vec<_> = run.commands.iter().map(|(_, command)| *command).collect();
    let quarters = [[150, 50, 0], [100, 100, 0], [50, 50, 0]];
    let line = (0..=4).map(|k| [25 * k, 0, 0]);
    assert_eq!(seen, line.chain(quarters).collect::<Vec<_>>());
}

#[test]
fn the_least_period_is_enough_and_a_tick_less_is_late() {
    let least = FULL.least_period();
    for period in [least - 1, least, least + 1] {
        let run = run(&line_and_arc(), Rounding::Nearest, period, 2);
        assert_eq!(run.late, period < least, "{period} ticks");
        // A point that is late is not lost: it comes with the next sampling time.
        assert_eq!(run.commands.len(), 8);
        assert!(!run.starved);
    }
}

#[test]
fn the_first_point_is_ready_after_its_latency() {
    // The sampling time ends in every tick of a range around the latency.
    for period in 100..140 {
        let segments = line_and_arc();
        let run = run(&segments[..1], Rounding::Nearest, period, 1);
        let start = 32;
        // A sampling time is over in the ticks k·period − 1.
        let due = (start + FULL.first() + 1).div_ceil(period) * period;
        assert_eq!(run.commands[0].0, due, "period {period}");
    }
}

#[test]
#[ignore = "takes long"]
fn halt_leaves_the_commands_where_they_are() {
    let segments = line_and_arc();
    for halted in 300..900 {
        let mut simulator = LastTicks::simulator(&FULL).unwrap();
        let mut host = Host {
            segments: &segments,
            segment: 0,
            word: 0,
            start_with: 2,
            started: false,
        };
        let mut held = None;
        let mut ready = true;
        for tick in 0..1_500 {
            let mut i = host.ports(ready, 100);
            i.halt = tick == halted;
            let pushed = i.segments.record.push;
            let (free, command, sampled, busy) = simulator
                .step_with(&i, |now| {
                    let w = now.w;
                    (w.ready, [w.x, w.y, w.z], w.sampled, w.busy)
                })
                .unwrap();
            ready = free && !pushed;
            if tick > halted {
                assert!(
                    !sampled || tick == halted + 1,
                    "sampled after halt at {halted}"
                );
                assert!(!busy, "busy after halt at {halted}");
                assert_eq!(*held.get_or_insert(command), command);
            }
        }
        // Waiting segments are discarded, and a new path runs as from power-on.
        assert!(!simulator.see(|s| s.w.starved));
        host = Host {
            segments: &segments,
            segment: 0,
            word: 0,
            start_with: 2,
            started: false,
        };
        let mut seen = Vec::new();
        ready = true;
        for _ in 0..1_500 {
            let i = host.ports(ready, 100);
            let pushed = i.segments.record.push;
            let (free, command, sampled) = simulator
                .step_with(&i, |now| {
                    let command = [now.w.x, now.w.y, now.w.z].map(i128::from);
                    (now.w.ready, command, now.w.sampled)
                })
                .unwrap();
            ready = free && !pushed;
            seen.extend(sampled.then_some(command));
        }
        assert_eq!(seen, commands(&segments), "after halt at {halted}");
    }
}

/// A record that is written already can be pushed and started right after a halt, while a step of
/// the rotation would still be under way.
#[test]
fn a_path_that_begins_right_after_a_halt_is_that_of_its_record() {
    let segments = line_and_arc();
    let [_, behind] = &segments;
    for halted in 560..680 {
        let mut simulator = LastTicks::simulator(&FULL).unwrap();
        let mut host = Host {
            segments: &segments,
            segment: 0,
            word: 0,
            start_with: 2,
            started: false,
        };
        let mut seen = Vec::new();
        let mut was_rotating = false;
        for tick in 0..halted + 500 {
            let mut i = host.ports(true, 100);
            if (200..232).contains(&tick) {
                i.segments.record.write = true;
                i.segments.record.write_word = tick - 200;
                let data = behind.record[tick as usize - 200] as u64;
                i.segments.record.write_data = data.cut(simulator.circuit().widths.data);
            }
            i.halt = tick == halted;
            i.segments.record.push |= tick == halted + 1;
            i.segments.start |= tick == halted + 2;
            was_rotating |= tick == halted && simulator.see(|s| s.p.rotation.p.control.q.busy);
            let (command, sampled) = simulator
                .step_with(&i, |now| {
                    let command = [now.w.x, now.w.y, now.w.z].map(i128::from);
                    (command, now.w.sampled)
                })
                .unwrap();
            seen.extend((sampled && tick > halted + 1).then_some(command));
        }
        let expected = commands(std::slice::from_ref(behind));
        assert_eq!(
            seen, expected,
            "after halt at {halted}, rotating: {was_rotating}"
        );
    }
}
