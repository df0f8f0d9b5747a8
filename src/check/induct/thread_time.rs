//! Processor time of a thread.

use std::ops::Add;
use std::time::Duration;

/// Moment in the processor time of the running thread. A limit in this time does not depend on what
/// else the machine does. Where the system does not count it, time is that of a clock on the wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ThreadTime(Duration);

impl ThreadTime {
    pub fn now() -> Self {
        ThreadTime(counted())
    }

    /// Returns the time since then.
    pub fn elapsed(self) -> Duration {
        counted().saturating_sub(self.0)
    }

    /// Returns the time until then.
    pub fn left(self) -> Duration {
        self.0.saturating_sub(counted())
    }
}

impl Add<Duration> for ThreadTime {
    type Output = Self;

    fn add(self, duration: Duration) -> Self {
        ThreadTime(self.0 + duration)
    }
}

#[cfg(unix)]
fn counted() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

#[cfg(not(unix))]
fn counted() -> Duration {
    use std::sync::OnceLock;
    use std::time::Instant;
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread;

    #[test]
    #[cfg(unix)]
    fn a_thread_that_sleeps_takes_no_time() {
        let start = ThreadTime::now();
        thread::sleep(Duration::from_millis(200));
        assert!(start.elapsed() < Duration::from_millis(100));
        let until = start + Duration::from_millis(100);
        assert!(until.left() > Duration::ZERO);
    }

    #[test]
    fn a_thread_that_works_takes_time() {
        let until = ThreadTime::now() + Duration::from_millis(5);
        while until.left() > Duration::ZERO {}
        assert!(ThreadTime::now() >= until);
    }
}
