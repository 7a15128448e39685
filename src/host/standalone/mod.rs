//! What a headset that is a computer of its own needs besides frames: its defaults, its folders, the life of its app.
//!
//! Nothing here knows Android's interface, so all of it is tested on any machine; `host::android` is what connects the two.

pub mod activity;
pub mod folders;
pub mod model;
pub mod settings;
