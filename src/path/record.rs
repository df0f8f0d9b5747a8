//! Format of records in the record memory: 32 words each.
//!
//! | word | blend, line | arc |
//! |---|---|---|
//! | 0 | bits 1..0 kind, bit 2 ends at rest, from bit 3 on samples | the same |
//! | 1 | modulus: M⁴ of a blend, N of a line | 1 |
//! | 2, 3, 4 | start point | the vector GP0 |
//! | 5, 6, 7 | 0 | centre G |
//! | 8c + 8 … | of coordinate c: integer and fractional part of the differences 1 to 4 | row c of
//! R, then 0 |
//!
//! Points are in guard units of 2^-G count, coefficients in units of 2^-B; a signed word is cut to
//! its bits. Differences are exact: integer part · modulus + fractional part. Blends and lines by
//! products have other words: [`products`](crate::jobs::arc_generator::products).

/// Number of words in a record.
pub const WORDS: usize = 32;

/// Number of words per coordinate, from its [`coordinate_word`] on.
const COORDINATE_WORDS: usize = 8;

/// Record of one segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Record {
    /// Words, each below 2^D.
    pub words: [u64; WORDS],
}

/// Returns the first word of a coordinate: of its differences or its matrix row.
#[must_use]
pub fn coordinate_word(coordinate: usize) -> usize {
    COORDINATE_WORDS * (coordinate + 1)
}
