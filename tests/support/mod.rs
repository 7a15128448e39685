//! What the tests of pictures and of the command line share. `docs/testing.md` explains the rules.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
pub mod faults;
pub mod golden;
pub mod headset;
pub mod limit;
pub mod live;
pub mod monado;
pub mod picture;
pub mod program;
pub mod random;
pub mod remote;
pub mod stage;
pub mod xvfb;
