//! The activity's events, heard in every turn of the frame loop.

use crate::gpu::Device;
use crate::host::HostError;
use crate::host::headset::{Guest, HeadsetFrame};
use crate::host::standalone::activity::{Activity, Event, Next};
use crate::host::standalone::settings::Kept;
use android_activity::{AndroidApp, MainEvent, PollEvent};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// How long nothing is done while nobody looks, before the runtime is asked again: it may have something to say too.
const NAP: Duration = Duration::from_millis(250);

/// Listens to the activity for the frame loop.
pub struct Watch {
    app: AndroidApp,
    activity: Activity,
    device: Option<Arc<Device>>,
    file: PathBuf,
    kept: Kept,
    stored: Option<Kept>,
}

impl Watch {
    /// Listens to `app`; what the next run begins with goes to `file`.
    pub fn new(app: AndroidApp, file: PathBuf, scene: String) -> Self {
        let kept = Kept { level: 0, scene };
        Self { app, activity: Activity::default(), device: None, file, kept, stored: None }
    }

    /// Waits until the activity is in front; `false` where it is destroyed before. What a host opens takes a second or more,
    /// in which no callback is answered: those that come first are over by then.
    pub fn is_shown(&mut self) -> bool {
        while self.activity.next() == Next::Wait {
            self.listen(NAP);
        }
        self.activity.next() == Next::Frames
    }

    /// Keeps what the next run begins with.
    pub fn keep(&mut self) {
        if let Some(device) = &self.device {
            device.keep_pipelines();
        }
        if self.stored.as_ref() == Some(&self.kept) {
            return;
        }
        match self.kept.store(&self.file) {
            Ok(()) => self.stored = Some(self.kept.clone()),
            Err(error) => log::warn!("{error}"),
        }
    }

    fn hear(&mut self, event: Event) {
        let reaction = self.activity.event(event);
        log::info!("activity: {}", reaction.tell);
        if reaction.keep {
            self.keep();
        }
    }

    /// Hears whatever has happened, waiting for it at most as long as `patience`.
    fn listen(&mut self, patience: Duration) {
        let mut patience = patience;
        loop {
            let mut heard = None;
            let app = self.app.clone();
            app.poll_events(Some(patience), |polled| {
                heard = Some(!matches!(polled, PollEvent::Timeout));
                if let PollEvent::Main(event) = polled
                    && let Some(event) = event_of(&event)
                {
                    self.hear(event);
                }
            });
            self.drain_input();
            if !heard.unwrap_or(false) {
                return;
            }
            patience = Duration::ZERO;
        }
    }

    /// Flat input is nobody's here, but it has to be taken: Android calls an app dead that lets it lie for five seconds.
    fn drain_input(&self) {
        if let Ok(mut events) = self.app.input_events_iter() {
            while events.next(|_| android_activity::InputStatus::Unhandled) {}
        }
    }
}

/// What the table of events knows of it.
const fn event_of(event: &MainEvent<'_>) -> Option<Event> {
    Some(match event {
        MainEvent::Start => Event::Started,
        MainEvent::Resume { .. } => Event::Resumed,
        MainEvent::Pause => Event::Paused,
        MainEvent::Stop => Event::Stopped,
        MainEvent::Destroy => Event::Destroyed,
        MainEvent::GainedFocus => Event::FocusGained,
        MainEvent::LostFocus => Event::FocusLost,
        MainEvent::InitWindow { .. } => Event::SurfaceMade,
        MainEvent::TerminateWindow { .. } => Event::SurfaceGone,
        MainEvent::LowMemory => Event::LowMemory,
        MainEvent::SaveState { .. } => Event::SaveAsked,
        MainEvent::ConfigChanged { .. } => Event::Reconfigured,
        _ => return None,
    })
}

impl Guest for Watch {
    fn goes_on(&mut self) -> bool {
        let patience = if self.activity.next() == Next::Wait { NAP } else { Duration::ZERO };
        self.listen(patience);
        self.activity.next() != Next::Leave
    }

    fn opened(&mut self, device: &Arc<Device>) -> Result<(), HostError> {
        self.device = Some(Arc::clone(device));
        Ok(())
    }

    fn closing(&mut self) {
        self.keep();
        self.device = None;
    }

    fn state(&mut self, name: &'static str) {
        log::info!("session: {name}");
        match name {
            "READY" => self.hear(Event::SessionRuns),
            "IDLE" | "EXITING" | "LOSS_PENDING" => self.hear(Event::SessionRests),
            _ => {}
        }
    }

    fn level(&mut self, number: usize) {
        self.kept.level = number;
    }

    fn frame(&mut self, _frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        Ok(())
    }
}
