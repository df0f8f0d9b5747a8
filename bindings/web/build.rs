//! Options of the linker: the page adds compiled circuits to the table of functions.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    for option in ["--export-table", "--growable-table"] {
        println!("cargo::rustc-link-arg-bins={option}");
    }
}
