//! `XR_FB_display_refresh_rate`.

use crate::xr::XrError;
use crate::xr::error::Doing;
use crate::xr::session::Session;

/// Asks for the display's rate that is nearest to `wanted` hertz, or for the highest without a wish. Returns the rate in use,
/// or nothing where the runtime offers no choice.
///
/// # Errors
/// The session or the runtime has gone.
pub fn choose_refresh_rate(session: &Session, wanted: Option<f32>) -> Result<Option<f32>, XrError> {
    if !session.runtime.extensions.fb_display_refresh_rate {
        return Ok(None);
    }
    let offered = session.raw.enumerate_display_refresh_rates().doing("listing refresh rates")?;
    let Some(rate) = pick(&offered, wanted) else { return Ok(None) };
    let current = session.raw.get_display_refresh_rate().doing("asking for the refresh rate")?;
    if rate == current {
        return Ok(Some(current));
    }
    session.raw.request_display_refresh_rate(rate).doing("choosing a refresh rate")?;
    Ok(Some(rate))
}

/// The offer nearest to `wanted`, or the highest; of two as near, the higher.
fn pick(offered: &[f32], wanted: Option<f32>) -> Option<f32> {
    let wanted = wanted.unwrap_or(f32::INFINITY);
    offered.iter().copied().filter(|rate| rate.is_finite()).min_by(|a, b| {
        let far = |rate: f32| if wanted.is_finite() { (rate - wanted).abs() } else { -rate };
        far(*a).total_cmp(&far(*b)).then(b.total_cmp(a))
    })
}

#[cfg(test)]
mod tests {
    use super::pick;

    #[test]
    fn the_nearest_or_the_highest() {
        let offered = [72.0, 80.0, 90.0, 120.0];
        assert_eq!(pick(&offered, None), Some(120.0));
        assert_eq!(pick(&offered, Some(75.0)), Some(72.0));
        assert_eq!(pick(&offered, Some(76.0)), Some(80.0));
        assert_eq!(pick(&offered, Some(1000.0)), Some(120.0));
        assert_eq!(pick(&[], Some(90.0)), None);
        assert_eq!(pick(&[f32::NAN, 60.0], None), Some(60.0));
    }
}
