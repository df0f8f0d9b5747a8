//! Keys that other names are used for.

/// The key to use in place of another name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Renamed {
    /// Name of the key.
    pub(super) name: &'static str,
    /// Its unit.
    pub(super) unit: &'static str,
    /// Factor for the number.
    pub(super) factor: u32,
}

/// Returns the key that has a setting in another unit.
pub(super) fn renamed(key: &str) -> Option<Renamed> {
    let name = match key {
        "feed_mm_per_s" | "speed_mm_per_s" => "feed_mm_per_min",
        "rapid_mm_per_s" => "rapid_mm_per_min",
        "corner_mm_per_s" => "corner_mm_per_min",
        _ => return None,
    };
    Some(Renamed {
        name,
        unit: "mm/min",
        factor: 60,
    })
}
