//! Check that a bench and a model are made for each other.

use crate::abi::MRTL_ABI;
use crate::bench::{Bench, mrtl_model, on};
use crate::codes::{MRTL_MISMATCH, MRTL_OK};
use crate::failure::Failure;
use motion_rtl::sim::{PortDirection, SignalInfo};

/// Returns the lines of the port list, each with its newline.
fn lines(signals: &[SignalInfo]) -> Vec<String> {
    let ports = signals.iter().filter_map(|signal| {
        let direction = match signal.port? {
            PortDirection::In => "in",
            PortDirection::Out => "out",
        };
        let kind = match signal.is_signed() {
            true => "signed",
            false => "unsigned",
        };
        let (name, width) = (&signal.path, signal.width());
        Some(format!("{direction} {name} {width} {kind}\n"))
    });
    ports.collect()
}

/// Returns the FNV-1a hash of a text.
fn hash(lines: &[String]) -> u64 {
    let bytes = lines.iter().flat_map(|line| line.bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

/// Checks that a bench fits a model: `abi` is MRTL_ABI of the header that the bench was compiled
/// with, `ports` the hash of the ports that it was written for.
///
/// The hash is FNV-1a with 64 bits over one line per port, in the order of the indices:
/// `in period 8 unsigned` and a newline. The text of the error has the model's hash and ports.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mrtl_check(model: mrtl_model, abi: u32, ports: u64) -> i32 {
    let fits = |bench: &mut Bench| {
        if abi != MRTL_ABI {
            let text = format!("the bench is made for ABI {abi}, the library has ABI {MRTL_ABI}");
            return Err(Failure::new(MRTL_MISMATCH, text));
        }
        let lines = lines(bench.signals());
        let own = hash(&lines);
        if ports != own {
            let (name, list) = (bench.model.name(), lines.concat());
            let text = format!(
                "{name} has other ports than the bench expects: hash {own:#018x}, \
                 not {ports:#018x}; its ports are:\n{list}"
            );
            return Err(Failure::new(MRTL_MISMATCH, text.trim_end()));
        }
        Ok(MRTL_OK)
    };
    // SAFETY: by the header's rules calls with one handle do not overlap.
    unsafe { on(model, fits) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_rtl::Model;

    fn model(settings: &str) -> Model {
        Model::new("enable_counter", &[settings.parse().unwrap()]).unwrap()
    }

    #[test]
    fn the_hash_is_fnv_1a() {
        // The published values of the empty text and of `foobar`.
        assert_eq!(hash(&[]), 0xcbf2_9ce4_8422_2325);
        assert_eq!(hash(&["foo".into(), "bar".into()]), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn ports_are_listed_with_width_and_sign() {
        let list = lines(&model("width=8").signals());
        assert_eq!(list, ["in period 8 unsigned\n", "out enable 1 unsigned\n"]);
        assert_ne!(hash(&list), hash(&lines(&model("width=9").signals())));
    }
}
