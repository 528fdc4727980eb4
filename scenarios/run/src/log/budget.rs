//! Which frames a log has room for.

/// Bytes kept for the summary at the end of the file: schemas and channels once more, and statistics.
const SUMMARY: u64 = 64 << 10;
/// Bytes of that summary per frame: where its chunk lies, and each channel in it.
const INDEX: u64 = 512;

/// A size that the log stays below: frames are left out, evenly over the run, and room for the last is kept. Curves and notes
/// are never left out.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Size of the file [bytes].
    pub bytes: u64,
    /// End of the simulated time [s], up to which it should last.
    pub end: f64,
}

/// How far a log is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// Size of the file before any frame [bytes].
    pub start: u64,
    /// Size of the file now [bytes].
    pub now: u64,
    /// Frames in it.
    pub frames: u64,
}

impl Budget {
    /// Whether a frame of `raw` bytes before compression, which it may not get to be smaller than, finds room at `time` [s];
    /// the `last` of a run does not leave room for another.
    pub(super) fn admits(&self, at: Standing, time: f64, raw: u64, last: bool) -> bool {
        let room = self.bytes.saturating_sub(SUMMARY + INDEX * (at.frames + 2));
        if last {
            return at.now + raw <= room;
        }
        let pace = room.saturating_sub(at.start + 2 * raw) as f64 * (time / self.end).clamp(0.0, 1.0);
        let in_time = at.frames == 0 || (at.now - at.start) as f64 <= pace;
        in_time && at.now + 2 * raw <= room
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of `size` bytes that `raw` ones are compressed to, at 0, 0.01 … 1 s: which are in the log, and its size.
    fn kept(bytes: u64, raw: u64, size: u64) -> (Vec<usize>, u64) {
        let budget = Budget { bytes, end: 1.0 };
        let mut at = Standing { start: 10_000, now: 10_000, frames: 0 };
        let mut kept = Vec::new();
        for k in 0..=100 {
            if budget.admits(at, k as f64 / 100.0, raw, k == 100) {
                (at.now, at.frames) = (at.now + size, at.frames + 1);
                kept.push(k);
            }
        }
        (kept, at.now + SUMMARY + INDEX * at.frames)
    }

    #[test]
    fn frames_are_left_out_evenly_and_the_last_is_there() {
        for (raw, size) in [(640_000, 640_000), (640_000, 480_000), (640_000, 200_000)] {
            for bytes in [3 << 20, 10 << 20, 30 << 20] {
                let (kept, file) = kept(bytes, raw, size);
                assert!(file <= bytes, "{file} of {bytes}");
                assert!(file + 4 * raw > bytes.min(101 * size), "{file} of {bytes}: frames left out that had room");
                assert_eq!([kept.first(), kept.last()], [Some(&0), Some(&100)], "{bytes}, {size}");
                let gaps: Vec<usize> = kept.windows(2).map(|pair| pair[1] - pair[0]).collect();
                let (widest, narrowest) = (gaps.iter().max(), gaps[..gaps.len() - 1].iter().min());
                assert!(widest <= narrowest.map(|n| n + 2).as_ref(), "{bytes}, {size}: {kept:?}");
            }
        }
    }

    #[test]
    fn a_budget_that_is_large_enough_leaves_nothing_out() {
        assert_eq!(kept(101 * 700_000, 640_000, 640_000).0.len(), 101);
    }

    #[test]
    fn a_budget_too_small_for_a_frame_has_none() {
        assert_eq!(kept(500_000, 640_000, 640_000).0.len(), 0);
    }
}
