//! Phases of waves far from the origin and long after the start.

/// Turns made by something that turns `rate` times a unit after `amount` units, whole ones left out: within half a turn
/// to either side.
///
/// The product's rounding error is found by a fused multiplication and added after the whole turns have gone: what a
/// thousand kilometres or a week lose is what rounding `rate` and `amount` themselves lost.
pub fn turns(rate: f64, amount: f64) -> f64 {
    let product = rate * amount;
    let lost = rate.mul_add(amount, -product);
    let part = (product - product.round()) + lost;
    part - part.round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_turns_are_left_out() {
        for (rate, amount, left) in [(0.25, 1.0, 0.25), (1.0, 7.0, 0.0), (-0.75, 1.0, 0.25), (0.0, 9.0, 0.0)]
        {
            assert_eq!(turns(rate, amount), left, "{rate} {amount}");
        }
    }

    #[test]
    fn nothing_is_lost_far_out() {
        // 0.1 is stored as 0.1 + 2^-54 / 1.8014...: what ten million and one of it leave is known to the last digit.
        let stored = 0.1_f64;
        let excess = 5.551_115_123_125_783e-18;
        let amount = 10_000_001.0;
        let exact = 0.1 + excess * amount;
        assert!((turns(stored, amount) - exact).abs() < 1e-16, "{}", turns(stored, amount));
    }
}
