//! Version of the program, its source and its compiler.

use std::sync::LazyLock;

/// Commit, if the environment of the build named it in `MOTION_RTL_COMMIT`. A build script that asked
/// git would compile the whole crate again after every commit; this variable concerns the program alone.
const COMMIT: Option<&str> = option_env!("MOTION_RTL_COMMIT");

/// Optional features, and whether they are built in.
const FEATURES: [(&str, bool); 4] = [
    ("cli", cfg!(feature = "cli")),
    ("jit", cfg!(feature = "jit")),
    ("schema", cfg!(feature = "schema")),
    ("shell", cfg!(feature = "shell")),
];

static SHORT: LazyLock<String> = LazyLock::new(|| {
    let version = env!("CARGO_PKG_VERSION");
    match COMMIT {
        Some(commit) => format!("{version} ({commit})"),
        None => version.to_owned(),
    }
});

static LONG: LazyLock<String> = LazyLock::new(|| {
    let names = |built: bool| {
        let features = FEATURES.iter().filter(|feature| feature.1 == built);
        let names: Vec<_> = features.map(|(name, _)| *name).collect();
        match names.is_empty() {
            true => "none".to_owned(),
            false => names.join(", "),
        }
    };
    format!(
        "{}\ncommit: {}\nfeatures: {}\nleft out: {}\nplatform: {}-{}",
        env!("CARGO_PKG_VERSION"),
        COMMIT.unwrap_or("unknown: set MOTION_RTL_COMMIT when building"),
        names(true),
        names(false),
        std::env::consts::ARCH,
        std::env::consts::OS
    )
});

/// Returns the version in one line.
pub fn short() -> &'static str {
    &SHORT
}

/// Returns version, commit, features and platform.
pub fn long() -> &'static str {
    &LONG
}
