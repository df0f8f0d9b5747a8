//! `completions` and `man`: for the shell, from the description of the command line.

use super::files::Files;
use super::program::description;
use super::{Failure, print, to_standard_output};
use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man as Page;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Name of the program.
const NAME: &str = "motion-rtl";

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct Completions {
    /// Shell that reads the completions.
    #[arg(value_enum)]
    shell: Shell,
}

/// Arguments of `man`.
#[derive(Debug, Args)]
pub struct Man {
    /// Directory for the pages, one for the program and one for each command.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Prints the completions of a shell.
pub fn completions(arguments: &Completions) -> Result<(), Failure> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut description(), NAME, &mut text);
    to_standard_output(&String::from_utf8_lossy(&text))
}

/// Writes the man pages.
pub fn man(arguments: &Man) -> Result<(), Failure> {
    let mut files = Files::begin(&arguments.out, NAME)?;
    let described = description();
    let mut pages = vec![(NAME.to_owned(), described.clone())];
    pages.extend(described.get_subcommands().map(|command| {
        let name = format!("{NAME}-{}", command.get_name());
        // A command's name is borrowed for ever; there are a few.
        (name.clone(), command.clone().name(&*name.leak()))
    }));
    for (name, command) in pages {
        let mut text = Vec::new();
        Page::new(command).render(&mut text)?;
        files.write_as(&format!("{name}.1"), &String::from_utf8_lossy(&text))?;
    }
    let mut text = String::new();
    for file in files.commit()? {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{file}");
    }
    print(&text)
}
