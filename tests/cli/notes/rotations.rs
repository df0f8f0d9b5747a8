//! Figures of the arc generator: how far its rotations are off, and what a sample costs.

use motion_rtl::circuits::arc_generator::{Rounding, Widths};
use motion_rtl::jobs::arc_generator::bounds::rotation_error;
use motion_rtl::jobs::arc_generator::conventional::{
    Conventional, Operations, blend, blend_terms, difference_engines, products, rotation,
};
use motion_rtl::jobs::arc_generator::prepare::Timing;
use motion_rtl::jobs::arc_generator::prepared::{Prepared, Segment, Shape};
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::Decoded;
use motion_rtl::jobs::arc_generator::settings::ShortPieces;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::vector::{distance, rodrigues, sub};
use std::f64::consts::TAU;
use std::fmt::Write as _;

const TIMING: Timing = Timing {
    sample_s: 0.001,
    blend_samples: 64,
    corner: 0.0,
    short_pieces: ShortPieces::Refuse,
    most_samples: Widths::FULL.most_samples(),
};

/// A turn around a tilted axis, in counts; nothing of it is a whole number.
fn turn(radius: f64) -> Circle {
    let centre = [0.3, -1.7, 2.1];
    // At right angles to the axis, of length 1.
    let across = [3.0 / 7.0, 6.0 / 7.0, 2.0 / 7.0];
    Circle {
        centre,
        axis: [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0],
        start: std::array::from_fn(|k| centre[k] + radius * across[k]),
        radius,
        angle: TAU,
    }
}

/// Largest distance of a point of the turn from its exact point, in counts, before it is rounded to
/// counts.
fn observed(radius: f64, steps: u64, widths: &Widths, rounding: Rounding) -> f64 {
    let circle = turn(radius);
    let step = TAU / steps as f64;
    let shape = Shape::Arc {
        circle,
        from: 0.0,
        step,
    };
    let segment = Segment {
        shape,
        samples: steps,
        first_sample: 0,
        piece: 0,
        next_piece: None,
        ends_at_rest: true,
    };
    let prepared = Prepared {
        segments: vec![segment],
        pieces: Vec::new(),
        timing: TIMING,
    };
    let records = records(&prepared, 1.0, widths, rounding).expect("it fits into the words");
    let points = Decoded::of(&records[0], widths).points(widths, rounding);
    let unit = (widths.guard() as f64).exp2();
    let errors = (0..).zip(points).map(|(sample, point)| {
        let exact = circle.point(step * f64::from(sample));
        distance(point.map(|units| units as f64 / unit), exact)
    });
    errors.fold(0.0, f64::max)
}

/// A table of the bound and of what a turn shows.
pub fn errors() -> String {
    let with = |guard: usize, fraction: usize| Widths {
        point: Widths::FULL.position + guard,
        coefficient: fraction + 2,
        ..Widths::FULL
    };
    let mut rows = Vec::new();
    for radius in [1e3, 1e5, 4e6] {
        rows.extend([360, 3600, 36_000].map(|steps| (radius, steps, 16, 40)));
    }
    rows.extend([(8, 40), (16, 30), (8, 30)].map(|(guard, bits)| (1e3, 3600, guard, bits)));
    let mut text = String::from(
        "| radius | steps | G | B | bound, nearest | observed | bound, floor | observed |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for (radius, steps, guard, fraction) in rows {
        let widths = with(guard, fraction);
        let _ = write!(text, "| {radius} | {steps} | {guard} | {fraction} |");
        for rounding in [Rounding::Nearest, Rounding::Floor] {
            let bound = rotation_error(radius, steps, &widths, rounding);
            let seen = observed(radius, steps, &widths, rounding);
            assert!(seen <= bound, "{radius} in {steps}: {seen} above {bound}");
            let _ = write!(text, " {bound:.5} | {seen:.5} |");
        }
        text.push('\n');
    }
    text
}

/// A table of what a sample costs by either method.
pub fn operations() -> String {
    let circle = turn(1e3);
    let conventional = Conventional::new(&circle, 1e3, &TIMING);
    let samples: Vec<_> = conventional.samples().map(|(_, count)| count).collect();
    let ramp = conventional.ramp as usize;
    let (matrix, mut vector) = (
        rodrigues(circle.axis, 0.001),
        sub(circle.start, circle.centre),
    );
    let (_, arc) = rotation(&matrix, &mut vector, circle.centre);
    let (_, quartic) = blend(&blend_terms([0.0; 3], [1.0; 3], [2.0; 3]), 0.25);
    let none = Operations::default();
    let rows = [
        ("conventional", "accelerating", samples[1]),
        ("conventional", "at constant speed", samples[ramp + 1]),
        ("conventional", "decelerating", samples[samples.len() - 2]),
        ("this text", "blend, [5] as it is written", quartic),
        (
            "this text",
            "blend, by the difference engine",
            difference_engines().unwrap(),
        ),
        ("this text", "blend, by products at h", products().unwrap()),
        ("this text", "arc", arc),
    ];
    let mut text = String::from(
        "| method | sample | multiplications | additions | sines and cosines |\n|---|---|---|---|---|\n",
    );
    for (method, sample, count) in rows {
        assert_ne!(count, none, "{method}, {sample}");
        let Operations {
            multiplications,
            additions,
            trigonometric,
        } = count;
        let _ = writeln!(
            text,
            "| {method} | {sample} | {multiplications} | {additions} | {trigonometric} |"
        );
    }
    text
}
