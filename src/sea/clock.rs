//! Time as an integer fraction of the repeat period, so that the loop closes exactly.

/// Binary digits of a [`Phase`]: a period of 200 s is cut into steps of 3 nanoseconds.
const DIGITS: u32 = 36;
/// One whole period.
const WHOLE: u64 = 1 << DIGITS;

/// A moment within the repeat period T, in units of T / 2^36.
///
/// Harmonic n of eq (16) has turned through n times this fraction of a circle. In integers that product, modulo one
/// turn, is exact, so a week of uptime loses no precision, and `t` and `t + T` are the same number although their
/// floating-point remainders differ in the last digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Phase(u64);

impl Phase {
    /// The moment `time` (seconds, any sign, finite) modulo `period` (seconds, above 0).
    pub fn at(time: f64, period: f64) -> Self {
        let fraction = time.rem_euclid(period) / period;
        Self((fraction * WHOLE as f64).round() as u64 % WHOLE)
    }

    /// Tick `index` of `count` equal ones.
    pub fn of_tick(index: u64, count: u64) -> Self {
        let product = u128::from(index % count) << DIGITS;
        Self((product / u128::from(count)) as u64)
    }

    /// The last of `count` equal ticks that is not after this moment.
    pub fn tick(self, count: u64) -> u64 {
        // of_tick rounds down, so the quotient may be one too small, never too large.
        let index = ((u128::from(self.0) * u128::from(count)) >> DIGITS) as u64;
        if index + 1 < count && Self::of_tick(index + 1, count) <= self { index + 1 } else { index }
    }

    /// By how many 2^-32 of a turn harmonic `harmonic` has advanced, whole turns left out, rounded down.
    #[inline(always)]
    pub fn turned(self, harmonic: u32) -> u32 {
        ((self.0.wrapping_mul(u64::from(harmonic)) % WHOLE) >> (DIGITS - u32::BITS)) as u32
    }

    /// Fraction of the period since `earlier`, which must not be later.
    pub fn since(self, earlier: Self) -> f64 {
        self.0.saturating_sub(earlier.0) as f64 / WHOLE as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tick_contains_its_own_beginning() {
        for count in [1, 3, 7, 2000, 2001, 99_991] {
            for index in (0..count).step_by(7) {
                assert_eq!(Phase::of_tick(index, count).tick(count), index);
            }
        }
    }

    #[test]
    fn periods_do_not_matter() {
        for i in 0..1000 {
            let time = f64::from(i) * 0.1;
            assert_eq!(Phase::at(time, 200.0), Phase::at(time + 200.0, 200.0));
            assert_eq!(Phase::at(time, 200.0), Phase::at(time - 600.0, 200.0));
        }
    }

    #[test]
    fn harmonics_turn_proportionally() {
        let phase = Phase::at(12.5, 200.0);
        assert_eq!(phase.turned(1), 1 << 28);
        assert_eq!(phase.turned(17), 1 << 28);
        assert_eq!(phase.turned(3), 3 << 28);
    }
}
