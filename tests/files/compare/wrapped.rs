//! An FST that is packed as a whole, as GHDL, NVC and `vvp -fst-space` write it.

use motion_rtl::circuits::blocks::{EnableCounter, enable_counter::In};
use motion_rtl::compare::{Settings, compare};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::{Clock, Fst, Options};
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// The FST of some ticks.
pub fn counter(ticks: u64) -> Vec<u8> {
    let circuit = EnableCounter { width: 8 };
    let options = Options::default();
    let mut fst = Fst::new(
        Cursor::new(Vec::new()),
        &circuit,
        Clock::default(),
        &options,
    )
    .unwrap();
    let mut simulator = Simulator::new(&circuit).unwrap();
    simulator
        .run(ticks, |_, _| In { period: 3 }, &mut fst)
        .unwrap();
    fst.finish().unwrap().into_inner()
}

/// A file as a single section of an FST, whose contents are that file by gzip.
pub fn wrapped(bytes: &[u8]) -> Vec<u8> {
    let packed = miniz_oxide::deflate::compress_to_vec(bytes, 6);
    let length = 16 + 10 + packed.len() as u64;
    let numbers = [length.to_be_bytes(), (bytes.len() as u64).to_be_bytes()].concat();
    let gzip = [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3];
    [&[254][..], &numbers, &gzip, &packed].concat()
}

fn refusal(golden: &Path, other: &Path, bytes: &[u8]) -> String {
    fs::write(other, bytes).unwrap();
    compare(golden, other, &Settings::default())
        .unwrap_err()
        .problem
}

#[test]
fn a_packed_fst_is_what_is_in_it() {
    let directory = tempfile::tempdir().unwrap();
    let [plain, packed] = ["plain.fst", "packed.fst"].map(|name| directory.path().join(name));
    let bytes = counter(20);
    fs::write(&plain, &bytes).unwrap();
    fs::write(&packed, wrapped(&bytes)).unwrap();
    for [golden, other] in [[&plain, &packed], [&packed, &plain]] {
        let report = compare(golden, other, &Settings::default()).unwrap();
        assert!(report.is_equal(), "{report}");
        assert_eq!((report.ticks, report.signals), (20, 4), "{report}");
        assert_eq!(report.ports_out, ["enable_counter.enable"]);
    }
}

#[test]
fn a_packed_fst_that_is_cut_off_or_claims_too_much_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let [plain, packed] = ["plain.fst", "packed.fst"].map(|name| directory.path().join(name));
    let bytes = counter(20);
    fs::write(&plain, &bytes).unwrap();
    let whole = wrapped(&bytes);
    let refused = |bytes: &[u8]| refusal(&plain, &packed, bytes);
    // Not yet packed: GTKWave's writer gives the length at the end.
    let unfinished = [&[254][..], &[0; 8], &whole[9..]].concat();
    assert_eq!(refused(&unfinished), "is not packed to its end");
    for length in 1..whole.len() - 1 {
        assert!(!refused(&whole[..length]).is_empty(), "{length}");
    }
    assert_eq!(refused(&whole[..16]), "is cut off");
    let claims = |claim: u64| {
        let claim = claim.to_be_bytes();
        refused(&[&whole[..9], &claim[..], &whole[17..]].concat())
    };
    let length = bytes.len() as u64;
    for claim in [length - 1, length + 1, 0] {
        assert_eq!(
            claims(claim),
            "does not unpack to an FST of the length that it tells"
        );
    }
    for claim in [1 << 20, 1 << 40, u64::MAX] {
        assert_eq!(claims(claim), "unpacks to more than there can be");
    }
    // Packed twice, and something else than an FST.
    let text = "does not unpack to an FST of the length that it tells";
    assert_eq!(refused(&wrapped(&whole)), text);
    assert_eq!(refused(&wrapped(b"$enddefinitions $end\n")), text);
    let mut named = whole.clone();
    named[20] = 8;
    assert_eq!(refused(&named), "is packed by something else than gzip");
}
