//! Which faults strike when, as `SWELL_FAULTS` says: `NAME@A..B`, without B, or `NAME@N`, several with commas between.
//! Numbers count the calls named below since the process began, from 1.
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// `xrGetSystem`: the headset is not there. `no_system@N` strikes the first N calls.
    NoSystem,
    /// `xrCreateSession` fails.
    CreateSessionFails,
    /// `xrWaitFrame` fails, and nothing else is wrong.
    WaitFails,
    /// `xrWaitFrame`: the frame is not to be rendered.
    ShouldRenderFalse,
    /// `xrWaitFrame`: the instance is lost, until it is destroyed.
    InstanceLost,
    /// `xrAcquireSwapchainImage` fails.
    AcquireFails,
    /// `xrWaitSwapchainImage` times out.
    WaitImageTimeout,
    /// `xrEndFrame` fails; the runtime does not get the frame.
    EndFails,
    /// `xrEndFrame`: the session is lost, until it is destroyed.
    SessionLost,
    /// After this `xrRequestExitSession` the session is lost, until it is destroyed.
    LostAtExit,
    /// After this `xrEndFrame` the state is LOSS_PENDING, and the session is lost once the program knows.
    LossPending,
    /// After this `xrEndFrame` an event tells that the instance will be lost, which it is once no event is left.
    InstanceLossPending,
    /// After this `xrEndFrame` an event tells of another visibility mask, for either view.
    MaskChanged,
    /// After this `xrEndFrame` an event tells that the local space's origin moves one metre along +X.
    Recentre,
    /// After this `xrEndFrame` an event tells of other controllers.
    ProfileChanged,
}

const NAMES: [(&str, Fault); 15] = [
    ("no_system", Fault::NoSystem),
    ("create_session_fails", Fault::CreateSessionFails),
    ("wait_fails", Fault::WaitFails),
    ("should_render_false", Fault::ShouldRenderFalse),
    ("instance_lost", Fault::InstanceLost),
    ("acquire_fails", Fault::AcquireFails),
    ("wait_image_timeout", Fault::WaitImageTimeout),
    ("end_fails", Fault::EndFails),
    ("session_lost", Fault::SessionLost),
    ("lost_at_exit", Fault::LostAtExit),
    ("loss_pending", Fault::LossPending),
    ("instance_loss_pending", Fault::InstanceLossPending),
    ("mask_changed", Fault::MaskChanged),
    ("recentre", Fault::Recentre),
    ("profile_changed", Fault::ProfileChanged),
];

impl Fault {
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(_, fault)| *fault == self).map_or("?", |(name, _)| name)
    }
}

#[derive(Default)]
pub struct Plan(Vec<(Fault, Range<u32>)>);

impl Plan {
    pub fn parse(text: &str) -> Result<Self, String> {
        text.split(',').filter(|part| !part.is_empty()).map(parse_one).collect::<Result<_, _>>().map(Self)
    }

    /// Whether `fault` strikes call number `call`.
    pub fn strikes(&self, fault: Fault, call: u32) -> bool {
        self.0.iter().any(|(planned, calls)| *planned == fault && calls.contains(&call))
    }
}

fn parse_one(text: &str) -> Result<(Fault, Range<u32>), String> {
    let wrong = || format!("SWELL_FAULTS: '{text}' is none of NAME, NAME@N, NAME@A..B; names: {NAMES:?}");
    let number = |text: &str| text.parse::<u32>().map_err(|_| wrong());
    let (name, calls) = text.split_once('@').unwrap_or((text, "1"));
    let (_, fault) = NAMES.iter().find(|(known, _)| *known == name).ok_or_else(wrong)?;
    let calls = match calls.split_once("..") {
        Some((first, end)) => number(first)?..number(end)?,
        None if *fault == Fault::NoSystem => 1..number(calls)? + 1,
        None => number(calls)?..number(calls)? + 1,
    };
    if calls.start == 0 || calls.is_empty() { Err(wrong()) } else { Ok((*fault, calls)) }
}
