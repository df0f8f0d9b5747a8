//! Numbers in an FST, and sizes of unpacked data.

/// Greatest expansion of a byte by deflate.
pub const DEFLATE: u64 = 1032;
/// Greatest expansion of a byte by FastLZ.
pub const FAST_LZ: u64 = 256;

/// Returns the eight bytes at this position as a number.
pub fn number(bytes: &[u8], place: usize) -> Option<u64> {
    let end = place.checked_add(8)?;
    Some(u64::from_be_bytes(bytes.get(place..end)?.try_into().ok()?))
}

/// Reads a number of seven bits per byte, the lowest first; also returns the bytes after it.
pub fn varint(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let mut value = 0;
    for (place, byte) in bytes.iter().take(9).enumerate() {
        value |= u64::from(byte & 0x7f) << (7 * place);
        if byte & 0x80 == 0 {
            return Some((value, &bytes[place + 1..]));
        }
    }
    None
}

/// Reads a number of seven bits per byte whose highest bit is the sign; also returns the bytes
/// after it.
pub fn signed(bytes: &[u8]) -> Option<(i64, &[u8])> {
    let (value, rest) = varint(bytes)?;
    let unused = 64 - 7 * (bytes.len() - rest.len()) as u32;
    Some(((value << unused) as i64 >> unused, rest))
}

/// Unpacks bytes that are packed by zlib unless that would make them longer; returns `None` unless
/// they unpack to the claimed length.
pub fn zlib(bytes: &[u8], claimed: u64) -> Option<Vec<u8>> {
    if claimed == bytes.len() as u64 {
        return Some(bytes.to_vec());
    }
    let claimed = usize::try_from(claimed).ok()?;
    let unpacked = miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(bytes, claimed).ok()?;
    (unpacked.len() == claimed).then_some(unpacked)
}

/// Returns the unpacked length of an LZ4 block.
pub fn lz4_length(mut rest: &[u8]) -> Option<u64> {
    /// Reads a length of four bits, continued in the following bytes if all are set.
    fn length(bits: u8, mut rest: &[u8]) -> Option<(u64, &[u8])> {
        let mut length = u64::from(bits);
        let mut more = bits == 15;
        while more {
            let (&byte, after) = rest.split_first()?;
            length += u64::from(byte);
            rest = after;
            more = byte == 255;
        }
        Some((length, rest))
    }

    let mut unpacked = 0;
    loop {
        let (&token, after) = rest.split_first()?;
        let (literals, after) = length(token >> 4, after)?;
        unpacked += literals;
        rest = after.get(usize::try_from(literals).ok()?..)?;
        if rest.is_empty() {
            return Some(unpacked);
        }
        let (copied, after) = length(token & 15, rest.get(2..)?)?;
        unpacked += copied + 4;
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_of_a_block_is_what_it_unpacks_to() {
        for length in [0usize, 1, 14, 15, 16, 269, 270, 271, 1000, 70_000] {
            let still = vec![b'0'; length];
            let moving: Vec<u8> = (0..length).map(|at| (at * at / 7) as u8).collect();
            for bytes in [still, moving] {
                let packed = lz4_flex::block::compress(&bytes);
                assert_eq!(lz4_length(&packed), Some(length as u64), "{length}");
            }
        }
        assert_eq!(lz4_length(&[]), None);
        assert_eq!(lz4_length(&[0xf0]), None);
    }

    #[test]
    fn numbers_have_a_sign_where_they_are_signed() {
        for (bytes, value) in [
            (&[0x13][..], 19),
            (&[0x7b], -5),
            (&[0xac, 0x02], 300),
            (&[0x80, 0x7f], -128),
        ] {
            assert_eq!(signed(bytes), Some((value, &[][..])));
        }
        assert_eq!(varint(&[0xff, 0x01, 7]), Some((255, &[7][..])));
        assert_eq!(varint(&[0xff; 12]), None);
    }
}
