//! The circuit and the program side by side.

use super::program::{Outputs, Ports, Program};
use motion_rtl::circuits::linear_interpolator::{PatternGenerator, pattern_generator};
use motion_rtl::sim::Simulator;
use motion_rtl::trace::LastTicks;

/// Both, fed with the same ports; they are compared in every tick.
pub struct Bench {
    simulator: Simulator<PatternGenerator>,
    program: Program,
    /// Ticks from a start to `ready`, and from an advance to `valid`.
    pub prepare: u64,
    pub scan_latency: u64,
    pub ticks: u64,
}

impl Bench {
    /// With so many bits of positions and times.
    pub fn new([position, time]: [u32; 2]) -> Self {
        let circuit = PatternGenerator {
            position: position as usize,
            time: time as usize,
        };
        Bench {
            simulator: LastTicks::simulator(&circuit).unwrap(),
            program: Program::new(position, time),
            prepare: circuit.prepare_latency(),
            scan_latency: circuit.scan_latency(),
            ticks: 0,
        }
    }

    /// Outputs of the circuit in the next tick.
    pub fn outputs(&self) -> Outputs {
        let q = self.simulator.registers().p.trapezoid.q;
        Outputs {
            position: q.position,
            valid: q.valid,
            ready: q.ready,
            active: q.active,
        }
    }

    /// A tick.
    pub fn step(&mut self, ports: &Ports) {
        let i = pattern_generator::In {
            start: ports.start,
            from: ports.from,
            distance: ports.distance,
            speed: ports.speed,
            acceleration_time: ports.times[0],
            deceleration_time: ports.times[1],
            advance: ports.advance,
            halt: ports.halt,
        };
        let shown = self
            .simulator
            .step_with(&i, |now| Outputs {
                position: now.w.position,
                valid: now.w.valid,
                ready: now.w.ready,
                active: now.w.active,
            })
            .unwrap();
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
            for within in 0..self.scan_latency {
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
            if abort == Some((scan, self.scan_latency)) {
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
        for tick in 1..self.prepare {
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
