use motion_rtl::circuits::pulse_interpolator::{UnitLaw, Variant, unit_law::In};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::{Clock, Options, StimulusFile, Vcd};
use std::{error::Error, fs::File, path::Path};

/// Speeds up from a half-period of 50 ticks to one of 10, in unit times of 100 ticks.
pub fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    let circuit = UnitLaw {
        width: 16,
        variant: Variant::Safe,
    };
    let waves = File::create(folder.join("unit_law.vcd"))?;
    let clock = Clock::from_hz(100_000_000)?;
    let mut vcd = Vcd::new(waves, &circuit, clock, &Options::default())?;
    let mut stimulus = StimulusFile::new(File::create(folder.join("unit_law.stimulus"))?, &circuit);
    Simulator::new(&circuit)?.run(
        4000,
        |tick, _| In {
            half_period: 50 - tick / 100,
            period: 100,
        },
        (&mut vcd, &mut stimulus),
    )?;
    vcd.finish()?;
    stimulus.finish()?;
    Ok(())
}
