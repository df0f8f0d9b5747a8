//! Contents of memories in text: as a list of words in configurations of circuits, by widths in
//! `Debug`.

use super::memory::Image;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// The widths without the words, which may be many.
impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Image")
            .field("address", &self.address())
            .field("width", &self.width())
            .finish_non_exhaustive()
    }
}

/// The words from address 0 up, without the zeros at the end.
impl Serialize for Image {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.written().serialize(to)
    }
}

/// An image just large enough for a list of words; circuits [resize](Image::resized) it.
impl<'de> Deserialize<'de> for Image {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let words: Vec<u64> = Vec::deserialize(from)?;
        let bits = |number: u64| (u64::BITS - number.leading_zeros()) as usize;
        let address = words.len().saturating_sub(1) as u64;
        let widest = words.iter().copied().max().unwrap_or(0);
        Ok(Image::of(bits(address), bits(widest).max(1), words))
    }
}
