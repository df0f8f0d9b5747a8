//! A trajectory controller of any widths without motors: a path and a profile in, points out.

/// What stands when all points of a period do, in guard units.
#[derive(Debug, Clone, Copy)]
pub struct Period<const AXES: usize> {
    pub command: [i64; AXES],
    pub response: [i64; AXES],
    pub reference: [i64; AXES],
    pub correction: [i64; AXES],
    pub corrected: [i64; AXES],
    /// What the servo's own model makes of it: where the motor is held.
    pub model: [i64; AXES],
    pub length: i64,
    pub answered: i64,
    /// The lengths that the points were looked up at.
    pub looked_up: [u64; 2],
    /// The segments that were found for them.
    pub segments: [usize; 2],
}

/// A path as the words of its segments, with the length of each.
pub type Path = Vec<(u64, [u64; 16])>;

/// A record of the profile.
pub type Record = [u64; 32];

/// A controller of the given widths, and its run on paths.
macro_rules! bench {
    ($name:ident, $axes:literal, $a:literal, $e:literal, [$($widths:tt)*], In<$($ports:literal),*>) => {
        pub mod $name {
            use super::{Path, Period, Record};
            use motion_rtl::kernel::Simulator;
            use motion_rtl::logic::Sim;
            use motion_rtl::trajectory_controller::controller::In;
            use motion_rtl::trajectory_controller::vector_correction::Correction;
            use motion_rtl::trajectory_controller::{Rounding, TrajectoryController};
            use std::array::from_fn;

            pub type Controller = TrajectoryController<$axes, $a, $($widths)*>;
            pub type Ports = In<Sim, $axes, $($ports),*>;

            /// Ports of a tick in which nothing is told.
            pub fn idle(path: &Path, gains: [u64; 2], period: u64) -> Ports {
                let end: u64 = path.iter().map(|segment| segment.0).sum();
                Ports {
                    write: false.into(),
                    write_word: 0.into(),
                    write_data: 0.into(),
                    push: false.into(),
                    start: false.into(),
                    halt: false.into(),
                    restart: false.into(),
                    write_begin: false.into(),
                    begin_segment: 0.into(),
                    begin_length: 0.into(),
                    write_path: false.into(),
                    path_address: 0.into(),
                    path_data: 0.into(),
                    last: (path.len() as u64 - 1).into(),
                    path_end: (end as i64).into(),
                    period: period.into(),
                    gain_1: gains[0].into(),
                    gain_2: gains[1].into(),
                    position_gain: [0.into(); $axes],
                    speed_gain: [0.into(); $axes],
                    integral_gain: [0.into(); $axes],
                    inertia: [0.into(); $axes],
                    limit: [0.into(); $axes],
                    given: false.into(),
                    given_command: [0.into(); $axes],
                    a: [false.into(); $axes],
                    b: [false.into(); $axes],
                }
            }

            /// Ticks in which path and profile are written, then `start`.
            pub fn writes(path: &Path, profile: &[Record], gains: [u64; 2], period: u64) -> Vec<Ports> {
                let idle = || idle(path, gains, period);
                let mut writes = Vec::new();
                let mut begin = 0;
                for (index, (length, words)) in (0u64..).zip(path) {
                    for (word, &data) in (0u64..).zip(words) {
                        writes.push(Ports {
                            write_begin: (word == 0).into(),
                            begin_segment: index.into(),
                            begin_length: begin.into(),
                            write_path: true.into(),
                            path_address: (index << 4 | word).into(),
                            path_data: data.into(),
                            ..idle()
                        });
                    }
                    begin += length;
                }
                for record in profile {
                    for (word, &data) in (0u64..).zip(record) {
                        writes.push(Ports {
                            write: true.into(),
                            write_word: word.into(),
                            write_data: data.into(),
                            push: (word == 31).into(),
                            ..idle()
                        });
                    }
                }
                writes.push(Ports { start: true.into(), ..idle() });
                writes
            }

            /// The first periods of a path; it fails where the arithmetic is late.
            pub fn run(
                path: &Path,
                profile: &[Record],
                gains: [u64; 2],
                correction: Correction,
                (period, periods): (u64, usize),
            ) -> Vec<Period<$axes>> {
                let circuit = Controller::new(correction, Rounding::Nearest);
                let watched = Simulator::watching(&circuit, false, |watch| {
                    let driven = watch.at(watch.w.axes[0].w.driven);
                    let waiting = watch.at(watch.q.progress.waiting);
                    (driven, waiting, watch.at(watch.q.gather.late))
                });
                let (mut simulator, (driven, waiting, late)) = watched.unwrap();
                let mut writes = writes(path, profile, gains, period).into_iter();
                let mut seen = Vec::new();
                while seen.len() < periods {
                    let i = writes.next().unwrap_or_else(|| idle(path, gains, period));
                    let (next, ended) = simulator.step(i, |now| {
                        let (q, w) = (now.q, now.w);
                        let ended = now.get(driven) && !now.get(waiting);
                        ended.then(|| Period {
                            command: from_fn(|k| q.distribution.axes[k].point.get()),
                            response: from_fn(|k| q.axes[k].response.integrators.position.get()),
                            reference: from_fn(|k| q.reference_point.axes[k].point.get()),
                            correction: from_fn(|k| q.axes[k].corrector.correction.get()),
                            corrected: from_fn(|k| q.axes[k].corrector.corrected.get()),
                            model: from_fn(|k| q.axes[k].servo.model.integrators.position.get()),
                            length: q.progress.length.get(),
                            answered: q.tangential.integrators.position.get(),
                            looked_up: [w.clamp_command.w.clamped.get(), w.clamp_response.w.clamped.get()],
                            segments: [
                                w.distribution.w.segment.get() as usize,
                                w.reference_point.w.segment.get() as usize,
                            ],
                        })
                    });
                    simulator = next;
                    seen.extend(ended);
                    assert!(!simulator.get(late));
                }
                assert!(!simulator.registers().sequencer.late.get());
                seen
            }
        }
    };
}

bench!(
    plane, 2, 8, 12,
    [31, 47, 55, 42, 57, 44, 52, 55, 12, 41, 20, 16, 64, 24, 58, 16, 24],
    In<8, 47, 55, 12, 16, 24, 16, 24>
);
bench!(
    space, 3, 8, 12,
    [31, 47, 55, 42, 57, 44, 52, 55, 12, 41, 20, 16, 64, 24, 58, 16, 24],
    In<8, 47, 55, 12, 16, 24, 16, 24>
);
bench!(
    small, 2, 1, 5,
    [4, 6, 8, 6, 10, 6, 11, 12, 5, 9, 6, 4, 11, 4, 17, 4, 8],
    In<1, 6, 12, 5, 4, 4, 4, 8>
);
