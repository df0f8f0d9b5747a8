//! Check that a bench and a model are made for each other.

use crate::abi::MRTL_ABI;
use crate::bench::{Bench, mrtl_model, on};
use crate::codes::{MRTL_MISMATCH, MRTL_OK};
use crate::failure::Failure;
use motion_rtl::checker::PortList;

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
        let list = PortList::of(&bench.model);
        let own = list.hash();
        if ports != own {
            let (name, list) = (bench.model.name(), list.text());
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
