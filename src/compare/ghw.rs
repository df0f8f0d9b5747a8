//! Check of a GHW, the format of GHDL, before it is read: the reader allocates memory for any
//! number of strings, types and signals that the file claims to have.

use crate::input::Fault;

const HEADER: &[u8] = b"GHDLwave\n";
/// Position of the byte order, and its value for big endian.
const ORDER: (usize, u8) = (12, 2);
/// Sections, and the number of counts at the beginning of each.
const SECTIONS: [(&[u8; 8], usize); 3] = [
    (b"STR\0\0\0\0\0", 1),
    (b"TYP\0\0\0\0\0", 1),
    (b"HIE\0\0\0\0\0", 3),
];

/// True if a file begins as a GHW does.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(HEADER)
}

/// Returns an error for counts larger than the file: each item takes at least a byte.
pub(super) fn check(file: &str, bytes: &[u8]) -> Result<(), Fault> {
    let high_first = bytes.get(ORDER.0) == Some(&ORDER.1);
    let count = |bytes: &[u8]| -> Option<u64> {
        let bytes = <[u8; 4]>::try_from(bytes.get(..4)?).ok()?;
        let count = match high_first {
            true => u32::from_be_bytes(bytes),
            false => u32::from_le_bytes(bytes),
        };
        Some(count.into())
    };
    for (mark, counts) in SECTIONS {
        let found = bytes.windows(mark.len()).enumerate();
        for (place, _) in found.filter(|(_, window)| window == mark) {
            let behind = &bytes[place + mark.len()..];
            for number in behind.chunks(4).take(counts) {
                if count(number).is_none_or(|count| count > bytes.len() as u64) {
                    let name = String::from_utf8_lossy(&mark[..3]);
                    let problem = format!("its section {name} does not fit into it");
                    let allowed = "a complete GHW, from a simulator that has ended";
                    return Err(Fault::new(file, 0, "file", problem, allowed));
                }
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_held_against_the_size() {
        for order in [1, 2] {
            let file = |counts: [u32; 3]| {
                let header = [HEADER, &[16, 0, 1, order, 4, 1, 0], b"HIE\0\0\0\0\0"].concat();
                let counts = counts.map(|count| match order {
                    2 => count.to_be_bytes(),
                    _ => count.to_le_bytes(),
                });
                [&header[..], counts.as_flattened()].concat()
            };
            assert_eq!(file([0; 3]).len(), 36);
            assert!(begins(&file([0; 3])));
            assert!(check("x.ghw", &file([36; 3])).is_ok());
            for counts in [[37, 0, 0], [0, 37, 0], [0, 0, u32::MAX]] {
                assert!(check("x.ghw", &file(counts)).is_err());
            }
            assert!(check("x.ghw", &file([0; 3])[..34]).is_err());
        }
    }
}
