//! Simulated time as the log counts it.

use foxglove::messages::Timestamp;

use super::error::LogError;

const NANOSECONDS_PER_SECOND: u64 = 1_000_000_000;

/// The first time [s] past the clock, whose seconds are a `u32`.
const CLOCK_END: f64 = 4_294_967_296.0;

/// Simulated time, rounded to whole nanoseconds, in [0, 2³²) s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stamp {
    nanoseconds: u64,
}

impl Stamp {
    /// The stamp of `time` [s].
    pub(super) fn from_seconds(time: f64) -> Result<Self, LogError> {
        if !(0.0..CLOCK_END).contains(&time) {
            return Err(LogError::Time { time });
        }
        Ok(Self { nanoseconds: (time * NANOSECONDS_PER_SECOND as f64).round() as u64 })
    }

    /// The time [ns], as an MCAP message header carries it.
    pub(super) fn nanoseconds(self) -> u64 {
        self.nanoseconds
    }

    /// The time in seconds and nanoseconds, as a Foxglove message carries it.
    pub(super) fn timestamp(self) -> Timestamp {
        Timestamp::new(
            (self.nanoseconds / NANOSECONDS_PER_SECOND) as u32,
            (self.nanoseconds % NANOSECONDS_PER_SECOND) as u32,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_round_to_the_nearest_nanosecond() {
        // In f64, 1.001e9 comes out as 1000999999.9999999: truncation would lose 1 ns.
        let stamp = Stamp::from_seconds(1.001).expect("a time within the clock");
        assert_eq!(stamp.nanoseconds(), 1_001_000_000);
        assert_eq!(stamp.timestamp(), Timestamp::new(1, 1_000_000));
    }

    #[test]
    fn both_ends_of_the_clock_hold() {
        assert_eq!(Stamp::from_seconds(-0.0).unwrap().nanoseconds(), 0);
        let last = Stamp::from_seconds(CLOCK_END.next_down()).expect("the last time");
        assert_eq!(last.timestamp().sec(), u32::MAX);
        for time in [-1e-12, CLOCK_END, f64::NAN, f64::INFINITY] {
            let Err(LogError::Time { time: reported }) = Stamp::from_seconds(time) else {
                panic!("{time} s was accepted");
            };
            assert_eq!(reported.to_bits(), time.to_bits());
        }
    }
}
