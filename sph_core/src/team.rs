//! A team of threads that waits awake for the next parallel loop.
//!
//! A loop of a small scene lasts 20 to 300 µs, and a pool whose threads sleep between loops needs some 15 µs to begin and to end
//! one. A team's threads look for the next loop without sleeping, so that beginning and ending one takes less than 1 µs. The chunks of
//! a loop are cut into equal shares, the same from loop to loop, so that the data of a chunk stay in the caches of one core; who has
//! done its own share takes chunks of others'. A thread that the system stops delays at most the chunk it is at.
//!
//! The only `unsafe` of the crate stands here: a loop's closure and the arrays that it changes live on the stack of the thread that
//! begins it, which the threads of a pool, that live longer, may not borrow in safe Rust. What makes it sound is said at each place.

#![allow(unsafe_code)]

use std::any::Any;
use std::cell::{Cell, UnsafeCell};
use std::hint::spin_loop;
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use rayon::prelude::*;

/// Looks for work before a thread lets others run, each time.
const LOOKS: u32 = 2000;

/// Such turns before a thread sleeps, and how long.
const TURNS: u32 = 1000;
const NAP: Duration = Duration::from_micros(100);

/// What is done with chunk c.
type Work<'a> = dyn Fn(usize) + Sync + 'a;

/// The loop that is under way.
#[derive(Clone, Copy)]
struct Loop {
    work: *const Work<'static>,
    chunks: usize,
}

/// Chunks of one member's share that are not taken; alone in its cache lines.
#[repr(align(128))]
struct Share(AtomicUsize);

struct Team {
    /// Of each thread of the pool.
    shares: Box<[Share]>,
    /// The thread that begins loops.
    leader: usize,
    /// Written by the leader while no share has a chunk left and none is at work; read by who has taken a chunk.
    current: UnsafeCell<Option<Loop>>,
    /// Chunks that are not done.
    unfinished: AtomicUsize,
    /// The leader's task is over.
    over: AtomicBool,
    /// What the first chunk that panicked says.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

// SAFETY: `current` is written by the leader alone, when no member can read it: see `Team::each` and `Team::take`. The closure it
// points to is `Sync`.
unsafe impl Sync for Team {}

thread_local! {
    /// The team that this thread leads; dangling after the task, and so taken away with it.
    static LEADS: Cell<Option<*const Team>> = const { Cell::new(None) };
    /// This thread is at work for a team: loops within a chunk are done by itself.
    static AT_WORK: Cell<bool> = const { Cell::new(false) };
}

impl Team {
    fn of(threads: usize, leader: usize) -> Team {
        Team {
            shares: (0..threads).map(|_| Share(AtomicUsize::new(0))).collect(),
            leader,
            current: UnsafeCell::new(None),
            unfinished: AtomicUsize::new(0),
            over: AtomicBool::new(false),
            panic: Mutex::new(None),
        }
    }

    /// End of a member's share of `chunks`.
    fn end_of(&self, member: usize, chunks: usize) -> usize {
        chunks * (member + 1) / self.shares.len()
    }

    /// `work(c)` for each of `chunks`, by the leader and who else has time. Returns when all are done.
    fn each(&self, chunks: usize, work: &Work<'_>) {
        let work: *const Work<'_> = work;
        // SAFETY: only the lifetime changes. The pointer is followed for chunks of this loop alone, and this function returns when
        // all of them are done. No thread reads `current` now: a member reads it after it took a chunk and before that is done, and all
        // chunks of the loop before are done.
        unsafe {
            *self.current.get() =
                Some(Loop { work: std::mem::transmute::<*const Work<'_>, *const Work<'static>>(work), chunks })
        };
        self.unfinished.store(chunks, Ordering::Relaxed);
        let mut from = 0;
        for (member, share) in self.shares.iter().enumerate() {
            let end = self.end_of(member, chunks);
            share.0.store(end - from, Ordering::Release);
            from = end;
        }
        self.work_as(self.leader);
        look(|| self.unfinished.load(Ordering::Acquire) == 0);
        if let Some(panic) = self.panic.lock().expect("no panic under this lock").take() {
            resume_unwind(panic);
        }
    }

    /// Take a chunk of a member's share: its place from the end.
    fn take(&self, member: usize) -> Option<usize> {
        let share = &self.shares[member].0;
        if share.load(Ordering::Relaxed) == 0 {
            return None;
        }
        share.fetch_update(Ordering::Acquire, Ordering::Relaxed, |left| left.checked_sub(1)).ok()
    }

    /// Do what is left of the loop, one's own share first.
    fn work_as(&self, member: usize) {
        let (threads, mut done) = (self.shares.len(), 0);
        AT_WORK.set(true);
        for of in (0..threads).map(|k| (member + k) % threads) {
            while let Some(left) = self.take(of) {
                // SAFETY: a chunk that is taken and not done keeps the loop, and with it the leader in `each`. Taking it (Acquire)
                // comes after the writing of `current` (Release of its share).
                let Loop { work, chunks } = unsafe { *self.current.get() }.expect("a loop with chunks");
                let c = self.end_of(of, chunks) - left;
                let work = AssertUnwindSafe(unsafe { &*work });
                if let Err(panic) = catch_unwind(|| work(c)) {
                    self.panic.lock().expect("no panic under this lock").get_or_insert(panic);
                }
                done += 1;
            }
        }
        AT_WORK.set(false);
        if done > 0 {
            self.unfinished.fetch_sub(done, Ordering::Release);
        }
    }

    /// Work for the leader until its task is over.
    fn join(&self, member: usize) {
        // the leader, and who works for another team and waits, would wait for itself
        if LEADS.get().is_some() || AT_WORK.get() {
            return;
        }
        let has_work = || self.shares[member].0.load(Ordering::Relaxed) > 0;
        loop {
            look(|| has_work() || self.over.load(Ordering::Relaxed));
            if !has_work() {
                return;
            }
            self.work_as(member);
        }
    }
}

/// Wait for something: awake, then letting others run from time to time, and where nothing comes for long, asleep.
fn look(is: impl Fn() -> bool) {
    for turn in 0_u32.. {
        for _ in 0..LOOKS {
            if is() {
                return;
            }
            spin_loop();
        }
        if turn < TURNS { std::thread::yield_now() } else { std::thread::sleep(NAP) }
    }
}

/// Do `task` as the leader of a team of all threads of this thread's pool; must be called on one of them.
fn lead<T>(task: impl FnOnce() -> T) -> T {
    /// Ends the team, also when the task panics.
    struct Leading<'a>(&'a Team);
    impl Drop for Leading<'_> {
        fn drop(&mut self) {
            LEADS.set(None);
            self.0.over.store(true, Ordering::Relaxed);
        }
    }
    let (threads, own) = (rayon::current_num_threads(), rayon::current_thread_index());
    let Some(own) = own.filter(|_| threads > 1 && LEADS.get().is_none() && !AT_WORK.get()) else { return task() };
    let team = &Team::of(threads, own);
    rayon::in_place_scope(|scope| {
        scope.spawn_broadcast(|_, member| team.join(member.index()));
        LEADS.set(Some(team));
        let _leading = Leading(team);
        task()
    })
}

/// Do `task` on a thread of the pool with the others as its team: the loops inside then start without waking the pool each time.
pub fn within_pool<T: Send>(task: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_some() { task() } else { rayon::scope(|_| lead(task)) }
}

/// Do `task` with a pool of `threads` of its own.
pub fn on_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a system that gives threads").install(|| lead(task))
}

/// `work(c)` for each of `chunks`, by this thread's team or else its pool.
pub(crate) fn each_chunk(chunks: usize, work: &Work<'_>) {
    match LEADS.get() {
        _ if chunks == 1 || AT_WORK.get() => (0..chunks).for_each(work),
        // SAFETY: `lead` sets the pointer for the time of its task alone, and holds the team all that time.
        Some(team) => unsafe { &*team }.each(chunks, work),
        None => (0..chunks).into_par_iter().for_each(work),
    }
}

/// An array cut into parts of one length.
struct Parts<'a, T> {
    start: *mut T,
    length: usize,
    part: usize,
    array: PhantomData<&'a mut [T]>,
}

// SAFETY: it hands out parts that do not overlap, each to one thread.
unsafe impl<T: Send> Sync for Parts<'_, T> {}

impl<'a, T> Parts<'a, T> {
    fn of(array: &'a mut [T], part: usize) -> Parts<'a, T> {
        Parts { start: array.as_mut_ptr(), length: array.len(), part, array: PhantomData }
    }

    fn count(&self) -> usize {
        self.length.div_ceil(self.part)
    }

    /// Part c.
    ///
    /// # Safety
    /// No part may be asked for twice.
    #[allow(clippy::mut_from_ref)]
    unsafe fn get(&self, c: usize) -> &'a mut [T] {
        let from = c * self.part;
        assert!(from < self.length, "part {c} of {}", self.count());
        // SAFETY: within the array, and parts do not overlap.
        unsafe { std::slice::from_raw_parts_mut(self.start.add(from), self.part.min(self.length - from)) }
    }
}

/// `change(c, part)` for every part of `length` of an array.
pub(crate) fn each_part<T: Send>(array: &mut [T], length: usize, change: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let parts = Parts::of(array, length);
    // SAFETY: `each_chunk` asks for each c once.
    each_chunk(parts.count(), &|c| change(c, unsafe { parts.get(c) }));
}

/// What is done with part c of two arrays.
pub(crate) type OnBoth<'a, A, B> = dyn Fn(usize, &mut [A], &mut [B]) + Sync + 'a;

/// The same of two arrays, cut into as many parts.
pub(crate) fn each_part_of_both<A: Send, B: Send>(
    (a, length_a): (&mut [A], usize),
    (b, length_b): (&mut [B], usize),
    change: &OnBoth<'_, A, B>,
) {
    let (a, b) = (Parts::of(a, length_a), Parts::of(b, length_b));
    assert_eq!(a.count(), b.count());
    // SAFETY: `each_chunk` asks for each c once.
    each_chunk(a.count(), &|c| unsafe { change(c, a.get(c), b.get(c)) });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_chunk_is_done_once() {
        for threads in [1, 2, 5] {
            on_threads(threads, || {
                for n in (0..40).chain([1000, 4097]) {
                    let mut counts = vec![0; n];
                    each_part(&mut counts, 3, &|c, part| part.iter_mut().for_each(|count| *count += c + 1));
                    assert!((0..n).all(|k| counts[k] == k / 3 + 1), "{n} on {threads}");
                }
            });
        }
    }

    #[test]
    fn a_loop_within_a_chunk_is_done_by_its_thread() {
        let mut sums = [0; 50];
        on_threads(3, || {
            each_part(&mut sums, 1, &|c, sum| {
                let mut inner = vec![0; 100];
                each_part(&mut inner, 7, &|_, part| part.fill(c));
                sum[0] = within_pool(|| inner.iter().sum());
            });
        });
        assert!((0..50).all(|c| sums[c] == 100 * c));
    }

    #[test]
    fn a_panic_reaches_the_leader_and_ends_the_team() {
        let of = |bad: usize| {
            on_threads(3, || {
                each_chunk(100, &|_| ());
                each_chunk(100, &|c| assert!(c != bad, "chunk {c}"));
                bad
            })
        };
        let panic = catch_unwind(|| of(71)).expect_err("a panic");
        assert_eq!(panic.downcast_ref::<String>().map(String::as_str), Some("chunk 71"));
        assert_eq!(of(100), 100);
    }
}
