//! The position pattern generator as a program: a cycle is a list of weights, and every tick at
//! which something happens is known beforehand.

/// Input ports in a tick.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ports {
    pub start: bool,
    pub from: i64,
    pub distance: i64,
    pub speed: u64,
    pub times: [u64; 2],
    pub advance: bool,
    pub halt: bool,
}

/// Output ports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outputs {
    pub position: i64,
    pub valid: bool,
    pub ready: bool,
    pub active: bool,
}

/// A cycle in plain numbers; its scans count from 0.
#[derive(Debug, Clone)]
pub struct Plan {
    pub distance: i128,
    pub up: i128,
    pub steady: i128,
    pub down: i128,
    /// All weights together.
    pub whole: i128,
}

impl Plan {
    /// With positions of `p` bits and times of `t`, which are the bits of the speed's fraction too.
    pub fn new(ports: &Ports, [p, t]: [u32; 2]) -> Self {
        let [up, down] = ports.times.map(|time| i128::from(time.max(1)));
        let speed = i128::from(ports.speed.max(1));
        let distance = i128::from(ports.distance);
        // The fewest scans with which no step is longer than V.
        let rest = ((2 * distance.abs()) << t) - speed * (up + down);
        let steady = match rest > 0 {
            true => rest.div_euclid(2 * speed) + i128::from(rest % (2 * speed) > 0),
            false => 0,
        };
        // The count is limited: the cycle goes faster then.
        let steady = steady.min((1 << (p - 1)) - 1);
        let whole = up * down * (up + 2 * steady + down);
        Plan {
            distance,
            up,
            steady,
            down,
            whole,
        }
    }

    pub fn scans(&self) -> i128 {
        self.up + self.steady + self.down
    }

    pub fn weight(&self, scan: i128) -> i128 {
        let to_go = self.scans() - scan;
        if scan < self.up {
            (2 * scan + 1) * self.down
        } else if to_go > self.down {
            2 * self.up * self.down
        } else {
            (2 * to_go - 1) * self.up
        }
    }

    /// Twice the speed between two scans.
    fn speed_after(&self, scans: i128) -> i128 {
        let to_go = self.scans() - scans;
        2 * (scans * self.down)
            .min(to_go * self.up)
            .min(self.up * self.down)
    }

    /// The weights of the ramp down that an abort after so many scans brings.
    pub fn stop(&self, scans: i128) -> Vec<i128> {
        let (mut weights, mut speed) = (Vec::new(), self.speed_after(scans));
        while speed >= 2 * self.up {
            weights.push(speed - self.up);
            speed -= 2 * self.up;
        }
        weights.extend((speed > 0).then_some(speed / 2));
        weights
    }

    /// Distance gone with weights of that sum.
    pub fn gone(&self, sum: i128) -> i128 {
        (self.distance.abs() * sum).div_euclid(self.whole) * self.distance.signum()
    }
}

#[derive(Debug)]
struct Cycle {
    plan: Plan,
    from: i128,
    /// The tick in which the multiplier-divider takes the first step of the preparation.
    begun: u64,
    ready_at: u64,
    /// Scans made, and the sum of their weights.
    scans: i128,
    sum: i128,
    /// The tick of `valid` of the scan that runs, and its weight.
    running: Option<(u64, i128)>,
    /// The weights yet to come after an abort.
    stopping: Option<std::vec::IntoIter<i128>>,
}

/// The generator with positions of `p` bits and times of `t`.
#[derive(Debug)]
pub struct Program {
    p: u32,
    t: u32,
    multiply: u64,
    divide: u64,
    tick: u64,
    cycle: Option<Cycle>,
    position: i128,
    valid: bool,
    /// The first tick in which the multiplier-divider can begin.
    free: u64,
}

impl Program {
    pub fn new(p: u32, t: u32) -> Self {
        Program {
            p,
            t,
            multiply: u64::from(2 * t + 1),
            divide: u64::from(p + 2 * t + 2),
            tick: 0,
            cycle: None,
            position: 0,
            valid: false,
            free: 0,
        }
    }

    /// The plan of the cycle that is under way.
    pub fn plan(&self) -> Option<&Plan> {
        self.cycle.as_ref().map(|cycle| &cycle.plan)
    }

    pub fn outputs(&self) -> Outputs {
        let wrapped = self.position << (128 - self.p) >> (128 - self.p);
        Outputs {
            position: wrapped as i64,
            valid: self.valid,
            ready: self
                .cycle
                .as_ref()
                .is_some_and(|cycle| cycle.running.is_none() && self.tick >= cycle.ready_at),
            active: self.cycle.is_some(),
        }
    }

    /// Ticks of the four steps of the preparation, from the start of one to that of the next.
    fn steps(&self) -> [u64; 4] {
        let product = self.multiply + 2;
        [product, product + self.divide, product, product]
    }

    fn start(&mut self, i: &Ports) {
        self.position = i.from.into();
        if i.distance == 0 || i.halt {
            return;
        }
        let begun = self.free.max(self.tick + 1);
        self.cycle = Some(Cycle {
            plan: Plan::new(i, [self.p, self.t]),
            from: i.from.into(),
            begun,
            ready_at: begun + self.steps().iter().sum::<u64>(),
            scans: 0,
            sum: 0,
            running: None,
            stopping: None,
        });
    }

    /// The tick's rising edge.
    pub fn edge(&mut self, i: &Ports) {
        let (tick, ready, steps) = (self.tick, self.outputs().ready, self.steps());
        let length = 1 + self.multiply + self.divide;
        self.valid = false;
        self.tick += 1;
        let Some(cycle) = &mut self.cycle else {
            self.tick = tick;
            if i.start {
                self.start(i);
            }
            self.tick = tick + 1;
            return;
        };
        let mut ended = false;
        if i.halt && cycle.stopping.is_none() {
            if tick < cycle.ready_at {
                // The step under way is left to finish.
                let mut begun = cycle.begun;
                for step in steps {
                    if (begun..begun + step).contains(&tick) {
                        self.free = begun + step - 1;
                    }
                    begun += step;
                }
                ended = true;
            } else {
                let scans = cycle.scans + i128::from(cycle.running.is_some());
                cycle.stopping = Some(cycle.plan.stop(scans).into_iter());
                ended = scans == 0;
            }
        }
        if i.advance && ready && !ended {
            let weight = match &mut cycle.stopping {
                Some(weights) => weights.next().expect("it goes on"),
                None => cycle.plan.weight(cycle.scans),
            };
            cycle.running = Some((tick + 1 + length + 1, weight));
        }
        if let Some((_, weight)) = cycle.running.take_if(|(at, _)| *at == tick + 1) {
            cycle.scans += 1;
            cycle.sum += weight;
            self.position = cycle.from + cycle.plan.gone(cycle.sum);
            self.valid = true;
            ended = match &cycle.stopping {
                Some(weights) => weights.len() == 0,
                None => cycle.scans == cycle.plan.scans(),
            };
        }
        if ended {
            self.cycle = None;
        }
    }
}
