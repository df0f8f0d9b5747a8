use motion_rtl::kernel::Simulator;
use motion_rtl::pulse_interpolator::{UnitLaw, unit_law::In};
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd};
use std::{error::Error, fs::File, path::Path};

/// Speeds up from a half-period of 50 ticks to one of 10, in unit times of 100 ticks.
pub fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    let circuit = UnitLaw::<16>::default();
    let waves = File::create(folder.join("unit_law.vcd"))?;
    let clock = Clock::from_hz(100_000_000)?;
    let mut vcd = Vcd::new(waves, &circuit, clock, &Options::default())?;
    let mut stimulus = StimulusFile::new(File::create(folder.join("unit_law.stimulus"))?);
    let run = Simulator::new(&circuit)?.run(
        4000,
        |tick, _| In {
            half_period: (50 - tick / 100).into(),
            period: 100.into(),
        },
        (&mut vcd, &mut stimulus),
    );
    run?;
    vcd.finish()?;
    stimulus.finish()?;
    Ok(())
}
