//! Check of an FST before it is read: the reader allocates any number of bytes or items that the
//! file claims to have, and the program ends if that fails.

mod packed;
mod values;

use super::gap::Gap;
use super::wave::LARGEST;
use crate::input::Fault;
use packed::{DEFLATE, lz4_length, number, varint, zlib};

const HEADER: u8 = 0;
/// Includes the eight bytes of the length itself.
const HEADER_LENGTH: u64 = 329;
const BLACKOUT: u8 = 2;
const GEOMETRY: u8 = 3;
/// Whole file packed by gzip.
const WRAPPER: u8 = 254;
/// Header of a gzip stream without a name and without a comment.
const GZIP: [u8; 4] = [0x1f, 0x8b, 8, 0];
const GZIP_HEADER: usize = 10;

struct Section<'a> {
    kind: u8,
    bytes: &'a [u8],
}

/// Widths of the signals according to the file, by handle.
struct Geometry {
    /// Length per signal; 0 if its values carry a length.
    lengths: Vec<u32>,
}

/// True if a file begins as an FST does: with a header, which always has the same length.
///
/// The reader checks this too, but loops forever after lengths that overflow.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.first() == Some(&HEADER) && number(bytes, 1) == Some(HEADER_LENGTH)
}

/// Unpacks an FST that is packed as a whole, as GHDL, NVC and `vvp -fst-space` write it; returns
/// `None` if the file is not packed.
pub(super) fn unwrap(file: &str, bytes: &[u8]) -> Result<Option<Vec<u8>>, Fault> {
    if bytes.first() != Some(&WRAPPER) {
        return Ok(None);
    }
    let fault = |problem: &str| {
        let allowed = "a complete FST of at most 1073741824 bytes, from a simulator that has ended";
        Fault::new(file, 0, "file", problem, allowed)
    };
    let (Some(length), Some(claimed)) = (number(bytes, 1), number(bytes, 9)) else {
        return Err(fault("is cut off"));
    };
    if length == 0 {
        return Err(fault("is not packed to its end"));
    }
    let packed = bytes.get(17..).filter(|packed| packed.starts_with(&GZIP));
    let packed = packed.and_then(|packed| packed.get(GZIP_HEADER..));
    let packed = packed.ok_or_else(|| fault("is packed by something else than gzip"))?;
    if claimed > LARGEST.min((packed.len() as u64).saturating_mul(DEFLATE)) {
        return Err(fault("unpacks to more than there can be"));
    }
    let limit = usize::try_from(claimed).unwrap_or(usize::MAX);
    let unpacked = miniz_oxide::inflate::decompress_to_vec_with_limit(packed, limit);
    match unpacked {
        Ok(unpacked) if unpacked.len() == limit && begins(&unpacked) => Ok(Some(unpacked)),
        _ => Err(fault(
            "does not unpack to an FST of the length that it tells",
        )),
    }
}

/// Returns an error for sections that claim more than they contain; else the gaps in which the
/// dump was switched off.
pub(super) fn check(file: &str, bytes: &[u8]) -> Result<Vec<Gap>, Fault> {
    checked(bytes).ok_or_else(|| {
        let allowed = "a complete FST, from a simulator that has ended";
        Fault::new(file, 0, "file", "its sections do not fit together", allowed)
    })
}

fn checked(bytes: &[u8]) -> Option<Vec<Gap>> {
    let sections = sections(bytes)?;
    let mut gaps = Vec::new();
    let mut geometry = None;
    for section in &sections {
        match section.kind {
            BLACKOUT => blackouts(section.bytes, &mut gaps)?,
            // The reader uses the last one.
            GEOMETRY => geometry = Some(Geometry::read(section.bytes)?),
            _ => {}
        }
    }
    let geometry = geometry?;
    for section in &sections {
        fits(section, &geometry)?;
    }
    Some(gaps)
}

/// Reads the gaps: their number, then for each whether the dump is on from there, and the time
/// since the one before.
fn blackouts(bytes: &[u8], gaps: &mut Vec<Gap>) -> Option<()> {
    let (count, mut rest) = varint(bytes)?;
    let mut time = 0u64;
    for _ in 0..count {
        let (&on, after) = rest.split_first()?;
        let (delta, after) = varint(after)?;
        time = time.checked_add(delta)?;
        Gap::switch(gaps, time, on != 0);
        rest = after;
    }
    Some(())
}

/// Returns the sections without kind and length, to the end of the file.
fn sections(mut rest: &[u8]) -> Option<Vec<Section<'_>>> {
    let mut sections = Vec::new();
    while let Some((&kind, after)) = rest.split_first() {
        let length = usize::try_from(number(after, 0)?).ok()?;
        let bytes = after.get(8..length)?;
        sections.push(Section { kind, bytes });
        rest = &after[length..];
    }
    Some(sections)
}

/// Returns `None` if a section claims too much.
fn fits(section: &Section<'_>, geometry: &Geometry) -> Option<()> {
    let bytes = section.bytes;
    let within = |value: u64, most: u64| (value <= most).then_some(());
    match section.kind {
        HEADER => within(320, bytes.len() as u64),
        1 | 5 | 8 => values::fit(section.kind, bytes, geometry),
        // Hierarchy: by deflate, by LZ4, by LZ4 twice with the length in between.
        4 => within(
            number(bytes, 0)?,
            (bytes.len() as u64).checked_mul(DEFLATE)?,
        ),
        6 => within(number(bytes, 0)?, lz4_length(bytes.get(8..)?)?),
        7 => {
            let (once, rest) = varint(bytes.get(8..)?)?;
            within(once, lz4_length(rest)?)?;
            let once = lz4_flex::block::decompress(rest, usize::try_from(once).ok()?).ok()?;
            within(number(bytes, 0)?, lz4_length(&once)?)
        }
        _ => Some(()),
    }
}

impl Geometry {
    /// Reads the unpacked size, the number of signals, and the length of each.
    fn read(bytes: &[u8]) -> Option<Self> {
        let unpacked = zlib(bytes.get(16..)?, number(bytes, 0)?)?;
        let count = number(bytes, 8)?;
        let mut rest = &unpacked[..];
        let mut lengths = Vec::new();
        for _ in 0..count {
            let (length, after) = varint(rest)?;
            rest = after;
            lengths.push(match u32::try_from(length).ok()? {
                // Real number.
                0 => 8,
                u32::MAX => 0,
                length => length,
            });
        }
        Some(Geometry { lengths })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// True if a hierarchy of this kind holds the claimed size; `rest` follows the claim.
    fn holds(kind: u8, claim: u64, rest: &[u8]) -> bool {
        let bytes = [&claim.to_be_bytes(), rest].concat();
        let section = Section {
            kind,
            bytes: &bytes,
        };
        let lengths = Vec::new();
        fits(&section, &Geometry { lengths }).is_some()
    }

    #[test]
    fn a_hierarchy_holds_what_its_compression_makes_of_it() {
        let rest = [0; 92];
        assert!(holds(4, 100 * DEFLATE, &rest));
        assert!(!holds(4, 100 * DEFLATE + 1, &rest));
        let text = b"counter counter counter counter counter counter counter ".repeat(9);
        let once = lz4_flex::block::compress(&text);
        let length = text.len() as u64;
        assert!(holds(6, length, &once));
        assert!(!holds(6, length + 1, &once));
        let twice = lz4_flex::block::compress(&once);
        let twice = [&[once.len() as u8][..], &twice].concat();
        assert!(once.len() < 128 && holds(7, length, &twice));
        assert!(!holds(7, length + 1, &twice));
        for kind in [4, 6, 7] {
            assert!(!holds(kind, u64::MAX, &rest), "{kind}");
        }
    }

    #[test]
    fn a_geometry_has_a_length_for_each_signal() {
        let read = |claim: u64, count: u64, rest: &[u8]| {
            let bytes = [&claim.to_be_bytes()[..], &count.to_be_bytes(), rest].concat();
            Geometry::read(&bytes).map(|geometry| geometry.lengths)
        };
        let lengths = [1, 0, 0xff, 0xff, 0xff, 0xff, 0x0f, 0xac, 0x02];
        assert_eq!(read(9, 4, &lengths), Some(vec![1, 8, 0, 300]));
        assert_eq!(read(9, 5, &lengths), None);
        let packed = miniz_oxide::deflate::compress_to_vec_zlib(&[1; 100], 1);
        assert_eq!(read(100, 100, &packed), Some(vec![1; 100]));
        for claim in [99, 101, 1 << 40] {
            assert_eq!(read(claim, 90, &packed), None);
        }
    }
}
