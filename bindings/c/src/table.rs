//! Values behind integer handles.
//!
//! A handle is the index of a slot, the generation of the slot and the kind of the table. A number
//! that was never given out, a handle of a freed value and a handle of the other kind are therefore
//! refused. A generation returns after 8,191 values in one slot.

use crate::codes::{MRTL_BUSY, MRTL_PANIC, MRTL_WRONG_HANDLE};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;
use std::sync::atomic::Ordering::{Acquire, Relaxed, Release};
use std::sync::atomic::{AtomicI32, AtomicPtr, AtomicU8, AtomicU32};
use std::sync::{Mutex, MutexGuard, PoisonError};

const INDEX_BITS: u32 = 16;
const SLOTS: usize = 1 << INDEX_BITS;
const GENERATIONS: i32 = (1 << 13) - 1;

/// No call is running.
const IDLE: u8 = 0;
/// A call is running.
const BUSY: u8 = 1;
/// A call has panicked.
const BROKEN: u8 = 2;

/// Values of one kind. All bytes of an empty table are zero, so it takes no space in the library.
pub struct Table<T, const KIND: i32> {
    slots: [Slot<T>; SLOTS],
    free: Mutex<Free>,
}

struct Slot<T> {
    /// Handle of the value; negative if the value was freed, 0 if there never was one.
    handle: AtomicI32,
    /// Next free slot, plus one.
    next: AtomicU32,
    state: AtomicU8,
    value: AtomicPtr<T>,
}

/// Slots without a value.
struct Free {
    /// First slot of the list of freed ones, plus one.
    freed: u32,
    /// Slots from this one on never had a value.
    unused: u32,
}

/// Reason why a value cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// No value has the handle.
    Wrong,
    /// Another call is using the value.
    Busy,
    /// This call, or one before it, has panicked.
    Panicked,
}

impl Refusal {
    /// Returns the code of the error.
    pub fn code(self) -> i32 {
        match self {
            Refusal::Wrong => MRTL_WRONG_HANDLE,
            Refusal::Busy => MRTL_BUSY,
            Refusal::Panicked => MRTL_PANIC,
        }
    }

    /// Returns the text of the error about a model or a snapshot.
    pub fn text(self, what: &str, handle: i32) -> String {
        match self {
            Refusal::Wrong => format!("no {what} has the handle {handle}"),
            Refusal::Busy => format!("{what} {handle}: another thread is inside a call with it"),
            Refusal::Panicked => {
                format!("{what} {handle}: a fault inside the library; it can only be freed")
            }
        }
    }
}

impl<T> Slot<T> {
    const fn new() -> Self {
        Slot {
            handle: AtomicI32::new(0),
            next: AtomicU32::new(0),
            state: AtomicU8::new(IDLE),
            value: AtomicPtr::new(null_mut()),
        }
    }
}

impl<T: Send, const KIND: i32> Table<T, KIND> {
    pub const fn new() -> Self {
        Table {
            slots: [const { Slot::new() }; SLOTS],
            free: Mutex::new(Free {
                freed: 0,
                unused: 0,
            }),
        }
    }

    fn free_slots(&self) -> MutexGuard<'_, Free> {
        self.free.lock().unwrap_or_else(PoisonError::into_inner)
    }

    #[inline]
    fn slot(&self, handle: i32) -> &Slot<T> {
        &self.slots[handle as u32 as usize & (SLOTS - 1)]
    }

    /// Stores a value and returns its handle, which is positive; `None` if all slots are taken.
    pub fn insert(&self, value: T) -> Option<i32> {
        let mut free = self.free_slots();
        let index = match free.freed {
            0 if (free.unused as usize) < SLOTS => {
                free.unused += 1;
                free.unused - 1
            }
            0 => return None,
            next => {
                free.freed = self.slots[next as usize - 1].next.load(Relaxed);
                next - 1
            }
        };
        let slot = &self.slots[index as usize];
        let generation = (-slot.handle.load(Relaxed) >> INDEX_BITS) & GENERATIONS;
        let generation = generation % GENERATIONS + 1;
        let handle = KIND | generation << INDEX_BITS | index as i32;
        slot.value.store(Box::into_raw(Box::new(value)), Relaxed);
        slot.state.store(IDLE, Relaxed);
        slot.handle.store(handle, Release);
        Some(handle)
    }

    /// Calls a function with a value. A panic of the function is caught, and the value is refused
    /// from then on.
    ///
    /// # Errors
    /// Returns an error if no value has the handle, a call is using the value, or a call panics or
    /// has panicked.
    ///
    /// # Safety
    /// Calls with one handle, and [`remove`](Self::remove) with it, do not overlap in time, and
    /// whoever makes the next one has seen the end of the last.
    #[inline]
    pub unsafe fn with<R>(
        &self,
        handle: i32,
        call: impl FnOnce(&mut T) -> R,
    ) -> Result<R, Refusal> {
        let slot = self.slot(handle);
        if slot.handle.load(Acquire) != handle || handle <= 0 {
            return Err(Refusal::Wrong);
        }
        match slot.state.load(Relaxed) {
            IDLE => slot.state.store(BUSY, Relaxed),
            BUSY => return Err(Refusal::Busy),
            _ => return Err(Refusal::Panicked),
        }
        // SAFETY: the slot has this handle, so the pointer is that of `insert` and not yet freed.
        // No other reference to the value exists, since calls with one handle do not overlap by
        // this function's contract, and a nested call finds the slot busy.
        let value = unsafe { &mut *slot.value.load(Relaxed) };
        match catch_unwind(AssertUnwindSafe(|| call(value))) {
            Ok(result) => {
                slot.state.store(IDLE, Relaxed);
                Ok(result)
            }
            Err(payload) => {
                slot.state.store(BROKEN, Relaxed);
                // Its destructor could panic too.
                std::mem::forget(payload);
                Err(Refusal::Panicked)
            }
        }
    }

    /// Drops a value; its handle is wrong from then on.
    ///
    /// # Errors
    /// Returns an error if no value has the handle, a call is using the value, or its destructor
    /// panics.
    ///
    /// # Safety
    /// That of [`with`](Self::with).
    pub unsafe fn remove(&self, handle: i32) -> Result<(), Refusal> {
        let value = {
            let mut free = self.free_slots();
            let slot = self.slot(handle);
            if slot.handle.load(Acquire) != handle || handle <= 0 {
                return Err(Refusal::Wrong);
            }
            if slot.state.load(Relaxed) == BUSY {
                return Err(Refusal::Busy);
            }
            slot.handle.store(-handle, Release);
            slot.next.store(free.freed, Relaxed);
            free.freed = (handle as u32 & (SLOTS as u32 - 1)) + 1;
            slot.value.swap(null_mut(), Relaxed)
        };
        // SAFETY: the pointer came from `Box::into_raw` in `insert`. The slot had this handle under
        // the lock and has it no more, so nothing else frees the pointer or finds it again.
        let value = unsafe { Box::from_raw(value) };
        catch_unwind(AssertUnwindSafe(|| drop(value))).map_err(|payload| {
            std::mem::forget(payload);
            Refusal::Panicked
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Numbers = Table<u64, { 1 << 30 }>;

    fn with(table: &Numbers, handle: i32) -> Result<u64, Refusal> {
        // SAFETY: each table of these tests is used by one thread.
        unsafe { table.with(handle, |value| *value) }
    }

    fn remove(table: &Numbers, handle: i32) -> Result<(), Refusal> {
        // SAFETY: each table of these tests is used by one thread.
        unsafe { table.remove(handle) }
    }

    #[test]
    fn values_are_found_by_their_own_handles_only() {
        static TABLE: Numbers = Table::new();
        let [a, b] = [5, 6].map(|value| TABLE.insert(value).unwrap());
        assert_eq!((with(&TABLE, a), with(&TABLE, b)), (Ok(5), Ok(6)));
        for wrong in [
            0,
            -1,
            -a,
            i32::MIN,
            i32::MAX,
            b + 1,
            a ^ (1 << 30),
            a + (1 << 16),
        ] {
            assert_eq!(with(&TABLE, wrong), Err(Refusal::Wrong), "{wrong}");
            assert_eq!(remove(&TABLE, wrong), Err(Refusal::Wrong), "{wrong}");
        }
        assert_eq!(remove(&TABLE, a), Ok(()));
        assert_eq!(
            (with(&TABLE, a), with(&TABLE, b)),
            (Err(Refusal::Wrong), Ok(6))
        );
        assert_eq!(remove(&TABLE, a), Err(Refusal::Wrong));
    }

    #[test]
    fn a_freed_handle_stays_wrong_when_its_slot_is_used_again() {
        static TABLE: Numbers = Table::new();
        let first = TABLE.insert(1).unwrap();
        remove(&TABLE, first).unwrap();
        let mut last = first;
        for _ in 1..GENERATIONS {
            let next = TABLE.insert(2).unwrap();
            assert!(next > 0 && next != first && next != last);
            assert_eq!((next & 0xffff, next >> 30), (first & 0xffff, 1));
            assert_eq!(with(&TABLE, first), Err(Refusal::Wrong));
            assert_eq!(with(&TABLE, last), Err(Refusal::Wrong));
            remove(&TABLE, next).unwrap();
            last = next;
        }
        assert_eq!(TABLE.insert(3), Some(first), "generations begin again");
    }

    #[test]
    fn a_full_table_takes_a_value_when_one_was_freed() {
        static TABLE: Numbers = Table::new();
        let handles: Vec<i32> = (0..SLOTS as u64)
            .map_while(|value| TABLE.insert(value))
            .collect();
        assert_eq!((handles.len(), TABLE.insert(0)), (SLOTS, None));
        assert_eq!(with(&TABLE, handles[40_000]), Ok(40_000));
        remove(&TABLE, handles[7]).unwrap();
        let last = TABLE.insert(99).unwrap();
        assert_eq!((with(&TABLE, last), TABLE.insert(0)), (Ok(99), None));
    }

    #[test]
    fn a_panic_is_caught_and_the_value_refused_afterwards() {
        static TABLE: Numbers = Table::new();
        let handle = TABLE.insert(1).unwrap();
        // SAFETY: one thread uses the table.
        let caught = unsafe { TABLE.with(handle, |_| -> u64 { panic!("planted") }) };
        assert_eq!(caught, Err(Refusal::Panicked));
        assert_eq!(with(&TABLE, handle), Err(Refusal::Panicked));
        assert_eq!(remove(&TABLE, handle), Ok(()));
        assert_eq!(with(&TABLE, handle), Err(Refusal::Wrong));
        let next = TABLE.insert(2).unwrap();
        assert_eq!(with(&TABLE, next), Ok(2));
    }

    #[test]
    fn a_value_in_use_is_busy() {
        static TABLE: Numbers = Table::new();
        let handle = TABLE.insert(1).unwrap();
        // SAFETY: one thread uses the table, and the inner calls are refused.
        let inner =
            unsafe { TABLE.with(handle, |_| (with(&TABLE, handle), remove(&TABLE, handle))) };
        assert_eq!(inner, Ok((Err(Refusal::Busy), Err(Refusal::Busy))));
        assert_eq!(with(&TABLE, handle), Ok(1));
    }

    #[test]
    fn a_destructor_that_panics_frees_its_slot() {
        struct Bomb;
        impl Drop for Bomb {
            fn drop(&mut self) {
                panic!("planted");
            }
        }
        static TABLE: Table<Bomb, 0> = Table::new();
        let handle = TABLE.insert(Bomb).unwrap();
        // SAFETY: one thread uses the table.
        let removed = unsafe { [TABLE.remove(handle), TABLE.remove(handle)] };
        assert_eq!(removed, [Err(Refusal::Panicked), Err(Refusal::Wrong)]);
    }
}
