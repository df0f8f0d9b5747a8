//! The catalogue is elaborated over a grid of widths: what cannot be is refused in words.

use motion_rtl::registry::{CATALOGUE, Entry, Refused, Request};
use rayon::prelude::*;

/// Makes a circuit of these widths: true if made, false if refused for its widths.
fn made(entry: &Entry, request: &Request) -> Result<bool, String> {
    match entry.requested(request) {
        Ok(circuit) => match circuit.layout() {
            Ok(()) => Ok(true),
            Err(error) => Err(format!("{} with {request:?}: {error}", entry.name)),
        },
        Err(Refused::Wrong(text)) if text.contains("its code panics") => {
            Err(format!("{} with {request:?}: {text}", entry.name))
        }
        Err(Refused::Wrong(_) | Refused::Numbers(_) | Refused::NoWidths) => Ok(false),
        Err(other) => Err(format!("{} with {request:?}: {other}", entry.name)),
    }
}

fn of_width(width: u64) -> Request {
    Request {
        width: Some(width),
        ..Request::default()
    }
}

#[test]
fn every_circuit_is_elaborated_at_every_width() {
    let faults: Vec<String> = CATALOGUE
        .par_iter()
        .flat_map_iter(|entry| {
            (0..=64).filter_map(move |width| match made(entry, &of_width(width)) {
                // Every circuit that has widths has these.
                Ok(false) if (4..=12).contains(&width) && !entry.widths().is_empty() => {
                    Some(format!("{} is not there at width {width}", entry.name))
                }
                Ok(_) => None,
                Err(fault) => Some(fault),
            })
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_width_is_chosen_by_its_name() {
    let faults: Vec<String> = CATALOGUE
        .par_iter()
        .flat_map_iter(|entry| {
            let widths = entry.widths().into_iter();
            widths.flat_map(move |(name, full)| {
                let around = [1, full.saturating_sub(1), full, full + 1, 64, 65];
                around.into_iter().filter_map(move |bits| {
                    let request = Request {
                        named: vec![(name.to_owned(), bits as u64)],
                        ..Request::default()
                    };
                    match made(entry, &request) {
                        Ok(false) if bits == full => {
                            Some(format!("{}: {name} = {full} is refused", entry.name))
                        }
                        Ok(_) => None,
                        Err(fault) => Some(fault),
                    }
                })
            })
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn absurd_widths_are_refused() {
    for entry in CATALOGUE {
        for width in [65, 4097, u64::MAX] {
            assert!(entry.requested(&of_width(width)).is_err(), "{}", entry.name);
        }
        for (name, _) in entry.widths() {
            let request = Request {
                named: vec![(name.to_owned(), u64::MAX)],
                ..Request::default()
            };
            assert!(entry.requested(&request).is_err(), "{}: {name}", entry.name);
        }
        let request = Request {
            named: vec![("no_such".to_owned(), 4)],
            ..Request::default()
        };
        let refused = entry.requested(&request).err().expect("a refusal");
        assert!(
            matches!(refused, Refused::NoSuchWidth { .. } | Refused::NoWidths),
            "{}: {refused}",
            entry.name
        );
    }
}
