//! A team of threads for loops that last microseconds: its members spin for a short while between two loops,
//! then sleep.
//!
//! Every loop goes over parts that are handed out one by one, each to one member: first those of its own
//! share, which are the same in every loop of as many parts, so that they stay in its cache, then what others
//! have not begun. Which member gets which part is left to chance, so results must not depend on it: parts
//! are disjoint, and sums are joined afterwards in the order of the parts. A pool that steals work needs some
//! microseconds to begin such a loop; a team that still spins needs less than one.

use std::cell::UnsafeCell;
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Turns of a member that waits for the next loop before it sleeps: some 60 microseconds.
const SPIN: usize = 4000;
/// Turns of the leader that waits for the others before it lets other programs run.
const PATIENCE: usize = 10_000;

/// Something that is handed out in parts.
///
/// # Safety
/// Parts of different indices must not overlap.
pub unsafe trait Parts: Sync {
    /// A part.
    type Part;
    /// Number of parts.
    fn count(&self) -> usize;
    /// The part of an index.
    ///
    /// # Safety
    /// `index` must be less than [`Parts::count`], and asked for once.
    unsafe fn part(&self, index: usize) -> Self::Part;
}

/// Chunks of a list, each of the same length but for the last.
pub struct Chunks<'a, T> {
    first: *mut T,
    length: usize,
    size: usize,
    list: PhantomData<&'a mut [T]>,
}

impl<'a, T> Chunks<'a, T> {
    /// Of `size` values; of at least one.
    pub fn new(list: &'a mut [T], size: usize) -> Self {
        Self { first: list.as_mut_ptr(), length: list.len(), size: size.max(1), list: PhantomData }
    }
}

// SAFETY: anyone who has a part of it has the only access to these values, as with a slice that is split.
unsafe impl<T: Send> Sync for Chunks<'_, T> {}

// SAFETY: chunks begin at multiples of their size, so no two overlap.
unsafe impl<'a, T: Send> Parts for Chunks<'a, T> {
    type Part = &'a mut [T];

    fn count(&self) -> usize {
        self.length.div_ceil(self.size)
    }

    unsafe fn part(&self, index: usize) -> &'a mut [T] {
        let begin = index * self.size;
        let end = (begin + self.size).min(self.length);
        // SAFETY: by the contract the chunk lies inside the list that `new` has borrowed for 'a, and no one
        // else has it.
        unsafe { std::slice::from_raw_parts_mut(self.first.add(begin), end - begin) }
    }
}

macro_rules! tuples {
    ($($($name:ident)+;)*) => {
        $(
            // SAFETY: the parts of each do not overlap.
            unsafe impl<$($name: Parts),+> Parts for ($($name,)+) {
                type Part = ($($name::Part,)+);

                fn count(&self) -> usize {
                    #[allow(non_snake_case)]
                    let ($($name,)+) = self;
                    usize::MAX$(.min($name.count()))+
                }

                unsafe fn part(&self, index: usize) -> Self::Part {
                    #[allow(non_snake_case)]
                    let ($($name,)+) = self;
                    // SAFETY: the count is the smallest of all, and the contract is the same.
                    unsafe { ($($name.part(index),)+) }
                }
            }
        )*
    };
}

tuples! {
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E F;
    A B C D E F G;
    A B C D E F G H;
    A B C D E F G H I;
}

/// What every member does in a loop; the number of the member is its argument.
type Work<'a> = dyn Fn(usize) + Sync + 'a;

/// What leader and members share.
struct Shared {
    /// Number of the loop times [`TURN`], [`OPEN`] while members may enter it, and how many are inside.
    gate: AtomicUsize,
    work: UnsafeCell<Option<*const Work<'static>>>,
    sleepers: AtomicUsize,
    bed: Mutex<()>,
    bell: Condvar,
    ends: AtomicBool,
    has_panicked: AtomicBool,
}

/// One more loop.
const TURN: usize = 1 << 16;
/// Whether members may enter.
const OPEN: usize = 1 << 15;
/// How many are inside.
const INSIDE: usize = OPEN - 1;

// SAFETY: `work` is written by the leader while the gate is closed and no one is inside, and read by members
// who are inside.
unsafe impl Sync for Shared {}
// SAFETY: the pointer in it is used as `Sync` says.
unsafe impl Send for Shared {}

impl Shared {
    /// Whether there is a loop to enter, or none ever more.
    fn calls(&self, order: Ordering) -> bool {
        self.gate.load(order) & OPEN != 0 || self.ends.load(order)
    }

    /// Waits for a loop: spins, then sleeps.
    fn wait(&self) {
        for _ in 0..SPIN {
            if self.calls(Ordering::Acquire) {
                return;
            }
            std::hint::spin_loop();
        }
        let mut bed = self.bed.lock().unwrap_or_else(PoisonError::into_inner);
        // The leader looks for sleepers after it has opened the gate, and rings with the lock held: either it
        // sees this, or the gate is open here.
        self.sleepers.fetch_add(1, Ordering::SeqCst);
        while !self.calls(Ordering::SeqCst) {
            bed = self.bell.wait(bed).unwrap_or_else(PoisonError::into_inner);
        }
        self.sleepers.fetch_sub(1, Ordering::SeqCst);
    }

    fn ring(&self) {
        if self.sleepers.load(Ordering::SeqCst) > 0 {
            let _bed = self.bed.lock().unwrap_or_else(PoisonError::into_inner);
            self.bell.notify_all();
        }
    }

    /// What a member does all its life. A loop that is over before it comes is none of its business: no one
    /// waits for a member that is not inside.
    fn serve(&self, member: usize) {
        let mut done = 0;
        loop {
            self.wait();
            if self.ends.load(Ordering::Acquire) {
                return;
            }
            let gate = self.gate.load(Ordering::Acquire);
            if gate & OPEN == 0 || gate / TURN == done {
                // Its own work in this loop is done; others finish theirs.
                std::hint::spin_loop();
                continue;
            }
            if self.gate.compare_exchange(gate, gate + 1, Ordering::AcqRel, Ordering::Relaxed).is_err() {
                continue;
            }
            done = gate / TURN;
            // SAFETY: it is inside, so the leader has written it and leaves it alone.
            if let Some(work) = unsafe { *self.work.get() } {
                // SAFETY: the leader keeps what it points to alive while somebody is inside.
                if catch_unwind(AssertUnwindSafe(|| unsafe { (*work)(member) })).is_err() {
                    self.has_panicked.store(true, Ordering::SeqCst);
                }
            }
            self.gate.fetch_sub(1, Ordering::Release);
        }
    }
}

/// The team. Anyone who calls [`Team::each`] is its leader and works too.
pub struct Team {
    shared: Option<Arc<Shared>>,
    members: Vec<JoinHandle<()>>,
    /// The next part of each one's share.
    shares: Vec<Share>,
}

/// A counter in a cache line of its own.
#[derive(Default)]
#[repr(align(128))]
struct Share(AtomicUsize);

impl Team {
    /// No one but the leader.
    #[must_use]
    pub const fn alone() -> Self {
        Self { shared: None, members: Vec::new(), shares: Vec::new() }
    }

    /// Of so many threads with the leader; fewer where the system gives no more.
    #[must_use]
    pub fn new(threads: usize) -> Self {
        if threads < 2 {
            return Self::alone();
        }
        let shared = Arc::new(Shared {
            gate: AtomicUsize::new(0),
            work: UnsafeCell::new(None),
            sleepers: AtomicUsize::new(0),
            bed: Mutex::new(()),
            bell: Condvar::new(),
            ends: AtomicBool::new(false),
            has_panicked: AtomicBool::new(false),
        });
        let hire = |member: usize| {
            let shared = Arc::clone(&shared);
            std::thread::Builder::new().name(format!("embate-{member}")).spawn(move || shared.serve(member)).ok()
        };
        let members: Vec<_> = (1..threads).map_while(hire).collect();
        let shares = (0..=members.len()).map(|_| Share::default()).collect();
        Self { shared: Some(shared), members, shares }
    }

    /// Threads, the leader among them.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.members.len() + 1
    }

    /// Calls `work(index, member, part)` once for every part, on any member below [`Team::threads`]; returns
    /// when all is done.
    ///
    /// # Panics
    /// When `work` has panicked, on whichever thread; all members have left it then.
    pub fn each<P: Parts>(&mut self, parts: P, work: impl Fn(usize, usize, P::Part) + Sync) {
        let (count, threads) = (parts.count(), self.threads());
        let shared = match &self.shared {
            Some(shared) if count > 1 && threads > 1 => shared,
            _ => {
                for index in 0..count {
                    // SAFETY: every index below the count comes once.
                    work(index, 0, unsafe { parts.part(index) });
                }
                return;
            }
        };
        let shares = &self.shares;
        for (member, share) in shares.iter().enumerate() {
            share.0.store(member * count / threads, Ordering::Relaxed);
        }
        let own = |member: usize| {
            for owner in (member..threads).chain(0..member) {
                loop {
                    let index = shares[owner].0.fetch_add(1, Ordering::Relaxed);
                    if index >= (owner + 1) * count / threads {
                        break;
                    }
                    // SAFETY: the counters give every index of every share once, and shares do not overlap.
                    work(index, member, unsafe { parts.part(index) });
                }
            }
        };
        Self::work_together(shared, &own);
    }

    /// Opens the gate, works, closes it, and waits for those who are inside.
    fn work_together(shared: &Shared, work: &Work<'_>) {
        // SAFETY: only the lifetime changes; no one uses the pointer after this function, which waits for all
        // who are inside.
        let pointer = unsafe { std::mem::transmute::<*const Work<'_>, *const Work<'static>>(std::ptr::from_ref(work)) };
        // SAFETY: the gate is closed and no one is inside: the last loop has waited for that.
        unsafe { *shared.work.get() = Some(pointer) };
        let turn = shared.gate.load(Ordering::Relaxed) / TURN + 1;
        shared.gate.store((turn * TURN) | OPEN, Ordering::SeqCst);
        shared.ring();
        let done = catch_unwind(AssertUnwindSafe(|| work(0)));
        shared.gate.fetch_and(!OPEN, Ordering::AcqRel);
        let mut turns = 0;
        while shared.gate.load(Ordering::Acquire) & INSIDE > 0 {
            turns += 1;
            if turns < PATIENCE {
                std::hint::spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
        // SAFETY: as above.
        unsafe { *shared.work.get() = None };
        if let Err(panic) = done {
            shared.has_panicked.store(false, Ordering::SeqCst);
            resume_unwind(panic);
        }
        assert!(!shared.has_panicked.swap(false, Ordering::SeqCst), "a member of the team has panicked");
    }
}

impl std::fmt::Debug for Team {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Team").field("threads", &self.threads()).finish()
    }
}

impl Drop for Team {
    fn drop(&mut self) {
        if let Some(shared) = &self.shared {
            shared.ends.store(true, Ordering::SeqCst);
            shared.ring();
        }
        for member in self.members.drain(..) {
            // A member that has panicked has reported so when it did.
            let _ = member.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounds of the short loops; Miri is a thousand times slower.
    const ROUNDS: u64 = if cfg!(miri) { 100 } else { 20_000 };

    #[test]
    fn every_part_is_done_once_whatever_the_team() {
        for threads in [1, 2, 3, 8] {
            let mut team = Team::new(threads);
            for (length, size) in [(0, 3), (1, 3), (1000, 7), (64, 64), (65, 64), (if cfg!(miri) { 50 } else { 5000 }, 1)] {
                let (mut list, mut sums) = (vec![1u64; length], vec![0u64; length.div_ceil(size)]);
                let members = team.threads();
                for round in 1..=20u64 {
                    team.each((Chunks::new(&mut list, size), Chunks::new(&mut sums, 1)), |index, member, (part, sum)| {
                        assert!(member < members && part.len() == size.min(length - index * size));
                        part.iter_mut().for_each(|value| *value += index as u64);
                        sum[0] += part.iter().sum::<u64>();
                    });
                    assert!(list.iter().enumerate().all(|(k, &value)| value == 1 + round * (k / size) as u64), "{threads} {length}");
                }
                let expected =
                    |index: usize| (1..=20).map(|round| (1 + round * index as u64) * size.min(length - index * size) as u64).sum::<u64>();
                assert!(sums.iter().enumerate().all(|(index, &sum)| sum == expected(index)));
            }
        }
    }

    #[test]
    fn a_team_that_slept_wakes() {
        let mut team = Team::new(3);
        let mut list = [0u32; 30];
        for pause in [0, 1, 5, 20, 0, 0, 3] {
            std::thread::sleep(std::time::Duration::from_millis(pause));
            team.each(Chunks::new(&mut list, 1), |_, _, part| part[0] += 1);
        }
        assert_eq!(list, [7; 30]);
    }

    #[test]
    fn a_panic_of_any_member_reaches_the_leader_and_the_team_goes_on() {
        for bad in [0, 17, 99] {
            let mut team = Team::new(4);
            let mut list = [0u32; 100];
            let told = catch_unwind(AssertUnwindSafe(|| {
                team.each(Chunks::new(&mut list, 1), |index, _, part| {
                    assert!(index != bad, "on purpose");
                    part[0] = 1;
                });
            }));
            assert!(told.is_err());
            team.each(Chunks::new(&mut list, 1), |_, _, part| part[0] = 2);
            assert_eq!(list, [2; 100]);
        }
    }

    #[test]
    fn many_short_loops_do_not_lose_each_other() {
        let mut team = Team::new(2);
        let mut list = [0u64; 16];
        for _ in 0..ROUNDS {
            team.each(Chunks::new(&mut list, 2), |_, _, part| part.iter_mut().for_each(|value| *value += 1));
        }
        assert_eq!(list, [ROUNDS; 16]);
    }
}
