//! Map template.

use super::pair::Pairing;
use super::wave::Wave;
use std::fmt::Write as _;
use toml::Value;

/// Returns the skeleton of a map: the golden signals without partner as lines of `[signals]`, and
/// the candidates in the other file.
pub(super) fn skeleton(golden: &Wave, other: &Wave, clock: usize, pairing: &Pairing) -> String {
    let mut text = format!(
        "# Names of {} that stand for those of {}.\n",
        shown(&other.file),
        shown(&golden.file)
    );
    text +=
        "# Fill in a name and take the # away. The end of a path will do if it is the only one.\n";
    text += "# What has no partner on purpose goes into ignore, a port out into leave.\n";
    text += "\nignore = []\nleave = []\n\n[signals]\n";
    // Writing to a string cannot fail.
    for &index in &pairing.without_partner {
        let variable = &golden.variables[index];
        let name = Value::from(variable.path.as_str());
        let port = match pairing.ports.out.contains(&index) {
            true => ", port out",
            false => "",
        };
        let _ = writeln!(text, "#{name} = \"\" # {}{port}", bits(variable.width));
    }
    let free = pairing.free(other, clock);
    if !free.is_empty() {
        text += "\n# There without partner:\n";
    }
    for index in free {
        let variable = &other.variables[index];
        let _ = writeln!(
            text,
            "#   {} # {}",
            shown(&variable.path),
            bits(variable.width)
        );
    }
    text
}

/// Makes a name safe for a comment, which a line break would end.
fn shown(name: &str) -> String {
    name.replace(char::is_control, " ")
}

fn bits(width: u32) -> String {
    match width {
        1 => "1 bit".to_owned(),
        _ => format!("{width} bits"),
    }
}
