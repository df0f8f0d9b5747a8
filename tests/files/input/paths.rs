//! Files and their extensions.

use std::fs;
use std::path::Path;

use motion_rtl::input::read_path;

const EXTENSIONS: &str =
    "allowed: HPGL as .hpgl, .hpg, .plt or .hgl; G-code as .ngc, .gcode, .nc, .tap, .gc or .cnc";

#[test]
fn the_extension_chooses_the_reader() {
    let dir = tempfile::tempdir().unwrap();
    let plot = ["hpgl", "hpg", "plt", "hgl", "PLT"].map(|ext| (ext, "PD40,80"));
    let program = ["ngc", "gcode", "nc", "tap", "gc", "cnc", "NC"].map(|ext| (ext, "G0 X1 Y2"));
    for (extension, text) in plot.into_iter().chain(program) {
        let path = dir.path().join(format!("a.{extension}"));
        fs::write(&path, text).unwrap();
        let drawing = read_path(&path).unwrap();
        assert_eq!(drawing.file, path.display().to_string());
        assert_eq!(drawing.moves.len(), 1);
        assert_eq!(
            drawing.moves.get(0).unwrap().to,
            [1.0, 2.0, 0.0],
            "{extension}"
        );
        assert_eq!(
            drawing.moves.get(0).unwrap().rapid,
            text.starts_with('G'),
            "{extension}"
        );
    }
}

#[test]
fn what_cannot_be_read_is_a_fault() {
    let refuse = |path: &Path| read_path(path).unwrap_err().to_string();
    assert_eq!(
        refuse(Path::new("a.txt")),
        format!("a.txt: file: unknown extension .txt; {EXTENSIONS}")
    );
    assert_eq!(
        refuse(Path::new("plt")),
        format!("plt: file: no extension; {EXTENSIONS}")
    );
    let dir = tempfile::tempdir().unwrap();
    let missing = dir.path().join("missing.plt");
    assert!(refuse(&missing).contains("missing.plt: file: cannot be read: "));
    let folder = dir.path().join("folder.nc");
    fs::create_dir(&folder).unwrap();
    assert!(
        refuse(&folder).ends_with("folder.nc: file: not a regular file; allowed: a readable file")
    );
    let empty = dir.path().join("empty.nc");
    fs::write(&empty, "").unwrap();
    assert!(refuse(&empty).contains("empty.nc: file: no move in it"));
}
