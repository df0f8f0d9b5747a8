//! The circuit and the program side by side.

use super::program::{Outputs, Ports, Program};
use motion_rtl::kernel::Simulator;
use motion_rtl::linear_interpolator::{PatternGenerator, pattern_generator};
use motion_rtl::logic::Sim;

type Circuit<const P: usize, const T: usize, const M: usize, const Q: usize> =
    PatternGenerator<P, T, M, Q>;

/// Both, fed with the same ports; they are compared in every tick.
pub struct Bench<const P: usize, const T: usize, const M: usize, const Q: usize> {
    simulator: Option<Simulator<Circuit<P, T, M, Q>>>,
    program: Program,
    pub ticks: u64,
}

impl<const P: usize, const T: usize, const M: usize, const Q: usize> Bench<P, T, M, Q> {
    pub const PREPARE: u64 = Circuit::<P, T, M, Q>::PREPARE_LATENCY;
    pub const SCAN_LATENCY: u64 = Circuit::<P, T, M, Q>::SCAN_LATENCY;

    pub fn new() -> Self {
        let circuit = const {
            &PatternGenerator {
                trapezoid: motion_rtl::linear_interpolator::Trapezoid,
                mul_div: motion_rtl::blocks::MulDiv,
            }
        };
        Bench {
            simulator: Some(Simulator::new(circuit).unwrap()),
            program: Program::new(P as u32, T as u32),
            ticks: 0,
        }
    }

    /// What the circuit shows in the tick to come.
    pub fn outputs(&self) -> Outputs {
        let q = &self
            .simulator
            .as_ref()
            .expect("it runs")
            .registers()
            .trapezoid;
        Outputs {
            position: q.position.get(),
            valid: q.valid.get(),
            ready: q.ready.get(),
            active: q.active.get(),
        }
    }

    /// A tick.
    pub fn step(&mut self, ports: &Ports) {
        let i: pattern_generator::In<Sim, P, T> = pattern_generator::In {
            start: ports.start.into(),
            from: ports.from.into(),
            distance: ports.distance.into(),
            speed: ports.speed.into(),
            acceleration_time: ports.times[0].into(),
            deceleration_time: ports.times[1].into(),
            advance: ports.advance.into(),
            halt: ports.halt.into(),
        };
        let simulator = self.simulator.take().expect("it runs");
        let (next, shown) = simulator.step(i, |now| Outputs {
            position: now.w.position.get(),
            valid: now.w.valid.get(),
            ready: now.w.ready.get(),
            active: now.w.active.get(),
        });
        self.simulator = Some(next);
        let expected = self.program.outputs();
        let plan = self.program.plan();
        assert_eq!(shown, expected, "tick {} of {plan:?}", self.ticks);
        self.program.edge(ports);
        self.ticks += 1;
    }

    /// The positions of the scans to come, the present one before them, until the cycle ends or as
    /// many scans are made; `pause` ticks before every advance. The abort comes with the
    /// scan and so many ticks after its advance.
    pub fn scans(&mut self, most: u64, abort: Option<(u64, u64)>, pause: u64) -> Vec<i64> {
        let mut positions = vec![self.outputs().position];
        let mut scan = 0;
        while self.outputs().active && scan < most {
            for _ in 0..pause {
                self.step(&Ports::default());
            }
            for within in 0..Self::SCAN_LATENCY {
                let strobes = Ports {
                    advance: within == 0,
                    halt: abort == Some((scan, within)),
                    ..Ports::default()
                };
                self.step(&strobes);
            }
            if self.outputs().valid {
                positions.push(self.outputs().position);
            }
            if abort == Some((scan, Self::SCAN_LATENCY)) {
                self.step(&Ports {
                    halt: true,
                    ..Ports::default()
                });
            }
            scan += 1;
        }
        positions
    }

    /// A cycle: prepared, then scan by scan.
    pub fn cycle(&mut self, ports: &Ports, abort: Option<(u64, u64)>, pause: u64) -> Vec<i64> {
        self.step(ports);
        for tick in 1..Self::PREPARE {
            let early = self.outputs().ready;
            assert!(!early, "ready {tick} ticks after the start");
            if ports.distance != 0 {
                self.step(&Ports::default());
            }
        }
        assert_eq!(self.outputs().ready, ports.distance != 0);
        self.scans(u64::MAX, abort, pause)
    }
}
