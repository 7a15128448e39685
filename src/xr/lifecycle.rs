//! The states of a session and what each asks of an application (OpenXR 1.0, section 9.3).

use openxr::SessionState;

/// What has to be done on entering a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// Nothing.
    Nothing,
    /// Begin the session.
    Begin,
    /// End it.
    End,
    /// Leave for good: the person or the runtime wants no more frames.
    Leave,
    /// Destroy it and, if one likes, make another.
    Lost,
}

/// Where a session is.
#[derive(Clone, Copy, Debug)]
pub struct Lifecycle {
    state: SessionState,
    running: bool,
}

impl Default for Lifecycle {
    fn default() -> Self {
        Self { state: SessionState::UNKNOWN, running: false }
    }
}

impl Lifecycle {
    /// Enters `state`.
    pub fn enter(&mut self, state: SessionState) -> Demand {
        self.state = state;
        match state {
            SessionState::READY if !self.running => {
                self.running = true;
                Demand::Begin
            }
            SessionState::STOPPING if self.running => {
                self.running = false;
                Demand::End
            }
            SessionState::EXITING => Demand::Leave,
            SessionState::LOSS_PENDING => Demand::Lost,
            _ => Demand::Nothing,
        }
    }

    /// The latest state.
    pub const fn state(self) -> SessionState {
        self.state
    }

    /// Whether frames are to be waited for, begun and ended.
    pub const fn is_running(self) -> bool {
        self.running
    }

    /// Its name, as OpenXR writes it.
    pub fn name(self) -> &'static str {
        match self.state {
            SessionState::IDLE => "IDLE",
            SessionState::READY => "READY",
            SessionState::SYNCHRONIZED => "SYNCHRONIZED",
            SessionState::VISIBLE => "VISIBLE",
            SessionState::FOCUSED => "FOCUSED",
            SessionState::STOPPING => "STOPPING",
            SessionState::LOSS_PENDING => "LOSS_PENDING",
            SessionState::EXITING => "EXITING",
            _ => "UNKNOWN",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use SessionState as S;

    fn demands(states: &[S]) -> Vec<Demand> {
        let mut lifecycle = Lifecycle::default();
        states.iter().map(|&state| lifecycle.enter(state)).collect()
    }

    #[test]
    fn a_whole_life() {
        use Demand::{Begin, End, Leave, Nothing as N};
        let states = [
            S::IDLE,
            S::READY,
            S::SYNCHRONIZED,
            S::VISIBLE,
            S::FOCUSED,
            S::VISIBLE,
            S::SYNCHRONIZED,
            S::STOPPING,
            S::IDLE,
            S::EXITING,
        ];
        assert_eq!(demands(&states), [N, Begin, N, N, N, N, N, End, N, Leave]);
    }

    #[test]
    fn a_headset_put_down_and_taken_up_again() {
        use Demand::{Begin, End, Nothing as N};
        let states = [S::IDLE, S::READY, S::SYNCHRONIZED, S::STOPPING, S::IDLE, S::READY];
        assert_eq!(demands(&states), [N, Begin, N, End, N, Begin]);
    }

    #[test]
    fn frames_only_between_begin_and_end() {
        let mut lifecycle = Lifecycle::default();
        let mut running = |state| {
            lifecycle.enter(state);
            lifecycle.is_running()
        };
        assert!(!running(S::IDLE));
        for state in [S::READY, S::SYNCHRONIZED, S::VISIBLE, S::FOCUSED] {
            assert!(running(state));
        }
        assert!(!running(S::STOPPING) && !running(S::IDLE));
    }

    #[test]
    fn loss_is_loss_in_any_state() {
        for before in [S::IDLE, S::READY, S::FOCUSED, S::STOPPING] {
            assert_eq!(demands(&[before, S::LOSS_PENDING])[1], Demand::Lost);
        }
    }
}
