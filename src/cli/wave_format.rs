//! Formats of waves by their names on the command line.

use clap::ValueEnum;
use motion_rtl::trace::WaveFormat;

/// A format of waves.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text that every waveform viewer reads.
    #[default]
    Vcd,
    /// GTKWave's format, which takes a fifth to a hundredth of the bytes.
    Fst,
}

impl From<Format> for WaveFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Vcd => WaveFormat::Vcd,
            Format::Fst => WaveFormat::Fst,
        }
    }
}

impl Format {
    /// Returns the extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Vcd => "vcd",
            Format::Fst => "fst",
        }
    }
}
