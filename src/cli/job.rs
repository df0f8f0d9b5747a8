//! A scenario ready to be run, of whatever circuit.

use super::arguments::Arguments;
use super::source::Source;
use super::waves_of::{self, System};
use super::{Failure, arc, lead_angle, linear, machine, pulse, trajectory};
use motion_rtl::scenario::{Loaded, Scenario};

/// A job, by its circuit.
pub enum Job {
    /// A drawing on the pulse interpolator.
    Pulse(Box<pulse::Job>),
    /// Patterns on the pulse interpolator.
    Patterns(Box<pulse::patterns::Job>),
    /// Patterns on two groups of the pulse interpolator.
    Groups(Box<pulse::patterns::groups::Job>),
    /// On the linear interpolator.
    Linear(Box<linear::Job>),
    /// On the lead-angle compensator.
    LeadAngle(Box<lead_angle::Job>),
    /// On the arc generator.
    Arc(Box<arc::Job>),
    /// On the trajectory controller.
    Trajectory(Box<trajectory::Job>),
    /// On the machine.
    Machine(Box<machine::Job>),
}

impl Job {
    /// Reads and compiles the input of a scenario.
    pub fn prepare(source: Source) -> Result<Self, Failure> {
        Ok(match source.loaded.scenario.clone() {
            Scenario::PulseInterpolator(scenario) if scenario.settings.pattern.is_empty() => {
                Job::Pulse(pulse::Job::prepare(source, true)?.into())
            }
            Scenario::PulseInterpolator(scenario) if scenario.settings.group.is_empty() => {
                Job::Patterns(pulse::patterns::Job::prepare(source, &scenario.settings)?.into())
            }
            Scenario::PulseInterpolator(scenario) => Job::Groups(
                pulse::patterns::groups::Job::prepare(source, &scenario.settings)?.into(),
            ),
            Scenario::LinearInterpolator(scenario) => {
                Job::Linear(linear::Job::prepare(source, scenario.settings)?.into())
            }
            Scenario::LeadAngle(scenario) => {
                Job::LeadAngle(lead_angle::Job::prepare(source, scenario.settings)?.into())
            }
            Scenario::ArcGenerator(scenario) => {
                Job::Arc(arc::Job::prepare(source, scenario.settings)?.into())
            }
            Scenario::TrajectoryController(scenario) => {
                Job::Trajectory(trajectory::Job::prepare(source, scenario.settings)?.into())
            }
            Scenario::Machine(scenario) => {
                Job::Machine(machine::Job::prepare(source, scenario.settings)?.into())
            }
        })
    }

    /// Runs it, or the one system of it whose waves are asked for.
    pub fn run(&self, arguments: &Arguments) -> Result<(), Failure> {
        if let Some(wanted) = &arguments.waves_of {
            return waves_of::run(arguments, wanted, self.scenario(), self.systems());
        }
        match self {
            Job::Pulse(job) => pulse::run(arguments, job),
            Job::Patterns(job) => pulse::patterns::run(arguments, job),
            Job::Groups(job) => pulse::patterns::groups::run(arguments, job),
            Job::Linear(job) => linear::run(arguments, job),
            Job::LeadAngle(job) => lead_angle::run(arguments, job),
            Job::Arc(job) => arc::run(arguments, job),
            Job::Trajectory(job) => trajectory::run(arguments, job),
            Job::Machine(job) => machine::run(arguments, job),
        }
    }

    /// The systems that its summary names.
    pub fn systems(&self) -> Vec<System<'_>> {
        match self {
            Job::Pulse(job) => pulse::systems(job),
            Job::Patterns(job) => pulse::patterns::systems(job),
            Job::Groups(job) => pulse::patterns::groups::systems(job),
            Job::Linear(job) => linear::systems(job),
            Job::LeadAngle(job) => lead_angle::waves::systems(job),
            Job::Arc(job) => arc::systems(job),
            Job::Trajectory(job) => trajectory::systems(job),
            Job::Machine(job) => machine::systems(job),
        }
    }

    fn scenario(&self) -> (&Loaded, &str) {
        match self {
            Job::Pulse(job) => (&job.loaded, &job.stem),
            Job::Patterns(job) => (&job.loaded, &job.stem),
            Job::Groups(job) => (&job.loaded, &job.stem),
            Job::Linear(job) => (&job.loaded, &job.stem),
            Job::LeadAngle(job) => (&job.loaded, &job.stem),
            Job::Arc(job) => (&job.loaded, &job.stem),
            Job::Trajectory(job) => (&job.loaded, &job.stem),
            Job::Machine(job) => (&job.loaded, &job.stem),
        }
    }
}
