use super::UnknownSignal;
use crate::engine::EngineError;
use crate::hdl::{
    Circuit, Value,
    pack::{bits_of, input_widths, inputs},
};

/// Number of bits that is too large to enumerate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{what} have {bits} bits, at most {most} can be enumerated")]
pub struct TooWide {
    /// Name of the quantity.
    pub what: &'static str,
    /// Width in bits.
    pub bits: usize,
    /// Greatest allowed width in bits.
    pub most: usize,
}

/// Reason why a circuit cannot be checked.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// Too many bits to enumerate.
    #[error(transparent)]
    TooWide(#[from] TooWide),
    /// Invariants name signals that the circuit does not have.
    #[error("{}", lines(.0))]
    Signals(Vec<UnknownSignal>),
    /// The assumptions allow no input at power-on, so there is nothing to search.
    #[error(
        "{circuit}: no input keeps all assumptions at power-on; correct the statements that `given` and `narrowing` make, `applies`, and what `inputs` and `assume` exclude"
    )]
    NoInput {
        /// Name of the circuit.
        circuit: String,
    },
    /// The circuit cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

crate::netlist::debug_as_display!(CheckError);

/// Returns all errors, one per line.
pub(super) fn lines(errors: &[UnknownSignal]) -> String {
    let lines: Vec<_> = errors.iter().map(UnknownSignal::to_string).collect();
    lines.join("\n")
}

impl TooWide {
    /// Returns an error if there are more than `most` bits.
    pub(crate) fn check_bits(what: &'static str, bits: usize, most: usize) -> Result<(), Self> {
        match bits > most {
            true => Err(TooWide { what, bits, most }),
            false => Ok(()),
        }
    }
}

/// Returns all inputs of a circuit, in the order of their packed bits.
///
/// # Errors
/// Returns an error if they have more than 63 bits; an enumeration would not end anyway.
pub fn all<C: Circuit>(circuit: &C) -> Result<impl Iterator<Item = C::In<Value>>, TooWide> {
    let bits = input_widths(circuit).iter().sum();
    TooWide::check_bits("the signals", bits, 63)?;
    Ok((0..1u64 << bits).map(|word| inputs(circuit, bits_of(word))))
}

/// Stream of random words that depends on the seed only, not on the machine (SplitMix64).
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// Creates the stream of a seed.
    pub const fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// Returns the next 64 random bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        scramble(self.0)
    }

    /// Returns random inputs of a circuit.
    pub fn inputs<C: Circuit>(&mut self, circuit: &C) -> C::In<Value> {
        inputs(circuit, |_| self.word())
    }
}

/// Spreads every bit of a word over the whole word; a bijection.
#[inline]
pub(crate) const fn scramble(word: u64) -> u64 {
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stream_is_splitmix() {
        // First words of the reference implementation for seed 1234567.
        let mut random = Random::new(1_234_567);
        let words = [random.word(), random.word(), random.word()];
        assert_eq!(
            words,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423
            ]
        );
    }
}
