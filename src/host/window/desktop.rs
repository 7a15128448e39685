//! A window of the desktop's: its events, asked for and never waited in, and pictures shown on it.
//!
//! The event loop does not run the program. Whoever draws asks for events between two frames, so that a headset's frames
//! are never kept by a window.

use super::input::{Input, Key};
use super::interface::Interface;
use crate::draw::Painting;
use crate::gpu::{Device, GpuError, Layers, Outcome, Pace, Picture, Presenter, Shown, Surface};
use crate::host::HostError;
use std::ffi::CStr;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::error::OsError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::platform::pump_events::{EventLoopExtPumpEvents, PumpStatus};
use winit::window::{Fullscreen, Window, WindowAttributes, WindowId};

/// How often a hidden window looks whether it is still hidden.
const HIDDEN: Duration = Duration::from_millis(100);
/// How often a window without the keyboard asks whether it is minimised: asking waits for the display server.
const ASK: Duration = Duration::from_millis(300);
/// Where nobody knows how often the screen is renewed.
const USUAL_REFRESH: f64 = 1.0 / 60.0;

/// A window, shown on from the moment it has a device.
pub struct DesktopWindow {
    /// Dropped first: it shows on the window.
    presenter: Option<Presenter>,
    state: State,
    events: EventLoop<()>,
}

/// What events change.
struct State {
    wanted: WindowAttributes,
    window: Option<Arc<Window>>,
    failed: Option<OsError>,
    input: Input,
    /// What is drawn over the picture, once somebody wants it.
    interface: Option<Interface>,
    /// Pixels, as events tell: asking would wait for the display server.
    size: [u32; 2],
    closed: bool,
    occluded: bool,
    focused: bool,
    minimised: bool,
    asked: Instant,
    refresh: Option<f64>,
}

impl DesktopWindow {
    /// Opens a window of `size` pixels. One a process, from its main thread.
    ///
    /// # Errors
    /// [`HostError::NoDisplay`] where there is nothing to open it on.
    pub fn open(title: &str, size: [u32; 2]) -> Result<Self, HostError> {
        let events = EventLoop::new().map_err(|error| HostError::NoDisplay(plain(&error.to_string())))?;
        let size = PhysicalSize::new(size[0], size[1]);
        let state = State {
            wanted: Window::default_attributes().with_title(title).with_inner_size(size),
            window: None,
            failed: None,
            input: Input::default(),
            interface: None,
            size: [0, 0],
            closed: false,
            occluded: false,
            focused: true,
            minimised: false,
            asked: Instant::now(),
            refresh: None,
        };
        let mut window = Self { presenter: None, state, events };
        window.pump_for(Duration::ZERO)?;
        match (&window.state.window, window.state.failed.take()) {
            (Some(_), _) => Ok(window),
            (None, Some(error)) => Err(HostError::NoDisplay(plain(&error.to_string()))),
            (None, None) => Err(HostError::NoDisplay("the display opens no window now".to_owned())),
        }
    }

    /// Extensions that the Vulkan instance needs; the device needs [`Presenter::DEVICE_EXTENSIONS`].
    ///
    /// # Errors
    /// Vulkan can show nothing on such a display.
    pub fn extensions(&self) -> Result<Vec<&'static CStr>, GpuError> {
        Surface::extensions(&self.events)
    }

    /// Shows pictures of `device` from now on.
    ///
    /// # Errors
    /// The device cannot show anything on this window.
    pub fn attach(&mut self, device: &Arc<Device>, pace: Pace) -> Result<(), GpuError> {
        if let Some(window) = &self.state.window {
            let shown: Arc<dyn Shown> = Arc::clone(window) as Arc<dyn Shown>;
            self.presenter = Some(Presenter::new(device, &shown, pace)?);
        }
        Ok(())
    }

    /// Shows nothing any more: before the device goes.
    pub fn detach(&mut self) {
        self.presenter = None;
    }

    /// Takes in what has happened. Where nothing can be seen and `idle`, it waits a little for something to happen.
    ///
    /// # Errors
    /// [`HostError::DisplayGone`].
    pub fn pump(&mut self, idle: bool) -> Result<(), HostError> {
        self.state.look_whether_minimised();
        let wait = if idle && self.is_hidden() { HIDDEN } else { Duration::ZERO };
        self.pump_for(wait)
    }

    fn pump_for(&mut self, wait: Duration) -> Result<(), HostError> {
        match self.events.pump_app_events(Some(wait), &mut self.state) {
            PumpStatus::Continue => Ok(()),
            // Nobody here ends the event loop.
            PumpStatus::Exit(_) => Err(HostError::DisplayGone),
        }
    }

    /// Whether somebody closed it.
    pub const fn is_closed(&self) -> bool {
        self.state.closed
    }

    /// Whether nothing of it can be seen, as far as the system tells.
    pub fn is_hidden(&self) -> bool {
        self.state.occluded || self.state.minimised || self.state.size.contains(&0)
    }

    /// Pixels that pictures are shown on; none while there are none.
    ///
    /// # Errors
    /// The window is gone, or the device was lost.
    pub fn extent(&mut self) -> Result<Option<[u32; 2]>, GpuError> {
        let size = self.state.size;
        self.presenter.as_mut().map_or(Ok(None), |presenter| presenter.extent(size))
    }

    /// Shows `layers` of `picture`, where an image of the window comes within `patience`.
    ///
    /// # Errors
    /// The window is gone, or the device was lost.
    pub fn show(
        &mut self,
        picture: &Picture,
        layers: Layers,
        patience: Duration,
    ) -> Result<Outcome, GpuError> {
        let size = self.state.size;
        match &mut self.presenter {
            Some(presenter) => presenter.show(picture, layers, size, patience),
            None => Ok(Outcome::NoSize),
        }
    }

    /// Waits until no picture is being read any more: before one goes.
    ///
    /// # Errors
    /// The device was lost.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.presenter.as_ref().map_or(Ok(()), Presenter::wait)
    }

    /// Keys and mouse.
    pub const fn input(&mut self) -> &mut Input {
        &mut self.state.input
    }

    /// Keys pressed since the last call. Those that are about the window itself have been seen to.
    pub fn pressed(&mut self) -> Vec<Key> {
        let keys: Vec<Key> = self.state.input.pressed().collect();
        for _ in keys.iter().filter(|key| **key == Key::Fullscreen) {
            self.toggle_fullscreen();
        }
        keys
    }

    /// What is drawn over the picture, if somebody has wanted it yet.
    pub const fn interface(&mut self) -> Option<&mut Interface> {
        self.state.interface.as_mut()
    }

    /// The same, made now where it is not there. With `step`, a frame counts as so many seconds.
    pub fn interface_or_new(&mut self, step: Option<f64>) -> Option<&mut Interface> {
        let window = self.state.window.as_ref()?;
        Some(self.state.interface.get_or_insert_with(|| Interface::new(window, step)))
    }

    /// Runs `show` in it for a frame: what is to be drawn over the picture. Nothing while it is hidden.
    pub fn run_interface(&mut self, show: impl FnMut(&mut egui::Ui)) -> Option<Painting> {
        let window = self.state.window.as_ref()?;
        self.state.interface.as_mut()?.run(window, show)
    }

    fn toggle_fullscreen(&self) {
        if let Some(window) = &self.state.window {
            let all = Fullscreen::Borderless(None);
            window.set_fullscreen(if window.fullscreen().is_some() { None } else { Some(all) });
        }
    }

    /// Writes `title` above the window.
    pub fn set_title(&self, title: &str) {
        if let Some(window) = &self.state.window {
            window.set_title(title);
        }
    }

    /// Seconds between two pictures of the screen it is on.
    pub fn refresh(&mut self) -> f64 {
        let window = self.state.window.as_ref();
        let ask = || {
            let millihertz = window?.current_monitor()?.refresh_rate_millihertz()?;
            (millihertz > 0).then(|| 1000.0 / f64::from(millihertz))
        };
        *self.state.refresh.get_or_insert_with(|| ask().unwrap_or(USUAL_REFRESH))
    }
}

impl State {
    /// X11 tells nobody that it minimises a window, and takes the keyboard away when it does.
    fn look_whether_minimised(&mut self) {
        if (self.focused && !self.minimised) || self.asked.elapsed() < ASK {
            return;
        }
        self.asked = Instant::now();
        self.minimised = self.window.as_ref().and_then(|window| window.is_minimized()).unwrap_or(false);
    }
}

impl ApplicationHandler for State {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.window.is_none() {
            match events.create_window(self.wanted.clone()) {
                Ok(window) => {
                    self.size = window.inner_size().into();
                    self.window = Some(Arc::new(window));
                }
                Err(error) => self.failed = Some(error),
            }
        }
    }

    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let taken = match (&mut self.interface, &self.window) {
            (Some(interface), Some(window)) => interface.take(window, &event),
            _ => false,
        };
        let shown = self.interface.as_ref().is_some_and(Interface::is_shown);
        if !taken {
            self.input.take(&event, shown);
        }
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => self.closed = true,
            WindowEvent::Occluded(occluded) => self.occluded = occluded,
            WindowEvent::Focused(focused) => self.focused = focused,
            WindowEvent::Resized(size) => self.size = size.into(),
            // It may be on another screen now. A new scale comes with a new size.
            WindowEvent::Moved(_) | WindowEvent::ScaleFactorChanged { .. } => self.refresh = None,
            _ => {}
        }
    }
}

/// What winit says, without where in its source it says so.
fn plain(error: &str) -> String {
    let reason = error.strip_prefix("os error at ").and_then(|rest| rest.split_once(": "));
    reason.map_or(error, |(_, reason)| reason).trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn a_reason_is_told_without_its_place() {
        assert_eq!(plain("os error at /x/mod.rs:7: DISPLAY: none."), "DISPLAY: none");
        assert_eq!(plain("other"), "other");
    }
}
