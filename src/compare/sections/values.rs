//! Check of a section of values: two times, the writer's memory, the first values, the changes and
//! their positions, and last the times.

use super::Geometry;
use super::packed::{FAST_LZ, lz4_length, number, signed, varint, zlib};

/// Kind of section whose position list has signed numbers.
const SIGNED_PLACES: u8 = 8;
/// Length of a signal in bits that the reader may allocate without harm.
const SMALL: u64 = 1 << 20;

/// Returns `None` if a section claims too much.
pub fn fit(kind: u8, bytes: &[u8], geometry: &Geometry) -> Option<()> {
    let within = |value: u64, most: u64| (value <= most).then_some(());
    let handles = geometry.lengths.len() as u64;
    // From the end: the time table.
    let times = bytes.len().checked_sub(24)?;
    let start = usize_of(times, number(bytes, times + 8)?)?;
    let unpacked = zlib(bytes.get(start..times)?, number(bytes, times)?)?;
    within(number(bytes, times + 16)?, unpacked.len() as u64)?;
    // Before it: the length of the position list that precedes it.
    let places_end = start.checked_sub(8)?;
    let places_start = usize_of(places_end, number(bytes, places_end)?)?;
    let places = bytes.get(places_start..places_end)?;
    // From the start: the first values.
    let (unpacked, rest) = varint(bytes.get(24..places_start)?)?;
    let (packed, rest) = varint(rest)?;
    let (count, rest) = varint(rest)?;
    within(count, handles)?;
    let packed = usize::try_from(packed).ok()?;
    let frame = zlib(rest.get(..packed)?, unpacked)?.len() as u64;
    let longest = geometry.lengths.iter().copied().max().unwrap_or(0);
    within(longest.into(), frame.max(SMALL))?;
    let (count, changes) = varint(rest.get(packed..)?)?;
    within(count, handles)?;
    chains(kind, changes, places, count)
}

/// Returns the position of bytes with this length that end at `end`.
fn usize_of(end: usize, length: u64) -> Option<usize> {
    end.checked_sub(usize::try_from(length).ok()?)
}

/// Checks the changes of each signal, which follow the letter of their packing.
fn chains(kind: u8, changes: &[u8], mut places: &[u8], handles: u64) -> Option<()> {
    let (mut signals, mut begin) = (0u64, None::<usize>);
    while !places.is_empty() {
        let place;
        (place, places) = match kind {
            SIGNED_PLACES => Place::signed(places)?,
            _ => Place::unsigned(places)?,
        };
        match place {
            Place::Without(some) => signals = signals.checked_add(some)?,
            Place::Alias => signals += 1,
            Place::After(bytes) => {
                signals += 1;
                let next = begin
                    .unwrap_or(0)
                    .checked_add(usize::try_from(bytes).ok()?)?;
                if let Some(begin) = begin {
                    chain(changes, begin, next)?;
                }
                begin = Some(next);
            }
        }
    }
    if let Some(begin) = begin {
        chain(changes, begin, changes.len())?;
    }
    (signals <= handles).then_some(())
}

/// Entry of the position list, for one or more signals.
enum Place {
    /// Number of signals without a change.
    Without(u64),
    /// Signal with the changes of another.
    Alias,
    /// Signal whose changes begin this number of bytes after the ones before.
    After(u64),
}

impl Place {
    fn signed(bytes: &[u8]) -> Option<(Self, &[u8])> {
        if bytes.first()? & 1 == 0 {
            let (some, rest) = varint(bytes)?;
            return Some((Place::Without(some >> 1), rest));
        }
        let (value, rest) = signed(bytes)?;
        let place = match u64::try_from(value >> 1) {
            Ok(after @ 1..) => Place::After(after),
            _ => Place::Alias,
        };
        Some((place, rest))
    }

    fn unsigned(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (value, rest) = varint(bytes)?;
        match value {
            0 => Some((Place::Alias, varint(rest)?.1)),
            _ if value & 1 == 1 => Some((Place::After(value >> 1), rest)),
            _ => Some((Place::Without(value >> 1), rest)),
        }
    }
}

/// Checks the changes of a signal: their unpacked length, 0 if they are not packed, and their
/// bytes.
fn chain(changes: &[u8], begin: usize, end: usize) -> Option<()> {
    let (unpacked, packed) = varint(changes.get(begin..end)?)?;
    let most = match changes.first()? {
        _ if unpacked == 0 => 0,
        b'4' => lz4_length(packed)?,
        b'F' => (packed.len() as u64).checked_mul(FAST_LZ)?,
        // The reader allocates as it goes.
        _ => unpacked,
    };
    (unpacked <= most).then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_holds_what_it_claims() {
        let bytes = vec![7; 300];
        let packed = lz4_flex::block::compress(&bytes);
        let holds = |claim: &[u8], places: &[u8], handles| {
            let changes = [b"4", claim, &packed].concat();
            chains(8, &changes, places, handles).is_some()
        };
        // After the letter; one signal without a change before it.
        let places = [1 << 1, 1 << 1 | 1];
        assert!(holds(&[0xac, 0x02], &places, 2));
        assert!(!holds(&[0xad, 0x02], &places, 2));
        assert!(!holds(&[0xff, 0xff, 0xff, 0xff, 0x0f], &places, 2));
        assert!(
            !holds(&[0xac, 0x02], &places, 1),
            "more signals than handles"
        );
        assert!(
            !holds(&[0xac, 0x02], &[200 << 1 & 0x7f | 1], 2),
            "behind the end"
        );
        // Alias and many signals without a change, in both kinds of list.
        assert!(holds(&[0xac, 0x02], &[3, 0x7f], 2));
        assert!(chains(5, &[b'4', 0, 1], &[3, 0, 1], 2).is_some());
        assert!(chains(5, &[b'4', 0, 1], &[3, 0, 1], 1).is_none());
        assert!(chains(5, &[b'4', 0, 1], &[3, 0xfe, 0xff, 0xff, 0xff, 0x0f], 9).is_none());
    }
}
