//! A team of threads that spins until the next parallel loop.
//!
//! A loop of a small scene lasts 20 to 300 µs, and a pool whose threads sleep between loops needs some 15 µs to begin and to end
//! one. A team's threads look for the next loop without sleeping, so that beginning and ending one takes less than 1 µs. The chunks of
//! a loop are cut into equal shares, the same from loop to loop, so that the data of a chunk stay in the caches of one core; who has
//! done its own share takes chunks of others'. A thread that the system stops delays at most the chunk it is at.
//!
//! The only `unsafe` of the crate stands here: a loop's closure and the arrays that it changes live on the stack of the thread that
//! begins it, which the threads of a pool, that live longer, may not borrow in safe Rust. What makes it sound is said at each place.

#![allow(unsafe_code)]

mod parts;

use std::any::Any;
use std::cell::{Cell, RefCell, UnsafeCell};
use std::hint::spin_loop;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

pub(crate) use parts::{each_part, each_part_of_both};
use rayon::prelude::*;

/// Turns of a spin loop before a thread yields.
const LOOKS: u32 = 2000;
/// Yields without a loop after which a member leaves, some 30 ms.
const TURNS: u32 = 1000;
/// Loops after which members who left are called again.
const CALL_EVERY: usize = 64;

/// A member is late that keeps the leader waiting longer than the leader worked, and this: the machine is busy.
const LATE: Duration = Duration::from_micros(100);
/// Fewest and most loops that the leader then does alone; twice as many each time.
const ALONE: [usize; 2] = [64, 4096];

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
    /// Of each thread of the pool; the leader's is its own, or the first where it is no thread of the pool.
    shares: Box<[Share]>,
    leader: usize,
    /// Written by the leader while no share has a chunk left and none is at work; read by who has taken a chunk.
    current: UnsafeCell<Option<Loop>>,
    /// Chunks that are not done.
    unfinished: AtomicUsize,
    /// The leader's task is over.
    over: AtomicBool,
    /// Threads of the pool that wait for loops, those that were called and have not come, and loops so far.
    members: AtomicUsize,
    called: AtomicUsize,
    loops: AtomicUsize,
    /// Loops that the leader does alone, what is left of them and how many it was last.
    alone: AtomicUsize,
    alone_last: AtomicUsize,
    /// A chunk of this loop panicked, and what the first one says.
    failed: AtomicBool,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

// SAFETY: `current` is written by the leader alone, when no member can read it: see `Team::each` and `Team::work_as`. The closure that
// it points to is `Sync`.
unsafe impl Sync for Team {}
// SAFETY: as above; the pointer is not followed after the loop it belongs to.
unsafe impl Send for Team {}

thread_local! {
    /// The team that this thread leads.
    static LEADS: RefCell<Option<Arc<Team>>> = const { RefCell::new(None) };
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
            members: AtomicUsize::new(0),
            called: AtomicUsize::new(0),
            loops: AtomicUsize::new(0),
            alone: AtomicUsize::new(0),
            alone_last: AtomicUsize::new(0),
            failed: AtomicBool::new(false),
            panic: Mutex::new(None),
        }
    }

    /// Call the threads of the pool. Who is busy comes later, or not at all.
    fn call(self: &Arc<Team>) {
        self.called.store(self.shares.len(), Ordering::Relaxed);
        let team = Arc::clone(self);
        rayon::spawn_broadcast(move |thread| {
            team.called.fetch_sub(1, Ordering::Relaxed);
            team.join(thread.index());
        });
    }

    /// End of a member's share of `chunks`.
    fn end_of(&self, member: usize, chunks: usize) -> usize {
        chunks * (member + 1) / self.shares.len()
    }

    /// `work(c)` for each of `chunks`, by the leader and who else has time. Returns when all are done.
    fn each(self: &Arc<Team>, chunks: usize, work: &Work<'_>) {
        let left = self.alone.load(Ordering::Relaxed);
        if left > 0 || self.shares.len() == 1 {
            self.alone.store(left.saturating_sub(1), Ordering::Relaxed);
            let _at_work = AtWork::begin();
            return (0..chunks).for_each(work);
        }
        let are_missing = self.members.load(Ordering::Relaxed) + 1 < self.shares.len();
        if self.loops.fetch_add(1, Ordering::Relaxed).is_multiple_of(CALL_EVERY)
            && are_missing
            && self.called.load(Ordering::Relaxed) == 0
        {
            self.call();
        }
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
        let start = Instant::now();
        self.work_as(self.leader);
        let worked = start.elapsed();
        while !within(TURNS, || self.unfinished.load(Ordering::Acquire) == 0) {}
        let last = self.alone_last.load(Ordering::Relaxed);
        let [least, most] = ALONE;
        let now =
            if start.elapsed() > 2 * worked + LATE { (2 * last).clamp(least, most) } else { last.saturating_sub(1) };
        if now > last {
            self.alone.store(now, Ordering::Relaxed);
        }
        self.alone_last.store(now, Ordering::Relaxed);
        if self.failed.swap(false, Ordering::Relaxed) {
            // the lock is given back before the panic goes on
            let panic = self.panic.lock().expect("no panic under this lock").take();
            resume_unwind(panic.expect("what the first panic says"));
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

    /// Do what is left of the loop, one's own share first. Must not panic before it has said what is done: chunks do within a catch.
    fn work_as(&self, member: usize) {
        let (threads, mut done) = (self.shares.len(), 0);
        let at_work = AtWork::begin();
        for of in (0..threads).map(|k| (member + k) % threads) {
            while let Some(left) = self.take(of) {
                done += 1;
                if self.failed.load(Ordering::Relaxed) {
                    continue;
                }
                // SAFETY: a chunk that is taken and not done keeps the loop, and with it the leader in `each`. Taking it (Acquire)
                // comes after the writing of `current` (Release of its share).
                let Loop { work, chunks } = unsafe { *self.current.get() }.expect("a loop with chunks");
                let c = self.end_of(of, chunks) - left;
                let work = AssertUnwindSafe(unsafe { &*work });
                if let Err(panic) = catch_unwind(|| work(c)) {
                    self.keep(panic);
                }
            }
        }
        drop(at_work);
        if done > 0 {
            self.unfinished.fetch_sub(done, Ordering::Release);
        }
    }

    /// Keep what the first panic says; later ones are leaked, since dropping them may panic.
    fn keep(&self, panic: Box<dyn Any + Send>) {
        let mut first = self.panic.lock().expect("no panic under this lock");
        match &*first {
            None => *first = Some(panic),
            Some(_) => std::mem::forget(panic),
        }
        self.failed.store(true, Ordering::Relaxed);
    }

    /// Work for the leader until its task is over or no loop comes for long: who waits here may keep others waiting.
    fn join(&self, member: usize) {
        if member == self.leader || AT_WORK.get() || leads().is_some() {
            return;
        }
        self.members.fetch_add(1, Ordering::Relaxed);
        let has_work = || self.shares[member].0.load(Ordering::Relaxed) > 0;
        while within(TURNS, || has_work() || self.over.load(Ordering::Relaxed)) && !self.over.load(Ordering::Relaxed) {
            self.work_as(member);
        }
        self.members.fetch_sub(1, Ordering::Relaxed);
    }
}

/// This thread is at work for a team as long as this lives.
struct AtWork;

impl AtWork {
    fn begin() -> AtWork {
        AT_WORK.set(true);
        AtWork
    }
}

impl Drop for AtWork {
    fn drop(&mut self) {
        AT_WORK.set(false);
    }
}

fn leads() -> Option<Arc<Team>> {
    LEADS.with_borrow(Option::clone)
}

/// Spin until something holds, and yield from time to time: false if it does not hold within this number of yields.
fn within(yields: u32, is: impl Fn() -> bool) -> bool {
    for _ in 0..yields {
        for _ in 0..LOOKS {
            if is() {
                return true;
            }
            spin_loop();
        }
        std::thread::yield_now();
    }
    false
}

/// Do `task` as the leader of a team of the pool's threads.
fn lead<T>(task: impl FnOnce() -> T) -> T {
    /// Ends the team, also when the task panics.
    struct Leading(Arc<Team>);
    impl Drop for Leading {
        fn drop(&mut self) {
            LEADS.set(None);
            self.0.over.store(true, Ordering::Relaxed);
        }
    }
    if AT_WORK.get() || leads().is_some() {
        return task();
    }
    let own = rayon::current_thread_index().unwrap_or(0);
    let team = Arc::new(Team::of(rayon::current_num_threads(), own));
    LEADS.set(Some(Arc::clone(&team)));
    let _leading = Leading(team);
    task()
}

/// Do `task` with the pool's threads as this thread's team: the loops inside then start without waking the pool each time.
pub fn within_pool<T: Send>(task: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_some() { task() } else { lead(task) }
}

/// Do `task` with a pool of `threads` of its own.
pub fn on_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("a system that gives threads").install(|| lead(task))
}

/// `work(c)` for each of `chunks`, by this thread's team or else its pool.
pub(crate) fn each_chunk(chunks: usize, work: &Work<'_>) {
    if chunks == 1 || AT_WORK.get() {
        return (0..chunks).for_each(work);
    }
    match leads() {
        Some(team) => team.each(chunks, work),
        None => (0..chunks).into_par_iter().for_each(work),
    }
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

    /// A pool's thread that waits in a loop of the pool's own may be called to a team meanwhile: it leaves it again.
    #[test]
    fn loops_of_the_pool_and_of_teams_end_beside_each_other() {
        for _ in 0..20 {
            let sum = on_threads(4, || {
                let of_pool: usize = (0..64_usize).into_par_iter().map(|k| within_pool(|| k)).sum();
                let mut counts = [0; 500];
                each_part(&mut counts, 1, &|_, part| part[0] += 1);
                rayon::broadcast(|_| ());
                of_pool + counts.iter().sum::<usize>()
            });
            assert_eq!(sum, 64 * 63 / 2 + 500);
        }
    }

    #[test]
    fn runs_beside_each_other_need_not_wait_for_each_other() {
        let (to_second, first) = std::sync::mpsc::channel();
        let (to_first, second) = std::sync::mpsc::channel();
        std::thread::scope(|scope| {
            let run = |task: Box<dyn FnOnce() + Send>| scope.spawn(|| within_pool(task));
            run(Box::new(move || {
                each_chunk(100, &|_| ());
                to_second.send(()).expect("the second run");
                second.recv().expect("the second run");
            }));
            run(Box::new(move || {
                first.recv().expect("the first run");
                each_chunk(100, &|_| ());
                to_first.send(()).expect("the first run");
            }));
        });
    }

    #[test]
    fn a_panic_reaches_the_leader_and_ends_the_team() {
        let of = |bad: usize| on_threads(3, || each_chunk(100, &|c| assert!(c != bad, "chunk {c}")));
        // the team goes on after a panic that is caught within its task
        on_threads(3, || {
            for bad in [3, 50] {
                let caught = catch_unwind(|| each_chunk(100, &|c| assert!(c != bad && c != 99, "chunk {c}")));
                assert!(caught.is_err());
                let mut counts = [0; 200];
                each_part(&mut counts, 2, &|_, part| part.fill(1));
                assert_eq!(counts, [1; 200]);
            }
        });
        let panic = catch_unwind(|| of(71)).expect_err("a panic");
        assert_eq!(panic.downcast_ref::<String>().map(String::as_str), Some("chunk 71"));
        of(100);
    }
}
