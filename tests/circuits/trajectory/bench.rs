//! A trajectory controller of any widths without motors: a path and a profile in, points out.

use motion_rtl::circuits::blocks::RecordWrite;
use motion_rtl::circuits::trajectory_controller::controller::In;
use motion_rtl::circuits::trajectory_controller::error_feedback::FeedbackGains;
use motion_rtl::circuits::trajectory_controller::model_state::ModelGains;
use motion_rtl::circuits::trajectory_controller::path_point::PathWrite;
use motion_rtl::circuits::trajectory_controller::vector_correction::Correction;
use motion_rtl::circuits::trajectory_controller::{Rounding, TrajectoryController, Widths};
use motion_rtl::hdl::{At, Cut, Value, zero};
use motion_rtl::sim::Simulator;

/// Values when all points of a period are complete, in guard units.
#[derive(Debug, Clone)]
pub struct Period {
    pub command: Vec<i64>,
    pub response: Vec<i64>,
    pub reference: Vec<i64>,
    pub correction: Vec<i64>,
    pub corrected: Vec<i64>,
    /// Position of the servo's own model: where the motor is held.
    pub model: Vec<i64>,
    pub length: i64,
    pub answered: i64,
    /// The lengths that the points were looked up at.
    pub looked_up: [u64; 2],
    /// The segments that were found for them.
    pub segments: [usize; 2],
}

/// T and N, where errors are fed back: 1.5 and 2.5.
pub const FED: FeedbackGains<Value> = FeedbackGains {
    tangential_gain: 384,
    normal_gain: 640,
};

/// A path as the words of its segments, with the length of each.
pub type Path = Vec<(u64, [u64; 16])>;

/// A record of the profile.
pub type Record = [u64; 32];

/// A controller of the given widths, and its run on paths.
#[derive(Debug, Clone, Copy)]
pub struct Bench {
    widths: Widths,
    axes: usize,
}

const WIDTHS: Widths = Widths {
    segment: 8,
    ..Widths::FULL
};

pub const PLANE: Bench = Bench {
    widths: WIDTHS,
    axes: 2,
};
pub const SPACE: Bench = Bench {
    widths: WIDTHS,
    axes: 3,
};
pub const SMALL: Bench = Bench {
    widths: Widths {
        position: 4,
        point: 6,
        radius: 8,
        coefficient: 6,
        curvature: 6,
        angle: 6,
        data: 12,
        segment: 1,
        fraction: 9,
        samples: 6,
        period: 8,
        gain: 4,
        servo_gain: 4,
        torque: 4,
    },
    axes: 2,
};

impl Bench {
    pub fn controller(self, correction: Correction) -> TrajectoryController {
        TrajectoryController::new(self.widths, self.axes, correction, Rounding::Nearest)
    }

    /// Ports of a tick in which nothing is told.
    pub fn idle(self, path: &Path, gains: [u64; 2], period: u64) -> In<Value> {
        let end: u64 = path.iter().map(|segment| segment.0).sum();
        In {
            last: path.len() as u64 - 1,
            path_end: end as i64,
            period,
            model_gains: ModelGains {
                gain_1: gains[0],
                gain_2: gains[1],
            },
            feedback_gains: FeedbackGains {
                tangential_gain: FED.tangential_gain.cut(self.widths.gain),
                normal_gain: FED.normal_gain.cut(self.widths.gain),
            },
            axis_gain_1: vec![gains[0]; self.axes],
            axis_gain_2: vec![gains[1]; self.axes],
            ..zero(&self.controller(Correction::Vector))
        }
    }

    /// Ticks in which path and profile are written, then `start`.
    pub fn writes(
        self,
        path: &Path,
        profile: &[Record],
        gains: [u64; 2],
        period: u64,
    ) -> Vec<In<Value>> {
        let idle = self.idle(path, gains, period);
        let mut writes = Vec::new();
        let mut begin = 0;
        for (index, (length, words)) in (0u64..).zip(path) {
            for (word, &data) in (0u64..).zip(words) {
                let path = PathWrite {
                    write_begin: word == 0,
                    begin_segment: index,
                    begin_length: begin,
                    write_path: true,
                    path_address: index << 4 | word,
                    path_data: data,
                };
                writes.push(In {
                    path,
                    ..idle.clone()
                });
            }
            begin += length;
        }
        for record in profile {
            for (word, &data) in (0u64..).zip(record) {
                let record = RecordWrite {
                    write: true,
                    write_word: word,
                    write_data: data,
                    push: word == 31,
                };
                writes.push(In {
                    record,
                    ..idle.clone()
                });
            }
        }
        writes.push(In {
            start: true,
            ..idle
        });
        writes
    }

    /// The first periods of a path; it fails where the arithmetic is late.
    pub fn run(
        self,
        path: &Path,
        profile: &[Record],
        gains: [u64; 2],
        correction: Correction,
        periods: (u64, usize),
    ) -> Vec<Period> {
        let at_power_on = self.at_power_on(correction);
        at_power_on.run(path, profile, gains, periods)
    }

    pub fn at_power_on(self, correction: Correction) -> AtPowerOn {
        let circuit = self.controller(correction);
        let watched = Simulator::watching(&circuit, false, |watch| Watched {
            driven: watch.at(watch.p.axes[0].w.driven),
            waiting: watch.at(watch.p.progress.q.waiting),
            late: watch.at(watch.p.gather.q.late),
        });
        let (simulator, watched) = watched.unwrap();
        AtPowerOn {
            bench: self,
            simulator,
            watched,
        }
    }
}

/// A controller that has not run yet.
pub struct AtPowerOn {
    bench: Bench,
    simulator: Simulator<TrajectoryController>,
    watched: Watched,
}

#[derive(Clone, Copy)]
struct Watched {
    driven: At<bool>,
    waiting: At<bool>,
    late: At<bool>,
}

impl AtPowerOn {
    /// Compiles it, for many runs.
    pub fn compiled(mut self) -> Self {
        self.simulator.compile();
        self
    }

    /// The first periods of a path; it fails where the arithmetic is late.
    pub fn run(
        &self,
        path: &Path,
        profile: &[Record],
        gains: [u64; 2],
        (period, periods): (u64, usize),
    ) -> Vec<Period> {
        let Watched {
            driven,
            waiting,
            late,
        } = self.watched;
        let mut simulator = self.simulator.clone();
        let mut writes = self.bench.writes(path, profile, gains, period).into_iter();
        let idle = self.bench.idle(path, gains, period);
        let mut seen = Vec::new();
        while seen.len() < periods {
            let write = writes.next();
            let ended = simulator
                .step_with(write.as_ref().unwrap_or(&idle), |now| {
                    let ended = now.get(driven) && !now.get(waiting);
                    ended.then(|| {
                        let (p, axes) = (now.p, &now.p.axes);
                        let [placed, referred] = [&p.distribution, &p.reference_point];
                        let response = axes.iter().map(|axis| &axis.p.response.p.integrators);
                        let model = axes.iter().map(|axis| &axis.p.servo.p.model.p.integrators);
                        let corrector = axes.iter().map(|axis| &axis.p.corrector.q);
                        Period {
                            command: placed.p.axes.iter().map(|axis| axis.q.point).collect(),
                            response: response.map(|model| model.q.position).collect(),
                            reference: referred.p.axes.iter().map(|axis| axis.q.point).collect(),
                            correction: corrector.clone().map(|of| of.correction).collect(),
                            corrected: corrector.map(|of| of.corrected).collect(),
                            model: model.map(|model| model.q.position).collect(),
                            length: p.progress.q.length,
                            answered: p.tangential.p.integrators.q.position,
                            looked_up: [p.clamp_command.w.clamped, p.clamp_response.w.clamped],
                            segments: [placed, referred].map(|point| point.w.segment as usize),
                        }
                    })
                })
                .unwrap();
            seen.extend(ended);
            assert!(!simulator.get(late));
        }
        assert!(!simulator.registers().p.sequencer.q.late);
        seen
    }
}
