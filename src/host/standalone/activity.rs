//! The life of Android's activity as a state machine: events in, what is to be done out.
//!
//! It says when frames are looked after, when nothing but waiting makes sense, and when state is kept. OpenXR's own states
//! ([`crate::xr::Lifecycle`]) say when frames are drawn: the runtime listens to the activity too, and begins and ends the
//! session by itself. The table of all events is in `docs/android-lifecycle.md`, in the order of the tests below.

/// What happens to the activity, and to the session beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// `onStart`: about to be seen.
    Started,
    /// `onResume`: in front.
    Resumed,
    /// `onPause`: something is in front of it: the system's menu, a dialog, the headset taken off.
    Paused,
    /// `onStop`: not seen any more.
    Stopped,
    /// `onDestroy`: the end.
    Destroyed,
    /// `onWindowFocusChanged(true)`.
    FocusGained,
    /// `onWindowFocusChanged(false)`.
    FocusLost,
    /// The flat window has a surface.
    SurfaceMade,
    /// It has none any more.
    SurfaceGone,
    /// `onLowMemory`.
    LowMemory,
    /// `onSaveInstanceState`.
    SaveAsked,
    /// `onConfigurationChanged`.
    Reconfigured,
    /// The OpenXR session begins or goes on.
    SessionRuns,
    /// The OpenXR session rests.
    SessionRests,
}

/// What the frame loop does next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Go on: look for events of both kinds without waiting, draw what the runtime asks for.
    Frames,
    /// Nobody sees anything and no session runs: sleep until the activity hears something.
    Wait,
    /// End the session in order and return, so that the activity can finish.
    Leave,
}

/// What an event asks for, at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reaction {
    /// Keep what the next run begins with: the process may be ended without another word.
    pub keep: bool,
    /// What the log says of it.
    pub tell: &'static str,
}

/// Where the activity is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Activity {
    resumed: bool,
    destroyed: bool,
    session_runs: bool,
}

impl Activity {
    /// Learns of `event`.
    pub const fn event(&mut self, event: Event) -> Reaction {
        let (keep, tell) = match event {
            Event::Started => (false, "started"),
            Event::Resumed => {
                self.resumed = true;
                (false, "resumed")
            }
            Event::Paused => {
                self.resumed = false;
                (true, "paused; frames go on until the runtime ends the session")
            }
            Event::Stopped => {
                self.resumed = false;
                (true, "stopped")
            }
            Event::Destroyed => {
                (self.resumed, self.destroyed) = (false, true);
                (true, "destroyed; leaving")
            }
            Event::FocusGained => (false, "focus gained"),
            Event::FocusLost => (false, "focus lost; frames go on, the runtime withholds input"),
            Event::SurfaceMade => (false, "a surface, which nothing is drawn on"),
            Event::SurfaceGone => (false, "the surface is gone; nothing was drawn on it"),
            Event::LowMemory => (true, "memory is low; nothing is held that could be given back"),
            Event::SaveAsked => (true, "asked for its state, which is in files"),
            Event::Reconfigured => (false, "another configuration, which changes nothing"),
            Event::SessionRuns => {
                self.session_runs = true;
                (false, "the session runs")
            }
            Event::SessionRests => {
                self.session_runs = false;
                (true, "the session rests")
            }
        };
        Reaction { keep, tell }
    }

    /// What the frame loop does next.
    pub const fn next(self) -> Next {
        if self.destroyed {
            Next::Leave
        } else if self.resumed || self.session_runs {
            Next::Frames
        } else {
            Next::Wait
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Event as E;
    use proptest::prelude::*;

    const ALL: [Event; 14] = [
        E::Started,
        E::Resumed,
        E::Paused,
        E::Stopped,
        E::Destroyed,
        E::FocusGained,
        E::FocusLost,
        E::SurfaceMade,
        E::SurfaceGone,
        E::LowMemory,
        E::SaveAsked,
        E::Reconfigured,
        E::SessionRuns,
        E::SessionRests,
    ];

    /// What comes of `events` from the beginning: the last reaction's `keep`, and what is next.
    fn after(events: &[Event]) -> (bool, Next) {
        let mut activity = Activity::default();
        let keep = events.iter().map(|&event| activity.event(event).keep).last();
        (keep.unwrap_or(false), activity.next())
    }

    const SHOWN: [Event; 5] = [E::Started, E::Resumed, E::SurfaceMade, E::FocusGained, E::SessionRuns];

    fn shown_and(events: &[Event]) -> (bool, Next) {
        after(&[&SHOWN, events].concat())
    }

    #[test]
    fn created_it_waits() {
        assert_eq!(after(&[]), (false, Next::Wait));
    }

    #[test]
    fn started_it_still_waits() {
        assert_eq!(after(&[E::Started]), (false, Next::Wait));
    }

    #[test]
    fn resumed_it_listens_to_the_runtime_before_there_is_a_session() {
        assert_eq!(after(&[E::Started, E::Resumed]), (false, Next::Frames));
    }

    #[test]
    fn paused_it_keeps_state_and_follows_the_session_to_its_end() {
        assert_eq!(shown_and(&[E::Paused]), (true, Next::Frames));
        assert_eq!(shown_and(&[E::Paused, E::SessionRests]), (true, Next::Wait));
    }

    #[test]
    fn a_session_that_rests_first_leaves_the_pause_to_decide() {
        assert_eq!(shown_and(&[E::SessionRests]), (true, Next::Frames));
        assert_eq!(shown_and(&[E::SessionRests, E::Paused]), (true, Next::Wait));
    }

    #[test]
    fn taken_up_again_it_goes_on() {
        let down = [E::Paused, E::SessionRests, E::Stopped];
        assert_eq!(shown_and(&down), (true, Next::Wait));
        assert_eq!(shown_and(&[&down[..], &[E::Started, E::Resumed]].concat()), (false, Next::Frames));
    }

    #[test]
    fn stopped_without_a_pause_it_keeps_state_and_waits() {
        assert_eq!(shown_and(&[E::SessionRests, E::Stopped]), (true, Next::Wait));
    }

    #[test]
    fn destroyed_it_keeps_state_and_leaves_whatever_comes() {
        assert_eq!(shown_and(&[E::Destroyed]), (true, Next::Leave));
        for event in ALL {
            assert_eq!(shown_and(&[E::Destroyed, event]).1, Next::Leave, "{event:?}");
        }
        assert_eq!(after(&[E::Destroyed]), (true, Next::Leave));
    }

    #[test]
    fn focus_changes_nothing() {
        assert_eq!(shown_and(&[E::FocusLost]), (false, Next::Frames));
        assert_eq!(shown_and(&[E::FocusLost, E::FocusGained]), (false, Next::Frames));
        assert_eq!(after(&[E::FocusGained]), (false, Next::Wait));
    }

    #[test]
    fn the_surface_changes_nothing() {
        assert_eq!(shown_and(&[E::SurfaceGone]), (false, Next::Frames));
        assert_eq!(shown_and(&[E::SurfaceGone, E::SurfaceMade]), (false, Next::Frames));
        assert_eq!(after(&[E::SurfaceMade]), (false, Next::Wait));
    }

    #[test]
    fn a_permission_dialog_is_a_pause_and_a_resume() {
        let dialog = [E::Paused, E::FocusLost, E::SessionRests, E::Resumed, E::FocusGained];
        assert_eq!(shown_and(&dialog), (false, Next::Frames));
    }

    #[test]
    fn low_memory_keeps_state_and_goes_on() {
        assert_eq!(shown_and(&[E::LowMemory]), (true, Next::Frames));
        assert_eq!(after(&[E::LowMemory]), (true, Next::Wait));
    }

    #[test]
    fn asked_for_its_state_it_keeps_it() {
        assert_eq!(shown_and(&[E::SaveAsked]), (true, Next::Frames));
    }

    #[test]
    fn another_configuration_changes_nothing() {
        assert_eq!(shown_and(&[E::Reconfigured]), (false, Next::Frames));
    }

    #[test]
    fn a_session_begins_and_rests_as_the_runtime_says() {
        assert_eq!(after(&[E::SessionRuns]), (false, Next::Frames));
        assert_eq!(after(&[E::SessionRuns, E::SessionRests]), (true, Next::Wait));
    }

    #[test]
    fn every_event_is_told() {
        let mut told: Vec<_> = ALL.iter().map(|&event| Activity::default().event(event).tell).collect();
        told.sort_unstable();
        told.dedup();
        assert_eq!(told.len(), ALL.len());
        assert!(told.iter().all(|words| !words.is_empty()));
    }

    proptest! {
        #[test]
        fn whatever_comes_only_destruction_ends_it_and_who_is_not_seen_keeps_state(
            events in prop::collection::vec(prop::sample::select(&ALL[..]), 0..60),
        ) {
            let mut activity = Activity::default();
            let mut kept = true;
            for (index, event) in events.iter().enumerate() {
                let reaction = activity.event(*event);
                kept = reaction.keep || (kept && ![E::Resumed, E::SessionRuns].contains(event));
                let destroyed = events[..=index].contains(&E::Destroyed);
                prop_assert_eq!(activity.next() == Next::Leave, destroyed);
                // What sleeps may be ended by the system: all that frames have changed is kept by then.
                prop_assert!(activity.next() != Next::Wait || kept);
            }
        }
    }
}
