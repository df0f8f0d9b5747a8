//! Waves of a running model.

use super::{Clock, FOCUS, Options, WaveFile, WaveFormat, gtkw};
use crate::engine::Engine;
use crate::files::{AtomicFile, Directory, commit_all};
use crate::sim::{Elaborated, Model, ModelError, RunError, Tap};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

impl Model {
    /// Begins waves of all signals from this tick on: a VCD or an FST, by the extension of `path`.
    /// The clock is one of 1 MHz. [`waves_with`](Self::waves_with) takes other options.
    ///
    /// The directory is created if necessary. All signals are watched until
    /// [`finish_waves`](Self::finish_waves).
    ///
    /// ```
    /// use motion_rtl::Model;
    ///
    /// let directory = tempfile::tempdir()?;
    /// let mut counter = Model::new("enable_counter", &["width=8".parse()?])?;
    /// counter.set("period", 10)?;
    /// counter.run(1000);
    /// counter.waves_to(directory.path().join("counter.vcd"))?;
    /// counter.run(500);
    /// let files = counter.finish_waves()?;
    /// assert!(files[0].ends_with("counter.vcd") && files[1].ends_with("counter.gtkw"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if waves are being written already, the extension is another one, the file
    /// cannot be written, or two signals have one name. The model goes on without waves then.
    pub fn waves_to(&mut self, path: impl AsRef<Path>) -> Result<(), ModelError> {
        self.waves_with(path, Clock::default(), &Options::default())
    }

    /// Begins waves as [`waves_to`](Self::waves_to) does, with this clock, of the signals and
    /// ticks that `options` selects.
    ///
    /// # Errors
    /// Returns the errors of [`waves_to`](Self::waves_to), or an error if a selected path does not
    /// exist.
    pub fn waves_with(
        &mut self,
        path: impl AsRef<Path>,
        clock: Clock,
        options: &Options,
    ) -> Result<(), ModelError> {
        if self.is_tapped() {
            return Err(ModelError::WavesOn {
                refused: "no other waves can be begun",
            });
        }
        let waves = ModelWaves::new(self, path.as_ref(), clock, options)?;
        self.begin(Box::new(waves));
        Ok(())
    }

    /// Ends the waves with the tick before this one; returns the paths of the waveform and of a
    /// GTKWave save file beside it, or nothing if no waves were begun. Both files appear complete;
    /// without this call there are none.
    ///
    /// # Errors
    /// Returns the first error of writing; no new file or directory is left then.
    pub fn finish_waves(&mut self) -> Result<Vec<PathBuf>, ModelError> {
        let files = self.end().map(Tap::finish).transpose()?;
        Ok(files.unwrap_or_default())
    }
}

/// Waves of a model, being written.
struct ModelWaves {
    circuit: Elaborated,
    clock: Clock,
    options: Options,
    path: PathBuf,
    /// First tick that was received.
    first: Option<u64>,
    last: u64,
    /// The file, or the first error.
    file: Result<WaveFile, RunError>,
    // After the file, whose directory is removed if it is empty.
    _directory: Option<Directory>,
}

impl ModelWaves {
    fn new(model: &Model, path: &Path, clock: Clock, options: &Options) -> io::Result<Self> {
        let format = WaveFormat::of(path)?;
        let circuit = model.elaborated().clone();
        let parent = path.parent().filter(|parent| *parent != Path::new(""));
        let directory = parent.map(Directory::create).transpose()?;
        let file = AtomicFile::create(path)?;
        Ok(ModelWaves {
            file: Ok(WaveFile::new(file, format, &circuit, clock, options)?),
            circuit,
            clock,
            options: options.clone(),
            path: path.to_owned(),
            first: None,
            last: 0,
            _directory: directory,
        })
    }

    fn save_file(&self) -> io::Result<AtomicFile> {
        let first = self.first.unwrap_or(0).max(self.options.ticks.start);
        let end = (self.last + 1).min(self.options.ticks.end);
        let focus = first..end.min(first.saturating_add(FOCUS));
        let dump = self.path.file_name().unwrap_or_default().to_string_lossy();
        let save = gtkw::save_file(&self.circuit, self.clock, &self.options, &dump, focus)?;
        let mut file = AtomicFile::create(self.path.with_extension("gtkw"))?;
        file.write_all(save.as_bytes())?;
        Ok(file)
    }
}

impl Tap for ModelWaves {
    fn tick(&mut self, tick: u64, engine: &Engine) {
        if let Ok(file) = &mut self.file {
            self.first.get_or_insert(tick);
            self.last = tick;
            if let Err(error) = file.tick(tick, engine) {
                self.file = Err(error);
            }
        }
    }

    fn finish(self: Box<Self>) -> io::Result<Vec<PathBuf>> {
        let save = self.save_file();
        let file = self.file.map_err(|error| match error {
            RunError::Waves(error) => error,
            other => io::Error::other(other),
        })?;
        commit_all([file.finish()?, save?])
    }
}
