//! Notes whose timing charts ship with the program.

macro_rules! notes {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $name)))),*]
    };
}

/// Notes with timing charts: name and text.
pub const NOTES: [(&str, &str); 9] = notes![
    "rtl_notes/arc_generator.md",
    "rtl_notes/blocks.md",
    "rtl_notes/conventions.md",
    "rtl_notes/golden_model.md",
    "rtl_notes/lead_angle.md",
    "rtl_notes/linear_interpolator.md",
    "rtl_notes/machine.md",
    "rtl_notes/pulse_interpolator.md",
    "rtl_notes/trajectory_controller.md",
];

#[cfg(test)]
mod tests {
    use super::NOTES;
    use std::fs;
    use std::path::Path;

    /// Adds the names of the notes below a folder that have charts.
    fn add(folder: &str, names: &mut Vec<String>) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for entry in fs::read_dir(path).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{folder}/{}", entry.file_name().to_str().unwrap());
            if entry.file_type().unwrap().is_dir() {
                add(&name, names);
            } else if name.ends_with(".md")
                && fs::read_to_string(entry.path())
                    .unwrap()
                    .contains("```chart ")
            {
                names.push(name);
            }
        }
    }

    #[test]
    fn every_note_with_charts_ships() {
        let mut names = Vec::new();
        add("rtl_notes", &mut names);
        names.sort();
        assert_eq!(NOTES.map(|(name, _)| name).to_vec(), names);
    }
}
