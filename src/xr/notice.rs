//! Events of a runtime, as far as Swell listens to them.

use openxr::{self as xr, Event};

/// What a runtime has to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Notice {
    /// The session is in another state.
    State(xr::SessionState),
    /// The runtime is about to go.
    InstanceLossPending,
    /// The origin of spaces of a kind moves.
    Recentred {
        /// Which kind.
        space: xr::ReferenceSpaceType,
        /// When.
        at: xr::Time,
    },
    /// An eye's visible area has changed.
    MaskChanged,
    /// A hand holds something else.
    ProfileChanged,
    /// The display's refresh rate has changed, hertz.
    RefreshRate(f32),
    /// Clocks or heat: the runtime's level for a subdomain has changed.
    Performance,
    /// Events were lost, this many.
    EventsLost(u32),
}

impl Notice {
    pub(super) fn of(event: &Event<'_>) -> Option<Self> {
        Some(match event {
            Event::SessionStateChanged(change) => Self::State(change.state()),
            Event::InstanceLossPending(_) => Self::InstanceLossPending,
            Event::ReferenceSpaceChangePending(change) => {
                Self::Recentred { space: change.reference_space_type(), at: change.change_time() }
            }
            Event::VisibilityMaskChangedKHR(_) => Self::MaskChanged,
            Event::InteractionProfileChanged(_) => Self::ProfileChanged,
            Event::DisplayRefreshRateChangedFB(change) => Self::RefreshRate(change.to_display_refresh_rate()),
            Event::PerfSettingsEXT(_) => Self::Performance,
            Event::EventsLost(lost) => Self::EventsLost(lost.lost_event_count()),
            _ => return None,
        })
    }
}
