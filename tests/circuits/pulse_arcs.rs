//! Arcs on the conventional pulse interpolator: amounts against exact points, in their unit times.

use motion_rtl::check::Random;
use motion_rtl::circuits::blocks::cordic_state::GAIN;
use motion_rtl::circuits::pulse_interpolator::circular_interpolator::{ArcMove, GUARD};
use motion_rtl::circuits::pulse_interpolator::conventional::{Conventional, In};
use motion_rtl::circuits::pulse_interpolator::motor_controller::ConventionalWidths;
use motion_rtl::hdl::{Value, zero};
use motion_rtl::trace::LastTicks;
use std::f64::consts::TAU;

/// Angles have so many bits.
const ANGLE: f64 = 32.0;

/// An arc, or a straight move where its radius is 0.
#[derive(Debug, Clone, Copy, Default)]
struct Arc {
    /// In steps.
    radius: f64,
    /// Angle of the first point.
    angle: u64,
    /// Angle turned in a unit time.
    turn: u64,
    units: u64,
    straight: [i64; 2],
}

impl Arc {
    /// The exact point behind so many unit times.
    fn point(&self, unit: u64) -> [f64; 2] {
        let units = u128::from(self.angle) + u128::from(unit) * u128::from(self.turn);
        let angle = (units % (1 << 32)) as f64 * TAU / ANGLE.exp2();
        [angle.cos(), angle.sin()].map(|part| self.radius * part)
    }
}

fn device(axes: usize) -> Conventional {
    Conventional {
        axes,
        widths: ConventionalWidths::default(),
        period: 500,
        arcs: true,
    }
}

/// Plays arcs one behind the other at T: where all axes are at the end of every unit time, and how
/// many came late.
fn play(axes: usize, period: u64, arcs: &[Arc]) -> (Vec<Vec<i64>>, u64) {
    let circuit = device(axes);
    let mut simulator = LastTicks::simulator(&circuit).unwrap();
    let total: u64 = arcs.iter().map(|arc| arc.units).sum();
    let (mut at, mut before) = (vec![0i64; axes], vec![false; axes]);
    let (mut ends, mut late, mut given) = (Vec::new(), 0, 0);
    while (ends.len() as u64) < total {
        let ready = simulator.see(|s| s.w.ready);
        let mut i: In<Value> = zero(&circuit);
        if let Some(arc) = arcs.get(given).filter(|_| ready) {
            (i.order.command, i.order.units, i.order.period) = (true, arc.units, period);
            i.order.delta[..2].copy_from_slice(&arc.straight);
            i.arc = Some(ArcMove {
                circular: arc.radius > 0.0,
                radius: (arc.radius / GAIN * (1 << GUARD) as f64).round() as u64,
                angle: arc.angle,
                turn: arc.turn,
            });
            given += 1;
        }
        for axis in 0..axes {
            let step = simulator.see(|s| s.w.step[axis]);
            if step && !before[axis] {
                let down = simulator.see(|s| s.w.dir[axis]);
                at[axis] += if down { -1 } else { 1 };
            }
            before[axis] = step;
        }
        if simulator.see(|s| s.w.unit_rst) {
            late += u64::from(simulator.see(|s| s.w.late) && !ends.is_empty());
            if simulator.see(|s| s.w.busy) {
                ends.push(at.clone());
            }
        }
        simulator.step_with(&i, |_| ()).unwrap();
    }
    (ends, late)
}

/// The ends of all unit times are those of the exact arc, rounded, but for what a CORDIC is off.
fn holds(axes: usize, period: u64, arcs: &[Arc]) {
    let (ends, late) = play(axes, period, arcs);
    assert_eq!(late, 0);
    let mut ends = ends.into_iter();
    let mut from = [0i64; 2];
    for arc in arcs {
        let begin = arc.point(0).map(|part| (part + 0.5).floor());
        for unit in 1..=arc.units {
            let end = ends.next().unwrap();
            assert!(end[2..].iter().all(|&other| other == 0));
            for k in 0..2 {
                let way = match arc.radius > 0.0 {
                    true => arc.point(unit)[k] - begin[k],
                    false => (arc.straight[k] * unit as i64) as f64 / arc.units as f64,
                };
                // Half a step, and the point of the CORDIC by less than a quarter.
                let off = ((end[k] - from[k]) as f64 - way).abs();
                assert!(off < 0.75, "{arc:?}, unit {unit}: {off}");
            }
            if unit == arc.units {
                from = [end[0], end[1]];
            }
        }
    }
}

#[test]
fn the_steps_of_an_arc_are_those_of_its_points() {
    let quarter = 1u64 << 30;
    let backwards = (1u64 << 32) - quarter / 16;
    let straight = Arc {
        units: 3,
        straight: [7, -40],
        ..Arc::default()
    };
    let arc = |radius, angle, turn, units| Arc {
        radius,
        angle,
        turn,
        units,
        ..Arc::default()
    };
    holds(2, 500, &[arc(100.0, 0, quarter / 8, 16), straight]);
    holds(3, 600, &[straight, arc(1000.5, quarter * 3, backwards, 40)]);
    holds(4, 60_000, &[arc(65_000.0, 12_345, quarter / 4, 3)]);
    let mut random = Random::new(8);
    for _ in 0..12 {
        let radius = 1.0 + (random.word() % 100_000) as f64 / 100.0;
        let turn = random.word() % (quarter / 16);
        holds(
            2,
            400,
            &[arc(radius, random.word() >> 32, turn, 12), straight],
        );
    }
}

#[test]
fn a_whole_turn_ends_where_it_began() {
    // A hundred turns: nothing is lost or doubled by rounding.
    let arc = Arc {
        radius: 333.3,
        angle: 98_765,
        turn: 1 << 27,
        units: 3200,
        ..Arc::default()
    };
    let (ends, late) = play(2, 200, &[arc]);
    assert_eq!((late, ends.len()), (0, 3200));
    for turn in ends.chunks(32) {
        assert_eq!(turn[31], [0, 0]);
        assert_eq!(turn[15], ends[15]);
    }
}

#[test]
fn an_arc_is_made_while_the_amounts_before_are_divided() {
    let circular = device(2).circular();
    assert_eq!(circular.latency(), [69, 35]);
    let arc = Arc {
        radius: 20.0,
        turn: 1 << 28,
        units: 20,
        ..Arc::default()
    };
    for axes in 2..=8 {
        let least = device(axes).controller().least_period();
        assert_eq!(play(axes, least, &[arc]).1, 0, "{axes}");
        assert!(play(axes, least - 1, &[arc]).1 > 0, "{axes}");
    }
}
