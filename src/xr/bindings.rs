//! Which button does what on which controller: suggestions to the runtime, which may be rebound by a person.

/// A thing that hands do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// Where the hand is.
    Grip,
    /// Where it points.
    Aim,
    /// Glide where it points: 0 to 1.
    Go,
    /// Hold: 0 to 1.
    Hold,
    /// The thumbstick: the left one glides, the right one turns.
    Stick,
    /// Back to the middle of the raft, looking ahead.
    Recentre,
    /// Show the panel, or hide it.
    Panel,
    /// Vibrate.
    Buzz,
}

/// Suggestions for one interaction profile.
pub struct Profile {
    /// Its path.
    pub path: &'static str,
    /// The extension it needs, if any.
    pub extension: Option<&'static str>,
    /// For each hand (`/user/hand/left` and `right`), what is at which path below it.
    pub both: &'static [(Act, &'static str)],
    /// The same for the left hand alone.
    pub left: &'static [(Act, &'static str)],
    /// The same for the right hand alone.
    pub right: &'static [(Act, &'static str)],
}

const POSES: [(Act, &str); 2] = [(Act::Grip, "input/grip/pose"), (Act::Aim, "input/aim/pose")];

/// Controllers with a stick, a trigger and a grip that all tell how far.
static TOUCH: &[(Act, &str)] = &[
    POSES[0],
    POSES[1],
    (Act::Go, "input/trigger/value"),
    (Act::Hold, "input/squeeze/value"),
    (Act::Stick, "input/thumbstick"),
    (Act::Recentre, "input/thumbstick/click"),
    (Act::Buzz, "output/haptic"),
];

/// What is on the left one of those alone.
static TOUCH_LEFT: &[(Act, &str)] = &[(Act::Recentre, "input/menu/click"), (Act::Panel, "input/y/click")];

/// All of them.
pub static PROFILES: &[Profile] = &[
    Profile {
        path: "/interaction_profiles/khr/simple_controller",
        extension: None,
        both: &[POSES[0], POSES[1], (Act::Go, "input/select/click"), (Act::Buzz, "output/haptic")],
        left: &[(Act::Panel, "input/menu/click")],
        right: &[(Act::Recentre, "input/menu/click")],
    },
    Profile {
        path: "/interaction_profiles/oculus/touch_controller",
        extension: None,
        both: TOUCH,
        left: TOUCH_LEFT,
        right: &[],
    },
    Profile {
        path: "/interaction_profiles/meta/touch_controller_plus",
        extension: Some("XR_META_touch_controller_plus"),
        both: TOUCH,
        left: TOUCH_LEFT,
        right: &[],
    },
    Profile {
        path: "/interaction_profiles/valve/index_controller",
        extension: None,
        both: TOUCH,
        left: &[(Act::Panel, "input/b/click")],
        right: &[],
    },
    Profile {
        path: "/interaction_profiles/ext/hand_interaction_ext",
        extension: Some("XR_EXT_hand_interaction"),
        both: &[POSES[0], POSES[1], (Act::Go, "input/pinch_ext/value"), (Act::Hold, "input/grasp_ext/value")],
        left: &[],
        right: &[],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_profile_has_poses_and_a_way_to_go() {
        for profile in PROFILES {
            for act in [Act::Grip, Act::Aim, Act::Go] {
                assert!(profile.both.iter().any(|(bound, _)| *bound == act), "{}: {act:?}", profile.path);
            }
        }
    }

    #[test]
    fn needed_extensions_are_known() {
        for extension in PROFILES.iter().filter_map(|profile| profile.extension) {
            assert!(
                super::super::extensions::KNOWN.iter().any(|known| known.name == extension),
                "{extension}"
            );
        }
    }
}
