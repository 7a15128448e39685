//! An OpenXR API layer for tests: between a program and the runtime it makes calls fail, injects events, and writes down
//! what the program asked for. It is loaded by the OpenXR loader, never linked; `tests/support/faults.rs` shows how.
//!
//! `SWELL_FAULTS` holds faults (see `plan`), `SWELL_FAULT_LOG` names the file that gets a line for each call. The layer
//! knows one instance and one session at a time. Its counters and its plan live as long as the process, so a fault strikes
//! once however often a program starts anew.
#![allow(clippy::expect_used, reason = "a part of tests, which may panic")]
mod calls;
mod describe;
mod events;
mod instance;
mod next;
mod plan;
mod pretend;
mod runtime;
mod state;
