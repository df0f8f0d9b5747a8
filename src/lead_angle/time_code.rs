//! Time codes: lead times Δt in CKs that can be set (13, Table 1), for the host side.
//!
//! ```text
//! N   codes                 at a CK of 0.1 ms
//! 1   1, 2, … 199           0.1 to 19.9 ms by 0.1 ms
//! 2   200, 202, … 398       20 to 39.8 ms by 0.2 ms
//! 5   400, 405, … 995       40 to 99.5 ms by 0.5 ms
//! 10  1000, 1010, … 1990    100 to 199 ms by 1 ms
//! ```
//!
//! Code 0 is no lead.

/// The largest time code.
pub const LARGEST_CODE: u16 = 1990;

/// N with the least and the largest code it serves.
const RANGES: [(u16, u16, u16); 4] = [
    (1, 1, 199),
    (2, 200, 398),
    (5, 400, 995),
    (10, 1000, LARGEST_CODE),
];

/// N of a time in CKs that can be set: 1, 2, 5 or 10, and 0 of no lead.
#[must_use]
pub fn ratio(code: u16) -> Option<u16> {
    let serves = |&(n, least, most): &(u16, u16, u16)| {
        (least..=most).contains(&code) && code.is_multiple_of(n)
    };
    match code {
        0 => Some(0),
        _ => RANGES.into_iter().find(serves).map(|(n, ..)| n),
    }
}

/// The nearest code below and the nearest above a time that cannot be set; without the latter
/// above [`LARGEST_CODE`].
#[must_use]
pub fn neighbours(cks: f64) -> (u16, Option<u16>) {
    let codes = || (0..=LARGEST_CODE).filter(|&code| ratio(code).is_some());
    let below = codes().rev().find(|&code| f64::from(code) < cks);
    let above = codes().find(|&code| f64::from(code) > cks);
    (below.unwrap_or(0), above)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_519_codes_and_no_lead() {
        let codes: Vec<u16> = (0..=u16::MAX).filter(|&c| ratio(c).is_some()).collect();
        assert_eq!(codes.len(), 520);
        let count = |n| codes.iter().filter(|&&code| ratio(code) == Some(n)).count();
        assert_eq!([0, 1, 2, 5, 10].map(count), [1, 199, 100, 120, 100]);
        assert!(codes.iter().all(|&c| c <= LARGEST_CODE));
        // A tap of the 199 stages has each of them.
        let tap = |code: u16| code / ratio(code).unwrap_or(1).max(1);
        assert!(codes.iter().all(|&code| tap(code) <= 199));
    }

    #[test]
    fn the_neighbours_of_what_cannot_be_set() {
        for (cks, below, above) in [
            (0.4, 0, Some(1)),
            (199.5, 199, Some(200)),
            (201.0, 200, Some(202)),
            (399.0, 398, Some(400)),
            (997.0, 995, Some(1000)),
            (1991.0, 1990, None),
            (-3.0, 0, Some(0)),
        ] {
            assert_eq!(neighbours(cks), (below, above), "{cks}");
        }
    }
}
