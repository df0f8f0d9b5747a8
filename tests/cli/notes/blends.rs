//! Figures of blends by products: how far a point is off the quartic.

use motion_rtl::circuits::arc_generator::{Blend, Rounding, Widths};
use motion_rtl::jobs::arc_generator::bounds::product_error;
use motion_rtl::jobs::arc_generator::prepare::Timing;
use motion_rtl::jobs::arc_generator::prepared::{Prepared, Segment, Shape};
use motion_rtl::jobs::arc_generator::products;
use motion_rtl::jobs::arc_generator::record::records;
use motion_rtl::jobs::arc_generator::reference::{Decoded, Points};
use motion_rtl::jobs::arc_generator::settings::ShortPieces;
use std::fmt::Write as _;

/// A⁻, A, A⁺ in guard units: as far apart as words have it, or 3 mm at 1 µm.
fn corners(far: bool) -> [[i64; 3]; 3] {
    let most = (1i64 << 39) - (1 << 16);
    match far {
        true => [
            [-most, most, 5],
            [most, -most, most - 7],
            [-most, most / 3, -most],
        ],
        false => [
            [-100_000_003, 7_777_777, 5],
            [100_000_001, 6, -99_999_989],
            [3, 200_000_033, 100_000_007],
        ],
    }
}

/// Largest distance of a coordinate from the quartic, in guard units, by products and by differences
/// where these hold the blend.
fn observed(points: [[i64; 3]; 3], samples: u64, widths: &Widths) -> (f64, Option<f64>) {
    let unit = (-(widths.guard() as f64)).exp2();
    let [before, corner, behind] = points.map(|point| point.map(|units| units as f64 * unit));
    let segment = Segment {
        shape: Shape::Blend {
            before,
            corner,
            behind,
        },
        samples,
        first_sample: 0,
        piece: 0,
        next_piece: None,
        ends_at_rest: true,
    };
    let timing = Timing {
        sample_s: 0.001,
        blend_samples: samples,
        corner: 0.0,
        short_pieces: ShortPieces::Refuse,
        most_samples: widths.most_samples(),
    };
    let prepared = Prepared {
        segments: vec![segment],
        pieces: Vec::new(),
        timing,
    };
    let m = i128::from(samples);
    let power = m.pow(4);
    let off = |made: Points| {
        let made: Vec<_> = made.collect();
        assert_eq!(made.len() as u64, samples + 1);
        let errors = (0..).zip(made).flat_map(|(n, point)| {
            let n: i128 = n;
            (0..3).map(move |k| {
                let [a, b, c] = points.map(|point| i128::from(point[k]));
                let way = 2 * (b - a) * n * m.pow(3) + (a - 2 * b + c) * (2 * m - n) * n.pow(3);
                let error = (i128::from(point[k]) - a) * power - way;
                error.abs() as f64 / power as f64
            })
        });
        errors.fold(0.0, f64::max)
    };
    let rounding = Rounding::Nearest;
    let own = Blend::Products.widths(*widths);
    let made = products::records(&prepared, 1.0, &own, rounding).expect("it fits into the words");
    let by_products = off(products::points(&made[0], &own, rounding));
    let holds = samples <= Blend::Differences.most_samples(widths);
    let by_differences = holds.then(|| {
        let made = records(&prepared, 1.0, widths, rounding).expect("it fits into the words");
        off(Decoded::of(&made[0], widths).points(widths, rounding))
    });
    (by_products, by_differences)
}

/// A table of the bound and of what blends show.
pub fn errors() -> String {
    let mut text = String::from(
        "| B | points | M | bound | by products | by differences |\n|---|---|---|---|---|---|\n",
    );
    for (fraction, far, samples) in [
        (40, false, 20),
        (40, false, 1024),
        (40, false, 65_536),
        (40, false, (1 << 20) - 2),
        (40, true, 20),
        (40, true, 1024),
        (40, true, (1 << 20) - 2),
        (30, false, 20),
        (30, false, 1024),
        (30, true, 1024),
    ] {
        let widths = Widths {
            coefficient: fraction + 2,
            ..Widths::FULL
        };
        let bound = 0.5 + product_error(&widths) * (widths.guard() as f64).exp2();
        let (products, differences) = observed(corners(far), samples, &widths);
        assert!(products <= bound, "{samples}: {products} above {bound}");
        let differences = differences.map_or("–".to_owned(), |units| format!("{units:.3}"));
        let points = if far {
            "as far as words reach"
        } else {
            "3 mm apart at 1 µm"
        };
        let _ = writeln!(
            text,
            "| {fraction} | {points} | {samples} | {bound:.3} | {products:.3} | {differences} |"
        );
    }
    text
}
