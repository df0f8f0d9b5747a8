/// Mapping of a range of data to a range of pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    pub(super) least: f64,
    pub(super) most: f64,
    start: f64,
    /// Pixels per unit of data; negative if data grows against the pixels.
    factor: f64,
}

impl Scale {
    /// Maps `least..most` to `length` pixels from `start` on; a negative length points upwards.
    pub(super) fn new(least: f64, most: f64, start: f64, length: f64) -> Self {
        Scale {
            least,
            most,
            start,
            factor: length / (most - least),
        }
    }

    pub(super) fn pixel(&self, value: f64) -> f64 {
        self.start + (value - self.least) * self.factor
    }

    /// Returns round numbers in the range with their labels: 1, 2 or 5 times a power of ten apart,
    /// about `count` of them; none if the range is too small or too large for such numbers.
    pub(super) fn ticks(&self, count: f64) -> Vec<(f64, String)> {
        let raw = (self.most - self.least) / count;
        let decade = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * decade)
            .into_iter()
            .find(|step| *step >= raw)
            .unwrap_or(raw);
        if !(step.is_normal() && step > 0.0) {
            return Vec::new();
        }
        let first = (self.least / step).ceil() as i64;
        let last = (self.most / step).floor() as i64;
        let tick = |k: i64| {
            let value = k as f64 * step;
            (value, label(value, step))
        };
        (first..=last).map(tick).collect()
    }
}

/// Formats a number with the digits needed for a tick of this step.
fn label(value: f64, step: f64) -> String {
    let decimals = (-step.log10().floor()).max(6.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

/// Returns the range of some numbers, widened if it is empty, with a margin at both ends.
pub(super) fn range(values: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (least, most) = values.filter(|value| value.is_finite()).fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), value| (least.min(value), most.max(value)),
    );
    if least > most {
        return (0.0, 1.0);
    }
    if least == most {
        let half = least.abs().max(1.0) / 2.0;
        return (least - half, most + half);
    }
    let span = most - least;
    (least - margin * span, most + margin * span)
}

#[cfg(test)]
mod tests {
    use super::{Scale, label, range};

    fn ticks(least: f64, most: f64, count: f64) -> (Vec<f64>, Vec<String>) {
        Scale::new(least, most, 0.0, 10.0)
            .ticks(count)
            .into_iter()
            .unzip()
    }

    fn ticks_of(least: f64, most: f64, count: f64) -> Vec<f64> {
        ticks(least, most, count).0
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let (ticks, labels) = ticks(-0.3, 1.1, 7.0);
        assert_eq!(ticks, [-0.2, 0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(labels, ["-0.2", "0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(ticks_of(0.0, 99.0, 5.0), [0.0, 20.0, 40.0, 60.0, 80.0]);
    }

    #[test]
    fn small_ticks_are_told_apart() {
        let (_, labels) = ticks(0.0, 1e-6, 5.0);
        let expected = ["0", "0.0000002", "0.0000004", "0.0000006", "0.0000008"];
        assert_eq!(labels[..5], expected);
        let (_, labels) = ticks(-2e-9, 2e-9, 4.0);
        let expected = ["-0.000000002", "-0.000000001", "0"];
        assert_eq!(labels[..3], expected);
    }

    #[test]
    fn a_range_without_round_numbers_has_no_ticks() {
        let smallest = f64::from_bits(1);
        assert_eq!(ticks_of(0.0, smallest, 10.0), [0.0; 0]);
        assert_eq!(ticks_of(1e-310, 2e-310, 5.0), [0.0; 0]);
        assert_eq!(ticks_of(-f64::MAX, f64::MAX, 5.0), [0.0; 0]);
    }

    #[test]
    fn labels_are_short() {
        assert_eq!(
            [0.2, -0.0, 250.0, 0.000001].map(|value| label(value, 1.0)),
            ["0.2", "0", "250", "0.000001"]
        );
    }

    #[test]
    fn an_empty_range_is_widened() {
        assert_eq!(range([3.0, 3.0].into_iter(), 0.0), (1.5, 4.5));
        assert_eq!(range([0.0].into_iter(), 0.5), (-0.5, 0.5));
        assert_eq!(range([f64::NAN].into_iter(), 0.5), (0.0, 1.0));
        assert_eq!(range([0.0, 10.0].into_iter(), 0.1), (-1.0, 11.0));
    }

    #[test]
    fn pixels_are_linear() {
        let scale = Scale::new(-1.0, 1.0, 100.0, -50.0);
        assert_eq!(
            [-1.0, 0.0, 1.0].map(|v| scale.pixel(v)),
            [100.0, 75.0, 50.0]
        );
    }
}
