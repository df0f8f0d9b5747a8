//! The group against a second model of it, written as a program, under random control computers.

use super::common::{self, widths};
use motion_rtl::circuits::pulse_interpolator::Variant::Safe;
use motion_rtl::circuits::pulse_interpolator::group::{Group, In};
use motion_rtl::circuits::pulse_interpolator::pattern_memory::WritePort;
use motion_rtl::hdl::{Value, zero};
use proptest::prelude::*;

const WORDS: u64 = 4;
type Port = In<Value>;

#[derive(Debug, Clone, Copy)]
struct Command {
    base: u64,
    last: u64,
    cyclic: bool,
    run: bool,
    now: bool,
    period: u64,
}

/// The group as a program: unit times of so many ticks, each with a waveform.
#[derive(Debug)]
struct Program {
    memory: [[(u64, bool); WORDS as usize]; 2],
    playing: Option<Command>,
    waiting: Option<Command>,
    address: u64,
    period: u64,
    next_period: u64,
    /// Ticks of the unit time that are over.
    elapsed: u64,
    words: [(u64, bool); 2],
}

impl Program {
    fn new(period: u64) -> Self {
        Program {
            memory: [[(0, false); WORDS as usize]; 2],
            playing: None,
            waiting: None,
            address: 0,
            period,
            next_period: period,
            elapsed: 0,
            words: [(0, false); 2],
        }
    }

    fn is_last_tick(&self, i: &Port) -> bool {
        i.unit_end || self.elapsed + 1 >= self.period
    }

    /// Step, direction; then unit_rst, ready, busy.
    fn outputs(&self, i: &Port) -> ([(bool, bool); 2], [bool; 3]) {
        let lines = self
            .words
            .map(|(n, dir)| (n > 0 && self.elapsed / n % 2 == 1, dir));
        let flags = [
            self.is_last_tick(i),
            self.waiting.is_none(),
            self.playing.is_some(),
        ];
        (lines, flags)
    }

    fn begin_unit(&mut self) {
        self.elapsed = 0;
        self.period = self.next_period;
        let ended = match self.playing {
            None => true,
            Some(command) => self.address == command.last,
        };
        match self.waiting {
            Some(command) if ended || command.now => {
                self.waiting = None;
                self.period = command.period;
                self.next_period = command.period;
                self.playing = command.run.then_some(command);
                if command.run {
                    self.address = command.base;
                }
            }
            _ => match self.playing {
                Some(command) if ended && command.cyclic => self.address = command.base,
                Some(_) if ended => self.playing = None,
                Some(_) => self.address = (self.address + 1) % WORDS,
                None => {}
            },
        }
        for (word, memory) in self.words.iter_mut().zip(&self.memory) {
            match self.playing {
                Some(_) => *word = memory[self.address as usize],
                None => word.0 = 0,
            }
        }
    }

    fn tick(&mut self, i: &Port) {
        let was_waiting = self.waiting.is_some();
        if self.is_last_tick(i) {
            self.begin_unit();
        } else {
            self.elapsed += 1;
        }
        if i.write_period {
            self.next_period = i.period;
        }
        if i.command && (!was_waiting || i.now) {
            self.waiting = Some(Command {
                base: i.base,
                last: i.last,
                cyclic: i.cyclic,
                run: i.run,
                now: i.now,
                period: i.period,
            });
        }
        let port = &i.port;
        if port.write && port.write_axis < 2 {
            self.memory[port.write_axis as usize][port.write_address as usize] =
                (port.write_half_period, port.write_direction);
        }
    }
}

/// A control computer that is busy now and then.
fn port() -> impl Strategy<Value = Port> {
    let flags = any::<[bool; 6]>();
    let words = [0..4u64, 0..4, 0..8, 0..4, 0..8, 0..3];
    (0..8u8, flags, words).prop_map(|(act, flags, words)| {
        let [cyclic, run, now, halt, dir, set] = flags;
        let [base, last, period, address, half_period, axis] = words;
        Port {
            command: act == 0,
            base,
            last,
            cyclic,
            run: run || !halt,
            now,
            period,
            write_period: act == 1 && set,
            unit_end: act == 2 && set && dir,
            port: WritePort {
                write: act >= 5,
                write_axis: axis,
                write_address: address,
                write_half_period: half_period,
                write_direction: dir,
            },
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_circuit_does_what_the_program_does(
        period in 0..8u64,
        ports in prop::collection::vec(port(), 1..600),
    ) {
        let circuit = Group::new(2, widths(3, 3, 2), Safe, period);
        let mut program = Program::new(period);
        let mut expected = Vec::new();
        for port in &ports {
            expected.push(program.outputs(port));
            program.tick(port);
        }
        let drive = |tick: u64| {
            ports.get(tick as usize).cloned().unwrap_or_else(|| zero(&circuit))
        };
        let seen = common::run(&circuit, ports.len() as u64, drive, |now| {
            let lines = [0, 1].map(|axis| (now.w.step[axis], now.w.dir[axis]));
            (lines, [now.w.unit_rst, now.w.ready, now.w.busy])
        });
        for (tick, (expected, seen)) in expected.iter().zip(&*seen).enumerate() {
            assert_eq!(expected, seen, "tick {tick}");
        }
    }
}
