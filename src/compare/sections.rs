//! An FST is looked through before it is read: the reader makes room for whatever number of bytes
//! or items the file claims to have, and where there is no such room the program ends.

use super::gap::Gap;
use crate::input::Fault;

/// The most that deflate can make of a byte.
const DEFLATE: u64 = 1032;
/// The most that LZ4 can make of a byte.
const LZ4: u64 = 255;

const HEADER: u8 = 0;
/// With the eight bytes of the length itself.
const HEADER_LENGTH: u64 = 329;
const BLACKOUT: u8 = 2;
const GEOMETRY: u8 = 3;

struct Section<'a> {
    kind: u8,
    bytes: &'a [u8],
}

/// Whether it begins as an FST does: with a header, which has always the same length.
///
/// The reader looks for this too, but goes on for ever behind lengths that overflow.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.first() == Some(&HEADER) && number(bytes, 1) == Some(HEADER_LENGTH)
}

/// Refuses sections that claim more than they can hold. Gives the times in which the dump was
/// switched off.
pub(super) fn check(file: &str, bytes: &[u8]) -> Result<Vec<Gap>, Fault> {
    let gaps = sections(bytes).and_then(|sections| {
        let complete = sections.iter().any(|section| section.kind == GEOMETRY);
        let handles = sections.iter().filter(|section| section.kind == GEOMETRY);
        let handles = handles.filter_map(|section| number(section.bytes, 8)).max();
        let fits = |section: &Section<'_>| fits(section, handles.unwrap_or(0)).is_some();
        let mut gaps = Vec::new();
        for section in sections.iter().filter(|section| section.kind == BLACKOUT) {
            blackouts(section.bytes, &mut gaps)?;
        }
        (complete && sections.iter().all(fits)).then_some(gaps)
    });
    gaps.ok_or_else(|| {
        let allowed = "a complete FST, from a simulator that has ended";
        Fault::new(file, 0, "file", "its sections do not fit together", allowed)
    })
}

/// How many, then for each whether the dump is on from there, and the time since the one before.
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

/// The eight bytes at this place as a number.
fn number(bytes: &[u8], place: usize) -> Option<u64> {
    let end = place.checked_add(8)?;
    Some(u64::from_be_bytes(bytes.get(place..end)?.try_into().ok()?))
}

/// A number of seven bits a byte, the lowest first; behind it what follows.
fn varint(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let mut value = 0;
    for (place, byte) in bytes.iter().take(9).enumerate() {
        value |= u64::from(byte & 0x7f) << (7 * place);
        if byte & 0x80 == 0 {
            return Some((value, &bytes[place + 1..]));
        }
    }
    None
}

/// The sections without kind and length, to the end of the file.
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

/// Nothing where the section claims too much.
fn fits(section: &Section<'_>, handles: u64) -> Option<()> {
    let bytes = section.bytes;
    let room = (bytes.len() as u64).checked_mul(DEFLATE)?;
    let within = |value: u64, most: u64| (value <= most).then_some(());
    match section.kind {
        HEADER => within(320, bytes.len() as u64),
        // Values: two times, memory, the first values, the changes and their places, and last the
        // times.
        1 | 5 | 8 => {
            let times = bytes.len().checked_sub(24)?;
            let uncompressed = number(bytes, times)?;
            within(uncompressed, room)?;
            let compressed = number(bytes, times + 8)?;
            within(compressed, times as u64)?;
            // Before the times stands how long the list of places before it is.
            let places = (times as u64).checked_sub(compressed.checked_add(8)?)?;
            within(number(bytes, usize::try_from(places).ok()?)?, places)?;
            within(number(bytes, times + 16)?, uncompressed)?;
            let (uncompressed, rest) = varint(bytes.get(24..)?)?;
            within(uncompressed, room)?;
            let (compressed, rest) = varint(rest)?;
            within(compressed, rest.len() as u64)?;
            let (count, rest) = varint(rest)?;
            within(count, handles)?;
            let (count, _) = varint(rest.get(usize::try_from(compressed).ok()?..)?)?;
            within(count, handles)
        }
        GEOMETRY => {
            let uncompressed = number(bytes, 0)?;
            within(uncompressed, room)?;
            within(number(bytes, 8)?, uncompressed)
        }
        // The hierarchy: by deflate, by LZ4, by LZ4 twice with the length in between.
        4 => within(number(bytes, 0)?, room),
        6 => within(number(bytes, 0)?, (bytes.len() as u64).checked_mul(LZ4)?),
        7 => {
            let (once, rest) = varint(bytes.get(8..)?)?;
            within(once, (rest.len() as u64).checked_mul(LZ4)?)?;
            within(number(bytes, 0)?, once.checked_mul(LZ4)?)
        }
        _ => Some(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a hierarchy of this kind holds what it claims, if `rest` is behind the claim.
    fn holds(kind: u8, claim: u64, rest: &[u8]) -> bool {
        let bytes = [&claim.to_be_bytes(), rest].concat();
        let section = Section {
            kind,
            bytes: &bytes,
        };
        fits(&section, 0).is_some()
    }

    #[test]
    fn a_hierarchy_holds_what_its_compression_can_make_of_it() {
        let rest = [0; 92];
        for (kind, most) in [(4, 100 * 1032), (6, 100 * 255)] {
            assert!(holds(kind, most, &rest), "{kind}");
            assert!(!holds(kind, most + 1, &rest), "{kind}");
        }
        // 300 bytes after the first step, of which there are two here.
        let twice = [0xac, 0x02, 0, 0];
        assert!(holds(7, 300 * 255, &twice));
        assert!(!holds(7, 300 * 255 + 1, &twice));
        // More after the first step than two bytes can be.
        let [low, high] = [0xff, 0x03];
        assert!(!holds(7, 1, &[low, high, 0, 0]));
        for kind in [4, 6, 7] {
            assert!(!holds(kind, u64::MAX, &rest), "{kind}");
        }
    }
}
