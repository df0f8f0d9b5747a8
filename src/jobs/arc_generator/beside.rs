//! Arcs of a path on the conventional circuit, each from rest to rest, for comparison with the arc
//! generator.

use super::conventional::Conventional as Method;
use super::job::{Bench, Command, Played, See};
use super::joints::Hand;
use super::record::{blend_differences, put_differences, quantise, signed};
use crate::circuits::arc_generator::axis_terms::AXIS_WORD;
use crate::circuits::arc_generator::vector_row::VECTOR_WORD;
use crate::circuits::arc_generator::{Conventional, Widths};
use crate::circuits::blocks::record_memory::ARC;
use crate::path::record::{Record, WORDS, coordinate_word};
use crate::path::vector::scale;
use crate::sim::{Observer, RunError};
use std::f64::consts::TAU;

/// Returns the records of an arc: start, ramp, constant speed, ramp; without ramps two. Returns
/// `None` if a coordinate or the radius does not fit its word, or there are too many samples.
///
/// Each record has its start vector, so an error does not carry over to the next.
#[must_use]
pub fn records(run: &Method, counts_per_mm: f64, widths: &Widths) -> Option<Vec<Record>> {
    let circle = &run.circle;
    // The vector is the difference of rounded points.
    let counts = |mm: f64| mm.abs() * counts_per_mm + 1.0;
    let farthest = circle.extremes().into_iter().flatten().chain(circle.centre);
    let fits = |mm: f64| widths.holds(counts(mm));
    let runs = run.samples <= widths.most_samples() && run.ramp <= widths.most_blend_samples();
    if !(runs && fits(circle.radius) && farthest.into_iter().all(fits)) {
        return None;
    }
    let angle = |radians: f64| quantise(radians / TAU, widths.coefficient);
    let (ramp, all) = (angle(run.ramp_angle), angle(circle.angle));
    let power = i128::from(run.ramp).pow(4);
    let way = i128::from(all) - 2 * i128::from(ramp);
    let record = |samples, from, modulus, differences| {
        record(
            run,
            counts_per_mm,
            widths,
            (samples, from),
            (modulus, differences),
        )
    };
    let begin = record(0, 0, 1, [0; 4]);
    let even = record(run.samples, ramp, i128::from(run.samples), [way, 0, 0, 0]);
    let blend = |from, corners| record(run.ramp, from, power, blend_differences(corners, run.ramp));
    let mut records = match run.ramp {
        0 => vec![begin, even],
        _ => vec![
            begin,
            blend(0, [0, 0, ramp]),
            even,
            blend(all - ramp, [all - ramp, all, all]),
        ],
    };
    // The path ends at rest.
    if let Some(last) = records.last_mut() {
        last.words[0] |= 4;
    }
    Some(records)
}

fn record(
    run: &Method,
    counts_per_mm: f64,
    widths: &Widths,
    (samples, from): (u64, i64),
    (modulus, differences): (i128, [i128; 4]),
) -> Record {
    let (point, coefficient) = (widths.point, widths.coefficient);
    let units = |mm| scale(mm, counts_per_mm).map(|counts| quantise(counts, widths.guard()));
    let turned = from as f64 * TAU / (coefficient as f64).exp2();
    let (centre, begin) = (units(run.circle.centre), units(run.circle.point(turned)));
    let [x, y, z] = run.circle.axis;
    let axis = [x, y, z, x * x, y * y, z * z, x * y, x * z, y * z];
    let mut words = [0; WORDS];
    words[0] = ARC | samples << 3;
    words[1] = modulus as u64;
    words[2] = signed(from, coefficient);
    for k in 0..3 {
        words[5 + k] = signed(centre[k], point);
        words[VECTOR_WORD as usize + k] = signed(begin[k] - centre[k], point);
    }
    for (word, term) in words[AXIS_WORD as usize..].iter_mut().zip(axis) {
        let term = quantise(term, widths.coefficient_fraction());
        *word = signed(term, coefficient);
    }
    let engine = &mut words[coordinate_word(0)..coordinate_word(1)];
    put_differences(engine, differences, modulus, coefficient);
    Record { words }
}

/// Plays the records of arcs on `circuit`, a sample every `sample_ticks` ticks or as soon as one
/// is ready; `observer` sees it too.
///
/// # Errors
/// Returns the error of `observer`.
pub fn play(
    circuit: &Conventional,
    records: &[Record],
    sample_ticks: u32,
    observer: &mut dyn Observer<Conventional>,
) -> Result<Played, RunError> {
    let mut commands = Vec::new();
    let each = &mut |command| commands.push(command);
    let played = play_each(circuit, records, sample_ticks, None, observer, each)?;
    Ok(Played { commands, ..played })
}

/// Plays as [`play`] does, but passes every command to `each` and keeps none; the joints of `hand`
/// are beside the circuit as in [`job::play_each`](super::job::play_each).
///
/// # Errors
/// Returns the error of `observer`.
pub fn play_each(
    circuit: &Conventional,
    records: &[Record],
    sample_ticks: u32,
    hand: Option<Hand>,
    observer: &mut dyn Observer<Conventional>,
    each: &mut dyn FnMut(Command),
) -> Result<Played, RunError> {
    let bench = Bench::new(records, sample_ticks);
    bench.play(circuit, hand, observer, each, |watch| {
        See::of(watch, &watch.p.sequencer.q, &watch.w)
    })
}
