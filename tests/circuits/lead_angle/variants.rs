//! The variants that the catalogue's proofs do not take, since those take the default.

use motion_rtl::registry::{ProofSearch, Verdict, find};

#[test]
fn every_variant_is_proved() {
    let variants: [(&str, &[&[u64]]); 3] = [
        ("placement", &[&[4, 1], &[4, 2]]),
        ("comparator", &[&[4, 1]]),
        ("stop_error", &[&[4, 1]]),
    ];
    for (name, all) in variants {
        let entry = find(name).expect("it is in the catalogue");
        for arguments in all {
            let circuit = entry.make(arguments).expect("it can be made");
            let verdict = circuit.prove(&ProofSearch::default(), &mut |_| ()).unwrap();
            let proved = matches!(verdict, Verdict::Proved(_));
            assert!(proved, "{name} {arguments:?}: {verdict:?}");
        }
    }
}
