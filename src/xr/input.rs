//! Hands: one action set, made once for a session.

use super::bindings::{Act, PROFILES, Profile};
use super::error::{Doing, XrError};
use super::extensions::KNOWN;
use super::session::{FrameTime, Pose, Session};
use openxr as xr;
use std::time::Duration;

/// Left, right.
pub const HANDS: usize = 2;
const PATHS: [&str; HANDS] = ["/user/hand/left", "/user/hand/right"];

/// One hand at the time of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hand {
    /// Where it is, if it is tracked.
    pub grip: Option<Pose>,
    /// Where it points from, along -Z, if it is tracked.
    pub aim: Option<Pose>,
    /// Trigger or pinch, 0 to 1.
    pub go: f32,
    /// Squeeze or grasp, 0 to 1.
    pub hold: f32,
    /// Thumbstick: right and forwards, -1 to 1.
    pub stick: [f32; 2],
    /// Recentring was asked for since the frame before.
    pub recentre: bool,
    /// The panel was asked for, or away, since the frame before.
    pub panel: bool,
}

/// The action set and its spaces.
pub struct Input {
    grips: [xr::Space; HANDS],
    aims: [xr::Space; HANDS],
    grip: xr::Action<xr::Posef>,
    aim: xr::Action<xr::Posef>,
    go: xr::Action<f32>,
    hold: xr::Action<f32>,
    stick: xr::Action<xr::Vector2f>,
    recentre: xr::Action<bool>,
    panel: xr::Action<bool>,
    buzz: xr::Action<xr::Haptic>,
    hands: [xr::Path; HANDS],
    set: xr::ActionSet,
}

impl Input {
    /// Makes the actions, suggests bindings for every profile the runtime may know, and attaches them to `session`.
    ///
    /// # Errors
    /// The runtime refuses or has gone. A profile that it does not know is passed over.
    pub fn new(session: &Session) -> Result<Self, XrError> {
        let instance = &session.runtime.instance;
        let doing = "making actions";
        let hands = [instance.string_to_path(PATHS[0]), instance.string_to_path(PATHS[1])];
        let [left, right] = hands;
        let hands = [left.doing(doing)?, right.doing(doing)?];
        let set = instance.create_action_set("ocean", "Ocean", 0).doing(doing)?;
        let grip = set.create_action("grip", "Hand", &hands).doing(doing)?;
        let aim = set.create_action("aim", "Point", &hands).doing(doing)?;
        let go = set.create_action("go", "Glide where the hand points", &hands).doing(doing)?;
        let hold = set.create_action("hold", "Hold", &hands).doing(doing)?;
        let stick = set.create_action("stick", "Glide and turn", &hands).doing(doing)?;
        let recentre = set.create_action("recentre", "Back to the middle", &hands).doing(doing)?;
        let panel = set.create_action("panel", "Show the panel, or hide it", &hands).doing(doing)?;
        let buzz = set.create_action("buzz", "Vibrate", &hands).doing(doing)?;
        let space = |action: &xr::Action<xr::Posef>, hand: usize| {
            action.create_space(&session.raw, hands[hand], xr::Posef::IDENTITY).doing("making a hand's space")
        };
        let input = Self {
            grips: [space(&grip, 0)?, space(&grip, 1)?],
            aims: [space(&aim, 0)?, space(&aim, 1)?],
            grip,
            aim,
            go,
            hold,
            stick,
            recentre,
            panel,
            buzz,
            hands,
            set,
        };
        let has =
            |name| KNOWN.iter().any(|known| known.name == name && known.is_in(&session.runtime.extensions));
        for profile in PROFILES.iter().filter(|profile| profile.extension.is_none_or(has)) {
            input.suggest(instance, profile)?;
        }
        session.raw.attach_action_sets(&[&input.set]).doing("attaching actions")?;
        Ok(input)
    }

    fn suggest(&self, instance: &xr::Instance, profile: &Profile) -> Result<(), XrError> {
        let doing = "suggesting bindings";
        let mut bindings = Vec::new();
        for (hand, path) in PATHS.iter().enumerate() {
            let own = if hand == 0 { profile.left } else { profile.right };
            for (act, component) in profile.both.iter().chain(own) {
                let path = instance.string_to_path(&format!("{path}/{component}")).doing(doing)?;
                bindings.push(match act {
                    Act::Grip => xr::Binding::new(&self.grip, path),
                    Act::Aim => xr::Binding::new(&self.aim, path),
                    Act::Go => xr::Binding::new(&self.go, path),
                    Act::Hold => xr::Binding::new(&self.hold, path),
                    Act::Stick => xr::Binding::new(&self.stick, path),
                    Act::Recentre => xr::Binding::new(&self.recentre, path),
                    Act::Panel => xr::Binding::new(&self.panel, path),
                    Act::Buzz => xr::Binding::new(&self.buzz, path),
                });
            }
        }
        let path = instance.string_to_path(profile.path).doing(doing)?;
        match instance.suggest_interaction_profile_bindings(path, &bindings) {
            // A controller that this runtime has never heard of is not held in any hand either.
            Err(xr::sys::Result::ERROR_PATH_UNSUPPORTED) => Ok(()),
            other => other.doing(doing),
        }
    }

    /// Both hands at `time`. Allocates nothing; without the focus all is still.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn hands(&self, session: &Session, time: FrameTime) -> Result<[Hand; HANDS], XrError> {
        session.raw.sync_actions(&[(&self.set).into()]).doing("listening to the hands")?;
        Ok([self.hand(session, time, 0)?, self.hand(session, time, 1)?])
    }

    fn hand(&self, session: &Session, time: FrameTime, hand: usize) -> Result<Hand, XrError> {
        let (raw, path) = (&session.raw, self.hands[hand]);
        let doing = "reading a hand";
        let locate = |space: &xr::Space| -> Result<Option<Pose>, XrError> {
            let found = space.locate(session.base(), time.raw).doing("locating a hand")?;
            let valid = xr::SpaceLocationFlags::POSITION_VALID | xr::SpaceLocationFlags::ORIENTATION_VALID;
            Ok(found.location_flags.contains(valid).then(|| Pose::of(found.pose)))
        };
        let number = |action: &xr::Action<f32>| -> Result<f32, XrError> {
            let state = action.state(raw, path).doing(doing)?;
            Ok(if state.is_active { state.current_state } else { 0.0 })
        };
        let stick = self.stick.state(raw, path).doing(doing)?;
        let pressed = |action: &xr::Action<bool>| -> Result<bool, XrError> {
            let state = action.state(raw, path).doing(doing)?;
            Ok(state.is_active && state.changed_since_last_sync && state.current_state)
        };
        Ok(Hand {
            grip: locate(&self.grips[hand])?,
            aim: locate(&self.aims[hand])?,
            go: number(&self.go)?,
            hold: number(&self.hold)?,
            stick: if stick.is_active { [stick.current_state.x, stick.current_state.y] } else { [0.0; 2] },
            recentre: pressed(&self.recentre)?,
            panel: pressed(&self.panel)?,
        })
    }

    /// A short vibration of one hand, `strength` 0 to 1.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn buzz(&self, session: &Session, hand: usize, strength: f32) -> Result<(), XrError> {
        let short =
            xr::Duration::from_nanos(i64::try_from(Duration::from_millis(20).as_nanos()).unwrap_or(0));
        let event = xr::HapticVibration::new()
            .amplitude(strength)
            .frequency(xr::FREQUENCY_UNSPECIFIED)
            .duration(short);
        self.buzz.apply_feedback(&session.raw, self.hands[hand], &event).doing("vibrating")
    }

    /// Paths of the profiles in use, left and right; empty where a hand holds nothing.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn profiles(&self, session: &Session) -> Result<[String; HANDS], XrError> {
        let doing = "asking what the hands hold";
        let name = |hand: usize| -> Result<String, XrError> {
            let path = session.raw.current_interaction_profile(self.hands[hand]).doing(doing)?;
            if path == xr::Path::NULL {
                return Ok(String::new());
            }
            session.runtime.instance.path_to_string(path).doing(doing)
        };
        Ok([name(0)?, name(1)?])
    }
}
