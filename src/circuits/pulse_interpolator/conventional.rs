//! The conventional device of Fig. 5 (¶0002–0005), for comparison: a motor controller that
//! computes, and pulse generators that make its pulses.
//!
//! ```text
//!                    ┌──────────────┐
//!  command, delta… ─▶│ conventional ├──▶ step_x, step_y, …
//!  units, period ───▶│ pulse        ├──▶ dir_x, dir_y, …
//!                    │ interpolator ├──▶ ready, busy, unit_rst, late
//!                    └──────────────┘
//! ```
//!
//! While a unit time runs, the next one is computed. If it is not ready in time, it starts a whole
//! unit time later, and the axes stop until then.

use super::circular_interpolator::{self, ArcMove, CircularInterpolator};
use super::motor_controller::{self, ConventionalWidths, Move};
use super::{AXIS_NAMES, MotorController, PulseTrain, UnitTimeRegister};
use super::{group, pulse_train, unit_time_register};
use crate::circuits::blocks::{Cordic, EnableCounter, MulDiv, cordic, enable_counter, mul_div};
use crate::prelude::*;

/// Conventional device of 1 to 8 axes.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conventional {
    /// Number of axes.
    pub axes: usize,
    /// Word widths.
    pub widths: ConventionalWidths,
    /// Unit time at power-on, in ticks.
    pub period: u64,
    /// True if it takes arcs of its first two axes too.
    pub arcs: bool,
}

impl Conventional {
    /// Its motor controller.
    pub const fn controller(&self) -> MotorController {
        MotorController {
            axes: self.axes,
            widths: self.widths,
        }
    }

    const fn unit_time(&self) -> UnitTimeRegister {
        UnitTimeRegister {
            width: self.widths.period,
            period: self.period,
        }
    }

    /// Circuit that makes the moves of an arc, where arcs are included.
    pub const fn circular(&self) -> CircularInterpolator {
        CircularInterpolator {
            controller: self.controller(),
            angle: ANGLE,
        }
    }
}

/// Width of an angle: after a thousand unit times it is off by a twentieth of a step at the greatest
/// radius.
const ANGLE: usize = 32;

signals! { for Conventional as c;
    /// Input ports: the computer 7.
    pub struct In {
        /// Move from the computer 7.
        pub order: Move(&c.controller()) as Flat,
        /// Parameters of the move if it is an arc.
        pub arc: ArcMove(&c.circular()) if c.arcs,
    }
    /// The circuits inside.
    pub struct Parts {
        /// Unit-time register.
        pub unit_time: Part<UnitTimeRegister>(c.unit_time()),
        /// Unit-time counter; its enable is RST.
        pub counter: Part<EnableCounter>(EnableCounter { width: c.widths.period }),
        /// Steps of arcs.
        pub interpolator: Part<CircularInterpolator>(c.circular()) if c.arcs,
        /// Points of arcs.
        pub cordic: Part<Cordic>(c.circular().cordic()) if c.arcs,
        /// Motor controller 5.
        pub controller: Part<MotorController>(c.controller()),
        /// Divider of the motor controller.
        pub divider: Part<MulDiv>(c.controller().divider()),
        /// Pulse generators 6x, 6y.
        pub trains: [Part<PulseTrain>(PulseTrain {
            half_period: c.widths.half_period,
            pulses: c.widths.distance + 1,
        }); c.axes] as Elements(&AXIS_NAMES),
    }
    /// Output ports.
    pub struct Net {
        /// Step pulses; a step is a rising edge.
        pub step: [Bit; c.axes] as Elements(group::STEP),
        /// Directions; high counts down.
        pub dir: [Bit; c.axes] as Elements(group::DIR),
        /// RST: high in the last tick of the unit time.
        pub unit_rst: Bit,
        /// Ready: a move is accepted.
        pub ready: Bit,
        /// A unit time of a move is running.
        pub busy: Bit,
        /// A unit time without pulses follows, because the next unit time of the move is not
        /// prepared.
        pub late: Bit,
    }
}

impl Circuit for Conventional {
    const NAME: &'static str = "conventional_pulse_interpolator";
    const ABOUT: &'static str = "conventional device: a motor controller and pulse generators";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let counter = p.counter.settle(enable_counter::In {
            period: p.unit_time.q.active,
        });
        let unit_rst = counter.w.enable;
        let (mut order, mut idle) = (i.order, None);
        if let (Some(interpolator), Some(cordic), Some(arc)) = (p.interpolator, p.cordic, i.arc) {
            let point = cordic.settle(cordic::In {
                start: interpolator.q.start,
                radius: interpolator.q.wide_radius,
                angle: interpolator.q.place,
                ..cordic::In::low(&self.circular().cordic())
            });
            let interpolator = interpolator.settle(circular_interpolator::In {
                order,
                arc,
                pending: p.controller.q.pending,
                done: point.w.done,
                along: point.w.along,
                across: point.w.across,
            });
            order = interpolator.w.next_order;
            idle = Some(interpolator.w.idle);
        }
        let controller = p.controller.settle(motor_controller::In {
            order,
            unit_rst,
            done: p.divider.q.done,
            quotient: p.divider.q.quotient,
            remainder: p.divider.q.remainder,
        });
        p.divider.settle(mul_div::In {
            start: controller.q.start,
            product_only: Bit::low(),
            multiplicand: controller.w.dividend,
            multiplier: U::new(1, 1),
            addend: controller.w.addend,
            divisor: controller.w.divisor,
        });
        p.unit_time.settle(unit_time_register::In {
            unit_rst,
            take: controller.w.prepared,
            take_period: controller.q.unit_period,
            ..unit_time_register::In::low(&self.unit_time())
        });
        let trains = settle_each(p.trains, |axis| pulse_train::In {
            load: unit_rst,
            half_period: controller.q.words[axis].half_period,
            // In a unit time that is not prepared there are no pulses.
            pulses: controller
                .w
                .prepared
                .mux(controller.q.words[axis].amount, 0),
            down: controller.q.words[axis].down,
        });
        let net = Net {
            step: trains.iter().map(|train| train.q.step).collect(),
            dir: trains.iter().map(|train| train.q.dir).collect(),
            unit_rst,
            ready: idle.unwrap_or(controller.w.ready),
            busy: controller.q.busy,
            late: controller.w.late,
        };
        (net, Nothing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::LastTicks;

    /// A move with its unit time.
    type Given<'a> = (&'a [i64], u64, u64);

    /// Plays moves in sequence; calls `see` with the position and the pulses of each axis at the
    /// end of every unit, and returns how many came late.
    fn play(
        circuit: &Conventional,
        moves: &[Given<'_>],
        mut see: impl FnMut(u64, &[i64], &[u64]),
    ) -> u64 {
        let mut simulator = LastTicks::simulator(circuit).unwrap();
        let axes = circuit.axes;
        let (mut positions, mut pulses) = (vec![0i64; axes], vec![0; axes]);
        let (mut before, mut late, mut given, mut begun) = (vec![false; axes], 0, 0, 0);
        let total: u64 = moves.iter().map(|(_, units, _)| units).sum();
        let mut unit = 0;
        for tick in 0u64.. {
            let ready = simulator.see(|s| s.w.ready);
            let now = moves.get(given).filter(|_| ready);
            simulator.set(|i| i.order.command, now.is_some()).unwrap();
            if let Some((delta, units, period)) = now {
                for (axis, steps) in delta.iter().enumerate() {
                    simulator.set(|i| i.order.delta[axis], *steps).unwrap();
                }
                simulator.set(|i| i.order.units, *units).unwrap();
                simulator.set(|i| i.order.period, *period).unwrap();
                given += 1;
            }
            let step: Vec<_> = (0..axes)
                .map(|axis| simulator.see(|s| s.w.step[axis]))
                .collect();
            for axis in 0..axes {
                if step[axis] && !before[axis] {
                    let down = simulator.see(|s| s.w.dir[axis]);
                    positions[axis] += if down { -1 } else { 1 };
                    pulses[axis] += 1;
                }
            }
            before = step;
            if simulator.see(|s| s.w.unit_rst) {
                if simulator.see(|s| s.w.busy) {
                    see(tick + 1 - begun, &positions, &pulses);
                    unit += 1;
                    if unit == total {
                        break;
                    }
                }
                late += u64::from(simulator.see(|s| s.w.late) && unit > 0);
                pulses.fill(0);
                begun = tick + 1;
            }
            simulator.step();
        }
        late
    }

    /// |delta|·u/units, rounded, with its sign.
    fn due(delta: i64, unit: u64, units: u64) -> i64 {
        let steps = (2 * delta.unsigned_abs() * unit + units) / (2 * units);
        steps as i64 * delta.signum()
    }

    fn holds(axes: usize, moves: &[Given<'_>], late: u64) {
        let circuit = Conventional {
            axes,
            widths: ConventionalWidths::default(),
            period: 10,
            arcs: false,
        };
        let mut expected = Vec::new();
        let mut from = vec![0; axes];
        for &(delta, units, period) in moves {
            for unit in 1..=units {
                let at: Vec<_> = (0..axes)
                    .map(|k| from[k] + due(delta[k], unit, units))
                    .collect();
                expected.push((period, at));
            }
            from = expected.last().unwrap().1.clone();
        }
        let mut expected = expected.into_iter();
        let mut before = vec![0i64; axes];
        let found = play(&circuit, moves, |ticks, positions, pulses| {
            let (period, at) = expected.next().unwrap();
            assert_eq!((ticks, positions), (period, &at[..]));
            for axis in 0..axes {
                assert_eq!(pulses[axis], before[axis].abs_diff(at[axis]));
            }
            before = at;
        });
        assert_eq!((found, expected.next()), (late, None));
    }

    #[test]
    fn every_unit_has_the_steps_of_a_straight_line() {
        // Any number of pulses up to T/2, in both directions, also of nearly all words.
        holds(
            2,
            &[
                (&[400, -37], 1, 800),
                (&[-1, 0], 7, 801),
                (&[1000, 999], 13, 500),
            ],
            0,
        );
        holds(
            3,
            &[
                (&[-65_536, 65_535, 3], 500, 300),
                (&[0, 0, 0], 2, 170),
                (&[5, -5, 1], 3, 200),
            ],
            0,
        );
        holds(8, &[(&[1, -2, 3, -4, 5, -6, 7, -8], 9, 436)], 0);
    }

    #[test]
    fn a_unit_that_takes_longer_to_compute_than_it_lasts_comes_late_and_whole() {
        for axes in 1..=8 {
            let controller = Conventional {
                axes,
                widths: ConventionalWidths::default(),
                period: 1,
                arcs: false,
            };
            let least = controller.controller().least_period();
            assert_eq!(least, 3 + 54 * axes as u64);
            let delta = vec![3; axes];
            // A single move of three units, and three moves of one unit.
            let one = |period| [(&delta[..], 3, period)];
            let three = |period| [(&delta[..], 1, period); 3];
            holds(axes, &one(least - 1), 0);
            holds(axes, &one(least - 2), 2);
            holds(axes, &three(least), 0);
            holds(axes, &three(least - 1), 2);
        }
    }

    #[test]
    fn more_pulses_than_fit_are_not_begun() {
        let circuit = Conventional {
            axes: 1,
            widths: ConventionalWidths::default(),
            period: 10,
            arcs: false,
        };
        for (steps, made) in [(50, 50), (51, 0), (200, 0)] {
            let mut seen = Vec::new();
            play(&circuit, &[(&[steps], 1, 100)], |_, at, _| seen.push(at[0]));
            assert_eq!(seen, [made]);
        }
    }
}
