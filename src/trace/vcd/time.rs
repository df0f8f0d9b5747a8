//! Times as text.

/// Number of digits that are incremented; the ones before them are text.
const DIGITS: usize = 8;
/// First number beyond these digits.
const END: u64 = 100_000_000;
/// Space for the text before them: `#` and the twelve other digits that a time can have.
const HEAD: usize = 16;
/// Greatest length of the text after a time.
const THEN: usize = 16;
/// Space for a time with the text after it.
pub const ROOM: usize = HEAD + DIGITS + THEN;

/// Times of a dump, incremented in decimal: the step is usually that of the time before.
#[derive(Debug, Default)]
pub struct Times {
    last: u64,
    /// Expected difference to the next time.
    step: u64,
    /// First time that has more digits, or other digits before the incremented ones; at first
    /// every time.
    end: u64,
    /// Last digits of the time, one per byte, the first in the highest.
    low: u64,
    /// Digits of the step, each biased so that it carries into the next byte after nine.
    plus: u64,
    /// Text before the incremented digits, padded with zeros.
    head: [u8; HEAD],
    head_len: usize,
    /// Number of bits of the leading zeros of a time with less than eight digits.
    zeros: u32,
}

impl Times {
    /// Writes a time, with the text that follows on and after its line; returns the length.
    #[inline(always)]
    pub fn put<const N: usize>(
        &mut self,
        line: &mut [u8; ROOM],
        time: u64,
        then: &[u8; N],
    ) -> usize {
        const { assert!(N <= THEN) }
        if time.wrapping_sub(self.last) == self.step && time < self.end {
            self.last = time;
            // A byte that carries holds its digit; one that does not holds six more, below an F.
            let sum = self.low.wrapping_add(self.plus);
            self.low = (sum & 0x0f0f_0f0f_0f0f_0f0f) - (sum >> 4 & 0x0606_0606_0606_0606);
        } else {
            self.anew(time);
        }
        let digits = (self.low | 0x3030_3030_3030_3030) << self.zeros;
        let len = self.head_len % HEAD;
        line[..HEAD].copy_from_slice(&self.head);
        line[len..][..DIGITS].copy_from_slice(&digits.to_be_bytes());
        let end = len + DIGITS - self.zeros as usize / 8;
        line[end..][..N].copy_from_slice(then);
        end + N
    }

    /// Sets a time with another step, or with other digits before the incremented ones.
    #[cold]
    #[inline(never)]
    fn anew(&mut self, time: u64) {
        let step = time.wrapping_sub(self.last);
        // A longer step comes here every time.
        self.step = if step < END { step } else { 0 };
        self.plus = digits(self.step) + 0xf6f6_f6f6_f6f6_f6f6;
        self.last = time;
        self.low = digits(time % END);
        let shown = (time.max(1).ilog10() + 1).min(DIGITS as u32);
        self.zeros = 8 * (DIGITS as u32 - shown);
        self.end = match time {
            0..END => 10u64.pow(shown),
            _ => (time - time % END).saturating_add(END),
        };
        let head = match time / END {
            0 => "#".to_owned(),
            high => format!("#{high}"),
        };
        self.head_len = head.len();
        self.head[..head.len()].copy_from_slice(head.as_bytes());
    }
}

/// Returns the eight digits of a number below 10^8, the first in the highest byte.
fn digits(number: u64) -> u64 {
    (0..DIGITS as u32).fold(0, |digits, place| {
        digits | (number / 10u64.pow(place) % 10) << (8 * place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(times: &mut Times, time: u64) -> String {
        let mut line = [0; ROOM];
        let len = times.put(&mut line, time, b"\n1!\n");
        String::from_utf8(line[..len].to_vec()).unwrap()
    }

    #[test]
    fn of_every_length_in_any_order() {
        let mut times = Times::default();
        let powers = (0..20).map(|power| 10u64.pow(power));
        let around = powers.flat_map(|power| [power - 1, power, power + 1, power / 8 * 9]);
        for time in around.chain([0, 9_999, 99_990_000, u64::MAX, u64::MAX, 7]) {
            assert_eq!(text(&mut times, time), format!("#{time}\n1!\n"));
        }
    }

    #[test]
    fn over_every_carry_in_steps_of_every_length() {
        for step in (0..11).flat_map(|power| [1, 5, 9].map(|digit| digit * 10u64.pow(power))) {
            for from in [0, END - 40 * step.min(END / 40), 9_999_999_900 * END] {
                let mut times = Times::default();
                for time in (0..100).map(|count| from + count * step) {
                    assert_eq!(text(&mut times, time), format!("#{time}\n1!\n"));
                }
            }
        }
        let mut times = Times::default();
        for time in 99_900_000..100_100_000 {
            assert_eq!(text(&mut times, time), format!("#{time}\n1!\n"));
        }
    }
}
