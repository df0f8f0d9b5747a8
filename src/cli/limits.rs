//! Limits under which the program is started.

use super::Failure;
use std::fs;

/// Least address space in KiB: with less, threads and first allocations fail anywhere.
const LEAST_KIB: u64 = 64 << 10;

/// Refuses an address space that is too small to begin in.
pub fn check() -> Result<(), Failure> {
    let limits = fs::read_to_string("/proc/self/limits").unwrap_or_default();
    match address_space(&limits).map(|bytes| bytes >> 10) {
        Some(kib) if kib < LEAST_KIB => Err(Failure::Argument {
            field: "ulimit -v",
            problem: format!("the address space is limited to {kib} KiB"),
            allowed: format!("{LEAST_KIB} KiB or more"),
        }),
        _ => Ok(()),
    }
}

/// Limit in bytes, as the system lists it; `None` if "unlimited".
fn address_space(limits: &str) -> Option<u64> {
    let line = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"));
    line?.split_whitespace().next()?.parse().ok()
}

/// True if standard output was closed when the program began: the null device stands in for it
/// then, open for reading too. Some programs pass on such a one themselves.
pub fn is_closed() -> bool {
    let flags = fs::read_to_string("/proc/self/fdinfo/1").unwrap_or_default();
    let flags = flags.lines().find_map(|line| line.strip_prefix("flags:"));
    let flags = flags.and_then(|flags| i32::from_str_radix(flags.trim(), 8).ok());
    let device = fs::read_link("/proc/self/fd/1");
    device.is_ok_and(|device| device.as_os_str() == "/dev/null")
        && flags.is_some_and(|flags| flags & ACCESS == BOTH)
}

/// Access modes in the flags, and the one for reading and writing.
const ACCESS: i32 = 0o3;
const BOTH: i32 = 0o2;

#[cfg(test)]
mod tests {
    use super::address_space;

    #[test]
    fn the_limit_is_read_as_the_system_lists_it() {
        let of = |limit: &str| {
            let lines =
                "Limit                     Soft Limit           Hard Limit           Units\n";
            address_space(&format!(
                "{lines}Max address space         {limit} unlimited  bytes\n"
            ))
        };
        assert_eq!(of("50331648"), Some(50_331_648));
        assert_eq!(of("unlimited"), None);
        assert_eq!(address_space(""), None);
    }
}
